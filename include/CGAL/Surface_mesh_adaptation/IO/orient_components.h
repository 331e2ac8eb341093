// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which way the components of a surface look: closed ones outwards, cavities inwards, open ones as most of their area
// did in the input.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_ORIENT_COMPONENTS_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_ORIENT_COMPONENTS_H

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Turns the components of a triangle mesh, which are oriented consistently, to the side that they are to look to.
///
/// The input says it for open components, by most of their area, and for closed ones inside others: a cavity looks
/// inwards, a shell inside a shell outwards. What is not inside another looks outwards, and takes all that is inside it
/// along when it is turned. A component inside another whose faces did not agree bounds a volume with it.
template <class TriangleMesh>
class Component_orienter
{
public:
  /// \param is_turned whether the `i`-th face of `mesh` looks the other way in the input
  Component_orienter(TriangleMesh& mesh, const std::vector<bool>& is_turned)
    : mesh_(mesh), point_(get(CGAL::vertex_point, mesh))
  {
    const auto number = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh_);
    components_.resize(CGAL::Polygon_mesh_processing::connected_components(mesh_, number));
    std::size_t i = 0;
    for (const Face f : faces(mesh_)) {
      add(components_[get(number, f)], f, i, is_turned[i]);
      ++i;
    }
  }

  /// Turns what is to be turned. Calls `turned(i)` for the number of each face of it.
  template <class Turned>
  void orient(const Turned& turned)
  {
    for (Component& c : components_) c.is_to_turn = c.is_against_input();
    if (std::any_of(components_.begin(), components_.end(), [](const Component& c) { return c.is_in_doubt(); })) {
      find_containers();
      orient_closed_components();
    }
    for (const Component& c : components_)
      if (c.is_to_turn) {
        CGAL::Polygon_mesh_processing::reverse_face_orientations(c.faces, mesh_);
        for (const std::size_t i : c.numbers) turned(i);
      }
  }

  /// How many components have a face for whose number `has(i)` holds.
  template <class Has>
  std::size_t number_of_components_that_have(const Has& has) const
  {
    return std::size_t(std::count_if(components_.begin(), components_.end(), [&](const Component& c) {
      return std::any_of(c.numbers.begin(), c.numbers.end(), has);
    }));
  }

private:
  using Face = typename boost::graph_traits<TriangleMesh>::face_descriptor;
  using Point_map = typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::type;
  using Point = typename boost::property_traits<Point_map>::value_type;
  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;
  using Side = CGAL::Side_of_triangle_mesh<TriangleMesh, Kernel>;
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

  struct Component
  {
    std::vector<Face> faces;
    std::vector<std::size_t> numbers;    // of the faces
    CGAL::Bbox_3 box;
    double area = 0;                     // of the faces that look as in the input, less that of the others
    double volume = 0;                   // that the faces bound
    bool is_closed = true;
    bool agrees = true;                  // all faces look as in the input, or none
    bool is_first_turned = false;
    std::vector<std::size_t> containers; // the components that this one is inside of
    bool is_to_turn = false;

    bool is_against_input() const { return area < 0; }
    bool is_in_doubt() const { return is_closed && (!agrees || (volume < 0) != is_against_input()); }
    bool takes_along() const { return is_to_turn != is_against_input(); }
  };

  std::array<Point, 3> corners(Face f) const
  {
    const auto h = halfedge(f, mesh_);
    return {get(point_, source(h, mesh_)), get(point_, target(h, mesh_)), get(point_, target(next(h, mesh_), mesh_))};
  }

  void add(Component& c, Face f, std::size_t number, bool is_turned)
  {
    if (c.faces.empty()) c.is_first_turned = is_turned;
    c.agrees = c.agrees && is_turned == c.is_first_turned;
    c.faces.push_back(f);
    c.numbers.push_back(number);
    const auto [p, q, r] = corners(f);
    const Point& origin = get(point_, *vertices(mesh_).begin());
    c.box += p.bbox() + q.bbox() + r.bbox();
    c.area += (is_turned ? -1 : 1) * std::sqrt(CGAL::to_double(CGAL::squared_area(p, q, r)));
    c.volume += CGAL::to_double(CGAL::volume(origin, p, q, r));
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh_), mesh_))
      c.is_closed = c.is_closed && !is_border(opposite(h, mesh_), mesh_);
  }

  void orient_closed_components()
  {
    for (Component& c : components_)
      if (c.is_closed && c.containers.empty()) c.is_to_turn = c.volume < 0;
    for (Component& c : components_)
      if (!c.containers.empty())
        c.is_to_turn = c.agrees ? c.is_against_input() != outermost(c).takes_along()
                                : (c.volume < 0) != (c.containers.size() % 2 == 1);
  }

  const Component& outermost(const Component& c) const
  {
    return components_[*std::min_element(c.containers.begin(), c.containers.end(), [&](std::size_t i, std::size_t j) {
      return components_[i].containers.size() < components_[j].containers.size();
    })];
  }

  void find_containers()
  {
    std::vector<std::pair<std::size_t, std::size_t>> candidates; // boxes: the first holds the second
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < components_.size(); ++i)
      if (components_[i].is_closed) boxes.emplace_back(components_[i].box, i);
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      if (holds(a, b)) candidates.emplace_back(a.info(), b.info());
      if (holds(b, a)) candidates.emplace_back(b.info(), a.info());
    });
    std::sort(candidates.begin(), candidates.end());
    for (std::size_t i = 0, j; i < candidates.size(); i = j) {
      for (j = i; j < candidates.size() && candidates[j].first == candidates[i].first;) ++j;
      add_as_container(candidates[i].first, candidates.data() + i, candidates.data() + j);
    }
  }

  bool holds(const Box& a, const Box& b) const
  {
    for (int i = 0; i < 3; ++i)
      if (b.min_coord(i) < a.min_coord(i) || b.max_coord(i) > a.max_coord(i)) return false;
    return true;
  }

  /// \param first, last candidates for what is inside the component `container`
  void add_as_container(std::size_t container, const std::pair<std::size_t, std::size_t>* first,
                        const std::pair<std::size_t, std::size_t>* last)
  {
    std::vector<Face> with_area; // a ray may meet no other
    for (const Face f : components_[container].faces)
      if (const auto [p, q, r] = corners(f); !CGAL::collinear(p, q, r)) with_area.push_back(f);
    if (with_area.empty()) return;
    const typename Side::AABB_tree tree(with_area.begin(), with_area.end(), mesh_, point_);
    const Side side(tree);
    for (; first != last; ++first) {
      Component& c = components_[first->second];
      const auto points = extreme_points(c);
      if (std::all_of(points.begin(), points.end(), [&](const Point& p) { return side(p) == CGAL::ON_BOUNDED_SIDE; }))
        c.containers.push_back(container);
    }
  }

  /// A component that is neither inside another nor outside has points on both sides of it: most likely among these.
  std::array<Point, 6> extreme_points(const Component& c) const
  {
    const Point start = corners(c.faces.front())[0];
    std::array<Point, 6> extreme = {start, start, start, start, start, start};
    for (const Face f : c.faces)
      for (const Point& p : corners(f))
        for (int i = 0; i < 3; ++i) {
          if (p[i] < extreme[std::size_t(2 * i)][i]) extreme[std::size_t(2 * i)] = p;
          if (p[i] > extreme[std::size_t(2 * i + 1)][i]) extreme[std::size_t(2 * i + 1)] = p;
        }
    return extreme;
  }

  TriangleMesh& mesh_;
  Point_map point_;
  std::vector<Component> components_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_ORIENT_COMPONENTS_H

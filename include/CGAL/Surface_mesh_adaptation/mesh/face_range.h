// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads some faces of a face graph into a mesh view, with two rings of faces around them.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_FACE_RANGE_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_FACE_RANGE_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Whether `Range` is a range of faces of `FaceGraph`.
template <class Range, class FaceGraph, class = void>
constexpr bool is_face_range = false;

template <class Range, class FaceGraph>
constexpr bool is_face_range<Range, FaceGraph,
                             std::enable_if_t<std::is_same_v<
                               std::decay_t<decltype(*std::begin(std::declval<const Range&>()))>,
                               typename boost::graph_traits<std::remove_const_t<FaceGraph>>::face_descriptor>>> = true;

/// What is passed as a mesh beside `Field`, rather than an execution policy or a range of faces.
template <class Mesh, class Field>
using If_mesh = std::enable_if_t<!is_execution<Mesh> && !is_face_range<Mesh, Field>>;

/// What is passed as a range of faces of a mesh.
template <class Range, class Mesh>
using If_faces = std::enable_if_t<is_face_range<Range, Mesh>>;

/// The place of `element` in `range`, which has it.
template <class Range, class Element>
std::size_t place_in(const Range& range, const Element& element)
{
  return std::size_t(std::distance(range.begin(), std::find(range.begin(), range.end(), element)));
}

/// Faces of a graph, numbered: those of a range first, then two rings of faces around them.
template <class FaceGraph>
class Face_range
{
public:
  using Face = typename boost::graph_traits<FaceGraph>::face_descriptor;

  /// \throws Empty_mesh_error, Mesh_too_large_error, Non_triangular_face_error
  /// \par Complexity
  /// O(number of faces), and setting a byte for each face of `graph`
  template <class Range>
  Face_range(const Range& range, const FaceGraph& graph)
    : number_(get(CGAL::dynamic_face_property_t<Index>(), graph))
  {
    for (const Face f : range) add(f, graph);
    if (faces_.empty()) throw Empty_mesh_error();
    number_inside_ = Index(faces_.size());
    for (int ring = 0; ring < 2; ++ring)
      for (std::size_t i = 0, n = faces_.size(); i < n; ++i)
        for (const auto h : CGAL::halfedges_around_face(halfedge(faces_[i], graph), graph))
          for (const auto g : CGAL::halfedges_around_target(h, graph))
            if (!is_border(g, graph)) add(face(g, graph), graph);
  }

  const std::vector<Face>& list() const { return faces_; }
  Index number_inside() const { return number_inside_; }

  /// The number of the face; `no_index` if it is neither inside nor near.
  Index number(Face f) const { return get(number_, f) - 1; }

  bool is_inside(Face f) const { return number(f) < number_inside_; }

private:
  void add(Face f, const FaceGraph& graph)
  {
    if (get(number_, f) != 0) return;
    const auto h = halfedge(f, graph);
    if (next(next(next(h, graph), graph), graph) != h || next(h, graph) == h)
      throw Non_triangular_face_error(place_in(faces(graph), f));
    if (faces_.size() == max_number_of_faces) throw Mesh_too_large_error(faces_.size() + 1, max_number_of_faces);
    faces_.push_back(f);
    put(number_, f, Index(faces_.size())); // from 1: maps start with 0
  }

  typename boost::property_map<FaceGraph, CGAL::dynamic_face_property_t<Index>>::const_type number_;
  std::vector<Face> faces_;
  Index number_inside_ = 0;
};

/// Numbers the fans of faces around vertices. A vertex whose faces form several fans becomes several vertices: where the
/// rings around a range touch themselves, it is no fault of the mesh.
template <class FaceGraph>
void number_fans(const FaceGraph& graph, Imported_mesh<FaceGraph>& result)
{
  Mesh_view& mesh = result.mesh;
  for (Index h = 0; h < mesh.number_of_halfedges(); ++h) {
    if (mesh.corner[h] != no_index) continue;
    const Index v = Index(mesh.outgoing.size());
    mesh.outgoing.push_back(mesh.first_of_fan(h));
    mesh.for_each_outgoing(v, [&](Index g) { mesh.corner[g] = v; });
    result.vertices.push_back(source(result.halfedges[h], graph));
  }
}

/// Reads the faces of `range`, with their numbers.
/// \throws Non_finite_coordinate_error, Invalid_extent_error
template <class FaceGraph, class VertexPointMap>
Imported_mesh<FaceGraph> import_face_range(const FaceGraph& graph, const Face_range<FaceGraph>& range,
                                           const VertexPointMap& point_map)
{
  Imported_mesh<FaceGraph> result;
  for (const auto f : range.list())
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, graph), graph)) result.halfedges.push_back(h);
  Mesh_view& mesh = result.mesh;
  mesh.corner.assign(result.halfedges.size(), no_index);
  mesh.curve.assign(result.halfedges.size(), no_curve);
  for (const auto h : result.halfedges) {
    const auto o = opposite(h, graph);
    const Index f = is_border(o, graph) ? no_index : range.number(face(o, graph));
    const auto is_it = [&](Index i) { return result.halfedges[3 * std::size_t(f) + i] == o; };
    mesh.twin.push_back(f == no_index ? no_index : 3 * f + (is_it(0) ? 0 : is_it(1) ? 1 : 2));
  }
  number_fans(graph, result);
  Bounding_box box;
  for (const auto v : result.vertices) {
    const auto& p = get(point_map, v);
    result.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    if (!result.points.back().allFinite()) throw Non_finite_coordinate_error(place_in(vertices(graph), v));
    box = box + Bounding_box{result.points.back(), result.points.back()};
  }
  check_extent(box);
  return result;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_FACE_RANGE_H

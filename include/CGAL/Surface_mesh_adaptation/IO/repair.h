// SPDX-License-Identifier: GPL-3.0-or-later
//
// From any soup of polygons to a valid triangle mesh.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_REPAIR_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_REPAIR_H

#include <CGAL/Surface_mesh_adaptation/IO/Repair_report.h>
#include <CGAL/Surface_mesh_adaptation/IO/orient_components.h>
#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>
#include <CGAL/Surface_mesh_adaptation/IO/triangulate_polygons.h>
#include <CGAL/Surface_mesh_adaptation/IO/weld.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/join_triangles.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFiles
/// @{

/// What `repair_polygon_soup_to_triangle_mesh()` may do.
struct Repair_options
{
  bool weld = true;                    ///< join points at the same place where edges match then
  bool remove_degenerate_faces = true; ///< those without area
};

namespace internal {

/// Parts of a polygon between two visits of the same vertex, each without repetitions and with three corners at least.
inline std::vector<std::vector<std::uint32_t>> parts_of(const std::vector<std::uint32_t>& polygon)
{
  std::vector<std::vector<std::uint32_t>> parts;
  std::vector<std::uint32_t> walk;
  const auto close = [&](std::ptrdiff_t first) {
    if (std::ptrdiff_t(walk.size()) - first >= 3) parts.emplace_back(walk.begin() + first, walk.end());
    walk.erase(walk.begin() + first, walk.end());
  };
  for (const std::uint32_t v : polygon) {
    const auto visited = std::find(walk.begin(), walk.end(), v);
    if (visited != walk.end()) close(visited - walk.begin());
    walk.push_back(v);
  }
  close(0);
  return parts;
}

inline void remove_holes(...) {} // other meshes have none in their lists

template <class Point>
void remove_holes(CGAL::Surface_mesh<Point>& mesh)
{
  mesh.collect_garbage();
}

template <class TriangleMesh>
void clear_elements(TriangleMesh& mesh)
{
  CGAL::clear(mesh);
}

template <class Point>
void clear_elements(CGAL::Surface_mesh<Point>& mesh)
{
  mesh.clear_without_removing_property_maps();
}

template <class TriangleMesh>
std::size_t number_of_degenerate_faces(const TriangleMesh& mesh)
{
  return std::size_t(std::count_if(faces(mesh).begin(), faces(mesh).end(), [&](const auto f) {
    return CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh);
  }));
}

/// Removes faces without area by CGAL. Returns whether that went well: the mesh is valid.
template <class TriangleMesh>
bool removes_degenerate_faces(TriangleMesh& mesh)
{
  try {
    CGAL::Polygon_mesh_processing::remove_degenerate_faces(mesh);
    remove_holes(mesh);
    if (num_faces(mesh) > 0) read_face_graph(Sequential_execution(), mesh, get(CGAL::vertex_point, mesh));
    return true;
  } catch (const std::exception&) { // of what CGAL asserts, or we
    return false;
  }
}

/// Keeps where vertices and faces come from while some of them go, and others come, which are numbered 0.
template <class TriangleMesh>
class Kept_numbers
{
public:
  explicit Kept_numbers(const TriangleMesh& mesh)
    : of_vertex_(get(CGAL::dynamic_vertex_property_t<std::size_t>(), mesh)),
      of_face_(get(CGAL::dynamic_face_property_t<std::size_t>(), mesh))
  {
    std::size_t i = 0;
    for (const auto v : vertices(mesh)) put(of_vertex_, v, ++i);
    i = 0;
    for (const auto f : faces(mesh)) put(of_face_, f, ++i);
  }

  /// A vertex that has come, or moved, is at the place of a former one.
  /// \param former the points of these
  template <class Points>
  void renumber(const TriangleMesh& mesh, Repair_report& report, const Points& former) const
  {
    std::vector<std::size_t> points, polygons;
    for (const auto v : vertices(mesh)) {
      const std::size_t n = get(of_vertex_, v);
      const auto& p = get(CGAL::vertex_point, mesh, v);
      const bool is_known = n > 0 && former[n - 1] == p;
      const auto found = is_known ? former.begin() + std::ptrdiff_t(n - 1) : std::find(former.begin(), former.end(), p);
      points.push_back(report.point_of_vertex[std::size_t(found - former.begin())]);
    }
    for (const auto f : faces(mesh)) {
      const std::size_t n = get(of_face_, f);
      polygons.push_back(n > 0 ? report.polygon_of_face[n - 1] : Repair_report::none);
    }
    report.point_of_vertex = std::move(points);
    report.polygon_of_face = std::move(polygons);
  }

private:
  typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<std::size_t>>::const_type of_vertex_;
  typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<std::size_t>>::const_type of_face_;
};

/// The polygons of a soup on the way to a triangle mesh. Whatever is done is counted in the report.
template <class Point>
class Soup_repair
{
public:
  /// Takes what can be made of each polygon: triangles.
  template <class Polygons>
  Soup_repair(std::vector<Point> points, const Polygons& polygons) : points_(std::move(points))
  {
    constexpr std::size_t most = (std::numeric_limits<std::uint32_t>::max)() - 1;
    if (points_.size() > most) throw Mesh_too_large_error(points_.size(), most);
    origin_.resize(points_.size());
    std::iota(origin_.begin(), origin_.end(), std::uint32_t(0));
    take(polygons);
  }

  /// \param mesh is empty
  template <class TriangleMesh>
  Repair_report build(TriangleMesh& mesh, const Repair_options& options)
  {
    remove_unused();
    is_turned_.assign(triangles_.size(), false);
    original_.resize(points_.size());
    std::iota(original_.begin(), original_.end(), std::uint32_t(0));
    view_ = view_of_surface();
    if (!view_) {
      remove_duplicate_faces();
      orient_and_cut();
    }
    join(options.weld);
    remove_unused();
    convert(mesh);
    if (!triangles_.empty()) orient_components(mesh);
    number_elements();
    find_degenerate_faces(mesh);
    if (options.remove_degenerate_faces && report_.degenerate_faces.count > 0) remove_degenerate_faces(mesh);
    return std::move(report_);
  }

private:
  template <class Polygons>
  void take(const Polygons& polygons)
  {
    std::vector<bool> is_finite(points_.size()), is_used(points_.size(), false);
    for (std::size_t i = 0; i < points_.size(); ++i) is_finite[i] = is_finite_point(points_[i]);
    Polygon_triangulator<Point> triangulate(points_);
    std::vector<std::uint32_t> corners; // of one polygon
    std::size_t number = 0;
    for (const auto& polygon : polygons) {
      take(polygon, number, corners, is_finite, is_used, triangulate);
      ++number;
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!is_used[i]) report_.isolated_points.add("vertex", i);
      else if (!is_finite[i]) report_.non_finite_points.add("vertex", i);
    }
  }

  template <class Polygon>
  void take(const Polygon& polygon, std::size_t number, std::vector<std::uint32_t>& corners,
            const std::vector<bool>& is_finite, std::vector<bool>& is_used, Polygon_triangulator<Point>& triangulate)
  {
    corners.clear();
    bool exist = true, are_finite = true;
    for (const auto v : polygon) {
      exist = exist && std::size_t(v) < points_.size();
      if (!exist) continue;
      corners.push_back(std::uint32_t(v));
      is_used[corners.back()] = true;
      are_finite = are_finite && is_finite[corners.back()];
    }
    if (!exist) report_.invalid_faces.add("face", number);
    else if (corners.size() < 3) report_.small_faces.add("face", number);
    else if (repeats(corners)) take_parts(corners, number, are_finite, triangulate);
    else if (are_finite) take_triangles(corners, number, triangulate);
  }

  static bool is_finite_point(const Point& p)
  {
    return std::isfinite(CGAL::to_double(p.x())) && std::isfinite(CGAL::to_double(p.y())) &&
           std::isfinite(CGAL::to_double(p.z()));
  }

  static bool repeats(const std::vector<std::uint32_t>& corners)
  {
    if (corners.size() == 3) return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    return std::set<std::uint32_t>(corners.begin(), corners.end()).size() < corners.size();
  }

  void take_parts(const std::vector<std::uint32_t>& corners, std::size_t number, bool are_finite,
                  Polygon_triangulator<Point>& triangulate)
  {
    report_.repeating_faces.add("face", number);
    if (!are_finite) return;
    for (const auto& part : parts_of(corners)) take_triangles(part, number, triangulate);
  }

  void take_triangles(const std::vector<std::uint32_t>& corners, std::size_t number,
                      Polygon_triangulator<Point>& triangulate)
  {
    if (corners.size() == 3) return add_triangle({corners[0], corners[1], corners[2]}, number);
    report_.polygons.add("face", number);
    for (const auto& t : triangulate(corners)) add_triangle(t, number);
  }

  void add_triangle(const std::array<std::uint32_t, 3>& triangle, std::size_t polygon)
  {
    triangles_.push_back(triangle);
    polygon_.push_back(std::uint32_t(polygon));
  }

  /// Points without a triangle may not be finite, and would be in the way.
  void remove_unused()
  {
    std::vector<std::uint32_t> origin = remove_unused_points(points_, triangles_);
    for (std::uint32_t& i : origin) i = origin_[i];
    origin_ = std::move(origin);
  }

  /// The triangles as a view, if they are an oriented manifold as they are and no two have the same corners: most files
  /// are like that, and CGAL's functions take long to find nothing to do.
  std::optional<Mesh_view> view_of_surface() const
  {
    std::optional<Mesh_view> view(std::in_place);
    const std::size_t n = triangles_.size();
    if (n > max_number_of_faces) return std::nullopt;
    view->corner.resize(3 * n);
    for (std::size_t f = 0; f < n; ++f) // the first corner is the last one, as it is in CGAL's functions for soups
      for (std::size_t i = 0; i < 3; ++i) view->corner[3 * f + (i + 1) % 3] = triangles_[f][i];
    if (!join_triangles(*view, points_.size(), [] {}) || !is_manifold(*view)) view.reset();
    return view;
  }

  /// Whether each vertex has one fan of faces, and no face a copy that looks the other way.
  static bool is_manifold(const Mesh_view& view)
  {
    std::size_t corners = 0;
    for (Index v = 0; v < view.number_of_vertices(); ++v) view.for_each_outgoing(v, [&](Index) { ++corners; });
    bool has_copies = false;
    for (Index h = 0; h < view.number_of_halfedges() && !has_copies; h += 3)
      has_copies = !view.is_border(h) && view.apex(h) == view.apex(view.twin[h]);
    return corners == view.number_of_halfedges() && !has_copies;
  }

  /// Keeps the first of the triangles with the same corners.
  void remove_duplicate_faces()
  {
    using Key = std::pair<std::array<std::uint32_t, 3>, std::uint32_t>;
    std::vector<Key> keys;
    keys.reserve(triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      keys.emplace_back(triangles_[i], i);
      std::sort(keys.back().first.begin(), keys.back().first.end());
    }
    std::sort(keys.begin(), keys.end());
    std::vector<bool> is_duplicate(triangles_.size(), false);
    for (std::size_t i = 1; i < keys.size(); ++i)
      if (keys[i].first == keys[i - 1].first) is_duplicate[keys[i].second] = true;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (is_duplicate[i]) report_.duplicate_faces.add("face", polygon_[i]);
      else {
        triangles_[kept] = triangles_[i];
        polygon_[kept++] = polygon_[i];
      }
    }
    triangles_.resize(kept);
    polygon_.resize(kept);
  }

  /// Keeps account of what CGAL cuts and turns.
  class Orientation_visitor : public CGAL::Polygon_mesh_processing::Default_orientation_visitor
  {
  public:
    explicit Orientation_visitor(Soup_repair& soup) : soup_(&soup) {}

    void non_manifold_edge(std::size_t v, std::size_t w, std::size_t) { soup_->add_non_manifold_edge(v, w); }
    void duplicated_vertex(std::size_t v, std::size_t) { soup_->original_.push_back(std::uint32_t(v)); }
    void polygon_orientation_reversed(std::size_t i) { soup_->is_turned_[i].flip(); }

  private:
    Soup_repair* soup_; // visitors are copied
  };

  /// Makes the triangles an oriented manifold: copies of points are added where it has to be cut.
  void orient_and_cut()
  {
    is_turned_.assign(triangles_.size(), false);
    CGAL::Polygon_mesh_processing::orient_polygon_soup(points_, triangles_,
                                                       CGAL::parameters::visitor(Orientation_visitor(*this)));
    for (std::size_t i = origin_.size(); i < points_.size(); ++i) origin_.push_back(origin_[original_[i]]);
  }

  /// CGAL finds an edge once for each of its faces.
  void add_non_manifold_edge(std::size_t v, std::size_t w)
  {
    if (non_manifold_edges_.insert({(std::min)(v, w), (std::max)(v, w)}).second)
      report_.non_manifold_edges.add_edge(origin_[v], origin_[w]);
  }

  /// Joins points along seams, copies at least: where an edge has more than two faces, surfaces that have two of them
  /// are whole again.
  void join(bool weld)
  {
    Seam_finder seams(weld && may_have_seams() ? places_of(points_) : original_, triangles_);
    if (seams.found_any()) view_.reset();
    Disjoint_sets sets = seams.joined_points();
    for (std::size_t i = 0; i < triangles_.size() && seams.found_any(); ++i) {
      if (seams.is_turned(triangles_[i][0])) turn(i);
      for (std::uint32_t& v : triangles_[i]) v = sets.find(v);
    }
    report_joined_points(sets);
    seams.for_each_open_seam([&](std::uint32_t v, std::uint32_t w) {
      if (weld) report_.open_seams.add_edge(origin_[v], origin_[w]);
    });
  }

  /// A closed surface has none.
  bool may_have_seams() const
  {
    return !view_ || std::find(view_->twin.begin(), view_->twin.end(), no_index) != view_->twin.end();
  }

  void report_joined_points(Disjoint_sets& sets)
  {
    std::set<std::uint32_t> cut;
    for (const auto& e : non_manifold_edges_) cut.insert({std::uint32_t(e[0]), std::uint32_t(e[1])});
    for (std::uint32_t v = 0; v < points_.size(); ++v)
      if (original_[v] == v && sets.find(v) != v) report_.welded_points.add("vertex", origin_[v]);
      else if (sets.find(v) != sets.find(original_[v]) && cut.insert(original_[v]).second)
        report_.non_manifold_vertices.add("vertex", origin_[v]);
  }

  void turn(std::size_t triangle)
  {
    std::swap(triangles_[triangle][1], triangles_[triangle][2]);
    is_turned_[triangle].flip();
  }

  template <class TriangleMesh>
  void convert(TriangleMesh& mesh)
  {
    if (!view_) return CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points_, triangles_, mesh);
    write_connectivity(Sequential_execution(), *view_, mesh);
    const auto point = get(CGAL::vertex_point, mesh);
    std::size_t i = 0;
    for (const auto v : vertices(mesh)) put(point, v, points_[i++]);
    view_.reset();
  }

  template <class TriangleMesh>
  void orient_components(TriangleMesh& mesh)
  {
    Component_orienter<TriangleMesh> orienter(mesh, is_turned_);
    orienter.orient([&](std::size_t i) { turn(i); });
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      if (is_turned_[i] && (i == 0 || !is_turned_[i - 1] || polygon_[i] != polygon_[i - 1]))
        report_.turned_faces.add("face", polygon_[i]);
    if (report_.turned_faces.count > 0)
      report_.turned_components =
        orienter.number_of_components_that_have([&](std::size_t i) { return is_turned_[i]; });
  }

  void number_elements()
  {
    report_.polygon_of_face.assign(polygon_.begin(), polygon_.end());
    report_.point_of_vertex.assign(origin_.begin(), origin_.end());
  }

  template <class TriangleMesh>
  void find_degenerate_faces(const TriangleMesh& mesh)
  {
    std::size_t i = 0;
    for (const auto f : faces(mesh)) {
      if (CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh))
        report_.degenerate_faces.add("face", polygon_[i]);
      ++i;
    }
  }

  /// Leaves the mesh as it was if CGAL does not get through.
  template <class TriangleMesh>
  void remove_degenerate_faces(TriangleMesh& mesh)
  {
    const Kept_numbers<TriangleMesh> numbers(mesh);
    if (report_.degenerate_faces.count == num_faces(mesh)) clear_elements(mesh);
    else if (!removes_degenerate_faces(mesh)) {
      clear_elements(mesh);
      return convert(mesh);
    }
    numbers.renumber(mesh, report_, points_);
    report_.removed_degenerate_faces = report_.degenerate_faces.count - number_of_degenerate_faces(mesh);
  }

  std::vector<Point> points_;
  std::vector<std::uint32_t> origin_;       // the index in the input of each point
  std::vector<std::uint32_t> original_;     // of which each point is a copy, or the point itself
  Triangle_soup triangles_;
  std::vector<std::uint32_t> polygon_;      // of which each triangle is a part
  std::vector<bool> is_turned_;             // by triangle: looks the other way in the input
  std::set<std::array<std::size_t, 2>> non_manifold_edges_;
  std::optional<Mesh_view> view_;           // of the triangles, if they are a surface as they are
  Repair_report report_;
};

} // namespace internal

/// Makes a valid triangle mesh of any polygons given by the indices of their corners in `points`, by the tools of
/// Polygon Mesh Processing. The result is an oriented 2-manifold, closed or with boundary, that `adapt_surface_mesh()`
/// accepts. Closed components look outwards, cavities inwards, open components as most of their area did.
///
/// What was done is counted in the report, which also says where each vertex and face comes from.
///
/// \param points, polygons, options what is given, and what may be done with it
/// \tparam Polygons a range of ranges of integers
/// \param mesh an empty model of `MutableFaceGraph`
/// \throws Empty_mesh_error if nothing is left, Mesh_too_large_error
/// \par Complexity
/// O(n log n) for an input with few faces at each edge and vertex
template <class Point, class Polygons, class TriangleMesh>
Repair_report repair_polygon_soup_to_triangle_mesh(std::vector<Point> points, const Polygons& polygons,
                                                   TriangleMesh& mesh, const Repair_options& options = Repair_options())
{
  Repair_report report = internal::Soup_repair<Point>(std::move(points), polygons).build(mesh, options);
  if (num_faces(mesh) == 0) throw Empty_mesh_error();
  return report;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_REPAIR_H

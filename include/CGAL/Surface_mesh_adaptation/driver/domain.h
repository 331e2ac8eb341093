// SPDX-License-Identifier: GPL-3.0-or-later
//
// What of the user's mesh is adapted: all of it, or a range of its faces. Each domain reads it into a mesh view and
// writes the result back; `Written_mesh` says which elements of the mesh those of the view have become.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_DOMAIN_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_DOMAIN_H

#include <CGAL/Surface_mesh_adaptation/distance/Surroundings.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_range.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/mesh/replace_faces.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Calls `use()`; an error at a vertex is reported with the place of that vertex in `graph`, not with its number after the
/// renumbering of the import.
template <class FaceGraph, class Use>
void with_input_numbers(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported, const Use& use)
{
  const auto place = [&](const Invalid_input_error& e) {
    return place_in(vertices(graph), imported.vertices[e.index()]);
  };
  try {
    use();
  } catch (const Invalid_metric_error& e) {
    throw Invalid_metric_error(place(e));
  } catch (const Invalid_field_error& e) {
    throw Invalid_field_error(place(e));
  } catch (const Invalid_normal_error& e) {
    throw Invalid_normal_error(place(e));
  }
}

/// The whole of a mesh.
template <class FaceGraph>
class Whole_mesh
{
public:
  using Graph = FaceGraph;
  static constexpr bool is_part = false;

  explicit Whole_mesh(FaceGraph& graph) : graph_(graph) {}

  FaceGraph& graph() const { return graph_; }

  template <class Execution, class VertexPointMap>
  Imported_mesh<FaceGraph> import(const Execution& execution, const VertexPointMap& points) const
  {
    return import_face_graph(execution, graph_, points);
  }

  /// \throws Non_manifold_vertex_error, Non_simplicial_edge_error
  template <class Execution>
  void check_fans(const Execution& execution, const Imported_mesh<FaceGraph>& imported, const Renumbering& numbers) const
  {
    internal::check_fans(execution, imported.mesh, [&](Index v) { return numbers.vertex(v); });
  }

  bool is_inside(const Imported_mesh<FaceGraph>&, Index) const { return true; }

  /// What is around the domain; the predicate says which faces of an adapted mesh are inside of it.
  template <class VertexPointMap, class IsInside>
  Surroundings surroundings(const VertexPointMap&, const IsInside&) const
  {
    return {};
  }

  template <class Execution, class Surface, class VertexPointMap, class IsInside>
  void write(const Execution& execution, const Imported_mesh<FaceGraph>&, const Surface& surface,
             const VertexPointMap& points, const IsInside&)
  {
    write_connectivity(execution, surface.mesh, graph_);
    write_points(execution, surface.points, graph_, points);
  }

  /// Whether no face that stays is at the edge of the halfedge `h` of the view.
  bool owns_edge(Index) const { return true; }

  /// Calls `f(i, v)` for the vertex `v` of the graph that vertex `i` of the view has become.
  template <class F>
  void for_each_vertex(const F& f) const
  {
    Index i = 0;
    for (const auto v : vertices(graph_)) f(i++, v);
  }

  /// The same for faces.
  template <class F>
  void for_each_face(const F& f) const
  {
    Index i = 0;
    for (const auto face : faces(graph_)) f(i++, face);
  }

private:
  FaceGraph& graph_;
};

/// A range of the faces of a mesh. The view has two rings of faces around them, too, for normals; these stay.
template <class FaceGraph>
class Part_of_mesh
{
public:
  using Graph = FaceGraph;
  static constexpr bool is_part = true;

  template <class FaceRange>
  Part_of_mesh(const FaceRange& range, FaceGraph& graph) : graph_(graph), range_(range, graph)
  {}

  FaceGraph& graph() const { return graph_; }

  template <class Execution, class VertexPointMap>
  Imported_mesh<FaceGraph> import(const Execution&, const VertexPointMap& points) const
  {
    return import_face_range(graph_, range_, points);
  }

  /// \throws Non_simplicial_edge_error
  template <class Execution>
  void check_fans(const Execution& execution, const Imported_mesh<FaceGraph>& imported, const Renumbering&) const
  {
    try {
      internal::check_fans(execution, imported.mesh, [](Index v) { return v; });
    } catch (const Non_simplicial_edge_error& e) {
      throw Non_simplicial_edge_error(place_in(vertices(graph_), imported.vertices[e.index()]));
    }
  }

  bool is_inside(const Imported_mesh<FaceGraph>& imported, Index f) const
  {
    return range_.is_inside(face(imported.halfedges[3 * std::size_t(f)], graph_));
  }

  template <class VertexPointMap, class IsInside>
  Surroundings surroundings(const VertexPointMap& points, const IsInside& is_inside) const
  {
    return {[this, points](const Vector_3& low, const Vector_3& high) { return triangles_around(points, low, high); },
            is_inside};
  }

  template <class Execution, class Surface, class VertexPointMap, class IsInside>
  void write(const Execution&, const Imported_mesh<FaceGraph>& imported, const Surface& surface,
             const VertexPointMap& points, const IsInside& is_inside)
  {
    const Mesh_view& mesh = surface.mesh;
    owns_edge_.resize(mesh.number_of_halfedges());
    for (Index h = 0; h < owns_edge_.size(); ++h)
      owns_edge_[h] = mesh.is_border(h) || is_inside(Mesh_view::face(mesh.twin[h]));
    const auto origin = [&](Index v) { return surface.origin[v]; };
    Face_replacement<FaceGraph, IsInside, decltype(origin)> replacement(graph_, mesh, is_inside, origin);
    replacement.run(range_, imported);
    vertices_ = std::move(replacement.vertices);
    faces_ = std::move(replacement.faces);
    using Point = typename boost::property_traits<VertexPointMap>::value_type;
    for_each_vertex([&](Index i, const auto& v) {
      put(points, v, Point(surface.points[i][0], surface.points[i][1], surface.points[i][2]));
    });
  }

  bool owns_edge(Index h) const { return owns_edge_[h] != 0; }

  /// Those of the range that are not on its border.
  template <class F>
  void for_each_vertex(const F& f) const
  {
    for (const auto& [i, v] : vertices_) f(i, v);
  }

  template <class F>
  void for_each_face(const F& f) const
  {
    for (const auto& [i, face] : faces_) f(i, face);
  }

private:
  /// The faces beyond those of the view that reach into a box; such a face need not be a triangle: a fan of them.
  template <class VertexPointMap>
  std::vector<Triangle_points> triangles_around(const VertexPointMap& points, const Vector_3& low,
                                                const Vector_3& high) const
  {
    std::vector<Triangle_points> triangles;
    std::vector<Vector_3> corners;
    for (const auto f : faces(graph_)) {
      if (range_.number(f) != no_index) continue;
      corners.clear();
      for (const auto v : CGAL::vertices_around_face(halfedge(f, graph_), graph_)) {
        const auto& p = get(points, v);
        corners.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
      }
      for (std::size_t i = 2; i < corners.size(); ++i) {
        const Triangle_points t = {corners[0], corners[i - 1], corners[i]};
        if ((t[0].cwiseMin(t[1]).cwiseMin(t[2]).array() <= high.array()).all() &&
            (t[0].cwiseMax(t[1]).cwiseMax(t[2]).array() >= low.array()).all())
          triangles.push_back(t);
      }
    }
    return triangles;
  }

  FaceGraph& graph_;
  Face_range<FaceGraph> range_;
  std::vector<std::uint8_t> owns_edge_;
  std::vector<std::pair<Index, typename boost::graph_traits<FaceGraph>::vertex_descriptor>> vertices_;
  std::vector<std::pair<Index, typename boost::graph_traits<FaceGraph>::face_descriptor>> faces_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_DOMAIN_H

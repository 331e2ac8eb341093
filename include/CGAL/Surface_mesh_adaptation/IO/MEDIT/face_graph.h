// SPDX-License-Identifier: GPL-3.0-or-later
//
// The face graph of a mesh of MEDIT, and the other way round.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_FACE_GRAPH_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_FACE_GRAPH_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_mesh.h>
#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFiles
/// @{

/// Builds the empty face graph `mesh` from the triangles of `medit`: oriented consistently, without the points that
/// no triangle uses. Ridges and required edges are marked in `edge_is_constrained`, corners and required vertices in
/// `vertex_is_constrained`; the other values of both maps are not touched.
///
/// Returns the vertex of each point, or `null_vertex()` for a point that no triangle uses.
/// \throws Invalid_input_error if the triangles are not an orientable 2-manifold, if a mark is not on it, or if there
///         are quadrilaterals
template <class TriangleMesh, class EdgeIsConstrainedMap, class VertexIsConstrainedMap>
auto medit_to_triangle_mesh(const Medit_mesh& medit, TriangleMesh& mesh, EdgeIsConstrainedMap edge_is_constrained,
                            VertexIsConstrainedMap vertex_is_constrained)
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Point =
    typename boost::property_traits<typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::type>::value_type;
  if (!medit.quadrilaterals.empty()) throw Non_triangular_face_error(medit.triangles.size());
  std::vector<Point> points;
  points.reserve(medit.points.size());
  for (const auto& p : medit.points) points.emplace_back(p[0], p[1], p[2]);
  auto vertex_of_point = triangle_soup_to_triangle_mesh(std::move(points), medit.triangles, mesh);

  const auto mark_edges = [&](const Medit_mesh::Indices& edges) {
    for (const std::uint32_t e : edges) {
      const auto source = vertex_of_point[medit.edges[e][0]];
      const auto target = vertex_of_point[medit.edges[e][1]];
      const bool on_surface = source != Graph_traits::null_vertex() && target != Graph_traits::null_vertex();
      const auto found =
        on_surface ? halfedge(source, target, mesh) : std::make_pair(Graph_traits::null_halfedge(), false);
      if (!found.second) throw Invalid_input_error("a constrained edge is not an edge of a triangle", "edge", e);
      put(edge_is_constrained, edge(found.first, mesh), true);
    }
  };
  mark_edges(medit.ridges);
  mark_edges(medit.required_edges);

  const auto mark_vertices = [&](const Medit_mesh::Indices& vertices) {
    for (const std::uint32_t v : vertices) {
      if (vertex_of_point[v] == Graph_traits::null_vertex())
        throw Invalid_input_error("a constrained vertex is not a vertex of a triangle", "vertex", v);
      put(vertex_is_constrained, vertex_of_point[v], true);
    }
  };
  mark_vertices(medit.corners);
  mark_vertices(medit.required_vertices);
  return vertex_of_point;
}

/// The vertices and faces of `mesh` in their order, its constrained edges as ridges, its constrained vertices as
/// corners; all references are 0.
template <class TriangleMesh, class EdgeIsConstrainedMap, class VertexIsConstrainedMap>
Medit_mesh triangle_mesh_to_medit(const TriangleMesh& mesh, EdgeIsConstrainedMap edge_is_constrained,
                                  VertexIsConstrainedMap vertex_is_constrained)
{
  Medit_mesh medit;
  const auto point = get(CGAL::vertex_point, mesh);
  const auto index = get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh);
  for (const auto v : vertices(mesh)) {
    const auto i = std::uint32_t(medit.points.size());
    put(index, v, i);
    const auto& p = get(point, v);
    medit.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    if (get(vertex_is_constrained, v)) medit.corners.push_back(i);
  }
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh); // target first, as in CGAL's files
    medit.triangles.push_back(
      {get(index, target(h, mesh)), get(index, target(next(h, mesh), mesh)), get(index, source(h, mesh))});
  }
  for (const auto e : edges(mesh))
    if (get(edge_is_constrained, e)) {
      medit.ridges.push_back(std::uint32_t(medit.edges.size()));
      medit.edges.push_back({get(index, source(e, mesh)), get(index, target(e, mesh))});
    }
  medit.point_references.assign(medit.points.size(), 0);
  medit.triangle_references.assign(medit.triangles.size(), 0);
  medit.edge_references.assign(medit.edges.size(), 0);
  return medit;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_FACE_GRAPH_H

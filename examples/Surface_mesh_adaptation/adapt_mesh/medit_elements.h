// SPDX-License-Identifier: GPL-3.0-or-later
//
// References and required elements, from a MEDIT file to the mesh and back.

#ifndef ADAPT_MESH_MEDIT_ELEMENTS_H
#define ADAPT_MESH_MEDIT_ELEMENTS_H

#include "Medit_content.h"
#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_mesh.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/IO/Repair_report.h>

#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace adapt_mesh {

/// Reads what `medit` says of the elements of `result`, which was made of it. Protects the edges of required triangles.
/// Edges with a reference are constrained. \param place the number of the place of each point of `medit`
inline void put_content(const SMA::Medit_mesh& medit, const std::vector<std::uint32_t>& place,
                        const SMA::Repair_report& report, Constrained_mesh& result)
{
  Mesh& mesh = result.mesh;
  result.medit = std::make_unique<Medit_content>(mesh);
  Medit_content& content = *result.medit;
  std::vector<bool> is_corner(medit.points.size(), false), is_required(medit.triangles.size(), false);
  for (const std::uint32_t v : medit.corners) is_corner[place[v]] = true;
  for (const std::uint32_t t : medit.required_triangles) is_required[t] = true;
  std::vector<Vertex> vertex_of_place(medit.points.size(), Mesh::null_vertex());
  for (const Vertex v : mesh.vertices()) {
    const std::size_t p = report.point_of_vertex[v];
    vertex_of_place[place[p]] = v;
    content.reference[v] = medit.point_references[p];
    content.is_corner[v] = is_corner[place[p]];
    content.number[v] = unsigned(v) + 1;
  }
  content.has_required_triangles = !medit.required_triangles.empty();
  for (const Face f : mesh.faces()) {
    const std::size_t t = report.polygon_of_face[f];
    if (t >= is_required.size() || !is_required[t]) continue;
    content.is_required[f] = 1;
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) result.edge_is_protected[mesh.edge(h)] = true;
  }
  const auto ends = [&](std::uint32_t e) {
    return std::array<Vertex, 2>{vertex_of_place[place[medit.edges[e][0]]], vertex_of_place[place[medit.edges[e][1]]]};
  };
  for (std::uint32_t e = 0; e < medit.edges.size(); ++e) {
    const auto [a, b] = ends(e);
    if (medit.edge_references[e] == 0 || a == Mesh::null_vertex() || b == Mesh::null_vertex()) continue;
    const Halfedge h = mesh.halfedge(a, b);
    if (h == Mesh::null_halfedge()) continue;
    result.edge_is_constrained[mesh.edge(h)] = true;
    content.referenced_edges.push_back({mesh.point(a), mesh.point(b)});
    content.edge_references.push_back(medit.edge_references[e]);
  }
  for (const std::uint32_t e : medit.required_edges) {
    const auto [a, b] = ends(e);
    if (a == Mesh::null_vertex() || b == Mesh::null_vertex()) continue;
    const auto numbers = std::minmax(content.number[a], content.number[b]);
    content.required_edges[{numbers.first, numbers.second}] = medit.edge_references[e];
  }
}

/// The reference of the edge of the input nearest to the middle of `e`; 0 if none is near.
inline int reference_of_edge(const Medit_content& content, const Mesh& mesh, Edge e)
{
  constexpr double near = 0.2; // of the length of `e`: it is a chord of the curve
  const Point& a = mesh.point(mesh.vertex(e, 0));
  const Point& b = mesh.point(mesh.vertex(e, 1));
  const Point middle = CGAL::midpoint(a, b);
  double least = near * near * CGAL::squared_distance(a, b);
  int reference = 0;
  for (std::size_t i = 0; i < content.referenced_edges.size(); ++i) {
    const auto& [p, q] = content.referenced_edges[i];
    const double d = p == q ? CGAL::squared_distance(middle, p)
                            : CGAL::squared_distance(middle, CGAL::Segment_3<CGAL::Kernel_traits<Point>::Kernel>(p, q));
    if (d >= least) continue;
    least = d;
    reference = content.edge_references[i];
  }
  return reference;
}

/// The mesh as MEDIT files know it.
inline SMA::Medit_mesh medit_mesh(const Constrained_mesh& m)
{
  SMA::Medit_mesh medit = SMA::triangle_mesh_to_medit(m.mesh, m.edge_is_constrained, m.vertex_is_constrained);
  for (const Face f : m.mesh.faces()) medit.triangle_references[f] = m.label[f] + (m.names.empty() ? 0 : 1);
  if (m.medit == nullptr) return medit;
  const Medit_content& content = *m.medit;
  medit.corners.clear();
  for (const Vertex v : m.mesh.vertices()) {
    medit.point_references[v] = content.reference[v];
    if (m.vertex_is_constrained[v]) (content.is_corner[v] ? medit.corners : medit.required_vertices).push_back(v);
  }
  for (const Face f : m.mesh.faces())
    if (content.is_required[f] > 0.5) medit.required_triangles.push_back(f);
  std::size_t i = 0;
  for (const Edge e : m.mesh.edges()) {
    const auto numbers = std::minmax(content.number[m.mesh.vertex(e, 0)], content.number[m.mesh.vertex(e, 1)]);
    const auto required = content.required_edges.find({numbers.first, numbers.second});
    const bool is_required = m.edge_is_protected[e] && numbers.first > 0 && required != content.required_edges.end();
    if (m.edge_is_constrained[e]) medit.edge_references[i++] = reference_of_edge(content, m.mesh, e);
    if (!is_required) continue;
    if (!m.edge_is_constrained[e]) {
      medit.edges.push_back({m.mesh.vertex(e, 0), m.mesh.vertex(e, 1)});
      medit.edge_references.push_back(required->second);
    } else medit.edge_references[i - 1] = required->second;
    medit.required_edges.push_back(std::uint32_t(m.edge_is_constrained[e] ? i - 1 : medit.edges.size() - 1));
  }
  return medit;
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_MEDIT_ELEMENTS_H

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

/// Reads what a MEDIT file says of the elements of the mesh that was made of it.
class Medit_elements
{
public:
  /// \param place the number of the place of each point of `medit`
  Medit_elements(const SMA::Medit_mesh& medit, const std::vector<std::uint32_t>& place, const SMA::Repair_report& report,
                 Constrained_mesh& result)
    : medit_(medit), place_(place), report_(report), result_(result), mesh_(result.mesh)
    , vertex_of_place_(medit.points.size(), Mesh::null_vertex())
  {}

  void put()
  {
    result_.medit = std::make_unique<Medit_content>(mesh_);
    put_on_vertices(*result_.medit);
    put_on_faces(*result_.medit);
    for (std::uint32_t e = 0; e < medit_.edges.size(); ++e) put_reference(e, *result_.medit);
    for (const std::uint32_t e : medit_.required_edges) put_required(e, *result_.medit);
  }

private:
  void put_on_vertices(Medit_content& content)
  {
    std::vector<bool> is_corner(medit_.points.size(), false);
    for (const std::uint32_t v : medit_.corners) is_corner[place_[v]] = true;
    for (const Vertex v : mesh_.vertices()) {
      const std::size_t p = report_.point_of_vertex[v];
      vertex_of_place_[place_[p]] = v;
      content.reference[v] = medit_.point_references[p];
      content.is_corner[v] = is_corner[place_[p]];
      content.number[v] = unsigned(v) + 1;
    }
  }

  /// Protects the edges of required triangles.
  void put_on_faces(Medit_content& content)
  {
    std::vector<bool> is_required(medit_.triangles.size(), false);
    for (const std::uint32_t t : medit_.required_triangles) is_required[t] = true;
    content.has_required_triangles = !medit_.required_triangles.empty();
    for (const Face f : mesh_.faces()) {
      const std::size_t t = report_.polygon_of_face[f];
      if (t >= is_required.size() || !is_required[t]) continue;
      content.is_required[f] = 1;
      for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
        result_.edge_is_protected[mesh_.edge(h)] = true;
    }
  }

  std::array<Vertex, 2> ends(std::uint32_t e) const
  {
    return {vertex_of_place_[place_[medit_.edges[e][0]]], vertex_of_place_[place_[medit_.edges[e][1]]]};
  }

  /// Constrains the edge if it has a reference, and remembers that with its place.
  void put_reference(std::uint32_t e, Medit_content& content)
  {
    const auto [a, b] = ends(e);
    if (medit_.edge_references[e] == 0 || a == Mesh::null_vertex() || b == Mesh::null_vertex()) return;
    const Halfedge h = mesh_.halfedge(a, b);
    if (h == Mesh::null_halfedge()) return;
    result_.edge_is_constrained[mesh_.edge(h)] = true;
    content.referenced_edges.push_back({mesh_.point(a), mesh_.point(b)});
    content.edge_references.push_back(medit_.edge_references[e]);
  }

  void put_required(std::uint32_t e, Medit_content& content) const
  {
    const auto [a, b] = ends(e);
    if (a == Mesh::null_vertex() || b == Mesh::null_vertex()) return;
    const auto numbers = std::minmax(content.number[a], content.number[b]);
    content.required_edges[{numbers.first, numbers.second}] = medit_.edge_references[e];
  }

  const SMA::Medit_mesh& medit_;
  const std::vector<std::uint32_t>& place_;
  const SMA::Repair_report& report_;
  Constrained_mesh& result_;
  Mesh& mesh_;
  std::vector<Vertex> vertex_of_place_;
};

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

/// Adds the edges that are required, and the references of all edges, to `medit`, which has those that are constrained.
inline void add_edges(const Constrained_mesh& m, const Medit_content& content, SMA::Medit_mesh& medit)
{
  std::uint32_t next = 0; // among those that are constrained
  for (const Edge e : m.mesh.edges()) {
    const bool is_known = m.edge_is_constrained[e];
    const std::uint32_t i = is_known ? next++ : std::uint32_t(medit.edges.size());
    if (is_known) medit.edge_references[i] = reference_of_edge(content, m.mesh, e);
    const auto numbers = std::minmax(content.number[m.mesh.vertex(e, 0)], content.number[m.mesh.vertex(e, 1)]);
    const auto required = content.required_edges.find({numbers.first, numbers.second});
    if (!m.edge_is_protected[e] || numbers.first == 0 || required == content.required_edges.end()) continue;
    if (!is_known) {
      medit.edges.push_back({m.mesh.vertex(e, 0), m.mesh.vertex(e, 1)});
      medit.edge_references.push_back(0);
    }
    medit.edge_references[i] = required->second;
    medit.required_edges.push_back(i);
  }
}

/// The mesh as MEDIT files know it.
inline SMA::Medit_mesh medit_mesh(const Constrained_mesh& m)
{
  SMA::Medit_mesh medit = SMA::triangle_mesh_to_medit(m.mesh, m.edge_is_constrained, m.vertex_is_constrained);
  for (const Face f : m.mesh.faces()) medit.triangle_references[f] = m.label[f] + (m.names.empty() ? 0 : 1);
  if (m.medit == nullptr) return medit;
  medit.corners.clear();
  for (const Vertex v : m.mesh.vertices()) {
    medit.point_references[v] = m.medit->reference[v];
    if (m.vertex_is_constrained[v]) (m.medit->is_corner[v] ? medit.corners : medit.required_vertices).push_back(v);
  }
  for (const Face f : m.mesh.faces())
    if (m.medit->is_required[f] > 0.5) medit.required_triangles.push_back(f);
  add_edges(m, *m.medit, medit);
  return medit;
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_MEDIT_ELEMENTS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ridges, corners and what else a MEDIT file marks, as constraints of the mesh that was made of it.

#ifndef ADAPT_MESH_MEDIT_MARKS_H
#define ADAPT_MESH_MEDIT_MARKS_H

#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_mesh.h>
#include <CGAL/Surface_mesh_adaptation/IO/Repair_report.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace adapt_mesh {

/// The marked edges and vertices of a file, named by places: points that a repair may have joined have one place, and
/// vertices that it has cut apart are found by the point that they come from.
class Medit_marks
{
public:
  /// \param place the number of the place of each point of `medit`
  Medit_marks(const SMA::Medit_mesh& medit, std::vector<std::uint32_t> place)
    : place_(std::move(place)), is_marked_(place_.size(), false), is_vertex_(place_.size(), false)
  {
    std::vector<bool> is_required(medit.edges.size(), false);
    for (const std::uint32_t e : medit.required_edges) is_required[e] = true;
    for (const auto* indices : {&medit.ridges, &medit.required_edges})
      for (const std::uint32_t e : *indices)
        edges_.push_back({key(medit.edges[e][0], medit.edges[e][1]), e, false, is_required[e]});
    std::sort(edges_.begin(), edges_.end(), [](const auto& e, const auto& f) { return e.ends < f.ends; });
    for (const auto* indices : {&medit.corners, &medit.required_vertices}) {
      vertices_.insert(vertices_.end(), indices->begin(), indices->end());
      for (const std::uint32_t v : *indices) is_marked_[place_[v]] = true;
    }
  }

  /// Marks the elements of the mesh. \param point_of_vertex the point of each vertex
  void put_on(Constrained_mesh& result, const std::vector<std::size_t>& point_of_vertex)
  {
    const auto& mesh = result.mesh;
    for (const Vertex v : mesh.vertices()) {
      is_vertex_[place_[point_of_vertex[v]]] = true;
      if (is_marked_[place_[point_of_vertex[v]]]) result.vertex_is_constrained[v] = true;
    }
    for (const Edge e : mesh.edges())
      if (const Marked_edge* marked =
            find_edge(key(point_of_vertex[mesh.vertex(e, 0)], point_of_vertex[mesh.vertex(e, 1)])))
        (marked->is_required ? result.edge_is_protected : result.edge_is_constrained)[e] = true;
  }

  /// Marked edges that are not on the mesh.
  SMA::Soup_defect stray_edges() const
  {
    SMA::Soup_defect defect;
    for (const Marked_edge& e : edges_)
      if (!e.is_found) defect.add("edge", e.index);
    return defect;
  }

  /// Marked vertices that are not on the mesh.
  SMA::Soup_defect stray_vertices() const
  {
    SMA::Soup_defect defect;
    for (const std::uint32_t v : vertices_)
      if (!is_vertex_[place_[v]]) defect.add("vertex", v);
    return defect;
  }

private:
  using Key = std::array<std::uint32_t, 2>;

  struct Marked_edge
  {
    Key ends; // their places
    std::uint32_t index;
    bool is_found;
    bool is_required;
  };

  Key key(std::size_t v, std::size_t w) const
  {
    return {(std::min)(place_[v], place_[w]), (std::max)(place_[v], place_[w])};
  }

  /// The mark of the edge; null if it has none.
  const Marked_edge* find_edge(const Key& ends)
  {
    const auto is_before = [](const Marked_edge& e, const Key& k) { return e.ends < k; };
    auto e = std::lower_bound(edges_.begin(), edges_.end(), ends, is_before);
    const Marked_edge* const marked = e != edges_.end() && e->ends == ends ? &*e : nullptr;
    for (; e != edges_.end() && e->ends == ends; ++e) e->is_found = true;
    return marked;
  }

  std::vector<std::uint32_t> place_;
  std::vector<Marked_edge> edges_;
  std::vector<std::uint32_t> vertices_;
  std::vector<bool> is_marked_; // by place
  std::vector<bool> is_vertex_; // by place: the mesh has a vertex there
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_MEDIT_MARKS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Replaces some faces of a face graph by those of a mesh view. All other faces stay, with their vertices and edges.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_REPLACE_FACES_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_REPLACE_FACES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_range.h>

#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// \tparam IsInside tells of a face of the view whether it replaces one; the others are near, and stay
/// \tparam OriginOf gives the vertex of the input that a vertex of the view was, or `no_index`
template <class FaceGraph, class IsInside, class OriginOf>
class Face_replacement
{
public:
  using Traits = boost::graph_traits<FaceGraph>;
  using Vertex = typename Traits::vertex_descriptor;
  using Halfedge = typename Traits::halfedge_descriptor;
  using Edge = typename Traits::edge_descriptor;
  using Face = typename Traits::face_descriptor;

  Face_replacement(FaceGraph& graph, const Mesh_view& view, const IsInside& is_inside, const OriginOf& origin)
    : graph_(graph), view_(view), is_inside_(is_inside), origin_(origin)
  {}

  /// Of the view and of the graph: the vertices of new faces that are at no other face, and the new faces.
  std::vector<std::pair<Index, Vertex>> vertices;
  std::vector<std::pair<Index, Face>> faces;

  /// Replaces the faces inside of `range`, which was read into `imported`.
  void run(const Face_range<FaceGraph>& range, const Imported_mesh<FaceGraph>& imported)
  {
    look_at_vertices(imported);
    find_halfedges_that_stay();
    remove_inside(range);
    add_vertices();
    add_edges();
    add_faces();
    close_boundary();
  }

private:
  enum Side : std::uint8_t { inside = 1, outside = 2 };

  bool is_inside(Index h) const { return is_inside_(Mesh_view::face(h)); }

  /// On which sides each vertex is, and what it was.
  void look_at_vertices(const Imported_mesh<FaceGraph>& imported)
  {
    sides_.assign(view_.number_of_vertices(), 0);
    vertex_.assign(view_.number_of_vertices(), Traits::null_vertex());
    for (Index h = 0; h < view_.number_of_halfedges(); ++h)
      sides_[view_.corner[h]] = std::uint8_t(sides_[view_.corner[h]] | (is_inside(h) ? inside : outside));
    for (Index v = 0; v < vertex_.size(); ++v)
      if (origin_(v) != no_index) vertex_[v] = imported.vertices[origin_(v)];
  }

  /// The halfedges of faces that stay, as far as new faces or the boundary beside these need them.
  void find_halfedges_that_stay()
  {
    halfedge_.assign(view_.number_of_halfedges(), Traits::null_halfedge());
    for (Index h = 0; h < halfedge_.size(); ++h) {
      if (is_inside(h) || !(view_.is_border(h) || is_inside(view_.twin[h]))) continue;
      halfedge_[h] = halfedge(vertex_[view_.source(h)], vertex_[view_.target(h)], graph_).first;
      if (!view_.is_border(h)) halfedge_[view_.twin[h]] = opposite(halfedge_[h], graph_);
    }
  }

  /// Removes the faces inside, the edges that are at no other face, and the vertices that are not needed any more.
  void remove_inside(const Face_range<FaceGraph>& range)
  {
    auto is_kept = get(CGAL::dynamic_vertex_property_t<std::uint8_t>(), graph_);
    for (Index v = 0; v < vertex_.size(); ++v)
      if (vertex_[v] != Traits::null_vertex()) put(is_kept, vertex_[v], std::uint8_t(1));
    std::vector<Edge> edges;
    std::vector<Vertex> unused;
    for (Index i = 0; i < range.number_inside(); ++i)
      for (const Halfedge h : CGAL::halfedges_around_face(halfedge(range.list()[i], graph_), graph_)) {
        const Halfedge o = opposite(h, graph_);
        const bool is_alone = is_border(o, graph_), is_shared = !is_alone && range.is_inside(face(o, graph_));
        if (is_alone || (is_shared && range.number(face(o, graph_)) > i)) edges.push_back(edge(h, graph_));
        if (get(is_kept, target(h, graph_)) != 0) continue;
        put(is_kept, target(h, graph_), std::uint8_t(1)); // to be removed once
        unused.push_back(target(h, graph_));
      }
    for (Index i = 0; i < range.number_inside(); ++i) remove_face(range.list()[i], graph_);
    for (const Edge e : edges) remove_edge(e, graph_);
    for (const Vertex v : unused) remove_vertex(v, graph_);
  }

  void add_vertices()
  {
    for (Index v = 0; v < vertex_.size(); ++v) {
      if (vertex_[v] == Traits::null_vertex()) vertex_[v] = add_vertex(graph_);
      if (sides_[v] == inside) vertices.emplace_back(v, vertex_[v]);
    }
  }

  void add_edges()
  {
    for (Index h = 0; h < halfedge_.size(); ++h) {
      if (!is_inside(h) || halfedge_[h] != Traits::null_halfedge()) continue;
      halfedge_[h] = halfedge(add_edge(graph_), graph_);
      const Halfedge o = opposite(halfedge_[h], graph_);
      set_target(halfedge_[h], vertex_[view_.target(h)], graph_);
      set_target(o, vertex_[view_.source(h)], graph_);
      if (view_.is_border(h)) set_face(o, Traits::null_face(), graph_);
      else halfedge_[view_.twin[h]] = o;
    }
  }

  void add_faces()
  {
    for (Index f = 0; f < view_.number_of_faces(); ++f) {
      if (!is_inside_(f)) continue;
      const Face face = add_face(graph_);
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        set_face(halfedge_[h], face, graph_);
        set_next(halfedge_[h], halfedge_[Mesh_view::next(h)], graph_);
        set_halfedge(vertex_[view_.target(h)], halfedge_[h], graph_);
      }
      set_halfedge(face, halfedge_[3 * std::size_t(f)], graph_);
      faces.emplace_back(f, face);
    }
  }

  /// Links the boundary through the vertices that new faces share with it.
  void close_boundary()
  {
    for (Index h = 0; h < halfedge_.size(); ++h) {
      if (!view_.is_border(h) || (sides_[view_.source(h)] & inside) == 0) continue;
      const Halfedge leaving = opposite(halfedge_[last_of_fan(view_, h)], graph_), arriving = opposite(halfedge_[h], graph_);
      set_next(arriving, leaving, graph_);
      set_halfedge(vertex_[view_.source(h)], arriving, graph_);
    }
  }

  FaceGraph& graph_;
  const Mesh_view& view_;
  const IsInside& is_inside_;
  const OriginOf& origin_;
  std::vector<std::uint8_t> sides_;
  std::vector<Vertex> vertex_;
  std::vector<Halfedge> halfedge_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_REPLACE_FACES_H

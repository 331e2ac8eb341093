// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connectivity that the kernels work on: a triangulated surface as a table of corners.
//
// The halfedge `3f + i` leaves corner `i` of face `f` towards its corner `i + 1`; hence next, previous and face are
// arithmetic, and a halfedge costs two words: the vertex at its corner and its twin. Vertices, halfedges and faces
// are numbered densely; removed ones stay as marked holes until the next restructuring (restructure.h).
// Functions that write do so only to the elements named in their comment, so calls on disjoint neighbourhoods may
// run concurrently.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_MESH_VIEW_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_MESH_VIEW_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Ring.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// Number of a vertex, halfedge or face.
using Index = std::uint32_t;
/// None.
constexpr Index no_index = ~Index(0);

/// Most faces that can be numbered: their halfedges, three for each, by 31 bits.
constexpr std::size_t max_number_of_faces = std::numeric_limits<std::int32_t>::max() / 3;

/// Mark of a halfedge that lies on no feature curve.
constexpr Index no_curve = ~Index(0);

/// Mark of a halfedge that lies where curves have met that were too near to each other, in the result only.
constexpr Index merged_curve = no_curve - 1;

/// Kinds of feature curves, which are numbered kind by kind. Creases part smooth sectors, all others lie inside of them:
/// drawn ones on the surface, where that is, and borders of planes, which have a shape of their own as creases do. The edges
/// of those that are protected stay in one piece.
struct Curve_ranges
{
  Index first_protected = no_curve;    ///< those before are creases that may change
  Index first_smooth = no_curve;       ///< those before are creases
  Index end_of_protected = no_curve;   ///< those from `first_smooth` up to here are protected and drawn
  Index first_plane_border = no_curve; ///< those from `first_smooth` up to here are drawn

  /// Whether it parts smooth sectors.
  bool is_crease(Index curve) const { return curve < first_smooth; }
  /// Whether its edges stay in one piece.
  bool is_protected(Index curve) const { return curve >= first_protected && curve < end_of_protected; }
  /// Whether it is on the surface, where that is.
  bool is_drawn(Index curve) const { return curve >= first_smooth && curve < first_plane_border; }
};

/// A triangulated surface as a table of corners. The halfedge `3f + i` leaves corner `i` of face `f` towards its corner
/// `i + 1`. Removed elements stay as holes that are marked.
class Mesh_view
{
public:
  Buffer<Index> corner;    ///< vertex at each corner (source of each halfedge); `no_index` in removed faces
  Buffer<Index> twin;      ///< opposite halfedge, `no_index` on the boundary
  Buffer<Index> curve;     ///< feature curve of each halfedge, equal on both sides, or `no_curve`
  Curve_ranges curves;     ///< which of these are what
  Buffer<Index> label;     ///< of each face, the same on all faces that no feature parts; empty if there are none
  Buffer<Index> outgoing;  ///< a halfedge that leaves each vertex: on the boundary the one without twin;
                                ///< `no_index` for removed vertices

  std::size_t number_of_vertices() const { return outgoing.size(); }  ///< holes included
  std::size_t number_of_halfedges() const { return corner.size(); }  ///< holes included
  std::size_t number_of_faces() const { return corner.size() / 3; }  ///< holes included

  static Index face(Index h) { return h / 3; }  ///< of the halfedge `h`
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }  ///< in its face
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }  ///< in its face

  Index source(Index h) const { return corner[h]; }  ///< where `h` starts
  Index target(Index h) const { return corner[next(h)]; }  ///< where `h` ends
  /// The vertex across the halfedge in its face.
  Index apex(Index h) const { return corner[previous(h)]; }
  /// The end of the halfedge that is not `v`.
  Index other_end(Index h, Index v) const { return source(h) == v ? target(h) : source(h); }

  bool is_border(Index h) const { return twin[h] == no_index; }  ///< whether it has no twin
  bool is_feature(Index h) const { return curve[h] != no_curve; }  ///< whether it lies on a curve
  /// Whether `h` is a feature that parts smooth sectors.
  bool is_crease(Index h) const { return curves.is_crease(curve[h]); }
  /// Whether the edge of `h` stays in one piece.
  bool is_protected(Index h) const { return curves.is_protected(curve[h]); }
  /// Whether the edge of `h` is on a curve that has a shape of its own.
  bool is_shaped(Index h) const { return is_feature(h) && !curves.is_drawn(curve[h]); }
  bool has_labels() const { return !label.empty(); }  ///< of faces
  bool is_removed_vertex(Index v) const { return outgoing[v] == no_index; }  ///< whether it is a hole
  bool is_removed_face(Index f) const { return corner[3 * std::size_t(f)] == no_index; }  ///< whether it is a hole
  bool is_border_vertex(Index v) const { return is_border(outgoing[v]); }  ///< whether it is on the boundary

  /// Whether `h` speaks for its edge: the smaller of the two halfedges.
  bool is_edge_owner(Index h) const { return h < twin[h]; }
  Index edge_owner(Index h) const { return h < twin[h] ? h : twin[h]; }  ///< that of the edge of `h`

  /// The next halfedge that leaves the source of `h`, counterclockwise; `no_index` past the last of an open fan.
  Index rotated_ccw(Index h) const { return twin[previous(h)]; }
  /// The same, clockwise.
  Index rotated_cw(Index h) const { return twin[h] == no_index ? no_index : next(twin[h]); }

  /// Calls `f(h)` for the halfedges that leave `v`, counterclockwise, until it returns `false`.
  template <class F>
  void for_each_outgoing_while(Index v, const F& f) const
  {
    const Index first = outgoing[v];
    Index h = first;
    do {
      if (!f(h)) return;
      h = rotated_ccw(h);
    } while (h != first && h != no_index);
  }

  /// Calls `f(h)` for the halfedges that leave `v`, counterclockwise.
  template <class F>
  void for_each_outgoing(Index v, const F& f) const
  {
    for_each_outgoing_while(v, [&](Index h) { f(h); return true; });
  }

  /// Calls `f(w)` for the neighbours of `v`, counterclockwise.
  template <class F>
  void for_each_neighbor(Index v, const F& f) const
  {
    Index last = no_index;
    for_each_outgoing(v, [&](Index h) {
      f(target(h));
      last = h;
    });
    if (is_border(previous(last))) f(apex(last));
  }

  /// Number of edges at `v`.
  std::size_t degree(Index v) const
  {
    std::size_t n = 0;
    for_each_neighbor(v, [&](Index) { ++n; });
    return n;
  }

  /// The halfedge from `v` to `w`, or `no_index`; on the boundary only the one with a face exists.
  Index halfedge(Index v, Index w) const
  {
    Index found = no_index;
    for_each_outgoing_while(v, [&](Index h) {
      if (target(h) == w) found = h;
      return found == no_index;
    });
    return found;
  }

  /// A halfedge of the edge between `v` and `w`, or `no_index`.
  Index any_halfedge(Index v, Index w) const
  {
    const Index h = halfedge(v, w);
    return h != no_index ? h : halfedge(w, v);
  }

  /// Whether an edge joins them.
  bool are_adjacent(Index v, Index w) const { return halfedge(v, w) != no_index || halfedge(w, v) != no_index; }

  /// Sets the curve of the edge of `h` on both sides.
  void set_curve(Index h, Index c)
  {
    curve[h] = c;
    if (!is_border(h)) curve[twin[h]] = c;
  }

  /// Replaces the edge of `h` by the other diagonal of its two faces.
  /// Writes the two faces, the twins of their four outer edges and the `outgoing` of their four vertices.
  /// \pre the edge is not on the boundary, no feature, and the other diagonal is not an edge yet
  void flip(Index h)
  {
    // faces (p, q, b) and (q, p, a) become (a, b, p) and (b, a, q)
    const Index t = twin[h], hn = next(h), hp = previous(h), tn = next(t), tp = previous(t);
    const Index p = corner[h], q = corner[t], b = corner[hp], a = corner[tp];
    const Index twin_hn = twin[hn], twin_hp = twin[hp], twin_tn = twin[tn], twin_tp = twin[tp];
    const Index curve_hn = curve[hn], curve_hp = curve[hp], curve_tn = curve[tn], curve_tp = curve[tp];

    corner[h] = a; corner[hn] = b; corner[hp] = p;
    corner[t] = b; corner[tn] = a; corner[tp] = q;
    glue(hn, twin_hp, curve_hp);
    glue(hp, twin_tn, curve_tn);
    glue(tn, twin_tp, curve_tp);
    glue(tp, twin_hn, curve_hn);
    if (outgoing[p] == h || outgoing[p] == tn) outgoing[p] = hp;
    if (outgoing[q] == t || outgoing[q] == hn) outgoing[q] = tp;
    if (outgoing[b] == hp) outgoing[b] = hn;
    if (outgoing[a] == tp) outgoing[a] = tn;
  }

  /// Puts the vertex `m` on the edge of `h`, from `p` to `x` between `a` on the right and `b` on the left: its two faces keep
  /// `x`, and the faces `f`, which is `(p, a, m)`, and `g`, which is `(p, m, b)`, are new.
  /// Writes these four, the twins of the two edges at `p`, and the `outgoing` of `p` and `m`.
  /// \pre the edge is no feature, `p` is not on the boundary, and `m`, `f` and `g` are holes
  void split_edge(Index h, Index m, Index f, Index g)
  {
    const Index from = next(twin[h]), to = rotated_ccw(h), p = corner[h], a = target(from), b = apex(h);
    const Index behind_a = twin[from], arriving_b = twin[to], curve_a = curve[from], curve_b = curve[to];
    corner[h] = corner[from] = m;
    corner[3 * f] = p; corner[3 * f + 1] = a; corner[3 * f + 2] = m;
    corner[3 * g] = p; corner[3 * g + 1] = m; corner[3 * g + 2] = b;
    glue(3 * f, behind_a, curve_a);
    glue(3 * f + 1, from, no_curve);
    glue(3 * f + 2, 3 * g, no_curve);
    glue(3 * g + 1, arriving_b, no_curve);
    glue(3 * g + 2, to, curve_b);
    outgoing[p] = to;
    outgoing[m] = h;
    if (has_labels()) label[f] = label[g] = label[face(h)];
  }

  /// An edge with the direction in which it is to be collapsed. `h` is any halfedge of the edge; a boundary edge has
  /// only one, so the vertex that vanishes may be its source or its target.
  struct Directed_edge
  {
    Index h = no_index;  ///< of the edge
    bool source_vanishes = true;  ///< else its target
  };

  /// The end of `e` that goes.
  Index vanishing_vertex(const Directed_edge& e) const { return e.source_vanishes ? source(e.h) : target(e.h); }
  /// The end of `e` that stays.
  Index kept_vertex(const Directed_edge& e) const { return e.source_vanishes ? target(e.h) : source(e.h); }

  /// Merges the vanishing vertex of `e` into the kept one; that vertex and the faces of the edge become holes.
  /// Writes only the faces around the vanishing vertex and the `outgoing` of that vertex and of its neighbours.
  /// \pre `is_collapsible(e)`
  void collapse(const Directed_edge& e)
  {
    const Index s = vanishing_vertex(e), d = kept_vertex(e);
    const Index leaving = e.source_vanishes ? e.h : twin[e.h], arriving = e.source_vanishes ? twin[e.h] : e.h;
    for_each_outgoing(s, [&](Index o) { corner[o] = d; });
    outgoing[s] = no_index;
    Index out = no_index;
    if (leaving != no_index) out = remove_wedge(next(leaving), previous(leaving));
    if (arriving != no_index) out = remove_wedge(previous(arriving), next(arriving));
    outgoing[d] = first_of_fan(out);
  }

  /// Whether collapsing `e` keeps a simplicial 2-manifold with the same boundary cycles: the link condition, and no
  /// vertex left with too few faces.
  bool is_collapsible(const Directed_edge& e) const
  {
    const Index s = vanishing_vertex(e), d = kept_vertex(e), t = twin[e.h];
    const bool on_border = t == no_index;
    if (!on_border && is_border_vertex(s)) return false;
    if (!can_lose_an_edge(apex(e.h)) || (!on_border && !can_lose_an_edge(apex(t)))) return false;

    Ring<Index> around_d;
    for_each_neighbor(d, [&](Index x) { around_d.push_back(x); });
    std::size_t common = 0;
    for_each_neighbor(s, [&](Index x) {
      common += std::size_t(std::count(around_d.begin(), around_d.end(), x)); // `d` is not its own neighbour
    });
    return common == (on_border ? 1u : 2u);
  }

  /// The halfedge at which the walk around the source of `h` starts: `h` unless the source is on the boundary.
  Index first_of_fan(Index h) const
  {
    Index g = h;
    for (Index r = rotated_cw(g); r != no_index && r != h; r = rotated_cw(g)) g = r;
    return is_border(g) ? g : h;
  }

private:
  /// Makes `h` and `t` twins on the curve `c`; `t` may be `no_index`.
  void glue(Index h, Index t, Index c)
  {
    twin[h] = t;
    curve[h] = c;
    if (t != no_index) {
      twin[t] = h;
      curve[t] = c;
    }
  }

  /// Removes the face whose edges `kept` (at the surviving vertex) and `merged` (at the vanished one) coincide now,
  /// and glues what lies behind them. Returns a halfedge that leaves the surviving vertex.
  Index remove_wedge(Index kept, Index merged)
  {
    const Index behind_kept = twin[kept], behind_merged = twin[merged];
    const Index c = curve[kept] != no_curve ? curve[kept] : curve[merged];
    // the apex: source of the halfedge of the wedge that does not leave the surviving vertex
    const bool kept_leaves = next(kept) == merged;
    const Index apex_out = kept_leaves ? merged : kept;
    const Index apex_vertex = corner[apex_out];
    const Index toward_survivor = kept_leaves ? behind_kept : behind_merged; // leaves the apex
    const Index from_survivor = kept_leaves ? behind_merged : behind_kept;   // arrives at the apex
    if (outgoing[apex_vertex] == apex_out) outgoing[apex_vertex] = toward_survivor;

    if (behind_kept != no_index) glue(behind_kept, behind_merged, c);
    else if (behind_merged != no_index) glue(behind_merged, no_index, c);

    const std::size_t f = face(kept);
    corner[3 * f] = corner[3 * f + 1] = corner[3 * f + 2] = no_index;
    return from_survivor != no_index ? from_survivor : next(toward_survivor);
  }

  /// Whether `v` keeps a fan of at least three (at a boundary, one) faces when a face between two of its edges goes.
  bool can_lose_an_edge(Index v) const { return degree(v) > (is_border_vertex(v) ? 2u : 3u); }
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_MESH_VIEW_H

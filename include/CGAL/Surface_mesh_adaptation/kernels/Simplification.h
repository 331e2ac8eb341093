// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification: removes the vertices at the end of edges that are too short in the metric by collapsing these
// (paper, figure 2 and section 5).
//
// Conflict neighbourhood of s -> d: the closed one-ring of s. The vertex d stays where it is, so nothing outside is
// written; the design's brute-force trials and ours (test_mesh_view) found no invalid result. Where a face is not flat,
// the test for folds also looks at the faces behind the ring: if these may be changing, the vertex is put off.
// Invariants: simplicial 2-manifold, components, genus, boundary cycles; corners stay; curve vertices vanish only
// along their curve; no face turns away from the surface.
// Work: O(active vertices) a sweep; span: the work of a block and the passes, or colours, of the border.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SIMPLIFICATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SIMPLIFICATION_H

#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/border_claims.h>
#include <CGAL/Surface_mesh_adaptation/kernels/collapse.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/curve_spacing.h>
#include <CGAL/Surface_mesh_adaptation/kernels/folds.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Simplification_thresholds
{
  double min_length = min_unit_length;  ///< edges below are collapsed
  double max_length = max_unit_length;  ///< no collapse creates an edge above, unless it removes a longer one
  double min_quality = 0.2;             ///< nor a face below, unless there was a worse one
  bool weigh_neighbors = false;         ///< decide by all edges that change: in an anisotropic metric by their mean
                                        ///< misfit, on curves by the mean length of neighbouring ones
};

template <class Surface, class Execution>
class Simplification
{
public:
  Simplification(const Execution& execution, Surface& surface, const Simplification_thresholds& thresholds)
    : execution_(execution), surface_(surface), mesh_(surface.mesh), thresholds_(thresholds)
  {}

  /// Examines every active vertex once. Returns the number of vertices removed.
  std::size_t sweep(Sweep_counts& counts)
  {
    Sweep_counts local;
    const auto visit = [&](Index v, const auto& vertices, Sweep_counts& c, std::vector<Index>& list) {
      if (mesh_.is_removed_vertex(v) || !is_active(surface_, v, Activity::simplify)) return;
      if (!contains_ring(vertices, mesh_, v)) return list.push_back(v);
      ++c.candidates;
      bool is_put_off = false;
      const Mesh_view::Directed_edge e = examine(v, [&](Index w) { return vertices.contains(w); }, is_put_off);
      if (is_put_off) list.push_back(v);
      if (e.h == no_index) return;
      apply(e);
      ++c.applied;
    };
    std::vector<Index> deferred = sweep_blocks(execution_, mesh_.number_of_vertices(), local, visit);
    // Where most vertices vanish, those at the borders are in each other's way: claims would propose them over and over.
    if (double(local.applied) > share_of_dense_collapses * double(local.candidates))
      deferred = sweep_block_neighborhoods(execution_, mesh_, deferred, local, visit);
    sweep_border(deferred, local);
    ++local.sweeps;
    counts += local;
    return local.applied;
  }

  /// Whether `e`, of whatever length, may be collapsed while nothing else changes.
  bool is_allowed(const Mesh_view::Directed_edge& e) const
  {
    bool is_put_off = false;
    return is_valid(e, star(mesh_.vanishing_vertex(e)), [](Index) { return true; }, is_put_off);
  }

  void apply(const Mesh_view::Directed_edge& e)
  {
    const Index s = mesh_.vanishing_vertex(e);
    mesh_.for_each_neighbor(s, [&](Index x) { activate(surface_, x); });
    if (!surface_.tolerance) return mesh_.collapse(e);
    const Ring<Index> faces = surface_.faces_around(s);
    mesh_.collapse(e);
    surface_.tolerance->hand_over(surface_, faces);
  }

private:
  /// The best valid collapse that removes `s`; `h == no_index` if there is none. On a curve, its neighbours count as
  /// far as they may be seen. A test for folds looks at the faces behind those around `s`: where one of their vertices
  /// may not be seen, `is_put_off` is set and there is none.
  template <class IsSeen>
  Mesh_view::Directed_edge propose(Index s, const IsSeen& is_seen, bool& is_put_off)
  {
    if (surface_.vertex_class(s) == Vertex_class::corner) return {};
    Ring<std::pair<double, Mesh_view::Directed_edge>> short_edges;
    for_each_collapse(surface_, s, max_length_to_collapse(s, is_seen), [&](const Mesh_view::Directed_edge& e) {
      short_edges.emplace_back(surface_.length(e.h), e);
    });
    std::sort(short_edges.begin(), short_edges.end(), [&](const auto& a, const auto& b) {
      return a.first < b.first || (a.first == b.first && mesh_.kept_vertex(a.second) < mesh_.kept_vertex(b.second));
    });
    if (short_edges.empty()) return {};
    const Star around = star(s);
    for (const auto& candidate : short_edges)
      if (is_valid(candidate.second, around, is_seen, is_put_off))
        return is_put_off ? Mesh_view::Directed_edge() : candidate.second;
    return {};
  }

  /// Proposes, and remembers that there is nothing to propose.
  template <class IsSeen>
  Mesh_view::Directed_edge examine(Index v, const IsSeen& is_seen, bool& is_put_off)
  {
    const Mesh_view::Directed_edge e = propose(v, is_seen, is_put_off);
    if (e.h == no_index && !is_put_off) deactivate(surface_, v, Activity::simplify);
    return e;
  }

  void sweep_border(const std::vector<Index>& vertices, Sweep_counts& counts)
  {
    using Collapse = Mesh_view::Directed_edge;
    sweep_border_by_claims<Collapse>(
      execution_, mesh_, vertices, reservations_, counts,
      [&](Index v) {
        bool is_put_off = false;
        return examine(v, [](Index) { return true; }, is_put_off);
      },
      [&](const Collapse& e) { return surface_.length(e.h) / thresholds_.min_length; },
      [&](const Collapse& e, const auto& claim) {
        claim(mesh_.vanishing_vertex(e));
        mesh_.for_each_neighbor(mesh_.vanishing_vertex(e), claim);
      },
      [&](const Collapse& e) { apply(e); });
  }

  /// The edges along which `s` may vanish are shorter.
  template <class IsSeen>
  double max_length_to_collapse(Index s, const IsSeen& is_seen) const
  {
    if (!thresholds_.weigh_neighbors || surface_.vertex_class(s) != Vertex_class::curve) return thresholds_.min_length;
    return is_collapsed_on_curve(surface_, s, is_seen) ? max_curve_length : min_curve_length;
  }

  /// The faces around a vertex that may vanish, and what its collapse must not worsen.
  struct Star
  {
    struct Face
    {
      Index x, y; ///< the other corners
      Vector_3 normal;
    };

    Ring<Face> faces;
    double quality = 1, alignment = 1; ///< the least ones
    double length = 0;                 ///< of the longest edge at the vertex
  };

  Star star(Index s) const
  {
    Star star;
    const bool is_open = mesh_.is_border_vertex(s);
    mesh_.for_each_outgoing(s, [&](Index h) {
      const Index x = mesh_.target(h), y = mesh_.apex(h);
      const Vector_3 n = surface_.normal(s, x, y);
      star.faces.push_back({x, y, n});
      star.quality = (std::min)(star.quality, surface_.quality(s, x, y));
      star.alignment = (std::min)(star.alignment, alignment_of_face(surface_, n, s, x, y));
      star.length = (std::max)({star.length, surface_.length(s, x), is_open ? surface_.length(s, y) : 0});
    });
    return star;
  }

  template <class IsSeen>
  bool is_valid(const Mesh_view::Directed_edge& e, const Star& star, const IsSeen& is_seen, bool& is_put_off) const
  {
    const Index s = mesh_.vanishing_vertex(e), d = mesh_.kept_vertex(e);
    if (surface_.vertex_class(s) == Vertex_class::curve && !is_curve_preserved(surface_, s, d)) return false;

    const double quality_limit = (std::min)(thresholds_.min_quality, star.quality);
    const double alignment_limit = least_alignment_after(star.alignment);
    const Index on_curve = thresholds_.weigh_neighbors ? next_on_curve(surface_, s, d) : no_index;
    const double length_limit = (std::max)(thresholds_.max_length, star.length);
    const bool may_be_long = is_anisotropic<typename Surface::Metric> && thresholds_.weigh_neighbors;
    bool is_flat = true, is_long = false;
    const auto is_fit = [&](Index x) {
      const double length = surface_.length(d, x);
      if (x == on_curve) return length <= max_curve_length;
      is_long = is_long || length > length_limit;
      return !is_long || (may_be_long && length <= max_length_in_between);
    };
    for (const typename Star::Face& f : star.faces) {
      if (f.x == d || f.y == d) continue;
      const double new_quality = surface_.quality(d, f.x, f.y);
      const Vector_3 n = surface_.normal(d, f.x, f.y);
      is_flat = is_flat && is_flat_face(surface_, n, d, f.x, f.y);
      if (!((new_quality > quality_limit || n == Vector_3::Zero()) && is_fit(f.x) && is_fit(f.y) &&
            is_upright(f, n, s, d, alignment_limit)))
        return false;
    }
    return !(is_long && is_fit_worse(e)) && mesh_.is_collapsible(e) &&
           (is_flat || is_unfolded(surface_, s, surface_.points[d], is_seen, is_put_off)) &&
           (!surface_.tolerance || keeps_tolerance(s, d));
  }

  /// Whether the face with the normal `n` that replaces `f` when `s` vanishes in `d` turns far neither from `f`, unless
  /// both are thin, nor from the surface at its corners and at `s`. Only degenerate faces become degenerate.
  bool is_upright(const typename Star::Face& f, const Vector_3& n, Index s, Index d, double limit) const
  {
    if (alignment_of_face(surface_, n, d, f.x, f.y) < limit) return false;
    if (n == Vector_3::Zero()) return is_in_order(f, s, d);
    const double at_s = surface_.vertex_class(s) == Vertex_class::smooth ? n.dot(surface_.normals[s]) : 1;
    if (cosine_of_turn(n, f.normal) >= min_turn_of_collapse && at_s >= limit) return true;
    return is_thin_face(surface_, d, f.x, f.y) && is_thin_face(surface_, s, f.x, f.y) &&
           alignment_of_thin_face(at_s) >= limit;
  }

  /// Whether the corner of the degenerate face `f` that lies between the others still does if `d` takes the place of
  /// `s`: else faces around it would be turned over.
  bool is_in_order(const typename Star::Face& f, Index s, Index d) const
  {
    const auto middle = [&](Index v) {
      const Vector_3 &p = surface_.points[v], &x = surface_.points[f.x], &y = surface_.points[f.y];
      const double at_v = (x - p).dot(y - p), at_x = (p - x).dot(y - x), at_y = (p - y).dot(x - y);
      return at_v < (std::min)(at_x, at_y) ? 0 : at_x < at_y ? 1 : 2;
    };
    return f.normal == Vector_3::Zero() && middle(s) == middle(d);
  }

  /// Whether the edges that a collapse creates fit the metric less than those that it removes.
  bool is_fit_worse(const Mesh_view::Directed_edge& e) const
  {
    const Index s = mesh_.vanishing_vertex(e), d = mesh_.kept_vertex(e), t = mesh_.twin[e.h];
    const Index c1 = mesh_.apex(e.h), c2 = t != no_index ? mesh_.apex(t) : d;
    Mean_misfit before, after;
    mesh_.for_each_neighbor(s, [&](Index x) {
      before.add(surface_.length(s, x));
      if (x != d && x != c1 && x != c2) after.add(surface_.length(d, x));
    });
    return !after.is_at_most(max_misfit, before);
  }

  bool keeps_tolerance(Index s, Index d) const
  {
    Ring<Index> old_faces;
    Ring<Triangle_points> faces;
    mesh_.for_each_outgoing(s, [&](Index h) {
      const Index x = mesh_.target(h), y = mesh_.apex(h);
      old_faces.push_back(Mesh_view::face(h));
      if (x != d && y != d) faces.push_back({surface_.points[d], surface_.points[x], surface_.points[y]});
    });
    if (!surface_.tolerance->are_covered(old_faces, faces)) return false; // this first: the other direction takes longer
    bool is_kept = true;
    mesh_.for_each_outgoing_while(s, [&](Index h) {
      const Index x = mesh_.target(h), y = mesh_.apex(h);
      is_kept = x == d || y == d ||
                surface_.tolerance->is_kept(surface_.corner(d), surface_.corner(x), surface_.corner(y));
      return is_kept;
    });
    return is_kept;
  }

  static constexpr double share_of_dense_collapses = 1.0 / 3; // of the vertices that are examined
  static constexpr double max_misfit = 1.3; // of what it was: where there are too many vertices moves make good for it

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Simplification_thresholds thresholds_;
  Reservations reservations_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SIMPLIFICATION_H

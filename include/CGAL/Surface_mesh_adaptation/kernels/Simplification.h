// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification: removes the vertices at the end of edges that are too short in the metric by collapsing these
// (paper, figure 2 and section 5).
//
// Conflict neighbourhood of s -> d: the closed one-ring of s. The vertex d stays where it is, so nothing outside is
// written; the design's brute-force trials and ours (test_mesh_view) found no invalid result.
// Invariants: simplicial 2-manifold, components, genus, boundary cycles; corners stay; curve vertices vanish only
// along their curve; no face turns away from the surface.
// Work: O(active vertices) a sweep; span: the work of a block and the passes of the border.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SIMPLIFICATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SIMPLIFICATION_H

#include <CGAL/Surface_mesh_adaptation/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/internal/flatten.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

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
    std::vector<Index> deferred = sweep_blocks(
      execution_, mesh_.number_of_vertices(), local,
      [&](Index v, const Block& block, Sweep_counts& c, std::vector<Index>& list) {
        if (mesh_.is_removed_vertex(v) || !is_active(surface_, v, Activity::simplify)) return;
        if (!block.contains_ring(mesh_, v)) return list.push_back(v);
        ++c.candidates;
        c.applied += examine(v);
      });
    for (std::uint32_t round = 0; !deferred.empty() && round < max_border_rounds; ++round)
      sweep_border(deferred, round, local);
    ++local.sweeps;
    counts += local;
    return local.applied;
  }

  /// The best valid collapse that removes `s`; `h == no_index` if there is none.
  CGAL_SMA_FLATTEN Mesh_view::Directed_edge propose(Index s) const
  {
    if (surface_.vertex_class(s) == Vertex_class::corner) return {};
    Ring<std::pair<double, Mesh_view::Directed_edge>> short_edges;
    const auto consider = [&](const Mesh_view::Directed_edge& e) {
      if (!may_slide_along(s, e.h)) return;
      const double length = surface_.length(e.h);
      if (length < thresholds_.min_length) short_edges.emplace_back(length, e);
    };
    Index last = no_index;
    mesh_.for_each_outgoing(s, [&](Index h) {
      consider({h, true});
      last = Mesh_view::previous(h);
    });
    if (mesh_.is_border(last)) consider({last, false});
    std::sort(short_edges.begin(), short_edges.end(), [&](const auto& a, const auto& b) {
      return a.first < b.first || (a.first == b.first && mesh_.kept_vertex(a.second) < mesh_.kept_vertex(b.second));
    });
    for (const auto& candidate : short_edges)
      if (is_valid(candidate.second)) return candidate.second;
    return {};
  }

  void apply(const Mesh_view::Directed_edge& e)
  {
    mesh_.for_each_neighbor(mesh_.vanishing_vertex(e), [&](Index x) { activate(surface_, x); });
    mesh_.collapse(e);
  }

private:
  static constexpr std::uint32_t max_border_rounds = 8; // what is left then is examined by the next sweep

  bool examine(Index v)
  {
    const Mesh_view::Directed_edge e = propose(v);
    if (e.h == no_index) {
      deactivate(surface_, v, Activity::simplify);
      return false;
    }
    apply(e);
    return true;
  }

  void sweep_border(std::vector<Index>& vertices, std::uint32_t round, Sweep_counts& counts)
  {
    counts.candidates += vertices.size();
    proposals_.resize(vertices.size());
    for_each_index(execution_, vertices.size(), [&](std::size_t i) {
      proposals_[i] = mesh_.is_removed_vertex(vertices[i]) ? Mesh_view::Directed_edge() : propose(vertices[i]);
    }, heavy_chunk_length);
    const auto valid = pack(execution_, vertices.size(), [&](std::size_t i) { return proposals_[i].h != no_index; });
    for_each_index(execution_, vertices.size(), [&](std::size_t i) {
      if (proposals_[i].h == no_index) deactivate(surface_, vertices[i], Activity::simplify);
    });
    reservations_.resize(execution_, mesh_.number_of_vertices());
    const auto winners = independent_set(
      execution_, valid.size(), reservations_,
      [&](std::size_t i) {
        const Mesh_view::Directed_edge& e = proposals_[valid[i]];
        const double relative = surface_.length(e.h) / thresholds_.min_length;
        return task_priority((std::min)(7u, std::uint32_t(8 * relative)), vertices[valid[i]], round);
      },
      [&](std::size_t i, const auto& claim) {
        claim(vertices[valid[i]]);
        mesh_.for_each_neighbor(vertices[valid[i]], claim);
      });
    for_each_index(execution_, winners.size(), [&](std::size_t i) { apply(proposals_[valid[winners[i]]]); });
    counts.applied += winners.size();

    vertices = gather<Index>(execution_, valid.size(), default_chunk_length,
                             [&](std::size_t begin, std::size_t end, std::vector<Index>& losers) {
      for (std::size_t i = begin; i < end; ++i)
        if (!mesh_.is_removed_vertex(vertices[valid[i]])) losers.push_back(vertices[valid[i]]);
    });
  }

  bool may_slide_along(Index s, Index h) const
  {
    return surface_.vertex_class(s) == Vertex_class::smooth || mesh_.curve[h] == surface_.locations[s].cell;
  }

  bool is_valid(const Mesh_view::Directed_edge& e) const
  {
    const Index s = mesh_.vanishing_vertex(e), d = mesh_.kept_vertex(e);
    if (!mesh_.is_collapsible(e)) return false;
    if (surface_.vertex_class(s) == Vertex_class::curve && !is_curve_preserved(s, d)) return false;

    double old_quality = 1, old_alignment = 1, length_limit = thresholds_.max_length;
    bool is_valid = true, is_flat = true;
    mesh_.for_each_outgoing(s, [&](Index h) {
      const Index x = mesh_.target(h), y = mesh_.apex(h);
      old_quality = (std::min)(old_quality, surface_.quality(s, x, y));
      old_alignment = (std::min)(old_alignment, surface_.alignment(s, x, y));
      length_limit = (std::max)({length_limit, surface_.length(s, x), surface_.length(s, y)});
    });
    const double quality_limit = (std::min)(thresholds_.min_quality, old_quality);
    const double alignment_limit = (std::min)(min_alignment, old_alignment);
    mesh_.for_each_outgoing_while(s, [&](Index h) {
      const Index x = mesh_.target(h), y = mesh_.apex(h);
      if (x == d || y == d) return true;
      const double new_quality = surface_.quality(d, x, y);
      const Vector_3 n = surface_.normal(d, x, y);
      is_flat = is_flat && surface_.is_flat(n, d, x, y);
      is_valid = new_quality > quality_limit && new_quality > 0 && surface_.length(d, x) <= length_limit &&
                 surface_.length(d, y) <= length_limit &&
                 surface_.alignment(n, d, x, y) >= alignment_limit && n.dot(surface_.normal(s, x, y)) >= min_turn &&
                 (surface_.vertex_class(s) != Vertex_class::smooth || n.dot(surface_.normals[s]) >= alignment_limit);
      return is_valid;
    });
    return is_valid &&
           (is_flat || surface_.sharpest_fold(s, surface_.points[d]) >=
                         (std::min)(min_fold, surface_.sharpest_fold(s, surface_.points[s]))) &&
           (!surface_.has_tolerance() || keeps_tolerance(s, d));
  }

  bool keeps_tolerance(Index s, Index d) const
  {
    Ring<Triangle_points> faces;
    bool is_kept = true;
    mesh_.for_each_outgoing_while(s, [&](Index h) {
      const Index x = mesh_.target(h), y = mesh_.apex(h);
      if (x == d || y == d) return true;
      faces.push_back({surface_.points[d], surface_.points[x], surface_.points[y]});
      is_kept = surface_.keeps_tolerance(surface_.corner(d), surface_.corner(x), surface_.corner(y));
      return is_kept;
    });
    return is_kept && surface_.is_near(faces, surface_.points[s]);
  }

  /// Whether the curve through `s` may skip it towards `d`: it must not turn too much there, the new edge must not be
  /// an edge of a curve already, and must leave a closed curve enough arcs to tell its sides apart.
  bool is_curve_preserved(Index s, Index d) const
  {
    const Index curve = surface_.locations[s].cell;
    Index other = no_index;
    bool is_free = true;
    const auto visit = [&](Index w, Index h) {
      if (mesh_.curve[h] == curve && w != d) other = w;
    };
    Index last = no_index;
    mesh_.for_each_outgoing(s, [&](Index h) {
      visit(mesh_.target(h), h);
      last = Mesh_view::previous(h);
    });
    if (mesh_.is_border(last)) visit(mesh_.source(last), last);
    if (other == no_index) return false;
    const Vector_3 a = surface_.points[d] - surface_.points[s], b = surface_.points[s] - surface_.points[other];
    if (a.dot(b) < min_curve_turn * a.norm() * b.norm()) return false;
    for (const Index h : {mesh_.halfedge(d, other), mesh_.halfedge(other, d)})
      if (h != no_index && mesh_.is_feature(h)) is_free = false;
    const auto& c = surface_.reference().features.curves[curve];
    const bool has_two_ends = !c.is_closed() && c.vertices.front() != c.vertices.back();
    if (has_two_ends) return is_free;
    const auto arc_d = surface_.reference().arc(curve, surface_.locations[s], surface_.locations[d]);
    const auto arc_o = surface_.reference().arc(curve, surface_.locations[s], surface_.locations[other]);
    return is_free && std::abs(arc_d.second - arc_o.second) < max_share_of_closed_curve * c.length();
  }

  static constexpr double min_turn = 0.3;        // cosine between a face and what replaces it
  static constexpr double min_curve_turn = 0.5;  // cosine of the angle that a curve turns at a vertex that vanishes
  static constexpr double max_share_of_closed_curve = 0.4;

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Simplification_thresholds thresholds_;
  std::vector<Mesh_view::Directed_edge> proposals_;
  Reservations reservations_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SIMPLIFICATION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Swapping: replaces an edge by the other diagonal of its two faces where that is better (paper, figure 2, section 5).
//
// Conflict neighbourhood of (p, q) -> (a, b): the four vertices, since the criterion reads degrees and the new edge
// must not exist; claiming them also keeps two winners from creating the same edge.
// Accepted only on strict improvement, so sweeps end. Invariants: as simplification; features are never swapped.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SWAPPING_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SWAPPING_H

#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/degrees.h>
#include <CGAL/Surface_mesh_adaptation/kernels/folds.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Swapping_thresholds
{
  double max_length = max_unit_length;  ///< no swap creates an edge above, unless it replaces a longer one
  bool equalize_degrees = true;         ///< prefer 6 faces around a vertex, 3 beside a curve, among good ones
};

template <class Surface, class Execution>
class Swapping
{
public:
  Swapping(const Execution& execution, Surface& surface, const Swapping_thresholds& thresholds)
    : execution_(execution), surface_(surface), mesh_(surface.mesh), thresholds_(thresholds)
  {}

  /// Examines every edge with an active end once. Returns the number of edges swapped.
  std::size_t sweep(Sweep_counts& counts)
  {
    Sweep_counts local;
    fill(execution_, touched_, mesh_.number_of_vertices(), std::uint8_t(0));
    std::vector<Index> deferred = sweep_blocks(
      execution_, mesh_.number_of_vertices(), local,
      [&](Index v, const Block& block, Sweep_counts& c, std::vector<Index>& list) {
        if (!mesh_.is_removed_vertex(v) && is_active(surface_, v, Activity::swap) && sweep_edges_of(v, block, c))
          list.push_back(v);
      });
    for (std::uint32_t round = 0; !deferred.empty() && round < max_border_rounds; ++round)
      sweep_border(deferred, round, local);
    for_each_index(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
      if (touched_[v]) activate(surface_, Index(v));
      else deactivate(surface_, Index(v), Activity::swap);
    });
    ++local.sweeps;
    counts += local;
    return local.applied;
  }

  /// The gain in worst quality of swapping the edge of `h`, or 0 if that is not possible or no improvement.
  double gain(Index h) const
  {
    if (mesh_.is_feature(h)) return 0; // so is the boundary
    const Index t = mesh_.twin[h];
    const Index p = mesh_.source(h), q = mesh_.target(h), b = mesh_.apex(h), a = mesh_.apex(t);
    if (surface_.has_quality(p, q, b, max_improvable_quality) && surface_.has_quality(q, p, a, max_improvable_quality))
      return 0;
    const double before = (std::min)(surface_.quality(p, q, b), surface_.quality(q, p, a));
    const double after = (std::min)(surface_.quality(a, b, p), surface_.quality(b, a, q));
    const bool better = is_degenerate(before) ? !is_degenerate(after) || is_much_shorter(a, b, p, q)
                                              : after > before * min_improvement;
    if (!better && !(thresholds_.equalize_degrees && after > min_degree_swap_quality &&
                     after > max_quality_loss * before))
      return 0;
    if (thresholds_.equalize_degrees) {
      const int change = degree_change(h);
      if (change > 0 && before > min_degree_swap_quality) return 0;
      if (change >= 0 && !better) return 0;
    }
    if (mesh_.are_adjacent(a, b) || !is_valid(h)) return 0;
    return (std::max)(after - before, least_gain);
  }

  void apply(Index h)
  {
    for (Index v : {mesh_.source(h), mesh_.target(h), mesh_.apex(h), mesh_.apex(mesh_.twin[h])})
      touched_[v] = 1;
    const std::array<Index, 2> faces{Mesh_view::face(h), Mesh_view::face(mesh_.twin[h])};
    mesh_.flip(h);
    if (surface_.tolerance) surface_.tolerance->hand_over(surface_, faces);
  }

private:
  static constexpr double min_improvement = 1.0 + 1e-3; // strict, and above rounding
  static constexpr double least_gain = 1e-9;
  static constexpr double min_degree_swap_quality = 0.55; // degrees matter only among good faces
  static constexpr double max_quality_loss = 0.7;
  static constexpr double min_turn = 0.5;
  static constexpr double degenerate_quality = 1e-5; // below, one face is as bad as another
  static constexpr double height_of_cap = 5e-4; // in lengths of the edge below
  static constexpr double alignment_behind_cap = 0.97; // 14 degrees
  static constexpr double min_length_beside_curves = 4; // of edges for which that of faces between curves counts:
  static constexpr double alignment_beside_curves = 0.97; // 14 degrees
  static constexpr double max_share = 0.99; // of the length of an edge between such faces

  /// Works through the edges from `v` to larger ids that lie in the block; whether some do not.
  bool sweep_edges_of(Index v, const Block& block, Sweep_counts& counts)
  {
    bool has_deferred = false;
    std::size_t remaining = 0;
    mesh_.for_each_outgoing(v, [&](Index) { ++remaining; });
    for (Index h = mesh_.outgoing[v]; remaining > 0 && h != no_index; --remaining) {
      const Index following = mesh_.rotated_ccw(h);
      if (is_candidate(v, h)) {
        if (lies_in(block, h)) {
          ++counts.candidates;
          if (gain(h) > 0) {
            apply(h);
            ++counts.applied;
          }
        } else has_deferred = true;
      }
      h = following;
    }
    return has_deferred;
  }

  bool is_candidate(Index v, Index h) const
  {
    const Index w = mesh_.target(h);
    return v < w && !mesh_.is_feature(h) &&
           is_active(surface_, v, Activity::swap) && is_active(surface_, w, Activity::swap);
  }

  bool lies_in(const Block& block, Index h) const
  {
    return block.contains(mesh_.source(h)) && block.contains(mesh_.target(h)) && block.contains(mesh_.apex(h)) &&
           block.contains(mesh_.apex(mesh_.twin[h]));
  }

  static Block block_of(Index v)
  {
    const Index begin = v - v % Index(block_length);
    return {begin, begin + Index(block_length)};
  }

  /// One pass of claims over the deferred edges of `vertices`, which keeps those that still have some.
  void sweep_border(std::vector<Index>& vertices, std::uint32_t round, Sweep_counts& counts)
  {
    const std::vector<Index> edges = gather<Index>(execution_, vertices.size(), claim_chunk_length,
                                                   [&](std::size_t begin, std::size_t end, std::vector<Index>& list) {
      for (std::size_t i = begin; i < end; ++i)
        mesh_.for_each_outgoing(vertices[i], [&](Index h) {
          if (is_candidate(vertices[i], h) && !lies_in(block_of(vertices[i]), h)) list.push_back(h);
        });
    });
    counts.candidates += edges.size();
    gains_.resize(edges.size());
    for_each_index(execution_, edges.size(), [&](std::size_t i) {
      gains_[i] = is_stopped(execution_) ? 0 : gain(edges[i]);
    }, heavy_chunk_length);
    const auto valid = pack(execution_, edges.size(), [&](std::size_t i) { return gains_[i] > 0; });
    reservations_.resize(execution_, mesh_.number_of_vertices());
    const auto winners = independent_set(
      execution_, valid.size(), reservations_,
      [&](std::size_t i) {
        const std::uint32_t bucket = std::uint32_t(7 - (std::min)(7.0, 16 * gains_[valid[i]]));
        return task_priority(bucket, edges[valid[i]], round);
      },
      [&](std::size_t i, const auto& claim) {
        const Index h = edges[valid[i]];
        for (Index v : {mesh_.source(h), mesh_.target(h), mesh_.apex(h), mesh_.apex(mesh_.twin[h])}) claim(v);
      });
    vertices.clear();
    if (winners.size() < valid.size())
      vertices = gather<Index>(execution_, valid.size(), default_chunk_length,
                               [&](std::size_t begin, std::size_t end, std::vector<Index>& remaining) {
        for (std::size_t i = begin; i < end; ++i) {
          const Index v = mesh_.source(edges[valid[i]]);
          if (i == 0 || v != mesh_.source(edges[valid[i - 1]])) remaining.push_back(v);
        }
      });
    for_each_index(execution_, winners.size(), [&](std::size_t i) { apply(edges[valid[winners[i]]]); },
                   heavy_chunk_length);
    counts.applied += winners.size();
  }

  /// Change of the sum of the squares by which the numbers of faces around the four vertices differ from the ideal ones.
  int degree_change(Index h) const
  {
    const Index t = mesh_.twin[h];
    const auto change = [&](Index leaving, int by) { return excess_of_faces(surface_, leaving).squared_change(by); };
    return change(h, -1) + change(t, -1) + change(Mesh_view::previous(h), 1) + change(Mesh_view::previous(t), 1);
  }

  bool is_valid(Index h) const
  {
    const Index t = mesh_.twin[h];
    const Index p = mesh_.source(h), q = mesh_.target(h), b = mesh_.apex(h), a = mesh_.apex(t);
    if (is_cut_by_cap(h) || is_cut_by_cap(t)) return !surface_.tolerance || keeps_tolerance(h);
    const double length = surface_.length(a, b);
    if (length > (std::max)(thresholds_.max_length, surface_.length(p, q)) && length > length_beside_degenerate_face(h))
      return false;
    const Vector_3 old1 = surface_.normal(p, q, b), old2 = surface_.normal(q, p, a);
    const Vector_3 new1 = surface_.normal(a, b, p), new2 = surface_.normal(b, a, q);
    const double limit = least_alignment_after((std::min)(alignment_of_face(surface_, old1, p, q, b),
                                                          alignment_of_face(surface_, old2, q, p, a)));
    if (alignment_of_face(surface_, new1, a, b, p) < limit || alignment_of_face(surface_, new2, b, a, q) < limit)
      return false;
    if (length > min_length_beside_curves && !keeps_beside_curves(h, {old1, old2}, {new1, new2})) return false;
    if (old1 == Vector_3::Zero() && old2 == Vector_3::Zero() && !is_convex(p, q, a, b)) return false;
    const double turn = (std::min)(min_turn, cosine_of_turn(old1, old2));
    const bool is_thin = is_thin_face(surface_, p, q, b) && is_thin_face(surface_, q, p, a) &&
                         is_thin_face(surface_, a, b, p) && is_thin_face(surface_, b, a, q);
    if (!is_thin && (std::min)({cosine_of_turn(new1, old1), cosine_of_turn(new1, old2), cosine_of_turn(new2, old1),
                                cosine_of_turn(new2, old2), cosine_of_turn(new1, new2)}) < turn)
      return false;
    if (surface_.tolerance && !keeps_tolerance(h)) return false;
    if (is_thin || (is_flat_face(surface_, new1, a, b, p) && is_flat_face(surface_, new2, b, a, q))) return true;
    // faces (p, q, b) and (q, p, a) with outer edges hn hp and tn tp become (a, b, p) and (b, a, q) with hp tn and tp hn
    const Index hn = Mesh_view::next(h), hp = Mesh_view::previous(h), tn = Mesh_view::next(t), tp = Mesh_view::previous(t);
    const auto fold = [&](Index e, const Vector_3& n) { return fold_across(surface_, e, n); };
    return (std::min)({fold(hn, new2), fold(hp, new1), fold(tn, new1), fold(tp, new2)}) >=
           (std::min)({min_fold, fold(hn, old1), fold(hp, old1), fold(tn, old2), fold(tp, old2)});
  }

  /// Whether the face at `h` has its corners in line, and the one behind is just cut in two at the corner between: the shape
  /// stays what it is, even in a fold.
  bool is_cut_by_cap(Index h) const
  {
    const Index p = mesh_.source(h), q = mesh_.target(h), b = mesh_.apex(h), a = mesh_.apex(mesh_.twin[h]);
    const Vector_3 e1 = surface_.points[q] - surface_.points[p], e2 = surface_.points[b] - surface_.points[p];
    if (!(e1.cross(e2).norm() < height_of_cap * e1.squaredNorm())) return false;
    const Vector_3 behind = surface_.normal(q, p, a);
    return (std::min)(behind.dot(surface_.normal(a, b, p)), behind.dot(surface_.normal(b, a, q))) > alignment_behind_cap;
  }

  /// Whether long faces between curves, none of whose corners has a normal of its own, stay where the surface beside
  /// these is. One after the other, swaps would bring an edge across a cylinder. `before` and `after` are the normals of
  /// the faces.
  bool keeps_beside_curves(Index h, const std::array<Vector_3, 2>& before, const std::array<Vector_3, 2>& after) const
  {
    const Index t = mesh_.twin[h];
    const auto is_smooth = [&](Index g) { return surface_.vertex_class(mesh_.source(g)) == Vertex_class::smooth; };
    const Index at_b = Mesh_view::previous(h), at_a = Mesh_view::previous(t);
    if (is_smooth(at_a) || is_smooth(at_b) || (is_smooth(h) && is_smooth(t))) return true;
    const Vector_3 p = normal_in_sector(surface_, h), q = normal_in_sector(surface_, t),
                   a = normal_in_sector(surface_, at_a), b = normal_in_sector(surface_, at_b);
    const auto alignment = [](const Vector_3& n, const Vector_3& u, const Vector_3& v, const Vector_3& w) {
      return (std::min)({cosine_of_turn(n, u), cosine_of_turn(n, v), cosine_of_turn(n, w)});
    };
    const double limit =
      (std::min)({alignment_beside_curves, alignment(before[0], p, q, b), alignment(before[1], q, p, a)});
    return (is_smooth(h) || alignment(after[0], a, b, p) >= limit) &&
           (is_smooth(t) || alignment(after[1], b, a, q) >= limit);
  }

  static bool is_degenerate(double quality) { return quality < degenerate_quality; }

  /// Degenerate faces get at good ones step by step, while the edges between them get shorter.
  bool is_much_shorter(Index a, Index b, Index p, Index q) const
  {
    return surface_.length(a, b) < max_share * surface_.length(p, q);
  }

  /// The length that the other diagonal may have if one of the faces at `h` is degenerate, else 0: that of any of their
  /// edges, since in space it is shorter than the longest one.
  double length_beside_degenerate_face(Index h) const
  {
    const auto is_degenerate_at = [&](Index g) {
      return is_degenerate(surface_.quality(mesh_.source(g), mesh_.target(g), mesh_.apex(g)));
    };
    double longest = 0;
    if (is_degenerate_at(h) || is_degenerate_at(mesh_.twin[h]))
      for (const Index g : {h, mesh_.twin[h]})
        longest = (std::max)({longest, surface_.length(Mesh_view::next(g)), surface_.length(Mesh_view::previous(g))});
    return longest;
  }

  /// Whether the other diagonal of four points in line leaves no face turned over: neither end of the edge from `p` to
  /// `q` lies between the other end and both `a` and `b`.
  bool is_convex(Index p, Index q, Index a, Index b) const
  {
    const Vector_3 &start = surface_.points[p], e = surface_.points[q] - start;
    const double ta = e.dot(surface_.points[a] - start), tb = e.dot(surface_.points[b] - start);
    return (std::min)(ta, tb) < e.squaredNorm() && (std::max)(ta, tb) > 0;
  }

  bool keeps_tolerance(Index h) const
  {
    const Index t = mesh_.twin[h];
    const Index p = mesh_.source(h), q = mesh_.target(h), b = mesh_.apex(h), a = mesh_.apex(t);
    const auto& points = surface_.points;
    const std::array<Triangle_points, 2> faces{{{points[a], points[b], points[p]}, {points[b], points[a], points[q]}}};
    const auto is_kept = [&](Index v) {
      return surface_.tolerance->is_kept(surface_.corner(a), surface_.corner(b), surface_.corner(v));
    };
    return surface_.tolerance->are_covered(std::array{Mesh_view::face(h), Mesh_view::face(t)}, faces) && is_kept(p) &&
           is_kept(q);
  }

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Swapping_thresholds thresholds_;
  Buffer<std::uint8_t> touched_; // in this sweep; `active` stays as it was, for other blocks read it
  std::vector<double> gains_;
  Reservations reservations_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SWAPPING_H

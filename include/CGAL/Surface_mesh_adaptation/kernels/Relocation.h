// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relocation: moves vertices on the surface to improve the faces around them (paper, section 3).
//
// Diffusion towards the centre of mass of the surrounding faces, weighted by the density of the metric (equation 1),
// and towards where these would be equilateral; over-relaxed, with a step that is halved until no face is made worse
// than allowed. Curve vertices move along their curve to balance the metric lengths on both sides, and where these are
// balanced also for the faces; corners stay. Where that does nothing for a vertex with a bad face around it, its worst
// distortion is minimised (minimize_worst.h), until no face is bad.
//
// Conflict neighbourhood: distance-1, because normals and metrics follow from the vertex's own location. Where a face
// is not flat, the test for folds also looks at the vertices behind the ring: if these may be moving, the vertex is put
// off until they stand still.
// Invariants: connectivity is not touched; no move turns a face farther from the surface than the limits or than it
// was; the worst face around a vertex never falls below both what it was and `good_quality`, or
// `good_quality_on_curves` if the vertex lies on one.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_H

#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/centering.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/curve_spacing.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/numerics/minimize_worst.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Relocation_thresholds
{
  double good_quality = 0.8;   ///< moves that leave no face below are always accepted; worse faces are optimised
  double good_quality_on_curves = 0.65; ///< the same for vertices on curves: equal lengths along these count, too
  double least_flatness = -1;  ///< cosine between a face and the tangent plane at a vertex that moves, unless it was
                               ///< less: the paper's theta_max
  double min_move = 0.03;      ///< metric length below which a move is not worth it
  double noticeable_move = 0.2; ///< the same in the first round over a mesh that is adapted already
};

template <class Surface, class Execution>
class Relocation
{
public:
  using Metric = typename Surface::Metric;

  Relocation(const Execution& execution, Surface& surface, const Relocation_thresholds& thresholds)
    : execution_(execution), surface_(surface), mesh_(surface.mesh), thresholds_(thresholds)
    , min_move_(thresholds.min_move)
  {}

  /// Whether the mesh is adapted already: it is left as it is then, but for noticeable moves.
  void expect_adapted(bool is_adapted)
  {
    min_move_ = is_adapted ? thresholds_.noticeable_move : thresholds_.min_move;
  }

  /// Examines every active vertex once. Returns the number of vertices moved.
  std::size_t sweep(Sweep_counts& counts)
  {
    Sweep_counts local;
    relaxation_ = relaxation_ == over_relaxation ? plain_relaxation : over_relaxation;
    const auto visit = [&](Index v, const auto& stands_still, Sweep_counts& c, std::vector<Index>& late) {
      Attempt<std::decay_t<decltype(stands_still)>> attempt{stands_still};
      ++c.candidates;
      c.applied += examine(v, attempt);
      if (attempt.is_put_off) late.push_back(v);
    };
    const std::vector<Index> deferred = sweep_blocks(
      execution_, mesh_.number_of_vertices(), local,
      [&](Index v, const Block& block, Sweep_counts& c, std::vector<Index>& list) {
        if (mesh_.is_removed_vertex(v) || surface_.vertex_class(v) == Vertex_class::corner ||
            !is_active(surface_, v, Activity::relocate))
          return;
        if (!contains_ring(block, mesh_, v)) return list.push_back(v);
        visit(v, [&](Index w) { return block.contains(w); }, c, list); // or has had its turn
      });
    // what would have to look at vertices that another task moves is left for the end: a few near features and folds
    const std::vector<Index> late = sweep_block_borders(execution_, mesh_, deferred, local, visit);
    std::vector<Index> never;
    for (const Index v : late) visit(v, [](Index) { return true; }, local, never);
    ++local.sweeps;
    counts += local;
    return local.applied;
  }

private:
  struct Neighbor
  {
    Index vertex;
    Vector_3 point;
    Vector_3 normal;   ///< zero on curves and at corners, which have several
    Metric metric;
  };

  /// The faces around a vertex, as the ring of their other corners, gathered once for all trials.
  struct Star
  {
    Ring<Neighbor> ring;
    bool is_closed = true;

    /// Calls `f(a, b)` for the pairs of consecutive neighbours, until it returns `false`; whether it never did.
    template <class F>
    bool for_each_face_while(const F& f) const
    {
      const Neighbor* const end = ring.data() + ring.size();
      const Neighbor* a = is_closed ? end - 1 : ring.data();
      for (const Neighbor* b = is_closed ? ring.data() : a + 1; b != end; a = b++)
        if (!f(*a, *b)) return false;
      return true;
    }

    /// Calls `f(a, b)` for the pairs of consecutive neighbours.
    template <class F>
    void for_each_face(const F& f) const
    {
      for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
        f(a, b);
        return true;
      });
    }
  };

  /// What a task may look at outside of the one-ring, and whether that was too little.
  template <class StandsStill>
  struct Attempt
  {
    const StandsStill& stands_still;
    bool is_put_off = false;
  };

  struct Shape
  {
    double worst = 1;      ///< quality
    double alignment = 1;  ///< least cosine between a face and the surface normals at its corners
    double flatness = 1;   ///< the same with the normal at the vertex only, if it is not on a curve
  };

  double good_quality(Index v) const
  {
    const bool is_on_curve = surface_.vertex_class(v) == Vertex_class::curve;
    return is_on_curve ? thresholds_.good_quality_on_curves : thresholds_.good_quality;
  }

  /// Tries to move `v`, while those vertices of which `attempt.stands_still` says so do not move.
  template <class StandsStill>
  bool examine(Index v, Attempt<StandsStill>& attempt)
  {
    const Star star = star_of(v);
    const bool moved = (surface_.vertex_class(v) == Vertex_class::curve ? slide(v, star, attempt)
                                                                        : diffuse(v, star, attempt)) ||
                       (!attempt.is_put_off && optimize(v, star, attempt));
    if (!moved && !attempt.is_put_off) deactivate(surface_, v, Activity::relocate);
    return moved;
  }

  /// Moves `v`, unless that leaves the tolerance.
  bool apply(Index v, const Star& star, const Placed_vertex<Metric>& moved)
  {
    if (surface_.has_tolerance() && !keeps_tolerance(v, star, moved)) return false;
    surface_.set(v, moved);
    if (surface_.has_tolerance()) surface_.hand_over(surface_.faces_around(v));
    activate_around(v, star, moved);
    return true;
  }

  bool keeps_tolerance(Index v, const Star& star, const Placed_vertex<Metric>& moved) const
  {
    Ring<Triangle_points> faces;
    star.for_each_face([&](const Neighbor& a, const Neighbor& b) { faces.push_back({moved.point, a.point, b.point}); });
    return surface_.are_covered(surface_.faces_around(v), faces) &&
           star.for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
             return surface_.keeps_tolerance({moved.location, moved.point}, surface_.corner(a.vertex),
                                             surface_.corner(b.vertex));
           });
  }

  /// The neighbours may move now; the other kernels look again only where the move left something for them.
  void activate_around(Index v, const Star& star, const Placed_vertex<Metric>& moved)
  {
    constexpr std::uint8_t relocate = std::uint8_t(Activity::relocate);
    std::uint8_t of_all = relocate;
    if (moved.location.kind == Vertex_class::curve) of_all |= std::uint8_t(Activity::simplify);
    star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - moved.point, eb = b.point - moved.point;
      std::uint8_t kernels = relocate;
      if (is_shorter(moved.metric, a.metric, ea, min_unit_length) || is_shorter(moved.metric, b.metric, eb, min_unit_length))
        kernels |= std::uint8_t(Activity::simplify);
      if (!internal::squared_shape(moved.metric, a.metric, b.metric, ea, eb, ea.cross(eb))
             .is_at_least(max_improvable_quality))
        kernels |= std::uint8_t(Activity::swap);
      activate(surface_, a.vertex, kernels);
      if (kernels != relocate || !star.is_closed) activate(surface_, b.vertex, kernels); // else b is the next a
      of_all |= kernels;
    });
    activate(surface_, v, of_all);
  }

  Star star_of(Index v) const
  {
    Star s;
    s.is_closed = !mesh_.is_border_vertex(v);
    mesh_.for_each_neighbor(v, [&](Index w) {
      s.ring.push_back({w, surface_.points[w], surface_.normals[w], surface_.metrics[w]});
    });
    return s;
  }

  Shape shape(const Star& star, const Placed_vertex<Metric>& v) const
  {
    Shape s;
    star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
      const Vector_3 n = ea.cross(eb);
      const double length = n.norm();
      const double q = internal::squared_shape(v.metric, a.metric, b.metric, ea, eb, n).quality();
      s.worst = (std::min)(s.worst, q);
      const Corner_products products(n, length, {&v.normal, &a.normal, &b.normal});
      const bool is_degenerate = unit_normal(ea, eb) == Vector_3::Zero();
      double alignment = is_degenerate ? 1 : products.least / length;
      const bool is_smooth = v.location.kind == Vertex_class::smooth;
      s.flatness = (std::min)(s.flatness, is_smooth && !is_degenerate ? n.dot(v.normal) / length : alignment);
      if (is_anisotropic<Metric> && products.is_smooth && is_thin(ea, eb, n))
        alignment = alignment_of_thin_face(alignment);
      s.alignment = (std::min)(s.alignment, alignment);
    });
    return s;
  }

  /// Whether all faces around the smooth vertex `v` have the quality `good_quality` and are so flat that they can be no
  /// part of a fold: a test without roots and quotients, which nearly all moves pass.
  bool is_good(const Star& star, const Placed_vertex<Metric>& v) const
  {
    return star.for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
      const Vector_3 normal = ea.cross(eb);
      if (!internal::squared_shape(v.metric, a.metric, b.metric, ea, eb, normal).is_at_least(thresholds_.good_quality))
        return false;
      const double squared_area = normal.squaredNorm();
      const auto is_flat_at = [&](const Vector_3& m, double least) {
        const double dot = normal.dot(m);
        return dot > 0 && dot * dot >= least * least * squared_area;
      };
      const bool is_a_smooth = a.normal != Vector_3::Zero(), is_b_smooth = b.normal != Vector_3::Zero();
      if (!is_flat_at(v.normal, (std::max)(flat_alignment, thresholds_.least_flatness)) ||
          (is_a_smooth && !is_flat_at(a.normal, flat_alignment)) ||
          (is_b_smooth && !is_flat_at(b.normal, flat_alignment)))
        return false;
      // with no smooth corner in common, nothing is known of the face behind: it matters unless the edge is a feature
      return is_a_smooth || is_b_smooth || mesh_.is_feature(mesh_.halfedge(a.vertex, b.vertex));
    });
  }

  static double total_quality(const Star& star, const Placed_vertex<Metric>& v)
  {
    double total = 0;
    star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
      total += internal::squared_shape(v.metric, a.metric, b.metric, ea, eb, ea.cross(eb)).quality();
    });
    return total;
  }

  /// Whether `moved` makes good faces all around, or else better ones than before. Diffusion settles where the faces are
  /// good if their metric is nearly the same, or the same but for its scale; where its directions turn, it would leave
  /// good faces for others, so that these must be better together.
  template <class StandsStill>
  bool is_acceptable(Index v, const Star& star, const Placed_vertex<Metric>& moved,
                     Attempt<StandsStill>& attempt) const
  {
    if (is_anisotropic<Metric> && total_quality(star, moved) < total_quality(star, surface_.vertex(v))) return false;
    if (is_good(star, moved)) return true;
    const Shape after = shape(star, moved);
    const Shape before = shape(star, surface_.vertex(v));
    return (after.worst > before.worst * min_improvement || after.worst >= thresholds_.good_quality) &&
           is_upright(v, before, after, moved, attempt);
  }

  /// Whether no face is turned farther from the surface than the limits or than it was.
  bool is_aligned(const Shape& before, const Shape& after) const
  {
    return after.alignment >= least_alignment_after(before.alignment) &&
           after.flatness >= (std::min)(thresholds_.least_flatness, before.flatness);
  }

  /// Whether `moved` neither turns a face away from the surface nor folds it over a neighbour more than is the case.
  /// That takes a look at the vertices behind the ring; if one of them may be moving meanwhile, the move is put off.
  template <class StandsStill>
  bool is_upright(Index v, const Shape& before, const Shape& after, const Placed_vertex<Metric>& moved,
                  Attempt<StandsStill>& attempt) const
  {
    if (!is_aligned(before, after)) return false;
    return is_unfolded(surface_, v, moved.point, attempt.stands_still, attempt.is_put_off);
  }

  /// The displacement of the smooth vertex `v` to the centre of the faces around it, in the tangent plane.
  Vector_3 displacement_to_center(Index v, const Star& star) const
  {
    return Surface_mesh_adaptation::displacement_to_center(
      surface_.points[v], surface_.normals[v], surface_.metrics[v], [&](const auto& add) {
        star.for_each_face([&](const Neighbor& a, const Neighbor& b) { add(a.point, a.metric, b.point, b.metric); });
      });
  }

  /// The displacement of the curve vertex `v` to the centre of the faces around it, along its curve. Each face has a
  /// plane of its own.
  double displacement_along_curve(Index v, const Star& star, const Vector_3& tangent) const
  {
    const Vector_3& p = surface_.points[v];
    Pull pull;
    star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - p, eb = b.point - p, across = ea.cross(eb);
      const double area = across.norm();
      if (!(area > 0)) return;
      const Vector_3 side = pull.add(surface_.metrics[v], a.metric, b.metric, ea, eb, area);
      pull.turned_sides += (across / area).cross(side);
    });
    return pull.displacement(share_of_shape_on_curves).dot(tangent);
  }

  template <class StandsStill>
  bool diffuse(Index v, const Star& star, Attempt<StandsStill>& attempt)
  {
    const Vector_3 t = displacement_to_center(v, star);
    if (!(surface_.metrics[v].length(t) > min_move_)) return false;
    for (const double scale : {relaxation_, relaxation_ / 2, relaxation_ / 4}) {
      const auto moved = surface_.place(surface_.reference().trace(surface_.locations[v], scale * t, true));
      if (is_acceptable(v, star, moved, attempt) && apply(v, star, moved)) return true;
    }
    return false;
  }

  /// The directions in which a vertex may move, orthonormal in its metric: steps in them do not depend on how stretched
  /// the faces are.
  struct Frame
  {
    Vector_3 u;
    Vector_3 v;  ///< zero on curves

    Vector_3 vector(const Vector_2& d) const { return d.x() * u + d.y() * v; }
  };

  Frame frame(const Placed_vertex<Metric>& p) const
  {
    const Metric_tensor_3 m = p.metric.tensor();
    const bool is_smooth = p.location.kind == Vertex_class::smooth;
    Vector_3 u = is_smooth ? p.normal.unitOrthogonal() : surface_.reference().curve_tangent(p.location);
    u /= m.length(u);
    if (!is_smooth) return {u, Vector_3::Zero()};
    Vector_3 v = p.normal.cross(u);
    v -= m.dot(u, v) * u;
    return {u, v / m.length(v)};
  }

  /// `p` moved along the surface, or along its curve, by `d` in the directions of its frame.
  Placed_vertex<Metric> moved(const Placed_vertex<Metric>& p, const Vector_2& d) const
  {
    const Frame f = frame(p);
    if (p.location.kind == Vertex_class::smooth)
      return surface_.place(surface_.reference().trace(p.location, f.vector(d), true));
    return surface_.place(surface_.reference().on_curve(p.location.cell, p.location.u + d.x() * f.u.norm()));
  }

  /// The distortions of the faces around `p` and how they change with it.
  Ring<Linear_function_2> distortions(const Star& star, const Placed_vertex<Metric>& p) const
  {
    const Frame f = frame(p);
    Ring<Linear_function_2> functions;
    star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const Distortion d = face_distortion(p.metric, a.metric, b.metric, a.point - p.point, b.point - p.point);
      functions.push_back({d.value, {d.gradient.dot(f.u), d.gradient.dot(f.v)}});
    });
    return functions;
  }

  /// Whether no face around `v` is worse than `q`.
  bool has_quality(const Star& star, const Placed_vertex<Metric>& v, double q) const
  {
    return star.for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
      return internal::squared_shape(v.metric, a.metric, b.metric, ea, eb, ea.cross(eb)).is_at_least(q);
    });
  }

  /// Whether a face around a vertex that was at `start` turns by more than 90 degrees if it is put at `p`.
  static bool is_turned(const Star& star, const Vector_3& start, const Vector_3& p)
  {
    return !star.for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
      return (a.point - start).cross(b.point - start).dot((a.point - p).cross(b.point - p)) > 0;
    });
  }

  /// Metric length of the longer edge from `p` to those of `ends` that there are; 0 if there are none.
  double longest_edge(const Placed_vertex<Metric>& p, const std::array<Index, 2>& ends) const
  {
    double longest = 0;
    for (const Index w : ends)
      if (w != no_index)
        longest = (std::max)(longest, edge_length(p.metric, surface_.metrics[w], surface_.points[w] - p.point));
    return longest;
  }

  /// Moves `v` to where its worst face is better, if it has a bad one.
  template <class StandsStill>
  bool optimize(Index v, const Star& star, Attempt<StandsStill>& attempt)
  {
    const Placed_vertex<Metric> start = surface_.vertex(v);
    const double enough = good_quality(v);
    if (has_quality(star, start, enough)) return false;
    const Shape before = shape(star, start);
    if (!(before.worst > 0)) return false;
    double radius = 0;
    for (const Neighbor& n : star.ring) radius += start.metric.length(n.point - start.point) / double(star.ring.size());
    // thin faces between two curves would empty parts of these
    const std::array<Index, 2> on_curve = neighbors_on_curve(surface_, v);
    const double longest = (std::max)(balanced_length, longest_edge(start, on_curve));
    Placed_vertex<Metric> best = start;
    minimize_worst(
      best, max_step * radius, max_optimization_rounds, 1 / enough,
      [&](const Placed_vertex<Metric>& x) { return distortions(star, x); },
      [&](const Placed_vertex<Metric>& x, const Vector_2& d) { return moved(x, d); },
      [&](const Placed_vertex<Metric>& x) {
        const Shape s = shape(star, x);
        const bool is_allowed = s.worst > 0 && longest_edge(x, on_curve) <= longest && is_aligned(before, s) &&
                                !is_turned(star, start.point, x.point);
        return is_allowed ? 1 / s.worst : std::numeric_limits<double>::infinity();
      });
    const Shape after = shape(star, best);
    return after.worst > least_gain * before.worst && is_upright(v, before, after, best, attempt) &&
           apply(v, star, best);
  }

  /// Moves a curve vertex to where its two curve edges have the same metric length; if both are about as asked for, only
  /// half-way, and half-way to the centre of the faces around it.
  template <class StandsStill>
  bool slide(Index v, const Star& star, Attempt<StandsStill>& attempt)
  {
    const Index curve = surface_.locations[v].cell;
    const std::array<Index, 2> beside = neighbors_on_curve(surface_, v);
    const Index w1 = beside[0], w0 = beside[1];
    if (w0 == no_index) return false;
    const auto arc0 = surface_.reference().arc(curve, surface_.locations[v], surface_.locations[w0]);
    const auto arc1 = surface_.reference().arc(curve, surface_.locations[v], surface_.locations[w1]);
    const double l0 = surface_.length(v, w0), l1 = surface_.length(v, w1);
    const double d0 = arc0.second - arc0.first, d1 = arc1.second - arc1.first;
    if (!(d0 * d1 < 0) || !(l0 + l1 > 0)) return false;
    // towards the longer side by half of the excess, in units of arc length per metric length
    const double to_middle = l0 > l1 ? d0 * 0.5 * (l0 - l1) / l0 : d1 * 0.5 * (l1 - l0) / l1;
    const Vector_3 tangent = surface_.reference().curve_tangent(surface_.locations[v]);
    const bool is_balanced = (std::max)(l0, l1) < balanced_length && (std::min)(l0, l1) * balanced_length > 1;
    const double d = !is_balanced ? to_middle
                                  : std::clamp(0.5 * (to_middle + displacement_along_curve(v, star, tangent)),
                                               0.4 * (std::min)(d0, d1), 0.4 * (std::max)(d0, d1));
    if (!(surface_.metrics[v].length(d * tangent) >= min_move_)) return false;
    const Shape before = shape(star, surface_.vertex(v));
    const double limit = (std::min)(before.worst, good_quality(v));
    const auto offset = [&](const Placed_vertex<Metric>& p) {
      return (std::max)(offset_of_drawn_curve(surface_, p, surface_.vertex(w0), curve),
                        offset_of_drawn_curve(surface_, p, surface_.vertex(w1), curve));
    };
    for (const double scale : {1.0, 0.5}) {
      const auto moved = surface_.place(surface_.reference().on_curve(curve, arc0.first + scale * d));
      const double after_offset = offset(moved);
      if (after_offset > max_offset_of_drawn && after_offset > offset(surface_.vertex(v))) continue;
      const Shape after = shape(star, moved);
      if (after.worst >= limit && is_upright(v, before, after, moved, attempt) && apply(v, star, moved)) return true;
    }
    return false;
  }

  // Alternating the two kills errors over many faces several times faster, and with the plain step in between also
  // those from face to face, which over-relaxation alone keeps alive.
  static constexpr double over_relaxation = 2.2, plain_relaxation = 1.0;
  static constexpr double share_of_shape_on_curves = 0.7; // where the lengths are looked after by themselves
  static constexpr double balanced_length = 1.25; // of curve edges: the faces beside may pull, but longer chords cut
  static constexpr double min_improvement = 1.0 + 1e-4;
  static constexpr double least_gain = 1.01;       // of optimisation: the factor of the worst quality
  static constexpr double max_step = 0.5;          // of its first step, in mean lengths of the edges at the vertex
  static constexpr int max_optimization_rounds = 5;

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Relocation_thresholds thresholds_;
  double min_move_;
  double relaxation_ = plain_relaxation;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_H

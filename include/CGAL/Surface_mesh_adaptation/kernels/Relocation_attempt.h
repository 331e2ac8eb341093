// SPDX-License-Identifier: GPL-3.0-or-later
//
// One vertex that relocation tries to move: which moves are allowed, and what follows from one that is made. How to
// move it is another idea: `diffusion.h`, `curve_slide.h`, `distortion_descent.h`.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_ATTEMPT_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_ATTEMPT_H

#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Relocation_star.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/folds.h>

#include <algorithm>
#include <cstdint>

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

/// `stands_still(w)` says whether the vertex `w` outside of the one-ring does not move meanwhile.
template <class Surface, class StandsStill>
class Relocation_attempt
{
public:
  using Metric = typename Surface::Metric;
  using Star = Relocation_star<Metric>;
  using Neighbor = typename Star::Neighbor;

  Surface& surface;
  const Index vertex;
  const Star star;
  const double min_move;    ///< metric length below which a move is not worth it
  bool is_put_off = false;  ///< whether a vertex would have to stand still that does not

  Relocation_attempt(Surface& s, Index v, const Relocation_thresholds& thresholds, double least,
                     const StandsStill& stands_still)
    : surface(s), vertex(v), star(s, v), min_move(least), thresholds_(thresholds), stands_still_(stands_still)
  {}

  Placed_vertex<Metric> start() const { return surface.vertex(vertex); }

  /// The quality from which on faces are good enough.
  double good_quality() const
  {
    const bool is_on_curve = surface.vertex_class(vertex) == Vertex_class::curve;
    return is_on_curve ? thresholds_.good_quality_on_curves : thresholds_.good_quality;
  }

  /// Whether `moved` makes good faces all around, or else better ones than before. Diffusion settles where the faces
  /// are good if their metric is nearly the same, or the same but for its scale; where its directions turn, it would
  /// leave good faces for others, so that these must be better together.
  bool is_acceptable(const Placed_vertex<Metric>& moved)
  {
    if (is_anisotropic<Metric> && star.total_quality(moved) < star.total_quality(start())) return false;
    if (is_good(moved)) return true;
    const Star_shape after = star.shape(moved);
    const Star_shape before = star.shape(start());
    return (after.worst > before.worst * min_improvement || after.worst >= thresholds_.good_quality) &&
           is_upright(before, after, moved);
  }

  /// Whether `moved`, which is due whatever the faces gain, leaves these about as good as they are.
  bool is_harmless(const Placed_vertex<Metric>& moved)
  {
    if (is_good(moved)) return true;
    const Star_shape after = star.shape(moved), before = star.shape(start());
    return after.worst >= (std::min)(harmless_loss * before.worst, thresholds_.good_quality) &&
           is_upright(before, after, moved);
  }

  /// Whether no face is turned farther from the surface than the limits or than it was.
  bool is_aligned(const Star_shape& before, const Star_shape& after) const
  {
    return after.alignment >= least_alignment_after(before.alignment) &&
           after.flatness >= (std::min)(thresholds_.least_flatness, before.flatness);
  }

  /// Whether `moved` neither turns a face away from the surface nor folds it over a neighbour more than is the case.
  /// That takes a look at the vertices behind the ring; if one of them may be moving meanwhile, the move is put off.
  bool is_upright(const Star_shape& before, const Star_shape& after, const Placed_vertex<Metric>& moved)
  {
    return is_aligned(before, after) && is_unfolded(surface, vertex, moved.point, stands_still_, is_put_off);
  }

  /// Moves the vertex, unless that leaves the tolerance.
  bool apply(const Placed_vertex<Metric>& moved)
  {
    if (surface.tolerance) return apply_within_tolerance(moved);
    set(moved);
    return true;
  }

private:
  static constexpr double min_improvement = 1.0 + 1e-4;
  static constexpr double harmless_loss = 0.9; // what is left of the worst quality

  /// Whether all faces around the smooth vertex have the quality `good_quality` and are so flat that they can be no
  /// part of a fold: a test without roots and quotients, which nearly all moves pass.
  bool is_good(const Placed_vertex<Metric>& v) const
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
      const Mesh_view& mesh = surface.mesh;
      return is_a_smooth || is_b_smooth || mesh.is_feature(mesh.halfedge(a.vertex, b.vertex));
    });
  }

  void set(const Placed_vertex<Metric>& moved)
  {
    surface.set(vertex, moved);
    activate_around(moved);
  }

  bool apply_within_tolerance(const Placed_vertex<Metric>& moved)
  {
    const Mesh_view& mesh = surface.mesh;
    const Ring<Index> old_faces = surface.faces_around(vertex);
    Ring<Triangle_points> faces;
    mesh.for_each_outgoing(vertex, [&](Index h) {
      faces.push_back({moved.point, surface.points[mesh.target(h)], surface.points[mesh.apex(h)]});
    });
    Covered_points::Owners owners;
    if (!surface.tolerance->are_covered(old_faces, faces, owners) || !keeps_near(moved)) return false;
    surface.tolerance->hand_over(old_faces, owners);
    set(moved);
    return true;
  }

  /// Whether the faces around stay within the tolerance of the input.
  bool keeps_near(const Placed_vertex<Metric>& moved) const
  {
    return star.for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
      return surface.tolerance->is_kept({moved.location, moved.point}, surface.corner(a.vertex),
                                        surface.corner(b.vertex));
    });
  }

  /// The neighbours may move now, and edges around be split where they could not be before; the other kernels look again
  /// only where the move left something for them.
  void activate_around(const Placed_vertex<Metric>& moved)
  {
    constexpr std::uint8_t always = std::uint8_t(Activity::relocate) | std::uint8_t(Activity::refine);
    std::uint8_t of_all = always;
    if (moved.location.kind == Vertex_class::curve) of_all |= std::uint8_t(Activity::simplify);
    star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const std::uint8_t kernels = std::uint8_t(always | kernels_with_work(moved, a, b));
      activate(surface, a.vertex, kernels);
      if (kernels != always || !star.is_closed) activate(surface, b.vertex, kernels); // else b is the next a
      of_all |= kernels;
    });
    activate(surface, vertex, of_all);
  }

  /// Other kernels that may have something to do at the face of `moved`, `a` and `b`.
  static std::uint8_t kernels_with_work(const Placed_vertex<Metric>& moved, const Neighbor& a, const Neighbor& b)
  {
    const Vector_3 ea = a.point - moved.point, eb = b.point - moved.point;
    std::uint8_t kernels = 0;
    if (is_shorter(moved.metric, a.metric, ea, min_unit_length) ||
        is_shorter(moved.metric, b.metric, eb, min_unit_length))
      kernels |= std::uint8_t(Activity::simplify);
    if (!internal::squared_shape(moved.metric, a.metric, b.metric, ea, eb, ea.cross(eb))
           .is_at_least(max_improvable_quality))
      kernels |= std::uint8_t(Activity::swap);
    return kernels;
  }

  const Relocation_thresholds& thresholds_;
  const StandsStill& stands_still_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_ATTEMPT_H

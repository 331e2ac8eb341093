// SPDX-License-Identifier: GPL-3.0-or-later
//
// Slides: move a vertex along its feature curve to balance the metric lengths on both sides, and where these are
// balanced also for the faces beside it.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CURVE_SLIDE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CURVE_SLIDE_H

#include <CGAL/Surface_mesh_adaptation/kernels/Relocation_attempt.h>
#include <CGAL/Surface_mesh_adaptation/kernels/centering.h>
#include <CGAL/Surface_mesh_adaptation/kernels/curve_spacing.h>

#include <algorithm>
#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// The displacement of the curve vertex to the centre of the faces around it, along its curve. Each face has a plane of
/// its own.
template <class Attempt>
double displacement_along_curve(const Attempt& attempt, const Vector_3& tangent)
{
  using Neighbor = typename Attempt::Neighbor;
  constexpr double share_of_shape = 0.7; // where the lengths are looked after by themselves
  const Vector_3& p = attempt.surface.points[attempt.vertex];
  Pull pull;
  attempt.star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
    const Vector_3 ea = a.point - p, eb = b.point - p, across = ea.cross(eb);
    const double area = across.norm();
    if (!(area > 0)) return;
    const Vector_3 side = pull.add(attempt.surface.metrics[attempt.vertex], a.metric, b.metric, ea, eb, area);
    pull.turned_sides += (across / area).cross(side);
  });
  return pull.displacement(share_of_shape).dot(tangent);
}

/// By what arc length the curve vertex slides from between its neighbours on the curve, `ends`: to where the edges to
/// them have the same metric length; if both are about as asked for, only half-way, and half-way to the centre of the
/// faces around it. 0: not at all.
template <class Attempt>
double length_of_slide(const Attempt& attempt, const std::array<Index, 2>& ends, const Vector_3& tangent)
{
  const auto& surface = attempt.surface;
  const Index v = attempt.vertex;
  const auto arc_to = [&](Index w) {
    const auto arc = surface.reference().arc(surface.locations[v].cell, surface.locations[v], surface.locations[w]);
    return arc.second - arc.first;
  };
  const double d0 = arc_to(ends[0]), d1 = arc_to(ends[1]);
  const double l0 = surface.length(v, ends[0]), l1 = surface.length(v, ends[1]);
  if (!(d0 * d1 < 0) || !(l0 + l1 > 0)) return 0;
  // towards the longer side by half of the excess, in units of arc length per metric length
  const double to_middle = l0 > l1 ? d0 * 0.5 * (l0 - l1) / l0 : d1 * 0.5 * (l1 - l0) / l1;
  const bool is_balanced = (std::max)(l0, l1) < balanced_length && (std::min)(l0, l1) * balanced_length > 1;
  if (!is_balanced) return to_middle;
  return std::clamp(0.5 * (to_middle + displacement_along_curve(attempt, tangent)), 0.4 * (std::min)(d0, d1),
                    0.4 * (std::max)(d0, d1));
}

} // namespace internal

/// Slides a curve vertex between its two neighbours on the curve.
template <class Attempt>
bool slide(Attempt& attempt)
{
  auto& surface = attempt.surface;
  const Index v = attempt.vertex, curve = surface.locations[v].cell;
  const auto [w1, w0] = neighbors_on_curve(surface, v);
  if (w0 == no_index) return false;
  const Vector_3 tangent = surface.reference().curve_tangent(surface.locations[v]);
  const double d = internal::length_of_slide(attempt, {w0, w1}, tangent);
  if (!(surface.metrics[v].length(d * tangent) >= attempt.min_move)) return false;
  const auto start = attempt.start();
  const Star_shape before = attempt.star.shape(start);
  const double limit = (std::min)(before.worst, attempt.good_quality());
  const auto a = surface.vertex(w0), b = surface.vertex(w1);
  const auto offset = [&](const auto& p) {
    return (std::max)(offset_of_drawn_curve(surface, p, a, curve), offset_of_drawn_curve(surface, p, b, curve));
  };
  const double at = surface.reference().arc(curve, surface.locations[v], surface.locations[w0]).first;
  for (const double scale : {1.0, 0.5}) {
    const auto moved = surface.place(surface.reference().on_curve(curve, at + scale * d));
    const double after_offset = offset(moved);
    if (after_offset > max_offset_of_drawn && after_offset > offset(start)) continue;
    const Star_shape after = attempt.star.shape(moved);
    if (after.worst >= limit && attempt.is_upright(before, after, moved) && attempt.apply(moved)) return true;
  }
  return false;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CURVE_SLIDE_H

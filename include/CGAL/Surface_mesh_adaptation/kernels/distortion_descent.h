// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optimisation: moves a vertex on the surface, or along its curve, to where the worst distortion of the faces around it
// is least (minimize_worst.h).

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DISTORTION_DESCENT_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DISTORTION_DESCENT_H

#include <CGAL/Surface_mesh_adaptation/kernels/Relocation_attempt.h>
#include <CGAL/Surface_mesh_adaptation/kernels/curve_spacing.h>
#include <CGAL/Surface_mesh_adaptation/numerics/minimize_worst.h>

#include <algorithm>
#include <array>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The directions in which a vertex may move, orthonormal in its metric: steps in them do not depend on how stretched
/// the faces are.
struct Relocation_frame
{
  Vector_3 u;
  Vector_3 v;  ///< zero on curves

  template <class Surface>
  Relocation_frame(const Surface& surface, const Placed_vertex<typename Surface::Metric>& p)
  {
    const Metric_tensor_3 m = p.metric.tensor();
    const bool is_smooth = p.location.kind == Vertex_class::smooth;
    u = is_smooth ? p.normal.unitOrthogonal() : surface.reference().curve_tangent(p.location);
    u /= m.length(u);
    v = Vector_3::Zero();
    if (!is_smooth) return;
    v = p.normal.cross(u);
    v -= m.dot(u, v) * u;
    v /= m.length(v);
  }

  Vector_3 vector(const Vector_2& d) const { return d.x() * u + d.y() * v; }
};

/// `p` moved along the surface, or along its curve, by `d` in the directions of its frame.
template <class Surface>
auto moved_in_frame(const Surface& surface, const Placed_vertex<typename Surface::Metric>& p, const Vector_2& d)
{
  const Relocation_frame frame(surface, p);
  const auto& reference = surface.reference();
  if (p.location.kind == Vertex_class::smooth)
    return surface.place(reference.trace(p.location, frame.vector(d), true));
  return surface.place(reference.on_curve(p.location.cell, p.location.u + d.x() * frame.u.norm()));
}

/// The distortions of the faces around `p` and how they change with it.
template <class Surface>
Ring<Linear_function_2> distortions(const Surface& surface, const Relocation_star<typename Surface::Metric>& star,
                                    const Placed_vertex<typename Surface::Metric>& p)
{
  using Neighbor = typename Relocation_star<typename Surface::Metric>::Neighbor;
  const Relocation_frame frame(surface, p);
  Ring<Linear_function_2> functions;
  star.for_each_face([&](const Neighbor& a, const Neighbor& b) {
    const Distortion d = face_distortion(p.metric, a.metric, b.metric, a.point - p.point, b.point - p.point);
    functions.push_back({d.value, {d.gradient.dot(frame.u), d.gradient.dot(frame.v)}});
  });
  return functions;
}

/// Metric length of the longer edge from `p` to those of `ends` that there are; 0 if there are none.
template <class Surface>
double longest_edge(const Surface& surface, const Placed_vertex<typename Surface::Metric>& p,
                    const std::array<Index, 2>& ends)
{
  double longest = 0;
  for (const Index w : ends)
    if (w != no_index)
      longest = (std::max)(longest, edge_length(p.metric, surface.metrics[w], surface.points[w] - p.point));
  return longest;
}

} // namespace internal

/// Moves the vertex to where its worst face is better, if it has a bad one.
template <class Attempt>
bool descend(Attempt& attempt)
{
  constexpr double least_gain = 1.01; // the factor of the worst quality
  constexpr double max_step = 0.5;    // the first one, in mean lengths of the edges at the vertex
  constexpr int max_rounds = 5;
  using Vertex = Placed_vertex<typename Attempt::Metric>;
  const auto& surface = attempt.surface;
  const auto& star = attempt.star;
  const Vertex start = attempt.start();
  const double enough = attempt.good_quality();
  if (star.has_quality(start, enough)) return false;
  const Star_shape before = star.shape(start);
  if (!(before.worst > 0)) return false;
  double radius = 0;
  for (const auto& n : star.ring) radius += start.metric.length(n.point - start.point) / double(star.ring.size());
  // thin faces between two curves would empty parts of these
  const std::array<Index, 2> on_curve = neighbors_on_curve(surface, attempt.vertex);
  const double longest = (std::max)(balanced_length, internal::longest_edge(surface, start, on_curve));
  Vertex best = start;
  minimize_worst(
    best, max_step * radius, max_rounds, 1 / enough,
    [&](const Vertex& x) { return internal::distortions(surface, star, x); },
    [&](const Vertex& x, const Vector_2& d) { return internal::moved_in_frame(surface, x, d); },
    [&](const Vertex& x) {
      const Star_shape s = star.shape(x);
      const bool is_allowed = s.worst > 0 && internal::longest_edge(surface, x, on_curve) <= longest &&
                              attempt.is_aligned(before, s) && !star.is_turned(start.point, x.point);
      return is_allowed ? 1 / s.worst : std::numeric_limits<double>::infinity();
    });
  const Star_shape after = star.shape(best);
  return after.worst > least_gain * before.worst && attempt.is_upright(before, after, best) && attempt.apply(best);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DISTORTION_DESCENT_H

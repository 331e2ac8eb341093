// SPDX-License-Identifier: GPL-3.0-or-later
//
// Diffusion: moves a smooth vertex towards the centre of mass of the surrounding faces, weighted by the density of the
// metric (paper, section 3, equation 1), and towards where these would be equilateral; over-relaxed, with a step that
// is halved until no face is made worse than allowed. Out of lattices of right-angled faces, which it leaves in balance,
// vertices go at random.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DIFFUSION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DIFFUSION_H

#include <CGAL/Surface_mesh_adaptation/kernels/Relocation_attempt.h>
#include <CGAL/Surface_mesh_adaptation/kernels/centering.h>
#include <CGAL/Surface_mesh_adaptation/kernels/lattice.h>

namespace CGAL {
namespace Surface_mesh_adaptation {

// Alternating the two kills errors over many faces several times faster, and with the plain step in between also
// those from face to face, which over-relaxation alone keeps alive.
constexpr double over_relaxation = 2.2, plain_relaxation = 1.0;

/// Moves a smooth vertex in the middle of a lattice, whose faces may become worse for a while.
template <class Attempt>
bool leave_lattice(Attempt& attempt)
{
  constexpr double least_quality = 0.2; // meanwhile
  const auto start = attempt.start();
  if (!internal::is_in_lattice(attempt.star, start)) return false;
  auto& surface = attempt.surface;
  const Vector_3 step = internal::step_out_of_lattice(attempt.star, start, attempt.vertex);
  const auto moved = surface.place(surface.reference().trace(start.location, step, true));
  return attempt.star.has_quality(moved, least_quality) &&
         attempt.is_upright(attempt.star.shape(start), attempt.star.shape(moved), moved) && attempt.apply(moved);
}

/// Moves the smooth vertex by `relaxation` times its way to the centre of the faces around it, or less.
template <class Attempt>
bool diffuse(Attempt& attempt, double relaxation)
{
  using Neighbor = typename Attempt::Neighbor;
  auto& surface = attempt.surface;
  const Index v = attempt.vertex;
  const Vector_3 t = displacement_to_center(
    surface.points[v], surface.normals[v], surface.metrics[v], [&](const auto& add) {
      attempt.star.for_each_face(
        [&](const Neighbor& a, const Neighbor& b) { add(a.point, a.metric, b.point, b.metric); });
    });
  if (!(surface.metrics[v].length(t) > attempt.min_move)) return leave_lattice(attempt);
  for (const double scale : {relaxation, relaxation / 2, relaxation / 4}) {
    const auto moved = surface.place(surface.reference().trace(surface.locations[v], scale * t, true));
    if (attempt.is_acceptable(moved) && attempt.apply(moved)) return true;
  }
  return false;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DIFFUSION_H

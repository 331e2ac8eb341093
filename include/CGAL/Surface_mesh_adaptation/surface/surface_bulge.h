// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the smooth surface over the faces of the input leaves these.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SURFACE_BULGE_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SURFACE_BULGE_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Patches bulge by less than this share of the longest edge of their face.
constexpr double largest_bulge_of_patches = 0.25;

/// The largest distance between the patches of `reference` and its faces, at the centroids and the middles of the
/// edges, if it is above `least`: faces that are too short for that are left out, and with them the estimates of their
/// jets.
/// \returns 0 if it is not
/// \par Complexity
/// O(n) for the lengths, and some microseconds for each face that is not left out
template <class Execution, class Reference>
double surface_bulge(const Execution& execution, const Reference& reference, double least)
{
  constexpr double places[4][2] = {{1.0 / 3, 1.0 / 3}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  return reduce(execution, reference.mesh.number_of_faces(), 0.0, [&](std::size_t f) {
    const auto corner = [&](std::size_t i) -> const Vector_3& {
      return reference.points[reference.mesh.corner[3 * f + i % 3]];
    };
    double longest = 0, largest = 0;
    for (std::size_t i = 0; i < 3; ++i) longest = (std::max)(longest, (corner(i + 1) - corner(i)).norm());
    if (largest_bulge_of_patches * longest <= least) return 0.0;
    for (const auto& p : places) {
      const Location l{Vertex_class::smooth, Index(f), p[0], p[1]};
      largest = (std::max)(largest, (reference.evaluate(l).position - reference.flat_point(l)).norm());
    }
    return largest > least ? largest : 0.0;
  }, [](double a, double b) { return (std::max)(a, b); });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SURFACE_BULGE_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lengths that say nothing of the shape of a part.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_NEGLIGIBLE_LENGTH_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_NEGLIGIBLE_LENGTH_H

#include <CGAL/Surface_mesh_adaptation/numerics/bounding_box.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// What is shorter, in faces that are far longer, is none of the shape: up to `most`, it is what the rounding of the
/// coordinates explains, and what the kernels of CAD systems take for nothing.
template <class Execution>
double negligible_length(const Execution& execution, const std::vector<Vector_3>& points, double most)
{
  constexpr double roundings = 4; // each of two points may have been rounded twice
  constexpr double of_kernels = 1e-6; // of the diagonal
  const double rounding = coordinate_rounding(execution, points), diagonal = diagonal_of_bounding_box(points);
  return (std::min)(most, (std::max)(roundings * rounding, of_kernels * diagonal));
}

/// The same, in lengths of the longest edge of a face.
constexpr double negligible_share = 1e-3;

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_NEGLIGIBLE_LENGTH_H

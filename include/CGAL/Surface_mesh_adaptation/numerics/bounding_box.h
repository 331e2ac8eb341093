// SPDX-License-Identifier: GPL-3.0-or-later
//
// The size of a set of points.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_BOUNDING_BOX_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_BOUNDING_BOX_H

#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// \pre there is a point
inline double diagonal_of_bounding_box(const std::vector<Vector_3>& points)
{
  Vector_3 low = points[0], high = points[0];
  for (const Vector_3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_BOUNDING_BOX_H

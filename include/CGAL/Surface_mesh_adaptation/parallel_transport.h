// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parallel transport over a short step of a surface of which the normals at both ends are known.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_PARALLEL_TRANSPORT_H
#define CGAL_SURFACE_MESH_ADAPTATION_PARALLEL_TRANSPORT_H

#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The rotation of least angle that takes the unit vector `from` to the unit vector `to`:
/// `c I + [x] + x x^T / (1 + c)` with `x = from x to`, `c = from . to`; the identity if they are opposite, where it is
/// not unique. As a transport it is exact on spheres and of second order globally on other surfaces.
inline Matrix_3 minimal_rotation(const Vector_3& from, const Vector_3& to)
{
  const double c = from.dot(to);
  if (c < -1 + 1e-12) return Matrix_3::Identity();
  const Vector_3 x = from.cross(to);
  Matrix_3 r = x * x.transpose() / (1 + c);
  r.diagonal().array() += c;
  r(0, 1) -= x[2]; r(1, 0) += x[2];
  r(0, 2) += x[1]; r(2, 0) -= x[1];
  r(1, 2) -= x[0]; r(2, 1) += x[0];
  return r;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_PARALLEL_TRANSPORT_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well linear functions on the faces of a mesh follow a function.

#ifndef TEST_SURFACE_MESH_ADAPTATION_INTERPOLATION_ERROR_H
#define TEST_SURFACE_MESH_ADAPTATION_INTERPOLATION_ERROR_H

#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/fields/metric_normalization.h>

#include <cmath>

namespace analytic {

namespace SMA = CGAL::Surface_mesh_adaptation;

/// Norms over the faces of a mesh.
struct Interpolation_error
{
  double l1 = 0;
  double l2 = 0;
};

/// The error of the linear interpolation of `u`, by the quadrature of degree 5. For a mesh of a curved surface `u` is
/// to be constant along the normals of the surface, so that points of the faces stand for points of the surface.
template <class F>
Interpolation_error interpolation_error(const shapes::Soup& mesh, const F& u)
{
  const SMA::internal::Triangle_quadrature quadrature;
  Interpolation_error error;
  for (const shapes::Triangle& t : mesh.triangles) {
    const SMA::Vector_3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double ua = u(a), ub = u(b), uc = u(c), area = (b - a).cross(c - a).norm() / 2;
    for (std::size_t k = 0; k < quadrature.size; ++k) {
      const auto& w = quadrature.nodes[k];
      const double e = std::abs(w[0] * ua + w[1] * ub + w[2] * uc - u(w[0] * a + w[1] * b + w[2] * c));
      error.l1 += quadrature.weights[k] * area * e;
      error.l2 += quadrature.weights[k] * area * e * e;
    }
  }
  error.l2 = std::sqrt(error.l2);
  return error;
}

} // namespace analytic

#endif // TEST_SURFACE_MESH_ADAPTATION_INTERPOLATION_ERROR_H

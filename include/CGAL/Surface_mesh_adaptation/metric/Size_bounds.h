// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounds of the sizes and of the anisotropy of a metric.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_SIZE_BOUNDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_SIZE_BOUNDS_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Largest ratio of the sizes of a metric at one point, unless said otherwise.
constexpr double default_max_anisotropy = 1000;

/// The tensor with the eigenvectors of `m`, and its eigenvalues in absolute value and raised to at least the largest
/// over `max_anisotropy` squared: with 1, a multiple of the identity. Zero stays zero, anything else becomes positive
/// definite. Commutes with scaling. \pre `max_anisotropy >= 1`
inline Metric_tensor_3 with_bounded_anisotropy(const Metric_tensor_3& m, double max_anisotropy)
{
  const Eigen_decomposition_3 e = eigen_decomposition(m);
  const Vector_3 absolute = e.values.cwiseAbs();
  const double largest = absolute.maxCoeff();
  if (max_anisotropy <= 1) return Metric_tensor_3(largest, 0, largest, 0, 0, largest);
  return metric_tensor(absolute.cwiseMax(largest / (max_anisotropy * max_anisotropy)), e.vectors);
}

/// The smallest and the largest size that a metric may ask for.
struct Size_bounds
{
  double hmin, hmax;

  /// \throws Invalid_parameter_error unless `0 < hmin <= hmax` and both are finite
  Size_bounds(double hmin_, double hmax_) : hmin(hmin_), hmax(hmax_)
  {
    if (!(hmin > 0) || !std::isfinite(hmax)) throw Invalid_parameter_error("hmin and hmax must be positive and finite");
    if (hmin > hmax) throw Invalid_parameter_error("hmin is larger than hmax");
  }

  /// Keeps the eigenvalue of a metric, an inverse squared size, within the bounds.
  double clamped(double eigenvalue) const
  {
    return (std::min)(1 / (hmin * hmin), (std::max)(1 / (hmax * hmax), eigenvalue));
  }
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_SIZE_BOUNDS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Metrics that are tightened around some points, with a gradation from there.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_TIGHTENED_METRIC_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_TIGHTENED_METRIC_H

#include <CGAL/Surface_mesh_adaptation/fields/Graded_bounds.h>
#include <CGAL/Surface_mesh_adaptation/fields/Metric_background.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// What sizes are multiplied with by tightening, at least: where a third is not enough, sizes are not what is missing.
constexpr double least_factor_of_tightening = 1.0 / 3;

/// The metric `m` of the point `p`, tightened: `bounds` are those of its size.
inline Isotropic_metric tightened(const Isotropic_metric& m, const Graded_bounds& bounds, const Vector_3& p)
{
  if (bounds.empty()) return m;
  const double size = 1 / m.inverse_size, bound = bounds.least(p, size);
  return bound < size ? Isotropic_metric{1 / bound} : m;
}

/// The same for tensors: `bounds` are those of a factor of all sizes, so that directions stay.
inline Anisotropic_metric tightened(const Anisotropic_metric& m, const Graded_bounds& bounds, const Vector_3& p)
{
  const double factor = bounds.least(p, 1);
  return factor < 1 ? scaled(m, 1 / (factor * factor)) : m;
}

/// What makes the size at `p`, which is that of `m` up to now bounded by `bounds`, `factor` times as large.
inline Graded_bounds::Source tightening(const Isotropic_metric& m, const Graded_bounds& bounds, const Vector_3& p,
                                        double factor, const Metric_aims& aims)
{
  const double size = 1 / m.inverse_size;
  return {p, (std::max)({factor * bounds.least(p, size), least_factor_of_tightening * size, aims.hmin}),
          std::log(aims.gradation)};
}

/// The same for tensors. Factors grow as they may along the largest size, more slowly than they may along others.
inline Graded_bounds::Source tightening(const Anisotropic_metric& m, const Graded_bounds& bounds, const Vector_3& p,
                                        double factor, const Metric_aims& aims)
{
  const Vector_3 eigenvalues = eigen_decomposition(m.m).values;
  const double smallest = 1 / std::sqrt(eigenvalues[2]), largest = 1 / std::sqrt(eigenvalues[0]);
  return {p, (std::max)({factor * bounds.least(p, 1), least_factor_of_tightening, aims.hmin / smallest}),
          std::log(aims.gradation) / largest};
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_TIGHTENED_METRIC_H

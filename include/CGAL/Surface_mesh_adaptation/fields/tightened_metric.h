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

/// Bounds of what a metric is at points: of the size of isotropic ones; of tensors those of a factor of all sizes, so that
/// directions stay. Where they contradict each other, the lower ones count.
struct Size_limits
{
  Graded_bounds upper;
  Graded_bounds negated_lower; ///< lower bounds fall with the distance: their negatives grow

  bool empty() const { return upper.empty() && negated_lower.empty(); }

  double operator()(const Vector_3& p, double value) const { return -negated_lower.least(p, -upper.least(p, value)); }
};

/// What `Size_limits` bound of a metric.
inline double limited_value(const Isotropic_metric& m) { return 1 / m.inverse_size; }
inline double limited_value(const Anisotropic_metric&) { return 1; }

/// How fast that may grow in space. Factors of tensors grow as they may along the largest size, more slowly than they may
/// along others.
inline double slope(const Isotropic_metric&, double gradation) { return std::log(gradation); }

inline double slope(const Anisotropic_metric& m, double gradation)
{
  return std::log(gradation) * std::sqrt(eigen_decomposition(m.m).values[0]);
}

/// The metric `m` of the point `p` within `limits`.
inline Isotropic_metric limited(const Isotropic_metric& m, const Size_limits& limits, const Vector_3& p)
{
  if (limits.empty()) return m;
  const double size = limited_value(m), bounded = limits(p, size);
  return bounded != size ? Isotropic_metric{1 / bounded} : m;
}

inline Anisotropic_metric limited(const Anisotropic_metric& m, const Size_limits& limits, const Vector_3& p)
{
  const double factor = limits(p, 1);
  return factor != 1 ? scaled(m, 1 / (factor * factor)) : m;
}

/// The value of the smallest size that is allowed.
inline double least_value(const Isotropic_metric&, double hmin) { return hmin; }

inline double least_value(const Anisotropic_metric& m, double hmin)
{
  return hmin * std::sqrt(eigen_decomposition(m.m).values[2]);
}

/// How far a metric may be tightened, and how fast sizes grow from there.
struct Limits_of_tightening
{
  double least_factor; ///< of the sizes that are asked for
  double hmin;         ///< the smallest size
  double gradation;    ///< at most 1: sizes do not grow
};

/// What makes the size at `p`, which is that of `m` up to now within `limits`, `factor` times as large.
template <class Metric>
Graded_bounds::Source tightening(const Metric& m, const Size_limits& limits, const Vector_3& p, double factor,
                                 const Limits_of_tightening& allowed)
{
  const double value = limited_value(m);
  return {p, (std::max)({factor * limits(p, value), allowed.least_factor * value, least_value(m, allowed.hmin)}),
          slope(m, allowed.gradation)};
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_TIGHTENED_METRIC_H

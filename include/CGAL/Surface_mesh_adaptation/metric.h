// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lengths and qualities in a metric given at the vertices, for isotropic and anisotropic metrics alike.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_H

#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// An isotropic metric: one size, kept as its inverse because lengths are all that is asked of it.
struct Isotropic_metric
{
  double inverse_size = 1;

  double length(const Vector_3& e) const { return inverse_size * e.norm(); }
  /// Number of unit areas per area of space.
  double density() const { return inverse_size * inverse_size; }
  Metric_tensor_3 tensor() const { return Metric_tensor_3::isotropic(1 / inverse_size); }
};

/// A full metric tensor at a vertex.
struct Anisotropic_metric
{
  Metric_tensor_3 m;

  double length(const Vector_3& e) const { return m.length(e); }
  const Metric_tensor_3& tensor() const { return m; }
};

/// The interval of metric lengths that count as "as asked for".
constexpr double min_unit_length = 0.70710678118654752;
constexpr double max_unit_length = 1.41421356237309505;

constexpr double square_root_of_3 = 1.73205080756887729;

/// Metric length of the edge `e` between vertices with metrics `a` and `b`: the trapezoidal rule.
template <class Metric>
double edge_length(const Metric& a, const Metric& b, const Vector_3& e)
{
  return 0.5 * (a.length(e) + b.length(e));
}

inline double edge_length(const Isotropic_metric& a, const Isotropic_metric& b, const Vector_3& e)
{
  return 0.5 * (a.inverse_size + b.inverse_size) * e.norm();
}

/// Quality of a triangle with edge vectors `e1`, `e2` from its first corner and twice the area `double_area`: 1 if
/// equilateral in the mean metric of its corners, 0 if degenerate.
inline double face_quality(const Isotropic_metric&, const Isotropic_metric&, const Isotropic_metric&,
                           const Vector_3& e1, const Vector_3& e2, double double_area)
{
  const double sum = e1.squaredNorm() + e2.squaredNorm() - e1.dot(e2);
  return sum > 0 ? square_root_of_3 * double_area / sum : 0;
}

inline double face_quality(const Anisotropic_metric& a, const Anisotropic_metric& b, const Anisotropic_metric& c,
                           const Vector_3& e1, const Vector_3& e2, double)
{
  const Metric_tensor_3 mean = a.m + b.m + c.m; // times 3: quality does not depend on the scale
  const Vector_3 m1 = mean * e1, m2 = mean * e2;
  const double e11 = e1.dot(m1), e12 = e1.dot(m2), e22 = e2.dot(m2);
  const double det = e11 * e22 - e12 * e12, sum = e11 + e22 - e12;
  return det > 0 && sum > 0 ? std::sqrt(3 * det) / sum : 0;
}

template <class Metric>
double face_quality(const Metric& a, const Metric& b, const Metric& c, const Vector_3& e1, const Vector_3& e2)
{
  return face_quality(a, b, c, e1, e2, e1.cross(e2).norm());
}

/// Relative density of the metric at three corners over a triangle, for weighting its area.
inline double face_density(const Isotropic_metric& a, const Isotropic_metric& b, const Isotropic_metric& c,
                           const Vector_3&, const Vector_3&, double area)
{
  return area * (a.density() + b.density() + c.density());
}

inline double face_density(const Anisotropic_metric& a, const Anisotropic_metric& b, const Anisotropic_metric& c,
                           const Vector_3& e1, const Vector_3& e2, double)
{
  const Metric_tensor_3 sum = a.m + b.m + c.m;
  const Vector_3 m1 = sum * e1, m2 = sum * e2;
  const double e12 = e1.dot(m2);
  return std::sqrt((std::max)(0.0, e1.dot(m1) * e2.dot(m2) - e12 * e12));
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_H

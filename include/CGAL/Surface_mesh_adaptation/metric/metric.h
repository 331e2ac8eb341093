// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lengths and qualities in a metric given at the vertices, for isotropic and anisotropic metrics alike.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_H

#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

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

  friend bool operator==(const Isotropic_metric& a, const Isotropic_metric& b) { return a.inverse_size == b.inverse_size; }
};

/// A full metric tensor at a vertex.
struct Anisotropic_metric
{
  Metric_tensor_3 m;

  double length(const Vector_3& e) const { return m.length(e); }
  double squared_length(const Vector_3& e) const { return m.squared_length(e); }
  const Metric_tensor_3& tensor() const { return m; }

  friend bool operator==(const Anisotropic_metric& a, const Anisotropic_metric& b) { return a.m == b.m; }
};

/// The metric in which areas are `factor` times as large.
inline Isotropic_metric scaled(const Isotropic_metric& m, double factor)
{
  return {std::sqrt(factor) * m.inverse_size};
}

inline Anisotropic_metric scaled(const Anisotropic_metric& a, double factor) { return {factor * a.m}; }

/// The interval of metric lengths that count as "as asked for".
constexpr double min_unit_length = 0.70710678118654752;
constexpr double max_unit_length = 1.41421356237309505;

/// Whether lengths may change with the direction. Where that changes along an edge, as across a curved layer, its length
/// is not proportional to it: the halves of an edge may have a quarter of its length each.
template <class Metric>
constexpr bool is_anisotropic = std::is_same<Metric, Anisotropic_metric>::value;

/// By how much a length misses 1, as a ratio: the same for its inverse.
inline double misfit(double length)
{
  const double l = std::log(length);
  return l * l;
}

/// The mean misfit of some edges.
class Mean_misfit
{
public:
  void add(double length)
  {
    sum_ += misfit(length);
    ++n_;
  }

  /// Whether the mean is at most `factor` times that of `other`; always for no edges.
  bool is_at_most(double factor, const Mean_misfit& other) const { return sum_ * other.n_ <= factor * other.sum_ * n_; }

private:
  double sum_ = 0;
  int n_ = 0;
};

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

/// `edge_length(a, b, e) < length`, without a root where that is clear.
template <class Metric>
bool is_shorter(const Metric& a, const Metric& b, const Vector_3& e, double length)
{
  return (a.squared_length(e) < length * length || b.squared_length(e) < length * length) && edge_length(a, b, e) < length;
}

inline bool is_shorter(const Isotropic_metric& a, const Isotropic_metric& b, const Vector_3& e, double length)
{
  const double inverse_size = 0.5 * (a.inverse_size + b.inverse_size);
  return inverse_size * inverse_size * e.squaredNorm() < length * length;
}

namespace internal {

/// A third of the squared quality is `squared_double_area / half_sum^2`, with the area and half the sum of the squared
/// edge lengths in the metric.
struct Squared_shape
{
  double squared_double_area, half_sum;

  double quality() const
  {
    return squared_double_area > 0 && half_sum > 0 ? std::sqrt(3 * squared_double_area) / half_sum : 0;
  }

  /// `quality() >= q`, without a root.
  bool is_at_least(double q) const { return 3 * squared_double_area >= q * q * half_sum * half_sum; }
};

/// Shape of a triangle with edge vectors `e1`, `e2` from its first corner and their cross product `n`, in the mean
/// metric of its corners.
inline Squared_shape squared_shape(const Isotropic_metric&, const Isotropic_metric&, const Isotropic_metric&,
                                   const Vector_3& e1, const Vector_3& e2, const Vector_3& n)
{
  return {n.squaredNorm(), e1.squaredNorm() + e2.squaredNorm() - e1.dot(e2)};
}

inline Squared_shape squared_shape(const Anisotropic_metric& a, const Anisotropic_metric& b,
                                   const Anisotropic_metric& c, const Vector_3& e1, const Vector_3& e2, const Vector_3&)
{
  const Metric_tensor_3 mean = a.m + b.m + c.m; // times 3: quality does not depend on the scale
  const Vector_3 m1 = mean * e1, m2 = mean * e2;
  const double e11 = e1.dot(m1), e12 = e1.dot(m2), e22 = e2.dot(m2);
  return {e11 * e22 - e12 * e12, e11 + e22 - e12};
}

} // namespace internal

/// Quality of a triangle with edge vectors `e1`, `e2` from its first corner: 1 if equilateral in the mean metric of its
/// corners, 0 if degenerate.
template <class Metric>
double face_quality(const Metric& a, const Metric& b, const Metric& c, const Vector_3& e1, const Vector_3& e2)
{
  return internal::squared_shape(a, b, c, e1, e2, e1.cross(e2)).quality();
}

/// The inverse of the quality of a triangle, at least 1, and how it changes with the first corner.
struct Distortion
{
  double value;        ///< infinite if degenerate
  Vector_3 gradient;   ///< for fixed metrics; as a vector of space, to be projected onto the directions of interest
};

namespace internal {

/// `e` by the scalar product in which the shape of a triangle with these metrics at its corners is measured.
inline Vector_3 dual(const Isotropic_metric&, const Isotropic_metric&, const Isotropic_metric&, const Vector_3& e)
{
  return e;
}

inline Vector_3 dual(const Anisotropic_metric& a, const Anisotropic_metric& b, const Anisotropic_metric& c,
                     const Vector_3& e)
{
  return (a.m + b.m + c.m) * e;
}

} // namespace internal

/// Distortion of the triangle of `face_quality`.
template <class Metric>
Distortion face_distortion(const Metric& a, const Metric& b, const Metric& c, const Vector_3& e1, const Vector_3& e2)
{
  const Vector_3 m1 = internal::dual(a, b, c, e1), m2 = internal::dual(a, b, c, e2);
  const double e11 = e1.dot(m1), e12 = e1.dot(m2), e22 = e2.dot(m2);
  const double half_sum = e11 + e22 - e12, squared_double_area = e11 * e22 - e12 * e12;
  if (!(squared_double_area > 0)) return {std::numeric_limits<double>::infinity(), Vector_3::Zero()};
  const double value = half_sum / std::sqrt(3 * squared_double_area);
  // moving the corner by d takes d from both edge vectors
  const Vector_3 of_area = (e22 - e12) * m1 + (e11 - e12) * m2;
  return {value, value * (of_area / squared_double_area - (m1 + m2) / half_sum)};
}

/// Relative mass of a triangle: `projected_area`, up to a constant, times the density of the metric at its corners.
inline double face_mass(const Isotropic_metric& a, const Isotropic_metric& b, const Isotropic_metric& c,
                        const Vector_3&, const Vector_3&, double projected_area)
{
  return projected_area * (a.density() + b.density() + c.density());
}

inline double face_mass(const Anisotropic_metric& a, const Anisotropic_metric& b, const Anisotropic_metric& c,
                        const Vector_3& e1, const Vector_3& e2, double projected_area)
{
  const double squared = internal::squared_shape(a, b, c, e1, e2, Vector_3::Zero()).squared_double_area;
  return std::copysign(std::sqrt((std::max)(0.0, squared)), projected_area);
}

/// The side `e` of a triangle, mapped such that `sqrt(3) / 2` times the cross product of the unit normal with it is
/// `face_mass` times the vector from the middle of `e` to the third corner of the triangle on its left that is
/// equilateral in the mean metric of the corners. (In the plane, a quarter turn `J` in the metric `M` is
/// `J M / sqrt(det M)`.)
inline Vector_3 weighted_side(const Isotropic_metric& a, const Isotropic_metric& b, const Isotropic_metric& c,
                              const Vector_3& e, double projected_area)
{
  return projected_area * (a.density() + b.density() + c.density()) * e;
}

inline Vector_3 weighted_side(const Anisotropic_metric& a, const Anisotropic_metric& b, const Anisotropic_metric& c,
                              const Vector_3& e, double projected_area)
{
  return projected_area * ((a.m + b.m + c.m) * e);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_H

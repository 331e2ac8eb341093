// SPDX-License-Identifier: GPL-3.0-or-later
//
// Symmetric positive definite 3x3 tensors and what adaptation does with them.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_TENSOR_3_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_TENSOR_3_H

#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

/// A metric tensor: the edge `e` has the length `sqrt(e^T M e)` in the metric, and an edge is as long as asked for
/// when that length is 1. The eigenvalue `l` along a direction asks for the size `1/sqrt(l)` along it.
///
/// Value type of six coefficients, in the order xx xy yy xz yz zz of MEDIT's `.sol` files.
class Metric_tensor_3
{
public:
  /// The identity: size 1 everywhere.
  Metric_tensor_3() : c_{1, 0, 1, 0, 0, 1} {}

  /// The isotropic metric of size `size`. \pre `size > 0`
  static Metric_tensor_3 isotropic(double size)
  {
    const double l = 1 / (size * size);
    return Metric_tensor_3(l, 0, l, 0, 0, l);
  }

  /// Its coefficients.
  Metric_tensor_3(double xx, double xy, double yy, double xz, double yz, double zz)
    : c_{xx, xy, yy, xz, yz, zz}
  {}

  /// Takes the lower triangle of `m`.
  explicit Metric_tensor_3(const Matrix_3& m)
    : c_{m(0, 0), m(1, 0), m(1, 1), m(2, 0), m(2, 1), m(2, 2)}
  {}

  /// Coefficient `i` in MEDIT's order.
  double operator[](int i) const { return c_[i]; }

  /// Both of its triangles.
  Matrix_3 matrix() const
  {
    Matrix_3 m;
    m << c_[0], c_[1], c_[3],
         c_[1], c_[2], c_[4],
         c_[3], c_[4], c_[5];
    return m;
  }

  /// `M u`
  Vector_3 operator*(const Vector_3& u) const
  {
    return Vector_3(c_[0] * u[0] + c_[1] * u[1] + c_[3] * u[2],
                    c_[1] * u[0] + c_[2] * u[1] + c_[4] * u[2],
                    c_[3] * u[0] + c_[4] * u[1] + c_[5] * u[2]);
  }

  double dot(const Vector_3& u, const Vector_3& v) const { return u.dot(*this * v); }  ///< `u^T M v`
  double squared_length(const Vector_3& u) const { return dot(u, u); }  ///< of `u` in the metric
  double length(const Vector_3& u) const { return std::sqrt(squared_length(u)); }  ///< of `u` in the metric

  /// Adds the coefficients.
  Metric_tensor_3& operator+=(const Metric_tensor_3& o)
  {
    for (int i = 0; i < 6; ++i) c_[i] += o.c_[i];
    return *this;
  }

  /// The sum of the coefficients.
  friend Metric_tensor_3 operator+(Metric_tensor_3 a, const Metric_tensor_3& b) { return a += b; }

  /// All coefficients times `s`.
  friend Metric_tensor_3 operator*(double s, Metric_tensor_3 a)
  {
    for (double& c : a.c_) c *= s;
    return a;
  }

  /// Whether all coefficients are equal.
  friend bool operator==(const Metric_tensor_3& a, const Metric_tensor_3& b)
  {
    for (int i = 0; i < 6; ++i)
      if (a.c_[i] != b.c_[i]) return false;
    return true;
  }

private:
  double c_[6];
};

/// Eigenvalues in increasing order and the orthonormal eigenvectors as columns.
struct Eigen_decomposition_3
{
  Vector_3 values;  ///< in increasing order
  Matrix_3 vectors;  ///< orthonormal, as columns
};

/// Iterative (QL) decomposition: keeps the relative accuracy of small eigenvalues far better than a closed form.
inline Eigen_decomposition_3 eigen_decomposition(const Metric_tensor_3& m)
{
  const Eigen::SelfAdjointEigenSolver<Matrix_3> solver(m.matrix());
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// The tensor with the given eigenvalues along the columns of `vectors` (orthonormal).
inline Metric_tensor_3 metric_tensor(const Vector_3& values, const Matrix_3& vectors)
{
  return Metric_tensor_3(Matrix_3(vectors * values.asDiagonal() * vectors.transpose()));
}

/// The sum of the products of two eigenvalues each: their product in the tangent plane where the third one is zero, as
/// that of shape operators and Hessians of a surface, the Gauss curvature for the former.
inline double second_invariant(const Metric_tensor_3& m)
{
  return (m[0] * m[2] - m[1] * m[1]) + (m[0] * m[5] - m[3] * m[3]) + (m[2] * m[5] - m[4] * m[4]);
}

/// Whether `m` is finite and positive definite.
inline bool is_positive_definite(const Metric_tensor_3& m)
{
  // the pivots of Gaussian elimination; comparisons with NaN fail
  const Matrix_3 a = m.matrix();
  const double l1 = a(1, 0) / a(0, 0), l2 = a(2, 0) / a(0, 0);
  const double p1 = a(1, 1) - l1 * a(1, 0), s = a(2, 1) - l1 * a(2, 0);
  const double p2 = a(2, 2) - l2 * a(2, 0) - s * s / p1;
  return a.allFinite() && a(0, 0) > 0 && p1 > 0 && p2 > 0;
}

/// Matrix logarithm. \pre `m` is positive definite
inline Metric_tensor_3 log(const Metric_tensor_3& m)
{
  const Eigen_decomposition_3 e = eigen_decomposition(m);
  return metric_tensor(e.values.array().log().matrix(), e.vectors);
}

/// Matrix exponential of a symmetric matrix; always positive definite.
inline Metric_tensor_3 exp(const Metric_tensor_3& m)
{
  const Eigen_decomposition_3 e = eigen_decomposition(m);
  return metric_tensor(e.values.array().exp().matrix(), e.vectors);
}

/// `R M R^T`: the tensor carried along by the rotation `r`.
inline Metric_tensor_3 rotated(const Metric_tensor_3& m, const Matrix_3& r)
{
  return Metric_tensor_3(Matrix_3(r * m.matrix() * r.transpose()));
}

/// Log-Euclidean mean of two tensors: `exp((1 - t) log a + t log b)` (Arsigny et al. 2006).
inline Metric_tensor_3 log_euclidean_interpolation(const Metric_tensor_3& a, const Metric_tensor_3& b, double t)
{
  return exp((1 - t) * log(a) + t * log(b));
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_TENSOR_3_H

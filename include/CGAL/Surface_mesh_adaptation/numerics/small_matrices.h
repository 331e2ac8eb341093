// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arithmetic of vectors and matrices of a few numbers that is evaluated at once. Eigen gives every expression a type of
// its own; where expressions are short and their operands small, these types gain nothing, and they took half of the
// time to compile the headers.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_SMALL_MATRICES_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_SMALL_MATRICES_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <type_traits>

namespace CGAL {
namespace Surface_mesh_adaptation {

using Vector_3 = Eigen::Vector3d;
using Matrix_3 = Eigen::Matrix3d;

namespace internal {

template <class T> inline constexpr bool is_small_matrix = false;
template <> inline constexpr bool is_small_matrix<Eigen::Vector2d> = true;
template <> inline constexpr bool is_small_matrix<Eigen::Vector3d> = true;
template <> inline constexpr bool is_small_matrix<Eigen::Matrix2d> = true;
template <> inline constexpr bool is_small_matrix<Eigen::Matrix3d> = true;

/// `M` if it is one of these types, which then match better than the base classes that Eigen's operators take.
template <class M, class Scalar = double>
using Small_matrix = std::enable_if_t<is_small_matrix<M> && std::is_arithmetic<Scalar>::value, M>;

} // namespace internal

template <class M>
internal::Small_matrix<M> operator+(const M& a, const M& b)
{
  M result = a;
  result += b;
  return result;
}

template <class M>
internal::Small_matrix<M> operator-(const M& a, const M& b)
{
  M result = a;
  result -= b;
  return result;
}

template <class M>
internal::Small_matrix<M> operator-(const M& a)
{
  return a * -1.0;
}

template <class M, class Scalar>
internal::Small_matrix<M, Scalar> operator*(const M& a, Scalar s)
{
  M result = a;
  result *= double(s);
  return result;
}

template <class M, class Scalar>
internal::Small_matrix<M, Scalar> operator*(Scalar s, const M& a)
{
  return a * s;
}

template <class M, class Scalar>
internal::Small_matrix<M, Scalar> operator/(const M& a, Scalar s)
{
  M result = a;
  result /= double(s);
  return result;
}

namespace internal {

/// `a b^T`
template <int n>
Eigen::Matrix<double, n, n> outer_product(const Eigen::Matrix<double, n, 1>& a, const Eigen::Matrix<double, n, 1>& b)
{
  return a * b.transpose();
}

/// `J m J^T` for `J` with the columns `x` and `y`: the form `m` of a plane with these axes as one of space.
inline Eigen::Matrix3d in_space(const Eigen::Matrix2d& m, const Eigen::Vector3d& x, const Eigen::Vector3d& y)
{
  return outer_product(m(0, 0) * x + m(1, 0) * y, x) + outer_product(m(0, 1) * x + m(1, 1) * y, y);
}

/// `m + s I`
template <int n>
Eigen::Matrix<double, n, n> shifted(Eigen::Matrix<double, n, n> m, double s)
{
  for (int i = 0; i < n; ++i) m(i, i) += s;
  return m;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_SMALL_MATRICES_H

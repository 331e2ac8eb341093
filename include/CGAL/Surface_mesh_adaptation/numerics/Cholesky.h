// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Cholesky factor of a small symmetric matrix. Eigen's is made for large ones: instantiating its blocked products
// took half of the time to compile a program that adapts a mesh.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CHOLESKY_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CHOLESKY_H

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// `a = L L^T`, of which only the lower triangle is read.
/// \par Complexity
/// O(n^3)
template <int n>
class Cholesky
{
public:
  using Matrix = Eigen::Matrix<double, n, n>;
  using Vector = Eigen::Matrix<double, n, 1>;

  explicit Cholesky(const Matrix& a) : lower_(Matrix::Zero())
  {
    for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i) lower_(i, j) = a(i, j);
    for (int k = 0; k < n && is_positive_definite_; ++k) {
      is_positive_definite_ = lower_(k, k) > 0;
      const double pivot = std::sqrt(lower_(k, k));
      lower_(k, k) = pivot;
      inverse_pivots_[k] = 1 / pivot;
      for (int i = k + 1; i < n; ++i) lower_(i, k) *= inverse_pivots_[k];
      for (int j = k + 1; j < n; ++j)
        for (int i = j; i < n; ++i) lower_(i, j) -= lower_(i, k) * lower_(j, k);
    }
  }

  bool is_positive_definite() const { return is_positive_definite_; }

  /// The least diagonal element of `L`. \pre positive definite
  double least_pivot() const
  {
    double least = lower_(0, 0);
    for (int i = 1; i < n; ++i) least = (std::min)(least, lower_(i, i));
    return least;
  }

  /// `L` \pre positive definite
  const Matrix& lower() const { return lower_; }

  /// `L^-1 b` \pre positive definite
  template <int m>
  Eigen::Matrix<double, n, m> solve_lower(Eigen::Matrix<double, n, m> b) const
  {
    for (int k = 0; k < m; ++k)
      for (int j = 0; j < n; ++j) {
        b(j, k) *= inverse_pivots_[j];
        for (int i = j + 1; i < n; ++i) b(i, k) -= lower_(i, j) * b(j, k);
      }
    return b;
  }

  /// `a^-1 b` \pre positive definite
  Vector solve(const Vector& b) const
  {
    Vector x = solve_lower(b);
    for (int i = n - 1; i >= 0; --i) {
      for (int j = i + 1; j < n; ++j) x[i] -= lower_(j, i) * x[j];
      x[i] *= inverse_pivots_[i];
    }
    return x;
  }

private:
  Matrix lower_;
  Vector inverse_pivots_; // quotients would wait for each other
  bool is_positive_definite_ = true;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CHOLESKY_H

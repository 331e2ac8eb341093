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

/// `a = L L^T` \pre `a` is symmetric
/// \par Complexity
/// O(n^3)
template <int n>
class Cholesky
{
public:
  using Matrix = Eigen::Matrix<double, n, n>;
  using Vector = Eigen::Matrix<double, n, 1>;

  explicit Cholesky(const Matrix& a)
  {
    for (int k = 0; k < n && is_positive_definite_; ++k) {
      Vector column = a.col(k); // whole columns, what is above the diagonal too: loops of one length are unrolled
      for (int j = 0; j < k; ++j)
        for (int i = 0; i < n; ++i) column[i] -= lower_(k, j) * lower_(i, j);
      is_positive_definite_ = column[k] > 0;
      const double pivot = std::sqrt(column[k]);
      inverse_pivots_[k] = 1 / pivot;
      lower_.col(k) = inverse_pivots_[k] * column;
      lower_(k, k) = pivot;
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
  Matrix lower() const { return lower_.template triangularView<Eigen::Lower>(); }

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
  Matrix lower_; ///< its lower triangle
  Vector inverse_pivots_; // quotients would wait for each other
  bool is_positive_definite_ = true;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CHOLESKY_H

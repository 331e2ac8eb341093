// SPDX-License-Identifier: GPL-3.0-or-later
//
// Least squares fit of a cubic or quadratic polynomial of two variables that is zero at the origin.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CUBIC_FIT_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CUBIC_FIT_H

#include <CGAL/Surface_mesh_adaptation/numerics/Cholesky.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Moments_2.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The derivatives at the origin of a function of two variables.
struct Derivatives_2
{
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian;
  double bend;      ///< largest second derivative, in units of length in which the samples spread alike all around
  double explained; ///< sum of the squares of a fit at its samples, with their weights
};

/// Gathers samples, then solves the normal equations. Their monomials are ordered by degree, so those of the quadratic
/// fit are a block of those of the cubic one: both come from the same moments.
class Cubic_fit
{
public:
  /// \param to_unit maps the samples to where they are of the order of 1 all around: where they are stretched in a
  ///        direction that is no axis, monomials of the coordinates themselves can hardly be told from each other
  explicit Cubic_fit(const Eigen::Matrix2d& to_unit = Eigen::Matrix2d::Identity()) : to_unit_(to_unit) {}

  void add(const Eigen::Vector2d& x, double value, double weight)
  {
    const Eigen::Vector2d p = to_unit_ * x;
    moments_.add(p, weight);
    moments_of_values_.add(p, weight * value);
    ++samples_;
  }

  /// Takes `value` from a sample that was added with the same weight.
  void subtract(const Eigen::Vector2d& x, double value, double weight)
  {
    moments_of_values_.add(to_unit_ * x, -weight * value);
  }

  std::size_t number_of_samples() const { return samples_; }

  /// The normal equations of the fit with `n` monomials, factored: 9 for the cubic, 5 for the quadratic one. Refers to
  /// the fit, of which values may change.
  template <int n>
  class Solver
  {
  public:
    explicit Solver(const Cubic_fit& fit) : fit_(fit), factors_(scaled_matrix()) {}

    /// Whether there are samples enough, and well enough spread; if so, sets `result`.
    bool solve(Derivatives_2& result) const
    {
      if (fit_.samples_ < least_samples || !is_well_scaled() || !factors_.is_positive_definite() ||
          !(factors_.least_pivot() > least_sine))
        return false;
      const auto moments = fit_.moments_of_values_.sums(); // ordered like the monomials
      const Vector right_side = Eigen::Map<const Vector>(moments.data());
      const Vector c = inverse_.cwiseProduct(factors_.solve(inverse_.cwiseProduct(right_side)));
      Eigen::Matrix2d hessian;
      hessian << 2 * c[2], c[3], c[3], 2 * c[4];
      const Eigen::Matrix2d back = fit_.to_unit_.transpose();
      result.gradient = back * Eigen::Vector2d(c[0], c[1]);
      result.hessian = back * hessian * fit_.to_unit_;
      result.bend = hessian.template lpNorm<Eigen::Infinity>();
      result.explained = c.dot(right_side);
      return true;
    }

  private:
    using Vector = Eigen::Matrix<double, n, 1>;
    using Matrix = Eigen::Matrix<double, n, n>;
    static constexpr std::size_t least_samples = n == 9 ? 14 : 6;

    /// The normal equations for columns of length 1, with the lengths that they have.
    Matrix scaled_matrix()
    {
      Matrix a;
      const auto moments = fit_.moments_.sums();
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          a(i, j) = moments[Moments::index(power_of_x[i] + power_of_x[j], power_of_y[i] + power_of_y[j])];
      scale_ = a.diagonal().cwiseSqrt();
      inverse_ = scale_.cwiseInverse();
      return inverse_.asDiagonal() * a * inverse_.asDiagonal();
    }

    bool is_well_scaled() const
    {
      const auto [least, largest] = std::minmax_element(scale_.data(), scale_.data() + n);
      return *least > least_column * *largest;
    }

    const Cubic_fit& fit_;
    Vector scale_, inverse_;
    Cholesky<n> factors_;
  };

  bool solve_cubic(Derivatives_2& result) const { return Solver<9>(*this).solve(result); }
  bool solve_quadratic(Derivatives_2& result) const { return Solver<5>(*this).solve(result); }

private:
  using Moments = Moments_2<2, 6>; // products of two monomials
  static constexpr std::array<int, 9> power_of_x{1, 0, 2, 1, 0, 3, 2, 1, 0}, power_of_y{0, 1, 0, 1, 2, 0, 1, 2, 3};

  /// The least sine of the angle between a column of the problem and the span of those before it.
  static constexpr double least_sine = 3.2e-3;
  /// The least length of a column over the longest: where all samples lie on two lines, the mixed one is but rounding.
  static constexpr double least_column = 1e-6;

  Eigen::Matrix2d to_unit_;
  Moments moments_;
  Moments_2<1, 3> moments_of_values_;
  std::size_t samples_ = 0;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CUBIC_FIT_H

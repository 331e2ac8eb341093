// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted sums of the monomials of two variables over samples.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_MOMENTS_2_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_MOMENTS_2_H

#include <Eigen/Core>

#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The sums of `w x^i y^j` over samples for all degrees `i + j` from `least` to `most`. Several samples are added at a
/// time, in vector registers: one by one, each sum would wait for itself.
template <int least, int most>
class Moments_2
{
  /// Those of lower degree than `degree`.
  static constexpr int number_of_monomials(int degree) { return degree * (degree + 1) / 2; }

public:
  static constexpr int count = (most + 1) * (most + 2) / 2 - least * (least + 1) / 2;

  Moments_2() { sums_.fill(Lane::Zero()); }

  void add(const Eigen::Vector2d& p, double weight)
  {
    x_[waiting_] = p[0];
    y_[waiting_] = p[1];
    weight_[waiting_] = weight;
    if (++waiting_ == lanes) accumulate();
  }

  /// Those of all samples so far, see `index()`.
  std::array<double, count> sums() const
  {
    Moments_2 all = *this;
    all.accumulate();
    std::array<double, count> sums;
    for (int k = 0; k < count; ++k) sums[k] = all.sums_[k].sum();
    return sums;
  }

  /// Where the sum of `w x^i y^j` is among the sums.
  static constexpr int index(int i, int j) { return number_of_monomials(i + j) - number_of_monomials(least) + j; }

private:
  static constexpr int lanes = 4;
  using Lane = Eigen::Array<double, lanes, 1>;

  void accumulate()
  {
    std::array<Lane, most + 1> monomials;
    monomials[0] = weight_;
    add_degrees<1>(monomials);
    weight_.setZero(); // of the places of samples that may not come any more
    waiting_ = 0;
  }

  /// Makes the `monomials` of `degree` from those of the last one, and so on.
  template <int degree>
  void add_degrees(std::array<Lane, most + 1>& monomials)
  {
    monomials[degree] = monomials[degree - 1] * y_;
    for (int j = 0; j < degree; ++j) monomials[j] *= x_;
    if constexpr (degree >= least)
      for (int j = 0; j <= degree; ++j) sums_[index(degree - j, j)] += monomials[j];
    if constexpr (degree < most) add_degrees<degree + 1>(monomials);
  }

  std::array<Lane, count> sums_;
  Lane x_ = Lane::Zero(), y_ = Lane::Zero(), weight_ = Lane::Zero(); ///< of the samples that wait
  int waiting_ = 0;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_MOMENTS_2_H

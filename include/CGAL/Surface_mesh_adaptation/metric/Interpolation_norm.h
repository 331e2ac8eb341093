// SPDX-License-Identifier: GPL-3.0-or-later
//
// The error of the linear interpolation of a quadratic function, and the metric that makes it small.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_INTERPOLATION_NORM_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_INTERPOLATION_NORM_H

#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/Size_bounds.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

/// The L^p norm of interpolation errors, in the mean over equilateral triangles of all orientations.
///
/// On a triangle with edges of length 1, the function with the Hessian `diag(1, r)` is missed by half of
/// `a (x + y + z) + b Re(w e^it)`, with `a = (1 + r) / 2`, `b = (1 - r) / 2`, the products `x, y, z` of two barycentric
/// coordinates each, `w = x + e^(2 pi i / 3) y + e^(4 pi i / 3) z`, and twice the orientation as `t`: the second
/// derivative along an edge is `a + b cos t`. On bowls, `r = 1`, the second term is zero, on saddles, `r = -1`, the
/// first: the error is much smaller there.
class Interpolation_norm
{
public:
  /// \param p the exponent; may be infinite \pre `p >= 1`
  explicit Interpolation_norm(double p) : p_(p), saddle_error_(error_on_saddles(p)) {}

  double exponent() const { return p_; }  ///< p

  /// The error for the Hessian `diag(1, r)` over that for `diag(1, 1)`: `sqrt(a^2 + s^2 b^2)`, where `s` is its value
  /// for `r = -1`. Exact for `p = 2`, where the two terms are orthogonal; in between up to 10 % above for `p = 1`, 7 %
  /// below for 4 and 20 % below for infinity. \pre `-1 <= r <= 1`
  double relative_error(double r) const { return std::hypot((1 + r) / 2, saddle_error_ * (1 - r) / 2); }

private:
  /// The norm of `Re(w e^it)`, in the mean over `t` that of `|w|` times that of the cosine, over the norm of
  /// `x + y + z`. Summed over the points of a lattice to which those with the largest `|w|`, 1/4 in the middle of a
  /// side, and `x + y + z`, 1/3 in the center, belong: hence for infinity as well.
  static double error_on_saddles(double p)
  {
    constexpr int n = 48;
    double of_w = 0, of_sum = 0, of_cosine = 0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const int k = n - i - j, x = j * k, y = k * i, z = i * j;
        const double weight = i == 0 || j == 0 || k == 0 ? 0.5 : 1;
        of_w += weight * std::pow(4 * std::sqrt(double(x * x + y * y + z * z - x * y - y * z - z * x)) / (n * n), p);
        of_sum += weight * std::pow(3.0 * (x + y + z) / (n * n), p);
      }
    for (int i = 0; i < n; ++i) of_cosine += std::pow(std::abs(std::cos(CGAL_PI * i / n)), p) / n;
    return 0.75 * std::pow(of_cosine * of_w / of_sum, 1 / p);
  }

  double p_, saddle_error_;
};

/// Turns the Hessian `H` of a field into the metric that minimises a norm of the interpolation error on it for a given
/// number of vertices, up to scale: `det(c |H|)^(-1/(2p + 2)) c |H|` with the determinant in the tangent plane
/// (Loseille, Alauzet 2011) and the relative error `c` of what is left of `H` on triangles that are equilateral in `|H|`.
///
/// The eigenvalues of `|H|` are the absolute values of those of `H`, with their ratio bounded as in
/// `with_bounded_anisotropy`: the metric is isotropic if `max_anisotropy` is 1. As far as it follows both eigenvalues,
/// what is left are bowls and saddles of the same curvatures; else the smaller one counts less. Zero stays zero.
/// \pre `hessian` has an eigenvalue 0 along the normal
inline Metric_tensor_3 multiscale_tensor(const Metric_tensor_3& hessian, const Interpolation_norm& norm,
                                         double max_anisotropy)
{
  const Metric_tensor_3 m = with_bounded_anisotropy(hessian, max_anisotropy);
  const Vector_3 values = eigen_decomposition(m).values;
  const double determinant = values[1] * values[2];
  if (!(values[1] > 0)) return Metric_tensor_3(0, 0, 0, 0, 0, 0);
  const double c = norm.relative_error(std::clamp(second_invariant(hessian) / determinant, -1.0, 1.0));
  return c * std::pow(c * c * determinant, -1 / (2 * norm.exponent() + 2)) * m;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_INTERPOLATION_NORM_H

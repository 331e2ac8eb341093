// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hessians of values at vertices, and the metrics that they make optimal.

#include "analytic_fields.h"
#include "fields/tensors.h"
#include "policies.h"

#include <CGAL/Surface_mesh_adaptation/fields/hessian.h>
#include <CGAL/Surface_mesh_adaptation/metric/Interpolation_norm.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace test_hessian {

using namespace tensors_of_tests;
using tensors_of_tests::nan; // not that of C
using analytic::Function;
using analytic::Surface;

// Hessians

/// The mean of what is not explained of `values` on a mesh.
double mean_unexplained(const Soup& soup, const std::vector<double>& values)
{
  const Reference r = reference(soup, false);
  const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
  double sum = 0, n = 0;
  for (const SMA::Hessian_estimate& h : SMA::estimate_hessians(sequential, r.mesh, r.points, jets, values)) {
    EXPECT_GE(h.unexplained, 0);
    EXPECT_LE(h.unexplained, 1);
    sum += h.unexplained;
    ++n;
  }
  return sum / n;
}

/// Root mean square error of the Hessian relative to its size, at inner or at boundary vertices.
double hessian_error(const Surface& surface, const Function& u, int level, bool on_boundary)
{
  const Soup soup = surface.mesh(level);
  const Reference r = reference(soup, false);
  const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
  const auto found = hessians(r, jets, analytic::samples(u, soup.points));
  double error = 0, size = 0;
  for (Index v = 0; v < soup.points.size(); ++v) {
    if (r.mesh.is_border_vertex(v) != on_boundary) continue;
    const Matrix_3 expected = surface.covariant_hessian(u, soup.points[v]);
    error += (found[jets.of_corner[r.mesh.outgoing[v]]].matrix() - expected).squaredNorm();
    size += expected.squaredNorm();
  }
  return std::sqrt(error / size);
}

TEST(Hessian, is_of_second_order_on_curved_surfaces)
{
  for (const Surface& surface : {analytic::ellipsoid(), analytic::torus(), analytic::graph()}) {
    const double coarse = hessian_error(surface, analytic::waves(), 1, false);
    const double fine = hessian_error(surface, analytic::waves(), 3, false);
    EXPECT_GT(std::log2(coarse / fine) / 2, 1.8) << surface.name;
    EXPECT_LT(fine, 0.01) << surface.name;
  }
}

TEST(Hessian, keeps_its_order_at_the_boundary)
{
  const double coarse = hessian_error(analytic::graph(), analytic::waves(), 1, true);
  const double fine = hessian_error(analytic::graph(), analytic::waves(), 3, true);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.6);
  EXPECT_LT(fine, 0.02);
}

TEST(Hessian, is_not_made_of_rounding_where_all_samples_lie_on_two_lines)
{
  SMA::internal::Cubic_fit fit;
  double rounding = 1e-15;
  for (const double x : {0.5, 1.0, 1.5}) {
    rounding = -rounding;
    fit.add({x, rounding}, std::sin(x), 1);
    fit.add({rounding, x}, std::sin(3 * x), 1);
  }
  SMA::internal::Derivatives_2 f;
  EXPECT_FALSE(fit.solve_quadratic(f));
  fit.add({1, 1}, 0.3, 1);
  EXPECT_TRUE(fit.solve_quadratic(f));
}

TEST(Cubic_fit, finds_the_derivatives_of_cubic_polynomials_whatever_the_number_of_samples)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (std::size_t n = 14; n < 40; ++n) { // samples are added several at a time
    std::array<double, 9> c;
    for (double& x : c) x = any(random);
    const auto polynomial = [&](double x, double y) {
      return c[0] * x + c[1] * y + c[2] * x * x + c[3] * x * y + c[4] * y * y + c[5] * x * x * x + c[6] * x * x * y +
             c[7] * x * y * y + c[8] * y * y * y;
    };
    SMA::internal::Cubic_fit fit;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector2d x(any(random), any(random));
      const double weight = 1.5 + any(random), other = any(random);
      fit.add(x, polynomial(x[0], x[1]) + other, weight);
      fit.subtract(x, other, weight);
    }
    SMA::internal::Derivatives_2 f;
    ASSERT_TRUE(fit.solve_cubic(f)) << n;
    Eigen::Matrix2d hessian;
    hessian << 2 * c[2], c[3], c[3], 2 * c[4];
    EXPECT_LT((f.gradient - Eigen::Vector2d(c[0], c[1])).norm(), 1e-10) << n;
    EXPECT_LT((f.hessian - hessian).norm(), 1e-10) << n;
  }
}

TEST(Hessian, of_a_quadratic_field_is_exact_on_stretched_faces_of_any_direction)
{
  for (const double stretch : {10.0, 1e2, 1e4})
    for (const double angle : {0.0, 0.4, pi / 4, 2.0}) {
      const Matrix_3 turn = Eigen::AngleAxisd(angle, Vector_3::UnitZ()).toRotationMatrix();
      const Matrix_3 map = turn * Vector_3(1, 1 / stretch, 1).asDiagonal();
      const Soup square = shapes::square(8, 0.3);
      const Soup soup = analytic::mapped(square, [&](const Vector_3& p) { return Vector_3(map * p); });
      const Reference r = reference(soup, false);
      const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
      Matrix_3 h;
      h << 1, 0.5, 0, 0.5, -2, 0, 0, 0, 0;
      const auto values = analytic::samples(analytic::quadratic(h, Vector_3(1, -2, 0)), square.points);
      for (const Metric_tensor_3& m : hessians(r, jets, values))
        EXPECT_LT((map.transpose() * m.matrix() * map - h).norm(), 1e-7) << stretch << ' ' << angle;
    }
}

TEST(Hessian, of_a_quadratic_field_is_exact_on_each_side_of_a_ridge)
{
  const Soup soup = shapes::cube(5);
  const Reference r = reference(soup);
  const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
  Matrix_3 h;
  h << 1, 2, -1, 2, 0.5, 3, -1, 3, -2;
  const auto found = hessians(r, jets, analytic::samples(analytic::quadratic(h, Vector_3(1, -2, 3)), soup.points));
  for (Index corner = 0; corner < r.mesh.number_of_halfedges(); ++corner) {
    const Vector_3 n = SMA::internal::face_normal(r.mesh, r.points, corner).normalized();
    const Matrix_3 across = Matrix_3::Identity() - n * n.transpose();
    EXPECT_LT((found[jets.of_corner[corner]].matrix() - across * h * across).norm(), 1e-10);
  }
}

TEST(Hessian, of_constant_and_linear_fields_on_planes_is_zero)
{
  Soup soup = shapes::square(20, 0.3);
  for (Vector_3& p : soup.points) p = Vector_3(p[0] + 100, p[1], 0.5 * p[0] - p[1]); // a slanted plane, off the origin
  const Reference r = reference(soup);
  const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
  for (const Vector_3& slope : {Vector_3(0, 0, 0), Vector_3(1, -3, 2), Vector_3(1e-9, 0, 1e9)}) {
    std::vector<double> values;
    for (const Vector_3& p : soup.points) values.push_back(7 + slope.dot(p));
    for (const Metric_tensor_3& m : hessians(r, jets, values)) EXPECT_EQ(norm(m), 0);
  }
}

TEST(Hessian, of_degenerate_neighbourhoods_is_finite)
{
  Soup collapsed = analytic::torus().mesh(1);
  for (std::size_t i = 0; i < 40; ++i) collapsed.points[i] = collapsed.points[0];
  for (const Soup& soup : {shapes::tetrahedron(), shapes::cube(1), shapes::octahedron(), collapsed})
    for (const bool ridges : {true, false}) {
      const Reference r = reference(soup, ridges);
      std::vector<double> values(soup.points.size());
      std::iota(values.begin(), values.end(), 1.0);
      const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
      for (const Metric_tensor_3& m : hessians(r, jets, values)) EXPECT_TRUE(m.matrix().allFinite());
    }
}

TEST(Hessian, says_how_far_it_explains_the_values)
{
  const Soup square = shapes::square(20, 0.3);
  const auto quadratic = analytic::quadratic(Vector_3(1, -3, 0).asDiagonal(), Vector_3(5, 1, 0));
  EXPECT_LT(mean_unexplained(square, analytic::samples(quadratic, square.points)), 1e-12);
  double coarser = 1;
  for (const int level : {2, 3, 4}) {
    const Soup soup = analytic::graph().mesh(level);
    const double unexplained = mean_unexplained(soup, analytic::samples(analytic::waves(), soup.points));
    EXPECT_LT(unexplained, coarser / 4);
    coarser = unexplained;
  }
  EXPECT_LT(coarser, 0.01);
  Random random(9);
  std::vector<double> noise;
  for (std::size_t v = 0; v < square.points.size(); ++v) noise.push_back(random.real());
  EXPECT_GT(mean_unexplained(square, noise), 0.3);
}

TEST(Hessian, names_the_first_value_that_is_not_finite)
{
  const Soup soup = shapes::square(6);
  const Reference r = reference(soup);
  const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
  std::vector<double> values(soup.points.size(), 1.0);
  values[29] = nan;
  values[17] = infinity;
  try {
    hessians(r, jets, values);
    FAIL();
  } catch (const SMA::Invalid_field_error& e) {
    EXPECT_EQ(e.index(), 17u);
  }
}

TEST(Hessian, is_the_same_bits_with_every_policy)
{
  const Soup soup = analytic::graph().mesh(3);
  const Reference r = reference(soup);
  const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
  const std::vector<double> values = analytic::samples(analytic::waves(), soup.points);
  const auto expected = hessians(r, jets, values);
  for_each_policy([&](const auto& execution, const std::string& name) {
    EXPECT_TRUE(hessians(r, jets, values, execution) == expected) << name;
  });
}

// Interpolation errors of quadratic functions

/// The L^p norm of the error for the Hessian `diag(1, r)` on a triangle with edges of length 1, in the mean over its
/// orientations: from the values of the function at points of the triangle and at its corners.
double interpolation_error(double p, double r)
{
  const int directions = 24, n = 60;
  double sum = 0, largest = 0;
  for (int d = 0; d < directions; ++d) {
    Vector_3 corners[3];
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * pi * (i / 3.0 + d / (6.0 * directions));
      corners[i] = Vector_3(std::cos(angle), std::sin(angle), 0) / std::sqrt(3.0);
    }
    const auto u = [&](const Vector_3& x) { return (x[0] * x[0] + r * x[1] * x[1]) / 2; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) { // the centers of the n^2 triangles into which lines cut this one
        const bool upper = i + j >= n;
        const double a = (upper ? n - i - 1 / 3.0 : i + 1 / 3.0) / n, b = (upper ? n - j - 1 / 3.0 : j + 1 / 3.0) / n,
                     c = 1 - a - b;
        const double e = std::abs(a * u(corners[0]) + b * u(corners[1]) + c * u(corners[2]) -
                                  u(a * corners[0] + b * corners[1] + c * corners[2]));
        sum += std::pow(e, p);
        largest = (std::max)(largest, e);
      }
  }
  return std::isinf(p) ? largest : std::pow(sum / (directions * n * n), 1 / p);
}

TEST(Interpolation_norm, knows_how_much_smaller_errors_on_saddles_are)
{
  // the samples miss the sides, where the largest errors are
  const std::pair<double, double> above_and_below[] = {{0.10, 0.005}, {0.005, 0.005}, {0.005, 0.07}, {0.025, 0.2}};
  const double exponents[] = {1, 2, 4, infinity};
  for (int i = 0; i < 4; ++i) {
    const SMA::Interpolation_norm norm(exponents[i]);
    const double on_bowl = interpolation_error(exponents[i], 1);
    EXPECT_EQ(norm.relative_error(1), 1);
    EXPECT_NEAR(norm.relative_error(-1), interpolation_error(exponents[i], -1) / on_bowl, i < 3 ? 0.002 : 0.02)
      << exponents[i];
    for (double r = -1; r < 1; r += 0.125) {
      const double ratio = norm.relative_error(r) / (interpolation_error(exponents[i], r) / on_bowl);
      EXPECT_LT(ratio, 1 + above_and_below[i].first) << exponents[i] << ' ' << r;
      EXPECT_GT(ratio, 1 - above_and_below[i].second) << exponents[i] << ' ' << r;
    }
  }
  EXPECT_NEAR(SMA::Interpolation_norm(2).relative_error(-1), std::sqrt(1 / 8.0), 1e-3); // in closed form
  EXPECT_EQ(SMA::Interpolation_norm(infinity).relative_error(-1), 0.75);
}

TEST(Multiscale_tensor, has_the_determinant_of_the_optimal_density)
{
  Random random(4);
  for (const double p : {1.0, 2.0, 4.0})
    for (const double sign : {1.0, -1.0}) {
      const double a = random.real(0.1, 10), b = sign * random.real(0.1, 10);
      const Matrix_3 axes = random_rotation(random);
      const SMA::Interpolation_norm norm(p);
      const Metric_tensor_3 m = SMA::multiscale_tensor(SMA::metric_tensor(Vector_3(0, a, b), axes), norm, 1e4);
      const Vector_3 u = axes.col(1), v = axes.col(2);
      EXPECT_NEAR(m.dot(u, v), 0, 1e-12);
      EXPECT_NEAR(m.dot(u, u) / m.dot(v, v), a / std::abs(b), 1e-9); // directions and ratio are kept
      const double error = norm.relative_error(sign) * std::sqrt(std::abs(a * b)); // on faces of unit area
      EXPECT_NEAR(std::sqrt(m.dot(u, u) * m.dot(v, v)), std::pow(error, p / (p + 1)), 1e-9);
    }
}

TEST(Multiscale_tensor, of_an_isotropic_metric_counts_the_smaller_eigenvalue_for_what_it_costs)
{
  for (const double r : {1.0, 0.5, 0.0, -0.4, -1.0}) {
    const SMA::Interpolation_norm norm(2);
    const Metric_tensor_3 hessian = SMA::metric_tensor(Vector_3(-3, 0, -3 * r), Matrix_3::Identity());
    const Metric_tensor_3 m = SMA::multiscale_tensor(hessian, norm, 1);
    EXPECT_LT(distance(m, std::pow(3 * norm.relative_error(r), 2 / 3.0) * Metric_tensor_3()), 1e-12);
  }
}

TEST(Multiscale_tensor, takes_the_absolute_hessian_for_the_largest_error)
{
  const SMA::Interpolation_norm norm(infinity);
  const auto metric = [&](double b) {
    return SMA::multiscale_tensor(SMA::metric_tensor(Vector_3(0, 3, b), Matrix_3::Identity()), norm, 10);
  };
  EXPECT_LT(distance(metric(2), SMA::metric_tensor(Vector_3(0.03, 3, 2), Matrix_3::Identity())), 1e-12);
  EXPECT_LT(distance(metric(-2), 0.75 * SMA::metric_tensor(Vector_3(0.03, 3, 2), Matrix_3::Identity())), 1e-12);
  EXPECT_EQ(SMA::multiscale_tensor(zero, norm, 100), zero);
}

} // namespace test_hessian

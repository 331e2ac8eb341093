// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where metrics come from: curvature, fields, intersection, gradation, a number of vertices.

#include "analytic_fields.h"
#include "interpolation_error.h"
#include "policies.h"
#include "real_meshes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <numeric>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using analytic::Featured_mesh;
using analytic::Function;
using analytic::Surface;
using shapes::Index;
using shapes::pi;
using shapes::Random;
using shapes::Soup;
using SMA::Matrix_3;
using SMA::Metric_tensor_3;
using SMA::Vector_3;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Reference = SMA::Reference_surface<SMA::Gregory_reconstruction>;
using Flat_reference = SMA::Reference_surface<SMA::Flat_reconstruction>;
using Tensors = std::vector<Metric_tensor_3>;

const SMA::Sequential_execution sequential;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Metric_tensor_3 zero(0, 0, 0, 0, 0, 0);

Reference reference(const Soup& soup, bool detect_ridges = true)
{
  SMA::Feature_parameters p;
  p.detect_ridges = detect_ridges;
  return Reference(sequential, shapes::view(soup), soup.points, p);
}

Matrix_3 random_rotation(Random& random)
{
  const double angle = random.real(0, pi);
  return Eigen::AngleAxisd(angle, random.vector().normalized()).toRotationMatrix();
}

Metric_tensor_3 random_metric(Random& random, double ratio)
{
  const double l = std::log(ratio), a = random.real(-l, l), b = random.real(-l, l), c = random.real(-l, l);
  return SMA::metric_tensor(Vector_3(std::exp(a), std::exp(b), std::exp(c)), random_rotation(random));
}

double distance(const Metric_tensor_3& a, const Metric_tensor_3& b) { return (a.matrix() - b.matrix()).norm(); }
double norm(const Metric_tensor_3& m) { return m.matrix().norm(); }

// Intersection

TEST(Intersection_of_all, dominates_each_and_does_not_depend_on_their_order)
{
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Tensors metrics;
    for (std::size_t i = 0; i < 2 + random.below(6); ++i) metrics.push_back(random_metric(random, 10));
    metrics.push_back(metrics[0]);
    const Metric_tensor_3 m = SMA::intersection_of_all(metrics);
    for (const Metric_tensor_3& a : metrics)
      EXPECT_GT(SMA::eigen_decomposition(m + (-1.0) * a).values[0], -1e-12 * norm(m));
    random.shuffle(metrics);
    EXPECT_EQ(SMA::intersection_of_all(metrics), m) << "the same bits";
  }
}

TEST(Intersection_of_all, of_one_is_itself_and_of_none_is_zero)
{
  const Metric_tensor_3 m(3, 1, 4, 0, 0.5, 5);
  EXPECT_EQ(SMA::intersection_of_all(Tensors{m}), m);
  EXPECT_EQ(SMA::intersection_of_all(Tensors{}), zero);
}

TEST(Bounded_anisotropy, raises_small_eigenvalues_only)
{
  Random random(2);
  const Matrix_3 r = random_rotation(random);
  const Metric_tensor_3 m = SMA::metric_tensor(Vector_3(-4, 1e-9, 0.5), r);
  EXPECT_LT(distance(SMA::with_bounded_anisotropy(m, 10), SMA::metric_tensor(Vector_3(4, 0.04, 0.5), r)), 1e-14);
  EXPECT_LT(distance(SMA::with_bounded_anisotropy(m, 1), 4.0 * Metric_tensor_3()), 1e-14);
  EXPECT_EQ(SMA::with_bounded_anisotropy(zero, 100), zero);
}

// Curvature

TEST(Curvature_tensors, are_those_of_the_surface_up_to_sign)
{
  for (const Surface& surface : {analytic::ellipsoid(), analytic::torus(), analytic::graph()}) {
    const Soup soup = surface.mesh(3);
    const Reference r = reference(soup, false);
    const Tensors tensors = SMA::curvature_tensors(sequential, r);
    double squares = 0, n = 0;
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
      if (r.features.vertex_class[v] != SMA::Vertex_class::smooth) continue;
      const Metric_tensor_3 exact(surface.shape_operator(soup.points[v]));
      const Vector_3 expected = SMA::eigen_decomposition(SMA::with_bounded_anisotropy(exact, 1000)).values;
      squares += (SMA::eigen_decomposition(tensors[v]).values - expected).squaredNorm() / 2;
      ++n;
    }
    EXPECT_LT(std::sqrt(squares / n), 0.01 * surface.largest_curvature) << surface.name;
  }
}

TEST(Curvature_tensors, at_ridges_are_what_both_sides_and_the_curve_ask_for)
{
  const double radius = 1;
  const Soup soup = shapes::capped_cylinder(64, 12, 1.5);
  const Reference r = reference(soup);
  const Tensors tensors = SMA::curvature_tensors(sequential, r);
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Vector_3 p = soup.points[v], radial(p[0], p[1], 0);
    if (radial.norm() < 1 - 1e-9) { // inside of a cap
      EXPECT_EQ(tensors[v], zero);
      continue;
    }
    const Vector_3 around = Vector_3::UnitZ().cross(radial);
    EXPECT_GT(tensors[v].dot(around, around), 0.97 / radius);
    EXPECT_LT(tensors[v].dot(around, around), 1.2 / radius); // the side and the curve disagree a little on the direction
    EXPECT_LT(tensors[v].dot(radial, radial), 1e-3);
    EXPECT_LT(tensors[v].dot(Vector_3::UnitZ(), Vector_3::UnitZ()), 0.05); // one-sided fits leave a little
  }
}

TEST(Curvature_tensors, of_flat_sides_are_zero_wherever_they_are)
{
  for (const double shift : {0.0, 1e6}) {
    Soup soup = shapes::cube(6);
    for (Vector_3& p : soup.points) p = Vector_3(p[0] + 0.3 * p[1], p[1], p[2] + 0.1 * p[0]) + Vector_3(shift, shift, 0);
    for (const Metric_tensor_3& m : SMA::curvature_tensors(sequential, reference(soup))) EXPECT_EQ(norm(m), 0);
  }
}

TEST(Curvature_tensors, of_facets_are_what_they_bend)
{
  const Soup soup = shapes::open_cylinder(24, 8, 2); // of radius 1
  const Flat_reference facets(sequential, shapes::view(soup), soup.points, SMA::Feature_parameters());
  const Reference smooth = reference(soup);
  const Tensors of_facets = SMA::curvature_tensors(sequential, facets), of_surface = SMA::curvature_tensors(sequential, smooth);
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (smooth.features.vertex_class[v] != SMA::Vertex_class::smooth) continue;
    const Vector_3 around = Vector_3::UnitZ().cross(soup.points[v]);
    EXPECT_NEAR(of_surface[v].dot(around, around), 1, 0.05);
    EXPECT_NEAR(of_facets[v].dot(around, around), 1.5 / std::cos(pi / 24), 0.03); // strips: all bends are parallel
    EXPECT_LT(of_facets[v].dot(Vector_3::UnitZ(), Vector_3::UnitZ()), 0.01);
  }
}

/// Two planes at a right angle with a narrow chamfer in between: two bends of 45 degrees less a little, along y.
Soup chamfered_edge(double width)
{
  const double turn = pi / 4 - 0.02;
  const Vector_3 along(std::cos(turn), 0, -std::sin(turn)), down(std::cos(2 * turn), 0, -std::sin(2 * turn));
  return shapes::grid(5, 6, false, false, 0, [=](double u, double v) -> Vector_3 {
    const double x = 5 * u - 2;
    const Vector_3 y(0, v, 0);
    if (x < 0.5) return y + Vector_3(x / 2, 0, 0);
    return y + width * along + (x - 1) / 2 * down;
  });
}

TEST(Curvature_tensors, see_bends_that_fits_smooth)
{
  const double width = 0.04;
  const Soup soup = chamfered_edge(width);
  const Reference r = reference(soup);
  const Tensors tensors = SMA::curvature_tensors(sequential, r);
  const double bend = 3 * std::tan((pi / 4 - 0.02) / 2) / std::sqrt(width * 0.5);
  std::size_t bent = 0;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (r.features.vertex_class[v] != SMA::Vertex_class::smooth) continue;
    if (v % 6 != 2 && v % 6 != 3) continue;
    EXPECT_GT(SMA::eigen_decomposition(tensors[v]).values.maxCoeff(), 0.9 * bend);
    ++bent;
  }
  EXPECT_EQ(bent, 2u * 5);
}

// Hessians

template <class Execution = SMA::Sequential_execution>
Tensors hessians(const Reference& r, const SMA::Corner_jets& jets, const std::vector<double>& values,
                 const Execution& execution = {})
{
  Tensors tensors;
  for (const SMA::Hessian_estimate& h : SMA::estimate_hessians(execution, r.mesh, r.points, jets, values))
    tensors.push_back(h.tensor);
  return tensors;
}

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

// Normalisation

/// A hexagonal patch of `rings` rings of equilateral triangles with edges of length 1, stretched by `stretch` along x.
Soup hexagon(int rings, double stretch)
{
  Soup s;
  std::map<std::pair<int, int>, Index> id;
  for (int i = -rings; i <= rings; ++i)
    for (int j = -rings; j <= rings; ++j)
      if (std::abs(i + j) <= rings) {
        id[{i, j}] = Index(s.points.size());
        s.points.emplace_back(stretch * (i + 0.5 * j), std::sqrt(0.75) * j, 0);
      }
  const auto add = [&](std::pair<int, int> a, std::pair<int, int> b, std::pair<int, int> c) {
    if (id.count(a) && id.count(b) && id.count(c)) s.triangles.push_back({id[a], id[b], id[c]});
  };
  for (int i = -rings; i <= rings; ++i)
    for (int j = -rings; j <= rings; ++j) {
      add({i, j}, {i + 1, j}, {i, j + 1});
      add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
    }
  return s;
}

TEST(Complexity, counts_the_vertices_of_a_mesh_with_unit_edges_exactly)
{
  for (const double stretch : {1.0, 30.0})
    for (const int rings : {1, 4, 11}) {
      const Soup soup = hexagon(rings, stretch);
      const Reference r = reference(soup);
      const Metric_tensor_3 m(1 / (stretch * stretch), 0, 1, 0, 0, 1);
      const auto c = complexity(sequential, r.mesh, r.points, r.normals, Tensors(soup.points.size(), m));
      EXPECT_NEAR(SMA::expected_number_of_vertices(sequential, r.mesh, c, 1), double(soup.points.size()), 1e-9);
      EXPECT_NEAR(c.boundary_length, 6 * rings, 1e-9);
    }
}

TEST(Complexity, of_linear_sizes_is_the_integral_of_their_density)
{
  const Soup soup = shapes::square(16, 0.3);
  const Reference r = reference(soup);
  std::vector<double> sizes;
  Tensors tensors;
  for (const Vector_3& p : soup.points) {
    sizes.push_back(0.1 + 0.4 * p[0]);
    const double log_density = 2 - 3 * p[1];
    tensors.push_back(Metric_tensor_3(std::exp(log_density), 0, std::exp(log_density), 0, 0, 1));
  }
  const double of_sizes = complexity(sequential, r.mesh, r.points, r.normals, sizes).area;
  EXPECT_NEAR(of_sizes, 1 / (0.1 * 0.5), 1e-4 * of_sizes);
  const double of_tensors = complexity(sequential, r.mesh, r.points, r.normals, tensors).area;
  const double expected = (std::exp(2.0) - std::exp(-1.0)) / 3;
  EXPECT_NEAR(of_tensors, expected, 1e-6 * expected);
}

TEST(Complexity, on_a_curved_surface_measures_in_its_tangent_planes)
{
  const Soup soup = shapes::sphere(4, 0.2);
  const Reference r = reference(soup);
  Tensors tensors;
  for (const Vector_3& n : soup.points)
    tensors.push_back(Metric_tensor_3(Matrix_3(100 * (Matrix_3::Identity() - n * n.transpose()) + 1e-3 * n * n.transpose())));
  EXPECT_NEAR(complexity(sequential, r.mesh, r.points, r.normals, tensors).area, 400 * pi, 0.01 * 400 * pi);
  const std::vector<double> sizes(soup.points.size(), 0.1);
  EXPECT_NEAR(complexity(sequential, r.mesh, r.points, r.normals, sizes).area, 400 * pi, 0.01 * 400 * pi);
}

/// The sizes that a tensor asks for along the edge of `h`, at both of its ends, in their tangent planes.
std::pair<double, double> sizes_along(const Reference& r, const Tensors& tensors, Index h)
{
  const Index p = r.mesh.source(h), q = r.mesh.target(h);
  const Vector_3 e = r.points[q] - r.points[p], np = r.normals.at(h), nq = r.normals.at(SMA::Mesh_view::next(h));
  const Vector_3 middle = (np + nq).normalized();
  return {e.norm() / tensors[p].length(SMA::minimal_rotation(middle, np) * e),
          e.norm() / tensors[q].length(SMA::minimal_rotation(middle, nq) * e)};
}

/// The largest h-shock over the edges.
double largest_shock(const Reference& r, const Tensors& tensors)
{
  double largest = 1;
  for (Index h = 0; h < r.mesh.number_of_halfedges(); ++h) {
    if (!r.mesh.is_edge_owner(h)) continue;
    const auto [hp, hq] = sizes_along(r, tensors, h);
    const double length = (r.points[r.mesh.target(h)] - r.points[r.mesh.source(h)]).norm();
    largest = (std::max)(largest, std::exp(std::abs(hp - hq) / length));
  }
  return largest;
}

double largest_shock(const Reference& r, const std::vector<double>& sizes)
{
  Tensors tensors;
  for (const double h : sizes) tensors.push_back(Metric_tensor_3::isotropic(h));
  return largest_shock(r, tensors);
}

double largest_size(const std::vector<double>& sizes) { return *std::max_element(sizes.begin(), sizes.end()); }
double smallest_size(const std::vector<double>& sizes) { return *std::min_element(sizes.begin(), sizes.end()); }

double largest_size(const Tensors& tensors)
{
  double l = infinity;
  for (const Metric_tensor_3& m : tensors) l = (std::min)(l, SMA::eigen_decomposition(m).values[0]);
  return 1 / std::sqrt(l);
}

double smallest_size(const Tensors& tensors)
{
  double l = 0;
  for (const Metric_tensor_3& m : tensors) l = (std::max)(l, SMA::eigen_decomposition(m).values[2]);
  return 1 / std::sqrt(l);
}

template <class Value>
void expect_normalized(double max_anisotropy)
{
  const Soup soup = shapes::square(40, 0.3);
  const Reference r = reference(soup);
  std::vector<double> u;
  for (const Vector_3& p : soup.points) u.push_back(analytic::front(p));
  const SMA::Corner_jets jets = SMA::estimate_jets(sequential, r.mesh, r.points);
  const auto h = hessians(r, jets, u);
  for (const double p : {1.0, 2.0, 4.0, infinity}) {
    const SMA::Interpolation_norm norm(p);
    SMA::Scalable_metric metric{Tensors(soup.points.size()), SMA::Size_bounds(0.004, 0.2), 1.5};
    for (Index v = 0; v < soup.points.size(); ++v) // the square has corners, but all its sectors are flat
      metric.tensors[v] = SMA::multiscale_tensor(h[jets.of_corner[r.mesh.outgoing[v]]], norm, max_anisotropy);
    for (const double n : {400.0, 2000.0, 5000.0}) {
      const auto values = SMA::normalize_to_vertex_count<Value>(sequential, r.mesh, r.points, r.normals, metric, n);
      const auto c = complexity(sequential, r.mesh, r.points, r.normals, values);
      EXPECT_NEAR(SMA::expected_number_of_vertices(sequential, r.mesh, c), n, 0.01 * n) << p;
      EXPECT_LE(largest_size(values), 0.2 * (1 + 1e-9));
      EXPECT_GE(smallest_size(values), 0.004 * (max_anisotropy > 1 ? 0.85 : 1 - 1e-9)); // intersections
      EXPECT_LE(largest_shock(r, values), 1.5 * (1 + 1e-9));
    }
    // what the bounds do not allow
    const auto fewest = SMA::normalize_to_vertex_count<Value>(sequential, r.mesh, r.points, r.normals, metric, 10);
    EXPECT_NEAR(smallest_size(fewest), 0.2, 0.01);
    const auto most = SMA::normalize_to_vertex_count<Value>(sequential, r.mesh, r.points, r.normals, metric, 1e9);
    EXPECT_NEAR(smallest_size(most), 0.004, max_anisotropy > 1 ? 6e-4 : 1e-6);
  }
}

TEST(Normalization, of_sizes_meets_the_number_the_bounds_and_the_gradation) { expect_normalized<double>(1); }
TEST(Normalization, of_tensors_meets_the_number_the_bounds_and_the_gradation) { expect_normalized<Metric_tensor_3>(100); }

TEST(Normalization, of_nothing_is_uniform)
{
  const Soup soup = shapes::sphere(2);
  const Reference r = reference(soup);
  const SMA::Scalable_metric metric{Tensors(soup.points.size(), zero), SMA::Size_bounds(0.1, 0.7)};
  const auto sizes = SMA::normalize_to_vertex_count<double>(sequential, r.mesh, r.points, r.normals, metric, 1000);
  for (const double h : sizes) EXPECT_DOUBLE_EQ(h, sizes[0]);
  const auto complexity = SMA::complexity(sequential, r.mesh, r.points, r.normals, sizes);
  EXPECT_NEAR(SMA::expected_number_of_vertices(sequential, r.mesh, complexity), 1000, 15);
  for (const double h : SMA::normalize_to_vertex_count<double>(sequential, r.mesh, r.points, r.normals, metric, 10))
    EXPECT_NEAR(h, 0.7, 1e-12);
  EXPECT_THROW(SMA::normalize_to_vertex_count<double>(sequential, r.mesh, r.points, r.normals, metric, nan),
               SMA::Invalid_parameter_error);
  EXPECT_THROW(SMA::Size_bounds(0.2, 0.1), SMA::Invalid_parameter_error);
}

// Gradation

/// Small sizes across a wavy line, large ones elsewhere: shocks of `ratio`.
Tensors shock(const Reference& r, double ratio, double anisotropy)
{
  Tensors tensors;
  for (Index v = 0; v < r.points.size(); ++v) {
    const Vector_3 p = r.points[v], n = r.normals.at(r.mesh.outgoing[v]);
    const Vector_3 across = (Vector_3(1, 0.5 * std::cos(5 * p[1]), 0.3).cross(n)).cross(n).normalized();
    Matrix_3 axes;
    axes << across, n.cross(across), n;
    const bool is_near = std::abs(p[0] + 0.1 * std::sin(5 * p[1]) - 0.4) < 0.05;
    const double small = is_near ? 1 / ratio : 1, long_ = is_near ? anisotropy / ratio : 1;
    tensors.push_back(SMA::metric_tensor(Vector_3(1 / (small * small), 1 / (long_ * long_), 1), axes));
  }
  return tensors;
}

Tensors graded(const Reference& r, Tensors tensors, double ratio = 1.5)
{
  apply_gradation(sequential, r.mesh, r.points, r.normals, ratio, tensors);
  return tensors;
}

TEST(Anisotropic_gradation, asks_for_no_size_below_half_of_the_smallest)
{
  const Reference r = reference(shapes::torus(40, 16, 0.3));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, 6.28), exponent(-3, 0);
  Tensors tensors; // long and thin, in any direction
  for (Index v = 0; v < r.points.size(); ++v) {
    const Vector_3 n = r.normals.at(r.mesh.outgoing[v]);
    const Eigen::AngleAxisd turn(angle(random), n);
    const double size = std::pow(10, exponent(random));
    const Matrix_3 axes = (turn * Eigen::Quaterniond::FromTwoVectors(Vector_3(0, 0, 1), n)).toRotationMatrix();
    tensors.push_back(SMA::metric_tensor(Vector_3(1 / (size * size), 1e-2, 1), axes));
  }
  const auto largest = [](const Tensors& all) {
    double value = 0;
    for (const Metric_tensor_3& m : all) value = std::max(value, SMA::eigen_decomposition(m).values[2]);
    return value;
  };
  EXPECT_LE(largest(graded(r, tensors)), 4 * largest(tensors));
}

TEST(Anisotropic_gradation, bounds_the_shock_of_every_edge)
{
  for (const Soup& soup : {shapes::square(32, 0.3), shapes::torus(60, 24, 0.3), shapes::capped_cylinder(32, 8, 1)})
    for (const double anisotropy : {1.0, 10.0, 100.0}) {
      const Reference r = reference(soup);
      const Tensors before = shock(r, 1000, anisotropy), after = graded(r, before);
      EXPECT_GT(largest_shock(r, before), 1e3);
      EXPECT_LE(largest_shock(r, after), 1.5 * (1 + 1e-9));
      for (std::size_t v = 0; v < before.size(); ++v) // it only asks for more
        EXPECT_GE(SMA::eigen_decomposition(after[v] + (-1.0) * before[v]).values[0], -1e-10 * norm(after[v]));
    }
}

TEST(Anisotropic_gradation, of_isotropic_tensors_in_the_plane_is_that_of_their_sizes)
{
  const Soup soup = shapes::square(32, 0.3);
  const Reference r = reference(soup);
  Random random(5);
  std::vector<double> sizes;
  Tensors tensors;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    sizes.push_back(std::exp(random.real(-5, 1)));
    tensors.push_back(Metric_tensor_3::isotropic(sizes.back()));
  }
  SMA::apply_gradation(sequential, r.mesh, r.points, 1.3, sizes);
  tensors = graded(r, tensors, 1.3);
  for (std::size_t v = 0; v < sizes.size(); ++v)
    EXPECT_LT(distance(tensors[v], Metric_tensor_3::isotropic(sizes[v])), 1e-9 * norm(tensors[v]));
}

TEST(Anisotropic_gradation, is_the_same_bits_with_every_policy)
{
  const Reference r = reference(shapes::torus(36, 15, 0.3));
  const Tensors before = shock(r, 100, 30), expected = graded(r, before);
  for_each_policy([&](const auto& execution, const std::string& name) {
    Tensors tensors = before;
    apply_gradation(execution, r.mesh, r.points, r.normals, 1.5, tensors);
    EXPECT_TRUE(tensors == expected) << name;
  });
}

TEST(Anisotropic_gradation, does_not_depend_on_the_numbering)
{
  const Soup soup = shapes::torus(40, 16, 0.3);
  std::vector<Index> number(soup.points.size()); // the new one of each vertex
  std::iota(number.begin(), number.end(), Index(0));
  Random random(6);
  random.shuffle(number);
  Soup renumbered = soup;
  for (std::size_t v = 0; v < number.size(); ++v) renumbered.points[number[v]] = soup.points[v];
  random.shuffle(renumbered.triangles);
  for (shapes::Triangle& t : renumbered.triangles) {
    for (Index& v : t) v = number[v];
    std::rotate(t.begin(), t.begin() + std::ptrdiff_t(random.below(3)), t.end());
  }
  const Reference a = reference(soup, false), b = reference(renumbered, false);
  const Tensors before = shock(a, 100, 10);
  Tensors permuted(before.size());
  for (std::size_t v = 0; v < number.size(); ++v) permuted[number[v]] = before[v];
  const Tensors ga = graded(a, before), gb = graded(b, permuted);
  for (std::size_t v = 0; v < number.size(); ++v) EXPECT_LT(distance(ga[v], gb[number[v]]), 1e-12 * norm(ga[v]));
}

TEST(Anisotropic_gradation, is_switched_off_by_a_ratio_of_one)
{
  const Reference r = reference(shapes::square(12));
  const Tensors before = shock(r, 100, 10);
  for (const double ratio : {1.0, 0.0, nan}) EXPECT_TRUE(graded(r, before, ratio) == before);
}

// Proximity

Tensors proximity(const Soup& soup, double hmin, double hmax)
{
  return SMA::proximity_tensors(sequential, reference(soup), SMA::Size_bounds(hmin, hmax));
}

bool all_are_zero(const Tensors& tensors)
{
  return std::all_of(tensors.begin(), tensors.end(), [](const Metric_tensor_3& m) { return m == zero; });
}

TEST(Proximity_tensors, measure_across_strips_and_nothing_else)
{
  const double width = 0.1;
  for (const Soup& soup : {shapes::open_cylinder(64, 3, width), shapes::capped_cylinder(64, 3, width)}) {
    const Reference r = reference(soup);
    const Tensors tensors = SMA::proximity_tensors(sequential, r, SMA::Size_bounds(0.01, 1));
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
      if (r.features.vertex_class[v] == SMA::Vertex_class::smooth) {
        EXPECT_EQ(tensors[v], zero);
        continue;
      }
      const Vector_3 up = Vector_3::UnitZ(), radial = Vector_3(soup.points[v][0], soup.points[v][1], 0).normalized();
      EXPECT_NEAR(width * tensors[v].length(up), std::sqrt(0.75), 1e-6);
      EXPECT_LT(width * tensors[v].length(radial), 0.002); // the rest is the largest anisotropy
      EXPECT_LT(width * tensors[v].length(radial.cross(up)), 0.002);
    }
    for_each_policy([&](const auto& execution, const std::string& name) {
      EXPECT_EQ(SMA::proximity_tensors(execution, r, SMA::Size_bounds(0.01, 1)), tensors) << name;
    });
  }
}

TEST(Proximity_tensors, of_strips_narrower_and_wider_than_the_sizes_are_zero)
{
  const Soup soup = shapes::capped_cylinder(64, 3, 0.1);
  EXPECT_FALSE(all_are_zero(proximity(soup, 0.11, 0.12)));
  EXPECT_TRUE(all_are_zero(proximity(soup, 0.12, 1)));
  EXPECT_TRUE(all_are_zero(proximity(soup, 0.01, 0.11)));
}

TEST(Proximity_tensors, of_wedges_are_zero)
{
  const auto wedge = [](double degrees) {
    const double y = std::tan(degrees / 2 * pi / 180);
    return shapes::subdivided(shapes::subdivided(Soup{{{0, 0, 0}, {1, -y, 0}, {1, y, 0}}, {{0, 1, 2}}}));
  };
  EXPECT_TRUE(all_are_zero(proximity(wedge(30), 1e-3, 1)));
  EXPECT_FALSE(all_are_zero(proximity(wedge(10), 1e-3, 1)));
}

TEST(Proximity_tensors, of_degenerate_faces_are_finite)
{
  Soup soup = shapes::capped_cylinder(12, 2, 0.1);
  for (const std::size_t v : {3, 20}) soup.points[v] = soup.points[v + 1];
  for (const Metric_tensor_3& m : proximity(soup, 1e-6, 1)) EXPECT_TRUE(std::isfinite(norm(m)));
}

// Fields

/// The values of a field at the vertices, in the order of the mesh.
template <class Value, class Field>
std::vector<Value> vertex_metric(Mesh& mesh, const Field& field, const std::vector<double>& deviations = {})
{
  const auto imported = SMA::internal::read_face_graph(sequential, mesh, get(CGAL::vertex_point, mesh));
  const Reference r(sequential, imported.mesh, imported.points, {});
  std::vector<Value> result;
  const SMA::internal::Field_input input{imported.vertices, deviations};
  SMA::internal::with_vertex_metric(sequential, field, input, r, [&](const auto& values) {
    if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<Value>>) result = values;
    else ADD_FAILURE() << "a metric of the other kind";
  });
  return result;
}

/// A field at the vertices of `mesh`, as a property map.
template <class F>
auto scalar_map(Mesh& mesh, const F& f)
{
  const auto map = mesh.add_property_map<Mesh::Vertex_index, double>().first;
  for (const auto v : mesh.vertices()) map[v] = f(Vector_3(mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]));
  return map;
}

template <class F>
auto solution_field(Mesh& mesh, const F& f, std::size_t vertices)
{
  const auto map = scalar_map(mesh, f);
  return SMA::Solution_metric_field<std::decay_t<decltype(map)>>(map, vertices);
}

double wave(const Vector_3& p) { return std::sin(3 * p[0]) * std::cos(4 * p[1]) + p[2] * p[2]; }

TEST(Curvature_metric_field, has_the_sizes_of_the_chordal_bound)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(4, 0.3));
  const double tolerance = 1e-3, diagonal = 2 * std::sqrt(3.0); // relative to the diagonal of the sphere's box
  SMA::Curvature_metric_field field(tolerance);
  const double expected = std::sqrt(6 * tolerance * diagonal);
  for (const double h : vertex_metric<double>(mesh, field)) EXPECT_NEAR(h, expected, 0.02 * expected);
  field.anisotropic = true;
  for (const Metric_tensor_3& m : vertex_metric<Metric_tensor_3>(mesh, field)) {
    const Vector_3 l = SMA::eigen_decomposition(m).values;
    EXPECT_NEAR(1 / std::sqrt(l[1]), expected, 0.02 * expected);
    EXPECT_NEAR(1 / std::sqrt(l[2]), expected, 0.02 * expected);
  }
}

TEST(Curvature_metric_field, follows_the_deviations_of_faces)
{
  const Soup soup = shapes::sphere(3, 0.3);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  SMA::Curvature_metric_field field(1e-3);
  field.gradation = 1;
  const double common = 1e-3 * SMA::internal::diagonal_of_bounding_box(soup.points);
  std::vector<double> deviations(mesh.number_of_faces(), 0);
  for (const auto f : mesh.faces())
    if (mesh.point(mesh.target(mesh.halfedge(f))).x() > 0) deviations[f] = f.idx() % 2 == 0 ? common / 4 : 4 * common;
  const std::vector<double> plain = vertex_metric<double>(mesh, field);
  const std::vector<double> sizes = vertex_metric<double>(mesh, field, deviations);
  for (const auto v : mesh.vertices()) {
    double least = 4 * common;
    for (const auto f : CGAL::faces_around_target(mesh.halfedge(v), mesh))
      least = std::min(least, deviations[f] > 0 ? deviations[f] : common);
    EXPECT_NEAR(sizes[v], plain[v] * std::sqrt(least / common), 1e-12);
  }
  field.vertices = 1000; // whatever the tolerance is then
  EXPECT_EQ(vertex_metric<double>(mesh, field, deviations), vertex_metric<double>(mesh, field));
}

TEST(Curvature_metric_field, of_noisy_points_is_smoother_if_told)
{
  const Soup soup = analytic::with_noise(shapes::sphere(4, 0.3), 0.02);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  SMA::Curvature_metric_field field(1e-3);
  field.gradation = 1;
  const auto spread = [&](bool noisy) { // relative standard deviation of what is one size
    field.noisy = noisy;
    double sum = 0, squares = 0;
    for (const double h : vertex_metric<double>(mesh, field)) {
      sum += h;
      squares += h * h;
    }
    return std::sqrt(squares * double(soup.points.size()) / (sum * sum) - 1);
  };
  EXPECT_LT(spread(true), 0.04);
  EXPECT_GT(spread(false), 2 * spread(true));
}

TEST(Curvature_metric_field, is_anisotropic_only_as_far_as_it_may)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::open_cylinder(64, 32, 2));
  SMA::Curvature_metric_field field(1e-4);
  field.anisotropic = true;
  for (const double a : {1.0, 3.0}) {
    field.max_anisotropy = a;
    for (const Metric_tensor_3& m : vertex_metric<Metric_tensor_3>(mesh, field)) {
      const Vector_3 l = SMA::eigen_decomposition(m).values;
      EXPECT_LE(std::sqrt(l[2] / l[0]), a * 1.01); // at the ridge two of them meet
    }
  }
  field.max_anisotropy = 0.5;
  EXPECT_THROW(vertex_metric<Metric_tensor_3>(mesh, field), SMA::Invalid_parameter_error);
}

TEST(Curvature_metric_field, is_met_on_narrow_strips_between_features)
{
  for (const double width : {0.1, 0.03, 0.01}) {
    Mesh mesh = shapes::mesh<Mesh>(shapes::capped_cylinder(64, 1, width));
    SMA::Curvature_metric_field field(1e-3);
    field.anisotropic = true;
    const auto report = SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field);
    EXPECT_GT(report.final.in_range, 0.94) << width; // less than that of the strips alone: for the tolerance they are
    EXPECT_GT(report.final.mean_quality, 0.92) << width; // tightened in all directions
    EXPECT_GT(report.final.min_quality, 0.5) << width;
  }
}

TEST(Curvature_metric_field, keeps_the_distance_to_the_surface)
{
  const Surface torus = analytic::torus();
  for (const bool anisotropic : {false, true}) {
    Mesh mesh = shapes::mesh<Mesh>(shapes::torus(120, 48, 0.2));
    SMA::Curvature_metric_field field(4e-4);
    field.anisotropic = anisotropic;
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field);
    const double eps = 4e-4 * std::sqrt(2 * 2.7 * 2.7 + 0.7 * 0.7);
    std::vector<double> gaps; // the largest of each face, over its middle and the middles of its edges
    const Soup result = shapes::soup(mesh);
    for (const shapes::Triangle& t : result.triangles) {
      const Vector_3 &a = result.points[t[0]], &b = result.points[t[1]], &c = result.points[t[2]];
      double gap = 0;
      for (const Vector_3& p : {Vector_3((a + b) / 2), Vector_3((b + c) / 2), Vector_3((c + a) / 2), Vector_3((a + b + c) / 3)})
        gap = (std::max)(gap, std::abs(std::sqrt(2 * torus.implicit.value(p)) - shapes::torus_small_radius));
      gaps.push_back(gap);
    }
    std::sort(gaps.begin(), gaps.end());
    EXPECT_LT(gaps.back(), 3 * eps);
    EXPECT_LT(gaps[gaps.size() * 99 / 100], 2 * eps);
    EXPECT_GT(gaps[gaps.size() / 2], 0.2 * eps); // and no more than needed
  }
}

/// Adapts `mesh` to `field` and compares the number of vertices. Returns the adapted mesh.
template <class Field>
Mesh expect_number_of_vertices(Mesh mesh, const Field& field, const std::string& name)
{
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field);
  EXPECT_NEAR(double(mesh.number_of_vertices()), double(field.vertices), 0.05 * double(field.vertices))
    << name << (field.anisotropic ? " anisotropic" : " isotropic");
  return mesh;
}

SMA::Curvature_metric_field curvature_field(std::size_t vertices, bool anisotropic)
{
  SMA::Curvature_metric_field field(1);
  field.vertices = vertices;
  field.anisotropic = anisotropic;
  return field;
}

TEST(Number_of_vertices, is_met_by_the_adapted_mesh)
{
  const Mesh sphere = shapes::mesh<Mesh>(shapes::sphere(4, 0.3));
  Mesh torus = shapes::mesh<Mesh>(shapes::torus(80, 32, 0.3)), square = shapes::mesh<Mesh>(shapes::square(40, 0.3));
  for (const double ratio : {0.1, 0.3, 1.0, 1.2, 3.0})
    for (const bool anisotropic : {false, true}) {
      const auto n = [&](const Mesh& mesh) { return std::size_t(ratio * double(mesh.number_of_vertices())); };
      expect_number_of_vertices(sphere, curvature_field(n(sphere), anisotropic), "sphere");
      expect_number_of_vertices(torus, curvature_field(n(torus), anisotropic), "torus");
      auto on_torus = solution_field(torus, wave, n(torus)),
           on_square = solution_field(square, analytic::front, n(square));
      on_torus.anisotropic = on_square.anisotropic = anisotropic;
      expect_number_of_vertices(torus, on_torus, "wave on a torus");
      expect_number_of_vertices(square, on_square, "front");
    }
}

TEST(Number_of_vertices, is_met_on_a_part_with_ridges)
{
  const Mesh part = real_mesh<Mesh>("anchor_dense");
  for (const double ratio : {0.1, 0.3, 1.2})
    for (const bool anisotropic : {false, true})
      expect_number_of_vertices(
        part, curvature_field(std::size_t(ratio * double(part.number_of_vertices())), anisotropic), "part with ridges");
}

TEST(Number_of_vertices, is_met_where_the_metric_jumps)
{
  const Mesh part = real_mesh<Mesh>("anchor_dense");
  SMA::Curvature_metric_field field = curvature_field(part.number_of_vertices() / 10, true);
  field.gradation = 1;
  expect_number_of_vertices(part, field, "part with ridges, without gradation,");
}

TEST(Number_of_vertices, is_met_by_a_mesh_that_conforms_already)
{
  for (const bool anisotropic : {false, true}) {
    const Mesh torus = expect_number_of_vertices(shapes::mesh<Mesh>(shapes::torus(80, 32, 0.3)),
                                                 curvature_field(2000, anisotropic), "torus");
    for (const std::size_t n : {1500, 1800, 2200, 2700})
      expect_number_of_vertices(torus, curvature_field(n, anisotropic), "adapted torus, " + std::to_string(n));
  }
}

TEST(Number_of_vertices, is_met_within_the_bounds_of_the_sizes)
{
  Mesh square = shapes::mesh<Mesh>(shapes::square(40, 0.3));
  auto field = solution_field(square, analytic::front, 1600);
  field.hmin = 0.012;
  field.hmax = 0.06;
  for (const bool anisotropic : {false, true}) {
    field.anisotropic = anisotropic;
    Mesh adapted = square;
    const auto metric = adapted.add_property_map<Mesh::Vertex_index, Metric_tensor_3>("v:metric").first;
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(adapted, field, SMA::parameters::output_metric_map(metric));
    EXPECT_NEAR(double(adapted.number_of_vertices()), 1600, 0.05 * 1600);
    Tensors tensors;
    for (const auto v : adapted.vertices()) tensors.push_back(metric[v]);
    EXPECT_LE(largest_size(tensors), field.hmax * (1 + 1e-9));
    EXPECT_GE(smallest_size(tensors), field.hmin * (anisotropic ? 0.85 : 1 - 1e-9)); // intersections
    std::size_t outside = 0; // of what edges in range may measure
    for (const auto e : adapted.edges()) {
      const auto &a = adapted.point(adapted.vertex(e, 0)), &b = adapted.point(adapted.vertex(e, 1));
      const double l = std::sqrt(CGAL::squared_distance(a, b));
      outside += l < field.hmin * std::sqrt(0.5) || l > field.hmax * std::sqrt(2.0) ? 1 : 0;
    }
    EXPECT_LT(double(outside), 0.01 * double(adapted.number_of_edges()));
  }
}

TEST(Number_of_vertices, gives_way_to_the_bounds_of_the_sizes)
{
  const Mesh sphere = shapes::mesh<Mesh>(shapes::sphere(4, 0.3));
  SMA::Curvature_metric_field field = curvature_field(20000, false);
  field.hmin = 0.06;
  const double n = SMA::default_packing * 2 / std::sqrt(3.0) * 4 * pi / (field.hmin * field.hmin);
  Mesh adapted = sphere;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(adapted, field);
  EXPECT_NEAR(double(adapted.number_of_vertices()), n, 0.05 * n);
}

/// The unit sphere adapted to sizes of .2 but across its equator, where they are .2 over `anisotropy` in the middle.
struct Layer_on_a_sphere
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(4, 0.3));
  SMA::Mesh_statistics statistics;

  template <class Execution>
  Layer_on_a_sphere(const Execution& execution, double anisotropy, unsigned rounds = SMA::default_number_of_rounds)
  {
    const SMA::Analytic_metric_field field([=](const Vector_3& p) {
      const double least = 0.2 / anisotropy, h = least + (0.2 - least) * std::abs(p[1]);
      return SMA::metric_tensor(Vector_3(25, 1 / (h * h), 25), Matrix_3::Identity());
    });
    statistics = SMA::adapt_surface_mesh(execution, mesh, field, SMA::parameters::number_of_iterations(rounds)).final;
  }

  /// The least cosine between a face and the sphere at its corners.
  double least_alignment() const
  {
    const Soup soup = shapes::soup(mesh);
    double least = 1;
    for (const shapes::Triangle& t : soup.triangles) {
      const Vector_3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
      const Vector_3 n = (b - a).cross(c - a).normalized();
      for (const Vector_3& p : {a, b, c}) least = (std::min)(least, n.dot(p) / p.norm());
    }
    return least;
  }
};

TEST(Analytic_metric_field, of_a_thin_layer_around_a_sphere_is_met)
{
  for (const double anisotropy : {100, 1000}) { // edges along it cut 2.5 and 25 smallest sizes deep into the sphere
    const Layer_on_a_sphere layer(sequential, anisotropy);
    EXPECT_GT(layer.statistics.in_range, anisotropy > 100 ? 0.92 : 0.98);
    EXPECT_GT(layer.statistics.mean_quality, anisotropy > 100 ? 0.9 : 0.96);
    EXPECT_GT(layer.statistics.min_quality, 0.2);
    EXPECT_GT(layer.least_alignment(), 0.9 * SMA::min_alignment_of_thin_faces); // normals are estimated
  }
}

TEST(Analytic_metric_field, of_a_thin_layer_gives_the_same_bits_with_every_policy)
{
  const Soup expected = shapes::soup(Layer_on_a_sphere(sequential, 100, 2).mesh);
  for_each_policy([&](const auto& execution, const std::string& name) {
    const Soup soup = shapes::soup(Layer_on_a_sphere(execution, 100, 2).mesh);
    EXPECT_EQ(soup.points, expected.points) << name;
    EXPECT_EQ(soup.triangles, expected.triangles) << name;
  });
}

TEST(Solution_metric_field, of_a_constant_is_uniform)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::torus(40, 16, 0.2));
  auto field = solution_field(mesh, [](const Vector_3&) { return 3.7; }, 1000);
  field.hmax = 0.25;
  const auto sizes = vertex_metric<double>(mesh, field);
  for (const double h : sizes) EXPECT_DOUBLE_EQ(h, sizes[0]);
  EXPECT_LT(sizes[0], field.hmax);
  SMA::adapt_surface_mesh(mesh, field);
  EXPECT_NEAR(double(mesh.number_of_vertices()), 1000, 100);
}

TEST(Solution_metric_field, reports_the_vertex_of_the_input_with_a_bad_value)
{
  Soup soup = shapes::torus(40, 16, 0.2);
  Random(8).shuffle(soup.triangles); // a poor order: the mesh is renumbered inside
  Mesh mesh = shapes::mesh<Mesh>(soup);
  auto field = solution_field(mesh, wave, 1000);
  field.values[Mesh::Vertex_index(123)] = nan;
  const Soup before = shapes::soup(mesh);
  try {
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field);
    FAIL();
  } catch (const SMA::Invalid_field_error& e) {
    EXPECT_EQ(e.index(), 123u);
  }
  EXPECT_EQ(shapes::soup(mesh).points, before.points);
  EXPECT_THROW(solution_field(mesh, wave, 0), SMA::Invalid_parameter_error);
  auto half = solution_field(mesh, wave, 1000);
  half.norm = 0.5;
  EXPECT_THROW(SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, half), SMA::Invalid_parameter_error);
}

TEST(Intersection_metric_field, of_sizes_is_the_smaller_one)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::square(20, 0.3));
  const auto map = scalar_map(mesh, [](const Vector_3& p) { return 0.05 + 0.1 * p[0]; });
  SMA::Intersection_metric_field field(SMA::Uniform_metric_field(0.1), map);
  field.gradation = 1;
  field.hmax = 10;
  const std::vector<double> sizes = vertex_metric<double>(mesh, field);
  for (const auto v : mesh.vertices()) EXPECT_NEAR(sizes[v], (std::min)(0.1, map[v]), 1e-12);
  map[Mesh::Vertex_index(5)] = -1;
  EXPECT_THROW(vertex_metric<double>(mesh, field), SMA::Invalid_metric_error);
}

TEST(Intersection_metric_field, of_tensors_dominates_them_and_meets_a_number)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::torus(60, 24, 0.3));
  SMA::Curvature_metric_field curvature(1e-3);
  auto solution = solution_field(mesh, wave, 2000);
  curvature.anisotropic = solution.anisotropic = true;
  curvature.gradation = solution.gradation = 1;
  SMA::Intersection_metric_field field(curvature, solution, SMA::Uniform_metric_field(0.3));
  field.gradation = 1;
  const Tensors both = vertex_metric<Metric_tensor_3>(mesh, field), one = vertex_metric<Metric_tensor_3>(mesh, curvature),
                other = vertex_metric<Metric_tensor_3>(mesh, solution);
  for (std::size_t v = 0; v < both.size(); ++v)
    for (const Metric_tensor_3& m : {one[v], other[v], Metric_tensor_3::isotropic(0.3)})
      EXPECT_GT(SMA::eigen_decomposition(both[v] + (-1.0) * m).values[0], -1e-10 * norm(both[v]));
  field.gradation = 1.5;
  field.vertices = 3000;
  Mesh adapted = mesh;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(adapted, field);
  EXPECT_NEAR(double(adapted.number_of_vertices()), 3000, 0.05 * 3000);
}

TEST(Intersection_metric_field, fits_strips_whatever_the_scale)
{
  const double width = 0.05;
  Mesh mesh = shapes::mesh<Mesh>(shapes::capped_cylinder(64, 1, width));
  SMA::Curvature_metric_field curvature(1e-3);
  curvature.anisotropic = true;
  const auto expect_fit = [&](auto field) {
    for (const std::size_t n : {0, 300, 1200}) {
      field.vertices = n;
      const Tensors tensors = vertex_metric<Metric_tensor_3>(mesh, field);
      for (const auto v : mesh.vertices()) {
        const bool is_on_strip = std::hypot(mesh.point(v).x(), mesh.point(v).y()) > 0.99;
        EXPECT_TRUE(!is_on_strip || std::abs(width * tensors[v].length(Vector_3::UnitZ()) - std::sqrt(0.75)) < 0.02) << n;
      }
    }
  };
  const SMA::Intersection_metric_field field(curvature, SMA::Uniform_metric_field(0.5));
  expect_fit(field);
  expect_fit(SMA::Intersection_metric_field(SMA::Uniform_metric_field(0.4), field));
}

TEST(Metric_fields, give_the_same_bits_with_every_policy)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::capped_cylinder(40, 12, 1));
  SMA::Curvature_metric_field curvature(1e-3);
  auto solution = solution_field(mesh, wave, 500);
  curvature.anisotropic = solution.anisotropic = true;
  SMA::Intersection_metric_field field(curvature, solution);
  field.vertices = 300;
  Soup expected;
  for_each_policy([&](const auto& execution, const std::string& name) {
    Mesh adapted = mesh;
    const auto report = SMA::adapt_surface_mesh(execution, adapted, field, SMA::parameters::number_of_iterations(1));
    EXPECT_GT(report.rounds, 1u) << "the number of vertices is corrected";
    const Soup soup = shapes::soup(adapted);
    if (expected.points.empty()) expected = soup;
    EXPECT_EQ(soup.points, expected.points) << name;
    EXPECT_EQ(soup.triangles, expected.triangles) << name;
  });
}

/// Mean error of the linear interpolation of the front on a mesh of the unit square.
double interpolation_error(const Mesh& mesh)
{
  return analytic::interpolation_error(shapes::soup(mesh), analytic::front).l1;
}

TEST(Solution_metric_field, spends_the_vertices_where_the_field_bends)
{
  const auto error = [](std::size_t n, bool anisotropic) {
    Mesh mesh = shapes::mesh<Mesh>(shapes::square(100, 0.3)); // resolves the front
    auto field = solution_field(mesh, analytic::front, n);
    field.norm = 1;
    field.anisotropic = anisotropic;
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field);
    return interpolation_error(mesh);
  };
  const double uniform = interpolation_error(shapes::mesh<Mesh>(shapes::square(31, 0.2))); // 1024 vertices
  const double isotropic = error(1000, false), anisotropic = error(1000, true);
  EXPECT_LT(isotropic, uniform / 3);
  EXPECT_LT(anisotropic, isotropic / 2);
  EXPECT_LT(error(4000, true), anisotropic / 3.5); // order 2 in the mean edge length is 4
}

} // namespace

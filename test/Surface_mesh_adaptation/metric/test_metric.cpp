// SPDX-License-Identifier: GPL-3.0-or-later
//
// The algebra of metric tensors against closed forms, and their transport.

#include "policies.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>
#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>

#include <Eigen/LU>

#include <gtest/gtest.h>

namespace test_metric {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::pi;
using shapes::Random;
using SMA::Anisotropic_metric;
using SMA::Isotropic_metric;
using SMA::Matrix_3;
using SMA::Metric_tensor_3;
using SMA::Vector_3;

constexpr int trials = 1000;

Matrix_3 random_rotation(Random& random)
{
  const double angle = random.real(0, pi);
  return Eigen::AngleAxisd(angle, random.vector().normalized()).toRotationMatrix();
}

/// A tensor with eigenvalues between `1/ratio` and `ratio`.
Metric_tensor_3 random_metric(Random& random, double ratio = 100)
{
  const double l = std::log(ratio), a = random.real(-l, l), b = random.real(-l, l), c = random.real(-l, l);
  return SMA::metric_tensor(Vector_3(std::exp(a), std::exp(b), std::exp(c)), random_rotation(random));
}

double norm(const Metric_tensor_3& m) { return m.matrix().norm(); }
double distance(const Metric_tensor_3& a, const Metric_tensor_3& b) { return (a.matrix() - b.matrix()).norm(); }

TEST(Metric_tensor, has_the_eigenvalues_and_vectors_it_was_made_of)
{
  Random random(1);
  for (int i = 0; i < trials; ++i) {
    Vector_3 values(std::exp(random.real(-5, 5)), std::exp(random.real(-5, 5)), std::exp(random.real(-5, 5)));
    std::sort(values.data(), values.data() + 3);
    const Matrix_3 r = random_rotation(random);
    const Metric_tensor_3 m = SMA::metric_tensor(values, r);
    const SMA::Eigen_decomposition_3 e = SMA::eigen_decomposition(m);
    EXPECT_LT((e.values - values).norm(), 1e-12 * values[2]);
    EXPECT_LT((e.vectors.transpose() * e.vectors - Matrix_3::Identity()).norm(), 1e-12);
    EXPECT_LT((m.matrix() * e.vectors - e.vectors * e.values.asDiagonal()).norm(), 1e-12 * values[2]);
    EXPECT_NEAR(SMA::second_invariant(m), values[0] * values[1] + values[0] * values[2] + values[1] * values[2],
                1e-12 * values[2] * values[2]);
    EXPECT_TRUE(SMA::is_positive_definite(m));
    EXPECT_FALSE(SMA::is_positive_definite(SMA::metric_tensor(Vector_3(-values[0], values[1], values[2]), r)));
  }
}

TEST(Metric_tensor, keeps_its_coefficients_in_the_order_of_medit)
{
  const Metric_tensor_3 m(1, 2, 3, 4, 5, 6);
  Matrix_3 expected;
  expected << 1, 2, 4, 2, 3, 5, 4, 5, 6;
  EXPECT_EQ(m.matrix(), expected);
  EXPECT_EQ(Metric_tensor_3(expected), m);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(m[i], i + 1);
  const Vector_3 u(1, -2, 3), v(0.5, 4, -1);
  EXPECT_EQ(m * u, expected * u);
  EXPECT_DOUBLE_EQ(m.dot(u, v), u.dot(expected * v));
  EXPECT_DOUBLE_EQ((2.0 * m + m)[4], 15);
}

TEST(Metric_tensor, measures_an_edge_of_the_size_asked_for_as_one)
{
  Random random(2);
  for (int i = 0; i < trials; ++i) {
    const double size = std::exp(random.real(-8, 8));
    const Vector_3 direction = random.vector().normalized();
    EXPECT_NEAR(Metric_tensor_3::isotropic(size).length(size * direction), 1, 1e-12);
    const Metric_tensor_3 m = random_metric(random);
    const SMA::Eigen_decomposition_3 e = SMA::eigen_decomposition(m);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(m.length(e.vectors.col(k) / std::sqrt(e.values[k])), 1, 1e-12);
  }
}

TEST(Metric_tensor, comes_back_from_its_logarithm)
{
  Random random(3);
  for (int i = 0; i < trials; ++i) {
    const Metric_tensor_3 m = random_metric(random);
    EXPECT_LT(distance(exp(log(m)), m), 1e-12 * norm(m));
    EXPECT_LT(distance(log(exp(log(m))), log(m)), 1e-11);
    EXPECT_NEAR(std::exp(log(m).matrix().trace()), m.matrix().determinant(), 1e-9 * m.matrix().determinant());
  }
  EXPECT_EQ(norm(log(Metric_tensor_3())), 0);
}

TEST(Metric_tensor, interpolates_sizes_geometrically)
{
  Random random(4);
  const Metric_tensor_3 a = Metric_tensor_3::isotropic(0.1), b = Metric_tensor_3::isotropic(10);
  EXPECT_LT(distance(log_euclidean_interpolation(a, b, 0.5), Metric_tensor_3()), 1e-12);
  for (int i = 0; i < trials; ++i) {
    const Metric_tensor_3 m = random_metric(random), n = random_metric(random);
    const double t = random.real();
    EXPECT_LT(distance(log_euclidean_interpolation(m, n, 0), m), 1e-11 * norm(m));
    EXPECT_LT(distance(log_euclidean_interpolation(m, n, 1), n), 1e-11 * norm(n));
    EXPECT_LT(distance(log_euclidean_interpolation(m, m, t), m), 1e-11 * norm(m));
    const Metric_tensor_3 x = log_euclidean_interpolation(m, n, t);
    const double expected = std::pow(m.matrix().determinant(), 1 - t) * std::pow(n.matrix().determinant(), t);
    EXPECT_NEAR(x.matrix().determinant(), expected, 1e-9 * expected); // no swelling
    const Matrix_3 r = random_rotation(random);
    EXPECT_LT(distance(log_euclidean_interpolation(rotated(m, r), rotated(n, r), t), rotated(x, r)), 1e-11 * norm(x));
  }
}

/// How far `m` is from dominating `a`: 0 or less if `m >= a` in every direction.
double excess(const Metric_tensor_3& a, const Metric_tensor_3& m)
{
  return -SMA::eigen_decomposition(m + (-1.0) * a).values[0] / norm(m);
}

TEST(Intersection, dominates_both_and_touches_them)
{
  Random random(5);
  for (int i = 0; i < trials; ++i) {
    const Metric_tensor_3 a = random_metric(random), b = random_metric(random), m = intersection(a, b);
    EXPECT_LT(excess(a, m), 1e-12);
    EXPECT_LT(excess(b, m), 1e-12);
    // the common eigenvectors of the pencil: along each of them it equals the larger of the two
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix_3> pencil(b.matrix(), a.matrix());
    for (int k = 0; k < 3; ++k) {
      const Vector_3 v = pencil.eigenvectors().col(k);
      const double expected = (std::max)(a.squared_length(v), b.squared_length(v));
      EXPECT_NEAR(m.squared_length(v), expected, 1e-8 * expected);
    }
    EXPECT_LT(distance(m, intersection(b, a)), 1e-11 * norm(m)); // commutative
    EXPECT_LT(distance(intersection(m, m), m), 1e-12 * norm(m)); // idempotent
    EXPECT_LT(distance(intersection(m, a), m), 1e-10 * norm(m)); // absorbs
  }
}

TEST(Intersection, is_exact_for_homothetic_tensors)
{
  Random random(6);
  for (int i = 0; i < trials; ++i) {
    const Metric_tensor_3 a = random_metric(random);
    EXPECT_LT(distance(intersection(a, a), a), 1e-12 * norm(a));
    EXPECT_LT(distance(intersection(a, 4.0 * a), 4.0 * a), 1e-12 * norm(4.0 * a));
    EXPECT_LT(distance(intersection(a, 0.25 * a), a), 1e-12 * norm(a));
    const Metric_tensor_3 near = 2.0 * a + 1e-10 * random_metric(random, 2); // the pencil is lost in rounding there
    EXPECT_LT(distance(intersection(a, near), near), 1e-9 * norm(a));
  }
}

// Lengths and qualities

TEST(Edge_length, is_the_mean_of_both_ends)
{
  Random random(7);
  for (int i = 0; i < trials; ++i) {
    const Vector_3 e = random.vector();
    const Isotropic_metric a{random.real(0.1, 10)}, b{random.real(0.1, 10)};
    EXPECT_DOUBLE_EQ(edge_length(a, b, e), (a.inverse_size + b.inverse_size) / 2 * e.norm());
    EXPECT_DOUBLE_EQ(edge_length(a, b, e), edge_length(b, a, -e));
    const Anisotropic_metric m{random_metric(random)}, n{random_metric(random)};
    EXPECT_DOUBLE_EQ(edge_length(m, n, e), (m.m.length(e) + n.m.length(e)) / 2);
    const Anisotropic_metric a_tensor{a.tensor()}, b_tensor{b.tensor()};
    EXPECT_NEAR(edge_length(a_tensor, b_tensor, e), edge_length(a, b, e), 1e-12 * edge_length(a, b, e));
  }
}

double quality(const Metric_tensor_3& m, const Vector_3& e1, const Vector_3& e2)
{
  const Anisotropic_metric a{m};
  return face_quality(a, a, a, e1, e2);
}

TEST(Face_quality, is_one_for_a_triangle_that_is_equilateral_in_the_metric)
{
  Random random(8);
  const Isotropic_metric one;
  for (int i = 0; i < trials; ++i) {
    const Matrix_3 r = random_rotation(random);
    const double scale = std::exp(random.real(-10, 10));
    const Vector_3 e1 = scale * r * Vector_3(1, 0, 0), e2 = scale * r * Vector_3(0.5, std::sqrt(0.75), 0);
    EXPECT_NEAR(face_quality(one, one, one, e1, e2), 1, 1e-12);
    const Metric_tensor_3 m = random_metric(random, 30);
    const SMA::Eigen_decomposition_3 e = SMA::eigen_decomposition(m);
    const Matrix_3 inverse_root = e.vectors * e.values.cwiseSqrt().cwiseInverse().asDiagonal() * e.vectors.transpose();
    EXPECT_NEAR(quality(m, inverse_root * e1, inverse_root * e2), 1, 1e-9);
  }
}

TEST(Face_quality, is_the_same_from_every_corner_and_at_every_scale)
{
  Random random(9);
  for (int i = 0; i < trials; ++i) {
    const Vector_3 a = random.vector(), b = random.vector(), c = random.vector();
    const Metric_tensor_3 m = random_metric(random, 10);
    const double q = quality(m, b - a, c - a), s = std::exp(random.real(-5, 5));
    EXPECT_GT(q, 0);
    EXPECT_LE(q, 1 + 1e-12);
    EXPECT_NEAR(quality(m, c - b, a - b), q, 1e-9);
    EXPECT_NEAR(quality(s * m, b - a, c - a), q, 1e-9);
    EXPECT_NEAR(quality(m, s * (b - a), s * (c - a)), q, 1e-9);
    const Isotropic_metric one;
    const double expected = 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() /
                            ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
    EXPECT_NEAR(face_quality(one, one, one, b - a, c - a), expected, 1e-12);
    EXPECT_NEAR(quality(Metric_tensor_3(), b - a, c - a), expected, 1e-9);
  }
}

TEST(Face_quality, is_zero_for_degenerate_triangles)
{
  const Isotropic_metric one;
  const Vector_3 e(1, 2, 3), zero = Vector_3::Zero();
  for (const auto& pair :
       {std::make_pair(e, zero), std::make_pair(zero, e), std::make_pair(zero, zero), std::make_pair(e, e)}) {
    EXPECT_EQ(face_quality(one, one, one, pair.first, pair.second), 0);
    EXPECT_LT(quality(Metric_tensor_3(), pair.first, pair.second), 1e-7);
  }
}

// Transport

/// Differentiates the inverse of `face_quality` and compares.
template <class Metric>
void expect_gradient_of_distortion(const Metric& a, const Metric& b, const Metric& c, Random& random)
{
  const Vector_3 p = random.vector(), q = random.vector(), r = random.vector();
  const auto value = [&](const Vector_3& x) { return 1 / face_quality(a, b, c, q - x, r - x); };
  if (!(value(p) < 20)) return; // where finite differences say something
  const SMA::Distortion f = face_distortion(a, b, c, q - p, r - p);
  EXPECT_NEAR(f.value, value(p), 1e-12 * f.value);
  for (int i = 0; i < 3; ++i) {
    constexpr double h = 1e-6;
    const double difference = (value(p + h * Vector_3::Unit(i)) - value(p - h * Vector_3::Unit(i))) / (2 * h);
    EXPECT_NEAR(f.gradient[i], difference, 1e-5 * (1 + f.gradient.norm()));
  }
}

TEST(Face_distortion, is_the_inverse_of_the_quality_with_its_gradient)
{
  Random random(21);
  for (int i = 0; i < trials; ++i) {
    expect_gradient_of_distortion(Isotropic_metric{2}, Isotropic_metric{3}, Isotropic_metric{4}, random);
    const Anisotropic_metric a{random_metric(random, 3)}, b{random_metric(random, 3)}, c{random_metric(random, 3)};
    expect_gradient_of_distortion(a, b, c, random);
  }
  const Isotropic_metric one;
  EXPECT_EQ(face_distortion(one, one, one, Vector_3(1, 0, 0), Vector_3(2, 0, 0)).value, INFINITY);
}

TEST(Minimal_rotation, takes_one_normal_to_the_other)
{
  Random random(11);
  for (int i = 0; i < trials; ++i) {
    const Vector_3 n = random.vector().normalized();
    const Vector_3 m =
      i % 2 == 0 ? Vector_3(random.vector().normalized()) : Vector_3((n + 1e-6 * random.vector()).normalized());
    const Matrix_3 r = SMA::minimal_rotation(n, m);
    const double tolerance = 4e-14 / (1 + n.dot(m)); // next to opposite normals the axis is uncertain
    EXPECT_LT((r * n - m).norm(), tolerance);
    EXPECT_LT((r.transpose() * r - Matrix_3::Identity()).norm(), tolerance);
    EXPECT_NEAR(r.determinant(), 1, tolerance);
    const Vector_3 axis = n.cross(m);
    EXPECT_LT((r * axis - axis).norm(), tolerance);
    EXPECT_LT((SMA::minimal_rotation(m, n) * r - Matrix_3::Identity()).norm(), tolerance);
  }
}

TEST(Minimal_rotation, is_defined_everywhere)
{
  const Vector_3 n(0.6, 0, 0.8);
  EXPECT_LT((SMA::minimal_rotation(n, n) - Matrix_3::Identity()).norm(), 1e-15);
  EXPECT_TRUE(SMA::minimal_rotation(n, -n).allFinite());
  EXPECT_TRUE(SMA::minimal_rotation(n, (-n + 1e-9 * Vector_3::UnitY()).normalized()).allFinite());
}

TEST(Minimal_rotation, turns_by_the_area_enclosed_on_the_sphere)
{
  const Vector_3 x = Vector_3::UnitX(), y = Vector_3::UnitY(), z = Vector_3::UnitZ();
  // the octant: a quarter of a turn
  const Vector_3 t = SMA::minimal_rotation(z, x) * SMA::minimal_rotation(y, z) * SMA::minimal_rotation(x, y) * y;
  EXPECT_NEAR(std::atan2(t.dot(z), t.dot(y)), pi / 2, 1e-12);

  Random random(12);
  for (int i = 0; i < trials; ++i) {
    const Vector_3 a = random.vector().normalized(), b = (a + 0.5 * random.vector()).normalized(),
                   c = (a + 0.5 * random.vector()).normalized();
    const double area = 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    const Vector_3 u = a.unitOrthogonal(), v = a.cross(u);
    const Vector_3 w = SMA::minimal_rotation(c, a) * SMA::minimal_rotation(b, c) * SMA::minimal_rotation(a, b) * u;
    EXPECT_NEAR(std::atan2(w.dot(v), w.dot(u)), area, 1e-12);
  }
}

TEST(Minimal_rotation, is_exact_along_great_circles_in_any_number_of_steps)
{
  Random random(13);
  for (const int steps : {1, 2, 7, 64}) {
    const Vector_3 n = random.vector().normalized(), t = n.unitOrthogonal(), b = n.cross(t);
    const double angle = 2.5;
    Vector_3 carried = t + 0.3 * b, at = n;
    for (int i = 1; i <= steps; ++i) {
      const Vector_3 next = std::cos(angle * i / steps) * n + std::sin(angle * i / steps) * t;
      carried = SMA::minimal_rotation(at, next) * carried;
      at = next;
    }
    const Vector_3 expected = std::cos(angle) * t - std::sin(angle) * n + 0.3 * b;
    EXPECT_LT((carried - expected).norm(), 1e-12);
  }
}

TEST(Minimal_rotation, keeps_the_sizes_of_a_tensor)
{
  Random random(14);
  for (int i = 0; i < 20; ++i) {
    Metric_tensor_3 m = random_metric(random, 100);
    const Vector_3 before = SMA::eigen_decomposition(m).values;
    Vector_3 at = random.vector().normalized();
    for (int step = 0; step < 64; ++step) {
      const Vector_3 next = (at + 0.2 * random.vector()).normalized();
      m = rotated(m, SMA::minimal_rotation(at, next));
      at = next;
    }
    const Vector_3 after = SMA::eigen_decomposition(m).values;
    EXPECT_LT((after - before).norm(), 1e-11 * before[2]);
  }
}

TEST(Minimal_rotation, converges_at_second_order_along_a_curve_of_the_torus)
{
  // along a parallel of the torus (not a geodesic) the exact turn is known: minus the angle around the axis times the
  // sine of the latitude
  const double latitude = 0.7, total = 1.0;
  const auto normal = [&](double u) {
    return Vector_3(std::cos(latitude) * std::cos(u), std::cos(latitude) * std::sin(u), std::sin(latitude));
  };
  const auto east = [&](double u) { return Vector_3(-std::sin(u), std::cos(u), 0); };
  double previous = 0;
  for (const int steps : {4, 8, 16, 32, 64}) {
    Vector_3 t = east(0);
    for (int i = 0; i < steps; ++i)
      t = SMA::minimal_rotation(normal(total * i / steps), normal(total * (i + 1) / steps)) * t;
    const Vector_3 north = normal(total).cross(east(total));
    const double error = std::abs(std::atan2(t.dot(north), t.dot(east(total))) + total * std::sin(latitude));
    if (previous > 0) {
      EXPECT_GT(std::log2(previous / error), 1.9);
    }
    previous = error;
  }
  EXPECT_LT(previous, 1e-4);
}

// Gradation

TEST(Gradation, bounds_the_growth_of_sizes_from_below_only)
{
  const shapes::Soup s = shapes::torus(60, 30, 0.2);
  const SMA::Mesh_view mesh = shapes::view(s);
  Random random(15);
  std::vector<double> wanted(s.points.size());
  for (double& h : wanted) h = std::exp(random.real(-4, 2));
  std::vector<double> first;
  for_each_policy([&](const auto& execution, const std::string& name) {
    std::vector<double> sizes = wanted;
    SMA::apply_gradation(execution, mesh, s.points, 1.4, sizes);
    if (first.empty()) first = sizes;
    EXPECT_EQ(sizes, first) << name;
  });
  bool lowered = false;
  for (SMA::Index h = 0; h < mesh.number_of_halfedges(); ++h) {
    const SMA::Index v = mesh.source(h), w = mesh.target(h);
    const double length = (s.points[v] - s.points[w]).norm();
    EXPECT_LE(std::abs(first[v] - first[w]), length * std::log(1.4) * (1 + 1e-9));
    EXPECT_LE(first[v], wanted[v]);
    lowered = lowered || first[v] < wanted[v];
  }
  EXPECT_TRUE(lowered);
  EXPECT_EQ(*std::min_element(first.begin(), first.end()), *std::min_element(wanted.begin(), wanted.end()));
  std::vector<double> off = wanted;
  SMA::apply_gradation(SMA::Sequential_execution(), mesh, s.points, 1, off);
  EXPECT_EQ(off, wanted);
}

} // namespace test_metric

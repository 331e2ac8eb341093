// SPDX-License-Identifier: GPL-3.0-or-later
//
// What tensors have in common, and those of the curvature.

#include "analytic_fields.h"
#include "fields/tensors.h"

#include <CGAL/Surface_mesh_adaptation/fields/curvature.h>
#include <CGAL/Surface_mesh_adaptation/metric/Size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace test_curvature_tensors {

using namespace tensors_of_tests;
using analytic::Surface;
using Flat_reference = SMA::Reference_surface<SMA::Flat_reconstruction>;

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

/// Two planes at a right angle with a narrow chamfer in between: two bends of 45 degrees less a little, along y, which are
/// edges where ridges are looked for.
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
  const Reference r = reference(soup, false);
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

} // namespace test_curvature_tensors

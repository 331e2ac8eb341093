// SPDX-License-Identifier: GPL-3.0-or-later
//
// The quartic Gregory patch alone: what it interpolates, and what it does where there is nothing to interpolate.

#include "surface/patches.h"

#include <CGAL/Surface_mesh_adaptation/numerics/cubic_curve.h>
#include <CGAL/Surface_mesh_adaptation/surface/feature_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface/patch_fallbacks.h>
#include <CGAL/Surface_mesh_adaptation/surface/surface_bulge.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace test_gregory_patch {

using namespace patches_of_tests;
using SMA::Flat_reconstruction;
using SMA::Gregory_reconstruction;
using SMA::Walton_meek_reconstruction;

TEST(Gregory_patch, interpolates_corners_and_their_normals)
{
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    for (const Construction c : {Construction::mid_edge, Construction::walton_meek}) {
      const Gregory_patch_3 g(p, c);
      ASSERT_EQ(g.interior(), Interior::gregory);
      const double corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
      for (std::size_t k = 0; k < 3; ++k) {
        const Surface_point x = g.evaluate(corner[k][0], corner[k][1]);
        EXPECT_EQ(x.position, p.points[k]);
        EXPECT_LT((x.normal - p.normals[k]).norm(), 1e-13);
      }
    }
  }
}

TEST(Gregory_patch, interpolates_normals_between_one_two_and_three_feature_edges)
{
  Random random(16);
  for (int i = 0; i < 600; ++i) {
    Patch p = random_patch(random);
    for (std::size_t k = 0; k < 3; ++k) p.is_feature[k] = int(k) <= i % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t before = (k + 2) % 3;
      const Vector_3 &out = p.tangents[k][0], &in = p.tangents[before][1];
      if (!p.is_feature[k] && !p.is_feature[before]) continue;
      p.normals[k] = Vector_3::UnitZ();
      p.normals[k] =
        SMA::orthogonalized_normal(p.normals[k], p.is_feature[k] ? out : in, p.is_feature[before] ? in : out);
    }
    const Gregory_patch_3 g(p);
    ASSERT_EQ(g.interior(), Interior::gregory);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(g.curve(k), p.is_feature[k] ? Curve::feature : Curve::smooth);
      EXPECT_LT((g.normal(k == 1, k == 2) - p.normals[k]).norm(), 1e-13);
    }
  }
}

TEST(Gregory_patch, has_the_derivatives_of_its_points)
{
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Gregory_patch_3 g(random_patch(random));
    const double u = random.real(0.05, 0.45), v = random.real(0.05, 0.45), d = 1e-4;
    const auto x = g.derivatives(u, v);
    // differences of fourth order
    const auto difference = [&](double du, double dv) -> Vector_3 {
      return (8 * (g.point(u + du, v + dv) - g.point(u - du, v - dv)) -
              (g.point(u + 2 * du, v + 2 * dv) - g.point(u - 2 * du, v - 2 * dv))) /
             (12 * d);
    };
    EXPECT_LT((x.du - difference(d, 0)).norm(), 1e-9);
    EXPECT_LT((x.dv - difference(0, d)).norm(), 1e-9);
    EXPECT_EQ(x.point, g.point(u, v));
    EXPECT_LT((x.du.cross(x.dv).normalized() - g.normal(u, v)).norm(), 1e-13);
  }
}

TEST(Gregory_patch, does_not_depend_on_the_numbering_of_its_corners)
{
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Patch p = random_patch(random);
    const double u = random.real(0, 0.5), v = random.real(0, 0.5), b[3] = {1 - u - v, u, v};
    const Surface_point x = Gregory_reconstruction::evaluate(p, u, v);
    for (const std::size_t shift : {1u, 2u}) {
      const Surface_point y =
        Gregory_reconstruction::evaluate(SMA::renumbered(p, shift), b[(1 + shift) % 3], b[(2 + shift) % 3]);
      EXPECT_LT((x.position - y.position).norm(), 1e-15);
      EXPECT_LT((x.normal - y.normal).norm(), 1e-13);
    }
  }
}

TEST(Gregory_patch, turns_and_grows_with_its_corners)
{
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Patch p = random_patch(random);
    const Eigen::Quaterniond q(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    const SMA::Matrix_3 r = q.normalized().toRotationMatrix();
    const double scale = std::exp(random.real(-9, 9));
    Patch moved = p;
    for (std::size_t k = 0; k < 3; ++k) {
      moved.points[k] = scale * (r * p.points[k]);
      moved.normals[k] = r * p.normals[k];
      for (std::size_t e = 0; e < 2; ++e) moved.tangents[k][e] = r * p.tangents[k][e];
      moved.shape_operators[k] = 1 / scale * SMA::rotated(p.shape_operators[k], r);
    }
    const double u = random.real(0, 0.5), v = random.real(0, 0.5);
    const Surface_point x = Gregory_reconstruction::evaluate(p, u, v),
                        y = Gregory_reconstruction::evaluate(moved, u, v);
    EXPECT_LT((y.position - scale * (r * x.position)).norm(), 1e-14 * scale);
    EXPECT_LT((y.normal - r * x.normal).norm(), 1e-12);
  }
}

TEST(Gregory_patch, is_flat_where_its_normals_say_so)
{
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Patch p = random_patch(random);
    const Vector_3 n = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    p.normals = {n, n, n};
    p.shape_operators = Patch().shape_operators;
    p.is_feature = {};
    const double u = random.real(0, 0.5), v = random.real(0, 0.5);
    const Surface_point x = Gregory_reconstruction::evaluate(p, u, v);
    EXPECT_LT((x.position - Flat_reconstruction::evaluate(p, u, v).position).norm(), 1e-15);
    EXPECT_LT((x.normal - n).norm(), 1e-14);
  }
}

TEST(Gregory_patch, without_shape_operators_has_the_mean_conormal_at_the_middle_of_an_edge)
{
  Random random(6);
  std::size_t smooth = 0;
  for (int i = 0; i < 200; ++i) {
    Patch p = random_patch(random);
    p.has_shape_operator = {};
    p.is_feature = {};
    const Gregory_patch_3 g(p);
    const bool is_smooth = g.curve(0) == Curve::smooth && g.curve(1) == Curve::smooth && g.curve(2) == Curve::smooth;
    if (!is_smooth || g.interior() != Interior::gregory) continue;
    ++smooth;
    const auto conormal = [&](std::size_t corner, std::size_t i0, std::size_t i1) -> Vector_3 {
      return p.normals[corner].cross(g.control_point(0, i1) - g.control_point(0, i0)).normalized();
    };
    EXPECT_NEAR(g.normal(0.5, 0).dot(conormal(0, 0, 1) + conormal(1, 3, 4)), 0, 1e-12);
  }
  EXPECT_GT(smooth, 50u);
}

/// How far the middle of a smooth edge over an arc of `angle` of the unit circle lies inside it.
template <class Reconstruction>
double depth_of_middle(double angle)
{
  Patch p;
  for (std::size_t i = 0; i < 2; ++i) {
    const double a = (double(i) - 0.5) * angle;
    p.points[i] = p.normals[i] = Vector_3(std::sin(a), 0, std::cos(a));
  }
  p.points[2] = p.points[0] + Vector_3(0, angle, 0);
  p.normals[2] = p.normals[0];
  return 1 - Reconstruction::evaluate(p, 0.5, 0).position.norm();
}

TEST(Gregory_patch, has_circles_over_its_edges)
{
  for (const double angle : {0.2, 0.4, 0.8}) {
    EXPECT_NEAR(depth_of_middle<Walton_meek_reconstruction>(angle), std::pow(angle, 4) / 384, 0.001 * std::pow(angle, 4));
    EXPECT_LT(std::abs(depth_of_middle<Gregory_reconstruction>(angle)), 1.2e-3 * std::pow(angle, 6));
  }
}

// Fallbacks

bool is_finite(const Patch& p)
{
  for (const Construction c : {Construction::mid_edge, Construction::walton_meek})
    for (const double u : {0.0, 0.3, 0.5, 1.0})
      for (const double v : {0.0, 0.2, 0.5, 1.0}) {
        if (u + v > 1) continue;
        const Surface_point x = Gregory_patch_3(p, c).evaluate(u, v);
        const double size = 1 + p.points[0].norm() + p.points[1].norm() + p.points[2].norm();
        if (!x.position.allFinite() || !x.normal.allFinite() || !(x.position.norm() < 10 * size)) return false;
      }
  return true;
}

/// The largest distance of the cubic with these handles from the middle of its edge, over the length of that.
double largest_bulge(const Vector_3& e, const SMA::internal::Cubic_handles& h)
{
  double largest = 0;
  for (int i = 0; i <= 32; ++i) {
    const double t = i / 32.0, s = 1 - t;
    const Vector_3 p = 3 * s * s * t * h.start + 3 * s * t * t * (e + h.end) + t * t * t * e;
    largest = (std::max)(largest, p.cross(e).norm() / e.squaredNorm());
  }
  return largest;
}

TEST(Gregory_patch, has_curves_over_its_edges_that_stay_near_these)
{
  std::mt19937 random(1);
  std::normal_distribution<double> coordinate;
  const auto direction = [&] { return Vector_3(coordinate(random), coordinate(random), coordinate(random)).normalized(); };
  double smooth = 0, feature = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vector_3 e = direction(), a = direction(), b = direction();
    smooth = (std::max)(smooth, largest_bulge(e, SMA::internal::smooth_handles(e, a, b)));
    feature = (std::max)(feature, largest_bulge(e, SMA::internal::feature_handles(e, a, b)));
  }
  EXPECT_GT(smooth, 0.12); // the least that is known to occur
  EXPECT_GT(feature, 0.19);
  EXPECT_LT(smooth, SMA::largest_bulge_of_patches);
  EXPECT_LT(feature, SMA::largest_bulge_of_patches);
}

/// The largest distance between points of a patch and of its triangle.
template <class Reconstruction>
double largest_bulge(const Patch& p)
{
  double largest = 0;
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; i + j <= 12; ++j) {
      const Vector_3 flat = Flat_reconstruction::evaluate(p, i / 12.0, j / 12.0).position;
      largest = (std::max)(largest, (Reconstruction::evaluate(p, i / 12.0, j / 12.0).position - flat).norm());
    }
  return largest;
}

TEST(Gregory_patch, leaves_its_triangle_by_no_more_than_it_may)
{
  Random random(18);
  double most = 0, most_of_pn_triangles = 0;
  for (int i = 0; i < 500; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    const Gregory_patch_3 free(p);
    const double limit = 0.01;
    p.largest_bulge_of_edge = {limit, limit, limit};
    p.largest_bulge = 4 * limit / 3;
    most = (std::max)(most, largest_bulge<Gregory_reconstruction>(p) / limit);
    most_of_pn_triangles = (std::max)(most_of_pn_triangles, largest_bulge<SMA::PN_triangle_reconstruction>(p) / limit);
    const Gregory_patch_3 g(p);
    for (std::size_t k = 0; k < 3; ++k) {
      if (g.curve(k) == Curve::lowered) continue; // the others are as they were
      for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(g.control_point(k, j), free.control_point(k, j));
    }
  }
  EXPECT_GT(most, 1);
  EXPECT_LT(most, 1.4);
  EXPECT_GT(most_of_pn_triangles, 1);
  EXPECT_LT(most_of_pn_triangles, 1.4);
}

TEST(Gregory_patch, keeps_an_edge_straight_where_the_normals_say_nothing)
{
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    const Vector_3 e = p.points[1] - p.points[0];
    switch (i % 4) {
    case 0:
      p.normals[0] = e.normalized();
      break; // along the edge
    case 1:
      p.normals[1] = -p.normals[0];
      break; // opposite
    case 2:
      p.points[1] = p.points[0];
      break; // no edge
    default:
      p.normals[1] = (Vector_3::UnitZ() + 1.5 * e).normalized();
      break; // 50 degrees off
    }
    const Gregory_patch_3 g(p);
    EXPECT_EQ(g.curve(0), Curve::straight);
    EXPECT_EQ(g.interior(), Interior::cubic);
    const Vector_3 quarter = p.points[0] + 0.25 * (p.points[1] - p.points[0]);
    EXPECT_LT((g.point(0.25, 0) - quarter).norm(), 1e-15);
    EXPECT_TRUE(is_finite(p));
  }
}

TEST(Patch_fallbacks, are_counted)
{
  Patches patches = tilted_torus(0.1);
  const auto count = [&] {
    return SMA::count_patch_fallbacks(sequential, patches.of_face.size(),
                                      [&](std::size_t f) -> const Patch& { return patches.of_face[f]; });
  };
  const SMA::Patch_fallbacks before = count();
  EXPECT_EQ(before.straight_sides, 0u);
  for (const Index h : {0u, 300u, 900u}) { // a normal along an edge
    ASSERT_TRUE(is_gregory(patches.of_face[h / 3]));
    Patch& p = patches.of_face[h / 3];
    p.normals[0] = (p.points[1] - p.points[0]).cross(p.normals[0]).cross(p.normals[0]).normalized();
  }
  const SMA::Patch_fallbacks after = count();
  EXPECT_EQ(after.cubic_interiors, before.cubic_interiors + 3);
  EXPECT_GE(after.straight_sides, 3u);
  EXPECT_LE(after.straight_sides, 6u);
}

TEST(Gregory_patch, is_cubic_inside_where_a_normal_is_far_off_the_facet)
{
  Random random(13);
  for (int i = 0; i < 300; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    const Vector_3 facet = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    const Vector_3 axis = facet.cross(random.vector()).normalized();
    const double angle = random.real(0, 0.6); // the edges stay smooth up to 35 degrees
    p.normals = {facet, facet, Eigen::AngleAxisd(angle, axis) * facet};
    const Gregory_patch_3 g(p);
    EXPECT_EQ(g.interior() == Interior::cubic, angle > shapes::pi / 6);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(g.curve(k), Curve::smooth);
    EXPECT_GT(g.normal(1.0 / 3, 1.0 / 3).dot(facet), 0.7);
  }
}

TEST(Gregory_patch, stays_finite_for_slivers_and_wrong_data)
{
  Random random(14);
  const double tiny = std::numeric_limits<double>::min();
  for (int i = 0; i < 2000; ++i) {
    Patch p = random_patch(random);
    switch (i % 8) {
    case 0:
      p.points[2] = p.points[1];
      break;
    case 1:
      p.points[2] = (p.points[0] + p.points[1]) / 2;
      break;
    case 2:
      p.points = {p.points[0], p.points[0], p.points[0]};
      break;
    case 3:
      p.points[2] = p.points[0] + 0.4 * (p.points[1] - p.points[0]) + std::exp(random.real(-40, 0)) * random.vector();
      break;
    case 4:
      for (Vector_3& n : p.normals) n = random.vector().normalized();
      break;
    case 5:
      for (Vector_3& n : p.normals) n.setZero();
      break;
    case 6:
      for (auto& t : p.tangents) t = {random.vector().normalized(), Vector_3::Zero()};
      break;
    default:
      for (Metric_tensor_3& s : p.shape_operators) s = std::exp(random.real(0, 100)) * s;
      break;
    }
    EXPECT_TRUE(is_finite(p)) << "case " << i % 8;
    const Gregory_patch_3 g(p);
    for (const double u : {tiny, 1e-310, 1 - 1e-16}) EXPECT_TRUE(g.evaluate(u, 0).normal.allFinite());
  }
}

TEST(Gregory_patch, does_not_fold_over_for_normals_up_to_25_degrees_off)
{
  Random random(15);
  std::size_t folds = 0;
  for (int i = 0; i < 2000; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    p.has_shape_operator = {};
    if (checks::quality(p.points[0], p.points[1], p.points[2]) < 0.3) continue;
    const Vector_3 facet = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    for (Vector_3& n : p.normals)
      n = Eigen::AngleAxisd(random.real(0, 25 * shapes::pi / 180), facet.cross(random.vector()).normalized()) * facet;
    for (int u = 0; u <= 8; ++u)
      for (int v = 0; u + v <= 8; ++v) folds += Gregory_patch_3(p).normal(u / 8.0, v / 8.0).dot(facet) <= 0;
  }
  EXPECT_EQ(folds, 0u);
}

} // namespace test_gregory_patch

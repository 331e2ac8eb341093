// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all reconstructions of a surface have in common, and point-normal triangles and flat facets.

#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace test_reconstructions {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Flat_reconstruction;
using SMA::Patch;
using SMA::PN_triangle_reconstruction;
using SMA::Surface_point;

Patch random_patch(Random& random)
{
  Patch p;
  p.points = {Vector_3(0, 0, 0) + 0.2 * random.vector(), Vector_3(1, 0, 0) + 0.2 * random.vector(),
              Vector_3(0, 1, 0) + 0.2 * random.vector()};
  for (std::size_t i = 0; i < 3; ++i) {
    p.normals[i] = (Vector_3::UnitZ() + 0.4 * random.vector()).normalized();
    p.is_feature[i] = random.below(3) == 0;
    for (Vector_3& t : p.tangents[i]) t = (p.points[(i + 1) % 3] - p.points[i] + 0.3 * random.vector()).normalized();
  }
  return p;
}

template <class Reconstruction>
class Reconstructions : public ::testing::Test
{};

using All_reconstructions = ::testing::Types<Flat_reconstruction, PN_triangle_reconstruction, SMA::Gregory_reconstruction,
                                             SMA::Walton_meek_reconstruction>;
TYPED_TEST_SUITE(Reconstructions, All_reconstructions, );

TYPED_TEST(Reconstructions, interpolate_their_corners)
{
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Patch p = random_patch(random);
    EXPECT_LT((TypeParam::evaluate(p, 0, 0).position - p.points[0]).norm(), 1e-14);
    EXPECT_LT((TypeParam::evaluate(p, 1, 0).position - p.points[1]).norm(), 1e-14);
    EXPECT_LT((TypeParam::evaluate(p, 0, 1).position - p.points[2]).norm(), 1e-14);
  }
}

TYPED_TEST(Reconstructions, share_the_curve_of_an_edge_with_the_other_face)
{
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Patch p = random_patch(random);
    // the face on the other side of edge 0 sees it backwards, as its edge 1
    Patch q = random_patch(random);
    q.points[1] = p.points[1];
    q.points[2] = p.points[0];
    q.normals[1] = p.normals[1];
    q.normals[2] = p.normals[0];
    q.is_feature[1] = p.is_feature[0];
    q.tangents[1] = {p.tangents[0][1] * -1.0, p.tangents[0][0] * -1.0};
    for (const double t : {0.1, 0.37, 0.5, 0.9})
      EXPECT_LT((TypeParam::evaluate(p, t, 0).position - TypeParam::evaluate(q, t, 1 - t).position).norm(), 1e-14);
  }
}

TYPED_TEST(Reconstructions, have_feature_edges_that_are_the_curve_itself)
{
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    Patch p = random_patch(random);
    p.is_feature[0] = true;
    for (const double t : {0.2, 0.5, 0.7}) {
      const Vector_3 c = TypeParam::evaluate_curve(p.points[0], p.points[1], p.tangents[0][0], p.tangents[0][1], t);
      EXPECT_LT((TypeParam::evaluate(p, t, 0).position - c).norm(), 1e-14);
    }
  }
}

TEST(PN_triangle, has_the_normal_of_its_surface)
{
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Patch p = random_patch(random);
    const double u = random.real(0.1, 0.4), v = random.real(0.1, 0.4), d = 1e-5;
    const auto at = [&](double x, double y) { return PN_triangle_reconstruction::evaluate(p, x, y).position; };
    const Vector_3 n = (at(u + d, v) - at(u - d, v)).cross(at(u, v + d) - at(u, v - d)).normalized();
    EXPECT_LT((PN_triangle_reconstruction::evaluate(p, u, v).normal - n).norm(), 1e-8);
  }
}

TEST(PN_triangle, is_flat_where_its_normals_say_so)
{
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    Patch p = random_patch(random);
    const Vector_3 n = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    p.normals = {n, n, n};
    p.is_feature = {};
    const double u = random.real(0, 0.5), v = random.real(0, 0.5);
    const Surface_point x = PN_triangle_reconstruction::evaluate(p, u, v);
    EXPECT_LT((x.position - Flat_reconstruction::evaluate(p, u, v).position).norm(), 1e-13);
    EXPECT_LT((x.normal - n).norm(), 1e-12);
  }
}

TEST(PN_triangle, stays_finite_for_degenerate_faces)
{
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    Patch p = random_patch(random);
    if (i % 3 == 0) p.points[2] = p.points[1];
    if (i % 3 == 1) p.points[2] = (p.points[0] + p.points[1]) / 2;
    if (i % 3 == 2) p.points = {p.points[0], p.points[0], p.points[0]};
    const Surface_point x = PN_triangle_reconstruction::evaluate(p, random.real(0, 0.5), random.real(0, 0.5));
    EXPECT_TRUE(x.position.allFinite() && x.normal.allFinite());
  }
}

struct Errors
{
  double distance = 0, normal = 0; ///< largest
};

/// Errors of the patches over the faces of a torus with exact normals.
template <class Reconstruction>
Errors torus_errors(std::size_t n)
{
  const Soup s = shapes::torus(n, n / 2, 0.2);
  Errors e;
  for (const shapes::Triangle& t : s.triangles) {
    Patch p;
    for (std::size_t i = 0; i < 3; ++i) {
      p.points[i] = s.points[t[i]];
      p.normals[i] = shapes::torus_normal(p.points[i]);
    }
    for (const double u : {0.0, 0.2, 0.4, 0.6})
      for (const double v : {0.0, 0.1, 0.3}) {
        const Surface_point x = Reconstruction::evaluate(p, u, v);
        e.distance = (std::max)(e.distance, shapes::torus_distance(x.position));
        e.normal = (std::max)(e.normal, (x.normal - shapes::torus_normal(x.position)).norm());
      }
  }
  return e;
}

TEST(PN_triangle, is_of_third_order_with_exact_normals)
{
  const Errors coarse = torus_errors<PN_triangle_reconstruction>(64),
               fine = torus_errors<PN_triangle_reconstruction>(256);
  EXPECT_GT(std::log(coarse.distance / fine.distance) / std::log(4), 2.7);
  EXPECT_GT(std::log(coarse.normal / fine.normal) / std::log(4), 1.7);
}

TEST(Flat_facet, is_of_second_order)
{
  const Errors coarse = torus_errors<Flat_reconstruction>(64), fine = torus_errors<Flat_reconstruction>(256);
  const double order = std::log(coarse.distance / fine.distance) / std::log(4);
  EXPECT_GT(order, 1.8);
  EXPECT_LT(order, 2.2);
}

} // namespace test_reconstructions

// SPDX-License-Identifier: GPL-3.0-or-later
//
// How fast patches and curves over finer and finer faces converge to what they interpolate.

#include "analytic_surfaces.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/surface/Gregory_patch_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace test_patch_convergence {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Flat_reconstruction;
using SMA::Gregory_patch_3;
using SMA::Gregory_reconstruction;
using SMA::Metric_tensor_3;
using SMA::Patch;
using SMA::PN_triangle_reconstruction;
using SMA::Walton_meek_reconstruction;
using Reference = SMA::Reference_surface<Gregory_reconstruction>;

template <class Surface>
class Convergence : public ::testing::Test
{};

using Surfaces = ::testing::Types<analytic::Ellipsoid, analytic::Torus, analytic::Graph, analytic::Sphere>;
TYPED_TEST_SUITE(Convergence, Surfaces, );

/// Slopes between two levels that are two apart, and the errors at the finer one.
struct Orders
{
  double distance, rms_distance, normal, rms_normal;
  analytic::Patch_errors fine;
};

template <class Reconstruction, class Surface>
Orders orders(const Surface& surface)
{
  const auto a = analytic::patch_errors<Reconstruction>(surface, 2),
             b = analytic::patch_errors<Reconstruction>(surface, 4);
  const double steps = std::log(a.h / b.h);
  return {std::log(a.distance / b.distance) / steps, std::log(a.rms_distance / b.rms_distance) / steps,
          std::log(a.normal / b.normal) / steps, std::log(a.rms_normal / b.rms_normal) / steps, b};
}

TYPED_TEST(Convergence, of_gregory_patches_is_of_fourth_order)
{
  const TypeParam surface;
  const Orders o = orders<Gregory_reconstruction>(surface);
  EXPECT_GT(o.distance, 3.4);
  EXPECT_GT(o.rms_distance, 3.8);
  EXPECT_GT(o.normal, 2.5);
  EXPECT_GT(o.rms_normal, 2.9);
  EXPECT_LT(o.fine.distance, 0.03 * std::pow(surface.scale() * o.fine.h, 3) * o.fine.h);
}

TEST(Gregory_patch, is_of_sixth_order_on_spheres)
{
  const Orders o = orders<Gregory_reconstruction>(analytic::Sphere());
  EXPECT_GT(o.distance, 5.4);
  EXPECT_GT(o.rms_distance, 5.9);
  EXPECT_GT(o.normal, 4.5);
  EXPECT_GT(o.rms_normal, 4.9);
}

/// Largest distance of patches of the size `h` to a cylinder of radius 1, with corners at random.
double cylinder_error(double h)
{
  Random random(16);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    Patch p;
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = 2 * shapes::pi * double(k) / 3 + random.real(-0.4, 0.4), a = h * std::cos(u), z = h * std::sin(u);
      p.normals[k] = Vector_3(std::cos(a), std::sin(a), 0);
      p.points[k] = p.normals[k] + z * Vector_3::UnitZ();
      const Vector_3 around = Vector_3::UnitZ().cross(p.normals[k]);
      p.shape_operators[k] = Metric_tensor_3(SMA::Matrix_3(around * around.transpose()));
      p.has_shape_operator[k] = true;
    }
    const Gregory_patch_3 g(p);
    for (int u = 0; u <= 6; ++u)
      for (int v = 0; u + v <= 6; ++v) {
        const Vector_3 x = g.point(u / 6.0, v / 6.0);
        worst = (std::max)(worst, std::abs(std::hypot(x[0], x[1]) - 1));
      }
  }
  return worst;
}

TEST(Gregory_patch, is_of_sixth_order_on_cylinders)
{
  EXPECT_GT(std::log2(cylinder_error(0.2) / cylinder_error(0.05)) / 2, 5.8);
}

TYPED_TEST(Convergence, of_walton_and_meek_is_of_third_order)
{
  const TypeParam surface;
  const Orders o = orders<Walton_meek_reconstruction>(surface);
  EXPECT_GT(o.distance, 2.7);
  EXPECT_GT(o.rms_distance, 2.9);
  EXPECT_GT(o.normal, 1.7);
  EXPECT_GT(o.rms_normal, 1.9);
  EXPECT_LT(o.fine.distance, 0.015 * std::pow(surface.scale() * o.fine.h, 2) * o.fine.h);
  // shape operators are worth an order: spheres are the exception
  if (!std::is_same_v<TypeParam, analytic::Sphere>) {
    EXPECT_LT(o.rms_normal, 2.3);
  }
}

TYPED_TEST(Convergence, of_flat_facets_is_of_second_order)
{
  const Orders o = orders<Flat_reconstruction>(TypeParam());
  EXPECT_GT(o.distance, 1.8);
  EXPECT_GT(o.rms_distance, 1.9);
  EXPECT_LT(o.rms_distance, 2.1);
}

TYPED_TEST(Convergence, of_point_normal_triangles_is_of_third_order)
{
  const Orders o = orders<PN_triangle_reconstruction>(TypeParam());
  EXPECT_GT(o.distance, 2.7);
  EXPECT_GT(o.normal, 1.5);
}

/// Largest distance to a space curve of the edges over `n` uneven pieces of it, with tangents turned by `tangent_error`
/// times the squared length of a piece.
double curve_error(std::size_t n, double tangent_error)
{
  const auto point = [](double t) { return Vector_3(std::cos(t), std::sin(2 * t), 0.5 * t * t); };
  const auto derivative = [](double t) { return Vector_3(-std::sin(t), 2 * std::cos(2 * t), t); };
  Random random(11);
  std::vector<double> at{0};
  for (std::size_t i = 1; i < n; ++i) at.push_back(2 * (double(i) + random.real(-0.25, 0.25)) / double(n));
  at.push_back(2);
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double h = at[i + 1] - at[i];
    const auto tangent = [&](double t) -> Vector_3 {
      return (derivative(t).normalized() + tangent_error * h * h * Vector_3(0.5, -0.3, 0.8)).normalized();
    };
    for (const double s : {0.2, 0.4, 0.5, 0.7, 0.9}) {
      const Vector_3 x =
        Gregory_reconstruction::evaluate_curve(point(at[i]), point(at[i + 1]), tangent(at[i]), tangent(at[i + 1]), s);
      double t = at[i] + s * h; // the closest point, by Newton's method
      for (int k = 0; k < 6; ++k) {
        const Vector_3 d = derivative(t), second(-std::cos(t), -4 * std::sin(2 * t), 1), r = point(t) - x;
        t -= r.dot(d) / (d.squaredNorm() + r.dot(second));
      }
      worst = (std::max)(worst, (point(t) - x).norm());
    }
  }
  return worst;
}

TEST(Feature_curve, is_of_fourth_order_with_exact_tangents_and_of_third_with_three_point_ones)
{
  EXPECT_GT(std::log2(curve_error(40, 0) / curve_error(160, 0)) / 2, 3.6);
  EXPECT_GT(std::log2(curve_error(40, 1) / curve_error(160, 1)) / 2, 2.7);
}

/// Largest distance, along z, of the curves of the reference surface to the boundary of the graph that it is made from.
double boundary_error(int level)
{
  const analytic::Graph graph;
  const Soup soup = analytic::mesh(graph, level);
  const Reference surface(SMA::Sequential_execution(), shapes::view(soup), soup.points, {});
  EXPECT_EQ(surface.features.curves.size(), 4u);
  double worst = 0;
  for (Index id = 0; id < surface.features.curves.size(); ++id)
    for (int i = 1; i < 2000; ++i) {
      const double s = surface.features.curves[id].length() * i / 2000;
      const Vector_3 p = surface.evaluate(surface.on_curve(id, s)).position;
      worst = (std::max)(worst, std::abs(p[2] - graph.jet(p[0], p[1]).f));
    }
  return worst;
}

TEST(Feature_curve, is_of_third_order_up_to_the_corners)
{
  EXPECT_GT(std::log2(boundary_error(2) / boundary_error(4)) / 2, 2.7);
}

/// Largest errors of the faces at the boundary of the graph, of which the edges follow the exact tangents of its sides.
analytic::Patch_errors errors_at_the_boundary(int level)
{
  const analytic::Graph graph;
  const Soup soup = analytic::mesh(graph, level);
  const auto side_tangent = [&](const Vector_3& p, int axis) {
    const auto j = graph.jet(p[0], p[1]);
    return (axis == 0 ? Vector_3(0, 1, j.y) : Vector_3(1, 0, j.x)).normalized();
  };
  return analytic::patch_errors<Gregory_reconstruction>(graph, soup, [&](Patch& p) {
    for (std::size_t i = 0; i < 3; ++i)
      for (const int axis : {0, 1}) {
        const Vector_3 &a = p.points[i], &b = p.points[(i + 1) % 3];
        if (a[axis] != b[axis] || std::abs(a[axis]) != 1) continue;
        p.is_feature[i] = true;
        p.tangents[i] = {side_tangent(a, axis), side_tangent(b, axis)};
      }
    return p.is_feature[0] || p.is_feature[1] || p.is_feature[2];
  });
}

TEST(Gregory_patch, keeps_its_order_next_to_features)
{
  const auto coarse = errors_at_the_boundary(2), fine = errors_at_the_boundary(4);
  EXPECT_GT(std::log(coarse.distance / fine.distance) / std::log(coarse.h / fine.h), 3.4);
  EXPECT_GT(std::log(coarse.normal / fine.normal) / std::log(coarse.h / fine.h), 2.5);
}

} // namespace test_patch_convergence

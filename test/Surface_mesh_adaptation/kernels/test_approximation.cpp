// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification within limits on distances and normals: that it keeps them, uses them up, and comes nearer to the input
// than quadric errors do. And adaptation with faces that are fitted to the surface.

#include "checks.h"
#include "distances.h"
#include "policies.h"
#include "real_meshes.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Quadric_3.h>
#include <CGAL/Surface_mesh_adaptation/numerics/closest_point.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace test_approximation {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;
using distances::Mesh;
using shapes::Soup;
using shapes::Vector_3;

/// Leaves everything to the limits.
const SMA::Uniform_metric_field no_size(1e6);

/// Cosine of the angle between the two that differ most: the normal of a face and that of `normal` at its corners and
/// centroid.
template <class Normal>
double least_cosine(const Soup& soup, const Normal& normal)
{
  double least = 1;
  for (const shapes::Triangle& t : soup.triangles) {
    const Vector_3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    const Vector_3 n = (b - a).cross(c - a).normalized();
    for (const Vector_3& p : {a, b, c, Vector_3((a + b + c) / 3)}) least = (std::min)(least, n.dot(normal(p)));
  }
  return least;
}

/// Mean of the heights of the faces above the unit sphere, and the deviation from it. With 20 000 samples the mean is off by
/// a tenth of the depth of faces that have their corners on the sphere.
std::pair<double, double> heights_above_sphere(const Mesh& mesh)
{
  double mean = 0, mean_square = 0;
  distances::for_each_sample(mesh, 1000000, [&](const auto& p, double weight) {
    const double height = Vector_3(p.x(), p.y(), p.z()).norm() - 1;
    mean += weight * height;
    mean_square += weight * height * height;
  });
  return {mean, std::sqrt(mean_square - mean * mean)};
}

TEST(Closest_point_of_triangle, is_closer_than_any_other_point)
{
  shapes::Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vector_3 a = random.vector(), b = random.vector(), c = random.vector(), p = 2 * random.vector();
    const auto found = SMA::internal::closest_point_of_triangle(p, a, b, c);
    const auto& w = found.weights;
    EXPECT_GE((std::min)({w[0], w[1], w[2]}), -1e-12);
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
    EXPECT_LT((w[0] * a + w[1] * b + w[2] * c + found.offset - p).norm(), 1e-12);
    double least = std::numeric_limits<double>::infinity();
    for (int j = 0; j <= 20; ++j)
      for (int k = 0; j + k <= 20; ++k)
        least = (std::min)(least, (p - a - j / 20.0 * (b - a) - k / 20.0 * (c - a)).norm());
    EXPECT_LE(found.offset.norm(), least + 1e-12);
  }
}

TEST(Prepared_triangle, knows_the_distance_of_the_closest_point)
{
  shapes::Random random(8);
  for (int i = 0; i < 2000; ++i) {
    const Vector_3 a = random.vector(), b = random.vector(), c = random.vector(), p = 2 * random.vector();
    const double exact = SMA::internal::closest_point_of_triangle(p, a, b, c).offset.squaredNorm();
    const SMA::internal::Prepared_triangle triangle({a, b, c});
    EXPECT_NEAR(triangle.squared_distance(p).squared, exact, 1e-12);
    const SMA::internal::Prepared_triangle segment({a, b, i % 2 == 0 ? a : b});
    EXPECT_NEAR(segment.squared_distance(p).squared, SMA::squared_distance_to_segment(p, a, b), 1e-12);
  }
}

TEST(Quadric_3, is_the_sum_of_squared_distances_and_least_where_planes_meet)
{
  shapes::Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Vector_3 corner = random.vector(), p = random.vector();
    SMA::Quadric_3 one, other;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const Vector_3 n = (Vector_3::Unit(k) + 0.3 * random.vector()).normalized();
      (k < 2 ? one : other).add_plane(corner, n, k + 1.0);
      sum += (k + 1) * std::pow(n.dot(p - corner), 2);
    }
    one += other;
    EXPECT_NEAR(one(p), sum, 1e-12);
    EXPECT_LT((one.minimum(p, 1e-13) - corner).norm(), 1e-9);
  }
  EXPECT_EQ(SMA::Quadric_3().minimum(Vector_3(1, 2, 3), 1e-7), Vector_3(1, 2, 3));
}

TEST(Simplify_within_limits, keeps_normals_and_uses_the_limit_up)
{
  const Soup soup = shapes::sphere(5, 0.3);
  const auto normal = [](const Vector_3& p) { return Vector_3(p.normalized()); };
  for (const double degrees : {5.0, 10.0, 20.0}) {
    SCOPED_TRACE(degrees);
    Mesh mesh = shapes::mesh<Mesh>(soup);
    SMA::simplify(mesh, no_size, params::maximum_normal_deviation(degrees));
    const Soup result = shapes::soup(mesh);
    ASSERT_TRUE(checks::is_manifold(result));
    EXPECT_EQ(checks::topology(result), checks::topology(soup));
    // the normals of the input faces that a face stands for are up to 1.3 degrees off those of the sphere
    EXPECT_GT(least_cosine(result, normal), std::cos((degrees + 2.5) * shapes::pi / 180));
    // a face with circumradius r deviates by r at its corners: 4 pi / N per vertex is 3/2 sqrt 3 r^2 for equilateral
    // ones
    const double radius = degrees * shapes::pi / 180;
    const double fewest = 4 * shapes::pi / (1.5 * std::sqrt(3.0) * radius * radius);
    EXPECT_LT(double(result.points.size()), 3 * fewest);
  }
}

TEST(Simplify_within_limits, keeps_the_distance_in_both_directions)
{
  for (const Soup& soup : {shapes::sphere(5, 0.3), shapes::torus(120, 44, 0.3), shapes::capped_cylinder(60, 20, 2)}) {
    const Mesh input = shapes::mesh<Mesh>(soup);
    const distances::Original original(input);
    for (const double distance : {0.005, 0.02}) {
      Mesh mesh = input;
      SMA::simplify(mesh, no_size,
                    params::maximum_distance(distance).surface_reconstruction(SMA::Flat_reconstruction()));
      ASSERT_TRUE(checks::is_manifold(shapes::soup(mesh)));
      // of the represented points it is a limit, in between and back little is missing
      EXPECT_LT(original.distance_to(mesh, 20000).largest, 1.5 * distance);
      EXPECT_LT(num_vertices(mesh), soup.points.size() / 3);
    }
  }
}

TEST(Simplify_within_limits, needs_no_vertex_but_the_corners_of_flat_faces)
{
  for (const Soup& soup : {shapes::square(12, 0.3), shapes::cube(6)}) {
    Mesh mesh = shapes::mesh<Mesh>(soup);
    SMA::simplify(mesh, no_size, params::maximum_distance(1e-9));
    const Soup result = shapes::soup(mesh);
    ASSERT_TRUE(checks::is_manifold(result));
    EXPECT_LE(result.points.size(), 10u);
    EXPECT_NEAR(checks::area(result), checks::area(soup), 1e-12);
  }
}

TEST(Simplify_within_limits, leaves_as_much_of_a_sphere_outside_as_inside)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(5, 0.3));
  SMA::simplify(mesh, no_size, params::maximum_normal_deviation(10));
  const auto [mean, deviation] = heights_above_sphere(mesh);
  EXPECT_LT(std::abs(mean), 0.6 * deviation); // with vertices on the sphere the mean is four times as large
}

TEST(Simplify_within_limits, comes_nearer_than_quadric_errors_at_the_same_number_of_vertices)
{
  struct Case
  {
    std::string name;
    Mesh mesh;
    double distance; ///< of the diagonal
  };
  constexpr double none = 1;
  Soup ellipsoid = shapes::sphere(5, 0.3);
  for (Vector_3& p : ellipsoid.points) p = p.cwiseProduct(Vector_3(1, 0.7, 0.5));
  for (const Case& c : {Case{"sphere", shapes::mesh<Mesh>(shapes::sphere(5, 0.3)), none},
                        Case{"ellipsoid", shapes::mesh<Mesh>(ellipsoid), none},
                        Case{"torus", shapes::mesh<Mesh>(shapes::torus(170, 60, 0.3)), none},
                        Case{"torus", shapes::mesh<Mesh>(shapes::torus(170, 60, 0.3)), 5e-4},
                        Case{"elephant", real_mesh<Mesh>("elephant"), none},
                        Case{"fandisk", real_mesh<Mesh>("fandisk"), none},
                        Case{"anchor_dense", real_mesh<Mesh>("anchor_dense"), none},
                        Case{"rotor_small", real_mesh<Mesh>("rotor_small"), none},
                        Case{"couplingdown", real_mesh<Mesh>("couplingdown"), none}}) {
    SCOPED_TRACE(c.name);
    const distances::Original original(c.mesh);
    Mesh ours = c.mesh;
    SMA::simplify(ours, no_size, params::maximum_normal_deviation(10)
                                   .maximum_distance(c.distance * original.diagonal())
                                   .surface_reconstruction(SMA::Flat_reconstruction()));
    const Mesh by_planes = distances::simplified<distances::Plane_quadrics>(c.mesh, num_vertices(ours));
    const Mesh by_triangles = distances::simplified<distances::Triangle_quadrics>(c.mesh, num_vertices(ours));
    const auto distance = original.distance_to(ours, 50000);
    const auto of_planes = original.distance_to(by_planes, 50000);
    const auto of_triangles = original.distance_to(by_triangles, 50000);
    EXPECT_LT(distance.largest, of_planes.largest);
    EXPECT_LT(distance.rms, 0.97 * of_planes.rms);
    EXPECT_LT(distance.largest, of_triangles.largest);
    EXPECT_LT(distance.rms, of_triangles.rms);
  }
}

TEST(Simplify_within_limits, gives_the_same_bits_with_every_policy)
{
  for (const Soup& soup : {shapes::torus(120, 44, 0.3), shapes::capped_cylinder(60, 20, 2)}) {
    Soup reference;
    for_each_policy([&](const auto& execution, const std::string& name) {
      Mesh mesh = shapes::mesh<Mesh>(soup);
      SMA::simplify(execution, mesh, no_size, params::maximum_normal_deviation(15).maximum_distance(0.01));
      const Soup result = shapes::soup(mesh);
      if (reference.points.empty()) reference = result;
      EXPECT_TRUE(checks::is_identical(result, reference)) << name;
    });
  }
}

TEST(Simplify_within_limits, keeps_constrained_vertices_where_they_are)
{
  const Soup soup = shapes::sphere(4, 0.3);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  auto is_fixed = mesh.add_property_map<Mesh::Vertex_index, bool>("v:fixed", false).first;
  for (const std::size_t v : {0, 100, 200}) is_fixed[Mesh::Vertex_index(Mesh::size_type(v))] = true;
  SMA::simplify(mesh, no_size, params::maximum_normal_deviation(15).vertex_is_constrained_map(is_fixed));
  const Soup result = shapes::soup(mesh);
  for (const std::size_t v : {0, 100, 200})
    EXPECT_EQ(std::count(result.points.begin(), result.points.end(), soup.points[v]), 1);
}

TEST(Simplify_within_limits, keeps_a_tolerance_whatever_the_limits_allow)
{
  const auto expect_within = [](const Mesh& input, double tolerance, const auto& limits) {
    const distances::Original original(input);
    Mesh mesh = input;
    SMA::simplify(mesh, no_size, limits.tolerance(tolerance * original.diagonal()));
    EXPECT_LT(num_vertices(mesh), num_vertices(input) / 4);
    EXPECT_LE(original.distance_to(mesh, 20000).largest, tolerance * original.diagonal());
  };
  const Mesh torus = shapes::mesh<Mesh>(shapes::torus(60, 22, 0.3)), part = real_mesh<Mesh>("rotor_small");
  for (const double tolerance : {0.02, 0.005}) {
    expect_within(torus, tolerance, params::maximum_distance(0.1).surface_reconstruction(SMA::Flat_reconstruction()));
    expect_within(part, tolerance, params::maximum_normal_deviation(60));
  }
}

TEST(Simplify_within_limits, uses_the_tolerance_up)
{
  for (const std::string name : {"elephant", "couplingdown"}) {
    SCOPED_TRACE(name);
    const Mesh input = real_mesh<Mesh>(name);
    const distances::Original original(input);
    const double tolerance = 0.001 * original.diagonal();
    Mesh mesh = input;
    SMA::simplify(mesh, no_size, params::maximum_normal_deviation(90).tolerance(tolerance));
    EXPECT_GT(original.distance_to(mesh, 200000).largest, 0.9 * tolerance);
  }
}

TEST(Simplify, counts_what_the_last_attempt_removed_when_a_tolerance_takes_several)
{
  const Mesh input = real_mesh<Mesh>("rotor_small");
  const double diagonal = distances::Original(input).diagonal();
  Mesh mesh = input;
  const std::size_t removed =
    SMA::simplify(mesh, SMA::Uniform_metric_field(0.05 * diagonal), params::tolerance(0.003 * diagonal));
  EXPECT_EQ(removed, num_vertices(input) - num_vertices(mesh));
}

TEST(Simplify_within_limits, refuses_limits_that_make_no_sense)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double degrees : {0.0, -1.0, 181.0, nan})
    EXPECT_THROW(SMA::simplify(mesh, no_size, params::maximum_normal_deviation(degrees)), SMA::Invalid_parameter_error);
  for (const double distance : {0.0, -1.0, nan})
    EXPECT_THROW(SMA::simplify(mesh, no_size, params::maximum_distance(distance)), SMA::Invalid_parameter_error);
}

TEST(Fit_to_surface, leaves_as_much_of_a_sphere_outside_as_inside)
{
  const Mesh input = shapes::mesh<Mesh>(shapes::sphere(4, 0.2));
  for (const double size : {0.3, 0.15, 0.08}) {
    Mesh on_sphere = input, fitted = input;
    const SMA::Uniform_metric_field field(size);
    const auto before = SMA::adapt_surface_mesh(on_sphere, field, params::fit_to_surface(false));
    const auto after = SMA::adapt_surface_mesh(fitted, field, params::fit_to_surface(true));
    const auto [depth, deviation] = heights_above_sphere(on_sphere);
    ASSERT_LT(depth, -deviation);
    EXPECT_LT(std::abs(heights_above_sphere(fitted).first), 0.15 * std::abs(depth));
    // nothing else has changed
    EXPECT_EQ(shapes::soup(fitted).triangles, shapes::soup(on_sphere).triangles);
    EXPECT_NEAR(after.final.mean_quality, before.final.mean_quality, 0.002);
    EXPECT_NEAR(after.final.in_range, before.final.in_range, 0.005);
    EXPECT_EQ(after.kernels.back().kernel, "fit");
    EXPECT_EQ(after.kernels.back().applied, num_vertices(fitted));
  }
}

TEST(Fit_to_surface, comes_nearer_to_real_meshes)
{
  for (const std::string name : {"elephant", "fandisk", "couplingdown", "rotor_small"}) {
    SCOPED_TRACE(name);
    const Mesh input = real_mesh<Mesh>(name);
    const distances::Original original(input);
    const SMA::Uniform_metric_field field(0.5 * shapes::soup(input).mean_edge_length());
    const auto flat = params::surface_reconstruction(SMA::Flat_reconstruction());
    Mesh on_surface = input, fitted = input;
    SMA::adapt_surface_mesh(on_surface, field, flat);
    const auto report = SMA::adapt_surface_mesh(fitted, field, flat.fit_to_surface(true));
    const auto before = original.distance_to(on_surface, 50000), after = original.distance_to(fitted, 50000);
    EXPECT_LT(after.rms, 0.57 * before.rms);
    EXPECT_LT(after.largest, before.largest);
    const Soup result = shapes::soup(fitted);
    EXPECT_TRUE(checks::is_manifold(result));
    EXPECT_GT(checks::least_area(result), 0);
    EXPECT_GT(report.final.min_quality, 0.2);
  }
}

TEST(Fit_to_surface, comes_the_nearer_the_less_the_shape_counts)
{
  const Mesh input = real_mesh<Mesh>("fandisk");
  const distances::Original original(input);
  const SMA::Uniform_metric_field field(shapes::soup(input).mean_edge_length());
  double rms = std::numeric_limits<double>::infinity(), quality = 1;
  for (const double weight : {0.5, 0.02, 0.002}) {
    Mesh mesh = input;
    const auto report = SMA::adapt_surface_mesh(
      mesh, field,
      params::surface_reconstruction(SMA::Flat_reconstruction()).fit_to_surface(true).shape_weight_of_fit(weight));
    const double next = original.distance_to(mesh, 50000).rms;
    EXPECT_LT(next, 0.8 * rms);
    EXPECT_LT(report.final.mean_quality, quality);
    rms = next;
    quality = report.final.mean_quality;
  }
  Mesh mesh = input;
  for (const double weight : {0.0, -1.0, 1.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(SMA::adapt_surface_mesh(mesh, field, params::fit_to_surface(true).shape_weight_of_fit(weight)),
                 SMA::Invalid_parameter_error);
  EXPECT_TRUE(checks::is_identical(shapes::soup(mesh), shapes::soup(input)));
}

TEST(Fit_to_surface, leaves_what_is_flat_and_what_is_constrained)
{
  for (const Soup& soup : {shapes::square(12, 0.3), shapes::cube(6)}) {
    Mesh plain = shapes::mesh<Mesh>(soup), fitted = plain;
    SMA::adapt_surface_mesh(plain, SMA::Uniform_metric_field(0.07));
    SMA::adapt_surface_mesh(fitted, SMA::Uniform_metric_field(0.07), params::fit_to_surface(true));
    const Soup expected = shapes::soup(plain), result = shapes::soup(fitted);
    ASSERT_EQ(result.points.size(), expected.points.size());
    for (std::size_t v = 0; v < result.points.size(); ++v)
      EXPECT_LT((result.points[v] - expected.points[v]).norm(), 1e-14);
  }
  const Soup soup = shapes::sphere(3, 0.3);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  auto is_fixed = mesh.add_property_map<Mesh::Vertex_index, bool>("v:fixed", false).first;
  for (const std::size_t v : {0, 100, 200}) is_fixed[Mesh::Vertex_index(Mesh::size_type(v))] = true;
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.2),
                          params::fit_to_surface(true).vertex_is_constrained_map(is_fixed));
  const Soup result = shapes::soup(mesh);
  for (const std::size_t v : {0, 100, 200})
    EXPECT_EQ(std::count(result.points.begin(), result.points.end(), soup.points[v]), 1);
}

TEST(Fit_to_surface, keeps_a_tolerance)
{
  for (const std::string name : {"elephant", "rotor_small"}) {
    SCOPED_TRACE(name);
    Mesh mesh = real_mesh<Mesh>(name);
    const double tolerance = 0.002 * distances::Original(mesh).diagonal();
    const Mesh input = mesh;
    const auto report =
      SMA::adapt_surface_mesh(mesh, SMA::Curvature_metric_field(0.001), params::tolerance(tolerance).fit_to_surface(true));
    EXPECT_LE(report.certified_distance, tolerance);
    EXPECT_LE(distances::Original(input).distance_to(mesh, 50000).largest, tolerance);
    EXPECT_GT(report.kernels.back().applied, num_vertices(mesh) / 2);
  }
}

TEST(Fit_to_surface, gives_the_same_bits_with_every_policy)
{
  Soup reference;
  for_each_policy([&](const auto& execution, const std::string& name) {
    Mesh mesh = shapes::mesh<Mesh>(shapes::capped_cylinder(60, 20, 2));
    SMA::adapt_surface_mesh(execution, mesh, SMA::Uniform_metric_field(0.06), params::fit_to_surface(true));
    const Soup result = shapes::soup(mesh);
    if (reference.points.empty()) reference = result;
    EXPECT_TRUE(checks::is_identical(result, reference)) << name;
  });
}

} // namespace test_approximation

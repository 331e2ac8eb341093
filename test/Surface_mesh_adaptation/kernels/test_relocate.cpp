// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relocation: where it moves vertices, and what it keeps.

#include "checks.h"
#include "kernels/smooth_shapes.h"
#include "numerics/plane_star.h"
#include "shape_meshes.h"

#include <CGAL/Surface_mesh_adaptation/kernels/centering.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/relocate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace test_relocate {

using namespace kernels_of_tests;
using stars_of_tests::Plane_star;
using SMA::Vector_2;
namespace params = SMA::parameters;

TEST(Relocate, moves_balanced_curves_to_where_the_faces_are_equilateral)
{
  // a band of three rows, of which the outer ones are turned against each other: their edges are all alike
  constexpr std::size_t columns = 60;
  const double radius = double(columns) / (2 * shapes::pi), skew = 0.35;
  const Soup skewed = tube(columns, 2, [&](std::size_t c, std::size_t r) {
    const double angle = (double(c) + (r == 0 ? -0.5 + skew : r == 1 ? 0 : -0.5 - skew)) / radius;
    return Vector_3(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(0.75) * double(r));
  });
  EXPECT_LT(checks::mean_quality(skewed), 0.95);
  Mesh mesh = shapes::mesh<Mesh>(skewed);
  SMA::relocate(mesh, SMA::Uniform_metric_field(1), params::number_of_iterations(50));
  EXPECT_GT(checks::mean_quality(shapes::soup(mesh)), 0.99);
}

TEST(Displacement_to_center, vanishes_in_the_centre_of_a_regular_star_and_leads_back_to_it)
{
  const Vector_3 normal(0, 0, 1);
  for (const double stretch : {1.0, 4.0}) { // a hexagon of unit edges in the metric, stretched in space
    const SMA::Anisotropic_metric metric{SMA::Metric_tensor_3(1 / (stretch * stretch), 0, 1, 0, 0, 1)};
    const auto corner = [&](int i) {
      const double angle = i * shapes::pi / 3;
      return Vector_3(stretch * std::cos(angle), std::sin(angle), 0);
    };
    const auto displacement = [&](const Vector_3& p) {
      return SMA::displacement_to_center(p, normal, metric, [&](const auto& add) {
        for (int i = 0; i < 6; ++i) add(corner(i), metric, corner(i + 1), metric);
      });
    };
    EXPECT_LT(displacement(Vector_3::Zero()).norm(), 1e-14);
    for (const Vector_3& p : {Vector_3(0.1 * stretch, 0, 0), Vector_3(0, 0.1, 0), Vector_3(-0.2 * stretch, 0.2, 0.1)}) {
      const Vector_3 left = p + displacement(p), flat(p.x(), p.y(), 0);
      EXPECT_DOUBLE_EQ(left.z(), p.z());
      EXPECT_LT(metric.length(left - Vector_3(0, 0, left.z())), 0.7 * metric.length(flat));
    }
  }
}

TEST(Relocate, raises_the_mean_and_the_least_quality)
{
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    Mesh mesh = shapes::mesh<Mesh>(shape.soup);
    EXPECT_GT(SMA::relocate(mesh, SMA::Uniform_metric_field(shape.soup.mean_edge_length())), 0u);
    const Soup after = shapes::soup(mesh);
    EXPECT_GT(checks::mean_quality(after), checks::mean_quality(shape.soup));
    EXPECT_GE(checks::least_quality(after), checks::least_quality(shape.soup) * (1 - 1e-9));
    EXPECT_EQ(after.points.size(), shape.soup.points.size());
  }
}

/// The largest angle between the tangent plane of the torus at each vertex and the faces around it, in degrees.
std::vector<double> deviations(const Soup& soup)
{
  std::vector<double> result(soup.points.size(), 0);
  for (const shapes::Triangle& t : soup.triangles) {
    const Vector_3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    const Vector_3 n = (b - a).cross(c - a).normalized();
    for (const auto v : t)
      result[v] = (std::max)(result[v], std::acos(n.dot(shapes::torus_normal(soup.points[v]))) * 180 / shapes::pi);
  }
  return result;
}

// Every third vertex in both directions may move, none of their neighbours: the faces around them are theirs alone.
TEST(Relocate, keeps_faces_near_the_tangent_plane_of_what_moves)
{
  const std::size_t around = 60, across = 30;
  const Soup before = shapes::torus(around, across, 0.15);
  const auto is_free = [&](std::size_t v) { return v / around % 3 == 0 && v % around % 3 == 0; };
  const auto relocated = [&](double limit) {
    Mesh mesh = shapes::mesh<Mesh>(before);
    const auto is_fixed = mesh.add_property_map<Mesh::Vertex_index, bool>("v:is_fixed", true).first;
    for (const auto v : mesh.vertices()) is_fixed[v] = !is_free(v);
    EXPECT_GT(SMA::relocate(mesh, SMA::Uniform_metric_field(1.5 * before.mean_edge_length()),
                            params::vertex_is_constrained_map(is_fixed).maximum_normal_deviation(limit)), 0u);
    return shapes::soup(mesh);
  };
  const double limit = 7, rounding = 0.5; // the kernel knows the normals as they were estimated
  const Soup limited = relocated(limit);
  const std::vector<double> start = deviations(before), free = deviations(relocated(180)), kept = deviations(limited);
  std::size_t beyond = 0;
  for (std::size_t v = 0; v < start.size(); ++v) {
    if (!is_free(v)) continue;
    beyond += free[v] > (std::max)(limit, start[v]) + rounding;
    EXPECT_LT(kept[v], (std::max)(limit, start[v]) + rounding) << v;
  }
  EXPECT_GT(beyond, 0u);
  EXPECT_GT(checks::mean_quality(limited), checks::mean_quality(before));
}

TEST(Relocate, refuses_angles_that_are_none)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(1));
  for (const double wrong : {0.0, -1.0, 181.0})
    EXPECT_THROW(SMA::relocate(mesh, SMA::Uniform_metric_field(1), params::maximum_normal_deviation(wrong)),
                 SMA::Invalid_parameter_error);
}

TEST(Relocate, spreads_the_vertices_of_a_boundary_evenly)
{
  // all vertices of the boundary of a square but its corners start near one end of their side
  Soup skewed = shapes::grid(10, 10, false, false, 0, [](double u, double v) { return Vector_3(u * u, v * v, 0); });
  Mesh mesh = shapes::mesh<Mesh>(skewed);
  SMA::relocate(mesh, SMA::Uniform_metric_field(0.1), params::number_of_iterations(200));
  double longest = 0, shortest = 1;
  for (const auto e : mesh.edges()) {
    if (!mesh.is_border(e)) continue;
    const double l = std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
    longest = (std::max)(longest, l);
    shortest = (std::min)(shortest, l);
  }
  EXPECT_LT(longest, 0.13); // 0.19 and 0.01 at the start
  EXPECT_GT(shortest, 0.07);
}

TEST(Relocate, puts_a_vertex_where_its_worst_face_is_best_or_good)
{
  shapes::Random random(14);
  std::vector<double> gaps;
  for (int trial = 0; trial < 100; ++trial) {
    const Plane_star star(random, 1);
    const double best = 1 / star.optimum();
    if (best > 0.75) continue; // diffusion may keep what is good
    Soup soup;
    for (const Vector_2& q : star.ring) soup.points.emplace_back(q.x(), q.y(), 0);
    soup.points.emplace_back(star.centroid().x(), star.centroid().y(), 0);
    const Index n = Index(star.ring.size());
    for (Index i = 0; i < n; ++i) soup.triangles.push_back({i, (i + 1) % n, n});
    if (!(checks::least_area(soup, [](const Vector_3&) { return Vector_3(0, 0, 1); }) > 0)) continue;
    Mesh mesh = shapes::mesh<Mesh>(soup);
    const auto is_fixed = mesh.add_property_map<Mesh::Vertex_index, bool>("v:fixed", true).first;
    is_fixed[Mesh::Vertex_index(n)] = false;
    SMA::relocate(mesh, SMA::Uniform_metric_field(1), params::vertex_is_constrained_map(is_fixed));
    const Soup after = shapes::soup(mesh);
    EXPECT_GE(checks::least_quality(after), checks::least_quality(soup) * (1 - 1e-12));
    gaps.push_back((best - checks::least_quality(after)) / best);
  }
  ASSERT_GT(gaps.size(), 20u);
  std::sort(gaps.begin(), gaps.end());
  EXPECT_LT(gaps[gaps.size() / 2], 0.01);
  EXPECT_LT(gaps.back(), 0.1);
}

TEST(Relocate, shifts_the_sides_of_a_narrow_strip_against_each_other)
{
  // no vertex inside: triangles that lean over, where isosceles ones would be better
  const double width = 0.2;
  Soup strip;
  for (int i = 0; i <= 20; ++i)
    for (const double y : {0.0, width}) strip.points.emplace_back(y > 0 && i > 0 && i < 20 ? i + 0.2 : i, y, 0);
  for (Index i = 0; i < 40; i += 2) {
    strip.triangles.push_back({i, i + 2, i + 1});
    strip.triangles.push_back({i + 1, i + 2, i + 3});
  }
  Mesh mesh = shapes::mesh<Mesh>(strip);
  SMA::relocate(mesh, SMA::Uniform_metric_field(1), params::number_of_iterations(50));
  const Soup after = shapes::soup(mesh);
  EXPECT_GT(checks::mean_quality(after), 1.05 * checks::mean_quality(strip));
  EXPECT_GT(checks::least_quality(after), 1.15 * checks::least_quality(strip));
  EXPECT_NEAR(checks::area(after), 20 * width, 1e-12);
  EXPECT_GT(checks::least_area(after, [](const Vector_3&) { return Vector_3(0, 0, 1); }), 0);
}

} // namespace test_relocate

// SPDX-License-Identifier: GPL-3.0-or-later
//
// A number of vertices, bounds, gradation and narrow places: what is made of tensors and sizes.

#include "analytic_fields.h"
#include "fields/tensors.h"
#include "policies.h"

#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/fields/metric_normalization.h>
#include <CGAL/Surface_mesh_adaptation/fields/proximity.h>
#include <CGAL/Surface_mesh_adaptation/metric/Interpolation_norm.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace test_normalization {

using namespace tensors_of_tests;
using tensors_of_tests::nan; // not that of C

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

// Noise asks for sizes without bound; what is left for it is a size that falls with the scale.
TEST(Normalization, keeps_sizes_above_the_least_one_of_the_scale)
{
  const Soup soup = shapes::sphere(4);
  const Reference r = reference(soup);
  const double noise = 1e12, least_size = 0.5;
  Tensors tensors(soup.points.size(), Metric_tensor_3::isotropic(1));
  for (std::size_t v = 0; v < tensors.size(); v += 50) tensors[v] = noise * tensors[v];
  for (const double n : {1000.0, 10000.0}) {
    const SMA::Scalable_metric metric{tensors, SMA::Size_bounds(1e-6, 1), 1, {}, least_size};
    const auto sizes = SMA::normalize_to_vertex_count<double>(sequential, r.mesh, r.points, r.normals, metric, n);
    const double scale = 1 / (sizes[1] * sizes[1]); // where there is no noise
    for (std::size_t v = 0; v < sizes.size(); ++v)
      EXPECT_NEAR(sizes[v], v % 50 == 0 ? least_size / scale : sizes[1], 1e-9);
    EXPECT_LT(sizes[0], sizes[1]);
  }
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

} // namespace test_normalization

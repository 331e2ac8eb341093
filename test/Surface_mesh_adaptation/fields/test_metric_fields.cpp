// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of the package: what metric each gives, and what the mesh that follows it is like.

#include "analytic_fields.h"
#include "fields/tensors.h"
#include "interpolation_error.h"
#include "policies.h"
#include "real_meshes.h"
#include "shape_meshes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace test_metric_fields {

using namespace tensors_of_tests;
using tensors_of_tests::nan; // not that of C
using analytic::Surface;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

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

} // namespace test_metric_fields

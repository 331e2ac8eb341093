// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each kernel alone, through its public function, on surfaces that are known: what it may never break, and that it does
// what it is for.

#include "checks.h"
#include "policies.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/kernels/centering.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/numerics/minimize_worst.h>
#include <CGAL/Surface_mesh_adaptation/refine.h>
#include <CGAL/Surface_mesh_adaptation/regularize.h>
#include <CGAL/Surface_mesh_adaptation/relocate.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>
#include <CGAL/Surface_mesh_adaptation/swap.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;
using shapes::Index;
using shapes::Soup;
using shapes::Vector_3;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// Calls a kernel; needed since functions that are templates are no values.
struct Kernel
{
  const char* name;
  double size; ///< as a multiple of the mean edge length, at which the kernel finds much to do
  std::function<std::size_t(Mesh&, const SMA::Uniform_metric_field&)> run;
};

/// The shapes are regular: their edges are split first.
template <class... Arguments>
std::size_t refine_and_regularize(Arguments&&... arguments)
{
  SMA::refine(arguments...);
  return SMA::regularize(arguments...);
}

std::vector<Kernel> kernels()
{
  return {{"refine", 0.3, [](Mesh& m, const auto& field) { return SMA::refine(m, field); }},
          {"simplify", 2, [](Mesh& m, const auto& field) { return SMA::simplify(m, field); }},
          {"swap", 1, [](Mesh& m, const auto& field) { return SMA::swap(m, field); }},
          {"relocate", 1, [](Mesh& m, const auto& field) { return SMA::relocate(m, field); }},
          {"regularize", 0.6, [](Mesh& m, const auto& field) { return refine_and_regularize(m, field); }}};
}

/// A surface of which the normal is known between its ridges.
struct Shape
{
  const char* name;
  Soup soup;
  std::function<Vector_3(const Vector_3&)> normal;
  std::function<double(const Vector_3&)> distance;
};

constexpr double cylinder_height = 2;

std::vector<Shape> smooth_shapes()
{
  const auto radial = [](const Vector_3& p) { return Vector_3(p[0], p[1], 0); };
  return {{"sphere", shapes::sphere(3, 0.5), [](const Vector_3& p) { return p; },
           [](const Vector_3& p) { return std::abs(p.norm() - 1); }},
          {"torus", shapes::torus(48, 24, 0.25), shapes::torus_normal,
           [](const Vector_3& p) {
    const double r = std::hypot(std::hypot(p[0], p[1]) - shapes::torus_large_radius, p[2]);
    return std::abs(r - shapes::torus_small_radius);
           }},
          {"square", shapes::square(16, 0.25), [](const Vector_3&) { return Vector_3(0, 0, 1); },
           [](const Vector_3& p) { return std::abs(p[2]); }},
          {"open cylinder", shapes::open_cylinder(32, 12, cylinder_height, 0.25), radial,
           [](const Vector_3& p) { return std::abs(std::hypot(p[0], p[1]) - 1); }}};
}

class Kernels : public ::testing::TestWithParam<std::size_t>
{
protected:
  Kernel kernel_ = kernels()[GetParam()];

  /// Runs the kernel on `soup` and expects it to have done something.
  Soup result(const Soup& soup, Mesh& mesh) const
  {
    mesh = shapes::mesh<Mesh>(soup);
    EXPECT_GT(kernel_.run(mesh, SMA::Uniform_metric_field(kernel_.size * soup.mean_edge_length())), 0u);
    return shapes::soup(mesh);
  }
};

TEST_P(Kernels, keep_a_manifold_of_the_same_topology)
{
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    Mesh mesh;
    const Soup after = result(shape.soup, mesh);
    ASSERT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
    EXPECT_FALSE(mesh.has_garbage());
    ASSERT_TRUE(checks::is_manifold(after));
    EXPECT_EQ(checks::topology(after), checks::topology(shape.soup));
  }
}

TEST_P(Kernels, turn_no_face_over_and_stay_on_the_surface)
{
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    ASSERT_GT(checks::least_area(shape.soup, shape.normal), 0);
    Mesh mesh;
    const Soup after = result(shape.soup, mesh);
    const double h = shape.soup.mean_edge_length();
    EXPECT_GT(checks::least_area(after, shape.normal), 0);
    for (const Vector_3& p : after.points) EXPECT_LT(shape.distance(p), 0.15 * h * h);
  }
}

TEST_P(Kernels, keep_the_boundary_of_a_square)
{
  Mesh mesh;
  const Soup after = result(shapes::square(16, 0.25), mesh);
  EXPECT_NEAR(checks::area(after), 1, 1e-12);
  const auto count = [&](double x, double y) {
    return std::count(after.points.begin(), after.points.end(), Vector_3(x, y, 0));
  };
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0}) EXPECT_EQ(count(x, y), 1);
  for (const auto h : mesh.halfedges()) {
    if (!mesh.is_border(h)) continue;
    const auto p = mesh.point(mesh.target(h));
    EXPECT_LT((std::min)({std::abs(p.x()), std::abs(1 - p.x()), std::abs(p.y()), std::abs(1 - p.y())}), 1e-12);
  }
}

TEST_P(Kernels, keep_the_ridges_of_a_capped_cylinder)
{
  const std::size_t around = 48;
  const Soup before = shapes::capped_cylinder(around, 12, cylinder_height);
  Mesh mesh = shapes::mesh<Mesh>(before);
  const auto is_ridge = mesh.add_property_map<Mesh::Edge_index, bool>("e:ridge", false).first;
  const double size = kernel_.size * before.mean_edge_length();
  const auto np = params::edge_is_constrained_map(is_ridge);
  if (std::string(kernel_.name) == "refine") SMA::refine(mesh, SMA::Uniform_metric_field(size), np);
  if (std::string(kernel_.name) == "simplify") SMA::simplify(mesh, SMA::Uniform_metric_field(size), np);
  if (std::string(kernel_.name) == "swap") SMA::swap(mesh, SMA::Uniform_metric_field(size), np);
  if (std::string(kernel_.name) == "relocate") SMA::relocate(mesh, SMA::Uniform_metric_field(size), np);
  if (std::string(kernel_.name) == "regularize") refine_and_regularize(mesh, SMA::Uniform_metric_field(size), np);

  ASSERT_TRUE(checks::is_manifold(shapes::soup(mesh)));
  const double chord_error = 1 - std::cos(shapes::pi / double(around));
  double length = 0;
  for (const auto e : mesh.edges()) {
    if (!is_ridge[e]) continue;
    const auto p = mesh.point(mesh.vertex(e, 0)), q = mesh.point(mesh.vertex(e, 1));
    length += std::sqrt(CGAL::squared_distance(p, q));
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 1, chord_error);
    EXPECT_NEAR(p.z(), q.z(), 1e-12);
    EXPECT_LT((std::min)(std::abs(p.z()), std::abs(p.z() - cylinder_height)), 1e-12);
  }
  // two circles: longer chords make them shorter, but not by much
  EXPECT_LT(length, 2 * 2 * shapes::pi * (1 + 1e-3));
  EXPECT_GT(length, 2 * 2 * shapes::pi * 0.95);
}

TEST_P(Kernels, keep_a_cube_exactly)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::cube(6));
  kernel_.run(mesh, SMA::Uniform_metric_field(kernel_.size * shapes::cube(6).mean_edge_length()));
  const Soup after = shapes::soup(mesh);
  ASSERT_TRUE(checks::is_manifold(after));
  EXPECT_NEAR(checks::area(after), 24, 1e-9);
  std::size_t corners = 0;
  for (const Vector_3& p : after.points) {
    EXPECT_NEAR(p.cwiseAbs().maxCoeff(), 1, 1e-12);
    if (p.cwiseAbs().isOnes(1e-12)) ++corners;
  }
  EXPECT_EQ(corners, 8u);
}

TEST_P(Kernels, give_the_same_bits_with_every_policy)
{
  const Soup before = shapes::torus(120, 60, 0.25);
  const SMA::Uniform_metric_field field(kernel_.size * before.mean_edge_length());
  Soup first;
  for_each_policy([&](const auto& execution, const std::string& name) {
    Mesh mesh = shapes::mesh<Mesh>(before);
    if (std::string(kernel_.name) == "refine") SMA::refine(execution, mesh, field);
    if (std::string(kernel_.name) == "simplify") SMA::simplify(execution, mesh, field);
    if (std::string(kernel_.name) == "swap") SMA::swap(execution, mesh, field);
    if (std::string(kernel_.name) == "relocate") SMA::relocate(execution, mesh, field);
    if (std::string(kernel_.name) == "regularize") refine_and_regularize(execution, mesh, field);
    const Soup after = shapes::soup(mesh);
    if (first.points.empty()) first = after;
    EXPECT_TRUE(checks::is_identical(after, first)) << name;
  });
  EXPECT_FALSE(first.triangles == before.triangles && first.points == before.points);
}

TEST_P(Kernels, stop_when_nothing_is_left_to_do)
{
  // once it is done, doing it again changes little or nothing
  const Soup before = shapes::sphere(3, 0.5);
  const SMA::Uniform_metric_field field(kernel_.size * before.mean_edge_length());
  Mesh mesh = shapes::mesh<Mesh>(before);
  const bool is_refined = std::string(kernel_.name) == "regularize";
  const std::size_t first = kernel_.run(mesh, field);
  const std::size_t second = is_refined ? SMA::regularize(mesh, field) : kernel_.run(mesh, field);
  EXPECT_LE(second, first / 5);
}

TEST_P(Kernels, survive_hostile_shapes)
{
  shapes::Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Soup soup = trial % 2 == 0 ? shapes::sphere(2) : shapes::torus(9, 7);
    for (Vector_3& p : soup.points) {
      p += 0.5 * random.vector();
      if (random.below(10) == 0) p = soup.points[random.below(soup.points.size())]; // degenerate faces
    }
    for (const double size : {0.1, 0.3, 1.0}) {
      Mesh mesh = shapes::mesh<Mesh>(soup);
      kernel_.run(mesh, SMA::Uniform_metric_field(size));
      ASSERT_TRUE(checks::is_manifold(shapes::soup(mesh)));
      ASSERT_EQ(checks::topology(shapes::soup(mesh)), checks::topology(soup));
    }
  }
}

std::string name_of_kernel(const ::testing::TestParamInfo<std::size_t>& i) { return kernels()[i.param].name; }

INSTANTIATE_TEST_SUITE_P(Alone, Kernels, ::testing::Range(std::size_t(0), kernels().size()), name_of_kernel);

// What each is for

struct Lengths
{
  std::size_t edges = 0, too_long = 0, too_short = 0;
};

Lengths lengths(const Soup& soup, double size)
{
  Lengths l;
  checks::for_each_edge(soup.triangles, [&](Index a, Index b) {
    const double length = (soup.points[a] - soup.points[b]).norm() / size;
    ++l.edges;
    l.too_long += length > std::sqrt(2.0) * (1 + 1e-12);
    l.too_short += length < std::sqrt(0.5);
  });
  return l;
}

TEST(Refine, leaves_hardly_a_long_edge)
{
  for (const Shape& shape : smooth_shapes())
    for (const double relative : {0.5, 0.2}) {
      SCOPED_TRACE(shape.name);
      Mesh mesh = shapes::mesh<Mesh>(shape.soup);
      const double size = relative * shape.soup.mean_edge_length();
      const std::size_t split = SMA::refine(mesh, SMA::Uniform_metric_field(size));
      const Lengths l = lengths(shapes::soup(mesh), size);
      EXPECT_LE(l.too_long, l.edges / 1000); // only where a split would turn a face over
      EXPECT_EQ(num_vertices(mesh), shape.soup.points.size() + split);
    }
}

TEST(Refine, keeps_the_vertices_of_the_input)
{
  const Soup before = shapes::torus(24, 12, 0.3);
  Mesh mesh = shapes::mesh<Mesh>(before);
  SMA::refine(mesh, SMA::Uniform_metric_field(0.06));
  const Soup after = shapes::soup(mesh);
  const auto less = [](const Vector_3& a, const Vector_3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::vector<Vector_3> sorted = after.points;
  std::sort(sorted.begin(), sorted.end(), less);
  for (const Vector_3& p : before.points) EXPECT_TRUE(std::binary_search(sorted.begin(), sorted.end(), p, less));
}

TEST(Refine, does_nothing_on_a_mesh_that_is_fine_enough)
{
  const Soup before = shapes::sphere(3);
  Mesh mesh = shapes::mesh<Mesh>(before);
  EXPECT_EQ(SMA::refine(mesh, SMA::Uniform_metric_field(1)), 0u);
  EXPECT_EQ(num_vertices(mesh), before.points.size());
}

TEST(Simplify, leaves_few_short_edges_and_makes_no_long_one)
{
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    Mesh mesh = shapes::mesh<Mesh>(shape.soup);
    const double size = 2.5 * shape.soup.mean_edge_length();
    const std::size_t removed = SMA::simplify(mesh, SMA::Uniform_metric_field(size));
    const Lengths l = lengths(shapes::soup(mesh), size);
    // all were too short; what is left cannot be collapsed without making a long edge: the other kernels help there
    EXPECT_LT(double(l.too_short), 0.25 * double(l.edges));
    EXPECT_EQ(l.too_long, 0u);
    EXPECT_EQ(num_vertices(mesh) + removed, shape.soup.points.size());
  }
}

TEST(Simplify, moves_no_vertex)
{
  const Soup before = shapes::torus(48, 24, 0.3);
  Mesh mesh = shapes::mesh<Mesh>(before);
  SMA::simplify(mesh, SMA::Uniform_metric_field(0.3));
  for (const Vector_3& p : shapes::soup(mesh).points)
    EXPECT_EQ(std::count(before.points.begin(), before.points.end(), p), 1);
}

TEST(Swap, raises_the_mean_quality_and_not_the_number_of_bad_faces)
{
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    Mesh mesh = shapes::mesh<Mesh>(shape.soup);
    EXPECT_GT(SMA::swap(mesh, SMA::Uniform_metric_field(3 * shape.soup.mean_edge_length())), 0u);
    const Soup after = shapes::soup(mesh);
    EXPECT_GT(checks::mean_quality(after), checks::mean_quality(shape.soup));
    EXPECT_GE(checks::least_quality(after), checks::least_quality(shape.soup) * (1 - 1e-9));
    EXPECT_EQ(after.triangles.size(), shape.soup.triangles.size());
  }
}

TEST(Swap, restores_a_triangulation_that_was_scrambled)
{
  // all diagonals the long way in a strip of squares that lean over: each swap that helps is found
  Soup leaning = shapes::grid(30, 30, false, false, 0, [](double u, double v) { return Vector_3(u + 0.5 * v, v, 0); });
  Mesh mesh = shapes::mesh<Mesh>(leaning);
  SMA::swap(mesh, SMA::Uniform_metric_field(1));
  const Soup after = shapes::soup(mesh);
  EXPECT_GT(checks::mean_quality(after), 0.94); // the short diagonal gives 0.96, the long one 0.56
}

/// A tube of so many columns and rows of quadrilaterals, cut one way in even rows and the other way in odd ones.
/// `point(column, row)`.
template <class Point>
Soup tube(std::size_t columns, std::size_t rows, const Point& point)
{
  Soup s;
  for (std::size_t r = 0; r <= rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) s.points.push_back(point(c, r));
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t d = (c + 1) % columns;
      const SMA::Index a = SMA::Index(r * columns + c), b = SMA::Index(r * columns + d);
      const SMA::Index above_a = SMA::Index(a + columns), above_b = SMA::Index(b + columns);
      if (r % 2 == 0) {
        s.triangles.push_back({a, b, above_b});
        s.triangles.push_back({a, above_b, above_a});
      } else {
        s.triangles.push_back({a, b, above_a});
        s.triangles.push_back({b, above_b, above_a});
      }
    }
  return s;
}

TEST(Swap, gives_ridges_three_faces_on_each_side)
{
  // a square tube of which the diagonals zigzag: 4 and 2 faces at the vertices of its ridges, 6 together
  constexpr std::size_t rows = 20;
  const Soup zigzag = tube(4, rows, [](std::size_t c, std::size_t r) {
    return Vector_3(c == 1 || c == 2, c >= 2, double(r));
  });
  Mesh mesh = shapes::mesh<Mesh>(zigzag);
  EXPECT_GT(SMA::swap(mesh, SMA::Uniform_metric_field(1)), 0u);
  std::map<std::array<int, 4>, int> faces; // at a point of space, for the normal of a side
  const Soup after = shapes::soup(mesh);
  for (const shapes::Triangle& t : after.triangles) {
    const Vector_3 center = (after.points[t[0]] + after.points[t[1]] + after.points[t[2]]) / 3;
    const int side = center.x() == 0 ? 0 : center.x() == 1 ? 1 : center.y() == 0 ? 2 : 3;
    for (const auto v : t) {
      const Vector_3& p = after.points[v];
      ++faces[{int(p.x()), int(p.y()), int(p.z()), side}];
    }
  }
  int inside = 0, balanced = 0;
  for (const auto& f : faces)
    if (f.first[2] > 0 && f.first[2] < int(rows)) {
      ++inside;
      balanced += f.second == 3;
    }
  EXPECT_EQ(inside, 8 * int(rows - 1));
  EXPECT_GT(balanced, 0.8 * inside); // none before
}

/// Of a mesh of the plane: the numbers of edges at the vertices that are not on its boundary.
std::map<std::size_t, std::size_t> inner_degrees(const Mesh& mesh)
{
  std::map<std::size_t, std::size_t> count;
  for (const auto v : mesh.vertices())
    if (!mesh.is_border(v)) ++count[mesh.degree(v)];
  return count;
}

/// A lattice of equilateral triangles of side 1 over a parallelogram, from (0, 0) to the right and up to the right.
Mesh lattice(std::size_t n)
{
  Soup soup;
  for (std::size_t j = 0; j <= n; ++j)
    for (std::size_t i = 0; i <= n; ++i)
      soup.points.emplace_back(double(i) + double(j) / 2, double(j) * std::sqrt(3.0) / 2, 0);
  const auto vertex = [&](std::size_t i, std::size_t j) { return Index(j * (n + 1) + i); };
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      soup.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      soup.triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return shapes::mesh<Mesh>(soup);
}

TEST(Regularize, does_nothing_to_a_lattice)
{
  Mesh mesh = lattice(12);
  ASSERT_EQ(inner_degrees(mesh).size(), 1u);
  EXPECT_EQ(SMA::regularize(mesh, SMA::Uniform_metric_field(1)), 0u);
}

TEST(Regularize, moves_a_vertex_from_where_it_is_too_many_to_where_one_is_missing)
{
  Mesh mesh = lattice(16);
  const auto halfedge_at = [&](double x, double y) {
    const auto distance = [&](auto h) { return CGAL::squared_distance(mesh.point(mesh.target(h)), Mesh::Point(x, y, 0)); };
    return *std::min_element(mesh.halfedges().begin(), mesh.halfedges().end(),
                             [&](auto g, auto h) { return distance(g) < distance(h); });
  };
  auto h = halfedge_at(8, 4);
  const auto between = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
  const auto opposite = mesh.opposite(h);
  const auto split = CGAL::Euler::split_edge(h, mesh);
  mesh.point(mesh.target(split)) = between;
  CGAL::Euler::split_face(split, mesh.next(mesh.next(split)), mesh);
  CGAL::Euler::split_face(opposite, mesh.next(mesh.next(opposite)), mesh);
  h = halfedge_at(14, 10);
  CGAL::Euler::collapse_edge(mesh.edge(h), mesh);
  mesh.collect_garbage();
  ASSERT_TRUE(CGAL::is_triangle_mesh(mesh));
  const std::size_t vertices = mesh.number_of_vertices();
  const std::map<std::size_t, std::size_t> before = inner_degrees(mesh);
  ASSERT_EQ(before.at(4), 1u);
  ASSERT_EQ(before.at(8), 1u);

  EXPECT_EQ(SMA::regularize(mesh, SMA::Uniform_metric_field(1)), 2u);

  EXPECT_EQ(mesh.number_of_vertices(), vertices);
  EXPECT_EQ(inner_degrees(mesh).size(), 1u); // all six
  EXPECT_EQ(inner_degrees(mesh).begin()->first, 6u);
  ASSERT_TRUE(checks::is_manifold(shapes::soup(mesh)));
  EXPECT_GT(checks::least_area(shapes::soup(mesh), [](const Vector_3&) { return Vector_3(0, 0, 1); }), 0);
}

TEST(Regularize, makes_an_adapted_mesh_more_regular_than_swaps_can)
{
  const Soup before = shapes::torus(48, 24, 0.25);
  Mesh mesh = shapes::mesh<Mesh>(before);
  const SMA::Uniform_metric_field field(0.4 * before.mean_edge_length());
  const auto irregular_share = [&] {
    return 1 - double(inner_degrees(mesh)[6]) / double(mesh.number_of_vertices());
  };
  const auto adapt = [&] {
    SMA::refine(mesh, field);
    for (int i = 0; i < 4; ++i) {
      SMA::simplify(mesh, field);
      SMA::swap(mesh, field);
      SMA::relocate(mesh, field);
    }
  };
  adapt();
  const double by_swaps = irregular_share();
  for (int i = 0; i < 3; ++i) {
    SMA::regularize(mesh, field);
    SMA::swap(mesh, field);
    SMA::relocate(mesh, field);
  }
  EXPECT_LT(irregular_share(), 0.8 * by_swaps);
  EXPECT_GT(checks::mean_quality(shapes::soup(mesh)), 0.97);
}

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

// The optimisation of relocation, alone and in it

using SMA::Linear_function_2;
using SMA::Vector_2;

/// The least maximum in the square, from all points where two of the functions, or one and a side, or two sides meet.
double least_maximum(const SMA::Ring<Linear_function_2>& functions, double radius)
{
  std::vector<Eigen::Vector3d> lines; // a x + b y = c
  for (const double s : {-radius, radius}) {
    lines.emplace_back(1, 0, s);
    lines.emplace_back(0, 1, s);
  }
  for (std::size_t i = 0; i < functions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vector_2 g = functions[i].gradient - functions[j].gradient;
      lines.emplace_back(g.x(), g.y(), functions[j].value - functions[i].value);
    }
  double least = maximum(functions, Vector_2(0, 0));
  for (const Eigen::Vector3d& k : lines)
    for (const Eigen::Vector3d& l : lines) {
      const double det = k[0] * l[1] - k[1] * l[0];
      const Vector_2 x((k[2] * l[1] - k[1] * l[2]) / det, (k[0] * l[2] - k[2] * l[0]) / det);
      if (x.cwiseAbs().maxCoeff() <= radius * (1 + 1e-12)) least = (std::min)(least, maximum(functions, x));
    }
  return least;
}

TEST(Minimize_maximum, finds_the_optimum_of_brute_force)
{
  shapes::Random random(11);
  for (int trial = 0; trial < 2000; ++trial) {
    SMA::Ring<Linear_function_2> functions;
    for (std::size_t n = 1 + random.below(10); n > 0; --n)
      functions.push_back({random.real(1, 3), random.vector().head<2>() * (trial % 3 == 0 ? 0.2 : 5)});
    if (trial % 5 == 0) functions.push_back(functions[0]); // equal ones, parallel ones, a constant
    if (trial % 7 == 0) functions.push_back({functions[0].value + 0.1, functions[0].gradient});
    if (trial % 11 == 0) functions.push_back({random.real(0, 3), Vector_2(0, 0)});
    const double radius = random.real(0.01, 2);
    const Vector_2 d = minimize_maximum(functions, radius);
    EXPECT_LE(d.cwiseAbs().maxCoeff(), radius * (1 + 1e-12));
    EXPECT_NEAR(maximum(functions, d), least_maximum(functions, radius), 1e-9);
  }
}

/// A star-shaped ring around a vertex of the plane that may move, in a metric of ratio `stretch`.
struct Plane_star
{
  std::vector<Vector_2> ring;
  SMA::Anisotropic_metric metric;

  Plane_star(shapes::Random& random, double stretch)
    : metric{SMA::Metric_tensor_3(1 / (stretch * stretch), 0, 1, 0, 0, 1)}
  {
    const std::size_t n = 5 + random.below(4);
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * shapes::pi * (double(i) + random.real(-0.35, 0.35)) / double(n);
      const double r = random.real(0.5, 1.5);
      ring.emplace_back(stretch * r * std::cos(angle), r * std::sin(angle));
    }
  }

  SMA::Ring<Linear_function_2> distortions(const Vector_2& p) const
  {
    SMA::Ring<Linear_function_2> functions;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector_2 a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
      const bool is_upright = a.x() * b.y() > a.y() * b.x();
      const Vector_3 ea(a.x(), a.y(), 0), eb(b.x(), b.y(), 0);
      const SMA::Distortion d = face_distortion(metric, metric, metric, ea, eb);
      functions.push_back({is_upright ? d.value : INFINITY, d.gradient.head<2>()});
    }
    return functions;
  }

  double worst(const Vector_2& p) const { return maximum(distortions(p), Vector_2(0, 0)); }

  /// Mean of the ring, weighted by areas: where diffusion leaves the vertex.
  Vector_2 centroid() const
  {
    Vector_2 sum(0, 0);
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector_2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const double w = a.x() * b.y() - a.y() * b.x();
      sum += w * (a + b) / 3;
      area += w;
    }
    return sum / area;
  }

  /// `worst`, continued outside of where all faces are upright such that the way back is downhill.
  double continued_worst(const Vector_2& p) const
  {
    double least = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector_2 a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
      least = (std::min)(least, a.x() * b.y() - a.y() * b.x());
    }
    return least < 0 ? 1e9 - least : (std::min)(1e9, worst(p));
  }

  /// The least worst distortion, by nested line searches: the points where a face is no worse than some bound form a
  /// disc in the metric, so that all functions here have one minimum.
  double optimum() const
  {
    const auto least_on = [](double low, double high, const auto& f) {
      constexpr double golden = 0.6180339887498949;
      double a = high - golden * (high - low), b = low + golden * (high - low), fa = f(a), fb = f(b);
      for (int i = 0; i < 60; ++i)
        if (fa < fb) {
          high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
        } else {
          low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
        }
      return (std::min)(fa, fb);
    };
    const double stretch = 1 / std::sqrt(metric.m[0]);
    return least_on(-1.5 * stretch, 1.5 * stretch, [&](double x) {
      return least_on(-1.5, 1.5, [&](double y) { return continued_worst(Vector_2(x, y)); });
    });
  }
};

/// What is left of the possible decrease of the worst distortion after so many rounds from the centroid, sorted.
std::vector<double> remaining_gaps(double stretch, int rounds)
{
  shapes::Random random(12);
  std::vector<double> gaps;
  while (gaps.size() < 100) {
    const Plane_star star(random, stretch);
    Vector_2 p = star.centroid();
    const double start = star.worst(p), optimum = star.optimum();
    if (!std::isfinite(start) || start < optimum * 1.001) continue;
    SMA::minimize_worst(p, 0.5, rounds, 0, [&](const Vector_2& x) { return star.distortions(x); },
                   [](const Vector_2& x, const Vector_2& d) { return Vector_2(x + d); },
                   [&](const Vector_2& x) { return star.worst(x); });
    gaps.push_back((star.worst(p) - optimum) / (start - optimum));
  }
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

TEST(Minimize_worst, never_raises_the_maximum_and_closes_the_gap_in_five_rounds)
{
  for (const double stretch : {1.0, 10.0})
    for (const int rounds : {1, 3, 5, 50}) {
      SCOPED_TRACE(std::to_string(stretch) + " after rounds: " + std::to_string(rounds));
      const std::vector<double> gaps = remaining_gaps(stretch, rounds);
      EXPECT_LE(gaps.back(), 1);
      EXPECT_GE(gaps.front(), -1e-6); // no better than the optimum
      if (rounds >= 5) { EXPECT_LT(gaps[gaps.size() / 2], 1e-3); }
      if (rounds == 50) { EXPECT_LT(gaps.back(), 1e-3); }
    }
}

TEST(Minimize_worst, stops_where_it_is_good_enough)
{
  shapes::Random random(13);
  const Plane_star star(random, 1);
  Vector_2 p = star.centroid();
  int evaluations = 0;
  SMA::minimize_worst(p, 0.5, 5, star.worst(p), [&](const Vector_2& x) { return star.distortions(x); },
                 [](const Vector_2& x, const Vector_2& d) { return Vector_2(x + d); },
                 [&](const Vector_2& x) { return ++evaluations, star.worst(x); });
  EXPECT_EQ(evaluations, 1);
  EXPECT_EQ(p, star.centroid());
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

TEST(Kernel, stops_after_the_sweeps_asked_for)
{
  const Soup before = shapes::sphere(2);
  Mesh once = shapes::mesh<Mesh>(before), all = once, none = once;
  const SMA::Uniform_metric_field field(0.02);
  const std::size_t in_one_sweep = SMA::refine(once, field, params::number_of_iterations(1));
  EXPECT_EQ(in_one_sweep, before.triangles.size() * 3 / 2); // each edge is split once
  EXPECT_LT(in_one_sweep, SMA::refine(all, field));
  EXPECT_EQ(SMA::refine(none, field, params::number_of_iterations(0)), 0u);
}

TEST(Kernel, asks_the_visitor_after_each_sweep)
{
  struct Visitor : SMA::Adaptation_visitor
  {
    int left = 2;
    bool go_on() { return --left > 0; }
  };
  Mesh twice = shapes::mesh<Mesh>(shapes::sphere(2)), stopped = twice;
  const SMA::Uniform_metric_field field(0.02);
  Visitor visitor;
  EXPECT_EQ(SMA::refine(stopped, field, params::visitor(std::ref(visitor))),
            SMA::refine(twice, field, params::number_of_iterations(2)));
  EXPECT_EQ(visitor.left, 0);
}

} // namespace

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each kernel alone, through its public function, on surfaces that are known: what it may never break, and that it does
// what it is for.

#include "checks.h"
#include "kernels/smooth_shapes.h"
#include "policies.h"
#include "shape_meshes.h"

#include <CGAL/Surface_mesh_adaptation/refine.h>
#include <CGAL/Surface_mesh_adaptation/regularize.h>
#include <CGAL/Surface_mesh_adaptation/relocate.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>
#include <CGAL/Surface_mesh_adaptation/swap.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace test_kernels {

using namespace kernels_of_tests;
namespace params = SMA::parameters;

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

} // namespace test_kernels

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What adaptation makes of everything but a good mesh and a good metric: it either refuses, with the mesh as it was to
// the last bit, or gives a manifold. And what it does with the user's visitor, constraints and property maps.

#include "checks.h"
#include "policies.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace test_adapt_inputs {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Metric_tensor_3;
using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Edge = Mesh::Edge_index;
namespace params = SMA::parameters;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls `adapt(mesh)`, which has to throw an `Error`; expects the mesh to be as before, and returns the error.
template <class Error, class Adapt>
Error expect_refusal(Mesh& mesh, const Adapt& adapt)
{
  const Soup before = shapes::soup(mesh);
  const auto halfedges = mesh.number_of_halfedges(), removed = mesh.number_of_removed_vertices();
  const auto expect_untouched = [&] {
    EXPECT_TRUE(checks::is_identical(shapes::soup(mesh), before));
    EXPECT_EQ(mesh.number_of_halfedges(), halfedges);
    EXPECT_EQ(mesh.number_of_removed_vertices(), removed);
  };
  try {
    adapt(mesh);
  } catch (const Error& e) {
    expect_untouched();
    return e;
  }
  throw std::runtime_error("nothing was thrown");
}

template <class Error>
Error expect_refusal_of_mesh(Mesh& mesh)
{
  return expect_refusal<Error>(
    mesh, [](Mesh& m) { SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, SMA::Uniform_metric_field(0.1)); });
}

// Meshes

TEST(Input, with_a_coordinate_that_is_not_finite_is_refused)
{
  for (const double bad : {nan, infinity, -infinity})
    for (const Index v : {0u, 17u, 161u}) {
      Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
      mesh.point(Vertex(v)) = Point(0, bad, 0);
      EXPECT_EQ(expect_refusal_of_mesh<SMA::Non_finite_coordinate_error>(mesh).index(), v);
    }
}

TEST(Input, with_a_face_that_is_no_triangle_is_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::square(4));
  CGAL::Euler::join_face(
    halfedge(*std::find_if(edges(mesh).begin(), edges(mesh).end(), [&](Edge e) { return !mesh.is_border(e); }), mesh),
    mesh);
  std::size_t index = 0;
  for (const auto f : faces(mesh)) {
    if (mesh.degree(f) != 3) break;
    ++index;
  }
  EXPECT_EQ(expect_refusal_of_mesh<SMA::Non_triangular_face_error>(mesh).index(), index);
}

TEST(Input, with_two_tetrahedra_that_share_a_vertex_is_refused)
{
  Soup two = shapes::tetrahedron();
  shapes::append(two, shapes::tetrahedron());
  Mesh mesh = shapes::mesh<Mesh>(two);
  for (const auto h : CGAL::halfedges_around_target(mesh.halfedge(Vertex(5)), mesh)) mesh.set_target(h, Vertex(2));
  mesh.remove_vertex(Vertex(5));
  EXPECT_EQ(expect_refusal_of_mesh<SMA::Non_manifold_vertex_error>(mesh).index(), 2u);
}

TEST(Input, with_an_isolated_vertex_is_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(1));
  mesh.add_vertex(Point(0, 0, 5));
  EXPECT_EQ(expect_refusal_of_mesh<SMA::Non_manifold_vertex_error>(mesh).index(), num_vertices(mesh) - 1);
}

TEST(Input, is_refused_by_its_own_numbers_if_their_order_is_poor)
{
  const Soup one = shapes::torus(90, 80); // rows so long that adaptation numbers the vertices anew
  const Index n = Index(one.points.size());
  Soup two = one;
  shapes::append(two, one);
  Mesh mesh = shapes::mesh<Mesh>(two);
  const Vertex other(n + 100), shared(5000);
  for (const auto h : CGAL::halfedges_around_target(mesh.halfedge(other), mesh)) mesh.set_target(h, shared);
  mesh.remove_vertex(other);
  EXPECT_EQ(expect_refusal_of_mesh<SMA::Non_manifold_vertex_error>(mesh).index(), 5000u);
  mesh = shapes::mesh<Mesh>(one);
  mesh.add_vertex(Point(0, 0, 0));
  EXPECT_EQ(expect_refusal_of_mesh<SMA::Non_manifold_vertex_error>(mesh).index(), n);
}

TEST(Input, with_two_edges_between_the_same_vertices_is_refused)
{
  // two fans around a common pair of poles, glued to a sphere: each edge is fine, but two of them join the poles
  Mesh mesh;
  std::vector<Vertex> v;
  for (const Point& p : {Point(0, 0, 1), Point(0, 0, -1), Point(1, 0, 0), Point(-1, 0, 0)})
    v.push_back(mesh.add_vertex(p));
  const auto add = [&](const std::array<Mesh::Halfedge_index, 3>& h) {
    const auto f = mesh.add_face();
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.set_face(h[i], f);
      mesh.set_next(h[i], h[(i + 1) % 3]);
    }
    mesh.set_halfedge(f, h[0]);
  };
  const auto edge = [&](Vertex a, Vertex b) {
    const auto h = mesh.add_edge(a, b);
    mesh.set_halfedge(b, h);
    mesh.set_halfedge(a, mesh.opposite(h));
    return h;
  };
  const auto left = edge(v[0], v[1]), right = edge(v[0], v[1]);
  const auto up_east = edge(v[2], v[0]), down_east = edge(v[1], v[2]), up_west = edge(v[3], v[0]),
             down_west = edge(v[1], v[3]);
  add({left, down_east, up_east});
  add({mesh.opposite(right), mesh.opposite(up_east), mesh.opposite(down_east)});
  add({right, down_west, up_west});
  add({mesh.opposite(left), mesh.opposite(up_west), mesh.opposite(down_west)});
  ASSERT_TRUE(mesh.is_valid(false));
  EXPECT_EQ(expect_refusal_of_mesh<SMA::Non_simplicial_edge_error>(mesh).index(), 0u);
}

TEST(Input, without_a_face_is_refused)
{
  Mesh mesh;
  expect_refusal_of_mesh<SMA::Empty_mesh_error>(mesh);
  mesh.add_vertex(Point(0, 0, 0));
  expect_refusal_of_mesh<SMA::Empty_mesh_error>(mesh);
}

TEST(Input, with_removed_elements_is_adapted_without_them)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::square(6));
  CGAL::Euler::remove_face(mesh.halfedge(Mesh::Face_index(40)), mesh);
  CGAL::Euler::collapse_edge(mesh.edge(mesh.halfedge(Vertex(16))), mesh);
  ASSERT_TRUE(mesh.has_garbage());
  const checks::Topology before = checks::topology(shapes::soup(mesh));
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.1));
  EXPECT_FALSE(mesh.has_garbage());
  ASSERT_TRUE(checks::is_manifold(shapes::soup(mesh)));
  EXPECT_EQ(checks::topology(shapes::soup(mesh)), before);
  EXPECT_EQ(before.boundary_cycles, 2u);
}

// Metrics and parameters

TEST(Metric, that_is_no_positive_size_is_refused)
{
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(SMA::Uniform_metric_field{bad}, SMA::Invalid_parameter_error);
    EXPECT_THROW(SMA::Curvature_metric_field{bad}, SMA::Invalid_parameter_error);
    for (const Index v : {0u, 17u, 161u}) {
      SCOPED_TRACE("size " + std::to_string(bad) + " at vertex " + std::to_string(v));
      Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
      const auto sizes = mesh.add_property_map<Vertex, double>("v:size", 0.3).first;
      sizes[Vertex(v)] = bad;
      const auto error = expect_refusal<SMA::Invalid_metric_error>(
        mesh, [&](Mesh& m) { SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, sizes); });
      EXPECT_EQ(error.index(), v);
    }
  }
}

TEST(Metric, that_is_no_positive_definite_tensor_is_refused)
{
  const std::vector<Metric_tensor_3> bad = {Metric_tensor_3(1, 0, 1, 0, 0, 0), Metric_tensor_3(1, 0, 1, 0, 0, -1),
                                            Metric_tensor_3(1, 2, 1, 0, 0, 1), Metric_tensor_3(1, 0, nan, 0, 0, 1),
                                            Metric_tensor_3(infinity, 0, 1, 0, 0, 1)};
  for (const Metric_tensor_3& m : bad)
    for (const Index v : {0u, 17u, 161u}) {
      Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
      const auto tensors =
        mesh.add_property_map<Vertex, Metric_tensor_3>("v:metric", Metric_tensor_3::isotropic(0.3)).first;
      tensors[Vertex(v)] = m;
      const auto error = expect_refusal<SMA::Invalid_metric_error>(
        mesh, [&](Mesh& x) { SMA::adapt_surface_mesh<CGAL::Sequential_tag>(x, tensors); });
      EXPECT_EQ(error.index(), v);
    }
}

TEST(Metric, of_a_formula_that_is_invalid_at_a_vertex_is_refused)
{
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    SCOPED_TRACE(bad);
    Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
    const auto size = [&](const Vector_3& p) { return p[2] > 0.999 ? bad : 0.3; };
    expect_refusal<SMA::Invalid_parameter_error>(
      mesh, [&](Mesh& m) { SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, SMA::Analytic_metric_field(size)); });
    const auto tensor = [&](const Vector_3& p) { return Metric_tensor_3(9, 0, 9, 0, 0, p[2] > 0.999 ? bad : 9); };
    expect_refusal<SMA::Invalid_parameter_error>(
      mesh, [&](Mesh& m) { SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, SMA::Analytic_metric_field(tensor)); });
  }
}

TEST(Metric, that_throws_leaves_the_mesh_as_it_was)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  const auto size = [](const Vector_3& p) -> double {
    if (p[2] > 0.99) throw std::domain_error("no size there");
    return 0.1;
  };
  for_each_policy([&](const auto& execution, const std::string& name) {
    SCOPED_TRACE(name);
    expect_refusal<std::domain_error>(
      mesh, [&](Mesh& m) { SMA::adapt_surface_mesh(execution, m, SMA::Analytic_metric_field(size)); });
  });
}

TEST(Metric, that_asks_for_too_many_elements_is_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::tetrahedron());
  for (const double tiny : {1e-200, 1e-308}) {
    SCOPED_TRACE(tiny);
    const auto sizes = mesh.add_property_map<Vertex, double>("v:size").first;
    for (const auto v : vertices(mesh)) sizes[v] = tiny; // its square is not even a number
    expect_refusal<SMA::Invalid_metric_error>(
      mesh, [&](Mesh& m) { SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, sizes); });
  }
}

TEST(Parameter, feature_angle_out_of_range_is_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  for (const double bad : {0.0, -1.0, 180.5, nan, infinity})
    expect_refusal<SMA::Invalid_parameter_error>(mesh, [&](Mesh& m) {
      SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, SMA::Uniform_metric_field(0.1), params::feature_angle(bad));
    });
}

TEST(Parameter, deviations_of_faces_that_make_no_sense_are_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  const auto deviation = mesh.add_property_map<Mesh::Face_index, double>("f:deviation", 0).first;
  for (const double bad : {-1.0, nan, infinity}) {
    deviation[Mesh::Face_index(7)] = bad;
    expect_refusal<SMA::Invalid_parameter_error>(mesh, [&](Mesh& m) {
      SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, SMA::Curvature_metric_field(0.01),
                                                    params::face_deviation_map(deviation));
    });
  }
}

TEST(Parameter, hmin_above_hmax_is_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  SMA::Curvature_metric_field field(0.01);
  field.hmin = 0.2;
  field.hmax = 0.1;
  expect_refusal<SMA::Invalid_parameter_error>(
    mesh, [&](Mesh& m) { SMA::adapt_surface_mesh<CGAL::Sequential_tag>(m, field); });
}

TEST(Parameter, no_round_leaves_the_surface)
{
  const Soup before = shapes::torus(24, 12, 0.2);
  Mesh mesh = shapes::mesh<Mesh>(before);
  const auto report = SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.02),
                                                                    params::number_of_iterations(0));
  EXPECT_EQ(report.rounds, 0u);
  const Soup after = shapes::soup(mesh);
  EXPECT_EQ(after.points.size(), before.points.size());
  EXPECT_NEAR(checks::area(after), checks::area(before), 1e-12);
  const auto as_set = [](const Soup& s) {
    std::vector<std::array<double, 3>> points;
    for (const Vector_3& p : s.points) points.push_back({p[0], p[1], p[2]});
    std::sort(points.begin(), points.end());
    return points;
  };
  EXPECT_EQ(as_set(after), as_set(before));
}

TEST(Parameter, policy_types_and_tags_choose_the_execution)
{
  const auto execution = [](auto tag) {
    Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(1));
    return SMA::adapt_surface_mesh<decltype(tag)>(mesh, SMA::Uniform_metric_field(0.3)).execution;
  };
  EXPECT_EQ(execution(CGAL::Sequential_tag()), "sequential");
  EXPECT_EQ(execution(SMA::Sequential_execution()), "sequential");
  EXPECT_EQ(execution(CGAL::Parallel_if_available_tag()), SMA::Default_parallel_execution::name);
  EXPECT_EQ(execution(SMA::Default_parallel_execution()), SMA::Default_parallel_execution::name);
#ifdef _OPENMP
  EXPECT_EQ(execution(SMA::OpenMP_execution()), "openmp");
#endif
}

TEST(Parameter, packs_of_cgal_are_understood)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2)), other = mesh;
  const auto report =
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.1), CGAL::parameters::number_of_iterations(2));
  EXPECT_LE(report.rounds, 2u);
  SMA::adapt_surface_mesh(other, SMA::Uniform_metric_field(0.1), params::number_of_iterations(2).feature_angle(45));
  EXPECT_TRUE(checks::is_identical(shapes::soup(mesh), shapes::soup(other)));
}

// Visitors

/// Counts the calls and stops after some kernels.
struct Stopping_visitor : SMA::Adaptation_visitor
{
  std::size_t kernels = 0, rounds_begun = 0, rounds_done = 0, stop_after = 1000;

  void round_begins(std::size_t round, std::size_t) { EXPECT_EQ(round, rounds_begun++); }
  void kernel_done(const SMA::Kernel_report& k)
  {
    const std::set<std::string> names = {"refine", "simplify", "swap", "regularize", "relocate"};
    EXPECT_EQ(names.count(k.kernel), 1u) << k.kernel;
    EXPECT_EQ(k.round + 1, rounds_begun);
    EXPECT_EQ(rounds_done, k.round);
    EXPECT_LE(k.applied, k.candidates);
    ++kernels;
  }
  void round_done(std::size_t, const SMA::Mesh_statistics&) { ++rounds_done; }
  bool go_on() { return kernels < stop_after; }
};

/// Each kernel has one row for each round, but for regularization, which not all rounds need.
void expect_a_row_for_each_kernel_and_round(const SMA::Adaptation_report& report)
{
  std::map<std::string, std::set<std::size_t>> rounds;
  for (const SMA::Kernel_report& k : report.kernels) EXPECT_TRUE(rounds[k.kernel].insert(k.round).second) << k.kernel;
  EXPECT_EQ(rounds.size(), 5u);
  rounds.erase("regularize");
  for (const auto& [kernel, of_kernel] : rounds) EXPECT_EQ(of_kernel.size(), report.rounds) << kernel;
}

TEST(Visitor, follows_the_run)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(3));
  Stopping_visitor visitor;
  const auto report = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.1), params::visitor(std::ref(visitor)));
  EXPECT_EQ(visitor.rounds_begun, report.rounds);
  EXPECT_EQ(visitor.rounds_done, report.rounds);
  EXPECT_GE(visitor.kernels, 4 * report.rounds);
  expect_a_row_for_each_kernel_and_round(report);
}

TEST(Visitor, follows_the_rounds_that_meet_a_number_of_vertices)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::torus(24, 12, 0.3));
  SMA::Curvature_metric_field field(1);
  field.vertices = 100; // needs corrections
  Stopping_visitor visitor;
  const auto report = SMA::adapt_surface_mesh(mesh, field, params::visitor(std::ref(visitor)));
  EXPECT_EQ(visitor.rounds_done, report.rounds);
  expect_a_row_for_each_kernel_and_round(report);
}

/// Takes longer than tasks go on without asking: what follows asks again.
struct Late_visitor : Stopping_visitor
{
  void kernel_done(const SMA::Kernel_report& k)
  {
    Stopping_visitor::kernel_done(k);
    if (!go_on()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
};

TEST(Visitor, that_stops_leaves_a_valid_mesh)
{
  for (std::size_t kernels = 1; kernels < 10; ++kernels) {
    const Soup before = shapes::torus(24, 12, 0.2);
    Mesh mesh = shapes::mesh<Mesh>(before);
    Late_visitor visitor;
    visitor.stop_after = kernels;
    const auto report =
      SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.05),
                              params::visitor(std::ref(visitor)).count_self_intersections(true));
    EXPECT_TRUE(report.stopped);
    EXPECT_EQ(visitor.kernels, kernels);
    EXPECT_FALSE(mesh.has_garbage());
    ASSERT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
    ASSERT_TRUE(checks::is_manifold(shapes::soup(mesh)));
    EXPECT_EQ(checks::topology(shapes::soup(mesh)), checks::topology(before));
    EXPECT_EQ(report.final.vertices, num_vertices(mesh));
    EXPECT_TRUE(report.self_intersections.are_counted);
  }
}

TEST(Visitor, that_throws_leaves_the_mesh_as_it_was)
{
  struct Throwing_visitor : SMA::Adaptation_visitor
  {
    void round_done(std::size_t, const SMA::Mesh_statistics&) { throw std::logic_error("enough"); }
  };
  Mesh mesh = shapes::mesh<Mesh>(shapes::torus(24, 12, 0.2));
  expect_refusal<std::logic_error>(mesh, [](Mesh& m) {
    SMA::adapt_surface_mesh(m, SMA::Uniform_metric_field(0.05), params::visitor(Throwing_visitor()));
  });
}

// Bad but valid geometry

void expect_survival(const Soup& before, double size)
{
  Mesh mesh = shapes::mesh<Mesh>(before);
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size));
  const Soup after = shapes::soup(mesh);
  ASSERT_TRUE(checks::is_manifold(after));
  EXPECT_EQ(checks::topology(after), checks::topology(before));
}

TEST(Geometry, with_degenerate_faces_survives)
{
  const Soup whole = shapes::sphere(2);
  for (const double size : {1.0, 0.4, 0.1}) {
    Soup collinear = whole, equal = whole, needle = whole;
    const shapes::Triangle &t = whole.triangles[10], &u = whole.triangles[200];
    collinear.points[t[0]] = (whole.points[t[1]] + whole.points[t[2]]) / 2;
    expect_survival(collinear, size);
    equal.points[t[0]] = whole.points[t[1]];
    equal.points[u[0]] = equal.points[u[2]];
    expect_survival(equal, size);
    needle.points[t[0]] = whole.points[t[1]] + 1e-13 * (whole.points[t[2]] - whole.points[t[1]]);
    expect_survival(needle, size);
  }
}

TEST(Geometry, that_collapses_to_a_line_survives)
{
  Soup line = shapes::sphere(1);
  for (Vector_3& p : line.points) p = Vector_3(p[0], 0, 0);
  for (const double size : {1.0, 0.1}) expect_survival(line, size);
}

TEST(Geometry, whose_extent_cannot_be_squared_or_is_zero_is_refused)
{
  for (const double scale : {0.0, 1e-315, 1e-120, 1e120, 1e300}) {
    SCOPED_TRACE(scale);
    Soup soup = shapes::sphere(1);
    for (Vector_3& p : soup.points) p *= scale;
    Mesh mesh = shapes::mesh<Mesh>(soup);
    const auto error = expect_refusal<SMA::Invalid_extent_error>(
      mesh, [](Mesh& m) { SMA::adapt_surface_mesh(m, SMA::Uniform_metric_field(0.1)); });
    EXPECT_NEAR(error.extent(), 2 * scale, 1.5 * scale);
  }
}

TEST(Geometry, that_intersects_itself_survives)
{
  Soup crossing = shapes::sphere(2);
  Soup other = shapes::torus(20, 10);
  for (Vector_3& p : other.points) p[0] += 0.7;
  shapes::append(crossing, other);
  expect_survival(crossing, 0.1);

  Soup tangled = shapes::sphere(2);
  shapes::Random random(3);
  for (Vector_3& p : tangled.points) p = random.vector();
  for (const double size : {1.0, 0.3, 0.1}) expect_survival(tangled, size);
}

TEST(Geometry, of_any_magnitude_survives)
{
  for (const double scale : {1e-30, 1e-9, 1e9, 1e30}) {
    SCOPED_TRACE(scale);
    const Soup unit = shapes::torus(24, 12, 0.2);
    Soup scaled = unit;
    for (Vector_3& p : scaled.points) p *= scale;
    Mesh mesh = shapes::mesh<Mesh>(scaled);
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.08 * scale));
    const Soup after = shapes::soup(mesh);
    ASSERT_TRUE(checks::is_manifold(after));
    EXPECT_EQ(checks::topology(after), checks::topology(unit));
    EXPECT_GT(checks::mean_quality(after), 0.95);
  }
}

// Constraints and property maps

TEST(Constraints, vertices_stay_where_they_are_and_are_marked_again)
{
  const Soup before = shapes::sphere(3, 0.2);
  Mesh mesh = shapes::mesh<Mesh>(before);
  const auto is_fixed = mesh.add_property_map<Vertex, bool>("v:fixed", false).first;
  std::vector<Point> fixed;
  for (const Index v : {3u, 100u, 101u, 641u}) {
    is_fixed[Vertex(v)] = true;
    fixed.push_back(mesh.point(Vertex(v)));
  }
  for (const double size : {0.05, 0.5}) { // the second time all others are removed
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size), params::vertex_is_constrained_map(is_fixed));
    std::vector<Point> marked;
    for (const auto v : vertices(mesh))
      if (is_fixed[v]) marked.push_back(mesh.point(v));
    EXPECT_TRUE(std::is_permutation(marked.begin(), marked.end(), fixed.begin(), fixed.end()));
  }
}

/// The equator of a sphere of which it is a chain of edges.
template <class TriangleMesh, class Map>
double mark_equator(const TriangleMesh& mesh, const Map& map)
{
  const auto point = get(CGAL::vertex_point, mesh);
  double length = 0;
  for (const auto e : edges(mesh)) {
    const auto p = get(point, source(e, mesh)), q = get(point, target(e, mesh));
    if (std::abs(p.z()) + std::abs(q.z()) > 1e-9) continue;
    put(map, e, true);
    length += std::sqrt(CGAL::squared_distance(p, q));
  }
  return length;
}

TEST(Constraints, edges_are_followed_and_marked_again)
{
  Soup before = shapes::octahedron();
  for (int i = 0; i < 3; ++i) {
    before = shapes::subdivided(before);
    for (Vector_3& p : before.points) p.normalize();
  }
  Mesh mesh = shapes::mesh<Mesh>(before);
  const auto is_marked = mesh.add_property_map<Edge, bool>("e:marked", false).first;
  mark_equator(mesh, is_marked);
  for (const double size : {0.07, 0.3}) {
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size), params::edge_is_constrained_map(is_marked));
    std::size_t marked = 0;
    double length = 0;
    for (const auto e : edges(mesh)) {
      if (!is_marked[e]) continue;
      ++marked;
      const auto p = mesh.point(source(e, mesh)), q = mesh.point(target(e, mesh));
      EXPECT_NEAR(std::abs(p.z()) + std::abs(q.z()), 0, 1e-3); // the curve lies in its plane
      length += std::sqrt(CGAL::squared_distance(p, q));
    }
    EXPECT_NEAR(length, 2 * shapes::pi, 0.1);
    const double mean_length = length / double(marked) / size;
    EXPECT_GT(mean_length, std::sqrt(0.5));
    EXPECT_LT(mean_length, std::sqrt(2.0));
  }
}

TEST(Constraints, read_only_maps_are_enough)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  const auto none = CGAL::Static_boolean_property_map<Edge, false>();
  const auto all = CGAL::Static_boolean_property_map<Vertex, true>();
  const Soup before = shapes::soup(mesh);
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.5),
                          params::edge_is_constrained_map(none).vertex_is_constrained_map(all));
  EXPECT_EQ(num_vertices(mesh), before.points.size());
  EXPECT_NEAR(checks::area(shapes::soup(mesh)), checks::area(before), 1e-12);
}

TEST(Property_maps, of_the_user_survive)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  mesh.add_property_map<Vertex, std::string>("v:name", "none");
  mesh.add_property_map<Mesh::Face_index, int>("f:material", 7);
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.1));
  const auto name = mesh.add_property_map<Vertex, std::string>("v:name", "lost"); // the one that there is
  const auto material = mesh.add_property_map<Mesh::Face_index, int>("f:material", 0);
  EXPECT_FALSE(name.second);
  EXPECT_FALSE(material.second);
  for (const auto v : vertices(mesh)) EXPECT_EQ(name.first[v], "none");
  for (const auto f : faces(mesh)) EXPECT_EQ(material.first[f], 7);
}

TEST(Property_maps, other_points_than_those_of_the_mesh_are_adapted)
{
  const Soup sphere = shapes::sphere(2);
  Mesh mesh = shapes::mesh<Mesh>(sphere);
  const auto points = mesh.add_property_map<Vertex, Point>("v:other").first;
  for (const auto v : vertices(mesh)) {
    points[v] = mesh.point(v);
    mesh.point(v) = Point(0, 0, 0);
  }
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.1), params::vertex_point_map(points));
  EXPECT_GT(num_vertices(mesh), 1000u);
  for (const auto v : vertices(mesh))
    EXPECT_NEAR(std::sqrt(CGAL::squared_distance(points[v], Point(0, 0, 0))), 1, 1e-2);
}

TEST(Report, is_one_json_object)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
  std::ostringstream json;
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.1)).write_json(json);
  const std::string text = json.str();
  EXPECT_EQ(text.front(), '{');
  EXPECT_EQ(text.find_last_not_of('\n'), text.rfind('}'));
  for (const auto& brackets : {std::make_pair('{', '}'), std::make_pair('[', ']')})
    EXPECT_EQ(std::count(text.begin(), text.end(), brackets.first),
              std::count(text.begin(), text.end(), brackets.second));
  EXPECT_NE(text.find("\"vertices\": " + std::to_string(num_vertices(mesh))), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

} // namespace test_adapt_inputs

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs end, for any mesh and metric: what asks for too much is refused, what runs away is stopped, users may stop it at
// any time, and what was not reached is said.

#include "checks.h"
#include "random_meshes.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/execution/Any_execution.h>
#include <CGAL/Surface_mesh_adaptation/metric_fields.h>
#include <CGAL/Surface_mesh_adaptation/refine.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <thread>

namespace test_limits {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;
using random_meshes::Random;
using shapes::Soup;
using shapes::Vector_3;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

Soup triangle_of(const Vector_3& a, const Vector_3& b, const Vector_3& c)
{
  Soup soup;
  soup.points = {a, b, c};
  soup.triangles = {{0, 1, 2}};
  return soup;
}

bool says(const SMA::Adaptation_report& report, const std::string& what)
{
  for (const std::string& warning : report.warnings)
    if (warning.find(what) != std::string::npos) return true;
  return false;
}

/// Expects that `adapt` is refused for asking for about `vertices`, of which `largest` are possible, with nothing changed.
template <class Adapt>
void expect_refusal(Mesh& mesh, double vertices, std::size_t largest, const Adapt& adapt)
{
  const Soup before = shapes::soup(mesh);
  try {
    adapt();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const SMA::Mesh_too_large_error& e) {
    EXPECT_NEAR(e.estimate().vertices / vertices, 1, 0.2);
    EXPECT_EQ(e.estimate().largest, largest);
  }
  EXPECT_TRUE(checks::is_identical(shapes::soup(mesh), before));
}

TEST(Limits, sizes_beyond_what_can_be_held_are_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::cube(1));
  const double area = checks::area(shapes::soup(mesh)), size = 1e-9;
  const std::size_t largest = SMA::largest_number_of_vertices(std::size_t(-1));
  expect_refusal(mesh, 2 / std::sqrt(3.0) * area / (size * size), largest,
                 [&] { SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size)); });
  expect_refusal(mesh, 2 / std::sqrt(3.0) * area / (size * size), largest,
                 [&] { SMA::refine(mesh, SMA::Uniform_metric_field(size)); });
}

TEST(Limits, the_user_may_set_a_lower_one)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(3));
  const double area = checks::area(shapes::soup(mesh)), size = 0.02;
  expect_refusal(mesh, 2 / std::sqrt(3.0) * area / (size * size), 10000, [&] {
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size), params::maximum_number_of_vertices(10000));
  });
  const auto report =
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.05), params::maximum_number_of_vertices(10000));
  EXPECT_GT(report.final.in_range, 0.97);
}

TEST(Limits, a_small_size_in_one_place_is_not_refused)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::square(1));
  const auto field = SMA::Analytic_metric_field([](const Vector_3& p) { return 1e-4 + 0.3 * p.norm(); });
  const auto report = SMA::adapt_surface_mesh(mesh, field, params::maximum_number_of_vertices(100000));
  EXPECT_GT(report.final.in_range, 0.95);
  EXPECT_LT(report.final.vertices, 5000u);
}

TEST(Limits, refinement_stops_before_there_are_more_vertices_than_allowed)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::square(1)); // between its corners the metric asks for more than at these
  const auto field = SMA::Analytic_metric_field([](const Vector_3& p) {
    return std::abs(p[0] - 0.4321) < 0.01 ? 1e-4 : 0.02;
  });
  const auto report = SMA::adapt_surface_mesh(mesh, field, params::maximum_number_of_vertices(5000));
  EXPECT_LE(mesh.number_of_vertices(), 5000u);
  EXPECT_TRUE(checks::is_manifold(shapes::soup(mesh)));
  EXPECT_TRUE(says(report, "refinement was stopped"));
}

TEST(Limits, needles_do_not_run_away)
{
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Soup soup = shapes::capped_cylinder(30 + random.below(40), 1, random.uniform(3, 30));
    for (Vector_3& p : soup.points) {
      const Vector_3 noise = random.vector();
      p += Vector_3(0.05 * noise[0], 0.05 * noise[1], 1.5 * noise[2]);
    }
    Mesh isotropic = shapes::mesh<Mesh>(soup), anisotropic = isotropic;
    SMA::Curvature_metric_field field(0.002);
    SMA::adapt_surface_mesh(isotropic, field);
    field.anisotropic = true;
    SMA::adapt_surface_mesh(anisotropic, field);
    EXPECT_LT(anisotropic.number_of_vertices(), 8 * isotropic.number_of_vertices()); // thousands of times without end
    EXPECT_TRUE(checks::is_manifold(shapes::soup(anisotropic)));
  }
}

/// Lets a run go on for some time.
struct Timed_visitor : SMA::Adaptation_visitor
{
  std::chrono::steady_clock::time_point end;
  std::size_t kernels_done = 0;

  explicit Timed_visitor(double seconds)
    : end(std::chrono::steady_clock::now() + std::chrono::microseconds(long(1e6 * seconds)))
  {}
  void kernel_done(const SMA::Kernel_report&) { ++kernels_done; }
  bool go_on() const { return std::chrono::steady_clock::now() < end; }
};

TEST(Interruption, a_run_that_is_stopped_at_any_time_leaves_a_valid_mesh)
{
  const Soup input = shapes::sphere(4, 0.3);
  for (const double seconds : {0.0, 0.06, 0.3}) {
    SCOPED_TRACE(seconds);
    Mesh mesh = shapes::mesh<Mesh>(input);
    Timed_visitor visitor(seconds);
    const auto report =
      SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.002), params::visitor(std::ref(visitor)));
    EXPECT_TRUE(report.stopped);
    EXPECT_LT(report.final.vertices, 3000000u); // it would have been 3.6 million
    const Soup result = shapes::soup(mesh);
    EXPECT_TRUE(checks::is_manifold(result));
    EXPECT_TRUE(checks::topology(result) == checks::topology(input));
  }
}

TEST(Interruption, is_asked_for_while_tasks_run)
{
  using SMA::internal::Interruption;
  std::size_t asked = 0;
  const auto execution = SMA::internal::Any_execution(SMA::Sequential_execution()).interruptible([&] {
    ++asked;
    return false;
  });
  const auto sleep = [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(60)); };
  std::size_t done = 0;
  const auto run = [&] {
    execution.run(4, [&](std::size_t i) {
      sleep(i);
      ++done;
    });
  };
  {
    const SMA::internal::Effect_of_interruption none(execution.interruption(), Interruption::Effect::none);
    run();
    EXPECT_EQ(asked, 0u);
    EXPECT_FALSE(is_stopped(execution));
  }
  {
    const SMA::internal::Effect_of_interruption leave_out(execution.interruption(), Interruption::Effect::leave_out);
    run();
    EXPECT_EQ(asked, 1u);
    EXPECT_TRUE(is_stopped(execution));
    EXPECT_EQ(done, 8u);
  }
  EXPECT_THROW(run(), SMA::internal::Interrupted);
  EXPECT_EQ(done, 8u);
}

template <class Reconstruction>
void expect_adapted(const Soup& soup, double size)
{
  Mesh mesh = shapes::mesh<Mesh>(soup);
  const auto report = SMA::adapt_surface_mesh(
    mesh, SMA::Uniform_metric_field(size), params::detect_features(false).surface_reconstruction(Reconstruction()));
  EXPECT_GT(report.final.in_range, 0.8);
  EXPECT_GT(report.final.mean_quality, 0.9);
  EXPECT_TRUE(checks::is_manifold(shapes::soup(mesh)));
}

TEST(Nothing_done, faces_off_the_normals_are_adapted_without_features)
{
  for (const Soup& soup : {shapes::cube(1), shapes::cube(2), shapes::tetrahedron(), shapes::octahedron(),
                           shapes::capped_cylinder(3, 1, 1), shapes::capped_cylinder(4, 1, 0.3)}) {
    expect_adapted<SMA::Gregory_reconstruction>(soup, 0.1);
    expect_adapted<SMA::Flat_reconstruction>(soup, 0.1);
  }
}

TEST(Nothing_done, numbers_of_vertices_are_met_where_the_curvature_says_nothing)
{
  for (const Soup& soup : {shapes::cube(1), shapes::cube(2), shapes::square(1), shapes::square(7, 0.3),
                           triangle_of({0, 0, 0}, {1, 0, 0}, {0.2, 3, 0})})
    for (const std::size_t number : {60, 1043, 4000})
      for (const bool is_anisotropic : {false, true}) {
        SCOPED_TRACE(number);
        Mesh mesh = shapes::mesh<Mesh>(soup);
        SMA::Curvature_metric_field field(0.001);
        field.vertices = number;
        field.anisotropic = is_anisotropic;
        const auto report = SMA::adapt_surface_mesh(mesh, field);
        EXPECT_NEAR(double(mesh.number_of_vertices()), double(number), 0.1 * double(number));
        EXPECT_TRUE(report.warnings.empty());
      }
}

TEST(Warnings, say_that_a_number_of_vertices_was_missed)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(3));
  auto is_constrained = mesh.add_property_map<Mesh::Vertex_index, bool>("v:constrained", true).first;
  SMA::Curvature_metric_field field(0.001);
  field.vertices = 100;
  const auto report = SMA::adapt_surface_mesh(mesh, field, params::vertex_is_constrained_map(is_constrained));
  EXPECT_TRUE(says(report, "642 vertices where 100 were asked for"));
  EXPECT_TRUE(says(report, "of the edges have the length asked for"));
}

TEST(Warnings, are_none_on_what_works)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(3));
  EXPECT_TRUE(SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.1)).warnings.empty());
}

TEST(Slivers, whose_third_edge_is_the_boundary_are_folds_without_a_face_behind_that)
{
  Soup soup; // the second face turns away from its neighbours
  soup.points = {{-3.98827, 3.5133, -1.01165}, {-4.17235, 3.40475, -0.589762}, {-3.75798, 3.83341, -0.875062},
                 {-3.96703, 3.6174, -0.733977}, {-3.80666, 3.85186, -0.730796}};
  soup.triangles = {{1, 0, 2}, {3, 1, 2}, {4, 3, 2}};
  Mesh mesh = shapes::mesh<Mesh>(soup);
  const auto report = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.25));
  EXPECT_TRUE(checks::topology(shapes::soup(mesh)) == checks::topology(soup));
  EXPECT_GT(report.final.in_range, 0.8);
}

TEST(Slivers, at_a_boundary_are_adapted)
{
  // three faces of a strip, of which the middle one is folded over at two edges; its third one is the boundary
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Soup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0.5, random.uniform(-0.01, 0.01), 0}, {0.2, 1, 0}, {0.8, 1, 0}};
    for (Vector_3& p : soup.points) p += random.magnitude(1e-4, 0.3) * random.vector();
    soup.triangles = {{0, 1, 2}, {1, 4, 2}, {0, 2, 3}};
    Mesh mesh = shapes::mesh<Mesh>(soup);
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.25));
    EXPECT_TRUE(checks::topology(shapes::soup(mesh)) == checks::topology(soup));
  }
}

TEST(Tolerance, is_certified_for_slivers_far_from_the_origin)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Soup soup = random_meshes::with_holes(random, shapes::square(6, 0.3));
    random_meshes::split_edges(random, soup);
    for (Vector_3& p : soup.points) p = p + Vector_3(5e5, 3e5, -4e5) + 1e-3 * random.vector();
    Mesh mesh = shapes::mesh<Mesh>(soup);
    try {
      const auto report = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.1), params::tolerance(1e-3));
      EXPECT_LE(report.certified_distance, 1e-3);
    } catch (const SMA::Tolerance_error& e) {
      EXPECT_GT(e.distance(), 1e-3);
    }
  }
}

} // namespace test_limits

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tolerance of sizes from the curvature: bounds of sizes around places, distances of faces, and what comes of them.

#include "analytic_surfaces.h"
#include "brute_force_intersections.h"
#include "checks.h"
#include "decimated_meshes.h"
#include "distances.h"
#include "near_sheets.h"
#include "policies.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/distance/Face_deviations.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/fields/Graded_bounds.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Refinement.h>

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace test_deviation {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;
using analytic::Ellipsoid;
using analytic::Graph;
using analytic::Sphere;
using analytic::Torus;
using distances::Mesh;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using Bounds = SMA::Graded_bounds;
using Reference = SMA::Reference_surface<SMA::Flat_reconstruction>;
using Surface = SMA::Adapted_surface<SMA::Isotropic_metric, SMA::Flat_reconstruction>;

const SMA::Sequential_execution sequential;

// Bounds

std::vector<Bounds::Source> random_sources(std::size_t n)
{
  Random random(5);
  std::vector<Bounds::Source> sources;
  for (std::size_t i = 0; i < n; ++i) sources.push_back({random.vector(), random.real(0.1, 2), random.real(0.2, 0.6)});
  return sources;
}

double least_of_all(const std::vector<Bounds::Source>& sources, const Vector_3& p, double limit)
{
  for (const Bounds::Source& s : sources) limit = (std::min)(limit, s.value + s.slope * (s.point - p).norm());
  return limit;
}

TEST(Graded_bounds, are_the_least_of_all_sources)
{
  for (const std::size_t n : {0, 1, 7, 8, 9, 65, 300, 5000}) {
    const std::vector<Bounds::Source> sources = random_sources(n);
    const Bounds bounds(sequential, sources);
    Random random(6);
    for (int i = 0; i < 200; ++i) {
      const Vector_3 p = 1.5 * random.vector();
      for (const double limit : {0.05, 0.3, 1.0, 10.0})
        EXPECT_DOUBLE_EQ(bounds.least(p, limit), least_of_all(sources, p, limit)) << n;
    }
  }
}

TEST(Graded_bounds, forget_sources_that_others_bound)
{
  const Bounds bounds(sequential, {{Vector_3(0, 0, 0), 1, 0.5}, {Vector_3(1, 0, 0), 1.6, 0.5}, {Vector_3(2, 0, 0), 1.9, 0.5}});
  ASSERT_EQ(bounds.sources().size(), 2u); // at (1, 0, 0) the first one asks for 1.5
  EXPECT_EQ(bounds.least(Vector_3(2, 0, 0), 10), 1.9);
  EXPECT_TRUE(Bounds().empty());
}

/// A mesh on the triangles of `soup`, as it is before anything is done to it.
struct On_triangles
{
  explicit On_triangles(const Soup& soup)
    : reference(sequential, shapes::view(soup), soup.points, SMA::Feature_parameters()), background(1.0)
    , surface(sequential, reference, background)
  {}

  Reference reference;
  SMA::Metric_background<SMA::Isotropic_metric> background;
  Surface surface;
};

/// Only vertices near what is new are looked at.
TEST(Graded_bounds, that_are_tightened_change_the_metrics_of_all_vertices_that_they_concern)
{
  On_triangles sphere(shapes::sphere(3, 0.3));
  Surface& surface = sphere.surface;
  Random random(9);
  for (int step = 0; step < 4; ++step) {
    std::vector<double> factors(surface.points.size(), 1);
    for (int i = 0; i < 12; ++i) factors[random.below(factors.size())] = random.real(0.4, 0.9);
    const auto before = surface.metrics;
    const auto is_changed = surface.tighten_metric(sequential, factors, {0.01, 0, 1.3});
    const auto after = surface.metrics;
    surface.limit_sizes(sequential, surface.limits()); // of all vertices
    for (SMA::Index v = 0; v < surface.points.size(); ++v) {
      EXPECT_EQ(after[v].inverse_size, surface.metrics[v].inverse_size) << v;
      EXPECT_EQ(is_changed[v] != 0, after[v].inverse_size != before[v].inverse_size) << v;
    }
  }
}

// Splits of a part

std::vector<Vector_3> sorted_points(const Surface& surface)
{
  std::vector<Vector_3> points(surface.points.begin(), surface.points.end());
  std::sort(points.begin(), points.end(), [](const Vector_3& p, const Vector_3& q) {
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  return points;
}

/// Asks for edges of half of the length at a few places, and lets kernels look at these and their neighbours alone.
void tighten_some_places(Surface& surface)
{
  Random random(10);
  std::vector<double> factors(surface.points.size(), 1);
  for (int i = 0; i < 3; ++i) factors[random.below(factors.size())] = 0.02;
  const auto is_changed = surface.tighten_metric(sequential, factors, {0.01, 0, 1.3});
  std::fill(surface.active.begin(), surface.active.end(), std::uint8_t(0));
  for (SMA::Index v = 0; v < is_changed.size(); ++v) {
    if (is_changed[v] == 0) continue;
    SMA::activate(surface, v);
    surface.mesh.for_each_neighbor(v, [&](SMA::Index w) { SMA::activate(surface, w); });
  }
}

std::size_t split_all(Surface& surface, bool is_local)
{
  SMA::Refinement refinement(sequential, surface);
  refinement.work_locally(is_local);
  SMA::Sweep_counts counts;
  while (refinement.sweep(0, counts) > 0) {}
  return counts.applied;
}

TEST(Refinement, that_works_locally_splits_what_one_of_everything_does)
{
  On_triangles everywhere(shapes::sphere(4, 0.3)), here(shapes::sphere(4, 0.3));
  for (On_triangles* sphere : {&everywhere, &here}) tighten_some_places(sphere->surface);
  const std::size_t split = split_all(everywhere.surface, false);
  EXPECT_GT(split, 50u);
  EXPECT_EQ(split_all(here.surface, true), split);
  EXPECT_TRUE(checks::is_valid(here.surface.mesh));
  EXPECT_EQ(sorted_points(here.surface), sorted_points(everywhere.surface));
}

TEST(Refinement, that_works_locally_does_not_look_where_nothing_has_changed)
{
  On_triangles sphere(shapes::sphere(4, 0.3));
  Surface& surface = sphere.surface;
  tighten_some_places(surface);
  std::fill(surface.active.begin(), surface.active.end(), std::uint8_t(0));
  EXPECT_EQ(split_all(surface, true), 0u);
  EXPECT_GT(split_all(surface, false), 50u);
}

// Distances of faces

TEST(Face_deviations, see_faces_above_the_surface_and_vertices_of_the_input_below)
{
  On_triangles flat(shapes::square(6));
  Surface& surface = flat.surface;
  SMA::Face_deviations<Surface> deviations(sequential, surface, 0.01);
  deviations.update(sequential);
  EXPECT_LT(deviations.largest(sequential), 1e-12);
  const SMA::Index v = 24; // inside
  ASSERT_EQ(surface.vertex_class(v), SMA::Vertex_class::smooth);
  surface.points[v][2] += 0.05;
  deviations.update(sequential);
  EXPECT_GT(deviations.largest(sequential), 0.02);
  for (const SMA::Index f : surface.faces_around(v)) EXPECT_GT(deviations[f], 0.01) << f;
  std::size_t above = 0;
  for (SMA::Index f = 0; f < surface.mesh.number_of_faces(); ++f) above += deviations[f] > deviations.allowed() ? 1 : 0;
  EXPECT_EQ(deviations.number_above(sequential), above);
  EXPECT_GT(deviations.nth_largest(0), deviations.nth_largest(surface.mesh.number_of_faces() - 1));
  EXPECT_EQ(deviations.nth_largest(surface.mesh.number_of_faces()), 0);
}

TEST(Face_deviations, of_what_changed_are_those_of_all)
{
  On_triangles sphere(shapes::sphere(3, 0.3));
  Surface& surface = sphere.surface;
  SMA::Face_deviations<Surface> twice(sequential, surface, 0.01);
  twice.update(sequential);
  Random random(8);
  for (SMA::Index v = 0; v < surface.points.size(); v += 9) surface.points[v] *= random.real(0.9, 1.1);
  twice.update(sequential);
  SMA::Face_deviations<Surface> once(sequential, surface, 0.01);
  once.update(sequential);
  for (SMA::Index f = 0; f < surface.mesh.number_of_faces(); ++f) EXPECT_GE(twice[f], once[f] - 1e-9) << f;
  EXPECT_NEAR(twice.largest(sequential), once.largest(sequential), 1e-9);
}

TEST(Face_keys, find_faces_under_other_numbers)
{
  Soup soup = shapes::sphere(2, 0.3);
  const SMA::Face_keys before(sequential, shapes::view(soup), soup.points);
  std::reverse(soup.triangles.begin(), soup.triangles.end());
  soup.points[0] *= 1.1;
  const SMA::Face_keys after(sequential, shapes::view(soup), soup.points);
  const SMA::Index n = SMA::Index(soup.triangles.size());
  for (SMA::Index f = 0; f < n; ++f) {
    const auto& t = soup.triangles[f];
    const bool is_changed = std::find(t.begin(), t.end(), 0u) != t.end();
    EXPECT_EQ(before.face(after[f]), is_changed ? SMA::no_index : n - 1 - f) << f;
  }
  EXPECT_EQ(SMA::Face_keys().face(after[0]), SMA::no_index);
}

double diagonal(const Mesh& mesh)
{
  return distances::Original(mesh).diagonal();
}

/// A bound of the Hausdorff distance between two meshes, by at most 2 % of `unit` too large.
double distance_between(const Mesh& a, const Mesh& b, double unit)
{
  const Soup of_a = shapes::soup(a), of_b = shapes::soup(b);
  return SMA::hausdorff_distance_bound(sequential, SMA::Triangle_tree(sequential, shapes::view(of_a), of_a.points),
                                       SMA::Triangle_tree(sequential, shapes::view(of_b), of_b.points), 0.02 * unit);
}

/// Few triangles with bends of all angles between them.
Mesh crumpled_sphere(Random& random)
{
  Soup soup = shapes::sphere(int(random.below(3)), 0.3);
  const double noise = random.real(0.02, 0.3);
  for (Vector_3& p : soup.points) p *= 1 + random.real(-noise, noise);
  return shapes::mesh<Mesh>(soup);
}

/// A crumpled sphere and sizes with a tolerance, which every other one is too coarse for.
struct Crumpled_case
{
  Crumpled_case(Random& random, int i, double largest_tolerance)
    : input(crumpled_sphere(random)), field(random.real(0.002, largest_tolerance))
    , asked(field.relative_tolerance * diagonal(input))
  {
    if (i % 2 != 0) field.hmin = 5 * asked;
  }

  Mesh input;
  SMA::Curvature_metric_field field;
  double asked; // the distance
};

/// Where the triangles are the surface. Nothing is said of distances below nine tenths of what was asked.
TEST(Face_deviations, on_triangles_are_the_hausdorff_distance)
{
  Random random(23);
  for (int i = 0; i < 20; ++i) {
    Crumpled_case c(random, i, 0.02);
    c.field.anisotropic = i % 3 == 0;
    Mesh mesh = c.input;
    const auto flat = params::surface_reconstruction(SMA::Flat_reconstruction());
    const double deviation = SMA::adapt_surface_mesh(sequential, mesh, c.field, flat).deviation;
    const double distance = distance_between(c.input, mesh, c.asked);
    EXPECT_LE(distance, (std::max)(1.06 * deviation, 0.98 * c.asked)) << i;
    EXPECT_LE(deviation, 1.2 * (std::max)(distance, 0.9 * c.asked)) << i;
  }
}

/// The largest distance of many points of the patches of `input` from `mesh`.
double distance_of_patches(const Mesh& input, const Mesh& mesh)
{
  const Soup of_input = shapes::soup(input), of_mesh = shapes::soup(mesh);
  const SMA::Reference_surface<SMA::Gregory_reconstruction> reference(sequential, shapes::view(of_input), of_input.points,
                                                                      SMA::Feature_parameters());
  const SMA::Triangle_tree tree(sequential, shapes::view(of_mesh), of_mesh.points);
  const int n = 40;
  double largest = 0;
  for (SMA::Index f = 0; f < of_input.triangles.size(); ++f)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vector_3 p = reference.evaluate({SMA::Vertex_class::smooth, f, double(i) / n, double(j) / n}).position;
        largest = (std::max)(largest, tree.nearest(p).squared_distance);
      }
  return std::sqrt(largest);
}

bool has_late_creases(const SMA::Adaptation_report& report)
{
  return std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& warning) {
    return warning.find("are ridges besides") != std::string::npos;
  });
}

/// But for late creases, which make another surface.
TEST(Face_deviations, on_patches_tell_their_distance)
{
  Random random(24);
  int compared = 0;
  for (int i = 0; i < 12; ++i) {
    const Crumpled_case c(random, i, 0.01);
    Mesh mesh = c.input;
    const SMA::Adaptation_report report = SMA::adapt_surface_mesh(sequential, mesh, c.field);
    if (has_late_creases(report)) continue;
    EXPECT_LE(distance_of_patches(c.input, mesh), 1.2 * (std::max)(report.deviation, 0.9 * c.asked)) << i;
    ++compared;
  }
  EXPECT_GE(compared, 10);
}

// The tolerance

/// What the field alone makes of the mesh: an intersection of one has the same sizes, and no tolerance.
SMA::Intersection_metric_field<SMA::Curvature_metric_field> without_tolerance(const SMA::Curvature_metric_field& field)
{
  SMA::Intersection_metric_field<SMA::Curvature_metric_field> result(field);
  result.gradation = SMA::default_gradation_of_isotropic_curvature;
  return result;
}

/// The largest distance of 200 000 points of the faces from the surface.
template <class Analytic>
double largest_distance(const Mesh& mesh, const Analytic& surface)
{
  double largest = 0;
  distances::for_each_sample(mesh, 200000, [&](const auto& q, double) {
    const Vector_3 p(q.x(), q.y(), q.z());
    largest = (std::max)(largest, (p - surface.closest_point(p)).norm());
  });
  return largest;
}

/// As many vertices as a tolerance may cost: distances are inverse to the number of vertices.
double most_vertices(const Mesh& before, double distance_before, double asked)
{
  return 1.35 * double(before.number_of_vertices()) * (std::max)(1.0, distance_before / asked);
}

/// That few vertices more keep the faces within the tolerance of the surface that a fine mesh is of.
template <class Analytic>
void expect_tolerance(const Analytic& surface, int level, double tolerance, const std::string& name)
{
  const Mesh input = shapes::mesh<Mesh>(surface.coarse_mesh(level));
  const double asked = tolerance * diagonal(input);
  const SMA::Curvature_metric_field field(tolerance);
  Mesh mesh = input, before = input;
  const SMA::Adaptation_report report = SMA::adapt_surface_mesh(sequential, mesh, field);
  EXPECT_EQ(SMA::adapt_surface_mesh(sequential, before, without_tolerance(field)).deviation, 0);
  const double distance = largest_distance(mesh, surface), distance_before = largest_distance(before, surface);
  EXPECT_LE(distance, 1.3 * asked) << name;
  EXPECT_LE(distance, 1.001 * distance_before) << name;
  EXPECT_LE(report.deviation, asked) << name;
  EXPECT_TRUE(report.warnings.empty()) << name << ": " << report.warnings[0];
  EXPECT_LE(double(mesh.number_of_vertices()), most_vertices(before, distance_before, asked)) << name;
  EXPECT_GT(report.final.in_range, 0.95) << name;
}

TEST(Tolerance_of_curvature, holds_on_analytic_surfaces)
{
  for (const double tolerance : {0.005, 0.001}) {
    expect_tolerance(Sphere(), 4, tolerance, "sphere");
    expect_tolerance(Ellipsoid(), 4, tolerance, "ellipsoid");
    expect_tolerance(Torus(), 3, tolerance, "torus");
    expect_tolerance(Graph(), 4, tolerance, "graph");
  }
}

TEST(Tolerance_of_curvature, holds_on_triangles)
{
  for (const Soup& soup : {Sphere().coarse_mesh(4), Torus().coarse_mesh(4), Graph().coarse_mesh(5)}) {
    const Mesh input = shapes::mesh<Mesh>(soup);
    const distances::Original original(input);
    const SMA::Curvature_metric_field field(0.004);
    Mesh mesh = input, before = input;
    const auto flat = params::surface_reconstruction(SMA::Flat_reconstruction());
    SMA::adapt_surface_mesh(sequential, mesh, field, flat);
    SMA::adapt_surface_mesh(sequential, before, without_tolerance(field), flat);
    EXPECT_LE(original.distance_to(mesh, 200000).largest, 0.004 * original.diagonal());
    EXPECT_LE(double(mesh.number_of_vertices()), 1.35 * double(before.number_of_vertices()));
  }
}

TEST(Tolerance_of_curvature, is_nearer_in_an_anisotropic_metric_too)
{
  const Torus torus;
  const Mesh input = shapes::mesh<Mesh>(torus.coarse_mesh(3));
  SMA::Curvature_metric_field field(0.002);
  field.anisotropic = true;
  SMA::Intersection_metric_field<SMA::Curvature_metric_field> sizes(field);
  Mesh mesh = input, before = input;
  SMA::adapt_surface_mesh(sequential, mesh, field);
  SMA::adapt_surface_mesh(sequential, before, sizes);
  const double distance_before = largest_distance(before, torus);
  EXPECT_LT(largest_distance(mesh, torus), 0.9 * distance_before);
  EXPECT_LE(double(mesh.number_of_vertices()), most_vertices(before, distance_before, 0.002 * diagonal(input)));
}

/// Edges fit the tightened metric as well as they fit that which is not tightened.
TEST(Tolerance_of_curvature, costs_no_conformity)
{
  Random random(3);
  const Soup bumpy = near_sheets::bumpy_sphere(random);
  for (const bool anisotropic : {false, true})
    for (const Soup& soup : {Torus().coarse_mesh(3), Ellipsoid().coarse_mesh(4), bumpy}) {
      SMA::Curvature_metric_field field(0.001);
      field.anisotropic = anisotropic;
      const SMA::Intersection_metric_field<SMA::Curvature_metric_field> sizes(field);
      Mesh mesh = shapes::mesh<Mesh>(soup), before = mesh;
      const double without = SMA::adapt_surface_mesh(sequential, before, sizes).final.in_range;
      const SMA::Adaptation_report report = SMA::adapt_surface_mesh(sequential, mesh, field);
      EXPECT_GT(report.final.in_range, without - 0.003) << anisotropic;
    }
}

/// A sphere of few triangles with spikes, whose ridges are taken for noise, or with bends of all angles.
Mesh sharp_sphere(Random& random, int i)
{
  Soup soup = shapes::sphere(1 + i % 2, 0.1);
  if (i % 4 < 2) for (int k = 0; k < 4; ++k) soup.points[random.below(soup.points.size())] *= random.real(1.1, 1.6);
  else for (Vector_3& p : soup.points) p *= random.real(0.8, 1.2);
  return shapes::mesh<Mesh>(soup);
}

/// Returns the report, which is the same with all.
template <class NamedParameters>
SMA::Adaptation_report expect_same_bits(const Mesh& input, const NamedParameters& np)
{
  const SMA::Curvature_metric_field field(0.002);
  Mesh expected_mesh = input;
  const SMA::Adaptation_report report = SMA::adapt_surface_mesh(sequential, expected_mesh, field, np);
  const Soup expected = shapes::soup(expected_mesh);
  for_each_policy([&](const auto& execution, const std::string& name) {
    Mesh mesh = input;
    EXPECT_EQ(SMA::adapt_surface_mesh(execution, mesh, field, np).deviation, report.deviation) << name;
    const Soup soup = shapes::soup(mesh);
    EXPECT_EQ(soup.points, expected.points) << name;
    EXPECT_EQ(soup.triangles, expected.triangles) << name;
  });
  return report;
}

TEST(Tolerance_of_curvature, gives_the_same_bits_with_every_policy)
{
  Random random(44);
  const auto flat = params::surface_reconstruction(SMA::Flat_reconstruction());
  expect_same_bits(shapes::mesh<Mesh>(Torus().coarse_mesh(3)), CGAL::parameters::default_values());
  EXPECT_TRUE(has_late_creases(expect_same_bits(sharp_sphere(random, 0), flat)));
}

TEST(Tolerance_of_curvature, is_said_to_be_missed_where_no_smaller_sizes_are_allowed)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::icosahedron());
  SMA::Curvature_metric_field field(0.001);
  field.hmin = 0.2;
  const auto report = SMA::adapt_surface_mesh(sequential, mesh, field,
                                              params::surface_reconstruction(SMA::Flat_reconstruction()));
  EXPECT_GT(report.deviation, 1.3 * 0.001 * diagonal(shapes::mesh<Mesh>(shapes::icosahedron())));
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_NE(report.warnings[0].find("times the tolerance of the sizes"), std::string::npos) << report.warnings[0];
}

/// Few large triangles say little of the curvature, and bends between them take many small ones.
TEST(Tolerance_of_curvature, holds_on_coarse_meshes)
{
  Random random(21);
  for (int i = 0; i < 8; ++i) {
    Soup soup = shapes::sphere(i % 3, 0.3);
    for (Vector_3& p : soup.points) p *= random.real(0.9, 1.1);
    const double tolerance = random.real(0.001, 0.005), asked = tolerance * diagonal(shapes::mesh<Mesh>(soup));
    const SMA::Curvature_metric_field field(tolerance);
    Mesh mesh = shapes::mesh<Mesh>(soup), flat = mesh;
    EXPECT_LE(SMA::adapt_surface_mesh(sequential, mesh, field).deviation, asked) << i;
    const auto on_triangles = params::surface_reconstruction(SMA::Flat_reconstruction());
    EXPECT_LE(SMA::adapt_surface_mesh(sequential, flat, field, on_triangles).deviation, 1.3 * asked) << i;
    EXPECT_LE(distances::Original(shapes::mesh<Mesh>(soup)).distance_to(flat, 50000).largest, 1.3 * asked) << i;
  }
}

/// No size brings faces near enough that cross edges which turn by much and are no ridges.
TEST(Tolerance_of_curvature, holds_where_edges_bend_that_are_no_ridges)
{
  Random random(31);
  int with_creases = 0;
  for (int i = 0; i < 8; ++i) {
    const Mesh input = sharp_sphere(random, i);
    const SMA::Curvature_metric_field field(random.real(0.0015, 0.004));
    const double asked = field.relative_tolerance * diagonal(input);
    Mesh mesh = input, flat = input;
    const auto on_patches = SMA::adapt_surface_mesh(sequential, mesh, field);
    const auto on_triangles = SMA::adapt_surface_mesh(sequential, flat, field,
                                                      params::surface_reconstruction(SMA::Flat_reconstruction()));
    EXPECT_LE(on_patches.deviation, asked) << i;
    EXPECT_LE(on_triangles.deviation, asked) << i;
    EXPECT_LE(distance_between(input, flat, asked), 1.02 * asked) << i;
    with_creases += has_late_creases(on_patches) + has_late_creases(on_triangles);
  }
  EXPECT_GE(with_creases, 5); // else this shows nothing
}

/// There edges become ridges before sizes are corrected, and patches do not leave them by much.
TEST(Tolerance_of_curvature, keeps_near_decimated_parts)
{
  struct Part { std::string name; double share, largest; };
  for (const Part& part : {Part{"couplingdown", 0.2, 0.0033}, Part{"joint", 0.3, 0.0095}, Part{"rotor_small", 0.3, 0.008}}) {
    SCOPED_TRACE(part.name + " " + std::to_string(part.share));
    const Mesh input = decimated_mesh<Mesh>(part.name, part.share);
    Mesh mesh = input;
    EXPECT_TRUE(has_late_creases(SMA::adapt_surface_mesh(sequential, mesh, SMA::Curvature_metric_field(0.001))));
    EXPECT_LT(distances::Original(input).distance_to(mesh, 50000).largest, part.largest * diagonal(input));
  }
}

/// Where the faces of the input are the surface, faces need not become small beside edges of the input: they follow these.
TEST(Tolerance_of_curvature, takes_few_vertices_on_large_triangles)
{
  Random random(23);
  const auto flat = params::surface_reconstruction(SMA::Flat_reconstruction());
  for (int i = 0; i < 8; ++i) {
    Soup soup = shapes::sphere(1 + i % 2, 0.2);
    for (Vector_3& p : soup.points) p *= random.real(0.93, 1.07);
    SMA::Curvature_metric_field field(random.real(0.0005, 0.001));
    field.anisotropic = i % 4 == 3;
    const Mesh input = shapes::mesh<Mesh>(soup);
    Mesh mesh = input, before = input;
    const double asked = field.relative_tolerance * diagonal(input);
    const SMA::Adaptation_report report = SMA::adapt_surface_mesh(sequential, mesh, field, flat);
    SMA::adapt_surface_mesh(sequential, before, without_tolerance(field), flat);
    EXPECT_LE(report.deviation, asked) << i;
    EXPECT_LE(distance_between(input, mesh, asked), 1.02 * asked) << i;
    EXPECT_GT(report.final.in_range, 0.95) << i;
    EXPECT_GT(report.final.min_quality, 0.2) << i;
    EXPECT_LE(double(mesh.number_of_vertices()), 2 * double(before.number_of_vertices())) << i;
  }
}

/// Labels, edges that are protected, a tolerance, and no self-intersections, all at once.
TEST(Tolerance_of_curvature, has_late_creases_together_with_everything_else)
{
  Random random(61);
  for (int i = 0; i < 4; ++i) {
    const Mesh input = sharp_sphere(random, i);
    const SMA::Curvature_metric_field field(0.003);
    const double asked = field.relative_tolerance * diagonal(input);
    Mesh mesh = input;
    auto label = mesh.add_property_map<Mesh::Face_index, int>("f:label", 0).first;
    auto is_protected = mesh.add_property_map<Mesh::Edge_index, bool>("e:protected", false).first;
    for (const auto f : mesh.faces()) label[f] = mesh.point(source(halfedge(f, mesh), mesh)).x() > 0 ? 1 : 0;
    const std::size_t number_of_protected = 5;
    for (std::size_t k = 0; k < number_of_protected; ++k) is_protected[Mesh::Edge_index(Mesh::size_type(3 * k))] = true;
    const SMA::Adaptation_report report =
      SMA::adapt_surface_mesh(sequential, mesh, field, params::surface_reconstruction(SMA::Flat_reconstruction())
                                                         .avoid_self_intersections(true)
                                                         .tolerance(2 * asked)
                                                         .face_patch_map(label)
                                                         .edge_is_constrained_map(is_protected)
                                                         .protect_constraints(true));
    EXPECT_TRUE(has_late_creases(report)) << i;
    EXPECT_LE(report.certified_distance, 2 * asked) << i;
    EXPECT_EQ(brute_force_intersections::number_of_pairs(shapes::soup(mesh)), 0u) << i;
    std::size_t left = 0;
    for (const auto e : mesh.edges()) left += is_protected[e] ? 1 : 0;
    EXPECT_EQ(left, number_of_protected) << i;
    double area = 0, area_of_input = 0;
    for (const auto f : mesh.faces()) area += label[f] * CGAL::Polygon_mesh_processing::face_area(f, mesh);
    for (const auto f : input.faces())
      if (input.point(source(halfedge(f, input), input)).x() > 0)
        area_of_input += CGAL::Polygon_mesh_processing::face_area(f, input);
    EXPECT_NEAR(area, area_of_input, 0.05 * area_of_input) << i;
  }
}

/// Nor does what is around a range of faces change.
TEST(Tolerance_of_curvature, has_late_creases_in_a_range_of_faces)
{
  Random random(62);
  Mesh mesh = sharp_sphere(random, 2);
  const Mesh input = mesh;
  std::vector<Mesh::Face_index> range, others;
  for (const auto f : mesh.faces())
    (mesh.point(source(halfedge(f, mesh), mesh)).z() > 0 ? range : others).push_back(f);
  const SMA::Adaptation_report report = SMA::adapt_surface_mesh(
    sequential, range, mesh, SMA::Curvature_metric_field(0.002), params::surface_reconstruction(SMA::Flat_reconstruction()));
  EXPECT_TRUE(has_late_creases(report));
  for (const auto f : others) {
    const auto of_face = CGAL::vertices_around_face(mesh.halfedge(f), mesh), before = CGAL::vertices_around_face(input.halfedge(f), input);
    EXPECT_TRUE(std::equal(of_face.begin(), of_face.end(), before.begin(), before.end(),
                           [&](auto v, auto w) { return mesh.point(v) == input.point(w); }));
  }
}

/// Not where nobody wants ridges, nor where sizes have to be larger than the distance, nor on what is round.
TEST(Tolerance_of_curvature, has_late_creases_only_where_these_are_missing)
{
  Random random(44);
  const Mesh sharp = sharp_sphere(random, 0), torus = shapes::mesh<Mesh>(Torus().coarse_mesh(3));
  const SMA::Curvature_metric_field field(0.002);
  SMA::Curvature_metric_field coarse = field;
  coarse.hmin = 0.05;
  const auto flat = params::surface_reconstruction(SMA::Flat_reconstruction());
  const auto has_some = [](Mesh mesh, const SMA::Curvature_metric_field& f, const auto& np) {
    return has_late_creases(SMA::adapt_surface_mesh(sequential, mesh, f, np));
  };
  EXPECT_TRUE(has_some(sharp, field, flat));
  EXPECT_FALSE(has_some(sharp, field, flat.detect_features(false)));
  EXPECT_FALSE(has_some(sharp, coarse, flat));
  EXPECT_FALSE(has_some(torus, field, flat));
  EXPECT_FALSE(has_some(torus, field, CGAL::parameters::default_values()));
}

/// A cylinder of few chords, open at its ends, with one more vertex next to the middle of a chord of the boundary: the
/// triangle between would be a wall if the chord became the arc that its neighbors are of.
Soup cylinder_with_cap(Random& random)
{
  const std::size_t around = 6 + random.below(3);
  Soup soup = shapes::open_cylinder(around, 3, 1);
  const std::size_t f = std::size_t(std::find_if(soup.triangles.begin(), soup.triangles.end(), [&](const auto& t) {
    return soup.points[t[0]].z() == soup.points[t[1]].z();
  }) - soup.triangles.begin());
  const shapes::Triangle t = soup.triangles[f];
  const double u = random.real(0.35, 0.65), height = random.real(0.02, 0.1);
  const Vector_3 foot = (1 - u) * soup.points[t[0]] + u * soup.points[t[1]];
  shapes::split_triangle(soup, f, (1 - height) * foot + height * soup.points[t[2]]);
  return soup;
}

TEST(Tolerance_of_curvature, holds_beside_caps_at_the_boundary)
{
  Random random(22);
  for (int i = 0; i < 10; ++i) {
    Mesh mesh = shapes::mesh<Mesh>(cylinder_with_cap(random));
    const double asked = 0.002 * diagonal(mesh);
    EXPECT_LE(SMA::adapt_surface_mesh(sequential, mesh, SMA::Curvature_metric_field(0.002)).deviation, asked) << i;
  }
}

} // namespace test_deviation

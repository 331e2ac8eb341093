// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces that intersect: they are counted as every pair of faces tells, and none that did not come about where that is
// asked for, whatever comes near to what.

#include "brute_force_intersections.h"
#include "checks.h"
#include "near_sheets.h"
#include "policies.h"
#include "random_meshes.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/distance/self_intersections.h>
#include <CGAL/Surface_mesh_adaptation/refine.h>
#include <CGAL/Surface_mesh_adaptation/regularize.h>
#include <CGAL/Surface_mesh_adaptation/relocate.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>
#include <CGAL/Surface_mesh_adaptation/swap.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace test_self_intersections {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Field = std::variant<SMA::Uniform_metric_field, SMA::Curvature_metric_field>;

std::size_t pairs(const Soup& soup)
{
  const SMA::Mesh_view mesh = shapes::view(soup);
  return SMA::self_intersections(SMA::Sequential_execution(), mesh, soup.points).size();
}

/// A field with sizes of some mean edges, uniform or by the curvature, isotropic or not.
Field random_field(Random& random, const Soup& soup)
{
  const double size = soup.mean_edge_length() * std::pow(10.0, random.real(-0.3, 1));
  if (random.below(2) == 0) return SMA::Uniform_metric_field(size);
  SMA::Curvature_metric_field field(random.real(0.001, 0.1));
  field.anisotropic = random.below(2) == 0;
  return field;
}

TEST(Self_intersections, are_those_that_every_pair_of_faces_tells)
{
  std::size_t all = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    Soup soup = shapes::sphere(2, 0.3);
    shapes::append(soup, shapes::torus(12, 8, 0.3));
    const double noise = std::pow(10.0, random.real(-4, 0));
    for (Vector_3& p : soup.points) {
      p += noise * random.vector();
      if (seed % 3 == 0) p = Vector_3(std::round(4 * p[0]), std::round(4 * p[1]), std::round(4 * p[2])); // coplanar faces
    }
    const std::size_t expected = brute_force_intersections::number_of_pairs(soup);
    ASSERT_EQ(pairs(soup), expected) << seed;
    all += expected;
  }
  EXPECT_GT(all, 10000u);
}

TEST(Self_intersections, are_the_same_with_every_policy)
{
  Soup soup = shapes::sphere(4, 0.3);
  Random random(1);
  for (Vector_3& p : soup.points) p += 0.05 * random.vector();
  const SMA::Mesh_view mesh = shapes::view(soup);
  const auto expected = SMA::self_intersections(SMA::Sequential_execution(), mesh, soup.points);
  EXPECT_GT(expected.size(), 10u);
  for_each_policy([&](const auto& execution, const std::string& name) {
    EXPECT_EQ(SMA::self_intersections(execution, mesh, soup.points), expected) << name;
  });
}

TEST(Self_intersections, are_counted_on_request)
{
  Soup soup = shapes::sphere(3);
  Soup inner = soup;
  for (Vector_3& p : inner.points) p *= 0.99;
  shapes::append(soup, inner);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  const auto report = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.4), params::count_self_intersections(true));
  EXPECT_TRUE(report.self_intersections.are_counted);
  EXPECT_EQ(report.self_intersections.before, 0u);
  EXPECT_EQ(report.self_intersections.after, brute_force_intersections::number_of_pairs(shapes::soup(mesh)));
  EXPECT_GT(report.self_intersections.after, 0u);
  EXPECT_EQ(std::count_if(report.warnings.begin(), report.warnings.end(), [](const std::string& s) {
    return s.find("avoid_self_intersections") != std::string::npos;
  }), 1);
  EXPECT_FALSE(SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.4)).self_intersections.are_counted);
}

TEST(Self_intersections, do_not_come_about_between_sheets_that_are_near_each_other)
{
  std::size_t runs = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 70; ++seed) {
    const auto [name, soup] = near_sheets::shape(seed);
    if (pairs(soup) > 0) continue;
    Random random(seed);
    const Field field = random_field(random, soup);
    Mesh mesh = shapes::mesh<Mesh>(soup), plain = mesh;
    const bool is_fitted = random.below(4) == 0;
    SMA::adapt_surface_mesh(mesh, field, params::avoid_self_intersections(true).fit_to_surface(is_fitted));
    SMA::adapt_surface_mesh(plain, field, params::fit_to_surface(is_fitted));
    EXPECT_EQ(brute_force_intersections::number_of_pairs(shapes::soup(mesh)), 0u) << name << ", seed " << seed;
    without += pairs(shapes::soup(plain)) > 0 ? 1 : 0;
    ++runs;
  }
  EXPECT_GT(runs, 55u);
  EXPECT_GT(without, runs / 3) << "the shapes are no test";
}

TEST(Self_intersections, do_not_come_about_in_a_thousand_small_random_meshes)
{
  std::size_t runs = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    random_meshes::Random random(seed);
    const Soup soup = random_meshes::mesh(random);
    if (!checks::is_manifold(soup) || brute_force_intersections::number_of_pairs(soup) > 0) continue;
    const auto adapted = [&](bool avoids) {
      Mesh mesh = shapes::mesh<Mesh>(soup);
      Random same(seed);
      try {
        SMA::adapt_surface_mesh(mesh, random_field(same, soup),
                                params::avoid_self_intersections(avoids).maximum_number_of_vertices(1000));
      } catch (const SMA::Adaptation_error&) { // it is as it was
      }
      return brute_force_intersections::number_of_pairs(shapes::soup(mesh));
    };
    EXPECT_EQ(adapted(true), 0u) << "seed " << seed;
    without += adapted(false) > 0 ? 1 : 0;
    ++runs;
  }
  EXPECT_GT(runs, 1000u);
  EXPECT_GT(without, 20u) << "the meshes are no test";
}

TEST(Self_intersections, are_avoided_with_the_same_bits_by_every_policy)
{
  const Soup soup = near_sheets::shape(7).soup;
  std::vector<Soup> results;
  for_each_policy([&](const auto& execution, const std::string& name) {
    Mesh mesh = shapes::mesh<Mesh>(soup);
    const SMA::Uniform_metric_field field(4 * soup.mean_edge_length());
    SMA::adapt_surface_mesh(execution, mesh, field, params::avoid_self_intersections(true));
    results.push_back(shapes::soup(mesh));
    EXPECT_TRUE(checks::is_identical(results.back(), results.front())) << name;
  });
  EXPECT_EQ(brute_force_intersections::number_of_pairs(results.front()), 0u);
}

TEST(Self_intersections, of_the_input_stay_where_they_are)
{
  Soup soup = shapes::torus(60, 24, 0.2), other = soup, shells = shapes::sphere(3, 0.2), inner = shells;
  for (Vector_3& p : other.points) p = Vector_3(p[0] + 0.5, p[2], p[1]); // through the first one
  for (Vector_3& p : inner.points) p *= 0.985;
  shapes::append(shells, inner);
  for (Vector_3& p : shells.points) p += Vector_3(10, 0, 0);
  shapes::append(soup, other);
  shapes::append(soup, shells);
  ASSERT_GT(pairs(soup), 0u);
  const auto number_of_pairs_of_shells = [&](bool avoid) {
    Mesh mesh = shapes::mesh<Mesh>(soup);
    SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.4), params::avoid_self_intersections(avoid));
    const Soup result = shapes::soup(mesh);
    const auto all = SMA::self_intersections(SMA::Sequential_execution(), shapes::view(result), result.points);
    EXPECT_GT(all.size(), 0u);
    return std::count_if(all.begin(), all.end(), [&](const SMA::Face_pair& pair) {
      return result.points[result.triangles[pair[0]][0]][0] > 5;
    });
  };
  EXPECT_GT(number_of_pairs_of_shells(false), 0);
  EXPECT_EQ(number_of_pairs_of_shells(true), 0);
}

TEST(Self_intersections, are_avoided_by_each_kernel_alone)
{
  const Soup soup = near_sheets::shape(14).soup;
  ASSERT_EQ(pairs(soup), 0u);
  const auto np = params::avoid_self_intersections(true);
  const double h = soup.mean_edge_length();
  const SMA::Uniform_metric_field coarse(4 * h), fine(0.5 * h), same(h);
  const auto check = [&](const std::string& name, const auto& run) {
    Mesh mesh = shapes::mesh<Mesh>(soup);
    run(mesh);
    EXPECT_EQ(brute_force_intersections::number_of_pairs(shapes::soup(mesh)), 0u) << name;
  };
  check("refine", [&](Mesh& m) { SMA::refine(m, fine, np); });
  check("simplify", [&](Mesh& m) { SMA::simplify(m, coarse, np); });
  check("swap", [&](Mesh& m) { SMA::swap(m, same, np); });
  check("regularize", [&](Mesh& m) { SMA::regularize(m, same, np); });
  check("relocate", [&](Mesh& m) { SMA::relocate(m, same, np); });
}

/// Lets a run go on until it was asked for that some times.
struct Counting_visitor : SMA::Adaptation_visitor
{
  mutable std::size_t left;

  explicit Counting_visitor(std::size_t times) : left(times) {}
  bool go_on() const { return left > 0 && --left > 0; }
};

TEST(Self_intersections, do_not_come_about_in_runs_that_are_stopped)
{
  std::size_t written = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto [name, soup] = near_sheets::shape(seed);
    if (pairs(soup) > 0) continue;
    Mesh mesh = shapes::mesh<Mesh>(soup);
    const Soup before = shapes::soup(mesh);
    Counting_visitor visitor(1 + seed % 8);
    try {
      const SMA::Uniform_metric_field field(4 * soup.mean_edge_length());
      SMA::adapt_surface_mesh(mesh, field, params::avoid_self_intersections(true).visitor(std::ref(visitor)));
      ++written;
      EXPECT_EQ(brute_force_intersections::number_of_pairs(shapes::soup(mesh)), 0u) << name << ", seed " << seed;
    } catch (const SMA::Self_intersection_error&) {
      EXPECT_TRUE(checks::is_identical(shapes::soup(mesh), before)) << name << ", seed " << seed;
    }
  }
  EXPECT_GT(written, 10u);
}

TEST(Self_intersections, are_avoided_with_a_tolerance_labels_and_protected_edges)
{
  Soup soup = shapes::sphere(3, 0.2);
  Soup inner = soup;
  for (Vector_3& p : inner.points) p *= 0.985;
  shapes::append(soup, inner);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  auto label = mesh.add_property_map<Mesh::Face_index, int>("f:label", 0).first;
  auto is_protected = mesh.add_property_map<Mesh::Edge_index, bool>("e:protected", false).first;
  const auto x = [&](Mesh::Vertex_index v) { return mesh.point(v).x(); };
  for (const auto f : mesh.faces())
    label[f] = x(source(halfedge(f, mesh), mesh)) > 0 ? 1 : 0;
  std::size_t number_of_protected = 0;
  for (const auto e : mesh.edges()) {
    is_protected[e] = x(source(halfedge(e, mesh), mesh)) < -0.8 && x(target(halfedge(e, mesh), mesh)) < -0.8;
    number_of_protected += is_protected[e] ? 1 : 0;
  }
  const auto report = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(0.35),
                                              params::avoid_self_intersections(true)
                                                .tolerance(0.05)
                                                .face_patch_map(label)
                                                .edge_is_constrained_map(is_protected)
                                                .protect_constraints(true));
  EXPECT_EQ(brute_force_intersections::number_of_pairs(shapes::soup(mesh)), 0u);
  EXPECT_LE(report.certified_distance, 0.05);
  std::size_t left = 0, labelled = 0;
  for (const auto e : mesh.edges()) left += is_protected[e] ? 1 : 0;
  for (const auto f : mesh.faces()) labelled += std::size_t(label[f]);
  EXPECT_GE(left, number_of_protected);
  EXPECT_GT(labelled, 0u);
}

TEST(Self_intersections, are_avoided_by_faces_that_stay_without_a_mark)
{
  std::size_t runs = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto [name, soup] = near_sheets::shape(seed);
    if (pairs(soup) > 0) continue;
    Mesh mesh = shapes::mesh<Mesh>(soup);
    auto is_protected = mesh.add_property_map<Mesh::Edge_index, bool>("e:protected", false).first;
    is_protected[*mesh.edges().begin()] = true;
    const auto report = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(4 * soup.mean_edge_length()),
                                                params::avoid_self_intersections(true)
                                                  .edge_is_constrained_map(is_protected)
                                                  .protect_constraints(true));
    const auto says = [](const std::string& s) { return s.find("faces of the input stay") != std::string::npos; };
    runs += std::any_of(report.warnings.begin(), report.warnings.end(), says) ? 1 : 0;
    const auto edges = mesh.edges();
    EXPECT_EQ(std::count_if(edges.begin(), edges.end(), [&](const auto e) { return is_protected[e]; }), 1)
      << name << ", seed " << seed;
  }
  EXPECT_GT(runs, 3u) << "the shapes are no test";
}

TEST(Self_intersections, are_avoided_with_what_is_around_a_part)
{
  Soup soup = shapes::sphere(4, 0.2);
  Soup inner = soup;
  for (Vector_3& p : inner.points) p *= 0.99;
  shapes::append(soup, inner);
  const auto adapted = [&](bool avoid) {
    Mesh mesh = shapes::mesh<Mesh>(soup);
    std::vector<Mesh::Face_index> part; // of the inner shell, which bulges where it gets coarser, and the outer one stays
    for (const auto f : mesh.faces()) {
      const auto p = mesh.point(source(halfedge(f, mesh), mesh));
      const double r = std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
      if (p.z() > -0.2 && r > 0.995) part.push_back(f);
    }
    SMA::adapt_surface_mesh(part, mesh, SMA::Uniform_metric_field(0.5), params::avoid_self_intersections(avoid));
    return shapes::soup(mesh);
  };
  EXPECT_GT(brute_force_intersections::number_of_pairs(adapted(false)), 0u);
  EXPECT_EQ(brute_force_intersections::number_of_pairs(adapted(true)), 0u);
}

TEST(Self_intersections, are_avoided_in_coordinates_of_single_precision)
{
  using Float_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>;
  Soup soup = near_sheets::shape(21).soup;
  for (Vector_3& p : soup.points) p += Vector_3(3000, 2000, 1000);
  Float_mesh mesh = shapes::mesh<Float_mesh>(soup);
  if (pairs(shapes::soup(mesh)) > 0) GTEST_SKIP() << "rounding the input made some";
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(3 * soup.mean_edge_length()),
                          params::avoid_self_intersections(true));
  EXPECT_EQ(brute_force_intersections::number_of_pairs(shapes::soup(mesh)), 0u);
}

} // namespace test_self_intersections

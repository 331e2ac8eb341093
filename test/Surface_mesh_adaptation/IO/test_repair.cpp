// SPDX-License-Identifier: GPL-3.0-or-later
//
// From soups of polygons to valid meshes: what is welded, cut, turned and left out, and that the result can be adapted
// whatever comes in.

#include "checks.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/IO/repair.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace test_repair {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Soup;
using shapes::Vector_3;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Polygons = std::vector<std::vector<std::size_t>>;

/// Polygons to be repaired.
struct Input
{
  std::vector<Point> points;
  Polygons polygons;

  Input() = default;
  explicit Input(const Soup& soup)
  {
    for (const Vector_3& p : soup.points) points.emplace_back(p[0], p[1], p[2]);
    for (const auto& t : soup.triangles) polygons.push_back({t[0], t[1], t[2]});
  }
};

struct Repaired
{
  SMA::Repair_report report;
  Soup soup;
  Mesh mesh;
};

Soup soup_of(const Mesh& mesh)
{
  Soup soup;
  for (const auto v : mesh.vertices())
    soup.points.emplace_back(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  for (const auto f : mesh.faces()) {
    soup.triangles.emplace_back();
    std::size_t i = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) soup.triangles.back()[i++] = Index(v);
  }
  return soup;
}

/// Repairs, and checks what always holds.
Repaired repaired(const Input& input, const SMA::Repair_options& options = SMA::Repair_options())
{
  Repaired r;
  r.report = SMA::repair_polygon_soup_to_triangle_mesh(input.points, input.polygons, r.mesh, options);
  r.soup = soup_of(r.mesh);
  EXPECT_TRUE(checks::is_manifold(r.soup));
  EXPECT_EQ(r.report.point_of_vertex.size(), r.soup.points.size());
  EXPECT_EQ(r.report.polygon_of_face.size(), r.soup.triangles.size());
  for (const auto v : r.mesh.vertices()) EXPECT_EQ(r.mesh.point(v), input.points[r.report.point_of_vertex[v]]);
  for (const std::size_t i : r.report.polygon_of_face)
    EXPECT_TRUE(i < input.polygons.size() || (i == SMA::Repair_report::none && r.report.removed_degenerate_faces > 0));
  return r;
}

double volume(const Soup& soup)
{
  double sum = 0;
  for (const auto& t : soup.triangles) sum += soup.points[t[0]].dot(soup.points[t[1]].cross(soup.points[t[2]])) / 6;
  return sum;
}

Soup moved(Soup soup, double scale, const Vector_3& by)
{
  for (Vector_3& p : soup.points) p = scale * p + by;
  return soup;
}

void turn(std::vector<std::size_t>& polygon) { std::reverse(polygon.begin(), polygon.end()); }

/// Gives each class of faces points of its own.
Input unwelded(const Soup& soup, const std::vector<std::size_t>& class_of_face)
{
  Input result;
  std::map<std::pair<std::size_t, Index>, std::size_t> index;
  const Input all(soup);
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    result.polygons.emplace_back();
    for (const Index v : soup.triangles[f]) {
      const auto added = index.emplace(std::make_pair(class_of_face[f], v), result.points.size());
      if (added.second) result.points.push_back(all.points[v]);
      result.polygons.back().push_back(added.first->second);
    }
  }
  return result;
}

std::vector<std::size_t> random_classes(std::size_t n, std::size_t classes, std::mt19937& random)
{
  std::vector<std::size_t> result(n);
  for (std::size_t& c : result) c = random() % classes;
  return result;
}

std::string all(const std::vector<std::string>& sentences)
{
  return std::accumulate(sentences.begin(), sentences.end(), std::string());
}

// Good input

TEST(Repair, leaves_good_input_alone)
{
  for (const Soup& soup : {shapes::sphere(2), shapes::torus(20, 9), shapes::square(5), shapes::cube(3)}) {
    const Repaired r = repaired(Input(soup));
    EXPECT_TRUE(r.report.is_valid());
    EXPECT_EQ(all(r.report.repairs()) + all(r.report.warnings()), "");
    EXPECT_EQ(r.soup.points, soup.points);
    EXPECT_EQ(r.soup.triangles.size(), soup.triangles.size());
    EXPECT_NEAR(volume(r.soup), volume(soup), 1e-12);
  }
}

/// What is an oriented surface goes a short way, with the same result as by CGAL's functions for soups: faces start at the
/// same corners, and vertices have the same halfedges, as far as anybody can tell.
TEST(Repair, builds_good_input_as_cgal_does)
{
  for (const Soup& soup : {shapes::sphere(2), shapes::torus(20, 9), shapes::square(5), shapes::open_cylinder(9, 4, 1)}) {
    const Input input(soup);
    const Repaired r = repaired(input);
    Mesh expected;
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(input.points, input.polygons, expected);
    EXPECT_TRUE(checks::is_identical(r.soup, soup_of(expected)));
    const auto read = [](const Mesh& mesh) {
      return SMA::internal::read_face_graph(SMA::Sequential_execution(), mesh, mesh.points()).mesh;
    };
    const SMA::Mesh_view ours = read(r.mesh), cgals = read(expected);
    EXPECT_TRUE(std::equal(ours.corner.begin(), ours.corner.end(), cgals.corner.begin(), cgals.corner.end()));
    EXPECT_TRUE(std::equal(ours.twin.begin(), ours.twin.end(), cgals.twin.begin(), cgals.twin.end()));
    EXPECT_TRUE(std::equal(ours.outgoing.begin(), ours.outgoing.end(), cgals.outgoing.begin(), cgals.outgoing.end()));
  }
}

TEST(Repair, leaves_out_a_copy_that_looks_the_other_way)
{
  Input input(shapes::tetrahedron());
  input.points.resize(3);
  input.polygons = {{0, 1, 2}, {2, 1, 0}}; // joined along all three edges
  const Repaired r = repaired(input);
  EXPECT_EQ(r.report.duplicate_faces.count, 1u);
  EXPECT_EQ(r.soup.triangles.size(), 1u);
}

// Welding

TEST(Repair, welds_patches_of_any_kind)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial)
    for (const Soup& soup :
         {shapes::sphere(2), shapes::torus(12, 7), shapes::square(6), shapes::open_cylinder(9, 4, 1)}) {
      const std::size_t n = soup.triangles.size();
      Input input = unwelded(soup, random_classes(n, trial == 0 ? n : 1 + random() % 5, random));
      const Repaired r = repaired(input);
      EXPECT_TRUE(r.report.is_valid());
      EXPECT_EQ(checks::topology(r.soup), checks::topology(soup));
      EXPECT_EQ(r.report.welded_points.count, input.points.size() - soup.points.size());
      EXPECT_EQ(r.report.open_seams.count, 0u);
      EXPECT_NEAR(volume(r.soup), volume(soup), 1e-12);
    }
}

TEST(Repair, welds_patches_that_look_different_ways)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Soup soup = shapes::sphere(2);
    const auto classes = random_classes(soup.triangles.size(), 6, random);
    Input input = unwelded(soup, classes);
    for (std::size_t f = 0; f < classes.size(); ++f)
      if (classes[f] % 3 == 0) turn(input.polygons[f]);
    const Repaired r = repaired(input);
    EXPECT_EQ(checks::topology(r.soup), checks::topology(soup));
    EXPECT_GT(volume(r.soup), 0);
    EXPECT_EQ(r.report.turned_components, 1u);
    const auto turned = std::count_if(classes.begin(), classes.end(), [](std::size_t c) { return c % 3 == 0; });
    EXPECT_EQ(r.report.turned_faces.count, std::size_t(turned));
  }
}

TEST(Repair, leaves_seams_open_if_asked_to)
{
  const Soup soup = shapes::sphere(1);
  SMA::Repair_options options;
  options.weld = false;
  std::vector<std::size_t> classes(soup.triangles.size());
  std::iota(classes.begin(), classes.end(), std::size_t(0));
  const Repaired r = repaired(unwelded(soup, classes), options);
  EXPECT_EQ(r.soup.points.size(), 3 * soup.triangles.size());
  EXPECT_EQ(r.report.welded_points.count, 0u);
}

/// Boxes that touch, each with points of its own.
Input touching_boxes(const std::vector<Vector_3>& places)
{
  Soup soup;
  for (const Vector_3& p : places) append(soup, moved(shapes::cube(2), 1, p));
  return Input(soup);
}

TEST(Repair, does_not_weld_what_merely_touches)
{
  const double side = [] {
    const Soup cube = shapes::cube(2);
    double largest = 0, least = 0;
    for (const Vector_3& p : cube.points) {
      largest = (std::max)(largest, p[0]);
      least = (std::min)(least, p[0]);
    }
    return largest - least;
  }();
  for (const Vector_3& by : {Vector_3(side, side, side), Vector_3(side, side, 0), Vector_3(side, 0, 0)}) {
    const Repaired r = repaired(touching_boxes({Vector_3(0, 0, 0), by}));
    EXPECT_TRUE(r.report.is_valid());
    EXPECT_EQ(r.report.welded_points.count, 0u);
    EXPECT_EQ(checks::topology(r.soup).components, 2u);
    EXPECT_EQ(checks::topology(r.soup).boundary_cycles, 0u);
  }
}

TEST(Repair, does_not_weld_three_sheets_that_meet)
{
  Input input;
  for (int sheet = 0; sheet < 3; ++sheet) {
    const std::size_t i = input.points.size();
    const Point tip(std::cos(2 * sheet), std::sin(2 * sheet), 0);
    input.points.insert(input.points.end(), {Point(0, 0, 0), Point(0, 0, 1), tip});
    input.polygons.push_back({i, i + 1, i + 2});
  }
  const Repaired r = repaired(input);
  EXPECT_EQ(checks::topology(r.soup).components, 3u);
  EXPECT_EQ(r.report.open_seams.count, 1u);
  EXPECT_NE(all(r.report.warnings()).find("between the vertices"), std::string::npos);
}

TEST(Repair, does_not_weld_a_sheet_to_its_copy)
{
  Soup soup = shapes::square(3);
  append(soup, shapes::square(3));
  const Repaired r = repaired(Input(soup));
  EXPECT_EQ(checks::topology(r.soup).components, 2u);
  EXPECT_EQ(r.report.welded_points.count, 0u);
}

TEST(Repair, welds_a_moebius_strip_only_as_far_as_it_has_two_sides)
{
  constexpr int n = 12;
  Input strip;
  const auto at = [](int i, double s) {
    const double t = 2 * M_PI * i / n;
    return Point((1 + s * std::cos(t / 2)) * std::cos(t), (1 + s * std::cos(t / 2)) * std::sin(t), s * std::sin(t / 2));
  };
  for (int i = 0; i <= n; ++i)
    for (const double s : {-0.3, 0.3}) strip.points.push_back(i < n ? at(i, s) : at(0, -s));
  for (std::size_t i = 0; i < 2 * n; i += 2) {
    strip.polygons.push_back({i, i + 1, i + 2});
    strip.polygons.push_back({i + 2, i + 1, i + 3});
  }
  const Repaired r = repaired(strip);
  EXPECT_TRUE(r.report.is_valid());
  EXPECT_EQ(r.report.welded_points.count, 0u);
  EXPECT_EQ(r.report.open_seams.count, 1u);
}

// Orientation

TEST(Repair, orients_closed_components_outwards_and_open_ones_as_most_of_their_area)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 30; ++trial) {
    const bool is_closed = trial % 2 == 0;
    const Soup soup = is_closed ? shapes::sphere(2) : shapes::square(10);
    Input input(soup);
    const std::size_t turned = random() % (is_closed ? soup.triangles.size() : soup.triangles.size() / 3);
    std::vector<std::size_t> order(soup.triangles.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::shuffle(order.begin(), order.end(), random);
    if (turned > 0 && trial % 3 == 0) std::swap(order[0], *std::find(order.begin(), order.end(), 0u)); // the first face
    for (std::size_t i = 0; i < turned; ++i) turn(input.polygons[order[i]]);
    const Repaired r = repaired(input);
    EXPECT_TRUE(r.report.is_valid());
    EXPECT_EQ(r.report.turned_faces.count, turned);
    EXPECT_EQ(r.report.turned_components, turned > 0 ? 1u : 0u);
    if (is_closed) {
      EXPECT_NEAR(volume(r.soup), volume(soup), 1e-12);
    }
    else {
      EXPECT_GT(checks::least_area(r.soup, [](const Vector_3&) { return Vector_3(0, 0, 1); }), 0);
    }
  }
}

/// Spheres of the radii 1, 2, 3 .. within each other, those turned that `is_turned` says.
Input nested(const std::vector<bool>& is_turned)
{
  Input result;
  for (std::size_t i = 0; i < is_turned.size(); ++i) {
    Input sphere(moved(shapes::sphere(2), double(i + 1), Vector_3(0.1, 0, 0)));
    for (auto& t : sphere.polygons) {
      if (is_turned[i]) turn(t);
      for (std::size_t& v : t) v += result.points.size();
    }
    result.points.insert(result.points.end(), sphere.points.begin(), sphere.points.end());
    result.polygons.insert(result.polygons.end(), sphere.polygons.begin(), sphere.polygons.end());
  }
  return result;
}

std::vector<double> signs_of_volumes(const Repaired& r, std::size_t spheres)
{
  std::vector<double> volumes(spheres);
  const std::size_t n = r.soup.triangles.size() / spheres;
  for (std::size_t i = 0; i < spheres; ++i) {
    Soup sphere = r.soup;
    const auto first = r.soup.triangles.begin() + std::ptrdiff_t(i * n);
    sphere.triangles.assign(first, first + std::ptrdiff_t(n));
    volumes[i] = volume(sphere) > 0 ? 1 : -1;
  }
  return volumes;
}

TEST(Repair, keeps_cavities_and_shells_as_they_are)
{
  EXPECT_EQ(repaired(nested({true, false})).report.turned_faces.count, 0u);
  EXPECT_EQ(repaired(nested({false, false})).report.turned_faces.count, 0u);
  EXPECT_EQ(repaired(nested({false, true, false})).report.turned_faces.count, 0u);
}

TEST(Repair, turns_what_is_inside_out_with_all_that_it_contains)
{
  EXPECT_EQ(signs_of_volumes(repaired(nested({false, true})), 2), (std::vector<double>{-1, 1}));
  EXPECT_EQ(signs_of_volumes(repaired(nested({true, true})), 2), (std::vector<double>{1, 1}));
  EXPECT_EQ(signs_of_volumes(repaired(nested({true, false, true})), 3), (std::vector<double>{1, -1, 1}));
}

TEST(Repair, makes_a_cavity_of_what_does_not_agree_inside_another)
{
  std::mt19937 random(4);
  for (int trial = 0; trial < 10; ++trial) {
    Input input = nested({false, false});
    for (std::size_t f = 0; f < input.polygons.size() / 2; ++f)
      if (random() % 3 == 0) turn(input.polygons[f]);
    EXPECT_EQ(signs_of_volumes(repaired(input), 2), (std::vector<double>{-1, 1}));
  }
}

TEST(Repair, orients_components_that_intersect_outwards)
{
  Soup soup = shapes::sphere(2);
  append(soup, moved(shapes::sphere(2), 0.8, Vector_3(0.5, 0, 0)));
  Input input(soup);
  for (auto& t : input.polygons) turn(t);
  EXPECT_EQ(signs_of_volumes(repaired(input), 2), (std::vector<double>{1, 1}));
}

// Polygons

TEST(Repair, triangulates_polygons)
{
  Input input;
  for (int i = 0; i < 8; ++i) input.points.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  input.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const Repaired r = repaired(input);
  EXPECT_TRUE(r.report.is_valid());
  EXPECT_EQ(r.report.polygons.count, 6u);
  EXPECT_EQ(r.soup.triangles.size(), 12u);
  EXPECT_NEAR(volume(r.soup), 1, 1e-12);
}

TEST(Repair, triangulates_stars_by_their_shape)
{
  std::mt19937 random(5);
  for (std::size_t n = 5; n < 40; ++n) {
    Input input;
    input.polygons.emplace_back();
    std::vector<double> radius(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double t = 2 * M_PI * double(i) / double(n), r = i % 2 == 0 ? 1 : 0.4 + 0.001 * double(random() % 100);
      input.points.emplace_back(r * std::cos(t), r * std::sin(t), 0);
      input.polygons[0].push_back(i);
    }
    const Repaired r = repaired(input);
    EXPECT_EQ(r.soup.triangles.size(), n - 2);
    EXPECT_GT(checks::least_area(r.soup, [](const Vector_3&) { return Vector_3(0, 0, 1); }), 0);
  }
}

TEST(Repair, divides_polygons_that_cross_themselves_or_have_no_area)
{
  Input input;
  input.points = {Point(0, 0, 0), Point(1, 1, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0.5, 2, 0)};
  input.polygons = {{0, 1, 2, 3, 4}};
  SMA::Repair_options options;
  options.remove_degenerate_faces = false;
  EXPECT_EQ(repaired(input, options).soup.triangles.size(), 3u);
  for (std::size_t i = 0; i < 5; ++i) input.points[i] = Point(double(i), 0, 0);
  EXPECT_EQ(repaired(input, options).report.degenerate_faces.count, 3u);
}

// What has to be left out or cut

TEST(Repair, names_and_mends_all_offences_at_once)
{
  const Soup soup = shapes::sphere(2);
  Input input(soup);
  const std::size_t n = input.points.size(), m = input.polygons.size();
  input.points.emplace_back(5, 5, 5);                                              // without a face
  input.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  input.polygons.push_back({0, 1, n + 7});
  input.polygons.push_back({0, 1});
  input.polygons.push_back({0, 0, 1});
  input.polygons.push_back({input.polygons[3][1], input.polygons[3][0], input.polygons[3][2]});
  input.polygons.push_back({0, 1, n + 1});
  const Repaired r = repaired(input);
  const auto expect = [](const SMA::Soup_defect& defect, std::size_t count, const std::string& first) {
    EXPECT_EQ(defect.count, count);
    EXPECT_EQ(defect.first, first);
  };
  expect(r.report.isolated_points, 1, "vertex " + std::to_string(n));
  expect(r.report.non_finite_points, 1, "vertex " + std::to_string(n + 1));
  expect(r.report.invalid_faces, 1, "face " + std::to_string(m));
  expect(r.report.small_faces, 1, "face " + std::to_string(m + 1));
  expect(r.report.repeating_faces, 1, "face " + std::to_string(m + 2));
  expect(r.report.duplicate_faces, 1, "face " + std::to_string(m + 3));
  EXPECT_EQ(r.report.offences().size(), 5u);
  EXPECT_EQ(r.report.repairs().size(), 5u);
  EXPECT_EQ(checks::topology(r.soup), checks::topology(soup));
}

TEST(Repair, divides_polygons_that_meet_themselves)
{
  Input input;
  input.points = {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(-1, 0, 0), Point(-1, -1, 0)};
  input.polygons = {{0, 1, 2, 0, 3, 4}, {0, 1, 1, 0}};
  const Repaired r = repaired(input);
  EXPECT_EQ(r.report.repeating_faces.count, 2u);
  EXPECT_EQ(r.soup.triangles.size(), 2u);
  EXPECT_EQ(r.soup.points.size(), 6u); // cut apart where they touch
}

TEST(Repair, cuts_spheres_apart_that_share_points)
{
  Soup soup = shapes::sphere(2);
  append(soup, moved(shapes::sphere(2), 1, Vector_3(2, 0, 0)));
  Input input(soup);
  std::size_t touching = 0;
  for (auto& t : input.polygons)
    for (std::size_t& v : t)
      for (std::size_t w = 0; w < v; ++w)
        if ((soup.points[v] - soup.points[w]).norm() < 1e-9) {
          v = w;
          ++touching;
        }
  ASSERT_GT(touching, 0u);
  const Repaired r = repaired(input);
  EXPECT_EQ(r.report.non_manifold_vertices.count, 1u);
  EXPECT_EQ(checks::topology(r.soup).components, 2u);
  EXPECT_EQ(checks::topology(r.soup).boundary_cycles, 0u);
}

TEST(Repair, cuts_boxes_apart_that_share_edges)
{
  Input input = touching_boxes({Vector_3(0, 0, 0), Vector_3(0, 0, 0)}); // the second one is moved next
  double largest = -1e300, least = 1e300;
  for (const Point& p : input.points) {
    largest = (std::max)(largest, p.x());
    least = (std::min)(least, p.x());
  }
  const double side = largest - least;
  const std::size_t n = input.points.size() / 2;
  for (std::size_t i = n; i < 2 * n; ++i)
    input.points[i] = Point(input.points[i].x() + side, input.points[i].y() + side, input.points[i].z());
  std::size_t shared = 0;
  for (auto& t : input.polygons)
    for (std::size_t& v : t)
      for (std::size_t w = 0; w < n && v >= n; ++w)
        if (input.points[v] == input.points[w]) {
          v = w;
          ++shared;
        }
  ASSERT_GT(shared, 2u);
  const Repaired r = repaired(input);
  EXPECT_EQ(r.report.non_manifold_edges.count, 2u);
  EXPECT_EQ(checks::topology(r.soup).components, 2u);
  EXPECT_EQ(checks::topology(r.soup).boundary_cycles, 0u);
  EXPECT_NEAR(volume(r.soup), 2 * side * side * side, 1e-12);
}

TEST(Repair, removes_faces_without_area)
{
  Soup soup = shapes::square(4);
  // a vertex in the middle of an edge of one face only, the other side closed by a face without area
  const auto [a, b, c] = soup.triangles[0];
  const auto m = Index(soup.points.size());
  soup.points.push_back((soup.points[a] + soup.points[b]) / 2);
  soup.triangles[0] = {a, m, c};
  soup.triangles.push_back({m, b, c});
  soup.triangles.push_back({a, b, m});
  const Repaired r = repaired(Input(soup));
  EXPECT_EQ(r.report.degenerate_faces.count, 1u);
  EXPECT_EQ(r.report.removed_degenerate_faces, 1u);
  EXPECT_GT(checks::least_area(r.soup), 0);
  SMA::Repair_options options;
  options.remove_degenerate_faces = false;
  EXPECT_EQ(repaired(Input(soup), options).soup.triangles.size(), soup.triangles.size());
}

TEST(Repair, says_if_nothing_is_left)
{
  Mesh mesh;
  EXPECT_THROW(SMA::repair_polygon_soup_to_triangle_mesh(std::vector<Point>(), Polygons(), mesh),
               SMA::Empty_mesh_error);
  const std::vector<Point> line = {Point(0, 0, 0), Point(1, 0, 0), Point(2, 0, 0)};
  EXPECT_THROW(SMA::repair_polygon_soup_to_triangle_mesh(line, Polygons{{0, 1, 2}}, mesh), SMA::Empty_mesh_error);
  EXPECT_THROW(SMA::repair_polygon_soup_to_triangle_mesh(line, Polygons{{0, 1, 5}}, mesh), SMA::Empty_mesh_error);
}

// Whatever comes

TEST(Repair, makes_a_valid_mesh_of_any_soup)
{
  for (unsigned seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Input input;
    const std::size_t n = 3 + random() % 20, m = 1 + random() % 60;
    const int places = 1 + int(random() % 5); // along each axis: few make many coincident points
    for (std::size_t i = 0; i < n; ++i)
      input.points.emplace_back(int(random()) % places, int(random()) % places, int(random()) % places);
    for (std::size_t i = 0; i < m; ++i) {
      input.polygons.emplace_back(random() % 10 < 8 ? 3 : random() % 7);
      for (std::size_t& v : input.polygons.back()) v = random() % (random() % 50 == 0 ? n + 2 : n);
    }
    try {
      const Repaired r = repaired(input);
      EXPECT_NO_THROW(SMA::read_face_graph(SMA::Sequential_execution(), r.mesh, r.mesh.points()));
      const Repaired again = repaired(Input(r.soup));
      EXPECT_TRUE(again.report.is_valid()) << all(again.report.offences());
    } catch (const SMA::Empty_mesh_error&) {
    }
    if (HasFailure()) break;
  }
}

} // namespace test_repair

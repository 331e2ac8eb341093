// SPDX-License-Identifier: GPL-3.0-or-later
//
// What belongs to the elements of a mesh comes out of an adaptation: labels, protected edges, attributes at faces and
// corners, origins, and what lies outside of a range of faces.

#include "checks.h"
#include "policies.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/refine.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace test_carried_values {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;
using shapes::Soup;
using shapes::Vector_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;

Vector_3 vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

std::array<Vector_3, 3> corners(const Mesh& mesh, Face f)
{
  const Halfedge h = mesh.halfedge(f);
  return {vector(mesh.point(mesh.source(h))), vector(mesh.point(mesh.target(h))),
          vector(mesh.point(mesh.target(mesh.next(h))))};
}

Vector_3 centroid(const Mesh& mesh, Face f)
{
  const auto c = corners(mesh, f);
  return (c[0] + c[1] + c[2]) / 3;
}

double area(const Mesh& mesh, Face f)
{
  const auto c = corners(mesh, f);
  return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2;
}

/// Areas of the faces by a label.
template <class Map>
auto areas(const Mesh& mesh, const Map& label)
{
  std::map<typename Map::value_type, double> result;
  for (const Face f : mesh.faces()) result[label[f]] += area(mesh, f);
  return result;
}

/// The number of connected parts of the faces of each label.
template <class Map>
auto parts(const Mesh& mesh, const Map& label)
{
  std::map<typename Map::value_type, int> result;
  std::set<Face> seen;
  for (const Face first : mesh.faces()) {
    if (!seen.insert(first).second) continue;
    ++result[label[first]];
    for (std::vector<Face> open{first}; !open.empty();) {
      const Face f = open.back();
      open.pop_back();
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const Face g = mesh.face(mesh.opposite(h));
        if (g != Mesh::null_face() && label[g] == label[f] && seen.insert(g).second) open.push_back(g);
      }
    }
  }
  return result;
}

/// A plate in three pieces that meet along curved lines: labels by place.
int material(const Vector_3& p)
{
  if (p[1] > 0.6) return 7;
  return p[0] < 0.4 ? -2 : 3;
}

Mesh labelled_plate(std::size_t n, std::uint64_t seed)
{
  Soup soup = shapes::square(n, 0);
  shapes::Random random(seed);
  for (Vector_3& p : soup.points) // inner vertices of the pieces, for the borders to stay straight
    if (std::abs(p[1] - 0.6) > 1e-9 && std::abs(p[0] - 0.4) > 1e-9 && p[0] > 1e-9 && p[0] < 1 - 1e-9 && p[1] > 1e-9 &&
        p[1] < 1 - 1e-9)
      p += Vector_3(random.real(-0.2, 0.2), random.real(-0.2, 0.2), 0) / double(n);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  auto label = mesh.add_property_map<Face, int>("f:label").first;
  for (const Face f : mesh.faces()) label[f] = material(centroid(mesh, f));
  return mesh;
}

Mesh::Property_map<Face, int> label_of(Mesh& mesh) { return mesh.add_property_map<Face, int>("f:label").first; }

TEST(Labels, of_flat_pieces_keep_their_borders_exactly)
{
  for (const double size : {0.03, 0.1, 0.3}) {
    Mesh mesh = labelled_plate(10, 5);
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(size),
                                                  params::face_patch_map(label_of(mesh)));
    const auto after = areas(mesh, label_of(mesh));
    ASSERT_EQ(after.size(), 3u);
    EXPECT_NEAR(after.at(7), 0.4, 1e-12);
    EXPECT_NEAR(after.at(-2), 0.24, 1e-12);
    EXPECT_NEAR(after.at(3), 0.36, 1e-12);
    for (const Face f : mesh.faces()) EXPECT_EQ(label_of(mesh)[f], material(centroid(mesh, f)));
  }
}

/// A checkerboard of 64 labels on a sphere: octants, each in 8.
Mesh checkerboard(int level)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(level));
  auto label = label_of(mesh);
  for (const Face f : mesh.faces()) {
    const Vector_3 c = centroid(mesh, f);
    const int longitude = int((std::atan2(c[1], c[0]) / CGAL_PI + 1) * 4) % 8, latitude = int((c[2] + 1) * 4) % 8;
    label[f] = 8 * latitude + longitude;
  }
  return mesh;
}

TEST(Labels, of_a_checkerboard_stay_connected_and_as_large)
{
  const Mesh input = checkerboard(5);
  Mesh copy = input;
  const auto before = areas(copy, label_of(copy));
  const auto parts_before = parts(copy, label_of(copy));
  ASSERT_EQ(before.size(), 64u);
  const double mean = 0.038; // of its edges
  const auto check = [&](const auto& field) {
    Mesh mesh = input;
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field, params::face_patch_map(label_of(mesh)));
    EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
    const auto after = areas(mesh, label_of(mesh));
    EXPECT_EQ(parts(mesh, label_of(mesh)), parts_before);
    for (const auto& [label, area] : before) EXPECT_NEAR(after.at(label), area, 0.01 * area) << label;
  };
  for (const double factor : {1.0, 0.5, 2.0}) check(SMA::Uniform_metric_field(factor * mean));
  check(SMA::Analytic_metric_field([&](const SMA::Vector_3& p) {
    const SMA::Vector_3 n = p.normalized();
    const SMA::Vector_3 e = n.cross(std::abs(n[2]) < 0.9 ? SMA::Vector_3::UnitZ() : SMA::Vector_3::UnitX()).normalized();
    return SMA::Metric_tensor_3(SMA::Matrix_3((SMA::Matrix_3::Identity() + 3 * e * e.transpose()) / (mean * mean)));
  }));
}

/// Two planes that meet at 30 degrees where x is 0.4, with labels on both sides; edges there are in `is_ridge`.
struct Roof
{
  Roof() : mesh(labelled_plate(10, 8)), is_ridge(mesh.add_property_map<Edge, bool>("e:ridge", false).first)
  {
    for (const Vertex v : mesh.vertices()) mesh.point(v) = Point(mesh.point(v).x(), mesh.point(v).y(), height(v));
    for (const Face f : mesh.faces()) label_of(mesh)[f] = centroid(mesh, f)[0] < 0.4 ? 0 : 1;
    for (const Edge e : mesh.edges()) is_ridge[e] = is_on_ridge(mesh.vertex(e, 0)) && is_on_ridge(mesh.vertex(e, 1));
  }

  bool is_on_ridge(Vertex v) const { return std::abs(mesh.point(v).x() - 0.4) < 1e-9; }
  double height(Vertex v) const { return -std::tan(CGAL_PI / 12) * std::abs(mesh.point(v).x() - 0.4); }

  /// How far the vertices are off the planes after an adaptation.
  template <class NamedParameters>
  double largest_distance(const NamedParameters& np)
  {
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.06), np);
    double largest = 0;
    for (const Vertex v : mesh.vertices()) largest = (std::max)(largest, std::abs(mesh.point(v).z() - height(v)));
    return largest;
  }

  Mesh mesh;
  Mesh::Property_map<Edge, bool> is_ridge;
};

/// Below the feature angle edges are sharp if they are asked to be, whatever else is asked of them.
TEST(Labels, and_protected_edges_leave_the_creases_that_are_asked_for)
{
  const auto distance = [](const auto& parameters_of) {
    Roof roof;
    return roof.largest_distance(parameters_of(roof));
  };
  const auto labels = [](Roof& r) { return params::face_patch_map(label_of(r.mesh)); };
  const auto creases = [](Roof& r) { return params::edge_is_constrained_map(r.is_ridge); };
  EXPECT_GT(distance(labels), 1e-3) << "the surface is smooth there";
  EXPECT_LT(distance(creases), 1e-12);
  EXPECT_LT(distance([&](Roof& r) { return labels(r).edge_is_constrained_map(r.is_ridge); }), 1e-12);
  EXPECT_LT(distance([&](Roof& r) { return creases(r).edge_is_protected_map(r.is_ridge); }), 1e-12);
  EXPECT_LT(distance([&](Roof& r) { return labels(r).edge_is_constrained_map(r.is_ridge).edge_is_protected_map(r.is_ridge); }),
            1e-12);
  EXPECT_GT(distance([&](Roof& r) { return labels(r).edge_is_protected_map(r.is_ridge); }), 1e-3);
}

TEST(Labels, leave_no_crease_on_a_smooth_surface)
{
  Mesh plain = shapes::mesh<Mesh>(shapes::sphere(3)), labelled = plain;
  auto label = label_of(labelled);
  for (const Face f : labelled.faces()) label[f] = centroid(labelled, f)[2] > 0.1 ? 1 : 0;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(labelled, SMA::Uniform_metric_field(0.05), params::face_patch_map(label));
  double largest = 0;
  for (const Vertex v : labelled.vertices())
    largest = (std::max)(largest, std::abs(vector(labelled.point(v)).norm() - 1));
  EXPECT_LT(largest, 1e-4);
}

TEST(Labels, of_any_type_and_on_any_model)
{
  Polyhedron mesh = shapes::mesh<Polyhedron>(shapes::cube(4));
  using Face_of_polyhedron = boost::graph_traits<Polyhedron>::face_descriptor;
  const auto side = [&](Face_of_polyhedron f) {
    const auto h = halfedge(f, mesh);
    const Vector_3 c = (vector(h->vertex()->point()) + vector(h->next()->vertex()->point()) +
                        vector(h->next()->next()->vertex()->point())) / 3;
    return std::string(c[2] > c[0] + 0.01 ? "above" : "below");
  };
  std::map<Face_of_polyhedron, std::string> labels;
  double above = 0;
  const auto area_of = [](Face_of_polyhedron f) {
    const auto h = f->halfedge();
    return std::sqrt(CGAL::squared_area(h->vertex()->point(), h->next()->vertex()->point(), h->prev()->vertex()->point()));
  };
  for (const auto f : faces(mesh)) {
    labels[f] = side(f);
    if (labels[f] == "above") above += area_of(f);
  }
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(
    mesh, SMA::Uniform_metric_field(0.15), params::face_patch_map(boost::make_assoc_property_map(labels)));
  double after = 0;
  for (const auto f : faces(mesh))
    if (labels.at(f) == "above") after += area_of(f);
  EXPECT_NEAR(after, above, 1e-9 * above);
}

TEST(Labels, are_the_same_with_every_policy)
{
  std::vector<int> expected;
  for_each_policy([&](const auto& policy, const std::string&) {
    Mesh mesh = checkerboard(4);
    SMA::adapt_surface_mesh(policy, mesh, SMA::Uniform_metric_field(0.06), params::face_patch_map(label_of(mesh)));
    std::vector<int> labels;
    for (const Face f : mesh.faces()) labels.push_back(label_of(mesh)[f]);
    if (expected.empty()) expected = labels;
    EXPECT_EQ(labels, expected);
  });
}

/// The edges of `mesh` as pairs of points.
using Edge_of_points = std::pair<std::array<double, 3>, std::array<double, 3>>;

Edge_of_points points_of(const Mesh& mesh, Edge e)
{
  const auto at = [&](Vertex v) {
    const Point& p = mesh.point(v);
    return std::array<double, 3>{p.x(), p.y(), p.z()};
  };
  const auto a = at(mesh.vertex(e, 0)), b = at(mesh.vertex(e, 1));
  return a < b ? Edge_of_points(a, b) : Edge_of_points(b, a);
}

TEST(Protected_edges, come_out_as_they_were)
{
  shapes::Random random(11);
  for (int i = 0; i < 12; ++i) {
    Mesh mesh = shapes::mesh<Mesh>(i % 3 == 0 ? shapes::torus(24, 12, 0.2)
                                   : i % 3 == 1 ? shapes::open_cylinder(20, 8, 2, 0.2) : shapes::cube(4));
    auto is_protected = mesh.add_property_map<Edge, bool>("e:protected", false).first;
    std::set<Edge_of_points> before;
    for (const Edge e : mesh.edges())
      if (random.real(0, 1) < 0.15) {
        is_protected[e] = true;
        before.insert(points_of(mesh, e));
      }
    const double size = std::array{0.08, 0.3, 1.0}[std::size_t(i / 4)];
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(
      mesh, SMA::Uniform_metric_field(size), params::edge_is_constrained_map(is_protected).protect_constraints(true));
    EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
    std::set<Edge_of_points> after;
    for (const Edge e : mesh.edges())
      if (is_protected[e]) after.insert(points_of(mesh, e));
    EXPECT_EQ(after, before) << i;
  }
}

TEST(Protected_edges, are_followed_by_the_sizes_beside_them)
{
  const auto mean_quality_at_boundary = [](double gradation) {
    Mesh mesh = shapes::mesh<Mesh>(shapes::square(40, 0));
    auto is_protected = mesh.add_property_map<Edge, bool>("e:protected", false).first;
    for (const Edge e : mesh.edges()) is_protected[e] = mesh.is_border(e);
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.1),
                                                  params::edge_is_constrained_map(is_protected)
                                                    .protect_constraints(true)
                                                    .protected_gradation(gradation));
    double sum = 0, n = 0;
    for (const Face f : mesh.faces()) {
      const auto c = corners(mesh, f);
      bool is_beside = false;
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
        is_beside = is_beside || mesh.is_border(mesh.edge(h));
      if (!is_beside) continue;
      sum += checks::quality(c[0], c[1], c[2]);
      ++n;
    }
    return sum / n;
  };
  EXPECT_GT(mean_quality_at_boundary(1.5), 0.87);
  EXPECT_LT(mean_quality_at_boundary(0), 0.75);
}

TEST(Protected_edges, leave_no_face_without_area_however_long_they_are)
{
  shapes::Random random(7);
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    Mesh mesh = shapes::mesh<Mesh>(i % 2 == 0 ? shapes::torus(10, 6, 0.2) : shapes::cube(2));
    auto is_protected = mesh.add_property_map<Edge, bool>("e:protected", false).first;
    for (const Edge e : mesh.edges()) is_protected[e] = random.real(0, 1) < 0.2;
    const auto report = SMA::adapt_surface_mesh<CGAL::Sequential_tag>(
      mesh, SMA::Uniform_metric_field(i % 4 < 2 ? 0.1 : 0.04),
      params::edge_is_constrained_map(is_protected).protect_constraints(true).protected_gradation(0));
    EXPECT_GT(report.final.min_quality, 0.005);
    EXPECT_GT(report.final.in_range, 0.75); // they are long themselves, and so are those around them
  }
}

/// Two charts on a cylinder cut along two lines, with texture coordinates of their own.
using Uv = CGAL::Point_2<Kernel>;

Uv uv_of(const Vector_3& p, bool is_first)
{
  double angle = std::atan2(p[1], p[0]);
  if (is_first ? angle < -1 : angle < 1e-6) angle += 2 * CGAL_PI; // up to rounding at the seams
  return is_first ? Uv(angle, p[2]) : Uv(10 + angle / 2, 5 - p[2]);
}

TEST(Corner_attributes, keep_both_sides_of_seams)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::open_cylinder(32, 8, 2));
  auto uv = mesh.add_property_map<Halfedge, Uv>("h:uv").first;
  const auto is_first = [&](Face f) { return centroid(mesh, f)[1] > 0; };
  for (const Face f : mesh.faces())
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      uv[h] = uv_of(vector(mesh.point(mesh.target(h))), is_first(f));
  for (const double size : {0.07, 0.4}) {
    Mesh adapted = mesh;
    auto map = adapted.add_property_map<Halfedge, Uv>("h:uv").first;
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(
      adapted, SMA::Uniform_metric_field(size),
      params::halfedge_attribute_maps(std::make_tuple(map)));
    for (const Face f : adapted.faces()) {
      const bool side = centroid(adapted, f)[1] > 0;
      for (const Halfedge h : adapted.halfedges_around_face(adapted.halfedge(f))) {
        const Vector_3 p = vector(adapted.point(adapted.target(h)));
        EXPECT_GT(side ? p[1] : -p[1], -1e-7); // no face lies across a seam
        const Uv expected = uv_of(p, side);
        EXPECT_NEAR(map[h].x(), expected.x(), 1e-3);
        EXPECT_NEAR(map[h].y(), expected.y(), 1e-3);
      }
    }
  }
}

TEST(Corner_attributes, of_flat_charts_are_exact)
{
  Mesh mesh = labelled_plate(10, 9);
  auto uv = mesh.add_property_map<Halfedge, Uv>("h:uv").first;
  const auto at = [](const Vector_3& p) {
    const int m = material(p);
    return [m](const Vector_3& q) { return Uv(m + 2 * q[0] - q[1], q[1] * m); };
  };
  for (const Face f : mesh.faces())
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      uv[h] = at(centroid(mesh, f))(vector(mesh.point(mesh.target(h))));
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.04),
                                                params::halfedge_attribute_maps(std::make_tuple(uv)));
  for (const Face f : mesh.faces())
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const Uv expected = at(centroid(mesh, f))(vector(mesh.point(mesh.target(h))));
      EXPECT_NEAR(uv[h].x(), expected.x(), 1e-12);
      EXPECT_NEAR(uv[h].y(), expected.y(), 1e-12);
    }
}

TEST(Face_attributes, are_those_below_the_centre)
{
  Mesh mesh = labelled_plate(10, 3);
  auto value = mesh.add_property_map<Face, double>("f:value").first;
  auto origin = mesh.add_property_map<Face, int>("f:origin").first;
  const Mesh before = mesh;
  for (const Face f : mesh.faces()) value[f] = double(f) / 3;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.05),
                                                params::face_attribute_maps(std::make_tuple(value))
                                                  .face_origin_map(origin));
  for (const Face f : mesh.faces()) {
    const Face below{Mesh::size_type(origin[f])};
    EXPECT_EQ(value[f], double(below) / 3);
    const auto c = corners(before, below);
    const Vector_3 p = centroid(mesh, f);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_GT((c[(i + 1) % 3] - c[i]).cross(p - c[i])[2], -1e-4); // the walk ends within a hundredth of the size
  }
}

TEST(Origins, name_the_vertices_that_are_still_there)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::cube(3));
  auto name = mesh.add_property_map<Vertex, std::string>("v:name").first;
  mesh.add_property_map<Vertex, std::array<int, 5>>("v:unknown"); // of a type that is not kept
  for (const Vertex v : mesh.vertices()) name[v] = "vertex " + std::to_string(v);
  auto origin = mesh.add_property_map<Vertex, Vertex>("v:origin").first;
  auto number = mesh.add_property_map<Vertex, std::size_t>("v:number").first;
  const Mesh before = mesh;
  SMA::refine<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.2), params::vertex_origin_map(origin));
  std::size_t n = 0;
  for (const Vertex v : mesh.vertices()) {
    if (origin[v] == Mesh::null_vertex()) {
      EXPECT_EQ(name[v], "");
      continue;
    }
    ++n;
    EXPECT_EQ(mesh.point(v), before.point(origin[v]));
    EXPECT_EQ(name[v], "vertex " + std::to_string(origin[v])); // which nobody passed
  }
  EXPECT_EQ(n, before.number_of_vertices());
  Mesh again = before;
  number = again.add_property_map<Vertex, std::size_t>("v:number").first;
  SMA::refine<CGAL::Sequential_tag>(again, SMA::Uniform_metric_field(0.2), params::vertex_origin_map(number));
  std::set<std::size_t> numbers;
  for (const Vertex v : again.vertices()) numbers.insert(number[v]);
  EXPECT_EQ(numbers.size(), before.number_of_vertices() + 1); // and that of new ones
  EXPECT_EQ(numbers.count(std::size_t(-1)), 1u);
}

TEST(Origins, do_not_bring_back_what_the_run_has_written)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(3));
  auto normal = mesh.add_property_map<Vertex, Kernel::Vector_3>("v:normal").first;
  for (const Vertex v : mesh.vertices()) normal[v] = mesh.point(v) - CGAL::ORIGIN;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(0.15), params::vertex_normal_map(normal));
  for (const Vertex v : mesh.vertices()) { // which have moved
    const Vector_3 n(normal[v].x(), normal[v].y(), normal[v].z());
    EXPECT_LT((n - vector(mesh.point(v)).normalized()).norm(), 5e-3);
  }
}

/// All that a selection must leave alone.
struct Outside
{
  std::map<Face, std::array<Vertex, 3>> faces;
  std::map<Vertex, Point> points;
  std::map<Vertex, int> values;
  std::map<Edge, int> values_of_edges;

  friend bool operator==(const Outside& a, const Outside& b)
  {
    return a.faces == b.faces && a.points == b.points && a.values == b.values && a.values_of_edges == b.values_of_edges;
  }
};

Outside outside(Mesh& mesh, const std::vector<Face>& rest)
{
  Outside result;
  const auto value = mesh.add_property_map<Vertex, int>("v:value").first;
  const auto value_of_edge = mesh.add_property_map<Edge, int>("e:value").first;
  for (const Face f : rest) {
    const Halfedge h = mesh.halfedge(f);
    result.faces[f] = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
    for (const Halfedge g : mesh.halfedges_around_face(h)) {
      const Vertex v = mesh.target(g);
      result.points[v] = mesh.point(v);
      result.values[v] = value[v];
      result.values_of_edges[mesh.edge(g)] = value_of_edge[mesh.edge(g)];
    }
  }
  return result;
}

TEST(Range_of_faces, leaves_the_rest_as_it_is)
{
  shapes::Random random(21);
  for (int i = 0; i < 30; ++i) {
    Mesh mesh = shapes::mesh<Mesh>(i % 3 == 0 ? shapes::torus(32, 16, 0.2)
                                   : i % 3 == 1 ? shapes::open_cylinder(24, 10, 2, 0.2) : shapes::cube(6));
    auto value = mesh.add_property_map<Vertex, int>("v:value").first;
    auto value_of_edge = mesh.add_property_map<Edge, int>("e:value").first;
    for (const Vertex v : mesh.vertices()) value[v] = int(v) + 1;
    for (const Edge e : mesh.edges()) value_of_edge[e] = int(e) + 1;
    // a ball, with holes and islands: faces near a random vertex, some of them at random
    const Vector_3 centre = vector(mesh.point(Vertex(Mesh::size_type(random.below(mesh.number_of_vertices())))));
    const double radius = random.real(0.3, 1.2), share = i % 2 == 0 ? 1 : 0.7;
    std::vector<Face> selected, rest;
    for (const Face f : mesh.faces())
      ((centroid(mesh, f) - centre).norm() < radius && random.real(0, 1) < share ? selected : rest).push_back(f);
    if (selected.empty()) selected.push_back(rest.back()), rest.pop_back();
    const auto topology = checks::topology(shapes::soup(mesh));
    const Outside before = outside(mesh, rest);
    const double size = std::array{0.06, 0.15, 0.6}[std::size_t(i / 10)];
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(selected, mesh, SMA::Uniform_metric_field(size));
    EXPECT_TRUE(mesh.is_valid(false)) << i;
    EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh)) << i;
    EXPECT_EQ(outside(mesh, rest), before) << i;
    mesh.collect_garbage();
    EXPECT_TRUE(checks::is_manifold(shapes::soup(mesh))) << i;
    EXPECT_EQ(checks::topology(shapes::soup(mesh)), topology) << i;
  }
}

TEST(Range_of_faces, knows_where_its_elements_come_from)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(3));
  const Mesh before = mesh;
  std::vector<Face> selected;
  for (const Face f : mesh.faces())
    if (centroid(mesh, f)[2] > 0.3) selected.push_back(f);
  auto vertex = mesh.add_property_map<Vertex, int>("v:origin", -2).first;
  auto face = mesh.add_property_map<Face, int>("f:origin", -2).first;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(selected, mesh, SMA::Uniform_metric_field(0.06),
                                                params::vertex_origin_map(vertex).face_origin_map(face));
  std::size_t n = 0;
  for (const Vertex v : mesh.vertices()) {
    if (vertex[v] < 0) continue; // those outside keep what they had
    ++n;
    EXPECT_EQ(Vertex(Mesh::size_type(vertex[v])), v);
  }
  EXPECT_GT(n, 0u);
  for (const Face f : mesh.faces()) {
    if (face[f] == -2) continue;
    const Vector_3 at = centroid(before, Face(Mesh::size_type(face[f])));
    EXPECT_LT((centroid(mesh, f) - at).norm(), 0.15);
    EXPECT_GT(at[2], 0.3);
  }
}

TEST(Range_of_faces, conforms_inside)
{
  Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(4));
  std::vector<Face> selected;
  for (const Face f : mesh.faces())
    if (centroid(mesh, f)[2] > 0) selected.push_back(f);
  auto is_new = mesh.add_property_map<Face, bool>("f:selected", false).first;
  for (const Face f : selected) is_new[f] = true;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(selected, mesh, SMA::Uniform_metric_field(0.03),
                                                params::face_attribute_maps(std::make_tuple(is_new)));
  double n = 0, in_range = 0, largest = 0;
  for (const Edge e : mesh.edges()) {
    const Vector_3 a = vector(mesh.point(mesh.vertex(e, 0))), b = vector(mesh.point(mesh.vertex(e, 1)));
    if (a[2] < 0.3 || b[2] < 0.3) continue; // near the border sizes follow that
    ++n;
    in_range += (a - b).norm() > 0.03 / std::sqrt(2.0) && (a - b).norm() < 0.03 * std::sqrt(2.0);
    largest = (std::max)({largest, std::abs(a.norm() - 1)});
  }
  EXPECT_GT(in_range, 0.97 * n);
  EXPECT_LT(largest, 1e-4);
  std::size_t n_new = 0;
  for (const Face f : mesh.faces()) n_new += is_new[f];
  EXPECT_GT(n_new, 3 * selected.size());
}

TEST(Range_of_faces, of_other_models_and_by_single_kernels)
{
  Polyhedron mesh = shapes::mesh<Polyhedron>(shapes::torus(24, 12, 0.2));
  std::vector<boost::graph_traits<Polyhedron>::face_descriptor> selected;
  std::set<std::array<double, 3>> outside;
  const auto array = [](const Point& p) { return std::array<double, 3>{p.x(), p.y(), p.z()}; };
  for (const auto f : faces(mesh)) {
    if (f->halfedge()->vertex()->point().x() > 0) selected.push_back(f);
    else outside.insert(array(f->halfedge()->vertex()->point()));
  }
  const std::size_t before = mesh.size_of_vertices();
  const std::size_t split = SMA::refine<CGAL::Sequential_tag>(selected, mesh, SMA::Uniform_metric_field(0.1));
  EXPECT_GT(split, 0u);
  EXPECT_EQ(mesh.size_of_vertices(), before + split);
  EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
  std::set<std::array<double, 3>> after;
  for (const auto v : vertices(mesh)) after.insert(array(v->point()));
  for (const auto& p : outside) EXPECT_EQ(after.count(p), 1u);
}

TEST(Chosen_field, is_the_one_that_a_variant_holds)
{
  using Chosen = std::variant<SMA::Uniform_metric_field, SMA::Curvature_metric_field>;
  const auto adapted = [](const auto& field) {
    Mesh mesh = shapes::mesh<Mesh>(shapes::sphere(2));
    SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field);
    return shapes::soup(mesh);
  };
  EXPECT_TRUE(checks::is_identical(adapted(Chosen(SMA::Uniform_metric_field(0.2))),
                                   adapted(SMA::Uniform_metric_field(0.2))));
  EXPECT_TRUE(checks::is_identical(adapted(Chosen(SMA::Curvature_metric_field(0.01))),
                                   adapted(SMA::Curvature_metric_field(0.01))));
}

} // namespace test_carried_values

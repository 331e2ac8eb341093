// SPDX-License-Identifier: GPL-3.0-or-later
//
// What belongs to the elements of a mesh comes out of an adaptation of every model of the face graph, with every
// policy, and the same to the bit wherever coordinates are the same.

#include "archetypes.h"
#include "checks.h"
#include "models.h"
#include "policies.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_carried_models {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;
using shapes::Soup;
using shapes::Vector_3;

/// Where the points of a model are.
template <class TriangleMesh>
auto points_of(TriangleMesh& m)
{
  return get(CGAL::vertex_point, m);
}

auto points_of(archetypes::Graph&) { return archetypes::Map<archetypes::Graph::Vertex, models::Kernel::Point_3>(); }

/// A face of a mesh with all that it and its corners have, from its least corner on.
using Record = std::array<double, 24>;

/// A mesh with maps for everything that is carried.
template <class TriangleMesh>
struct Carrier
{
  using Traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Traits::vertex_descriptor;
  using Halfedge = typename Traits::halfedge_descriptor;
  using Face = typename Traits::face_descriptor;

  TriangleMesh graph;
  decltype(points_of(std::declval<TriangleMesh&>())) points = points_of(graph);
  archetypes::Map<Face, int> label;
  archetypes::Map<typename Traits::edge_descriptor, bool> is_protected;
  archetypes::Map<Vertex, double> at_vertices;
  archetypes::Map<Face, double> at_faces;
  archetypes::Map<Halfedge, double> at_corners;
  archetypes::Map<Vertex, int> vertex_origin;
  archetypes::Map<Face, int> face_origin;
  std::vector<std::pair<Face, Record>> outside; ///< of the range that is adapted, before that

  explicit Carrier(const Soup& soup) { shapes::add_to(graph, points, soup); }
  Carrier(const Carrier&) = delete; // the points belong to the graph
  Carrier& operator=(const Carrier&) = delete;

  Vector_3 point(Vertex v) const
  {
    const auto& p = get(points, v);
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  std::array<Halfedge, 3> sides(Face f) const
  {
    const Halfedge h = halfedge(f, graph);
    return {h, next(h, graph), prev(h, graph)};
  }

  Vector_3 centroid(Face f) const
  {
    Vector_3 sum = Vector_3::Zero();
    for (const Halfedge h : sides(f)) sum += point(target(h, graph));
    return sum / 3;
  }

  double area(Face f) const
  {
    const auto h = sides(f);
    const Vector_3 a = point(target(h[0], graph));
    return (point(target(h[1], graph)) - a).cross(point(target(h[2], graph)) - a).norm() / 2;
  }

  auto parameters() const
  {
    return params::vertex_point_map(points)
      .face_patch_map(label)
      .edge_is_protected_map(is_protected)
      .vertex_attribute_maps(std::make_tuple(at_vertices))
      .face_attribute_maps(std::make_tuple(at_faces))
      .halfedge_attribute_maps(std::make_tuple(at_corners))
      .vertex_origin_map(vertex_origin)
      .face_origin_map(face_origin);
  }

  Record record(Face f) const
  {
    std::array<Halfedge, 3> h = sides(f);
    const auto is_less = [&](Halfedge g, Halfedge k) {
      const Vector_3 p = point(target(g, graph)), q = point(target(k, graph));
      return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    };
    std::rotate(h.begin(), std::min_element(h.begin(), h.end(), is_less), h.end());
    Record r;
    auto out = r.begin();
    for (const Halfedge g : h) {
      const Vertex v = target(g, graph);
      const Vector_3 p = point(v);
      for (const double x : {p[0], p[1], p[2], get(at_vertices, v), get(at_corners, g),
                             double(get(vertex_origin, v)), double(get(is_protected, edge(g, graph)))})
        *out++ = x;
    }
    for (const double x : {double(get(label, f)), get(at_faces, f), double(get(face_origin, f))}) *out++ = x;
    return r;
  }

  /// All faces, in an order that is that of no model.
  std::vector<Record> records() const
  {
    std::vector<Record> result;
    for (const Face f : faces(graph)) result.push_back(record(f));
    std::sort(result.begin(), result.end());
    return result;
  }
};

template <class TriangleMesh>
class Carried : public ::testing::Test
{
protected:
  static constexpr bool is_single = std::is_same_v<TriangleMesh, models::Single_precision_mesh>;
  static constexpr double rounding = is_single ? 1e-6 : 1e-12; ///< of coordinates below 2

  /// Calls `adapt(policy, carrier)`, which prepares and adapts a mesh, with each policy; expects the same of all, and
  /// of the reference model, and calls `check(carrier)` with the first.
  template <class Adapt, class Check>
  static void expect_everywhere_the_same(const Soup& soup, const Adapt& adapt, const Check& check)
  {
    std::vector<Record> expected;
    Soup expected_soup;
    for_each_policy([&](const auto& policy, const std::string& name) {
      Carrier<TriangleMesh> carrier(soup);
      adapt(policy, carrier);
      ASSERT_TRUE(CGAL::is_valid_polygon_mesh(carrier.graph)) << name;
      const Soup result = shapes::soup(carrier.graph, carrier.points);
      if (expected.empty()) {
        check(carrier);
        expected = carrier.records();
        expected_soup = result;
      }
      EXPECT_TRUE(carrier.records() == expected) << name;
      EXPECT_TRUE(checks::is_identical(result, expected_soup)) << name << ": another order";
    });
    if (is_single) return;
    Carrier<models::Reference> reference(soup);
    adapt(SMA::Sequential_execution(), reference);
    EXPECT_TRUE(reference.records() == expected);
  }
};

using Models = ::testing::Types<models::Surface_mesh, models::Exact_mesh, models::Single_precision_mesh,
                                models::Polyhedron, models::Cell_complex, archetypes::Graph>;
TYPED_TEST_SUITE(Carried, Models, );

/// Three pieces of the unit square, by place.
int material(const Vector_3& p)
{
  if (p[1] > 0.6) return 7;
  return p[0] < 0.4 ? -2 : 3;
}

/// Values at corners jump between the pieces.
double value_in(int material, const Vector_3& p) { return material + 2 * p[0] - p[1]; }

TYPED_TEST(Carried, labels_attributes_and_origins)
{
  const auto adapt = [](const auto& policy, auto& c) {
    for (const auto v : vertices(c.graph)) put(c.at_vertices, v, c.point(v)[0] - 3 * c.point(v)[1]);
    int n = 0;
    for (const auto f : faces(c.graph)) {
      put(c.label, f, material(c.centroid(f)));
      put(c.at_faces, f, n++ / 3.0);
      for (const auto h : c.sides(f)) put(c.at_corners, h, value_in(get(c.label, f), c.point(target(h, c.graph))));
    }
    SMA::adapt_surface_mesh(policy, c.graph, SMA::Uniform_metric_field(0.025), c.parameters());
  };
  const double precision = TestFixture::rounding;
  this->expect_everywhere_the_same(shapes::square(20), adapt, [&](const auto& c) {
    std::map<int, double> area;
    for (const auto f : faces(c.graph)) {
      const int label = get(c.label, f);
      area[label] += c.area(f);
      EXPECT_EQ(label, material(c.centroid(f)));
      EXPECT_EQ(get(c.at_faces, f), get(c.face_origin, f) / 3.0);
      for (const auto h : c.sides(f)) {
        const auto v = target(h, c.graph);
        EXPECT_NEAR(get(c.at_corners, h), value_in(label, c.point(v)), 10 * precision);
        EXPECT_NEAR(get(c.at_vertices, v), c.point(v)[0] - 3 * c.point(v)[1], 10 * precision);
      }
    }
    ASSERT_EQ(area.size(), 3u);
    EXPECT_NEAR(area[7], 0.4, precision);
    EXPECT_NEAR(area[-2], 0.24, precision);
    EXPECT_NEAR(area[3], 0.36, precision);
    for (const auto v : vertices(c.graph)) {
      const Vector_3 p = c.point(v);
      if (p == Vector_3(0, 0, 0)) {
        EXPECT_EQ(get(c.vertex_origin, v), 0);
      }
      if (p == Vector_3(1, 1, 0)) {
        EXPECT_EQ(get(c.vertex_origin, v), 21 * 21 - 1);
      }
    }
  });
}

/// Protects edges here and there: the same on every model.
template <class C>
void protect_some(C& c)
{
  for (const auto e : edges(c.graph)) {
    const Vector_3 middle = (c.point(source(e, c.graph)) + c.point(target(e, c.graph))) / 2;
    put(c.is_protected, e, std::sin(50 * middle[0] + 70 * middle[1] + 90 * middle[2]) > 0.8);
  }
}

/// The protected edges as pairs of points.
template <class C>
auto protected_edges(const C& c)
{
  std::set<std::set<std::array<double, 3>>> result;
  for (const auto e : edges(c.graph)) {
    const Vector_3 a = c.point(source(e, c.graph)), b = c.point(target(e, c.graph));
    if (get(c.is_protected, e)) result.insert({{a[0], a[1], a[2]}, {b[0], b[1], b[2]}});
  }
  return result;
}

TYPED_TEST(Carried, protected_edges)
{
  for (const Soup& soup : {shapes::cube(4), shapes::open_cylinder(20, 8, 2, 0.2)}) {
    Carrier<TypeParam> before(soup);
    protect_some(before);
    ASSERT_GT(protected_edges(before).size(), 20u);
    const auto adapt = [](const auto& policy, auto& c) {
      protect_some(c);
      SMA::adapt_surface_mesh(policy, c.graph, SMA::Uniform_metric_field(0.08), c.parameters());
    };
    this->expect_everywhere_the_same(soup, adapt, [&](const auto& c) {
      EXPECT_EQ(protected_edges(c), protected_edges(before));
      EXPECT_GT(num_faces(c.graph), 2 * num_faces(before.graph));
    });
  }
}

TYPED_TEST(Carried, what_is_outside_of_a_range)
{
  const Soup soup = shapes::torus(32, 16, 0.2);
  const auto is_inside = [](const Vector_3& p) { return p[0] > 0.2; };
  const auto adapt = [&](const auto& policy, auto& c) {
    int n = 0;
    for (const auto v : vertices(c.graph)) {
      put(c.vertex_origin, v, n++);
      put(c.at_vertices, v, c.point(v)[2]);
    }
    std::vector<typename std::decay_t<decltype(c)>::Face> inside;
    for (const auto f : faces(c.graph)) {
      put(c.label, f, c.centroid(f)[2] > 0 ? 1 : 2);
      put(c.at_faces, f, c.centroid(f)[1]);
      put(c.face_origin, f, -2);
      for (const auto h : c.sides(f)) put(c.at_corners, h, 1 / c.point(target(h, c.graph)).norm());
      if (is_inside(c.centroid(f))) inside.push_back(f);
    }
    for (const auto f : faces(c.graph))
      if (!is_inside(c.centroid(f))) c.outside.emplace_back(f, c.record(f));
    SMA::adapt_surface_mesh(policy, inside, c.graph, SMA::Uniform_metric_field(0.05), c.parameters());
  };
  this->expect_everywhere_the_same(soup, adapt, [&](const auto& c) {
    for (const auto& [f, record] : c.outside) EXPECT_TRUE(c.record(f) == record);
    EXPECT_GT(num_faces(c.graph), c.outside.size() + 1000);
    EXPECT_EQ(checks::topology(shapes::soup(c.graph, c.points)), checks::topology(soup));
    for (const auto f : faces(c.graph)) {
      if (get(c.face_origin, f) == -2) continue;
      EXPECT_LT(std::size_t(get(c.face_origin, f)), soup.triangles.size());
      const double z = c.centroid(f)[2];
      if (std::abs(z) > 0.05) {
        EXPECT_EQ(get(c.label, f), z > 0 ? 1 : 2);
      }
    }
  });
}

} // namespace test_carried_models

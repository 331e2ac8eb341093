// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adaptation of other meshes than `Surface_mesh<Simple_cartesian<double>::Point_3>`.

#include "checks.h"
#include "models.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <gtest/gtest.h>

#include <set>
#include <unordered_map>

namespace test_adapt_models {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Soup;
using shapes::Vector_3;

template <class TriangleMesh>
class Model : public ::testing::Test
{};

using Models = ::testing::Types<models::Surface_mesh, models::Exact_mesh, models::Single_precision_mesh,
                                models::Polyhedron, models::Cell_complex>;
TYPED_TEST_SUITE(Model, Models, );

TYPED_TEST(Model, is_adapted_as_any_other)
{
  for (const Soup& before : {shapes::torus(24, 12, 0.2), shapes::open_cylinder(20, 6, 2, 0.2), shapes::cube(4)})
    for (const double size : {0.4, 0.1}) {
      auto mesh = shapes::mesh<TypeParam>(before);
      const auto report = SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, SMA::Uniform_metric_field(size));
      const Soup after = shapes::soup(mesh);
      ASSERT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
      ASSERT_TRUE(checks::is_manifold(after));
      EXPECT_EQ(checks::topology(after), checks::topology(before));
      EXPECT_EQ(report.final.vertices, after.points.size());
      // the work is done in doubles: only the coordinates are rounded, before and after
      const Soup rounded{shapes::soup(shapes::mesh<TypeParam>(before)).points, before.triangles};
      auto reference = shapes::mesh<models::Reference>(rounded);
      SMA::adapt_surface_mesh<CGAL::Sequential_tag>(reference, SMA::Uniform_metric_field(size));
      const Soup expected = shapes::soup(reference);
      ASSERT_EQ(after.points.size(), expected.points.size());
      for (std::size_t v = 0; v < after.points.size(); ++v)
        EXPECT_LT((after.points[v] - expected.points[v]).norm(), 1e-6);
    }
}

TYPED_TEST(Model, has_its_constraints_marked_again)
{
  using Edge = typename boost::graph_traits<TypeParam>::edge_descriptor;
  using Vertex = typename boost::graph_traits<TypeParam>::vertex_descriptor;
  auto mesh = shapes::mesh<TypeParam>(shapes::cube(4));
  const auto point = [&](Vertex v) {
    const auto& p = get(CGAL::vertex_point, mesh, v);
    return Vector_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  };
  const auto is_at_corner = [&](Vertex v) { return point(v).cwiseAbs().sum() == 3; };
  const auto lies_on_ridge = [&](Edge e) {
    constexpr double rounding = 1e-12;
    const Vector_3 p = point(source(e, mesh)), q = point(target(e, mesh));
    return ((p.array().abs() - 1).abs() < rounding && (p - q).array().abs() < rounding).count() == 2;
  };
  std::set<Edge> edge_set;
  std::set<Vertex> vertex_set;
  CGAL::Boolean_property_map<std::set<Edge>> edge_map(edge_set);
  CGAL::Boolean_property_map<std::set<Vertex>> vertex_map(vertex_set);
  for (const auto v : vertices(mesh))
    if (is_at_corner(v)) put(vertex_map, v, true);
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(
    mesh, SMA::Uniform_metric_field(0.3),
    SMA::parameters::edge_is_constrained_map(edge_map).vertex_is_constrained_map(vertex_map));

  std::size_t ridges = 0, corners = 0;
  for (const auto e : edges(mesh)) {
    EXPECT_EQ(get(edge_map, e), lies_on_ridge(e));
    if (get(edge_map, e)) ++ridges;
  }
  for (const auto v : vertices(mesh)) {
    EXPECT_EQ(get(vertex_map, v), is_at_corner(v));
    if (get(vertex_map, v)) ++corners;
  }
  EXPECT_GE(ridges, 12 * 5u);
  EXPECT_EQ(corners, 8u);
}

TYPED_TEST(Model, takes_sizes_from_a_map_and_gives_the_metric_back)
{
  using Vertex = typename boost::graph_traits<TypeParam>::vertex_descriptor;
  auto mesh = shapes::mesh<TypeParam>(shapes::sphere(2));
  std::unordered_map<Vertex, double> sizes;
  std::unordered_map<Vertex, SMA::Metric_tensor_3> metrics;
  for (const auto v : vertices(mesh)) sizes[v] = CGAL::to_double(get(CGAL::vertex_point, mesh, v).z()) > 0 ? 0.1 : 0.3;
  SMA::adapt_surface_mesh<CGAL::Sequential_tag>(
    mesh, boost::make_assoc_property_map(sizes),
    SMA::parameters::output_metric_map(boost::make_assoc_property_map(metrics)));
  for (const auto v : vertices(mesh)) {
    ASSERT_EQ(metrics.count(v), 1u);
    const double size = 1 / std::sqrt(metrics[v][0]);
    const double z = CGAL::to_double(get(CGAL::vertex_point, mesh, v).z());
    if (std::abs(z) > 0.33) { // longer than any edge: the sizes there are not mixed
      EXPECT_NEAR(size, z > 0 ? 0.1 : 0.3, 1e-6);
    }
  }
}

} // namespace test_adapt_models

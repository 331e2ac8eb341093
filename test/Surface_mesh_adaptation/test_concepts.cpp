// SPDX-License-Identifier: GPL-3.0-or-later
//
// The functions ask their arguments for no more than the concepts say, and say themselves what is no model.

#include "archetypes.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/estimate_vertex_jets.h>
#include <CGAL/Surface_mesh_adaptation/refine.h>
#include <CGAL/Surface_mesh_adaptation/regularize.h>
#include <CGAL/Surface_mesh_adaptation/relocate.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>
#include <CGAL/Surface_mesh_adaptation/swap.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

namespace test_concepts {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace parameters = SMA::parameters;
using archetypes::Constant;
using archetypes::Counter;
using archetypes::Execution;
using archetypes::Graph;
using archetypes::Map;
using archetypes::Reconstruction;
using archetypes::Visitor;
using Kernel = CGAL::Simple_cartesian<double>;
using Vertex = Graph::Vertex;
using Edge = Graph::Edge;

/// The surface of a cube with sides of length 2.
struct Cube
{
  Graph graph;
  Map<Vertex, Kernel::Point_3> points;

  Cube() { shapes::add_to(graph, points, shapes::cube(3)); }

  double area() const
  {
    double sum = 0;
    for (const auto f : faces(graph)) {
      const auto h = halfedge(f, graph);
      sum += std::sqrt(CGAL::squared_area(get(points, source(h, graph)), get(points, target(h, graph)),
                                          get(points, target(next(h, graph), graph))));
    }
    return sum;
  }
};

TEST(Concepts, archetypes_are_adapted)
{
  Cube cube;
  Visitor visitor;
  std::size_t metrics = 0;
  const auto report = SMA::adapt_surface_mesh(
    Execution::make(), cube.graph, Constant<Vertex, double>(0.4),
    parameters::vertex_point_map(cube.points)
      .edge_is_constrained_map(Constant<Edge, bool>(false))
      .vertex_is_constrained_map(Constant<Vertex, bool>(false))
      .vertex_shape_operator_map(Constant<Vertex, SMA::Metric_tensor_3>(SMA::Metric_tensor_3(0, 0, 0, 0, 0, 0)))
      .vertex_normal_map(Constant<Vertex, Kernel::Vector_3>(Kernel::Vector_3(0, 0, 1)))
      .output_metric_map(Counter<Vertex, SMA::Metric_tensor_3>(metrics))
      .vertex_attribute_maps(std::make_tuple(Map<Vertex, double>()))
      .surface_reconstruction(Reconstruction())
      .visitor(std::ref(visitor)));
  EXPECT_GT(report.final.in_range, 0.9);
  EXPECT_EQ(report.final.vertices, num_vertices(cube.graph));
  EXPECT_EQ(report.execution, "backwards");
  EXPECT_EQ(metrics, num_vertices(cube.graph));
  EXPECT_EQ(visitor.rounds, report.rounds);
  EXPECT_NEAR(cube.area(), 24, 1e-9);
}

TEST(Concepts, archetypes_go_through_each_kernel)
{
  Cube cube;
  const Execution execution = Execution::make();
  const Constant<Vertex, double> size(0.4);
  const auto np = parameters::vertex_point_map(cube.points).surface_reconstruction(Reconstruction());
  const std::size_t before = num_vertices(cube.graph);
  const std::size_t splits = SMA::refine(execution, cube.graph, size, np);
  EXPECT_GT(splits, 0u);
  EXPECT_EQ(num_vertices(cube.graph), before + splits);
  SMA::swap(execution, cube.graph, size, np);
  SMA::regularize(execution, cube.graph, size, np);
  SMA::relocate(execution, cube.graph, size, np);
  const std::size_t removed = SMA::simplify(execution, cube.graph, Constant<Vertex, double>(4), np);
  EXPECT_GT(removed, 0u);
  EXPECT_LE(num_vertices(cube.graph), before + splits - removed);
  EXPECT_NEAR(cube.area(), 24, 1e-9);
}

TEST(Concepts, archetypes_have_jets)
{
  const Cube cube;
  const Map<Vertex, Kernel::Vector_3> normals;
  SMA::estimate_vertex_jets(Execution::make(), cube.graph,
                            parameters::vertex_point_map(cube.points).vertex_normal_map(normals));
  for (const Vertex v : vertices(cube.graph)) EXPECT_NEAR(get(normals, v).squared_length(), 1, 1e-12);
}

namespace internal = SMA::internal;
struct Nothing
{};
struct Nameless_execution
{
  int concurrency() const { return 1; }
  template <class Task>
  void run(std::size_t, const Task&) const
  {}
};
struct Endless_visitor
{
  void round_begins(std::size_t, std::size_t) {}
  void kernel_done(const SMA::Kernel_report&) {}
  void round_done(std::size_t, const SMA::Mesh_statistics&) {}
};
struct Curveless_reconstruction
{
  static SMA::Surface_point evaluate(const SMA::Patch&, double, double) { return {}; }
};
using Points = Map<Vertex, Kernel::Point_3>;
using Formula = SMA::Metric_tensor_3 (*)(const SMA::Vector_3&);

static_assert(internal::is_mutable_face_graph<Graph>);
static_assert(!internal::is_mutable_face_graph<const Graph>);
static_assert(!internal::is_mutable_face_graph<Nothing>);
static_assert(!internal::is_face_list_graph<int>);

static_assert(internal::is_metric_field<SMA::Uniform_metric_field, Graph>);
static_assert(internal::is_metric_field<Map<Vertex, SMA::Metric_tensor_3>, Graph>);
static_assert(internal::is_metric_field<SMA::Solution_metric_field<Map<Vertex, float>>, Graph>);
static_assert(internal::is_metric_field<SMA::Analytic_metric_field<Formula>, Graph>);
static_assert(internal::is_metric_field<
  SMA::Intersection_metric_field<SMA::Curvature_metric_field, Constant<Vertex, double>>, Graph>);
static_assert(!internal::is_metric_field<double, Graph>);
static_assert(!internal::is_metric_field<Map<Edge, double>, Graph>);
static_assert(!internal::is_metric_field<Points, Graph>);
static_assert(!internal::is_metric_field<Formula, Graph>);
static_assert(!internal::is_metric_field<SMA::Analytic_metric_field<double (*)(int, int)>, Graph>);
static_assert(!internal::is_metric_field<SMA::Intersection_metric_field<SMA::Uniform_metric_field, Nothing>, Graph>);

static_assert(internal::is_adaptation_execution<Execution>);
static_assert(internal::is_adaptation_execution<SMA::Sequential_execution>);
static_assert(!internal::is_adaptation_execution<Nothing>);
static_assert(!internal::is_adaptation_execution<Nameless_execution>);
static_assert(internal::is_adaptation_visitor<std::reference_wrapper<Visitor>>);
static_assert(internal::is_adaptation_visitor<SMA::Adaptation_visitor>);
static_assert(!internal::is_adaptation_visitor<Nothing>);
static_assert(!internal::is_adaptation_visitor<Endless_visitor>);
static_assert(internal::is_surface_reconstruction<Reconstruction>);
static_assert(internal::is_surface_reconstruction<SMA::Gregory_reconstruction>);
static_assert(!internal::is_surface_reconstruction<Nothing>);
static_assert(!internal::is_surface_reconstruction<Curveless_reconstruction>);

static_assert(internal::has_coordinates<Points, Vertex>);
static_assert(!internal::has_coordinates<Constant<Vertex, double>, Vertex>);
static_assert(internal::is_readable_as<Constant<Edge, bool>, Edge, bool>);
static_assert(!internal::is_readable_as<Constant<Vertex, bool>, Edge, bool>);
static_assert(internal::is_writable_with<Counter<Vertex, double>, Vertex, double>);
static_assert(!internal::is_writable_with<Constant<Vertex, double>, Vertex, double>);
static_assert(internal::are_read_write_maps<std::tuple<Points, Map<Vertex, int>>, Vertex>);
static_assert(!internal::are_read_write_maps<std::tuple<Points, Constant<Vertex, int>>, Vertex>);
static_assert(!internal::are_read_write_maps<Points, Vertex>);

} // namespace test_concepts

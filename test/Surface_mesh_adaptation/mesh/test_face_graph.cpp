// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading and writing face graphs, and the order of their vertices.

#include "checks.h"
#include "mesh/views.h"
#include "shape_meshes.h"

#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace test_face_graph {

namespace SMA = CGAL::Surface_mesh_adaptation;
using namespace views_of_tests;
using shapes::Triangle;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface_mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

template <class TriangleMesh>
class Face_graph : public ::testing::Test
{};

using Face_graphs = ::testing::Types<Surface_mesh, Polyhedron>;
TYPED_TEST_SUITE(Face_graph, Face_graphs, );

/// Rotates each triangle so that its least corner comes first.
std::vector<Triangle> canonical(std::vector<Triangle> triangles)
{
  for (Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return triangles;
}

std::vector<Triangle> triangles_of(const Mesh_view& m)
{
  std::vector<Triangle> t;
  for (std::size_t h = 0; h < m.number_of_halfedges(); h += 3)
    t.push_back({m.corner[h], m.corner[h + 1], m.corner[h + 2]});
  return t;
}

TYPED_TEST(Face_graph, is_read_and_written_back)
{
  const SMA::Sequential_execution sequential;
  for (const Soup& soup : small_surfaces()) {
    auto graph = shapes::mesh<TypeParam>(soup);
    const auto imported = SMA::internal::read_face_graph(sequential, graph, get(CGAL::vertex_point, graph));
    ASSERT_TRUE(checks::is_valid(imported.mesh));
    EXPECT_EQ(canonical(triangles_of(imported.mesh)), canonical(soup.triangles));
    EXPECT_EQ(imported.points, soup.points);
    for (Index h = 0; h < imported.mesh.number_of_halfedges(); ++h) {
      EXPECT_EQ(imported.vertices[imported.mesh.source(h)], source(imported.halfedges[h], graph));
      EXPECT_EQ(imported.vertices[imported.mesh.target(h)], target(imported.halfedges[h], graph));
    }

    TypeParam written = shapes::mesh<TypeParam>(shapes::tetrahedron()); // what was there goes
    SMA::internal::write_connectivity(sequential, imported.mesh, written);
    SMA::internal::write_points(sequential, imported.points, written, get(CGAL::vertex_point, written));
    ASSERT_TRUE(CGAL::is_valid_polygon_mesh(written));
    const Soup result = shapes::soup(written);
    EXPECT_EQ(result.points, soup.points);
    EXPECT_EQ(result.triangles, triangles_of(imported.mesh)) << "corners, or where faces start, have changed";
    EXPECT_EQ(num_halfedges(written), num_halfedges(graph));
  }
}

TYPED_TEST(Face_graph, has_its_boundary_cycles_written)
{
  const SMA::Sequential_execution sequential;
  Soup soup = shapes::open_cylinder(7, 3, 1);
  shapes::append(soup, shapes::square(3));
  TypeParam graph;
  SMA::internal::write_connectivity(sequential, shapes::view(soup), graph);
  std::vector<std::size_t> lengths;
  std::size_t border_halfedges = 0;
  for (const auto h : halfedges(graph)) {
    EXPECT_EQ(prev(next(h, graph), graph), h);
    EXPECT_EQ(target(h, graph), source(next(h, graph), graph));
    if (!is_border(h, graph)) continue;
    ++border_halfedges;
    EXPECT_TRUE(is_border(next(h, graph), graph));
    std::size_t length = 1;
    for (auto g = next(h, graph); g != h && length < 100; g = next(g, graph)) ++length;
    lengths.push_back(length);
  }
  EXPECT_EQ(border_halfedges, 7u + 7u + 12u);
  EXPECT_EQ(std::count(lengths.begin(), lengths.end(), 7u), 14);
  EXPECT_EQ(std::count(lengths.begin(), lengths.end(), 12u), 12);
}

TEST(Face_graph_with_garbage, is_read_without_it)
{
  Surface_mesh mesh = shapes::mesh<Surface_mesh>(shapes::sphere(1));
  for (int i = 0; i < 5; ++i) {
    const auto all = mesh.edges();
    CGAL::Euler::collapse_edge(
      *std::find_if(all.begin(), all.end(),
                    [&](Surface_mesh::Edge_index e) { return CGAL::Euler::does_satisfy_link_condition(e, mesh); }),
      mesh);
  }
  ASSERT_TRUE(mesh.has_garbage());
  const auto imported =
    SMA::internal::read_face_graph(SMA::Sequential_execution(), mesh, get(CGAL::vertex_point, mesh));
  ASSERT_TRUE(checks::is_valid(imported.mesh));
  EXPECT_EQ(imported.mesh.number_of_vertices(), mesh.number_of_vertices());
  EXPECT_EQ(imported.mesh.number_of_faces(), mesh.number_of_faces());
  EXPECT_EQ(checks::topology(imported.mesh).euler_characteristic, 2);
}

TEST(Hilbert_key, leads_through_all_cells_each_next_to_the_last_one)
{
  using Cell = std::array<int, 3>;
  for (const int shift : {18, 0}) { // the cells of the largest and of the smallest eighths of eighths of eighths
    std::vector<std::pair<std::uint64_t, Cell>> cells;
    for (int x = 0; x < 8; ++x)
      for (int y = 0; y < 8; ++y)
        for (int z = 0; z < 8; ++z) {
          const auto at = [=](int i) { return std::uint32_t(i) << shift; };
          cells.push_back({SMA::internal::hilbert_key({at(x), at(y), at(z)}) >> (3 * shift), Cell{x, y, z}});
        }
    std::sort(cells.begin(), cells.end());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      ASSERT_EQ(cells[i].first, i);
      if (i == 0) continue;
      const Cell &a = cells[i - 1].second, &b = cells[i].second;
      EXPECT_EQ(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]), 1);
    }
  }
}

} // namespace test_face_graph

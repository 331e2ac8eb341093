// SPDX-License-Identifier: GPL-3.0-or-later
//
// MEDIT files: what is read, what is written back, and what is refused, with the line.

#include "checks.h"
#include "medit_files.h"
#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace test_medit {

namespace SMA = CGAL::Surface_mesh_adaptation;
using medit_files::expect_equal;
using shapes::Soup;
using SMA::Medit_mesh;
using SMA::Medit_solution;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

const std::string header = "MeshVersionFormatted 2\nDimension 3\n";
const std::string vertices = "Vertices\n4\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n";
const std::string triangles = "Triangles\n2\n1 2 3 7\n1 4 2 8\n";

Medit_mesh parsed(const std::string& text) { return SMA::parse_medit_mesh(text, "some.mesh"); }
Medit_solution parsed_solution(const std::string& text) { return SMA::parse_medit_solution(text, "some.sol"); }

/// The line that the error names, and whether its message starts with the file and the line.
template <class Parse>
std::size_t line_of_error(const Parse& parse, const std::string& text)
{
  try {
    parse(text);
  } catch (const SMA::Io_error& e) {
    const std::string what = e.what();
    const std::string place = e.line() == 0 ? ": " : ":" + std::to_string(e.line()) + ": ";
    EXPECT_EQ(what.find("some."), 0u) << what;
    EXPECT_NE(what.find(place), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return e.line();
  }
  ADD_FAILURE() << "nothing was thrown";
  return 0;
}

std::size_t mesh_error(const std::string& text) { return line_of_error(parsed, text); }
std::size_t solution_error(const std::string& text) { return line_of_error(parsed_solution, text); }

TEST(Medit_mesh, is_read_with_all_its_marks)
{
  const Medit_mesh m = parsed(header + vertices + triangles +
                              "Edges\n2\n1 2 5\n2 3 6\nRidges\n1\n2\nRequiredEdges 1 1\nCorners\n2\n1\n4\n"
                              "RequiredVertices\n1\n3\nEnd\n");
  EXPECT_EQ(m.points, (std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(m.point_references, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(m.triangles, (Medit_mesh::Tuples<3>{{0, 1, 2}, {0, 3, 1}}));
  EXPECT_EQ(m.triangle_references, (std::vector<int>{7, 8}));
  EXPECT_EQ(m.edges, (Medit_mesh::Tuples<2>{{0, 1}, {1, 2}}));
  EXPECT_EQ(m.edge_references, (std::vector<int>{5, 6}));
  EXPECT_EQ(m.ridges, Medit_mesh::Indices{1});
  EXPECT_EQ(m.required_edges, Medit_mesh::Indices{0});
  EXPECT_EQ(m.corners, (Medit_mesh::Indices{0, 3}));
  EXPECT_EQ(m.required_vertices, Medit_mesh::Indices{2});
  EXPECT_TRUE(m.ignored_sections.empty());
}

TEST(Medit_mesh, may_have_comments_any_order_and_other_sections)
{
  const Medit_mesh m =
    parsed("# a comment\nMeshVersionFormatted 1 # here too\n\n  Dimension\n3\r\n" + triangles +
           "Tetrahedra\n1\n1 2 3 4 0\nNormals 1\n0 0 1\n#Triangles\n" + vertices + "\nEnd\nanything");
  EXPECT_EQ(m.triangles.size(), 2u);
  EXPECT_EQ(m.points.size(), 4u);
  EXPECT_EQ(m.ignored_sections, (std::vector<std::string>{"Tetrahedra", "Normals"}));
  EXPECT_EQ(parsed(header + vertices).triangles.size(), 0u) << "End may be missing";
}

TEST(Medit_mesh, comes_back_to_the_last_bit)
{
  shapes::Random random(1);
  const Medit_mesh m = medit_files::random_mesh(random, 1000);
  expect_equal(parsed(SMA::print_medit_mesh(m)), m);
}

TEST(Medit_mesh, that_is_malformed_is_refused_with_its_line)
{
  EXPECT_EQ(mesh_error(""), 1u);
  EXPECT_EQ(mesh_error("OFF\n"), 1u);
  EXPECT_EQ(mesh_error("MeshVersionFormatted 9\nDimension 3\n" + vertices), 1u);
  EXPECT_EQ(mesh_error("MeshVersionFormatted 2\nDimension 2\n" + vertices), 2u);
  EXPECT_EQ(mesh_error("MeshVersionFormatted 2\n" + vertices), 2u);
  EXPECT_GT(mesh_error(header + triangles), 0u); // no vertices
  EXPECT_EQ(mesh_error(header + "Vertices\n2\n0 0 0 0\n0 0 nan 0\n"), 6u);
  EXPECT_EQ(mesh_error(header + "Vertices\n2\n0 0 0 0\n0 inf 0 0\n"), 6u);
  EXPECT_EQ(mesh_error(header + "Vertices\n2\n0 0 0 0\n0 1e999 0 0\n"), 6u);
  EXPECT_EQ(mesh_error(header + "Vertices\n2\n0 0 0 0\n0 1,5 0 0\n"), 6u);
  EXPECT_EQ(mesh_error(header + "Vertices\n1\n0 0 0 zero\n"), 5u);
  EXPECT_EQ(mesh_error(header + "Vertices\n-1\n"), 4u);
  EXPECT_EQ(mesh_error(header + vertices + "Triangles\n2\n1 2 3 0\n1 2 5 0\n"), 12u); // no vertex 5
  EXPECT_EQ(mesh_error(header + vertices + "Triangles\n2\n1 2 3 0\n0 2 3 0\n"), 12u); // from 1
  EXPECT_EQ(mesh_error(header + vertices + "Triangles\n1\n1 2 3 0\nRidges\n1\n1\n"), 14u);
  EXPECT_EQ(mesh_error(header + vertices + "Corners\n1\n\n5\n"), 12u);
  EXPECT_EQ(mesh_error(header + vertices + vertices), 9u);
  EXPECT_EQ(mesh_error(header + vertices + "1 2 3\n"), 9u);
  EXPECT_EQ(mesh_error(header + vertices + "Quadrilaterals\n1\n1 2 3 5 0\n"), 11u); // no vertex 5
}

TEST(Medit_mesh, that_announces_more_than_it_holds_is_refused_at_once)
{
  for (const char* n : {"4000000000", "99999999999999999999", "3"}) {
    EXPECT_GE(mesh_error(header + "Vertices\n" + n + "\n0 0 0 0\n"), 4u);
    EXPECT_GE(mesh_error(header + vertices + "Triangles\n" + n + "\n1 2 3 0\n"), 10u);
    EXPECT_GE(mesh_error(header + vertices + "Ridges\n" + n + "\n"), 10u);
  }
}

TEST(Medit_mesh, that_is_cut_anywhere_is_read_or_refused)
{
  const std::string text = header + vertices + triangles + "Edges\n1\n1 2 5\nRidges\n1\n1\nCorners\n1\n4\nEnd\n";
  const Medit_mesh whole = parsed(text);
  for (std::size_t length = 0; length < text.size(); ++length) {
    try {
      const Medit_mesh part = parsed(text.substr(0, length));
      EXPECT_EQ(part.points.size(), whole.points.size());
      for (const auto& t : part.triangles)
        for (const auto v : t) EXPECT_LT(v, part.points.size());
    } catch (const SMA::Io_error& e) {
      EXPECT_LE(e.line(), std::size_t(std::count(text.begin(), text.end(), '\n')) + 1);
    }
  }
}

TEST(Medit_mesh, with_random_damage_is_read_or_refused)
{
  const std::string text = header + vertices + triangles + "Edges\n1\n1 2 5\nRidges\n1\n1\nCorners\n1\n4\nEnd\n";
  shapes::Random random(2);
  std::size_t refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string damaged = text;
    for (std::size_t n = 1 + random.below(4); n > 0; --n)
      damaged[random.below(damaged.size())] = char(random.below(256));
    try {
      const Medit_mesh m = parsed(damaged);
      for (const auto& t : m.triangles)
        for (const auto v : t) ASSERT_LT(v, m.points.size());
      for (const auto e : m.ridges) ASSERT_LT(e, m.edges.size());
    } catch (const SMA::Io_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 5000u);
}

TEST(Medit_mesh, that_does_not_exist_is_refused)
{
  EXPECT_THROW(SMA::read_medit_mesh("/no/such/file.mesh"), SMA::Io_error);
  EXPECT_THROW(SMA::write_medit_mesh("/no/such/file.mesh", Medit_mesh()), SMA::Io_error);
  EXPECT_THROW(SMA::read_medit_solution("/no/such/file.sol"), SMA::Io_error);
}

TEST(Medit_solution, comes_back_to_the_last_bit)
{
  shapes::Random random(3);
  for (const std::vector<int>& fields : medit_files::several_fields) {
    const Medit_solution s = medit_files::random_solution(random, fields);
    expect_equal(parsed_solution(SMA::print_medit_solution(s)), s);
  }
}

TEST(Medit_solution, that_is_malformed_is_refused_with_its_line)
{
  EXPECT_EQ(parsed_solution(header + "SolAtVertices\n2\n1 1\n0.5 2\n")[0].values, (std::vector<double>{0.5, 2}));
  EXPECT_GT(solution_error(header), 0u);
  EXPECT_EQ(solution_error(header + "SolAtVertices\n2\n0\n"), 5u);
  EXPECT_EQ(solution_error(header + "SolAtVertices\n2\n-1 1\n1 1\n"), 5u);
  EXPECT_EQ(solution_error(header + "SolAtVertices\n1\n1 5\n1 1\n"), 5u);       // no such type
  EXPECT_EQ(solution_error(header + "SolAtVertices\n2\n2 1 2\n1 1 1 1\n"), 4u); // eight values are missing four
  EXPECT_GT(solution_error(header + "SolAtVertices\n1\n2000000000 1 1\n"), 5u);
  EXPECT_EQ(solution_error(header + "SolAtVertices\n1\n1 1\n1\nSolAtVertices\n1\n1 1\n1\n"), 7u);
  EXPECT_EQ(solution_error(header + "SolAtVertices\n2\n1 1\n1\nnan\n"), 7u);
  EXPECT_GT(solution_error(header + "SolAtVertices\n2\n1 1\n1\n"), 5u);
  EXPECT_EQ(solution_error(header + "SolAtVertices\n4000000000\n1 1\n1\n"), 4u);
}

TEST(Medit_conversion, keeps_points_triangles_and_marks)
{
  const Soup soup = shapes::cube(2);
  Mesh mesh = shapes::mesh<Mesh>(soup);
  auto is_edge = mesh.add_property_map<Mesh::Edge_index, bool>("e", false).first;
  auto is_vertex = mesh.add_property_map<Mesh::Vertex_index, bool>("v", false).first;
  is_edge[Mesh::Edge_index(3)] = is_edge[Mesh::Edge_index(20)] = true;
  is_vertex[Mesh::Vertex_index(1)] = true;
  const Medit_mesh medit = parsed(SMA::print_medit_mesh(SMA::triangle_mesh_to_medit(mesh, is_edge, is_vertex)));
  EXPECT_EQ(medit.ridges.size(), 2u);
  EXPECT_EQ(medit.corners, Medit_mesh::Indices{1});

  Mesh back;
  auto edge_back = back.add_property_map<Mesh::Edge_index, bool>("e", false).first;
  auto vertex_back = back.add_property_map<Mesh::Vertex_index, bool>("v", false).first;
  SMA::medit_to_triangle_mesh(medit, back, edge_back, vertex_back);
  const Soup result = shapes::soup(back);
  ASSERT_TRUE(checks::is_manifold(result));
  EXPECT_EQ(result.points, soup.points);
  EXPECT_EQ(result.triangles.size(), soup.triangles.size());
  EXPECT_GT(checks::least_area(result, [](const shapes::Vector_3& p) { return p; }), 0) << "the orientation was lost";
  for (const auto v : back.vertices()) EXPECT_EQ(vertex_back[v], v == Mesh::Vertex_index(1));
  std::size_t marked = 0;
  for (const auto e : back.edges()) {
    if (!edge_back[e]) continue;
    ++marked;
    const auto h = mesh.halfedge(back.vertex(e, 0), back.vertex(e, 1));
    ASSERT_TRUE(h.is_valid());
    EXPECT_TRUE(is_edge[mesh.edge(h)]);
  }
  EXPECT_EQ(marked, 2u);
}

TEST(Medit_conversion, orients_and_leaves_out_unused_points)
{
  Medit_mesh m =
    parsed(header + "Vertices\n5\n9 9 9 0\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\nTriangles\n2\n2 3 4 0\n3 4 5 0\n");
  Mesh mesh;
  auto none = CGAL::Static_boolean_property_map<Mesh::Edge_index, false>();
  auto fixed = mesh.add_property_map<Mesh::Vertex_index, bool>("v", false).first;
  const auto vertex_of_point = SMA::medit_to_triangle_mesh(m, mesh, none, fixed);
  EXPECT_EQ(mesh.number_of_vertices(), 4u);
  EXPECT_EQ(mesh.number_of_faces(), 2u);
  EXPECT_EQ(vertex_of_point[0], Mesh::null_vertex());
  EXPECT_EQ(mesh.point(vertex_of_point[4]), Mesh::Point(1, 1, 0));
  ASSERT_TRUE(checks::is_manifold(shapes::soup(mesh)));
}

TEST(Medit_conversion, refuses_what_is_no_orientable_manifold)
{
  const auto refuse = [](const std::string& points_and_triangles) {
    Mesh mesh;
    auto edge = mesh.add_property_map<Mesh::Edge_index, bool>("e", false).first;
    auto vertex = mesh.add_property_map<Mesh::Vertex_index, bool>("v", false).first;
    EXPECT_THROW(SMA::medit_to_triangle_mesh(parsed(header + points_and_triangles), mesh, edge, vertex),
                 SMA::Invalid_input_error);
  };
  const std::string five = "Vertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 0\n";
  refuse(five + "Triangles\n3\n1 2 3 0\n1 2 4 0\n1 2 5 0\n");              // three faces at an edge
  refuse(five + "Triangles\n2\n1 2 3 0\n1 4 5 0\n");                       // two fans at a vertex
  refuse(five + "Quadrilaterals\n1\n1 2 4 3 0\n");                        // no triangle
  refuse(five + "Triangles\n1\n1 2 2 0\n");                                // a vertex twice
  refuse(five + "Triangles\n1\n1 2 3 0\nEdges\n1\n1 4 0\nRidges\n1\n1\n"); // a ridge that is no edge
  refuse(five + "Triangles\n1\n1 2 3 0\nCorners\n1\n5\n");                 // a corner that is on no face
  // a Moebius strip
  std::string strip = "Vertices\n5\n";
  for (int i = 0; i < 5; ++i) strip += std::to_string(i) + " " + std::to_string(i * i) + " 0 0\n";
  refuse(strip + "Triangles\n5\n1 2 3 0\n2 3 4 0\n3 4 5 0\n4 5 1 0\n5 1 2 0\n");
}

} // namespace test_medit

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program `adapt_mesh`: what a file says beyond points and faces comes out again.

#include "checks.h"
#include "program.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace test_cli_content {

using namespace program;

/// The cube of `shapes::cube(n)`, with a reference for each side.
SMA::Medit_mesh cube_with_references(std::size_t n)
{
  SMA::Medit_mesh m;
  const Soup soup = shapes::cube(n);
  for (const Vector_3& p : soup.points) m.points.push_back({p[0], p[1], p[2]});
  for (const shapes::Triangle& t : soup.triangles) {
    m.triangles.push_back({t[0], t[1], t[2]});
    const Vector_3 normal =
      (soup.points[t[1]] - soup.points[t[0]]).cross(soup.points[t[2]] - soup.points[t[0]]).normalized();
    m.triangle_references.push_back(int(std::lround(3 * normal[0] + 2 * normal[1] + normal[2])) + 10);
  }
  m.point_references.assign(m.points.size(), 0);
  return m;
}

std::map<int, double> areas(const SMA::Medit_mesh& m)
{
  std::map<int, double> result;
  const auto at = [&](std::uint32_t v) { return Vector_3(m.points[v][0], m.points[v][1], m.points[v][2]); };
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const auto& t = m.triangles[i];
    result[m.triangle_references[i]] += (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / 2;
  }
  return result;
}

using Content = Adapt_mesh;

TEST_F(Content, references_of_faces)
{
  const SMA::Medit_mesh in = cube_with_references(4);
  SMA::write_medit_mesh(path("in.mesh").string(), in);
  expect_success("in.mesh out.mesh --size 0.1 --quiet");
  expect_success("out.mesh again.meshb --size 0.4 --quiet --no-features"); // labels alone keep the edges
  for (const char* file : {"out.mesh", "again.meshb"}) {
    const auto before = areas(in), after = areas(SMA::read_medit_mesh(path(file).string()));
    ASSERT_EQ(after.size(), 6u);
    for (const auto& [reference, area] : before) EXPECT_NEAR(after.at(reference), area, 1e-12) << file;
  }
  expect_success("in.mesh none.mesh --size 0.1 --quiet --no-references");
  EXPECT_EQ(areas(SMA::read_medit_mesh(path("none.mesh").string())).size(), 1u);
}

std::set<std::set<std::array<double, 3>>> required_triangles(const SMA::Medit_mesh& m)
{
  std::set<std::set<std::array<double, 3>>> result;
  for (const std::uint32_t t : m.required_triangles)
    result.insert({m.points[m.triangles[t][0]], m.points[m.triangles[t][1]], m.points[m.triangles[t][2]]});
  return result;
}

std::set<std::set<std::array<double, 3>>> required_edges(const SMA::Medit_mesh& m)
{
  std::set<std::set<std::array<double, 3>>> result;
  for (const std::uint32_t e : m.required_edges) result.insert({m.points[m.edges[e][0]], m.points[m.edges[e][1]]});
  return result;
}

TEST_F(Content, required_elements_of_medit_files)
{
  SMA::Medit_mesh in = cube_with_references(6);
  for (std::uint32_t t = 0; t < in.triangles.size(); ++t) {
    const auto& corners = in.triangles[t];
    const bool is_near = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
      return in.points[v][0] < 0.4 && in.points[v][1] < 0.4;
    });
    if (is_near) in.required_triangles.push_back(t);
    if (t % 17 != 0) continue;
    in.required_edges.push_back(std::uint32_t(in.edges.size()));
    in.edges.push_back({corners[0], corners[1]});
    in.edge_references.push_back(int(t) + 1);
  }
  in.required_vertices = {5, 6};
  in.corners = {7};
  in.point_references[5] = 42;
  SMA::write_medit_mesh(path("in.mesh").string(), in);
  ASSERT_FALSE(in.required_triangles.empty());
  expect_success("in.mesh fine.mesh --size 0.05 --quiet");
  expect_success("fine.mesh coarse.mesh --size 0.5 --quiet"); // a second run treats them the same
  for (const char* file : {"fine.mesh", "coarse.mesh"}) {
    const SMA::Medit_mesh out = SMA::read_medit_mesh(path(file).string());
    EXPECT_EQ(required_triangles(out), required_triangles(in)) << file;
    EXPECT_EQ(required_edges(out), required_edges(in)) << file;
    std::set<std::array<double, 3>> required;
    for (const std::uint32_t v : out.required_vertices) required.insert(out.points[v]);
    EXPECT_EQ(required, (std::set<std::array<double, 3>>{in.points[5], in.points[6]})) << file;
    ASSERT_EQ(out.corners.size(), 1u);
    EXPECT_EQ(out.points[out.corners[0]], in.points[7]);
    const auto known = std::find(out.points.begin(), out.points.end(), in.points[5]);
    EXPECT_EQ(out.point_references[std::size_t(known - out.points.begin())], 42);
    std::set<int> references(in.edge_references.begin(), in.edge_references.end()), found;
    for (const int r : out.edge_references)
      if (r != 0) found.insert(r);
    EXPECT_EQ(found, references) << file;
  }
}

TEST_F(Content, sizes_by_reference)
{
  const SMA::Medit_mesh in = cube_with_references(8);
  SMA::write_medit_mesh(path("in.mesh").string(), in);
  write(path("in.mmgs"), "Parameters\n2\n\n13 Triangle 0.01 0.05 0.1\n8 Edge 1 1 1\n");
  for (const char* options : {"--size 0.4", "--curvature 0.01"}) {
    expect_success(std::string("in.mesh out.mesh --quiet --parameters in.mmgs ") + options);
    const SMA::Medit_mesh out = SMA::read_medit_mesh(path("out.mesh").string());
    std::map<int, double> n;
    for (const int reference : out.triangle_references) ++n[reference];
    EXPECT_GT(n.at(13), 4 / (0.05 * 0.05 * std::sqrt(3.0) / 4) * 0.8) << options; // a side has the area 4
    EXPECT_LT(n.at(7), 0.2 * n.at(13)) << options;                               // that opposite to it
  }
  write(path("in.mmgs"), "Parameters\n1\n13 Triangle many\n");
  expect_failure(3, "in.mesh out.off --size 1 --parameters in.mmgs", "three numbers expected");
}

/// A sphere whose faces above and below the equator have the references 1 and 2.
SMA::Medit_mesh sphere_with_references(int level)
{
  SMA::Medit_mesh m;
  const Soup soup = shapes::sphere(level);
  for (const Vector_3& p : soup.points) m.points.push_back({p[0], p[1], p[2]});
  for (const shapes::Triangle& t : soup.triangles) {
    m.triangles.push_back({t[0], t[1], t[2]});
    m.triangle_references.push_back(soup.points[t[0]][2] + soup.points[t[1]][2] + soup.points[t[2]][2] > 0 ? 1 : 2);
  }
  m.point_references.assign(m.points.size(), 0);
  return m;
}

/// Of the faces of a unit sphere that have a reference, those far from the equator: the mean size of their edges and the
/// largest distance of their centroids from the sphere.
struct Cap
{
  double size = 0, distance = 0;

  Cap(const SMA::Medit_mesh& m, int reference)
  {
    const auto at = [&](std::uint32_t v) { return Vector_3(m.points[v][0], m.points[v][1], m.points[v][2]); };
    double area = 0, n = 0;
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const Vector_3 a = at(m.triangles[i][0]), b = at(m.triangles[i][1]), c = at(m.triangles[i][2]);
      const Vector_3 centroid = (a + b + c) / 3;
      if (m.triangle_references[i] != reference || std::abs(centroid[2]) < 0.7) continue;
      area += (b - a).cross(c - a).norm() / 2;
      distance = std::max(distance, 1 - centroid.norm());
      ++n;
    }
    size = std::sqrt(area / n * 4 / std::sqrt(3.0));
  }
};

TEST_F(Content, distances_by_reference)
{
  SMA::write_medit_mesh(path("in.mesh").string(), sphere_with_references(4));
  write(path("in.mmgs"), "Parameters\n1\n\n1 Triangle 0.001 2 0.0005\n");
  const double coarse = 0.004, fine = 0.0005, diagonal = 2 * std::sqrt(3.0);
  const auto run = [&](const std::string& options) {
    expect_success("in.mesh out.mesh --quiet --gradation 2 " + options);
    return SMA::read_medit_mesh(path("out.mesh").string());
  };
  const std::string curvature = "--curvature " + std::to_string(coarse / diagonal);
  const SMA::Medit_mesh plain = run(curvature), out = run(curvature + " --parameters in.mmgs");
  const Cap with(out, 1), other(out, 2), without(plain, 1), other_without(plain, 2);
  EXPECT_NEAR(without.size / with.size, std::sqrt(coarse / fine), 0.15 * std::sqrt(coarse / fine));
  EXPECT_NEAR(other.size, other_without.size, 0.05 * other_without.size);
  EXPECT_LT(with.distance, 1.5 * fine);
  EXPECT_GT(with.distance, 0.5 * fine);
  EXPECT_LT(other.distance, 1.5 * coarse);
  EXPECT_GT(other.distance, 0.5 * coarse);

  const auto warning = [&](const std::string& options) {
    const Outcome outcome = this->run("in.mesh out.mesh --parameters in.mmgs " + options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(warning("--tolerance 0.002").find("--tolerance is the same everywhere"), std::string::npos);
  for (const char* options : {"--size 0.2", "--vertices 1000"})
    EXPECT_NE(warning(options).find("distances there are not used"), std::string::npos) << options;
  EXPECT_EQ(warning(curvature).find("distances there"), std::string::npos);
}

TEST_F(Content, boundaries_and_marked_edges_if_asked_for)
{
  write(path("in.off"), off(shapes::open_cylinder(16, 4, 1)));
  expect_success("in.off kept.off --size 0.05 --quiet --boundary keep");
  expect_success("in.off free.off --size 0.05 --quiet --boundary resample");
  const auto on_boundary = [](const Soup& soup) {
    std::map<std::array<shapes::Index, 2>, int> faces;
    for (const auto& t : soup.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        ++faces[{(std::min)(t[i], t[(i + 1) % 3]), (std::max)(t[i], t[(i + 1) % 3])}];
    return std::count_if(faces.begin(), faces.end(), [](const auto& f) { return f.second == 1; });
  };
  EXPECT_EQ(on_boundary(read(path("kept.off"))), 32);
  EXPECT_GT(on_boundary(read(path("free.off"))), 200);
  expect_failure(2, "in.off out.off --size 1 --boundary bent", "--boundary");
}

/// Rows of numbers of a text file, behind its header.
std::vector<std::vector<double>> rows(const std::string& text, const std::string& end_of_header)
{
  std::vector<std::vector<double>> result;
  std::istringstream in(text.substr(text.find(end_of_header) + end_of_header.size()));
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    result.emplace_back();
    for (double x; numbers >> x;) result.back().push_back(x);
  }
  return result;
}

TEST_F(Content, columns_of_ply_files)
{
  std::ostringstream text;
  text.precision(17);
  const Soup soup = shapes::square(8);
  text << "ply\nformat ascii 1.0\nelement vertex " << soup.points.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
          "property uchar blue\nproperty double pressure\nproperty float constant\nproperty float nx\n"
          "property float ny\nproperty float nz\nelement face "
       << soup.triangles.size()
       << "\nproperty list uchar int vertex_indices\nproperty int patch\nproperty double texture\nend_header\n";
  for (const Vector_3& p : soup.points)
    text << p[0] << " " << p[1] << " 0 " << int(std::lround(200 * p[0])) << " 7 0 " << 2 * p[0] - 3 * p[1]
         << " 0.3 0 0 1\n";
  for (const auto& t : soup.triangles) text << "3 " << t[0] << " " << t[1] << " " << t[2] << " 12 2.5\n";
  write(path("in.ply"), text.str());
  expect_success("in.ply out.ply --size 0.04 --quiet");
  const std::string out = content(path("out.ply"));
  for (const char* property : {"uchar red", "double pressure", "float constant", "int patch", "double texture", "double nx"})
    EXPECT_NE(out.find(std::string("property ") + property + "\n"), std::string::npos) << property;
  const std::string end = "end_header\n";
  const char* row = out.data() + out.find(end) + end.size();
  const std::size_t n = std::stoul(out.substr(out.find("element vertex ") + 15)), length = 6 * 8 + 3 + 8 + 4;
  for (std::size_t i = 0; i < n; ++i, row += length) {
    double p[6], pressure;
    float constant;
    std::memcpy(p, row, sizeof p);
    std::memcpy(&pressure, row + 51, 8);
    std::memcpy(&constant, row + 59, 4);
    EXPECT_NEAR(double(std::uint8_t(row[48])), 200 * p[0], 1.0);
    EXPECT_EQ(int(row[49]), 7);
    EXPECT_NEAR(pressure, 2 * p[0] - 3 * p[1], 1e-6);
    EXPECT_EQ(constant, 0.3f);
    EXPECT_NEAR(p[5], 1, 1e-12); // the normals, computed anew
  }
  const std::int32_t patch = 12;
  const double value = 2.5;
  const std::size_t faces = std::stoul(out.substr(out.find("element face ") + 13));
  for (std::size_t f = 0; f < faces; ++f, row += 25) {
    EXPECT_EQ(std::memcmp(row + 13, &patch, 4), 0);
    EXPECT_EQ(std::memcmp(row + 17, &value, 8), 0);
  }
  expect_success("out.ply again.ply --size 0.1 --quiet");
}

TEST_F(Content, colours_of_off_files)
{
  write(path("in.off"), "COFF\n4 2 0\n0 0 0 255 0 10 255\n1 0 0 255 0 20 255\n1 1 0 255 0 20 255\n0 1 0 255 0 10 255\n"
                        "3 0 1 2 1 2 3\n3 0 2 3 1 2 3\n");
  expect_success("in.off out.off --size 0.2 --quiet");
  const auto all = rows(content(path("out.off")), "COFF\n");
  const std::size_t n = std::size_t(all[0][0]);
  for (std::size_t i = 2; i < 2 + n; ++i) {
    ASSERT_EQ(all[i].size(), 7u);
    EXPECT_EQ(all[i][3], 255);
    EXPECT_NEAR(all[i][5], 10 + 10 * all[i][0], 0.51);
  }
  for (std::size_t i = 2 + n; i < all.size(); ++i)
    EXPECT_EQ(std::vector<double>(all[i].begin() + 4, all[i].end()), (std::vector<double>{1, 2, 3}));
}

/// A strip of two squares with a chart each, and a group and a material for each.
const char* const two_charts = "mtllib some.mtl\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
                               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 5 5\nvt 7 5\nvt 7 7\nvt 5 7\n"
                               "o strip\ng left\nusemtl red\nf 1/1 2/2 5/3 4/4\ng right\nusemtl blue\nf 2/5 3/6 6/7 5/8\n";

TEST_F(Content, lines_of_obj_files_that_a_backslash_continues)
{
  const std::string lines = "v 0 0 0\nv 1 0 \\\n0\nv 1 1 0\\\r\n\nv 0 1 0\nf 1//1 2//1\\\n 3//1 \\\n4//1\n";
  write(path("in.obj"), lines + "vn 0 0 1\n");
  expect_success("in.obj out.off --size 2 --quiet");
  EXPECT_NE(content(path("out.off")).find("OFF\n4 2 0\n"), std::string::npos);
}

TEST_F(Content, groups_materials_and_texture_coordinates_of_obj_files)
{
  write(path("in.obj"), two_charts);
  expect_success("in.obj out.obj --size 0.1 --quiet");
  expect_success("out.obj again.obj --size 0.2 --quiet");
  for (const char* file : {"out.obj", "again.obj"}) {
    std::vector<std::array<double, 3>> v;
    std::vector<std::array<double, 2>> vt;
    std::istringstream in(content(path(file)));
    std::string group, material, library;
    std::size_t faces = 0;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      std::array<double, 3> p{};
      std::array<double, 2> uv{};
      if (word == "v" && words >> p[0] >> p[1] >> p[2]) v.push_back(p);
      if (word == "vt" && words >> uv[0] >> uv[1]) vt.push_back(uv);
      if (word == "g") words >> group;
      if (word == "usemtl") words >> material;
      if (word == "mtllib") words >> library;
      if (word != "f") continue;
      ++faces;
      EXPECT_EQ(material, group == "left" ? "red" : "blue");
      for (std::string corner; words >> corner;) {
        const std::size_t i = std::stoul(corner) - 1, j = std::stoul(corner.substr(corner.find('/') + 1)) - 1;
        const bool is_left = group == "left";
        EXPECT_NEAR(vt.at(j)[0], is_left ? v.at(i)[0] : 5 + 2 * (v.at(i)[0] - 1), 1e-12);
        EXPECT_NEAR(vt.at(j)[1], is_left ? v.at(i)[1] : 5 + 2 * v.at(i)[1], 1e-12);
        EXPECT_TRUE(is_left ? v[i][0] < 1 + 1e-12 : v[i][0] > 1 - 1e-12);
      }
    }
    EXPECT_EQ(library, "some.mtl");
    EXPECT_GT(faces, 60u);
  }
}

TEST_F(Content, names_of_solids)
{
  std::string text;
  const Soup soup = shapes::cube(3);
  for (const bool is_top : {false, true}) {
    text += is_top ? "solid the top\n" : "solid rest\n";
    for (const auto& t : soup.triangles) {
      const bool all_on_top = soup.points[t[0]][2] == 1 && soup.points[t[1]][2] == 1 && soup.points[t[2]][2] == 1;
      if (all_on_top != is_top) continue;
      text += "facet normal 0 0 0\nouter loop\n";
      for (const auto v : t) {
        std::ostringstream line;
        line.precision(17);
        line << "vertex " << soup.points[v][0] << " " << soup.points[v][1] << " " << soup.points[v][2] << "\n";
        text += line.str();
      }
      text += "endloop\nendfacet\n";
    }
    text += "facet normal 0 0 0\nouter loop\nvertex 1 1 1\nvertex 1 1 1\nvertex 0 1 1\nendloop\nendfacet\n";
    text += "endsolid\n";
  }
  write(path("in.stl"), text);
  expect_success("in.stl out.stl --size 0.1 --quiet");
  const std::string out = content(path("out.stl"));
  const std::size_t top = out.find("solid the top\n");
  ASSERT_NE(top, std::string::npos);
  ASSERT_NE(out.find("solid rest\n"), std::string::npos);
  EXPECT_NEAR(checks::area(read(path("out.stl"))), 24, 1e-6);
  expect_success("in.stl out.obj --size 0.1 --quiet");
  EXPECT_NE(content(path("out.obj")).find("g the top\n"), std::string::npos);
}

TEST_F(Content, fields_at_the_vertices)
{
  const Soup soup = shapes::square(6);
  write(path("in.off"), off(soup));
  SMA::Medit_field scalar, vector;
  vector.components = 3;
  for (const Vector_3& p : soup.points) {
    scalar.values.push_back(4 * p[0] + p[1]);
    vector.values.insert(vector.values.end(), {p[0], 1, -p[1]});
  }
  SMA::write_medit_solution(path("in.sol").string(), {scalar, vector});
  expect_success("in.off out.off --size 0.07 --quiet --attributes in.sol --output-attributes out.sol");
  const SMA::Medit_solution out = SMA::read_medit_solution(path("out.sol").string());
  const Soup after = read(path("out.off"));
  ASSERT_EQ(out.size(), 2u);
  ASSERT_EQ(out[0].number_of_vertices(), after.points.size());
  for (std::size_t v = 0; v < after.points.size(); ++v) {
    EXPECT_NEAR(out[0].values[v], 4 * after.points[v][0] + after.points[v][1], 1e-12);
    EXPECT_NEAR(out[1].values[3 * v + 2], -after.points[v][1], 1e-12);
    EXPECT_EQ(out[1].values[3 * v + 1], 1);
  }
  expect_failure(2, "in.off out.off --size 1 --attributes in.sol", "--output-attributes");
}

} // namespace test_cli_content

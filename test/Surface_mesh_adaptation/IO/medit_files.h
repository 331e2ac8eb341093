// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contents of MEDIT files that the tests of both forms share.

#ifndef TEST_SURFACE_MESH_ADAPTATION_MEDIT_FILES_H
#define TEST_SURFACE_MESH_ADAPTATION_MEDIT_FILES_H

#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace medit_files {

using CGAL::Surface_mesh_adaptation::Medit_mesh;
using CGAL::Surface_mesh_adaptation::Medit_solution;

/// With every kind of section and numbers of any size.
inline Medit_mesh random_mesh(shapes::Random& random, std::uint32_t n)
{
  Medit_mesh m;
  for (std::uint32_t i = 0; i < n; ++i) {
    m.points.push_back({std::exp(random.real(-700, 700)), -random.real() / 3, double(i) * 1e300});
    m.point_references.push_back(int(random.below(1000)) - 500);
  }
  for (std::uint32_t i = 0; i + 2 < n; ++i) {
    m.triangles.push_back({i, i + 1, i + 2});
    m.triangle_references.push_back(int(i));
    m.quadrilaterals.push_back({i + 2, i, i + 1, 0});
    m.quadrilateral_references.push_back(7 - int(i));
    m.edges.push_back({i, i + 1});
    m.edge_references.push_back(-int(i));
  }
  m.ridges = {0, 5, n - 3};
  m.required_edges = {3};
  m.corners = {0, n - 1};
  m.required_vertices = {n / 2};
  return m;
}

inline void expect_equal(const Medit_mesh& a, const Medit_mesh& b)
{
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.point_references, b.point_references);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_references, b.triangle_references);
  EXPECT_EQ(a.quadrilaterals, b.quadrilaterals);
  EXPECT_EQ(a.quadrilateral_references, b.quadrilateral_references);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.edge_references, b.edge_references);
  EXPECT_EQ(a.ridges, b.ridges);
  EXPECT_EQ(a.required_edges, b.required_edges);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.required_vertices, b.required_vertices);
  EXPECT_EQ(a.ignored_sections, b.ignored_sections);
}

/// Numbers of components of the fields of one file.
inline const std::vector<std::vector<int>> several_fields = {{1}, {6}, {3, 1}, {1, 1, 6, 9, 3}};

inline Medit_solution random_solution(shapes::Random& random, const std::vector<int>& fields)
{
  Medit_solution solution;
  for (const int components : fields) {
    solution.emplace_back().components = components;
    for (int i = 0; i < 100 * components; ++i) solution.back().values.push_back(std::exp(random.real(-700, 700)));
  }
  return solution;
}

inline void expect_equal(const Medit_solution& a, const Medit_solution& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].components, b[i].components);
    EXPECT_EQ(a[i].values, b[i].values);
    EXPECT_EQ(a[i].number_of_vertices(), 100u);
  }
}

} // namespace medit_files

#endif // TEST_SURFACE_MESH_ADAPTATION_MEDIT_FILES_H

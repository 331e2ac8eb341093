// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which edges and vertices are features, and which are noise.

#include "surface/references.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace test_features {

using namespace references_of_tests;
using SMA::Features;

std::size_t count(const Features& f, Vertex_class c)
{
  return std::size_t(std::count(f.vertex_class.begin(), f.vertex_class.end(), c));
}

TEST(Features, of_a_smooth_closed_surface_are_none)
{
  for (const Soup& soup : {shapes::sphere(3, 0.3), shapes::torus(48, 24, 0.2)}) {
    const Surface s = reference(soup);
    EXPECT_TRUE(s.features.curves.empty());
    EXPECT_EQ(count(s.features, Vertex_class::smooth), soup.points.size());
  }
}

TEST(Features, of_a_cube_are_twelve_curves_and_eight_corners)
{
  const Surface s = reference(shapes::cube(5));
  EXPECT_EQ(s.features.curves.size(), 12u);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 8u);
  EXPECT_EQ(count(s.features, Vertex_class::curve), 12u * 4u);
  for (const SMA::Feature_curve& c : s.features.curves) {
    EXPECT_FALSE(c.is_closed());
    EXPECT_NEAR(c.length(), 2, 1e-12);
    EXPECT_EQ(c.vertices.size(), 6u);
    for (const Vector_3& t : c.tangents) EXPECT_NEAR(t.cwiseAbs().maxCoeff(), 1, 1e-12);
  }
}

TEST(Features, of_a_capped_cylinder_are_two_closed_curves)
{
  const Surface s = reference(shapes::capped_cylinder(32, 6, 2));
  ASSERT_EQ(s.features.curves.size(), 2u);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 0u);
  for (const SMA::Feature_curve& c : s.features.curves) {
    EXPECT_TRUE(c.is_closed());
    EXPECT_NEAR(c.length(), 32 * 2 * std::sin(pi / 32), 1e-12);
    for (std::size_t i = 0; i < c.vertices.size(); ++i) {
      const Vector_3& p = s.points[c.vertices[i]];
      EXPECT_NEAR(c.tangents[i].dot(Vector_3(p[0], p[1], 0)), 0, 1e-12); // exact for even points on a circle
    }
  }
}

TEST(Features, are_the_same_on_both_sides_of_an_edge)
{
  for (const Soup& soup :
       {shapes::cube(4), shapes::capped_cylinder(24, 5, 1), shapes::square(6), shapes::open_cylinder(9, 4, 1)})
    EXPECT_TRUE(checks::is_valid(reference(soup).mesh));
}

TEST(Features, of_a_square_are_its_sides)
{
  const Surface s = reference(shapes::square(8));
  EXPECT_EQ(s.features.curves.size(), 4u);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 4u);
  Feature_parameters off;
  off.detect_ridges = false;
  EXPECT_EQ(reference(shapes::square(8), off).features.curves.size(), 4u) << "boundaries are features in any case";
  EXPECT_TRUE(reference(shapes::cube(4), off).features.curves.empty());
}

TEST(Features, depend_on_the_angle_asked_for)
{
  const Soup prism = shapes::capped_cylinder(9, 3, 1); // edges of the side turn by 40 degrees, those of the caps by 90
  Feature_parameters p;
  EXPECT_EQ(count(reference(prism, p).features, Vertex_class::corner), 0u);
  p.ridge_angle = 39;
  const Features sharp = reference(prism, p).features;
  EXPECT_EQ(count(sharp, Vertex_class::corner), 18u);
  EXPECT_EQ(sharp.curves.size(), 9u + 18u);
  p.ridge_angle = 91;
  EXPECT_TRUE(reference(prism, p).features.curves.empty());
}

/// Marks the edges of a chain of vertices as constrained.
Feature_parameters constrained_chain(const Soup& soup, const std::vector<Index>& chain)
{
  const Mesh_view m = shapes::view(soup);
  Feature_parameters p;
  p.halfedge_constraint.assign(m.number_of_halfedges(), SMA::Edge_constraint::none);
  for (std::size_t i = 1; i < chain.size(); ++i)
    for (const Index h : {m.halfedge(chain[i - 1], chain[i]), m.halfedge(chain[i], chain[i - 1])})
      p.halfedge_constraint[h] = SMA::Edge_constraint::crease;
  return p;
}

TEST(Features, of_constrained_edges_end_in_corners)
{
  const Soup soup = shapes::torus(30, 15);
  std::vector<Index> chain;
  for (Index i = 3; i < 10; ++i) chain.push_back(i); // along a parallel
  const Surface s = reference(soup, constrained_chain(soup, chain));
  ASSERT_EQ(s.features.curves.size(), 1u);
  EXPECT_EQ(s.features.curves[0].vertices.size(), chain.size());
  EXPECT_EQ(count(s.features, Vertex_class::corner), 2u);
  EXPECT_EQ(s.features.vertex_class[3], Vertex_class::corner);
  EXPECT_EQ(s.features.vertex_class[9], Vertex_class::corner);
  EXPECT_EQ(s.features.vertex_class[6], Vertex_class::curve);
  // a single edge is kept too
  EXPECT_EQ(reference(soup, constrained_chain(soup, {3, 4})).features.curves.size(), 1u);
}

TEST(Features, of_constrained_vertices_are_corners)
{
  const Soup soup = shapes::capped_cylinder(24, 5, 1);
  Feature_parameters p;
  p.vertex_is_constrained.assign(soup.points.size(), 0);
  p.vertex_is_constrained[5] = 1;  // on the lower ridge
  p.vertex_is_constrained[60] = 1; // on the side
  const Surface s = reference(soup, p);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 2u);
  EXPECT_EQ(s.features.curves.size(), 2u);
  std::size_t loops = 0;
  for (const auto& c : s.features.curves) {
    EXPECT_EQ(c.vertices.front(), c.vertices.back());
    if (!c.is_closed()) ++loops; // from the corner back to it
  }
  EXPECT_EQ(loops, 1u);
}

/// A plane with a crease of `length` edges in its middle, which is lifted by `height`.
Soup creased(Index length, double height)
{
  const Index n = 20;
  Soup s = shapes::square(n);
  for (Index i = 0; i <= length; ++i) s.points[(n / 2) * (n + 1) + 4 + i][2] = height;
  return s;
}

TEST(Features, that_are_short_and_isolated_are_noise)
{
  // a spike: ridges around it branch, thus are no chain; what counts is that long creases stay
  const Surface s = reference(creased(9, 0.06)); // turns by more than 45 degrees at its foot, too
  EXPECT_GT(s.features.curves.size(), 4u);

  // an edge that is lifted out of a sphere until it is just sharp
  Soup sphere = shapes::sphere(3);
  const Mesh_view m = shapes::view(sphere);
  const Index h = 300, v = m.source(h), w = m.target(h);
  const Feature_parameters p;
  const auto is_sharp = [&](Index g) {
    const Vector_3 a = SMA::internal::face_normal(m, sphere.points, g),
                   b = SMA::internal::face_normal(m, sphere.points, m.twin[g]);
    return a.dot(b) < std::cos(p.ridge_angle * pi / 180) * a.norm() * b.norm();
  };
  for (int i = 0; i < 200 && !is_sharp(h); ++i)
    for (const Index x : {v, w}) sphere.points[x] *= 1.001;
  ASSERT_TRUE(is_sharp(h));
  std::size_t sharp = 0;
  for (Index g = 0; g < m.number_of_halfedges(); ++g) sharp += m.is_edge_owner(g) && is_sharp(g);
  ASSERT_EQ(sharp, 1u);
  EXPECT_TRUE(reference(sphere).features.curves.empty());
  // unless the user insists
  EXPECT_EQ(reference(sphere, constrained_chain(sphere, {v, w})).features.curves.size(), 1u);
}

TEST(Features, that_branch_off_others_and_end_at_once_are_noise)
{
  const auto number_of_curves = [](Index length, bool is_branch) {
    const Soup s = creased(length, 0.028);
    const Index row = 21, start = 10 * row + 4; // of the crease: a constrained curve runs through it
    const Feature_parameters p = is_branch ? constrained_chain(s, {start - row, start, start + row}) : Feature_parameters();
    return reference(s, p).features.curves.size();
  };
  const std::size_t boundary = 4;
  EXPECT_EQ(number_of_curves(2, true), boundary + 1);
  EXPECT_EQ(number_of_curves(4, true), boundary + 3);
  EXPECT_EQ(number_of_curves(4, false), boundary);
  EXPECT_EQ(number_of_curves(5, false), boundary + 1);
}

/// Puts a vertex into face `f` that lies beyond the edge from its corner `i` on, by a part of the height of the face:
/// the face over that edge is folded over. Returns the new vertex.
Index fold(Soup& s, std::size_t f, std::size_t i, double part = 0.02)
{
  const shapes::Triangle t = s.triangles[f];
  const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3], x = Index(s.points.size());
  const Vector_3 middle = 0.5 * (s.points[a] + s.points[b]);
  s.points.push_back(middle + part * (middle - s.points[c]));
  s.triangles[f] = {a, b, x};
  s.triangles.push_back({b, c, x});
  s.triangles.push_back({c, a, x});
  return x;
}

TEST(Features, of_folds_are_those_of_the_faces_around)
{
  for (const double part : {0.02, 0.3}) {
    Soup sphere = shapes::sphere(3);
    for (const std::size_t f : {0u, 500u, 900u}) fold(sphere, f, f % 3, part);
    EXPECT_TRUE(reference(sphere).features.curves.empty()) << part;
  }

  // on a ridge: it takes the way around the sliver, through the new vertex
  Soup cube = shapes::cube(5);
  const auto is_on_edge = [&](Index v, Index w) {
    const Vector_3 m = 0.5 * (cube.points[v] + cube.points[w]);
    return (m.cwiseAbs().array() > 1 - 1e-9).count() == 2;
  };
  std::size_t f = 0, i = 0;
  while (!is_on_edge(cube.triangles[f][i], cube.triangles[f][(i + 1) % 3])) {
    i = (i + 1) % 3;
    f += i == 0;
  }
  const Index x = fold(cube, f, i);
  const Features features = reference(cube).features;
  EXPECT_EQ(features.curves.size(), 12u);
  EXPECT_EQ(count(features, Vertex_class::corner), 8u);
  EXPECT_EQ(count(features, Vertex_class::curve), 12u * 4u + 1u);
  EXPECT_EQ(features.vertex_class[x], Vertex_class::curve);
}

/// Two plates of width `width` that meet at a right angle in a row of edges of length 1. The `flipped` edge of these is
/// replaced by the other diagonal of its two faces, which leaves a dent.
Soup plates(Index edges, double width, Index flipped)
{
  Soup s;
  for (Index i = 0; i <= edges; ++i) s.points.push_back({double(i), 0, 0});
  for (Index i = 0; i < edges; ++i) s.points.push_back({i + 0.5, width, 0});
  for (Index i = 0; i < edges; ++i) s.points.push_back({i + 0.5, 0, -width});
  const Index first = edges + 1;
  for (Index i = 0; i < edges; ++i) {
    const Index above = first + i, below = first + edges + i;
    if (i == flipped) {
      s.triangles.push_back({i, below, above});
      s.triangles.push_back({i + 1, above, below});
    } else {
      s.triangles.push_back({i, i + 1, above});
      s.triangles.push_back({i + 1, i, below});
    }
    if (i + 1 == edges) break;
    s.triangles.push_back({i + 1, above + 1, above});
    s.triangles.push_back({i + 1, below, below + 1});
  }
  return s;
}

TEST(Features, are_on_no_wrong_diagonals)
{
  const Index edges = 10, flipped = 4;
  for (const double width : {0.5, 2.0}) {
    const Surface straight = reference(plates(edges, width, edges));
    for (Index i = 0; i < edges; ++i) EXPECT_TRUE(straight.mesh.is_feature(straight.mesh.halfedge(i, i + 1)));
    const Surface dented = reference(plates(edges, width, flipped));
    const Index above = edges + 1 + flipped, below = above + edges;
    // the ridge turns by 90 degrees; the other diagonal by 71 where the faces are wide along it, else by 141
    EXPECT_EQ(dented.mesh.is_feature(dented.mesh.halfedge(above, below)), width < 1);
  }
}

TEST(Features, have_corners_at_the_points_of_cones)
{
  const Index around = 24;
  for (const double height : {0.4, 0.8, 1.0, 1.3, 3.0}) {
    Soup s = shapes::revolved({{1, 0}}, around);
    s.points.push_back({0, 0, height});
    for (Index i = 0; i < around; ++i) s.triangles.push_back({i, (i + 1) % around, around});
    const double angles = 2 * pi / std::hypot(1, height); // of the faces around the point, that of a cone
    EXPECT_EQ(reference(s).features.vertex_class[around] == Vertex_class::corner, angles < 240 * pi / 180) << height;
  }
  EXPECT_EQ(count(reference(shapes::icosahedron(), Feature_parameters()).features, Vertex_class::corner), 0u);
  Feature_parameters none;
  none.detect_ridges = false;
  const Soup spike = [] {
    Soup s = shapes::sphere(2);
    s.points[0] *= 3;
    return s;
  }();
  EXPECT_EQ(reference(spike).features.vertex_class[0], Vertex_class::corner);
  EXPECT_EQ(reference(spike, none).features.vertex_class[0], Vertex_class::smooth);
}

TEST(Features, of_tiny_holes_are_corners)
{
  Soup s = shapes::sphere(3);
  s.triangles.erase(s.triangles.begin() + 100); // a hole of three edges
  const Surface r = reference(s);
  EXPECT_EQ(count(r.features, Vertex_class::corner), 3u);
  EXPECT_EQ(count(r.features, Vertex_class::curve), 0u);
}

} // namespace test_features

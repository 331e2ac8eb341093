// SPDX-License-Identifier: GPL-3.0-or-later
//
// The primitives of the connectivity, and by brute force the claim on which all parallelism rests: that operations with
// disjoint claims may be applied together, in any order.

#include "checks.h"
#include "mesh/views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace test_mesh_view {

using namespace views_of_tests;
using checks::Topology;

TEST(Mesh_view, walks_the_fans_of_closed_and_open_surfaces)
{
  for (const Soup& soup : small_surfaces()) {
    const Mesh_view m = shapes::view(soup);
    ASSERT_TRUE(checks::is_valid(m));
    std::vector<std::vector<Index>> neighbors(soup.points.size());
    checks::for_each_edge(soup.triangles, [&](Index a, Index b) {
      neighbors[a].push_back(b);
      neighbors[b].push_back(a);
    });
    for (Index v = 0; v < soup.points.size(); ++v) {
      std::vector<Index> ring = closed_ring(m, v);
      EXPECT_EQ(m.degree(v), neighbors[v].size());
      ring.erase(ring.begin());
      EXPECT_TRUE(std::is_permutation(ring.begin(), ring.end(), neighbors[v].begin(), neighbors[v].end()));
      for (Index w = 0; w < soup.points.size(); ++w)
        EXPECT_EQ(m.are_adjacent(v, w), std::count(ring.begin(), ring.end(), w) == 1);
    }
  }
}

TEST(Mesh_view, stays_a_manifold_under_random_flips)
{
  for_many_views(40, [](Mesh_view& m, Random& random) {
    const Topology before = checks::topology(m);
    scramble(m, 100, random);
    ASSERT_TRUE(checks::is_valid(m));
    ASSERT_EQ(checks::topology(m), before);
  });
}

TEST(Mesh_view, is_as_it_was_after_a_flip_there_and_back)
{
  for_many_views(10, [](Mesh_view& m, Random& random) {
    for (const Index h : flippable_edges(m)) {
      const std::vector<Index> v = four_vertices(m, h);
      std::size_t n = 0;
      const auto edge_set = [&](const Mesh_view& x) {
        std::vector<std::pair<Index, Index>> edges;
        checks::for_each_edge(checks::live_triangles(x, n),
                              [&](Index a, Index b) { edges.push_back(std::minmax(a, b)); });
        std::sort(edges.begin(), edges.end());
        return edges;
      };
      const auto before = edge_set(m);
      Mesh_view flipped = m;
      flipped.flip(h);
      ASSERT_TRUE(flipped.are_adjacent(v[2], v[3]));
      ASSERT_FALSE(flipped.are_adjacent(v[0], v[1]));
      ASSERT_NE(edge_set(flipped), before);
      flipped.flip(flipped.halfedge(v[2], v[3]));
      ASSERT_EQ(edge_set(flipped), before);
      if (random.below(3) == 0) break;
    }
  });
}

Index curve_of(const Mesh_view& m, Index v, Index w)
{
  const Index h = m.halfedge(v, w);
  return m.curve[h != SMA::no_index ? h : m.halfedge(w, v)];
}

TEST(Mesh_view, is_as_it_was_after_a_split_is_collapsed)
{
  std::size_t splits = 0;
  for_many_views(10, [&](Mesh_view& m, Random& random) {
    add_features(m, 0.1, random);
    std::size_t n = 0;
    const Topology before = checks::topology(m);
    const auto triangles_before = checks::live_triangles(m, n);
    for (const Index h : splittable_edges(m)) {
      const std::vector<Index> corners = four_vertices(m, h);
      Mesh_view m2 = m;
      const Index v = split(m2, h);
      ASSERT_TRUE(checks::is_valid(m2));
      ASSERT_EQ(checks::topology(m2), before);
      ASSERT_EQ(m2.degree(v), 4u);
      for (const Index c : corners) ASSERT_TRUE(m2.are_adjacent(v, c));
      for (std::size_t end : {0, 1})
        for (std::size_t side : {2, 3})
          ASSERT_EQ(curve_of(m2, corners[end], corners[side]), curve_of(m, corners[end], corners[side]));
      ASSERT_FALSE(m2.are_adjacent(corners[0], corners[1]));
      const Mesh_view::Directed_edge back{m2.halfedge(v, corners[0]), true};
      if (!m2.is_collapsible(back)) continue; // where a vertex has three neighbours only
      m2.collapse(back);
      ASSERT_TRUE(checks::is_valid(m2));
      ASSERT_EQ(checks::topology(m2), before);
      ASSERT_TRUE(m2.are_adjacent(corners[0], corners[1]));
      ASSERT_EQ(checks::live_triangles(m2, n).size(), triangles_before.size());
      ++splits;
    }
  });
  EXPECT_GT(splits, 1000u);
}

TEST(Mesh_view, stays_a_manifold_under_any_collapse_that_it_allows)
{
  std::size_t allowed = 0;
  for_many_views(20, [&](Mesh_view& m, Random& random) {
    add_features(m, 0.1, random);
    const Topology before = checks::topology(m);
    for (const Mesh_view::Directed_edge& e : collapsible_edges(m)) {
      Mesh_view collapsed = m;
      const Index s = m.vanishing_vertex(e), d = m.kept_vertex(e);
      const bool was_border = m.is_border_vertex(d);
      collapsed.collapse(e);
      ASSERT_TRUE(checks::is_valid(collapsed));
      ASSERT_EQ(checks::topology(collapsed), before);
      ASSERT_TRUE(collapsed.is_removed_vertex(s));
      ASSERT_EQ(collapsed.is_border_vertex(d), was_border);
      ++allowed;
    }
  });
  EXPECT_GT(allowed, 1000u);
}

TEST(Mesh_view, refuses_every_collapse_of_the_smallest_surfaces)
{
  const Soup triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const Soup& soup : {shapes::tetrahedron(), triangle}) EXPECT_TRUE(collapsible_edges(shapes::view(soup)).empty());
  // the hole of a cylinder that is a triangle cannot shrink
  const Mesh_view m = shapes::view(shapes::open_cylinder(3, 4, 1));
  for (const auto& e : collapsible_edges(m)) EXPECT_FALSE(m.is_border(e.h));
}

TEST(Mesh_view, keeps_both_curves_of_a_wedge_that_vanishes)
{
  Mesh_view m = shapes::view(shapes::sphere(1));
  const Mesh_view::Directed_edge e = collapsible_edges(m).front();
  const Index s = m.vanishing_vertex(e), d = m.kept_vertex(e), a = m.apex(e.h), b = m.apex(m.twin[e.h]);
  m.set_curve(m.halfedge(s, a), 3); // the vanishing side
  m.set_curve(m.halfedge(d, b), 4); // the side that stays
  m.collapse(e);
  EXPECT_EQ(m.curve[m.halfedge(d, a)], 3u);
  EXPECT_EQ(m.curve[m.halfedge(d, b)], 4u);
  ASSERT_TRUE(checks::is_valid(m));
}

// Independence

/// Applies random maximal sets of operations with disjoint claims to many surfaces, several rounds on each; returns the
/// number of operations.
template <class Candidates, class Claims, class Apply>
std::size_t apply_independent_sets(const Candidates& candidates, const Claims& claims, const Apply& apply)
{
  std::size_t applied = 0;
  for_many_views(400, [&](Mesh_view& m, Random& random) {
    add_features(m, random.below(2) == 0 ? 0.1 : 0, random);
    const Topology before = checks::topology(m);
    for (int round = 0; round < 4; ++round) {
      const auto chosen = independent(m, candidates(m), random, [&](const auto& o) { return claims(m, o); });
      for (const auto& operation : chosen) apply(m, operation);
      ASSERT_TRUE(checks::is_valid(m));
      ASSERT_EQ(checks::topology(m), before);
      applied += chosen.size();
    }
  });
  return applied;
}

TEST(Independence, of_collapses_with_disjoint_closed_rings)
{
  EXPECT_GT(apply_independent_sets(collapsible_edges, ring_of_vanishing,
                                   [](Mesh_view& m, const Mesh_view::Directed_edge& e) { m.collapse(e); }),
            10000u);
}

TEST(Independence, of_flips_with_disjoint_vertices)
{
  EXPECT_GT(apply_independent_sets(flippable_edges, four_vertices, [](Mesh_view& m, Index h) { m.flip(h); }), 10000u);
}

TEST(Independence, of_splits_with_disjoint_vertices)
{
  EXPECT_GT(apply_independent_sets(splittable_edges, four_vertices, [](Mesh_view& m, Index h) { split(m, h); }), 10000u);
}

/// With claims that are too small something must break, else the tests of collapses and flips above prove nothing.
TEST(Independence, needs_the_whole_neighbourhood)
{
  std::size_t broken_by_collapses = 0, broken_by_flips = 0;
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    Mesh_view m = shapes::view(shapes::sphere(1)), n = m;
    scramble(m, 200, random);
    scramble(n, 200, random);
    // the edges of disjoint pairs of faces: two of them may create the same edge, or one that the other saw missing
    for (const Index h : independent(n, flippable_edges(n), random, [&](Index h) {
           return std::vector<Index>{h / 3, n.twin[h] / 3};
         }))
      n.flip(h);
    if (!checks::is_valid(n)) ++broken_by_flips;

    // vertices that vanish are not adjacent: the rings may still share vertices
    bool is_whole = true;
    for (const auto& e : independent(m, collapsible_edges(m), random, [&](const Mesh_view::Directed_edge& x) {
           return std::vector<Index>{m.vanishing_vertex(x), m.kept_vertex(x)};
         })) {
      is_whole = is_whole && !m.is_removed_face(e.h / 3) && m.is_collapsible(e);
      if (!is_whole) break;
      m.collapse(e);
    }
    if (!is_whole) ++broken_by_collapses;
  }
  EXPECT_GT(broken_by_flips, 20u);
  EXPECT_GT(broken_by_collapses, 20u);
}

} // namespace test_mesh_view

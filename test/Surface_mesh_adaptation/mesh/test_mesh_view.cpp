// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connectivity: reading and writing face graphs, the primitives, and by brute force the claim on which all
// parallelism rests: that operations with disjoint claims may be applied together, in any order.

#include "checks.h"
#include "policies.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/fill_holes.h>
#include <CGAL/Surface_mesh_adaptation/mesh/restructure.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using checks::Topology;
using shapes::Index;
using shapes::no_index;
using shapes::Random;
using shapes::Soup;
using shapes::Triangle;
using shapes::Vector_3;
using SMA::Mesh_view;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface_mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

// Operations

bool is_flippable(const Mesh_view& m, Index h)
{
  return !m.is_removed_face(h / 3) && !m.is_border(h) && !m.is_feature(h) &&
         !m.are_adjacent(m.apex(h), m.apex(m.twin[h]));
}

std::vector<Mesh_view::Directed_edge> collapsible_edges(const Mesh_view& m)
{
  std::vector<Mesh_view::Directed_edge> result;
  for (Index h = 0; h < m.number_of_halfedges(); ++h) {
    if (m.is_removed_face(h / 3)) continue;
    for (const bool source_vanishes : {true, false}) {
      const Mesh_view::Directed_edge e{h, source_vanishes};
      if ((source_vanishes || m.is_border(h)) && m.is_collapsible(e)) result.push_back(e);
    }
  }
  return result;
}

std::vector<Index> flippable_edges(const Mesh_view& m)
{
  std::vector<Index> result;
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (is_flippable(m, h) && m.is_edge_owner(h)) result.push_back(h);
  return result;
}

std::vector<Index> closed_ring(const Mesh_view& m, Index v)
{
  std::vector<Index> ring{v};
  m.for_each_neighbor(v, [&](Index w) { ring.push_back(w); });
  return ring;
}

std::vector<Index> four_vertices(const Mesh_view& m, Index h)
{
  return {m.source(h), m.target(h), m.apex(h), m.apex(m.twin[h])};
}

/// A random maximal set of operations whose claims are disjoint, in random order.
template <class Operation, class Claims>
std::vector<Operation> independent(const Mesh_view& m, std::vector<Operation> candidates, Random& random,
                                   const Claims& claims)
{
  random.shuffle(candidates);
  std::vector<bool> is_claimed(m.number_of_halfedges(), false); // claims are vertices or faces
  std::vector<Operation> chosen;
  for (const Operation& o : candidates) {
    const std::vector<Index> mine = claims(o);
    if (std::any_of(mine.begin(), mine.end(), [&](Index v) { return is_claimed[v]; })) continue;
    for (const Index v : mine) is_claimed[v] = true;
    chosen.push_back(o);
  }
  random.shuffle(chosen);
  return chosen;
}

// Surfaces

/// Flips edges at random, which gives vertices of degree 3 and of high degree.
void scramble(Mesh_view& m, std::size_t flips, Random& random)
{
  for (std::size_t i = 0; i < flips; ++i) {
    const Index h = Index(random.below(m.number_of_halfedges()));
    if (is_flippable(m, h)) m.flip(h);
  }
}

/// Marks random edges, and the boundary, as feature curves.
void add_features(Mesh_view& m, double share, Random& random)
{
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (m.is_border(h) || random.real() < share) m.set_curve(h, Index(random.below(5)));
}

std::vector<Soup> small_surfaces()
{
  return {shapes::tetrahedron(),
          shapes::octahedron(),
          shapes::icosahedron(),
          shapes::sphere(1),
          shapes::torus(4, 3),
          shapes::torus(7, 5),
          shapes::square(1),
          shapes::square(2),
          shapes::square(5),
          shapes::cube(2),
          shapes::open_cylinder(3, 1, 1),
          shapes::open_cylinder(6, 3, 1),
          {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
}

/// Calls `test(view, random)` for many scrambled versions of the small surfaces.
template <class Test>
void for_many_views(std::size_t trials, const Test& test)
{
  Random random(7);
  for (const Soup& soup : small_surfaces())
    for (std::size_t i = 0; i < trials; ++i) {
      Mesh_view m = shapes::view(soup);
      scramble(m, i % 4 == 0 ? 0 : 3 * soup.triangles.size(), random);
      test(m, random);
      if (::testing::Test::HasFatalFailure()) return;
    }
}

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

/// The edges between the ends of which a vertex may be put, as halfedges that leave an inner vertex.
std::vector<Index> splittable_edges(const Mesh_view& m)
{
  std::vector<Index> result;
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (!m.is_removed_face(Mesh_view::face(h)) && !m.is_border(h) && !m.is_feature(h) && !m.is_border_vertex(m.source(h)))
      result.push_back(h);
  return result;
}

/// Splits the edge of `h` with new elements at the end.
Index split(Mesh_view& m, Index h)
{
  const Index v = Index(m.number_of_vertices()), f = Index(m.number_of_faces());
  m.outgoing.resize(v + 1);
  for (auto* table : {&m.corner, &m.twin, &m.curve}) table->resize(3 * (f + 2));
  m.split_edge(h, v, f, f + 1);
  return v;
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

std::vector<Index> ring_of_vanishing(const Mesh_view& m, const Mesh_view::Directed_edge& e)
{
  return closed_ring(m, m.vanishing_vertex(e));
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

/// Collapses at most `most` edges at random.
void make_holes(Mesh_view& m, std::size_t most, Random& random)
{
  std::vector<Mesh_view::Directed_edge> chosen = independent(
    m, collapsible_edges(m), random, [&](const Mesh_view::Directed_edge& e) { return ring_of_vanishing(m, e); });
  chosen.resize((std::min)(most, chosen.size()));
  for (const auto& e : chosen) m.collapse(e);
}

// Restructuring

/// Marks edges at random, on both sides, and a random diagonal where there is a choice.
SMA::Buffer<std::uint8_t> random_marks(const Mesh_view& m, double share, Random& random)
{
  SMA::Buffer<std::uint8_t> codes(m.number_of_faces(), std::uint8_t(0));
  const auto mark = [&](Index h) { codes[h / 3] = std::uint8_t(codes[h / 3] | 1u << (h % 3)); };
  for (Index h = 0; h < m.number_of_halfedges(); ++h) {
    if (m.is_removed_face(h / 3) || !m.is_edge_owner(h) || random.real() >= share) continue;
    mark(h);
    if (!m.is_border(h)) mark(m.twin[h]);
  }
  for (std::uint8_t& c : codes)
    if ((c == 3 || c == 5 || c == 6) && random.below(2) == 0) c = std::uint8_t(c | 8);
  return codes;
}

std::size_t number_of_marks(const Mesh_view& m, const SMA::Buffer<std::uint8_t>& codes, bool on_curves_only)
{
  std::size_t n = 0;
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (!m.is_removed_face(h / 3) && m.is_edge_owner(h) && (codes[h / 3] >> (h % 3) & 1) != 0 &&
        (m.is_feature(h) || !on_curves_only))
      ++n;
  return n;
}

std::size_t number_of_feature_edges(const Mesh_view& m)
{
  std::size_t n = 0;
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (!m.is_removed_face(h / 3) && m.is_edge_owner(h) && m.is_feature(h)) ++n;
  return n;
}

TEST(Restructuring, splits_any_set_of_edges)
{
  const SMA::Sequential_execution sequential;
  for_many_views(150, [&](Mesh_view& m, Random& random) {
    add_features(m, 0.2, random);
    const Topology before = checks::topology(m);
    for (int round = 0; round < 3; ++round) {
      std::size_t old_vertices = 0, new_vertices = 0;
      const auto codes = random_marks(m, random.real(), random);
      checks::live_triangles(m, old_vertices);
      const std::size_t features = number_of_feature_edges(m) + number_of_marks(m, codes, true);
      const SMA::Restructuring plan(sequential, m, codes);
      Mesh_view refined;
      plan.build(sequential, refined);
      ASSERT_TRUE(checks::is_valid(refined));
      ASSERT_EQ(checks::topology(refined), before);
      checks::live_triangles(refined, new_vertices);
      ASSERT_EQ(new_vertices, old_vertices + number_of_marks(m, codes, false));
      ASSERT_EQ(new_vertices, refined.number_of_vertices()) << "there is a hole";
      ASSERT_EQ(new_vertices, plan.number_of_vertices());
      ASSERT_EQ(number_of_feature_edges(refined), features);
      m = refined;
      make_holes(m, m.number_of_vertices(), random); // for the next round
    }
  });
}

TEST(Restructuring, cuts_every_face_along_its_own_edges)
{
  const SMA::Sequential_execution sequential;
  Random random(9);
  const Soup square = shapes::square(6, 0.2);
  for (int trial = 0; trial < 50; ++trial) {
    const Mesh_view m = shapes::view(square);
    const auto codes = random_marks(m, 0.5, random);
    const SMA::Restructuring plan(sequential, m, codes);
    Mesh_view refined;
    plan.build(sequential, refined);
    Soup after{std::vector<Vector_3>(refined.number_of_vertices(), Vector_3::Constant(1e9)), {}};
    for (Index v = 0; v < m.number_of_vertices(); ++v) after.points[plan.vertex(v)] = square.points[v];
    for (Index h = 0; h < m.number_of_halfedges(); ++h)
      if (plan.is_split(h))
        after.points[plan.midpoint(h)] = (square.points[m.source(h)] + square.points[m.target(h)]) / 2;
    std::size_t n = 0;
    after.triangles = checks::live_triangles(refined, n);
    EXPECT_NEAR(checks::area(after), 1, 1e-12);
    EXPECT_GT(checks::least_area(after, [](const Vector_3&) { return Vector_3(0, 0, 1); }), 0);
  }
}

TEST(Restructuring, knows_all_sixteen_patterns)
{
  using SMA::internal::Split_pattern;
  for (std::uint8_t code = 0; code < 16; ++code) {
    const int marks = (code & 1) + (code >> 1 & 1) + (code >> 2 & 1);
    const Split_pattern& p = Split_pattern::of(code);
    EXPECT_EQ(p.number_of_children, marks + 1);
    // each child is upright, and together they fill the face
    const Eigen::Vector2d points[6] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
    double sum = 0;
    for (std::size_t c = 0; c < std::size_t(p.number_of_children); ++c) {
      const Eigen::Vector2d a = points[p.child[c][0]], b = points[p.child[c][1]] - a, d = points[p.child[c][2]] - a;
      const double area = b[0] * d[1] - b[1] * d[0];
      EXPECT_GT(area, 0);
      sum += area;
    }
    EXPECT_DOUBLE_EQ(sum, 1);
  }
  EXPECT_NE(Split_pattern::of(3).child, Split_pattern::of(11).child);
}

// Holes

/// The faces as labels of their vertices and curves of their edges, in an order that does not depend on any numbering.
std::vector<std::array<Index, 6>> labelled_faces(const Mesh_view& m, const std::vector<Index>& label)
{
  std::vector<std::array<Index, 6>> faces;
  for (Index f = 0; f < m.number_of_faces(); ++f) {
    if (m.is_removed_face(f)) continue;
    std::array<Index, 6> face{};
    std::size_t first = 0; // the corner with the least label
    for (std::size_t i = 1; i < 3; ++i)
      if (label[m.corner[3 * f + i]] < label[m.corner[3 * f + first]]) first = i;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t h = 3 * f + (first + i) % 3;
      face[i] = label[m.corner[h]];
      face[3 + i] = m.curve[h];
    }
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Fills the holes of `m` and compares it with what it was.
void expect_same_without_holes(Mesh_view& m)
{
  std::vector<Index> label(m.number_of_vertices()), vertex_holes, face_holes;
  std::iota(label.begin(), label.end(), Index(0));
  for (Index v = 0; v < m.number_of_vertices(); ++v)
    if (m.is_removed_vertex(v)) vertex_holes.push_back(v);
  for (Index f = 0; f < m.number_of_faces(); ++f)
    if (m.is_removed_face(f)) face_holes.push_back(f);
  const auto before = labelled_faces(m, label);
  const std::size_t vertices = m.number_of_vertices() - vertex_holes.size();
  std::size_t moved = 0;
  SMA::fill_holes(m, vertex_holes, face_holes, [&](Index from, Index to) {
    label[to] = label[from];
    ++moved;
  });
  ASSERT_EQ(m.number_of_vertices(), vertices);
  ASSERT_EQ(m.number_of_faces(), before.size());
  ASSERT_EQ(m.twin.size(), m.corner.size());
  ASSERT_EQ(m.curve.size(), m.corner.size());
  for (Index v = 0; v < vertices; ++v) ASSERT_FALSE(m.is_removed_vertex(v));
  ASSERT_TRUE(checks::is_valid(m));
  ASSERT_EQ(labelled_faces(m, label), before);
  ASSERT_LE(moved, vertex_holes.size());
}

TEST(Fill_holes, keeps_the_mesh_and_closes_few_and_many_holes)
{
  std::size_t with_holes = 0;
  for_many_views(60, [&](Mesh_view& m, Random& random) {
    add_features(m, 0.2, random);
    const std::size_t n = m.number_of_vertices();
    for (const std::size_t most : {std::size_t(1), n / 4, n}) {
      make_holes(m, most, random);
      with_holes += m.number_of_vertices() > std::size_t(std::count_if(m.outgoing.begin(), m.outgoing.end(),
                                                                      [](Index h) { return h != no_index; }));
      ASSERT_NO_FATAL_FAILURE(expect_same_without_holes(m));
    }
  });
  EXPECT_GT(with_holes, 500u);
}

TEST(Fill_holes, cuts_off_holes_at_the_end_and_moves_nothing_into_them)
{
  std::size_t tried = 0;
  for_many_views(20, [&](Mesh_view& m, Random&) {
    for (std::size_t i = 0; i < 3; ++i) { // the last vertices vanish one after the other
      const auto edges = collapsible_edges(m);
      const auto e = std::find_if(edges.begin(), edges.end(), [&](const Mesh_view::Directed_edge& x) {
        return m.vanishing_vertex(x) + 1 + i == m.number_of_vertices();
      });
      if (e == edges.end()) break;
      m.collapse(*e);
      ++tried;
    }
    ASSERT_NO_FATAL_FAILURE(expect_same_without_holes(m));
  });
  EXPECT_GT(tried, 100u);
}

TEST(Fill_holes, leaves_a_mesh_without_holes_alone)
{
  const Mesh_view before = shapes::view(shapes::sphere(1));
  Mesh_view m = before;
  const std::vector<Index> none;
  SMA::fill_holes(m, none, none, [](Index, Index) { FAIL() << "there is nothing to move"; });
  EXPECT_EQ(m.corner, before.corner);
  EXPECT_EQ(m.twin, before.twin);
  EXPECT_EQ(m.outgoing, before.outgoing);
}

// Blocks

/// `soup` with its vertices in random order: every block touches many others.
Soup with_shuffled_vertices(const Soup& soup, Random& random)
{
  std::vector<Index> place(soup.points.size());
  std::iota(place.begin(), place.end(), Index(0));
  random.shuffle(place);
  Soup result = soup;
  for (std::size_t v = 0; v < place.size(); ++v) result.points[place[v]] = soup.points[v];
  for (Triangle& t : result.triangles)
    for (Index& v : t) v = place[v];
  return result;
}

/// Meshes of several blocks, closed and open, in a good order and in none.
std::vector<Mesh_view> views_of_several_blocks()
{
  Random random(11);
  std::vector<Mesh_view> result;
  for (const Soup& soup : {shapes::torus(120, 70), shapes::square(80), shapes::open_cylinder(50, 90, 2)}) {
    result.push_back(shapes::view(soup));
    result.push_back(shapes::view(with_shuffled_vertices(soup, random)));
  }
  return result;
}

std::vector<Index> random_vertices(const Mesh_view& m, double share, Random& random)
{
  std::vector<Index> result;
  for (Index v = 0; v < m.number_of_vertices(); ++v)
    if (random.real() < share) result.push_back(v);
  return result;
}

TEST(Border_of_blocks, colors_blocks_differently_if_an_edge_of_a_listed_vertex_joins_them)
{
  Random random(12);
  std::size_t edges_between_blocks = 0;
  for (const Mesh_view& m : views_of_several_blocks())
    for (const double share : {0.02, 0.2, 1.0}) {
      const std::vector<Index> vertices = random_vertices(m, share, random);
      const SMA::Border_of_blocks border(SMA::Sequential_execution(), m, vertices, 1);
      std::vector<std::size_t> color(border.number_of_blocks(), ~std::size_t(0));
      const auto classes = border.blocks_by_color();
      for (std::size_t c = 0; c < classes.size(); ++c)
        for (const Index b : classes[c]) color[b] = c;
      for (std::size_t b = 0; b < border.number_of_blocks(); ++b)
        for (std::size_t i = border.begin(b); i < border.end(b); ++i) {
          ASSERT_EQ(vertices[i] / SMA::block_length, b);
          m.for_each_neighbor(vertices[i], [&](Index w) {
            const std::size_t other = w / SMA::block_length;
            if (other == b) return;
            ++edges_between_blocks;
            ASSERT_NE(color[other], color[b]);
            ASSERT_TRUE(border.stands_still(w, b));
          });
        }
    }
  EXPECT_GT(edges_between_blocks, 10000u);
}

TEST(Border_of_blocks, gives_disjoint_neighborhoods_to_blocks_of_a_color)
{
  Random random(14);
  std::size_t largest_class = 0;
  for (const Mesh_view& m : views_of_several_blocks())
    for (const double share : {0.02, 1.0}) {
      const std::vector<Index> vertices = random_vertices(m, share, random);
      const SMA::Border_of_blocks border(SMA::Sequential_execution(), m, vertices, 2);
      for (const auto& blocks : border.blocks_by_color()) {
        largest_class = (std::max)(largest_class, blocks.size());
        std::set<Index> taken;
        for (const Index b : blocks) {
          const SMA::Block_neighborhood neighborhood = border.neighborhood(b);
          ASSERT_TRUE(taken.insert(b).second);
          for (const Index other : neighborhood.adjacent) ASSERT_TRUE(taken.insert(other).second);
          for (std::size_t i = border.begin(b); i < border.end(b); ++i)
            ASSERT_TRUE(SMA::contains_ring(neighborhood, m, vertices[i]));
        }
      }
    }
  EXPECT_GT(largest_class, 1u);
}

/// Expects `sweep` to visit each vertex once, and to list the same vertices, some, with every policy.
template <class Sweep>
void expect_one_visit_of_each_vertex(const Sweep& sweep)
{
  Random random(13);
  for (const Mesh_view& m : views_of_several_blocks()) {
    const std::vector<Index> vertices = random_vertices(m, 0.3, random);
    std::vector<Index> first;
    for_each_policy([&](const auto& execution, const std::string& name) {
      SCOPED_TRACE(name);
      std::vector<int> visits(m.number_of_vertices(), 0);
      SMA::Sweep_counts counts;
      const std::vector<Index> odd = sweep(
        execution, m, vertices, counts, [&](Index v, const auto&, SMA::Sweep_counts& c, std::vector<Index>& list) {
        ++visits[v];
        ++c.candidates;
        if (v % 2 == 1) list.push_back(v);
        });
      EXPECT_EQ(counts.candidates, vertices.size());
      for (const Index v : vertices) EXPECT_EQ(visits[v], 1);
      EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), std::size_t(0)), vertices.size());
      if (first.empty()) first = odd;
      EXPECT_EQ(odd, first);
    });
    EXPECT_FALSE(first.empty());
  }
}

TEST(Sweep_block_borders, visits_each_vertex_once_and_lists_the_same_with_every_policy)
{
  expect_one_visit_of_each_vertex([](auto&&... arguments) { return SMA::sweep_block_borders(arguments...); });
}

TEST(Sweep_block_neighborhoods, visits_each_vertex_once_and_lists_the_same_with_every_policy)
{
  expect_one_visit_of_each_vertex([](auto&&... arguments) { return SMA::sweep_block_neighborhoods(arguments...); });
}

TEST(Sweep_blocks, visits_each_vertex_once_within_its_block)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    SCOPED_TRACE(name);
    const std::size_t n = 5 * SMA::block_length + 3;
    std::vector<int> visits(n, 0);
    SMA::Sweep_counts counts;
    const std::vector<Index> deferred = SMA::sweep_blocks(
      execution, n, counts, [&](Index v, const SMA::Block& block, SMA::Sweep_counts& c, std::vector<Index>& list) {
      ++visits[v];
      ++c.applied;
      if (!block.contains(v) || v % 100 == 0) list.push_back(v);
      });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), std::ptrdiff_t(n));
    EXPECT_EQ(counts.applied, n);
    EXPECT_EQ(counts.deferred, deferred.size());
    ASSERT_EQ(deferred.size(), (n + 99) / 100);
    for (std::size_t i = 0; i < deferred.size(); ++i) EXPECT_EQ(deferred[i], 100 * i);
  });
}

// Face graphs

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

} // namespace

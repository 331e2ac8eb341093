// SPDX-License-Identifier: GPL-3.0-or-later
//
// What builds a mesh anew after many splits, or closes the holes that collapses leave.

#include "checks.h"
#include "mesh/views.h"
#include "policies.h"

#include <CGAL/Surface_mesh_adaptation/mesh/Splitting.h>
#include <CGAL/Surface_mesh_adaptation/mesh/fill_holes.h>
#include <CGAL/Surface_mesh_adaptation/mesh/restructure.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace test_restructuring {

namespace SMA = CGAL::Surface_mesh_adaptation;
using namespace views_of_tests;
using checks::Topology;

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

/// The ends of the edge that a vertex is the middle of, or twice the vertex itself, with the numbers before.
using Origin = std::array<Index, 2>;

/// The origin of each vertex that `plan` makes, where `number(v)` is the new number of `v`.
template <class Plan, class Number>
std::vector<Origin> origins(const Mesh_view& m, const SMA::Buffer<std::uint8_t>& codes, const Plan& plan,
                            const Number& number)
{
  std::vector<Origin> result(plan.number_of_vertices(), Origin{SMA::no_index, SMA::no_index});
  for (Index v = 0; v < m.number_of_vertices(); ++v)
    if (!m.is_removed_vertex(v)) result[number(v)] = {v, v};
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (!m.is_removed_face(h / 3) && (codes[h / 3] >> h % 3 & 1) != 0)
      result[plan.midpoint(h)] = {(std::min)(m.source(h), m.target(h)), (std::max)(m.source(h), m.target(h))};
  return result;
}

/// Each face with the origins of its corners, the curves of its edges and its label.
std::set<std::array<Index, 10>> described_faces(const Mesh_view& m, const std::vector<Origin>& origin)
{
  std::set<std::array<Index, 10>> result;
  for (Index f = 0; f < m.number_of_faces(); ++f) {
    if (m.is_removed_face(f)) continue;
    Index first = 3 * f;
    for (Index h = 3 * f; h < 3 * f + 3; ++h)
      if (origin[m.corner[h]] < origin[m.corner[first]]) first = h;
    std::array<Index, 10> face;
    for (Index i = 0, h = first; i < 3; ++i, h = Mesh_view::next(h)) {
      face[3 * i] = origin[m.corner[h]][0];
      face[3 * i + 1] = origin[m.corner[h]][1];
      face[3 * i + 2] = m.curve[h];
    }
    face[9] = m.has_labels() ? m.label[f] : 0;
    result.insert(face);
  }
  return result;
}

TEST(Splitting, makes_the_same_faces_as_a_rewrite)
{
  for_many_views(40, [&](Mesh_view& m, Random& random) {
    add_features(m, 0.2, random);
    if (random.real() < 0.5) {
      m.label.resize(m.number_of_faces());
      for (Index& label : m.label) label = Index(random.below(3));
    }
    for (int round = 0; round < 3; ++round) {
      make_holes(m, m.number_of_vertices() / 4, random);
      const auto codes = random_marks(m, random.real(), random);
      const SMA::Restructuring plan(SMA::Sequential_execution(), m, codes);
      Mesh_view expected;
      plan.build(SMA::Sequential_execution(), expected);
      const auto faces = described_faces(expected, origins(m, codes, plan, [&](Index v) { return plan.vertex(v); }));
      std::vector<Index> marked; // and some others
      for (Index f = 0; f < m.number_of_faces(); ++f)
        if (codes[f] != 0 || (!m.is_removed_face(f) && random.real() < 0.1)) marked.push_back(f);
      const Mesh_view before = m;
      for_each_policy([&](const auto& execution, const std::string& name) {
        SCOPED_TRACE(name);
        m = before;
        const SMA::Splitting splitting(execution, m, codes, marked);
        const auto origin = origins(m, codes, splitting, [](Index v) { return v; });
        splitting.apply(execution, m);
        ASSERT_EQ(m.number_of_faces(), splitting.number_of_faces());
        ASSERT_EQ(m.number_of_vertices(), splitting.number_of_vertices());
        ASSERT_TRUE(checks::is_valid(m));
        ASSERT_EQ(described_faces(m, origin), faces);
      });
    }
  });
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

} // namespace test_restructuring

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sweeps over blocks of vertices, and over their borders.

#include "policies.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace test_block_sweep {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Random;
using shapes::Soup;
using shapes::Triangle;
using SMA::Mesh_view;

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

TEST(Short_blocks, are_many_where_there_would_be_too_few)
{
  std::size_t last = 0;
  for (std::size_t n = 32 * SMA::block_length + 1; n < 10000000; n += 1 + n / 7) {
    const std::size_t length = SMA::length_of_short_blocks(n);
    EXPECT_GE(length, last);
    EXPECT_TRUE(length == SMA::block_length || n / length <= 512) << n;
    EXPECT_GE(SMA::number_of_chunks(n, length), n < 100000 ? 128u : 256u) << n;
    last = length;
  }
  EXPECT_EQ(last, SMA::block_length);
  EXPECT_EQ(SMA::length_of_short_blocks(1000), SMA::block_length);
}

TEST(Border_of_blocks, colors_blocks_differently_if_an_edge_of_a_listed_vertex_joins_them)
{
  Random random(12);
  std::size_t edges_between_blocks = 0;
  for (const Mesh_view& m : views_of_several_blocks())
    for (const double share : {0.02, 0.2, 1.0}) {
      const std::vector<Index> vertices = random_vertices(m, share, random);
      const std::size_t length = SMA::block_length >> random.below(3);
      const SMA::Border_of_blocks border(SMA::Sequential_execution(), m, vertices, 1, length);
      std::vector<std::size_t> color(border.number_of_blocks(), ~std::size_t(0));
      const auto classes = border.blocks_by_color();
      for (std::size_t c = 0; c < classes.size(); ++c)
        for (const Index b : classes[c]) color[b] = c;
      for (std::size_t b = 0; b < border.number_of_blocks(); ++b)
        for (std::size_t i = border.begin(b); i < border.end(b); ++i) {
          ASSERT_EQ(vertices[i] / length, b);
          m.for_each_neighbor(vertices[i], [&](Index w) {
            const std::size_t other = w / length;
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

} // namespace test_block_sweep

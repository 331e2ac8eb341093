// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colourings of graphs.

#include "policies.h"
#include "tasks/graphs.h"

#include <CGAL/Surface_mesh_adaptation/tasks/graph_coloring.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>

namespace test_graph_coloring {

namespace SMA = CGAL::Surface_mesh_adaptation;
using namespace graphs_of_tests;

template <class Execution>
SMA::Graph_coloring coloring(const Execution& execution, const Graph& g)
{
  return SMA::graph_coloring(execution, g.size(), neighbors_in(g));
}

/// The first-fit colours in the order of the ids, by a code of their own.
Ids first_fit_colors(const Graph& g)
{
  Ids color(g.size(), ~0u);
  for (std::size_t i = 0; i < g.size(); ++i) {
    std::set<std::uint32_t> used;
    for (const std::uint32_t j : g.neighbors[i]) used.insert(color[j]);
    color[i] = 0;
    while (used.count(color[i]) != 0) ++color[i];
  }
  return color;
}

bool is_proper(const Graph& g, const Ids& color)
{
  const auto edges = g.edges();
  return color.size() == g.size() &&
         std::all_of(edges.begin(), edges.end(), [&](const auto& e) { return color[e.first] != color[e.second]; });
}

std::uint32_t number_of_colors(const Ids& color)
{
  return color.empty() ? 0 : *std::max_element(color.begin(), color.end()) + 1;
}

TEST(Graph_coloring, is_proper_and_the_same_with_every_policy)
{
  for (const Graph& g : graphs()) {
    SCOPED_TRACE(g.name);
    const SMA::Graph_coloring first = coloring(SMA::Sequential_execution(), g);
    ASSERT_TRUE(is_proper(g, first.color));
    for_each_policy([&](const auto& execution, const std::string& name) {
      EXPECT_EQ(coloring(execution, g).color, first.color) << name;
    });
  }
}

TEST(Graph_coloring, uses_few_colors)
{
  for (const Graph& g : graphs()) {
    SCOPED_TRACE(g.name);
    const SMA::Graph_coloring c = coloring(SMA::Sequential_execution(), g);
    if (g.size() == 0) {
      EXPECT_EQ(c.number_of_colors, 0u);
      continue;
    }
    EXPECT_EQ(c.number_of_colors, number_of_colors(c.color));
    EXPECT_LE(c.number_of_colors, g.max_degree() + 1);
    EXPECT_LE(c.number_of_colors, number_of_colors(first_fit_colors(g)) + 3);
    // each node has neighbours of all lesser colours: no colour could be left out
    for (std::size_t i = 0; i < g.size(); ++i) {
      std::set<std::uint32_t> lesser;
      for (const std::uint32_t j : g.neighbors[i])
        if (c.color[j] < c.color[i]) lesser.insert(c.color[j]);
      ASSERT_EQ(lesser.size(), c.color[i]);
    }
  }
  EXPECT_EQ(coloring(SMA::Sequential_execution(), complete(80)).number_of_colors, 80u);
  EXPECT_EQ(coloring(SMA::Sequential_execution(), star(6000)).number_of_colors, 2u);
}

TEST(Graph_coloring, takes_few_rounds_on_meshes)
{
  EXPECT_LE(coloring(SMA::Sequential_execution(), mesh_graph()).rounds, 25u);
  EXPECT_LE(coloring(SMA::Sequential_execution(), grid(100)).rounds, 25u);
}

TEST(Graph_coloring, ignores_loops_and_repetitions)
{
  const Graph g = grid(20);
  const auto c = SMA::graph_coloring(SMA::Sequential_execution(), g.size(), [&](std::size_t i, const auto& f) {
    f(i);
    for (const std::uint32_t j : g.neighbors[i]) {
      f(j);
      f(j);
    }
  });
  EXPECT_EQ(c.color, coloring(SMA::Sequential_execution(), g).color);
}

TEST(Graph_coloring, lists_its_classes)
{
  const Graph g = mesh_graph();
  const auto c = coloring(SMA::Sequential_execution(), g);
  const auto classes = SMA::color_classes(c);
  ASSERT_EQ(classes.size(), c.number_of_colors);
  std::size_t nodes = 0;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    EXPECT_TRUE(std::is_sorted(classes[k].begin(), classes[k].end()));
    for (const std::uint32_t i : classes[k]) EXPECT_EQ(c.color[i], k);
    nodes += classes[k].size();
  }
  EXPECT_EQ(nodes, g.size());
}

TEST(First_fit_coloring, is_proper_and_first_fit_in_the_order_of_the_ids)
{
  for (const Graph& g : graphs()) {
    SCOPED_TRACE(g.name);
    const SMA::Graph_coloring c = SMA::first_fit_coloring(g.size(), neighbors_in(g));
    EXPECT_TRUE(is_proper(g, c.color));
    EXPECT_EQ(c.color, first_fit_colors(g));
    EXPECT_EQ(c.number_of_colors, number_of_colors(c.color));
  }
}

} // namespace test_graph_coloring

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Graphs of all kinds: meshes, grids, random ones, with few and with very many neighbours.

#ifndef TEST_SURFACE_MESH_ADAPTATION_TASKS_GRAPHS_H
#define TEST_SURFACE_MESH_ADAPTATION_TASKS_GRAPHS_H

#include "shapes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace graphs_of_tests {

using shapes::Random;
using Ids = std::vector<std::uint32_t>;

struct Graph
{
  std::string name;
  std::vector<std::vector<std::uint32_t>> neighbors;

  std::size_t size() const { return neighbors.size(); }

  void add_edge(std::size_t a, std::size_t b)
  {
    if (a == b) return;
    neighbors[a].push_back(std::uint32_t(b));
    neighbors[b].push_back(std::uint32_t(a));
  }

  std::size_t max_degree() const
  {
    std::size_t most = 0;
    for (const auto& n : neighbors) most = (std::max)(most, std::set<std::uint32_t>(n.begin(), n.end()).size());
    return most;
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges() const
  {
    std::set<std::pair<std::uint32_t, std::uint32_t>> unique;
    for (std::uint32_t a = 0; a < size(); ++a)
      for (const std::uint32_t b : neighbors[a]) unique.insert(std::minmax(a, b));
    return {unique.begin(), unique.end()};
  }
};

inline Graph empty_graph(const std::string& name, std::size_t n)
{
  return {name, std::vector<std::vector<std::uint32_t>>(n)};
}

inline Graph random_graph(std::size_t n, std::size_t edges)
{
  Graph g = empty_graph("random", n);
  Random random(3);
  for (std::size_t i = 0; i < edges; ++i) g.add_edge(random.below(n), random.below(n));
  return g;
}

/// Recursive matrix graph (Chakrabarti, Zhan, Faloutsos 2004): few nodes have very many neighbours; edges repeat.
inline Graph r_mat(int scale, std::size_t edges)
{
  Graph g = empty_graph("R-MAT", std::size_t(1) << scale);
  Random random(4);
  for (std::size_t i = 0; i < edges; ++i) {
    std::size_t a = 0, b = 0;
    for (int bit = 0; bit < scale; ++bit) {
      const double x = random.real(); // quadrants with 0.55, 0.15, 0.15, 0.15
      a = 2 * a + (x >= 0.7 ? 1 : 0);
      b = 2 * b + ((x >= 0.55 && x < 0.7) || x >= 0.85 ? 1 : 0);
    }
    g.add_edge(a, b);
  }
  return g;
}

inline Graph star(std::size_t n)
{
  Graph g = empty_graph("star", n);
  for (std::size_t i = 1; i < n; ++i) g.add_edge(0, i);
  return g;
}

inline Graph grid(std::size_t n)
{
  Graph g = empty_graph("grid", n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i + 1 < n) g.add_edge(i + n * j, i + 1 + n * j);
      if (j + 1 < n) g.add_edge(i + n * j, i + n * (j + 1));
    }
  return g;
}

inline Graph complete(std::size_t n)
{
  Graph g = empty_graph("complete", n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) g.add_edge(i, j);
  return g;
}

inline Graph mesh_graph(std::size_t nu = 150, std::size_t nv = 80)
{
  const shapes::Soup s = shapes::torus(nu, nv);
  Graph g = empty_graph("mesh", s.points.size());
  for (const shapes::Triangle& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i) g.add_edge(t[i], t[(i + 1) % 3]); // each edge twice
  return g;
}

inline std::vector<Graph> graphs()
{
  return {empty_graph("empty", 0),
          empty_graph("edgeless", 10),
          random_graph(5000, 20000),
          r_mat(12, 40000),
          star(6000),
          grid(100),
          complete(80),
          mesh_graph()};
}

inline auto neighbors_in(const Graph& g)
{
  return [&g](std::size_t i, const auto& f) {
    for (const std::uint32_t j : g.neighbors[i]) f(j);
  };
}

} // namespace graphs_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_TASKS_GRAPHS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colouring of an implicit graph by priorities (Jones and Plassmann 1993): a node takes the least colour that none of
// its neighbours of higher priority has, once all of these are coloured. With hashed priorities the longest chain of
// such waits is O(log n / log log n) for bounded degree; the result is that of the sequential first-fit in the order
// of priority, whatever the number of threads.
//
// Work: O(n + edges) expected for bounded degree; span: the number of rounds.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_TASKS_GRAPH_COLORING_H
#define CGAL_SURFACE_MESH_ADAPTATION_TASKS_GRAPH_COLORING_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationTasks
/// @{

/// Colours from 0 on.
struct Graph_coloring
{
  std::vector<std::uint32_t> color;  ///< of each node
  std::uint32_t number_of_colors = 0;  ///< colours are less
  std::size_t rounds = 0;  ///< passes that it took
};

namespace internal {

/// A set of colours that finds the least one missing.
class Color_set
{
public:
  void insert(std::uint32_t color)
  {
    if (color < 64) low_ |= std::uint64_t(1) << color;
    else high_.push_back(color);
  }

  std::uint32_t first_missing()
  {
    for (std::uint32_t color = 0; color < 64; ++color)
      if ((low_ >> color & 1) == 0) return color;
    std::sort(high_.begin(), high_.end());
    std::uint32_t color = 64;
    for (std::uint32_t used : high_) {
      if (used > color) break;
      if (used == color) ++color;
    }
    return color;
  }

private:
  std::uint64_t low_ = 0;
  std::vector<std::uint32_t> high_; // only around nodes with very many neighbours
};

} // namespace internal

/// Colours the graph of `n` nodes in which `neighbors(i, f)` calls `f(j)` for the neighbours `j` of `i` (symmetric;
/// repetitions and `i` itself are allowed), so that neighbours differ.
template <class Execution, class Neighbors>
Graph_coloring graph_coloring(const Execution& execution, std::size_t n, const Neighbors& neighbors)
{
  constexpr std::uint32_t uncolored = ~std::uint32_t(0);
  Graph_coloring result;
  result.color.assign(n, uncolored);
  const auto goes_before = [](std::size_t i, std::size_t j) {
    const std::uint64_t a = hash_of_id(i), b = hash_of_id(j);
    return a < b || (a == b && i < j);
  };
  std::vector<std::uint32_t> waiting = pack(execution, n, [](std::size_t) { return true; });
  std::vector<std::uint32_t> chosen;
  while (!waiting.empty()) {
    ++result.rounds;
    chosen.resize(waiting.size());
    for_each_index(execution, waiting.size(), [&](std::size_t w) {
      const std::size_t i = waiting[w];
      internal::Color_set used;
      bool is_ready = true;
      neighbors(i, [&](std::size_t j) {
        if (j == i || !goes_before(j, i)) return;
        if (result.color[j] == uncolored) is_ready = false;
        else used.insert(result.color[j]);
      });
      chosen[w] = is_ready ? used.first_missing() : uncolored;
    });
    for_each_index(execution, waiting.size(), [&](std::size_t w) { result.color[waiting[w]] = chosen[w]; });
    const auto late = pack(execution, waiting.size(), [&](std::size_t w) { return chosen[w] == uncolored; });
    std::vector<std::uint32_t> next(late.size());
    for_each_index(execution, late.size(), [&](std::size_t i) { next[i] = waiting[late[i]]; });
    waiting.swap(next);
  }
  const std::uint32_t largest = reduce(execution, n, std::uint32_t(0), [&](std::size_t i) { return result.color[i]; },
                                       [](std::uint32_t a, std::uint32_t b) { return (std::max)(a, b); });
  result.number_of_colors = n == 0 ? 0 : largest + 1;
  return result;
}

/// The same in the order of the ids and on the calling thread: for graphs of a few thousand nodes, where barriers would
/// cost more.
template <class Neighbors>
Graph_coloring first_fit_coloring(std::size_t n, const Neighbors& neighbors)
{
  Graph_coloring result;
  result.rounds = 1;
  result.color.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    internal::Color_set used;
    neighbors(i, [&](std::size_t j) {
      if (j < i) used.insert(result.color[j]);
    });
    result.color.push_back(used.first_missing());
    result.number_of_colors = (std::max)(result.number_of_colors, result.color.back() + 1);
  }
  return result;
}

/// The nodes of each colour, in increasing order.
inline std::vector<std::vector<std::uint32_t>> color_classes(const Graph_coloring& coloring)
{
  std::vector<std::vector<std::uint32_t>> classes(coloring.number_of_colors);
  for (std::size_t i = 0; i < coloring.color.size(); ++i) classes[coloring.color[i]].push_back(std::uint32_t(i));
  return classes;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_TASKS_GRAPH_COLORING_H

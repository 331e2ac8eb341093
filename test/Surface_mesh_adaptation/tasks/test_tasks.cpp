// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data-parallel primitives, and the extraction of independent tasks.

#include "policies.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/Profiled_execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/keep_freed_memory.h>
#include <CGAL/Surface_mesh_adaptation/tasks/graph_coloring.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>
#include <CGAL/Surface_mesh_adaptation/tasks/matching.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Random;
using Ids = std::vector<std::uint32_t>;

// Primitives

constexpr std::size_t sizes[] = {
  0, 1, 2, SMA::default_chunk_length - 1, SMA::default_chunk_length, SMA::default_chunk_length + 1, 100000};

TEST(Execution, calls_each_index_once)
{
  for (const std::size_t n : sizes)
    for_each_policy([&](const auto& execution, const std::string& name) {
      SCOPED_TRACE(name);
      std::vector<int> calls(n, 0);
      SMA::for_each_index(execution, n, [&](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), std::ptrdiff_t(n));
    });
}

TEST(Execution, cuts_chunks_of_the_length_asked_for)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    SCOPED_TRACE(name);
    std::vector<std::pair<std::size_t, std::size_t>> chunks(4);
    SMA::for_each_chunk(execution, 37, 10, [&](std::size_t c, std::size_t b, std::size_t e) { chunks[c] = {b, e}; });
    const std::vector<std::pair<std::size_t, std::size_t>> expected = {{0, 10}, {10, 20}, {20, 30}, {30, 37}};
    EXPECT_EQ(chunks, expected);
  });
}

TEST(Execution, scans_to_the_sums_before)
{
  for (const std::size_t n : sizes) {
    const auto size = [](std::size_t i) { return std::uint32_t(i * 7 % 5); };
    Ids expected(n);
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < n; sum += size(i++)) expected[i] = sum;
    for_each_policy([&](const auto& execution, const std::string& name) {
      SCOPED_TRACE(name);
      Ids offsets(3, 99); // what was there does not matter
      EXPECT_EQ(SMA::exclusive_scan(execution, n, offsets, size), sum);
      EXPECT_EQ(offsets, expected);
    });
  }
}

TEST(Execution, packs_and_gathers_in_order)
{
  const auto is_wanted = [](std::size_t i) { return SMA::hash_of_id(i) % 3 == 0; };
  for (const std::size_t n : sizes) {
    Ids expected;
    for (std::size_t i = 0; i < n; ++i)
      if (is_wanted(i)) expected.push_back(std::uint32_t(i));
    for_each_policy([&](const auto& execution, const std::string& name) {
      SCOPED_TRACE(name);
      EXPECT_EQ(SMA::pack(execution, n, is_wanted), expected);
      EXPECT_EQ(SMA::count_if(execution, n, is_wanted), expected.size());
      const auto twice = SMA::gather<std::size_t>(execution, n, 100, [&](std::size_t b, std::size_t e, auto& list) {
        for (std::size_t i = b; i < e; ++i) list.insert(list.end(), i % 3, i);
      });
      EXPECT_TRUE(std::is_sorted(twice.begin(), twice.end()));
      std::size_t length = 0;
      for (std::size_t i = 0; i < n; ++i) length += i % 3;
      EXPECT_EQ(twice.size(), length);
    });
  }
}

TEST(Execution, reduces_to_the_same_bits_with_every_policy)
{
  const std::size_t n = 100000;
  Random random(1);
  std::vector<double> x(n);
  for (double& v : x) v = std::exp(random.real(-20, 20)); // the order of the sum shows in its last bits
  const auto sum = [&](const auto& execution) {
    return SMA::reduce(
      execution, n, 0.0, [&](std::size_t i) { return x[i]; }, [](double a, double b) { return a + b; });
  };
  const double first = sum(SMA::Sequential_execution());
  EXPECT_NEAR(first, std::accumulate(x.begin(), x.end(), 0.0), 1e-9 * first);
  EXPECT_NE(first, std::accumulate(x.rbegin(), x.rend(), 0.0)) << "the order does not show: the test is void";
  for_each_policy([&](const auto& execution, const std::string& name) {
    for (int i = 0; i < 10; ++i) EXPECT_EQ(sum(execution), first) << name;
  });
}

TEST(Execution, folds_in_order)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    const std::string text = SMA::reduce(
      execution, 10000, std::string(), [](std::size_t i) { return std::string(1, char('a' + i % 26)); },
      [](const std::string& a, const std::string& b) { return a + b; });
    ASSERT_EQ(text.size(), 10000u) << name;
    for (std::size_t i = 0; i < text.size(); ++i) ASSERT_EQ(text[i], char('a' + i % 26)) << name;
  });
}

TEST(Execution, passes_exceptions_of_tasks_on)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    SCOPED_TRACE(name);
    for (const std::size_t culprit : {std::size_t(0), std::size_t(50000), std::size_t(99999)})
      EXPECT_THROW(SMA::for_each_index(
                     execution, 100000,
                     [&](std::size_t i) {
        if (i == culprit) throw std::domain_error("task");
                     }),
                   std::domain_error);
    std::atomic<std::size_t> calls{0}; // and works on afterwards
    SMA::for_each_index(execution, 10000, [&](std::size_t) { ++calls; });
    EXPECT_EQ(calls, 10000u);
  });
}

TEST(Execution, runs_nested_in_its_own_tasks)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    std::atomic<std::size_t> calls{0};
    execution.run(4, [&](std::size_t) { SMA::for_each_index(execution, 10000, [&](std::size_t) { ++calls; }); });
    EXPECT_EQ(calls, 40000u) << name;
  });
}

TEST(Execution, uses_the_threads_asked_for_and_no_more)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    std::mutex mutex;
    std::condition_variable changed;
    std::set<std::thread::id> threads;
    const std::size_t least = (std::min)(2, execution.concurrency());
    execution.run(64, [&](std::size_t) {
      std::unique_lock<std::mutex> lock(mutex);
      threads.insert(std::this_thread::get_id());
      changed.notify_all();
      changed.wait_for(lock, std::chrono::seconds(10), [&] { return threads.size() >= least; }); // a busy machine is slow
    });
    EXPECT_LE(threads.size(), std::size_t(execution.concurrency())) << name;
    EXPECT_GE(threads.size(), least) << name;
  });
}

TEST(Execution, fills_whatever_was_there)
{
  for (const std::size_t n : {std::size_t(0), std::size_t(1), SMA::fill_chunk_length, 3 * SMA::fill_chunk_length + 1})
    for_each_policy([&](const auto& execution, const std::string& name) {
      SCOPED_TRACE(name);
      SMA::Buffer<int> buffer(n / 2 + 7, -1);
      SMA::fill(execution, buffer, n, 5);
      EXPECT_EQ(buffer.size(), n);
      EXPECT_EQ(std::count(buffer.begin(), buffer.end(), 5), std::ptrdiff_t(n));
    });
}

TEST(Profiled_execution, records_the_work_and_the_span_of_each_step)
{
  const SMA::Profiled_execution execution;
  volatile double sink = 0;
  const auto work = [&](std::size_t task) { // the last of three tasks is by far the longest
    for (std::size_t i = 0; i < (task == 2 ? 3000000u : 300000u); ++i) sink = sink + 1;
  };
  execution.run(3, work);
  execution.run(1, work);
  ASSERT_EQ(execution.steps().size(), 2u);
  const SMA::Parallel_step &three = execution.steps()[0], &one = execution.steps()[1];
  EXPECT_EQ(three.tasks, 3u);
  EXPECT_EQ(one.tasks, 1u);
  EXPECT_GT(three.longest, 0.5 * three.work);
  EXPECT_LT(three.longest, three.work);
  EXPECT_DOUBLE_EQ(one.longest, one.work);
}

TEST(Profiled_execution, predicts_by_the_bound_of_brent)
{
  const SMA::Parallel_step step{5, 8, 2}, alone{1, 3, 3};
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds(step, 1, 0.1), 8);
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds(step, 4, 0.1), 8.0 / 4 + 2 * 3.0 / 4 + 0.2);
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds(alone, 4, 0.1), 3);
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds({step, alone}, 10, 4, 0.1), 10 + 3.7 + 3);
}

// Buffers

/// Tells whether its default constructor ran.
struct Traced
{
  int value;
  Traced() : value(1) {}
  explicit Traced(int v) : value(v) {}
};

TEST(Buffer, leaves_new_elements_as_the_memory_is)
{
  SMA::Buffer<Traced> buffer(1000, Traced(7)); // with an argument they are made as in any vector
  for (const Traced& t : buffer) ASSERT_EQ(t.value, 7);
  const Traced* const memory = buffer.data();
  buffer.clear();
  buffer.resize(1000);
  ASSERT_EQ(buffer.data(), memory);
  for (const Traced& t : buffer) ASSERT_EQ(t.value, 7);
  for (std::size_t i = 0; i < buffer.size(); ++i) buffer[i] = Traced(int(i));
  for (std::size_t i = 0; i < buffer.size(); ++i) ASSERT_EQ(buffer[i].value, int(i));
}

TEST(Buffer, fetches_memory_once_for_what_is_expected)
{
  SMA::Buffer<int> buffer;
  SMA::resize_and_forget(buffer, 10, 1000);
  EXPECT_EQ(buffer.size(), 10u);
  const int* const memory = buffer.data();
  for (const std::size_t n : {1000, 3, 500}) {
    SMA::resize_and_forget(buffer, n);
    EXPECT_EQ(buffer.size(), n);
    EXPECT_EQ(buffer.data(), memory);
  }
  SMA::resize_and_forget(buffer, 5000, 20);
  EXPECT_EQ(buffer.size(), 5000u);
}

TEST(Buffer, gives_its_memory_back)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    SCOPED_TRACE(name);
    SMA::Buffer<int> a(100000, 1), b;
    SMA::Buffer<double> c(100000, 1);
    SMA::release(execution, a, b, c);
    EXPECT_EQ(a.capacity() + b.capacity() + c.capacity(), 0u);
    a.push_back(3); // and serves on
    EXPECT_EQ(a.front(), 3);
  });
}

// Graphs

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

Graph empty_graph(const std::string& name, std::size_t n) { return {name, std::vector<std::vector<std::uint32_t>>(n)}; }

Graph random_graph(std::size_t n, std::size_t edges)
{
  Graph g = empty_graph("random", n);
  Random random(3);
  for (std::size_t i = 0; i < edges; ++i) g.add_edge(random.below(n), random.below(n));
  return g;
}

/// Recursive matrix graph (Chakrabarti, Zhan, Faloutsos 2004): few nodes have very many neighbours; edges repeat.
Graph r_mat(int scale, std::size_t edges)
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

Graph star(std::size_t n)
{
  Graph g = empty_graph("star", n);
  for (std::size_t i = 1; i < n; ++i) g.add_edge(0, i);
  return g;
}

Graph grid(std::size_t n)
{
  Graph g = empty_graph("grid", n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i + 1 < n) g.add_edge(i + n * j, i + 1 + n * j);
      if (j + 1 < n) g.add_edge(i + n * j, i + n * (j + 1));
    }
  return g;
}

Graph complete(std::size_t n)
{
  Graph g = empty_graph("complete", n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) g.add_edge(i, j);
  return g;
}

Graph mesh_graph(std::size_t nu = 150, std::size_t nv = 80)
{
  const shapes::Soup s = shapes::torus(nu, nv);
  Graph g = empty_graph("mesh", s.points.size());
  for (const shapes::Triangle& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i) g.add_edge(t[i], t[(i + 1) % 3]); // each edge twice
  return g;
}

std::vector<Graph> graphs()
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

auto neighbors_in(const Graph& g)
{
  return [&g](std::size_t i, const auto& f) {
    for (const std::uint32_t j : g.neighbors[i]) f(j);
  };
}

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

// Independent sets: candidates are the nodes, resources the closed neighbourhoods

std::uint64_t priority(std::size_t i) { return SMA::task_priority(std::uint32_t(i % 8), std::uint32_t(i), 0); }
std::uint64_t hashed_priority(std::size_t i) { return SMA::task_priority(0, std::uint32_t(i), 0); }

template <class F>
void closed_neighborhood(const Graph& g, std::size_t i, const F& f)
{
  f(i);
  for (const std::uint32_t j : g.neighbors[i]) f(j);
}

/// Whether no two of `set` need the same resource; `taken` are the resources that are needed.
bool is_independent(const Graph& g, const Ids& set, std::vector<int>& taken)
{
  taken.assign(g.size(), 0);
  for (const std::uint32_t i : set) {
    std::set<std::size_t> mine;
    closed_neighborhood(g, i, [&](std::size_t r) { mine.insert(r); });
    for (const std::size_t r : mine) ++taken[r];
  }
  return std::all_of(taken.begin(), taken.end(), [](int t) { return t <= 1; });
}

TEST(Independent_set, is_independent_and_the_same_with_every_policy)
{
  for (const Graph& g : graphs()) {
    SCOPED_TRACE(g.name);
    Ids first;
    for_each_policy([&](const auto& execution, const std::string& name) {
      SCOPED_TRACE(name);
      SMA::Reservations reservations;
      reservations.resize(execution, g.size());
      for (int again = 0; again < 2; ++again) { // the slots are free again after each pass
        const Ids set = SMA::independent_set(execution, g.size(), reservations, priority,
                                             [&](std::size_t i, const auto& f) { closed_neighborhood(g, i, f); });
        std::vector<int> taken;
        EXPECT_TRUE(std::is_sorted(set.begin(), set.end()));
        EXPECT_TRUE(is_independent(g, set, taken));
        if (first.empty()) first = set;
        EXPECT_EQ(set, first);
      }
    });
    EXPECT_EQ(first.empty(), g.size() == 0);
    if (g.size() == 0) continue;
    // who goes before all others wins
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < g.size(); ++i)
      if (priority(i) < priority(best)) best = i;
    EXPECT_TRUE(std::binary_search(first.begin(), first.end(), best));
  }
}

template <class Execution, class Priority>
SMA::Maximal_independent_set maximal_set(const Execution& execution, const Graph& g, const Priority& first)
{
  return SMA::maximal_independent_set(execution, g.size(), g.size(), first,
                                      [&](std::size_t i, const auto& f) { closed_neighborhood(g, i, f); });
}

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

template <class Execution, class Priority>
SMA::Maximal_independent_set maximal_matching(const Execution& execution, const Graph& g, const Edges& edges,
                                              const Priority& first)
{
  return SMA::maximal_matching(execution, edges.size(), g.size(), first, [&](std::size_t i) { return edges[i]; });
}

/// `extract(execution)` gives `first`, members and rounds, with every policy.
template <class Extract>
void expect_same_with_every_policy(const SMA::Maximal_independent_set& first, const Extract& extract)
{
  for_each_policy([&](const auto& execution, const std::string& name) {
    const SMA::Maximal_independent_set again = extract(execution);
    EXPECT_EQ(again.members, first.members) << name;
    EXPECT_EQ(again.rounds, first.rounds) << name;
  });
}

TEST(Maximal_independent_set, is_independent_maximal_and_the_same_with_every_policy)
{
  for (const Graph& g : graphs()) {
    SCOPED_TRACE(g.name);
    const auto first = maximal_set(SMA::Sequential_execution(), g, priority);
    std::vector<int> taken;
    ASSERT_TRUE(is_independent(g, first.members, taken));
    for (std::size_t i = 0; i < g.size(); ++i) {
      bool is_free = true;
      closed_neighborhood(g, i, [&](std::size_t r) { is_free = is_free && taken[r] == 0; });
      EXPECT_FALSE(is_free) << "node " << i << " could be added";
    }
    expect_same_with_every_policy(first, [&](const auto& execution) { return maximal_set(execution, g, priority); });
  }
}

TEST(Maximal_matching, is_a_maximal_matching_and_the_same_with_every_policy)
{
  for (const Graph& g : graphs()) {
    SCOPED_TRACE(g.name);
    const Edges edges = g.edges();
    const auto first = maximal_matching(SMA::Sequential_execution(), g, edges, priority);
    std::vector<int> uses(g.size(), 0);
    for (const std::uint32_t i : first.members) {
      ++uses[edges[i].first];
      ++uses[edges[i].second];
    }
    EXPECT_TRUE(std::all_of(uses.begin(), uses.end(), [](int u) { return u <= 1; }));
    for (const auto& e : edges) EXPECT_TRUE(uses[e.first] + uses[e.second] > 0) << "an edge could be added";
    expect_same_with_every_policy(first, [&](const auto& execution) { return maximal_matching(execution, g, edges, priority); });
  }
}

TEST(Maximal_independent_set, counts_its_rounds)
{
  const SMA::Sequential_execution sequential;
  EXPECT_EQ(maximal_set(sequential, empty_graph("empty", 0), priority).rounds, 0u);
  EXPECT_EQ(maximal_set(sequential, empty_graph("edgeless", 10), priority).rounds, 1u);
  EXPECT_EQ(maximal_set(sequential, complete(80), priority).rounds, 1u); // one wins, and touches all others
  // a path whose ids are the priorities: each waits for the one before, but every other one loses meanwhile
  const std::size_t n = 100;
  const auto chain = SMA::maximal_independent_set(
    sequential, n, n + 1, [](std::size_t i) { return i; },
    [](std::size_t i, const auto& f) {
    f(i);
    f(i + 1);
    });
  EXPECT_EQ(chain.rounds, n / 2);
  EXPECT_EQ(chain.members.size(), n / 2);
}

/// Grown 16 times, a graph that takes O(log n) rounds takes a few more, one with long chains up to 16 times as many.
TEST(Maximal_independent_set, takes_logarithmically_many_rounds)
{
  std::vector<std::pair<Graph, Graph>> grown;
  grown.emplace_back(grid(60), grid(240));
  grown.emplace_back(mesh_graph(60, 50), mesh_graph(240, 200));
  grown.emplace_back(r_mat(11, 20000), r_mat(15, 320000));
  const SMA::Sequential_execution sequential;
  const auto expect_logarithmic = [](std::size_t n, std::size_t rounds, std::size_t rounds_before) {
    EXPECT_LE(double(rounds), std::log2(double(n)));
    EXPECT_LE(rounds, rounds_before + 4);
  };
  const auto rounds_of_set = [&](const Graph& g) { return maximal_set(sequential, g, hashed_priority).rounds; };
  for (const auto& [small, large] : grown) {
    SCOPED_TRACE(large.name);
    expect_logarithmic(large.size(), rounds_of_set(large), rounds_of_set(small));
    const Edges few = small.edges(), many = large.edges();
    expect_logarithmic(many.size(), maximal_matching(sequential, large, many, hashed_priority).rounds,
                       maximal_matching(sequential, small, few, hashed_priority).rounds);
  }
}

#ifdef __GLIBC__
TEST(Freed_memory, is_kept)
{
  SMA::keep_freed_memory();
  constexpr std::size_t size = std::size_t(1) << 26;
  std::vector<char>(size, 1);
  const auto heap = mallinfo2().arena;
  const std::vector<char> again(size, 1);
  EXPECT_EQ(mallinfo2().arena, heap) << "the heap shrank and grew, or only grew";
  EXPECT_EQ(mallinfo2().hblkhd, 0u) << "blocks of their own are given back";
}
#endif

TEST(Task_priority, is_unique_and_ordered_by_bucket)
{
  std::set<std::uint64_t> seen;
  std::uint64_t largest_of_bucket = 0;
  for (std::uint32_t bucket = 0; bucket < 8; ++bucket) {
    std::uint64_t least = ~std::uint64_t(0), largest = 0;
    for (std::uint32_t id = 0; id < 10000; ++id) {
      const std::uint64_t p = SMA::task_priority(bucket, id, 3);
      EXPECT_TRUE(seen.insert(p).second);
      least = (std::min)(least, p);
      largest = (std::max)(largest, p);
    }
    if (bucket > 0) {
      EXPECT_GT(least, largest_of_bucket);
    }
    largest_of_bucket = largest;
  }
  EXPECT_LT(largest_of_bucket, ~std::uint64_t(0)) << "that stands for a free resource";
  std::size_t wins = 0; // no id is favoured in all rounds
  for (std::uint32_t round = 0; round < 100; ++round)
    wins += SMA::task_priority(0, 1, round) < SMA::task_priority(0, 2, round);
  EXPECT_NEAR(double(wins), 50, 25);
}

} // namespace

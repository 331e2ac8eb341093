// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extraction of independent tasks: candidates are the nodes of graphs, or their edges, and resources the closed
// neighbourhoods, or the nodes.

#include "policies.h"
#include "tasks/graphs.h"

#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>
#include <CGAL/Surface_mesh_adaptation/tasks/matching.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace test_independent_sets {

namespace SMA = CGAL::Surface_mesh_adaptation;
using namespace graphs_of_tests;

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

} // namespace test_independent_sets

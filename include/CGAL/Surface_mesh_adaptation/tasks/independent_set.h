// SPDX-License-Identifier: GPL-3.0-or-later
//
// Independent tasks by deterministic reservations (Blelloch et al. 2012): every candidate writes its priority by atomic
// minimum on the resources that it needs, and wins if it holds them all. One pass costs two visits of the resources of
// each candidate and one barrier; the winners depend on the priorities alone, not on who writes first. The candidate of
// least priority among those in contact with it always wins, so repeated passes exhaust the candidates.
//
// Work: O(total number of resources) a pass; span: O(largest number of resources of a candidate).

#ifndef CGAL_SURFACE_MESH_ADAPTATION_TASKS_INDEPENDENT_SET_H
#define CGAL_SURFACE_MESH_ADAPTATION_TASKS_INDEPENDENT_SET_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationTasks
/// @{

/// Mixes the bits of `x` (the finaliser of a 64-bit multiplicative hash): equal ids give equal, unrelated numbers.
inline std::uint64_t hash_of_id(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// A priority that puts coarse buckets of gain first, then a hash of the id and the round, then the id. Few buckets
/// and a hash on purpose: a smooth quantity would make long chains of candidates that wait for each other.
/// \pre `bucket < 8` (0 goes first)
inline std::uint64_t task_priority(std::uint32_t bucket, std::uint32_t id, std::uint32_t round)
{
  const std::uint64_t h = hash_of_id((std::uint64_t(round) << 32) | id) >> 35; // 29 bits
  return (std::uint64_t(bucket) << 61) | (h << 32) | id;
}

/// One slot for each resource; reused from pass to pass.
class Reservations
{
public:
  /// Makes room for that many, all free. \pre no slot is held
  template <class Execution>
  void resize(const Execution& execution, std::size_t number_of_resources)
  {
    if (number_of_resources <= size_) return;
    size_ = number_of_resources;
    slots_.reset(new std::atomic<std::uint64_t>[size_]); // not cleared twice, and by the threads that will use it
    for_each_index(execution, size_, [&](std::size_t i) { release(i); }, fill_chunk_length);
  }

  /// Writes `priority`, unless the resource is held by a lesser one. May be called concurrently.
  void reserve(std::size_t resource, std::uint64_t priority)
  {
    std::uint64_t held = slots_[resource].load(std::memory_order_relaxed);
    while (priority < held &&
           !slots_[resource].compare_exchange_weak(held, priority, std::memory_order_relaxed)) {}
  }

  /// Whether no lesser priority was written.
  bool holds(std::size_t resource, std::uint64_t priority) const
  {
    return slots_[resource].load(std::memory_order_relaxed) == priority;
  }

  /// Makes the resource free.
  void release(std::size_t resource) { slots_[resource].store(~std::uint64_t(0), std::memory_order_relaxed); }

private:
  std::size_t size_ = 0;
  std::unique_ptr<std::atomic<std::uint64_t>[]> slots_;
};

/// One pass over `n` candidates. `priority(i)` must be unique; `resources(i, f)` calls `f(r)` for the resources of
/// candidate `i`. Returns the winners in increasing order: no two of them need the same resource.
template <class Execution, class Priority, class Resources>
std::vector<std::uint32_t> independent_set(const Execution& execution, std::size_t n, Reservations& reservations,
                                           const Priority& priority, const Resources& resources)
{
  for_each_index(execution, n, [&](std::size_t i) {
    resources(i, [&](std::size_t r) { reservations.reserve(r, priority(i)); });
  }, claim_chunk_length);
  std::vector<std::uint32_t> winners = pack(execution, n, [&](std::size_t i) {
    bool wins = true;
    resources(i, [&](std::size_t r) { wins = wins && reservations.holds(r, priority(i)); });
    return wins;
  }, claim_chunk_length);
  for_each_index(execution, n, [&](std::size_t i) {
    resources(i, [&](std::size_t r) { reservations.release(r); });
  }, claim_chunk_length);
  return winners;
}

/// What `maximal_independent_set()` returns.
struct Maximal_independent_set
{
  std::vector<std::uint32_t> members; ///< in increasing order
  std::size_t rounds = 0;             ///< passes that it took
};

/// Passes until every candidate has won or touches a winner: a maximal independent set. With hashed priorities the
/// number of rounds is O(log n) with high probability (Fischer and Noever 2018).
template <class Execution, class Priority, class Resources>
Maximal_independent_set maximal_independent_set(const Execution& execution, std::size_t n,
                                                std::size_t number_of_resources, const Priority& priority,
                                                const Resources& resources)
{
  Maximal_independent_set result;
  Reservations reservations;
  reservations.resize(execution, number_of_resources);
  std::vector<std::uint8_t> is_taken(number_of_resources, 0), is_member(n, 0);
  std::vector<std::uint32_t> candidates = pack(execution, n, [](std::size_t) { return true; });
  while (!candidates.empty()) {
    ++result.rounds;
    const auto winners = independent_set(
      execution, candidates.size(), reservations, [&](std::size_t i) { return priority(candidates[i]); },
      [&](std::size_t i, const auto& f) { resources(candidates[i], f); });
    for_each_index(execution, winners.size(), [&](std::size_t w) {
      const std::uint32_t i = candidates[winners[w]];
      is_member[i] = 1;
      resources(i, [&](std::size_t r) { is_taken[r] = 1; });
    });
    const auto free = pack(execution, candidates.size(), [&](std::size_t c) {
      bool is_free = true;
      resources(candidates[c], [&](std::size_t r) { is_free = is_free && is_taken[r] == 0; });
      return is_free;
    });
    std::vector<std::uint32_t> next(free.size());
    for_each_index(execution, free.size(), [&](std::size_t i) { next[i] = candidates[free[i]]; });
    candidates.swap(next);
  }
  result.members = pack(execution, n, [&](std::size_t i) { return is_member[i] != 0; });
  return result;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_TASKS_INDEPENDENT_SET_H

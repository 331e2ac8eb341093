// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sorts by keys of whole numbers, one digit of these after the other, the last one first (radix sort; in parallel as in
// Zagha and Blelloch 1991): each chunk counts its digits, and puts what it has behind lesser digits and the chunks before
// it.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_SORT_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_SORT_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

class Radix_sort
{
public:
  template <class Execution>
  static std::vector<std::uint32_t> order(const Execution& execution, const std::vector<std::uint64_t>& keys)
  {
    Radix_sort sort(keys.size());
    for_each_index(execution, keys.size(), [&](std::size_t i) { sort.items_[i] = {keys[i], std::uint32_t(i)}; });
    for (int shift = 0; shift < 64; shift += digit_bits) sort.by_digit(execution, shift);
    std::vector<std::uint32_t> result(keys.size());
    for_each_index(execution, result.size(), [&](std::size_t i) { result[i] = sort.items_[i].number; });
    return result;
  }

private:
  struct Item
  {
    std::uint64_t key;
    std::uint32_t number;
  };

  static constexpr int digit_bits = 8;
  static constexpr std::size_t number_of_digits = 1 << digit_bits, chunk_length = 1 << 13;

  using Counts = std::array<std::uint32_t, number_of_digits>;

  explicit Radix_sort(std::size_t n) : items_(n), sorted_(n), counts_(number_of_chunks(n, chunk_length)) {}

  template <class Execution>
  void by_digit(const Execution& execution, int shift)
  {
    const auto digit = [&](std::size_t i) { return items_[i].key >> shift & (number_of_digits - 1); };
    for_each_chunk(execution, items_.size(), chunk_length, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      counts_[chunk].fill(0);
      for (std::size_t i = begin; i < end; ++i) ++counts_[chunk][digit(i)];
    });
    if (!make_offsets()) return;
    for_each_chunk(execution, items_.size(), chunk_length, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sorted_[counts_[chunk][digit(i)]++] = items_[i];
    });
    items_.swap(sorted_);
  }

  /// Of counts; returns whether there is more than one digit.
  bool make_offsets()
  {
    std::uint32_t sum = 0, largest = 0;
    for (std::size_t digit = 0; digit < number_of_digits; ++digit) {
      const std::uint32_t before = sum;
      for (Counts& counts : counts_) sum += std::exchange(counts[digit], sum);
      largest = (std::max)(largest, sum - before);
    }
    return largest < items_.size();
  }

  Buffer<Item> items_, sorted_;
  std::vector<Counts> counts_;
};

} // namespace internal

/// The numbers `0 .. n - 1` sorted by key, ties by number.
/// \par Complexity
/// O(n) for each of the eight digits in which keys differ
template <class Execution>
std::vector<std::uint32_t> sorted_by_key(const Execution& execution, const std::vector<std::uint64_t>& keys)
{
  return internal::Radix_sort::order(execution, keys);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_SORT_H

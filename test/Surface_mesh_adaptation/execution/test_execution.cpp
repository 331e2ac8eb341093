// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data-parallel primitives, and the memory that they work on.

#include "policies.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/Profiled_execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/keep_freed_memory.h>
#include <CGAL/Surface_mesh_adaptation/execution/sort.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

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
#include <utility>
#include <vector>

namespace test_execution {

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

TEST(Execution, sorts_by_key_like_a_stable_sort)
{
  Random random(17);
  for (const std::size_t n : {0u, 1u, 8191u, 8192u, 8193u, 40000u, 65537u})
    for (const std::uint64_t factor : {std::uint64_t(0), std::uint64_t(1), std::uint64_t(1) << 20, ~std::uint64_t(0) / 1000})
      for (const std::size_t keys : {1u, 10u, 1000u}) {
        std::vector<std::uint64_t> key(n);
        for (std::uint64_t& k : key) k = factor * random.below(keys);
        Ids expected(n);
        std::iota(expected.begin(), expected.end(), 0u);
        std::stable_sort(expected.begin(), expected.end(), [&](std::size_t a, std::size_t b) { return key[a] < key[b]; });
        for_each_policy([&](const auto& execution, const std::string& name) {
          EXPECT_EQ(SMA::sorted_by_key(execution, key), expected) << name << " " << n << " " << factor << " " << keys;
        });
      }
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
  EXPECT_EQ(three.seconds.size(), 3u);
  EXPECT_EQ(one.seconds.size(), 1u);
  EXPECT_GT(three.longest(), 0.5 * three.work());
  EXPECT_LT(three.longest(), three.work());
  EXPECT_DOUBLE_EQ(one.longest(), one.work());
}

TEST(Profiled_execution, predicts_what_threads_take_that_fetch_their_tasks)
{
  const SMA::Parallel_step step{{1, 2, 3, 1, 1}}, alone{{3}}; // on two threads 1 + 3 and 2 + 1 + 1
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds(step, 1, 0.1), 8);
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds(step, 2, 0.1), 4 + 0.1);
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds(step, 8, 0.1), 3 + 0.3);
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds(alone, 4, 0.1), 3);
  EXPECT_DOUBLE_EQ(SMA::predicted_seconds({step, alone}, 10, 4, 0.1), 10 + 3.2 + 3);
}

TEST(Profiled_execution, predicts_between_the_least_and_the_bound_of_graham)
{
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    SMA::Parallel_step step;
    for (std::size_t task = 2 + random.below(200); task > 0; --task) step.seconds.push_back(float(random.real()));
    for (const int threads : {2, 3, 16, 64}) {
      const double least = (std::max)(step.work() / threads, step.longest());
      const double seconds = SMA::predicted_seconds(step, threads, 0);
      EXPECT_GE(seconds, least * (1 - 1e-9));
      EXPECT_LE(seconds, step.work() / threads + step.longest());
    }
  }
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

} // namespace test_execution

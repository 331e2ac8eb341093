// SPDX-License-Identifier: GPL-3.0-or-later
//
// Execution policies, and the data-parallel primitives that every sweep is written in.
//
// A policy only knows how to run independent tasks (`run`). The primitives cut their index range into chunks of a
// fixed size and combine what the chunks give in the order of the chunks, hence their results, floating-point sums
// included, depend neither on the policy nor on the number of threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_EXECUTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_EXECUTION_H

#include <CGAL/Surface_mesh_adaptation/execution/task_shares.h>
#include <CGAL/Surface_mesh_adaptation/execution/thread_sanitizer.h>

#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationExecution
/// @{

/// Runs tasks one after the other on the calling thread.
/// \cgalModels{AdaptationExecution}
class Sequential_execution
{
public:
  static constexpr const char* name = "sequential";  ///< for reports

  int concurrency() const { return 1; }  ///< one task at a time

  /// Calls `task(i)` for `i` in `[0, number_of_tasks)`, in order.
  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const
  {
    for (std::size_t i = 0; i < number_of_tasks; ++i) task(i);
  }
};

#ifdef CGAL_LINKED_WITH_TBB
/// Runs tasks on `threads` threads of oneTBB (0: as many as TBB would use by itself). While the policy lives, it raises
/// the limit of the process if that is lower.
/// \cgalModels{AdaptationExecution}
class TBB_execution
{
public:
  static constexpr const char* name = "tbb";  ///< for reports

  /// \param threads how many; 0: as many as TBB would use by itself
  explicit TBB_execution(int threads = 0)
  {
    using Limit = tbb::global_control;
    const std::size_t allowed = Limit::active_value(Limit::max_allowed_parallelism);
    if (std::size_t((std::max)(threads, 0)) > allowed)
      limit_ = std::make_shared<Limit>(Limit::max_allowed_parallelism, std::size_t(threads));
    arena_ = std::make_shared<tbb::task_arena>(threads > 0 ? threads : int(tbb::task_arena::automatic));
  }

  int concurrency() const { return arena_->max_concurrency(); }  ///< number of threads

  /// Calls `task(i)` for `i` in `[0, number_of_tasks)`, on these threads.
  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const
  {
    if (number_of_tasks == 1) return task(0);
    internal::Fork_join_annotation annotation;
    const auto body = [&](std::size_t i) { annotation.run([&] { task(i); }); };
    annotation.fork();
    arena_->execute([&] { tbb::parallel_for(std::size_t(0), number_of_tasks, body); });
    annotation.join();
  }

private:
  std::shared_ptr<tbb::global_control> limit_;
  std::shared_ptr<tbb::task_arena> arena_;
};
#endif

#ifdef _OPENMP
/// Runs tasks on `threads` threads of OpenMP (0: as many as `omp_get_max_threads()` says).
/// \cgalModels{AdaptationExecution}
class OpenMP_execution
{
public:
  static constexpr const char* name = "openmp";  ///< for reports

  /// \param threads how many; 0: as many as `omp_get_max_threads()` says
  explicit OpenMP_execution(int threads = 0) : threads_(threads > 0 ? threads : omp_get_max_threads()) {}

  int concurrency() const { return threads_; }  ///< number of threads

  /// Calls `task(i)` for `i` in `[0, number_of_tasks)`, on these threads.
  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const
  {
    if (number_of_tasks == 1) return task(0);
    std::exception_ptr failure; // no exception may leave an OpenMP region
    std::mutex failure_mutex;
    internal::Fork_join_annotation annotation;
    internal::Task_shares shares(number_of_tasks, std::size_t(threads_));
    const auto guarded = [&](std::size_t i) {
      try {
        annotation.run([&] { task(i); });
      } catch (...) {
        const std::lock_guard<std::mutex> lock(failure_mutex);
        if (!failure) failure = std::current_exception();
      }
    };
    annotation.fork();
#pragma omp parallel num_threads(threads_)
    shares.work(std::size_t(omp_get_thread_num()), guarded);
    annotation.join();
    if (failure) std::rethrow_exception(failure);
  }

private:
  int threads_;
};
#endif

/// The best policy that was built in: TBB, else OpenMP, else sequential.
#if defined(CGAL_LINKED_WITH_TBB)
using Default_parallel_execution = TBB_execution;
#elif defined(_OPENMP)
using Default_parallel_execution = OpenMP_execution;
#else
using Default_parallel_execution = Sequential_execution;
#endif

namespace internal {

/// Maps CGAL's concurrency tags onto policies; a policy maps onto itself.
template <class ConcurrencyTag> struct Execution_of { using type = ConcurrencyTag; };
template <> struct Execution_of<CGAL::Sequential_tag> { using type = Sequential_execution; };
#if defined(CGAL_LINKED_WITH_TBB)
template <> struct Execution_of<CGAL::Parallel_tag> { using type = TBB_execution; };
#elif defined(_OPENMP)
template <> struct Execution_of<CGAL::Parallel_tag> { using type = OpenMP_execution; };
#endif

template <class T, class = void> constexpr bool is_execution = false;
template <class T> constexpr bool is_execution<T, std::void_t<decltype(std::declval<const T&>().concurrency())>> = true;

/// A task as it could be.
struct Any_task
{
  void operator()(std::size_t) const {}
};

/// Whether `T` is a model of `AdaptationExecution`.
template <class T, class = void> constexpr bool is_adaptation_execution = false;
template <class T>
constexpr bool is_adaptation_execution<T, std::void_t<
  decltype(int(std::declval<const T&>().concurrency())), decltype(static_cast<const char*>(T::name)),
  decltype(std::declval<const T&>().run(std::size_t(), std::declval<const Any_task&>()))>> =
  std::is_copy_constructible_v<T>;

} // namespace internal

/// Whether a run is to stop and what its sweeps have not begun may be left out: never, for a policy of a user.
template <class Execution>
bool is_stopped(const Execution&)
{
  return false;
}

/// Length of a chunk of light work (tens of nanoseconds an index): long enough to hide the cost of a task, short enough
/// to occupy many threads.
constexpr std::size_t default_chunk_length = 512;
/// The same for the claims of tasks and what else is done for each of these (tenths of a microsecond an index).
constexpr std::size_t claim_chunk_length = 64;
/// The same for heavy work (a microsecond an index).
constexpr std::size_t heavy_chunk_length = 16;
/// The same for writing or copying (less than a nanosecond an index).
constexpr std::size_t fill_chunk_length = 16384;

/// In how many chunks of this length `n` indices are.
inline std::size_t number_of_chunks(std::size_t n, std::size_t chunk_length)
{
  return (n + chunk_length - 1) / chunk_length;
}

/// Calls `f(chunk, begin, end)` for the chunks of `[0, n)`.
template <class Execution, class F>
void for_each_chunk(const Execution& execution, std::size_t n, std::size_t chunk_length, const F& f)
{
  if (n == 0) return;
  execution.run(number_of_chunks(n, chunk_length), [&](std::size_t chunk) {
    const std::size_t begin = chunk * chunk_length;
    f(chunk, begin, (std::min)(begin + chunk_length, n));
  });
}

/// Calls `f(i)` for `i` in `[0, n)`; no two calls may touch the same data unless both only read it.
template <class Execution, class F>
void for_each_index(const Execution& execution, std::size_t n, const F& f,
                    std::size_t chunk_length = default_chunk_length)
{
  for_each_chunk(execution, n, chunk_length, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f(i);
  });
}

/// Makes `buffer` a list of `n` times `value`.
template <class Execution, class Buffer, class T>
void fill(const Execution& execution, Buffer& buffer, std::size_t n, const T& value)
{
  buffer.resize(n);
  for_each_chunk(execution, n, fill_chunk_length, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::fill(buffer.begin() + std::ptrdiff_t(begin), buffer.begin() + std::ptrdiff_t(end), value);
  });
}

/// Lets `add(value, i)` gather `[0, n)` into a value for each chunk and folds these with `combine`, both in order.
template <class Execution, class T, class Add, class Combine>
T accumulate(const Execution& execution, std::size_t n, const T& identity, const Add& add, const Combine& combine)
{
  std::vector<T> partial(number_of_chunks(n, default_chunk_length), identity);
  for_each_chunk(execution, n, default_chunk_length, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    T value = identity;
    for (std::size_t i = begin; i < end; ++i) add(value, i);
    partial[chunk] = value;
  });
  T result = identity;
  for (const T& value : partial) result = combine(result, value);
  return result;
}

/// Folds `map(i)` over `[0, n)` with `combine`, chunk by chunk, then over the chunks, both in order.
template <class Execution, class T, class Map, class Combine>
T reduce(const Execution& execution, std::size_t n, const T& identity, const Map& map, const Combine& combine)
{
  return accumulate(execution, n, identity, [&](T& value, std::size_t i) { value = combine(value, map(i)); }, combine);
}

/// The number of `i` in `[0, n)` with `predicate(i)`.
template <class Execution, class Predicate>
std::size_t count_if(const Execution& execution, std::size_t n, const Predicate& predicate)
{
  return reduce(execution, n, std::size_t(0), [&](std::size_t i) { return std::size_t(predicate(i) ? 1 : 0); },
                [](std::size_t a, std::size_t b) { return a + b; });
}

/// Writes the sum of the sizes before `i` to `offsets[i]`, which is resized to `n`, and returns the sum of all.
template <class Execution, class Offsets, class Size>
std::uint32_t exclusive_scan(const Execution& execution, std::size_t n, Offsets& offsets, const Size& size)
{
  offsets.resize(n);
  std::vector<std::uint32_t> chunk_offset(number_of_chunks(n, default_chunk_length) + 1, 0);
  for_each_chunk(execution, n, default_chunk_length, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    std::uint32_t sum = 0;
    for (std::size_t i = begin; i < end; ++i) {
      offsets[i] = sum;
      sum += size(i);
    }
    chunk_offset[chunk + 1] = sum;
  });
  for (std::size_t chunk = 1; chunk < chunk_offset.size(); ++chunk) chunk_offset[chunk] += chunk_offset[chunk - 1];
  for_each_chunk(execution, n, default_chunk_length, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    if (chunk_offset[chunk] == 0) return;
    for (std::size_t i = begin; i < end; ++i) offsets[i] += chunk_offset[chunk];
  });
  return chunk_offset.back();
}

/// Concatenates the lists that the chunks of `[0, n)` produce, in order: `produce(begin, end, list)` appends to `list`.
template <class T, class Execution, class Produce>
std::vector<T> gather(const Execution& execution, std::size_t n, std::size_t chunk_length, const Produce& produce)
{
  std::vector<std::vector<T>> lists(number_of_chunks(n, chunk_length));
  for_each_chunk(execution, n, chunk_length, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    produce(begin, end, lists[chunk]);
  });
  std::vector<std::size_t> offset(lists.size() + 1, 0);
  for (std::size_t i = 0; i < lists.size(); ++i) offset[i + 1] = offset[i] + lists[i].size();
  std::vector<T> result(offset.back());
  execution.run(lists.size(), [&](std::size_t i) {
    std::copy(lists[i].begin(), lists[i].end(), result.begin() + std::ptrdiff_t(offset[i]));
    std::vector<T>().swap(lists[i]); // giving back thousands of lists in series would take its time
  });
  return result;
}

/// The `i` in `[0, n)` with `predicate(i)`, in increasing order.
template <class Execution, class Predicate>
std::vector<std::uint32_t> pack(const Execution& execution, std::size_t n, const Predicate& predicate,
                                std::size_t chunk_length = default_chunk_length)
{
  return gather<std::uint32_t>(execution, n, chunk_length,
                               [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& list) {
    for (std::size_t i = begin; i < end; ++i)
      if (predicate(i)) list.push_back(std::uint32_t(i));
  });
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_EXECUTION_H

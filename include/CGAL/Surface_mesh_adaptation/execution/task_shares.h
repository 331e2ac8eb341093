// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hands tasks to threads: each thread works through a share of consecutive tasks, and when that is done through what
// the others have left of theirs. Consecutive tasks work on neighbouring memory, which a schedule that deals them out
// one by one passes to and fro between the threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_TASK_SHARES_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_TASK_SHARES_H

#include <atomic>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

class Task_shares
{
public:
  Task_shares(std::size_t number_of_tasks, std::size_t threads) : shares_(threads)
  {
    for (std::size_t i = 0; i < threads; ++i) {
      shares_[i].next.store(number_of_tasks * i / threads, std::memory_order_relaxed);
      shares_[i].end = number_of_tasks * (i + 1) / threads;
    }
  }

  /// Calls `task(i)` for all tasks that no other thread takes, those of share `own` first. All are taken when the first
  /// thread returns, however many threads there are; they are done when the last one does.
  template <class Task>
  void work(std::size_t own, const Task& task)
  {
    for (std::size_t turn = 0; turn < shares_.size(); ++turn) {
      Share& share = shares_[(own + turn) % shares_.size()];
      for (;;) {
        const std::size_t i = share.next.fetch_add(1, std::memory_order_relaxed);
        if (i >= share.end) break;
        task(i);
      }
    }
  }

private:
  struct alignas(64) Share ///< alone in its cache line, since others rarely look into it
  {
    std::atomic<std::size_t> next;
    std::size_t end;
  };

  std::vector<Share> shares_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_TASK_SHARES_H

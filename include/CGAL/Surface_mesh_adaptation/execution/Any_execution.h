// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_ANY_EXECUTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_ANY_EXECUTION_H

#include <CGAL/Surface_mesh_adaptation/execution/Interruption.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A task as a pointer to it and a function that calls it, for as long as the task lives. With `std::function`, of which
/// what copies and owns is compiled for each of some hundred tasks, programs take a quarter longer to compile.
class Task_reference
{
public:
  template <class Task>
  explicit Task_reference(const Task& task)
    : task_(&task), call_([](const void* t, std::size_t i) { (*static_cast<const Task*>(t))(i); })
  {}

  void operator()(std::size_t i) const { call_(task_, i); }

private:
  const void* task_;
  void (*call_)(const void*, std::size_t);
};

/// Any execution policy behind one type, so that the kernels are compiled once for all of them. A task is a chunk of
/// thousands of elements: the indirect call costs nothing.
/// \cgalModels{AdaptationExecution}
class Any_execution
{
public:
  template <class Execution>
  explicit Any_execution(const Execution& execution)
    : concurrency_(execution.concurrency())
    , run_([execution](std::size_t n, const Task_reference& task) { execution.run(n, task); })
  {
    static_assert(is_adaptation_execution<Execution>, "the execution policy must be a model of AdaptationExecution");
  }

  /// The same, but `go_on` is asked now and then, by the thread that calls this, whether to go on.
  Any_execution interruptible(std::function<bool()> go_on) const
  {
    Any_execution result = *this;
    result.interruption_ = std::make_shared<Interruption>(std::move(go_on));
    return result;
  }

  int concurrency() const { return concurrency_; }
  Interruption* interruption() const { return interruption_.get(); }

  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const
  {
    run_erased(number_of_tasks, Task_reference(task));
  }

private:
  /// No template, so that each task is compiled once.
  void run_erased(std::size_t number_of_tasks, const Task_reference& task) const
  {
    if (!interruption_) return run_(number_of_tasks, task);
    const auto interruptible_task = [&](std::size_t i) {
      interruption_->poll();
      task(i);
    };
    run_(number_of_tasks, Task_reference(interruptible_task));
  }

  int concurrency_;
  std::function<void(std::size_t, const Task_reference&)> run_;
  std::shared_ptr<Interruption> interruption_; // shared by copies
};

/// Whether the run is to stop: what kernels have not begun is left out.
inline bool is_stopped(const Any_execution& execution)
{
  return execution.interruption() != nullptr && execution.interruption()->is_requested();
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_ANY_EXECUTION_H

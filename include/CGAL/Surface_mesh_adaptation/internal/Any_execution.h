// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_ANY_EXECUTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_ANY_EXECUTION_H

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Any execution policy behind one type, so that the kernels are compiled once for all of them. A task is a chunk of
/// thousands of elements: the indirect call costs nothing.
/// \cgalModels `AdaptationExecution`
class Any_execution
{
public:
  template <class Execution>
  explicit Any_execution(const Execution& execution)
    : concurrency_(execution.concurrency())
    , run_([execution](std::size_t n, const std::function<void(std::size_t)>& task) { execution.run(n, task); })
  {}

  int concurrency() const { return concurrency_; }

  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const
  {
    run_(number_of_tasks, std::ref(task));
  }

private:
  int concurrency_;
  std::function<void(std::size_t, const std::function<void(std::size_t)>&)> run_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_ANY_EXECUTION_H

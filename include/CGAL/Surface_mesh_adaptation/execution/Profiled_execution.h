// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work and span of a run, measured on one thread, and the speed-up that follows from them for any number of threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PROFILED_EXECUTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PROFILED_EXECUTION_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// One parallel step: tasks between two barriers.
struct Parallel_step
{
  std::size_t tasks = 0;
  double work = 0;     ///< processor seconds of all tasks together
  double longest = 0;  ///< seconds of the longest task
};

/// Runs tasks one after the other and records how long they take, by `std::clock()`: in the time of the processor,
/// which does not count what other programs take meanwhile. \pre no other thread of this program runs
/// \cgalModels{AdaptationExecution}
class Profiled_execution
{
public:
  static constexpr const char* name = "profiled";

  int concurrency() const { return 1; }

  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const
  {
    Parallel_step step;
    step.tasks = number_of_tasks;
    std::clock_t last = std::clock();
    for (std::size_t i = 0; i < number_of_tasks; ++i) {
      task(i);
      const std::clock_t now = std::clock();
      const double seconds = double(now - last) / CLOCKS_PER_SEC;
      step.work += seconds;
      step.longest = (std::max)(step.longest, seconds);
      last = now;
    }
    steps_->push_back(step);
  }

  /// The steps so far, in order; shared by copies.
  const std::vector<Parallel_step>& steps() const { return *steps_; }

private:
  std::shared_ptr<std::vector<Parallel_step>> steps_ = std::make_shared<std::vector<Parallel_step>>();
};

/// Upper bound (Brent 1974) on the seconds that `step` takes on `threads` threads under any greedy schedule, plus a
/// barrier of `barrier` seconds for each doubling of the threads.
inline double predicted_seconds(const Parallel_step& step, int threads, double barrier)
{
  if (threads == 1 || step.tasks <= 1) return step.work;
  return step.work / threads + step.longest * (1 - 1.0 / threads) + barrier * std::log2(double(threads));
}

/// The same for a run with `serial` seconds outside of its parallel steps.
inline double predicted_seconds(const std::vector<Parallel_step>& steps, double serial, int threads, double barrier)
{
  double seconds = serial;
  for (const Parallel_step& step : steps) seconds += predicted_seconds(step, threads, barrier);
  return seconds;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PROFILED_EXECUTION_H

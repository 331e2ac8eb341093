// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work and span of a run, measured on one thread, and the speed-up that follows from them for any number of threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PROFILED_EXECUTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PROFILED_EXECUTION_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <functional>
#include <memory>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// One parallel step: tasks between two barriers.
struct Parallel_step
{
  std::vector<float> seconds; ///< of the processor, for each task

  double work() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }
  double longest() const { return seconds.empty() ? 0 : *std::max_element(seconds.begin(), seconds.end()); }
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
    step.seconds.reserve(number_of_tasks);
    std::clock_t last = std::clock();
    for (std::size_t i = 0; i < number_of_tasks; ++i) {
      task(i);
      const std::clock_t now = std::clock();
      step.seconds.push_back(float(now - last) / CLOCKS_PER_SEC);
      last = now;
    }
    steps_->push_back(std::move(step));
  }

  /// The steps so far, in order; shared by copies.
  const std::vector<Parallel_step>& steps() const { return *steps_; }

private:
  std::shared_ptr<std::vector<Parallel_step>> steps_ = std::make_shared<std::vector<Parallel_step>>();
};

/// The seconds that `step` takes on `threads` threads, of which each takes the next task as soon as it is free, plus a
/// barrier of `barrier` seconds for each doubling of the threads. At most work / threads + longest (Graham 1966).
/// Complexity: tasks * log(threads).
inline double predicted_seconds(const Parallel_step& step, int threads, double barrier)
{
  if (threads == 1 || step.seconds.size() <= 1) return step.work();
  std::priority_queue<double, std::vector<double>, std::greater<double>> free_at;
  for (int i = 0; i < threads; ++i) free_at.push(0);
  double end = 0;
  for (const float seconds : step.seconds) {
    const double done = free_at.top() + seconds;
    end = (std::max)(end, done);
    free_at.pop();
    free_at.push(done);
  }
  return end + barrier * std::log2(double(threads));
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

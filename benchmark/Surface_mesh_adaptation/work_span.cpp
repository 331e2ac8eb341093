// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work/span report of a whole adaptation, and the speed-up that it predicts for 2 to 288 threads: the scaling figures
// of the paper as a table, from one thread. The adaptation is the same each time, so it is repeated and the shortest
// time of every single step counts.
//
//     work_span MESH FACTOR [REPETITIONS]    (MESH of CGAL's data, edge length FACTOR times the mean)

#include "common.h"

#include <CGAL/Surface_mesh_adaptation/execution/Profiled_execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/keep_freed_memory.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace {

using bench::Mesh;
using bench::processor_seconds;
namespace SMA = bench::SMA;
using Steps = std::vector<SMA::Parallel_step>;

double work_of(const Steps& steps)
{
  double sum = 0;
  for (const SMA::Parallel_step& s : steps) sum += s.work();
  return sum;
}

/// What one kernel does, over all its calls.
struct Kernel_profile
{
  Steps steps;
  double serial = 0;    ///< seconds outside of the steps
  std::size_t peak = 0; ///< largest number of resident bytes of the program during a call

  double seconds() const { return work_of(steps) + serial; }

  /// What remains on infinitely many threads.
  double span() const
  {
    double sum = 0;
    for (const auto& s : steps) sum += s.longest();
    return sum;
  }

  std::size_t tasks() const
  {
    std::size_t sum = 0;
    for (const auto& s : steps) sum += s.seconds.size();
    return sum;
  }

  /// \pre `other` is of the same run done again
  void keep_shorter(const Kernel_profile& other)
  {
    serial = (std::min)(serial, other.serial);
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (other.steps[i].work() < steps[i].work()) steps[i] = other.steps[i];
  }
};

using Profile = std::map<std::string, Kernel_profile>;

/// Attributes the steps since the last call to the kernel that just ended.
class Recorder : public SMA::Adaptation_visitor
{
public:
  explicit Recorder(const SMA::Profiled_execution& execution) : execution_(execution) {}

  void round_begins(std::size_t, std::size_t) { take("setup"); }
  void kernel_done(const SMA::Kernel_report& k) { take(k.kernel); }
  void round_done(std::size_t, const SMA::Mesh_statistics&) { take("statistics"); }

  void take(const std::string& name)
  {
    const double now = processor_seconds();
    const Steps steps(execution_.steps().begin() + std::ptrdiff_t(taken_), execution_.steps().end());
    Kernel_profile& k = profile[name];
    k.steps.insert(k.steps.end(), steps.begin(), steps.end());
    k.serial += now - last_ - work_of(steps);
    k.peak = (std::max)(k.peak, bench::memory("VmHWM"));
    bench::forget_peak_of_memory();
    taken_ = execution_.steps().size();
    last_ = processor_seconds();
  }

  Profile profile;

private:
  const SMA::Profiled_execution& execution_;
  std::size_t taken_ = 0;
  double last_ = processor_seconds();
};

struct Run
{
  Profile profile;
  SMA::Adaptation_report report;
  Mesh result;
};

Run run(const Mesh& input, double size)
{
  Run r;
  r.result = input;
  const SMA::Profiled_execution execution;
  Recorder recorder(execution);
  r.report = SMA::adapt_surface_mesh(execution, r.result, SMA::Uniform_metric_field(size),
                                     SMA::parameters::visitor(std::ref(recorder)));
  recorder.take("write");
  r.profile = recorder.profile;
  return r;
}

/// What `Surface_mesh` itself takes to get its arrays, which nobody else can do for it: part of "write".
double seconds_of_resize(const Mesh& mesh)
{
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    Mesh empty;
    const double start = processor_seconds();
    empty.resize(mesh.number_of_vertices(), mesh.number_of_edges(), mesh.number_of_faces());
    least = (std::min)(least, processor_seconds() - start);
  }
  return least;
}

SMA::Sweep_counts counts_of(const SMA::Adaptation_report& report, const std::string& kernel)
{
  SMA::Sweep_counts sum;
  for (const SMA::Kernel_report& k : report.kernels)
    if (k.kernel == kernel) sum += {k.sweeps, k.candidates, k.applied, k.deferred};
  return sum;
}

void print_kernels(const Run& run, double total, std::size_t input_bytes)
{
  std::printf("%-11s %6s %10s %9s %9s %6s %7s %9s %9s %7s %10s %9s\n", "phase", "sweeps", "candidates", "applied",
              "deferred", "steps", "tasks", "work [s]", "span [s]", "share", "serial [s]", "peak B/v");
  for (const auto& [name, k] : run.profile) {
    const SMA::Sweep_counts c = counts_of(run.report, name);
    const double bytes = double(k.peak) - double(input_bytes);
    std::printf("%-11s %6zu %10zu %9zu %9zu %6zu %7zu %9.3f %9.4f %6.1f%% %10.4f %9.0f\n", name.c_str(), c.sweeps,
                c.candidates, c.applied, c.deferred, k.steps.size(), k.tasks(), work_of(k.steps), k.span(),
                100 * k.seconds() / total, k.serial, bytes / double(run.report.final.vertices));
  }
}

/// With the serial part as measured, and without what `Surface_mesh` takes to get its arrays.
void print_prediction(const Steps& steps, double serial, double resize)
{
  constexpr double barrier = 2e-6; // seconds for each doubling of the threads
  std::printf("%8s | %9s %9s %10s | without the resizing of Surface_mesh\n", "threads", "seconds", "speed-up",
              "efficiency");
  for (const int threads : {1, 2, 4, 8, 16, 32, 48, 64, 96, 128, 192, 288}) {
    std::printf("%8d", threads);
    for (const double s : {serial, serial - resize}) {
      const double t = SMA::predicted_seconds(steps, s, threads, barrier);
      const double speed_up = SMA::predicted_seconds(steps, s, 1, barrier) / t;
      std::printf(" | %9.4f %9.1f %9.1f%%", t, speed_up, 100 * speed_up / threads);
    }
    std::printf("\n");
  }
}

void print(const std::string& name, const Run& run, std::size_t input_bytes)
{
  Steps steps;
  double serial = 0;
  for (const auto& [kernel, k] : run.profile) {
    steps.insert(steps.end(), k.steps.begin(), k.steps.end());
    serial += k.serial;
  }
  const double total = work_of(steps) + serial, resize = seconds_of_resize(run.result);
  std::printf("%s: %zu vertices, %zu rounds, %.3f s, %.2f us per vertex\n", name.c_str(), run.report.final.vertices,
              run.report.rounds, total, 1e6 * total / double(run.report.final.vertices));
  std::printf("serial part %.2f %%: %.4f s, of which Surface_mesh takes %.4f s to resize itself\n\n",
              100 * serial / total, serial, resize);
  print_kernels(run, total, input_bytes);
  std::printf("\n");
  print_prediction(steps, serial, resize);
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: work_span MESH FACTOR [REPETITIONS]\n");
    return 2;
  }
  SMA::keep_freed_memory();
  const Mesh input = bench::read_mesh(argv[1]);
  const double size = std::atof(argv[2]) * bench::mean_edge_length(input);
  const std::size_t input_bytes = bench::memory("VmRSS");
  Run shortest = run(input, size);
  for (int i = 1; i < (argc == 4 ? std::atoi(argv[3]) : 3); ++i) {
    const Run again = run(input, size);
    for (auto& [name, k] : shortest.profile) k.keep_shorter(again.profile.at(name));
  }
  print(argv[1], shortest, input_bytes);
  return 0;
}

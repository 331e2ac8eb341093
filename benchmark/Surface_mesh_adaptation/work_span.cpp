// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work/span report of a whole adaptation, and the speed-up that it predicts for 2 to 288 threads: the scaling figures
// of the paper as a table, from one thread.
//
//     work_span MESH FACTOR    (MESH of CGAL's data, edge length FACTOR times the mean)

#include <CGAL/Surface_mesh_adaptation/Profiled_execution.h>
#include <CGAL/surface_mesh_adaptation.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double mean_edge_length(const Mesh& mesh)
{
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / double(mesh.number_of_edges());
}

/// What one kernel does, over all its calls.
struct Kernel_work
{
  std::vector<SMA::Parallel_step> steps;
  double seconds = 0;

  double work() const
  {
    double sum = 0;
    for (const auto& s : steps) sum += s.work;
    return sum;
  }

  /// What remains on infinitely many threads.
  double span() const
  {
    double sum = 0;
    for (const auto& s : steps) sum += s.longest;
    return sum;
  }

  std::size_t tasks() const
  {
    std::size_t sum = 0;
    for (const auto& s : steps) sum += s.tasks;
    return sum;
  }
};

/// Attributes the steps since the last call to the kernel that just ended.
class Kernel_clock : public SMA::Adaptation_visitor
{
public:
  explicit Kernel_clock(const SMA::Profiled_execution& execution) : execution_(execution) {}

  void round_begins(std::size_t, std::size_t) { take("setup"); }
  void kernel_done(const SMA::Kernel_report& k) { take(k.kernel); }
  void round_done(std::size_t, const SMA::Mesh_statistics&) { take("statistics"); }

  void take(const std::string& kernel)
  {
    Kernel_work& w = work[kernel];
    w.steps.insert(w.steps.end(), execution_.steps().begin() + std::ptrdiff_t(taken_), execution_.steps().end());
    w.seconds += seconds_since(last_);
    taken_ = execution_.steps().size();
    last_ = Clock::now();
  }

  std::map<std::string, Kernel_work> work;

private:
  const SMA::Profiled_execution& execution_;
  std::size_t taken_ = 0;
  Clock::time_point last_ = Clock::now();
};

void print_kernels(const std::map<std::string, Kernel_work>& kernels, double total)
{
  std::printf("%-11s %9s %8s %9s %9s %9s %10s\n", "phase", "steps", "tasks", "work [s]", "span [s]", "share",
              "serial [s]");
  for (const auto& [name, k] : kernels)
    std::printf("%-11s %9zu %8zu %9.3f %9.4f %8.1f%% %10.4f\n", name.c_str(), k.steps.size(), k.tasks(), k.work(),
                k.span(), 100 * k.seconds / total, k.seconds - k.work());
}

void print_prediction(const std::vector<SMA::Parallel_step>& steps, double serial)
{
  constexpr double barrier = 2e-6; // seconds for each doubling of the threads
  const double sequential = SMA::predicted_seconds(steps, serial, 1, barrier);
  std::printf("%8s %12s %9s %11s\n", "threads", "seconds", "speed-up", "efficiency");
  for (const int threads : {1, 2, 4, 8, 16, 32, 48, 64, 96, 128, 192, 288}) {
    const double t = SMA::predicted_seconds(steps, serial, threads, barrier);
    std::printf("%8d %12.4f %9.1f %10.1f%%\n", threads, t, sequential / t, 100 * sequential / t / threads);
  }
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 3) {
    std::fprintf(stderr, "usage: work_span MESH FACTOR\n");
    return 2;
  }
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(CGAL::data_file_path(std::string("meshes/") + argv[1] + ".off"), mesh)) return 1;
  const SMA::Uniform_metric_field field(std::atof(argv[2]) * mean_edge_length(mesh));
  const SMA::Profiled_execution execution;
  Kernel_clock clock(execution);
  const auto start = Clock::now();
  const SMA::Adaptation_report report =
    SMA::adapt_surface_mesh(execution, mesh, field, SMA::parameters::visitor(std::ref(clock)));
  const double total = seconds_since(start);
  clock.take("write");

  double work = 0;
  for (const auto& s : execution.steps()) work += s.work;
  std::printf("%s: %zu vertices, %zu rounds, %.3f s, %.2f us per vertex, serial part %.2f %%\n\n", argv[1],
              report.final.vertices, report.rounds, total, 1e6 * total / double(report.final.vertices),
              100 * (total - work) / total);
  print_kernels(clock.work, total);
  std::printf("\n");
  print_prediction(execution.steps(), total - work);
  return 0;
}

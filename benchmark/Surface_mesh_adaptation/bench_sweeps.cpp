// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the sweeps promise, as ratios within one run: a bad order of the input costs little, coarsening and refining
// cost microseconds a vertex, a mesh that is adapted already is left alone, and two threads halve the time. Each time
// is the least of several adaptations; those on one thread are in the time of the processor, which other programs on
// the machine do not enter.
//
//     bench_sweeps [REPETITIONS]

#include "common.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using bench::Mesh;
using bench::Point;
namespace SMA = bench::SMA;

struct Run
{
  Mesh result;
  SMA::Adaptation_report report;
  double processor = 1e300, wall = 1e300; ///< least of the repetitions, in seconds
};

template <class Execution, class Field>
Run adapt(const Execution& execution, const Mesh& input, const Field& field, int repetitions)
{
  Run best;
  for (int i = 0; i < repetitions; ++i) {
    Mesh mesh = input;
    const double processor = bench::processor_seconds(), wall = bench::wall_seconds();
    const SMA::Adaptation_report report = SMA::adapt_surface_mesh(execution, mesh, field);
    const double seconds = bench::processor_seconds() - processor;
    best.wall = (std::min)(best.wall, bench::wall_seconds() - wall);
    if (seconds < best.processor) {
      best.processor = seconds;
      best.report = report;
    }
    best.result = std::move(mesh);
  }
  return best;
}

/// The same mesh with its vertices and faces in random order.
Mesh shuffled(const Mesh& mesh)
{
  std::mt19937 random(1);
  std::vector<Mesh::Vertex_index> order(mesh.vertices().begin(), mesh.vertices().end()), place(order.size());
  std::shuffle(order.begin(), order.end(), random);
  Mesh result;
  for (const auto v : order) place[v] = result.add_vertex(mesh.point(v));
  std::vector<std::array<Mesh::Vertex_index, 3>> faces;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    faces.push_back({place[mesh.source(h)], place[mesh.target(h)], place[mesh.target(mesh.next(h))]});
  }
  std::shuffle(faces.begin(), faces.end(), random);
  CGAL::Euler::add_faces(faces, result);
  return result;
}

void print_kernels(const Run& run)
{
  std::printf("  %-10s %6s %10s %10s %10s %8s %12s %22s\n", "kernel", "sweeps", "candidates", "applied", "deferred",
              "seconds", "us/vertex", "us/vertex and sweep");
  for (const char* name : {"refine", "simplify", "swap", "regularize", "relocate"}) {
    SMA::Kernel_report sum;
    for (const SMA::Kernel_report& k : run.report.kernels)
      if (k.kernel == name) {
        sum.sweeps += k.sweeps;
        sum.candidates += k.candidates;
        sum.applied += k.applied;
        sum.deferred += k.deferred;
        sum.seconds += k.seconds;
      }
    const double per_vertex = 1e6 * sum.seconds / double(run.report.final.vertices);
    std::printf("  %-10s %6zu %10zu %10zu %10zu %8.3f %12.3f %22.3f\n", name, sum.sweeps, sum.candidates, sum.applied,
                sum.deferred, sum.seconds, per_vertex, per_vertex / double((std::max)(sum.sweeps, std::size_t(1))));
  }
}

void print_cost(const char* job, const Mesh& input, const Run& run)
{
  const double in = double(input.number_of_vertices()), out = double(run.report.final.vertices);
  std::printf("%-30s %8.0f -> %8.0f vertices, %2zu rounds, %7.3f s, %6.2f us per output vertex, %6.2f per input "
              "vertex, in range %.4f, mean quality %.4f\n",
              job, in, out, run.report.rounds, run.processor, 1e6 * run.processor / out, 1e6 * run.processor / in,
              run.report.final.in_range, run.report.final.mean_quality);
  print_kernels(run);
}

bool comes_before(const Point& p, const Point& q)
{
  return std::make_tuple(p.x(), p.y(), p.z()) < std::make_tuple(q.x(), q.y(), q.z());
}

/// The share of the vertices of `after` that were not there before.
double share_of_new_vertices(const Mesh& before, const Mesh& after)
{
  std::vector<Point> known;
  for (const auto v : before.vertices()) known.push_back(before.point(v));
  std::sort(known.begin(), known.end(), comes_before);
  std::size_t fresh = 0;
  for (const auto v : after.vertices())
    fresh += !std::binary_search(known.begin(), known.end(), after.point(v), comes_before);
  return double(fresh) / double(after.number_of_vertices());
}

/// The inputs and sizes that all sections use: about 138 and 554 thousand vertices.
struct Jobs
{
  int repetitions;
  Mesh input = bench::read_mesh("bunny00");
  double fine_size = 0.28 * bench::mean_edge_length(input), coarse_size = 2 * fine_size;
  Mesh coarse, fine;

  explicit Jobs(int repetitions_) : repetitions(repetitions_)
  {
    coarse = adapt(SMA::Sequential_execution(), input, SMA::Uniform_metric_field(coarse_size), 1).result;
    fine = adapt(SMA::Sequential_execution(), input, SMA::Uniform_metric_field(fine_size), 1).result;
  }

  template <class Field>
  Run run(const Mesh& mesh, const Field& field) const
  {
    return adapt(SMA::Sequential_execution(), mesh, field, repetitions);
  }

  Run refine(const Mesh& mesh) const { return run(mesh, SMA::Uniform_metric_field(fine_size)); }
  Run coarsen(const Mesh& mesh) const { return run(mesh, SMA::Uniform_metric_field(coarse_size)); }
};

void print_costs_and_orders(const Jobs& jobs)
{
  const Run refined = jobs.refine(jobs.coarse), coarsened = jobs.coarsen(jobs.fine);
  print_cost("uniform, refined by 4", jobs.coarse, refined);
  print_cost("uniform, coarsened by 4", jobs.fine, coarsened);
  const Run stretched = jobs.run(jobs.coarse, bench::turning_field(0.8 * jobs.fine_size, 100 * jobs.fine_size));
  print_cost("anisotropic, 4 : 1, turning", jobs.coarse, stretched);
  std::printf("shuffled over ordered input: %.3f of the time where it is refined, %.3f where it is coarsened\n",
              jobs.refine(shuffled(jobs.coarse)).processor / refined.processor,
              jobs.coarsen(shuffled(jobs.fine)).processor / coarsened.processor);
}

void print_again(const Jobs& jobs)
{
  const Run first = jobs.refine(jobs.input);
  print_cost("uniform, of the input as read", jobs.input, first);
  Mesh last = first.result;
  for (const char* which : {"second", "third"}) {
    const Run again = jobs.refine(last);
    std::printf("%s run, on the result of the one before: %.3f of the time of the first, %.4f of the vertices changed\n",
                which, again.processor / first.processor, share_of_new_vertices(last, again.result));
    last = again.result;
  }
}

template <class Execution>
void print_speed_up(const Jobs& jobs)
{
  const SMA::Uniform_metric_field field(jobs.fine_size);
  const Run one = adapt(Execution(1), jobs.coarse, field, jobs.repetitions);
  const Run two = adapt(Execution(2), jobs.coarse, field, jobs.repetitions);
  std::printf("%s: %.3f s on one thread, %.3f on two: %.2f times as fast, with %.2f times the processor time\n",
              Execution::name, one.wall, two.wall, one.wall / two.wall, two.processor / one.processor);
}

} // namespace

int main(int argc, char* argv[])
{
  const Jobs jobs(argc > 1 ? std::atoi(argv[1]) : 3);
  print_costs_and_orders(jobs);
  print_again(jobs);
#ifdef CGAL_LINKED_WITH_TBB
  print_speed_up<SMA::TBB_execution>(jobs);
#endif
#ifdef _OPENMP
  print_speed_up<SMA::OpenMP_execution>(jobs);
#endif
  return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole adaptations of the real meshes of CGAL's data, by job and execution policy. Counters: output vertices, share of
// the edges in range, mean and worst quality, smallest angle, and microseconds of the adaptation (without reading the
// mesh) per output vertex.
//
// Run one mesh with --benchmark_filter=elephant.

#include "common.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using bench::Mesh;
using bench::mean_edge_length;
namespace SMA = bench::SMA;

/// Adapts a copy of `input` in every iteration.
template <class Execution, class Field>
void adapt(benchmark::State& state, const Mesh& input, const Execution& execution, const Field& field)
{
  SMA::Adaptation_report report;
  double seconds = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Mesh mesh = input;
    state.ResumeTiming();
    report = SMA::adapt_surface_mesh(execution, mesh, field);
    seconds += report.seconds;
  }
  const SMA::Mesh_statistics& s = report.final;
  state.counters["vertices"] = double(s.vertices);
  state.counters["in_range"] = s.in_range;
  state.counters["mean_q"] = s.mean_quality;
  state.counters["min_q"] = s.min_quality;
  state.counters["min_angle"] = s.min_angle;
  state.counters["us/v"] = 1e6 * seconds / double(state.iterations()) / double(s.vertices);
}

template <class Execution>
void register_jobs(const std::string& mesh_name, const Execution& execution, const std::string& policy)
{
  const auto add = [&](const std::string& job, const auto& make_field) {
    benchmark::RegisterBenchmark((mesh_name + "/" + job + "/" + policy).c_str(), [=](benchmark::State& state) {
      const Mesh input = bench::read_mesh(mesh_name);
      adapt(state, input, execution, make_field(input));
    })->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  add("size_1x", [](const Mesh& m) { return SMA::Uniform_metric_field(mean_edge_length(m)); });
  add("size_0.5x", [](const Mesh& m) { return SMA::Uniform_metric_field(0.5 * mean_edge_length(m)); });
  add("curvature_0.001", [](const Mesh&) { return SMA::Curvature_metric_field(0.001); });
}

} // namespace

int main(int argc, char* argv[])
{
  for (const char* mesh : {"elephant", "bunny00", "armadillo", "camel", "knot2", "fandisk", "anchor_dense",
                           "couplingdown", "rotor_small", "turbine", "blade", "lion-head", "mannequin-devil"}) {
    register_jobs(mesh, SMA::Sequential_execution(), "sequential");
#ifdef CGAL_LINKED_WITH_TBB
    register_jobs(mesh, SMA::TBB_execution(), "tbb");
#endif
#ifdef _OPENMP
    register_jobs(mesh, SMA::OpenMP_execution(), "openmp");
#endif
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

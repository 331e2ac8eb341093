// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why the kernels work on a corner table and not on the user's `Surface_mesh`: the price of a walk around every vertex
// on both, and of the way in and out, which is paid once for a whole adaptation.

#include "common.h"

#include <benchmark/benchmark.h>

namespace {

using bench::Mesh;
namespace SMA = bench::SMA;
const SMA::Sequential_execution sequential;

/// A mesh of half a million vertices in a good order.
const Mesh& large_mesh()
{
  static const Mesh mesh = [] {
    Mesh m = bench::read_mesh("bunny00");
    SMA::adapt_surface_mesh(m, SMA::Uniform_metric_field(0.0024));
    return m;
  }();
  return mesh;
}

void per_vertex(benchmark::State& state)
{
  state.counters["vertices"] = double(large_mesh().number_of_vertices());
  state.counters["per_vertex"] = benchmark::Counter(double(large_mesh().number_of_vertices()),
                                                    benchmark::Counter::kIsIterationInvariantRate |
                                                    benchmark::Counter::kInvert);
}

void ring_walk_surface_mesh(benchmark::State& state)
{
  const Mesh& mesh = large_mesh();
  for (auto _ : state) {
    double sum = 0;
    for (const auto v : mesh.vertices())
      for (const auto w : CGAL::vertices_around_target(mesh.halfedge(v), mesh)) sum += mesh.point(w).x();
    benchmark::DoNotOptimize(sum);
  }
  per_vertex(state);
}

void ring_walk_view(benchmark::State& state)
{
  const auto imported = SMA::internal::read_face_graph(sequential, large_mesh(), large_mesh().points());
  for (auto _ : state) {
    double sum = 0;
    for (std::size_t v = 0; v < imported.mesh.number_of_vertices(); ++v)
      imported.mesh.for_each_neighbor(SMA::Index(v), [&](SMA::Index w) { sum += imported.points[w][0]; });
    benchmark::DoNotOptimize(sum);
  }
  per_vertex(state);
}

void read_face_graph(benchmark::State& state)
{
  for (auto _ : state)
    benchmark::DoNotOptimize(SMA::internal::read_face_graph(sequential, large_mesh(), large_mesh().points()));
  per_vertex(state);
}

void write_connectivity(benchmark::State& state)
{
  const auto imported = SMA::internal::read_face_graph(sequential, large_mesh(), large_mesh().points());
  Mesh mesh = large_mesh();
  for (auto _ : state) SMA::internal::write_connectivity(sequential, imported.mesh, mesh);
  per_vertex(state);
}

BENCHMARK(ring_walk_surface_mesh)->Unit(benchmark::kMillisecond);
BENCHMARK(ring_walk_view)->Unit(benchmark::kMillisecond);
BENCHMARK(read_face_graph)->Unit(benchmark::kMillisecond);
BENCHMARK(write_connectivity)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a point of the surface costs: a patch built and evaluated once, as the kernels do, and, for the Gregory patch,
// the two apart; the exponential map and its inverse; a transport. Faces are those of a torus, visited in order.

#include "../../test/Surface_mesh_adaptation/analytic_surfaces.h"

#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/surface/exponential_map.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <benchmark/benchmark.h>

#include <vector>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;

const std::vector<SMA::Patch>& patches()
{
  static const std::vector<SMA::Patch> result = [] {
    const analytic::Torus torus;
    const shapes::Soup soup = analytic::mesh(torus, 1);
    std::vector<SMA::Patch> p;
    for (const shapes::Triangle& t : soup.triangles) p.push_back(analytic::patch(torus, soup, t));
    return p;
  }();
  return result;
}

/// One call per patch; the time reported is that of a call.
template <class Call>
void for_each_patch(benchmark::State& state, const Call& call)
{
  for (auto _ : state)
    for (const SMA::Patch& p : patches()) benchmark::DoNotOptimize(call(p));
  state.counters["per_call"] = benchmark::Counter(
    double(patches().size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Reconstruction>
void build_and_evaluate(benchmark::State& state)
{
  for_each_patch(state, [](const SMA::Patch& p) { return Reconstruction::evaluate(p, 0.3, 0.5); });
}

template <SMA::Gregory_patch_3::Construction construction>
void build(benchmark::State& state)
{
  for_each_patch(state, [](const SMA::Patch& p) { return SMA::Gregory_patch_3(p, construction); });
}

void evaluate(benchmark::State& state)
{
  std::vector<SMA::Gregory_patch_3> built;
  for (const SMA::Patch& p : patches()) built.emplace_back(p);
  std::size_t i = 0;
  for_each_patch(state, [&](const SMA::Patch&) {
    i = i + 1 < built.size() ? i + 1 : 0;
    return built[i].evaluate(0.3, 0.5);
  });
}

template <SMA::Exponential_map_method method>
void exponential_map(benchmark::State& state)
{
  const analytic::Torus torus;
  const shapes::Soup soup = analytic::mesh(torus, 1);
  const SMA::Mesh_view mesh = shapes::view(soup);
  const SMA::One_ring ring = SMA::one_ring(mesh, mesh.outgoing[20], [&](SMA::Index f) { return patches()[f]; });
  for_each_patch(state, [&](const SMA::Patch& p) {
    const SMA::Vector_3 t = 0.1 * ring.normal().cross(p.normals[0]);
    return SMA::exponential_map(ring, t, method);
  });
}

void logarithm_map(benchmark::State& state)
{
  for_each_patch(state, [](const SMA::Patch& p) {
    return SMA::logarithm_map(p.points[0], p.normals[0], p.points[1], p.normals[1]);
  });
}

void minimal_rotation(benchmark::State& state)
{
  for_each_patch(state, [](const SMA::Patch& p) { return SMA::minimal_rotation(p.normals[0], p.normals[1]); });
}

void chord_rotation(benchmark::State& state)
{
  for_each_patch(state, [](const SMA::Patch& p) {
    return SMA::chord_rotation(p.points[0], p.normals[0], p.points[1], p.normals[1]);
  });
}

using Construction = SMA::Gregory_patch_3::Construction;
BENCHMARK_TEMPLATE(build_and_evaluate, SMA::Flat_reconstruction);
BENCHMARK_TEMPLATE(build_and_evaluate, SMA::PN_triangle_reconstruction);
BENCHMARK_TEMPLATE(build_and_evaluate, SMA::Walton_meek_reconstruction);
BENCHMARK_TEMPLATE(build_and_evaluate, SMA::Gregory_reconstruction);
BENCHMARK_TEMPLATE(build, Construction::walton_meek);
BENCHMARK_TEMPLATE(build, Construction::mid_edge);
BENCHMARK(evaluate);
BENCHMARK_TEMPLATE(exponential_map, SMA::Exponential_map_method::length_kept);
BENCHMARK_TEMPLATE(exponential_map, SMA::Exponential_map_method::shooting);
BENCHMARK(logarithm_map);
BENCHMARK(minimal_rotation);
BENCHMARK(chord_rotation);

} // namespace

BENCHMARK_MAIN();

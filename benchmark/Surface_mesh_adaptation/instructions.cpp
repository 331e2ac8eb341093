// SPDX-License-Identifier: GPL-3.0-or-later
//
// One adaptation with the sequential policy for Callgrind, which is told where each kernel ends; see
// scripts/count_instructions.
//
//     instructions MESH refine|coarsen|anisotropic    (MESH of CGAL's data)

#include "common.h"

#include <valgrind/callgrind.h>

#include <cstdio>
#include <functional>
#include <string>

namespace {

namespace SMA = bench::SMA;

/// Has the counts since the last call written down under a name.
struct Counts : SMA::Adaptation_visitor
{
  void round_begins(std::size_t round, std::size_t) { if (round == 0) take("setup"); }
  void kernel_done(const SMA::Kernel_report& k) { take(k.kernel); }
  void round_done(std::size_t, const SMA::Mesh_statistics&) { take("statistics"); }

  static void take(const std::string& name) { CALLGRIND_DUMP_STATS_AT(name.c_str()); }
};

template <class Field>
void adapt(bench::Mesh& mesh, const Field& field)
{
  Counts counts;
  CALLGRIND_START_INSTRUMENTATION;
  SMA::adapt_surface_mesh(SMA::Sequential_execution(), mesh, field, SMA::parameters::visitor(std::ref(counts)));
  counts.take("write");
  CALLGRIND_STOP_INSTRUMENTATION;
}

} // namespace

int main(int argc, char* argv[])
{
  const std::string job = argc == 3 ? argv[2] : "";
  if (job != "refine" && job != "coarsen" && job != "anisotropic") {
    std::fprintf(stderr, "usage: instructions MESH refine|coarsen|anisotropic\n");
    return 2;
  }
  bench::Mesh mesh = bench::read_mesh(argv[1]);
  const double coarse = bench::mean_edge_length(mesh), fine = 0.5 * coarse;
  SMA::adapt_surface_mesh(SMA::Sequential_execution(), mesh, SMA::Uniform_metric_field(job == "coarsen" ? fine : coarse));
  const std::size_t before = mesh.number_of_vertices();
  if (job == "refine") adapt(mesh, SMA::Uniform_metric_field(fine));
  else if (job == "coarsen") adapt(mesh, SMA::Uniform_metric_field(coarse));
  else adapt(mesh, bench::turning_field(0.8 * fine, 100 * fine));
  std::printf("%zu %zu\n", before, std::size_t(mesh.number_of_vertices()));
  return 0;
}

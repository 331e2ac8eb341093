// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints the processor seconds of one adaptation with the sequential policy; see scripts/compare_builds.
//
//     sequential MESH FACTOR    (MESH of CGAL's data, edge length FACTOR times the mean)

#include "common.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char* argv[])
{
  if (argc != 3) {
    std::fprintf(stderr, "usage: sequential MESH FACTOR\n");
    return 2;
  }
  bench::Mesh mesh = bench::read_mesh(argv[1]);
  const bench::SMA::Uniform_metric_field field(std::atof(argv[2]) * bench::mean_edge_length(mesh));
  const double start = bench::processor_seconds();
  bench::SMA::adapt_surface_mesh(bench::SMA::Sequential_execution(), mesh, field);
  std::printf("%.6f\n", bench::processor_seconds() - start);
  return 0;
}

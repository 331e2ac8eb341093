// SPDX-License-Identifier: GPL-3.0-or-later
//
// Remeshes a file to a uniform size by this package or by CGAL's `isotropic_remeshing`, with three iterations and edges
// of more than 45 degrees constrained, on one thread; prints the processor seconds, those of files left out. See
// scripts/compare_speed.
//
//     remesh_uniformly ours|isotropic_remeshing INPUT.off SIZE OUTPUT.off

#include "common.h"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using bench::Mesh;

void remesh_with_cgal(Mesh& mesh, double size)
{
  constexpr double feature_angle = 45;
  constexpr unsigned int iterations = 3;
  auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_sharp", false).first;
  PMP::detect_sharp_edges(mesh, feature_angle, is_sharp);
  PMP::isotropic_remeshing(faces(mesh), size, mesh,
                           CGAL::parameters::number_of_iterations(iterations).edge_is_constrained_map(is_sharp));
}

} // namespace

int main(int argc, char* argv[])
{
  Mesh mesh;
  if (argc != 5 || !CGAL::IO::read_polygon_mesh(argv[2], mesh)) {
    std::fprintf(stderr, "usage: remesh_uniformly ours|isotropic_remeshing INPUT.off SIZE OUTPUT.off\n");
    return 2;
  }
  const double size = std::atof(argv[3]), start = bench::processor_seconds();
  if (std::string(argv[1]) == "ours")
    bench::SMA::adapt_surface_mesh(bench::SMA::Sequential_execution(), mesh, bench::SMA::Uniform_metric_field(size));
  else
    remesh_with_cgal(mesh, size);
  std::printf("%.6f\n", bench::processor_seconds() - start);
  mesh.collect_garbage();
  return CGAL::IO::write_polygon_mesh(argv[4], mesh, CGAL::parameters::stream_precision(17)) ? 0 : 1;
}

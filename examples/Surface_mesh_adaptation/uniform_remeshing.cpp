// SPDX-License-Identifier: GPL-3.0-or-later
//
// Remeshes a surface with edges of one length: `uniform_remeshing [INPUT [LENGTH]]`.

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <cstdlib>
#include <exception>
#include <iostream>

namespace SMA = CGAL::Surface_mesh_adaptation;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

int main(int argc, char* argv[])
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/elephant.off");
  const double length = argc > 2 ? std::atof(argv[2]) : 0.01;

  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(file, mesh)) {
    std::cerr << "cannot read " << file << '\n';
    return EXIT_FAILURE;
  }
  try {
    //! [adapt]
    // in parallel if the program was built so; the result does not depend on it
    const SMA::Adaptation_report report = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(length));
    //! [adapt]
    std::cout << report.initial.vertices << " vertices became " << report.final.vertices << "; "
              << 100 * report.final.in_range << " % of the edges have the length asked for, the mean quality is "
              << report.final.mean_quality << '\n';
  } catch (const SMA::Adaptation_error& e) { // the mesh is as it was
    std::cerr << file << ": " << e.what() << '\n';
    return EXIT_FAILURE;
  }
  return CGAL::IO::write_polygon_mesh("uniform_remeshing.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}

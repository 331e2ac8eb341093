// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each kernel on its own, with its own stop: a number of sweeps, or whatever a visitor decides.

#include <CGAL/Surface_mesh_adaptation/refine.h>
#include <CGAL/Surface_mesh_adaptation/relocate.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>
#include <CGAL/Surface_mesh_adaptation/swap.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace parameters = CGAL::Surface_mesh_adaptation::parameters;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// Stops after a time. The only thing here that can differ from run to run.
struct Deadline : SMA::Adaptation_visitor
{
  std::chrono::steady_clock::time_point end = std::chrono::steady_clock::now() + std::chrono::seconds(10);

  bool go_on() const { return std::chrono::steady_clock::now() < end; }
};

int main(int argc, char* argv[])
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/lion-head.off");
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(file, mesh)) {
    std::cerr << "cannot read " << file << '\n';
    return EXIT_FAILURE;
  }
  const SMA::Uniform_metric_field field(0.02);

  //! [kernels]
  std::cout << SMA::refine(mesh, field) << " edges split, until none was too long\n";
  std::cout << SMA::simplify(mesh, field, parameters::number_of_iterations(3)) << " vertices removed in 3 sweeps\n";
  Deadline deadline;
  std::cout << SMA::swap(mesh, field, parameters::visitor(std::ref(deadline)))
            << " edges swapped before the deadline\n";
  // a policy in place of the default one: here on the calling thread only
  std::cout << SMA::relocate(SMA::Sequential_execution(), mesh, field, parameters::number_of_iterations(2))
            << " moves in 2 sweeps\n";
  //! [kernels]
  return CGAL::IO::write_polygon_mesh("kernels_alone.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}

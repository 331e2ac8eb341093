// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes that follow the curvature, and aim at a thousandth of the size of the part between the surface and the faces;
// that the result is within five thousandths of the input is certified. Ridges are detected, kept, and marked on it.

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace SMA = CGAL::Surface_mesh_adaptation;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

int main(int argc, char* argv[])
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/fandisk.off");
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(file, mesh)) {
    std::cerr << "cannot read " << file << '\n';
    return EXIT_FAILURE;
  }
  const auto is_ridge = mesh.add_property_map<Mesh::Edge_index, bool>("e:ridge", false).first;

  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());

  Mesh rough = mesh;

  //! [curvature]
  SMA::Curvature_metric_field field(0.001); // of the diagonal of the bounding box
  field.gradation = 1.2;                    // neighbouring sizes differ less than by default
  const auto parameters =
    SMA::parameters::tolerance(0.005 * diagonal).feature_angle(40).edge_is_constrained_map(is_ridge);
  const SMA::Adaptation_report report = SMA::adapt_surface_mesh(mesh, field, parameters);
  //! [curvature]

  const auto all = edges(mesh);
  std::cout << report.initial.vertices << " vertices became " << report.final.vertices << ", "
            << std::count_if(all.begin(), all.end(), [&](Mesh::Edge_index e) { return is_ridge[e]; })
            << " edges lie on ridges\n";

  // few faces, within a distance
  //! [within]
  const double distance = 0.005;
  const SMA::Adaptation_report within = SMA::adapt_surface_mesh(
    rough, SMA::Curvature_metric_field::for_tolerance(distance), SMA::parameters::tolerance(distance * diagonal));
  //! [within]
  std::cout << within.final.vertices << " vertices are enough within " << within.certified_distance / diagonal
            << " diagonals\n";
  return CGAL::IO::write_polygon_mesh("curvature_adaptation.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}

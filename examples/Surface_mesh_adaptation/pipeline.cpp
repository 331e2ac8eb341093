// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adaptation between other packages: a polygon soup is repaired and oriented, the mesh is adapted, and a ball is cut
// out of the result by a Boolean operation.

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMA = CGAL::Surface_mesh_adaptation;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

bool read_repaired(const std::string& file, Mesh& mesh)
{
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(file, points, polygons)) return false;
  PMP::repair_polygon_soup(points, polygons);
  PMP::orient_polygon_soup(points, polygons);
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  PMP::triangulate_faces(mesh);
  if (!CGAL::is_closed(mesh)) return false;
  PMP::orient_to_bound_a_volume(mesh);
  return true;
}

int main(int argc, char* argv[])
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/rotor_small.off");
  Mesh mesh, ball, result;
  if (!read_repaired(file, mesh)) {
    std::cerr << file << " is no closed surface\n";
    return EXIT_FAILURE;
  }
  const auto box = PMP::bbox(mesh);
  const Point low(box.xmin(), box.ymin(), box.zmin()), corner(box.xmax(), box.ymax(), box.zmax());
  const double radius = 0.35 * std::sqrt(CGAL::squared_distance(low, corner));

  CGAL::make_icosahedron<Mesh, Point>(ball, corner, radius);
  //! [pipeline]
  for (Mesh* m : {&mesh, &ball}) {
    const SMA::Uniform_metric_field field(radius / 20);
    // Booleans refuse surfaces that intersect themselves
    const auto report = SMA::adapt_surface_mesh(*m, field, SMA::parameters::avoid_self_intersections(true));
    std::cout << report.initial.vertices << " vertices became " << report.final.vertices << '\n';
  }
  //! [pipeline]
  if (!PMP::corefine_and_compute_difference(mesh, ball, result)) {
    std::cerr << "the difference is no manifold\n";
    return EXIT_FAILURE;
  }
  std::cout << "the difference has " << num_vertices(result) << " vertices\n";
  return CGAL::IO::write_polygon_mesh("pipeline.off", result) ? EXIT_SUCCESS : EXIT_FAILURE;
}

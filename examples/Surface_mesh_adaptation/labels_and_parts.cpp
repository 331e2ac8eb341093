// SPDX-License-Identifier: GPL-3.0-or-later
//
// What goes in comes out: materials of faces, a border that another mesh has to fit to, and all but a selection.

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMA = CGAL::Surface_mesh_adaptation;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;

/// The mean length of the edges.
double mean_length(const Mesh& mesh)
{
  double sum = 0;
  for (const Edge e : mesh.edges()) sum += PMP::edge_length(e, mesh);
  return sum / double(mesh.number_of_edges());
}

/// Two materials, above and below: the result has both, as large as before, and no face lies across their border.
void keep_materials(Mesh mesh, double length)
{
  const double height = (PMP::bbox(mesh).zmin() + PMP::bbox(mesh).zmax()) / 2;
  //! [labels]
  const auto material = mesh.add_property_map<Face, std::string>("f:material").first;
  for (const Face f : mesh.faces())
    material[f] = mesh.point(mesh.target(mesh.halfedge(f))).z() > height ? "steel" : "rubber";
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(length), SMA::parameters::face_patch_map(material));
  //! [labels]
  double steel = 0;
  for (const Face f : mesh.faces())
    if (material[f] == "steel") steel += PMP::face_area(f, mesh);
  std::cout << "steel: " << 100 * steel / PMP::area(mesh) << " % of the area\n";
}

/// A shell and its mirror image fit to each other after each was adapted by itself.
void keep_fit(double length)
{
  Mesh mesh;
  CGAL::make_grid(30, 30, mesh, [](std::size_t i, std::size_t j) {
    const double x = double(i) / 30, y = double(j) / 30;
    return Point(x, y, 0.2 * std::sin(4 * x) * y);
  }, true);
  //! [protect]
  const auto is_interface = mesh.add_property_map<Edge, bool>("e:interface", false).first;
  for (const Edge e : mesh.edges()) is_interface[e] = mesh.is_border(e);
  const auto border = SMA::parameters::edge_is_constrained_map(is_interface);
  SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(length), border.protect_constraints(true));
  //! [protect]
  std::cout << std::count_if(mesh.edges().begin(), mesh.edges().end(), [&](Edge e) { return mesh.is_border(e); })
            << " edges of the border, as before\n";
}

/// Small faces around one vertex: the rest of the mesh stays as it is.
void adapt_selection(Mesh mesh, double length)
{
  const Point center = mesh.point(*mesh.vertices().begin());
  const double radius = 10 * length;
  //! [selection]
  std::vector<Face> selection;
  for (const Face f : mesh.faces()) {
    const Point corner = mesh.point(mesh.target(mesh.halfedge(f)));
    if (CGAL::squared_distance(center, corner) < radius * radius) selection.push_back(f);
  }
  SMA::adapt_surface_mesh(selection, mesh, SMA::Uniform_metric_field(length));
  //! [selection]
  mesh.collect_garbage();
  std::cout << selection.size() << " faces selected, " << mesh.number_of_vertices() << " vertices now\n";
}

int main(int argc, char* argv[])
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/elephant.off");
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(file, mesh)) {
    std::cerr << "cannot read " << file << '\n';
    return EXIT_FAILURE;
  }
  keep_materials(mesh, mean_length(mesh));
  keep_fit(0.1);
  adapt_selection(mesh, 0.3 * mean_length(mesh));
  return EXIT_SUCCESS;
}

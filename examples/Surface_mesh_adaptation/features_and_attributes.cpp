// SPDX-License-Identifier: GPL-3.0-or-later
//
// What else an adaptation can be told: which edges and vertices to keep, which values to carry over, how far the result
// may be from the input; and how to follow it and to call it off.

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <tuple>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMA = CGAL::Surface_mesh_adaptation;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Edge = Mesh::Edge_index;

std::atomic<bool> is_interrupted = false;

//! [visitor]
/// Prints a line for each round, and ends the run when Ctrl-C is pressed.
struct Progress : SMA::Adaptation_visitor
{
  void round_done(std::size_t round, const SMA::Mesh_statistics& now)
  {
    std::cout << "round " << round + 1 << ": " << now.vertices << " vertices, " << 100 * now.in_range
              << " % of the edges in range\n";
  }
  bool go_on() { return !is_interrupted; }
};
//! [visitor]

int main(int argc, char* argv[])
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/fandisk.off");
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(file, mesh)) {
    std::cerr << "cannot read " << file << '\n';
    return EXIT_FAILURE;
  }
  std::signal(SIGINT, [](int) { is_interrupted = true; });
  const CGAL::Bbox_3 box = PMP::bbox(mesh);
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());

  // what is kept: edges found by another package, and one vertex
  //! [features]
  const auto is_feature = mesh.add_property_map<Edge, bool>("e:is_feature", false).first;
  PMP::detect_sharp_edges(mesh, 40, is_feature);
  const auto is_fixed = mesh.add_property_map<Vertex, bool>("v:is_fixed", false).first;
  const Vertex load = *mesh.vertices().begin();
  const Point loaded_point = mesh.point(load);
  is_fixed[load] = true;
  //! [features]

  // what is asked for: small faces around that vertex, in a mesh of 8000 vertices
  const auto size = mesh.add_property_map<Vertex, double>("v:size").first;
  const auto temperature = mesh.add_property_map<Vertex, double>("v:temperature").first;
  for (const Vertex v : mesh.vertices()) {
    const double distance = std::sqrt(CGAL::squared_distance(mesh.point(v), loaded_point));
    size[v] = 0.002 * diagonal + 0.02 * distance;
    temperature[v] = std::exp(-distance / diagonal);
  }
  //! [field]
  SMA::Intersection_metric_field field(size); // of one field only: for the number of vertices and the gradation
  field.vertices = 8000;
  field.gradation = 1.3;
  //! [field]

  //! [parameters]
  Progress progress;
  const auto parameters = SMA::parameters::detect_features(false)
                            .edge_is_constrained_map(is_feature)
                            .vertex_is_constrained_map(is_fixed)
                            .vertex_attribute_maps(std::make_tuple(temperature))
                            .tolerance(0.005 * diagonal)
                            .visitor(std::ref(progress));
  //! [parameters]
  try {
    const SMA::Adaptation_report report = SMA::adapt_surface_mesh(mesh, field, parameters);
    std::cout << report.final.vertices << " vertices, at most " << report.certified_distance / diagonal
              << " diagonals from the input" << (report.stopped ? ", not finished\n" : "\n");
  } catch (const SMA::Tolerance_error& e) { // the mesh is as it was
    std::cerr << "no nearer than " << e.distance() << ": smaller sizes may help\n";
    return EXIT_FAILURE;
  } catch (const SMA::Invalid_input_error& e) {
    std::cerr << file << ", element " << e.index() << ": " << e.what() << '\n';
    return EXIT_FAILURE;
  }

  for (const Vertex v : mesh.vertices()) // the maps are those of the new mesh now
    if (is_fixed[v])
      std::cout << "the vertex that was fixed is at " << mesh.point(v) << ", of temperature " << temperature[v] << '\n';
  return CGAL::IO::write_polygon_mesh("features_and_attributes.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}

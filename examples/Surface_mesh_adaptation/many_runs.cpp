// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sphere that is refined and coarsened again and again: the normals and shape operators are estimated once, and carried
// by the vertices from run to run, so that it stays a sphere.

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/estimate_vertex_jets.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace SMA = CGAL::Surface_mesh_adaptation;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;

/// A triangulation of the unit sphere with edges of about .16.
Mesh sphere()
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(0, 0, 0));
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(3));
  for (const Vertex v : vertices(mesh)) {
    const Kernel::Vector_3 p = mesh.point(v) - CGAL::ORIGIN;
    mesh.point(v) = CGAL::ORIGIN + p / std::sqrt(p.squared_length());
  }
  return mesh;
}

double largest_distance_from_sphere(const Mesh& mesh)
{
  double largest = 0;
  for (const Vertex v : vertices(mesh))
    largest = std::max(largest, std::abs(std::sqrt((mesh.point(v) - CGAL::ORIGIN).squared_length()) - 1));
  return largest;
}

int main()
{
  Mesh mesh = sphere();
  const auto normals = mesh.add_property_map<Vertex, Kernel::Vector_3>("v:normal").first;
  const auto shape_operators = mesh.add_property_map<Vertex, SMA::Metric_tensor_3>("v:shape_operator").first;

  //! [runs]
  const auto parameters = SMA::parameters::vertex_normal_map(normals).vertex_shape_operator_map(shape_operators);
  SMA::estimate_vertex_jets(mesh, parameters); // once: from here on they are carried
  for (int cycle = 1; cycle <= 10; ++cycle) {
    for (const double length : {0.08, 0.16})
      SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(length), parameters);
    std::cout << "cycle " << cycle << ": " << largest_distance_from_sphere(mesh) << " off the sphere\n";
  }
  //! [runs]
  return 0;
}

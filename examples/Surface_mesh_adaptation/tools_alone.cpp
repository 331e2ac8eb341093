// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels are made of, without them: curvatures and second derivatives at the vertices, a smooth patch over a
// face, a step along the surface, and a colouring. In the end, a simplification within limits and its error.

#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/fields/hessian.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>
#include <CGAL/Surface_mesh_adaptation/surface/exponential_map.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_jets.h>
#include <CGAL/Surface_mesh_adaptation/tasks/graph_coloring.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace SMA = CGAL::Surface_mesh_adaptation;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

int main(int argc, char* argv[])
{
  const std::string file = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/bunny00.off");
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(file, mesh)) {
    std::cerr << "cannot read " << file << '\n';
    return EXIT_FAILURE;
  }

  // the mesh as arrays, its features, and a normal and a shape operator for each smooth sector of a vertex
  //! [import]
  const SMA::Default_parallel_execution execution;
  auto imported = SMA::read_face_graph(execution, mesh, get(CGAL::vertex_point, mesh));
  SMA::Mesh_view& view = imported.mesh;
  const std::vector<SMA::Vector_3>& points = imported.points;
  const SMA::Features features = SMA::detect_features(execution, view, points, SMA::Feature_parameters());
  const SMA::Corner_jets jets = SMA::estimate_jets(execution, view, points);
  //! [import]
  double largest_curvature = 0;
  for (const SMA::Metric_tensor_3& s : jets.shape_operators)
    largest_curvature = std::max(largest_curvature, SMA::eigen_decomposition(s).values.cwiseAbs().maxCoeff());
  std::cout << features.curves.size() << " feature curves, largest curvature " << largest_curvature << '\n';

  // second derivatives along the surface of a field at the vertices
  std::vector<double> height(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) height[v] = points[v].z();
  //! [hessians]
  const auto hessians = SMA::estimate_hessians(execution, view, points, jets, height);
  //! [hessians]
  std::cout << "at the first corner, the Hessian of z is\n" << hessians[jets.of_corner[0]].tensor.matrix() << '\n';

  // patches, and a step from a vertex into a direction of its tangent plane, which takes a tensor along
  const auto patch = [&](SMA::Index f) {
    SMA::Patch p;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = 3 * std::size_t(f) + i;
      p.points[i] = points[view.corner[corner]];
      p.normals[i] = jets.normals[jets.of_corner[corner]];
      p.shape_operators[i] = jets.shape_operators[jets.of_corner[corner]];
      p.has_shape_operator[i] = true;
    }
    return p;
  };
  const SMA::Vector_3 middle = (points[view.corner[0]] + points[view.corner[1]] + points[view.corner[2]]) / 3;
  //! [patch]
  const SMA::Surface_point above = SMA::Gregory_patch_3(patch(0)).evaluate(1.0 / 3, 1.0 / 3);
  //! [patch]
  std::cout << "the surface is " << (above.position - middle).norm() << " off the middle of the first face\n";

  //! [step]
  const SMA::One_ring ring = SMA::one_ring(view, 0, patch);
  const SMA::Vector_3 edge = points[view.target(0)] - points[view.source(0)];
  const SMA::Vector_3 step = 0.5 * (edge - edge.dot(ring.normal()) * ring.normal());
  const SMA::Exponential_map_result end = SMA::exponential_map(ring, step);
  const SMA::Matrix_3 turn = SMA::chord_rotation(ring.center(), ring.normal(), end.point.position, end.point.normal);
  const SMA::Metric_tensor_3 carried = SMA::rotated(jets.shape_operators[jets.of_corner[0]], turn);
  //! [step]
  std::cout << "half an edge away, in face " << end.face << ", the shape operator becomes\n" << carried.matrix() << '\n';

  // vertices that may be moved at the same time
  //! [coloring]
  const SMA::Graph_coloring coloring = SMA::graph_coloring(
    execution, points.size(), [&](std::size_t v, const auto& f) { view.for_each_neighbor(SMA::Index(v), f); });
  //! [coloring]
  std::cout << coloring.number_of_colors << " colours in " << coloring.rounds << " rounds\n";

  // as few faces as limits on their normals and distances allow; the size is no limit
  const SMA::Triangle_tree input(execution, view, points);
  const double length = input.extent();
  //! [simplify]
  const std::size_t removed = SMA::simplify(
    mesh, SMA::Uniform_metric_field(length),
    SMA::parameters::maximum_normal_deviation(15).maximum_distance(0.001 * length));
  //! [simplify]
  const auto output = SMA::read_face_graph(execution, mesh, get(CGAL::vertex_point, mesh));
  const double distance = SMA::hausdorff_distance_bound(
    execution, input, SMA::Triangle_tree(execution, output.mesh, output.points), 1e-5 * length);
  std::cout << removed << " vertices removed, the distance is at most " << distance / length << " of the size\n";
  return CGAL::IO::write_polygon_mesh("tools_alone.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}

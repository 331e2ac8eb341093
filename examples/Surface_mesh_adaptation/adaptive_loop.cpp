// SPDX-License-Identifier: GPL-3.0-or-later
//
// An adaptive loop: a front that moves over a surface, on a mesh that moves with it. Solve, adapt to the solution,
// carry the solution over, and so on.
//
//     adaptive_loop [INPUT [VERTICES [STEPS [OUTPUT.ply]]]]
//
// The equation is that of Allen and Cahn, u_t = eps Laplace(u) + (u - u^3) / eps: it keeps u at 1 and -1, with steep
// fronts of width eps between, which move to shorten themselves. Linear finite elements with lumped mass, diffusion
// implicit and reaction explicit.

#include <CGAL/surface_mesh_adaptation.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace params = SMA::parameters;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;
using Values = Mesh::Property_map<Vertex, double>;

/// Stiffness matrix and lumped masses of linear finite elements on a mesh.
struct Finite_elements
{
  Eigen::SparseMatrix<double> stiffness;
  Eigen::VectorXd mass;

  explicit Finite_elements(const Mesh& mesh) : mass(Eigen::VectorXd::Zero(Eigen::Index(mesh.number_of_vertices())))
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto f : mesh.faces()) {
      auto h = mesh.halfedge(f);
      for (int i = 0; i < 3; ++i, h = mesh.next(h)) {
        const Vertex a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h));
        const auto u = mesh.point(a) - mesh.point(c), v = mesh.point(b) - mesh.point(c);
        const double double_area = std::sqrt(CGAL::cross_product(u, v).squared_length());
        const double w = CGAL::scalar_product(u, v) / double_area / 2; // half the cotangent of the angle at c
        const int i_a = int(a.idx()), i_b = int(b.idx());
        entries.insert(entries.end(), {{i_a, i_a, w}, {i_b, i_b, w}, {i_a, i_b, -w}, {i_b, i_a, -w}});
        mass[int(c.idx())] += double_area / 6;
      }
    }
    stiffness.resize(mass.size(), mass.size());
    stiffness.setFromTriplets(entries.begin(), entries.end());
  }
};

/// A few steps in time on one mesh.
void solve(const Mesh& mesh, Values u, double eps, double time_step, int steps)
{
  const Finite_elements elements(mesh);
  Eigen::SparseMatrix<double> matrix = eps * time_step * elements.stiffness;
  matrix += Eigen::SparseMatrix<double>(elements.mass.asDiagonal());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  Eigen::VectorXd x(elements.mass.size());
  for (const Vertex v : mesh.vertices()) x[int(v.idx())] = u[v];
  for (int i = 0; i < steps; ++i) {
    const Eigen::VectorXd reaction = (x.array() - x.array().cube()) / eps;
    const Eigen::VectorXd right_hand_side = elements.mass.cwiseProduct(x + time_step * reaction);
    x = solver.solve(right_hand_side); // which must not be an expression of x: that is written meanwhile
  }
  for (const Vertex v : mesh.vertices()) u[v] = x[int(v.idx())];
}

//! [adapt]
/// Adapts the mesh to `u`, whose values are those at the new vertices afterwards, and to the surface.
SMA::Adaptation_report adapt(Mesh& mesh, Values u, std::size_t vertices)
{
  SMA::Solution_metric_field solution(u, vertices);
  SMA::Curvature_metric_field surface(0.005);
  solution.anisotropic = surface.anisotropic = true;
  SMA::Intersection_metric_field field(solution, surface);
  field.vertices = vertices;
  return SMA::adapt_surface_mesh(mesh, field, params::vertex_attribute_maps(std::make_tuple(u)));
}
//! [adapt]

int main(int argc, char* argv[])
{
  const std::string input = argc > 1 ? argv[1] : CGAL::data_file_path("meshes/elephant.off");
  const std::size_t vertices = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 10000;
  const int steps = argc > 3 ? std::atoi(argv[3]) : 6;
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(input, mesh)) return 1;

  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  const double size = box.x_span() + box.y_span() + box.z_span(), eps = 0.004 * size, middle = (box.ymin() + box.ymax()) / 2;
  Values u = mesh.add_property_map<Vertex, double>("v:u").first;
  const auto front = [&](Vertex v) { return std::tanh((mesh.point(v).y() - middle) / (std::sqrt(2.0) * eps)); };
  for (int i = 0; i < 3; ++i) { // the front is not resolved on the first meshes
    for (const Vertex v : mesh.vertices()) u[v] = front(v);
    adapt(mesh, u, vertices);
  }
  for (const Vertex v : mesh.vertices()) u[v] = front(v);

  for (int step = 1; step <= steps; ++step) {
    solve(mesh, u, eps, 0.2 * eps, 50);
    const SMA::Adaptation_report report = adapt(mesh, u, vertices);
    double mean = 0, mass = 0, least = 0, largest = 0;
    const Finite_elements elements(mesh);
    for (const Vertex v : mesh.vertices()) {
      mean += elements.mass[int(v.idx())] * u[v];
      mass += elements.mass[int(v.idx())];
      least = (std::min)(least, u[v]);
      largest = (std::max)(largest, u[v]);
    }
    const SMA::Mesh_statistics& s = report.final;
    std::printf("step %d: %zu vertices, %.1f %% of the edges in range, quality %.3f, u from %.3f to %.3f, mean %.4f\n",
                step, s.vertices, 100 * s.in_range, s.mean_quality, least, largest, mean / mass);
  }
  if (argc > 4) {
    std::ofstream out(argv[4]);
    if (!CGAL::IO::write_PLY(out, mesh)) return 1;
  }
  return 0;
}

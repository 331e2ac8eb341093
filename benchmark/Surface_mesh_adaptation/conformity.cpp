// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well adapted meshes fit the tensors that they are adapted to, from a uniform mesh: fields of the Unstructured Grid
// Adaptation Working Group on the unit square and on the surfaces of a cube and a ball in space.
//
// The fields, for a smallest size h0 (.001 in the benchmark) and a largest of .1 (D. Ibanez et al., First benchmark of
// the Unstructured Grid Adaptation Working Group, 2017; cube and cube-cylinder of the repository UGAWG/adapt-benchmarks):
//
//     linear    .1 along x and z, h0 + 2 (.1 - h0) |y - .5| along y
//     polar-1   h0 + 2 (.1 - h0) |r - .5| along the radius r = |(x, y)|, .1 around the origin and along z
//     polar-2   as polar-1, but .025 d + .1 (1 - d) around the origin where d = 1 - 10 |r - .5| is positive
//
// where the benchmark, whose domain is r >= .5, has d = 10 (.6 - r). All sizes can be divided by a number, so that the
// meshes are finer in all directions.

#include "../../test/Surface_mesh_adaptation/shape_meshes.h"
#include "../../test/Surface_mesh_adaptation/shapes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using SMA::Metric_tensor_3;
using SMA::Vector_3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr double largest_size = 0.1;

/// Grows from h0 at distance 0 to the largest size at distance 1/2.
double layer_size(double h0, double distance) { return h0 + 2 * (largest_size - h0) * std::abs(distance); }

Metric_tensor_3 tensor(const Vector_3& sizes, const SMA::Matrix_3& axes)
{
  return SMA::metric_tensor(sizes.cwiseAbs2().cwiseInverse(), axes);
}

Metric_tensor_3 linear(double h0, const Vector_3& p)
{
  return tensor(Vector_3(largest_size, layer_size(h0, p[1] - 0.5), largest_size), SMA::Matrix_3::Identity());
}

Metric_tensor_3 polar(double h0, double size_around, const Vector_3& p)
{
  const double angle = std::atan2(p[1], p[0]);
  const SMA::Matrix_3 axes = Eigen::AngleAxisd(angle, Vector_3::UnitZ()).toRotationMatrix();
  return tensor(Vector_3(layer_size(h0, std::hypot(p[0], p[1]) - 0.5), size_around, largest_size), axes);
}

Metric_tensor_3 polar_1(double h0, const Vector_3& p) { return polar(h0, largest_size, p); }

Metric_tensor_3 polar_2(double h0, const Vector_3& p)
{
  const double d = (std::max)(0.0, 1 - 10 * std::abs(std::hypot(p[0], p[1]) - 0.5));
  return polar(h0, d / 40 + (1 - d) * largest_size, p);
}

struct Domain
{
  std::string name;
  shapes::Soup mesh;
  std::function<Vector_3(const Vector_3&)> normal; ///< of the surface near a point
};

/// The side of the unit cube that a point is on, or nearest to.
Vector_3 normal_of_cube(const Vector_3& p)
{
  const Vector_3 q = p - Vector_3::Constant(0.5);
  Eigen::Index side;
  q.cwiseAbs().maxCoeff(&side);
  Vector_3 n = Vector_3::Zero();
  n[side] = q[side] > 0 ? 1 : -1;
  return n;
}

std::vector<Domain> domains()
{
  const auto in_unit_cube = [](shapes::Soup soup) {
    for (Vector_3& p : soup.points) p = (p + Vector_3::Ones()) / 2;
    return soup;
  };
  return {{"square", shapes::square(30, 0.3), [](const Vector_3&) { return Vector_3(0, 0, 1); }},
          {"cube", in_unit_cube(shapes::cube(20)), normal_of_cube},
          {"ball", in_unit_cube(shapes::sphere(4, 0.3)),
           [](const Vector_3& p) { return Vector_3(p - Vector_3::Constant(0.5)); }}};
}

/// Faces that do not point outwards; on the square this is exact, and none means that the mesh is a triangulation.
std::size_t inverted_faces(const Domain& domain, const Mesh& mesh)
{
  std::size_t inverted = 0;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
               &c = mesh.point(mesh.target(mesh.next(h)));
    const Vector_3 n = domain.normal(Vector_3(a.x() + b.x() + c.x(), a.y() + b.y() + c.y(), a.z() + b.z() + c.z()) / 3);
    const Kernel::Point_3 above = a + Kernel::Vector_3(n[0], n[1], n[2]);
    if (CGAL::orientation(a, b, c, above) != CGAL::POSITIVE) ++inverted;
  }
  return inverted;
}

template <class Field>
void print_row(const Domain& domain, const std::string& name, double h0, double finer, const Field& field)
{
  Mesh mesh = shapes::mesh<Mesh>(domain.mesh);
  const SMA::Analytic_metric_field metric([&](const Vector_3& p) { return (finer * finer) * field(h0, p); });
  const SMA::Mesh_statistics s = SMA::adapt_surface_mesh(mesh, metric).final;
  std::printf("| %s, %s | %.0f | %.0f | %zu | %.1f %% | %.3f | %.3f | %zu | %.2g |\n", domain.name.c_str(),
              name.c_str(), largest_size / h0, finer, s.vertices, 100 * s.in_range, s.mean_quality, s.min_quality,
              inverted_faces(domain, mesh), s.min_angle);
  std::fflush(stdout);
}

} // namespace

int main()
{
  std::printf("| case | anisotropy | sizes over | vertices | in range | mean quality | worst | inverted | smallest angle |\n"
              "|---|---|---|---|---|---|---|---|---|\n");
  for (const Domain& domain : domains())
    for (const double h0 : {0.001, 0.0001})
      for (const double finer : {1.0, 4.0}) {
        print_row(domain, "linear", h0, finer, linear);
        print_row(domain, "polar-1", h0, finer, polar_1);
        print_row(domain, "polar-2", h0, finer, polar_2);
      }
  return 0;
}

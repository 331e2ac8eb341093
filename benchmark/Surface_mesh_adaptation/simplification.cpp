// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance between meshes and what is left of them after simplification, within limits on the normals and on the
// distance and without swaps, and at the same number of vertices by CGAL's quadric errors (M. Garland, P. Heckbert,
// Surface simplification using quadric error metrics, 1997) with their own placement. The output is a table in Markdown:
// largest and rms distance, sampled in both directions, in thousandths of the diagonal of the bounding box; and the
// processor time for each vertex of the input.

#include "../../test/Surface_mesh_adaptation/distances.h"
#include "../../test/Surface_mesh_adaptation/shape_meshes.h"
#include "../../test/Surface_mesh_adaptation/shapes.h"
#include "common.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using bench::Mesh;
using bench::SMA::Vector_3;

constexpr double samples = 200000; // of each mesh

struct Case
{
  std::string name;
  Mesh mesh;
  double degrees;
  double distance; ///< limit, in thousandths of the diagonal; 1000: none
};

Mesh ellipsoid()
{
  shapes::Soup soup = shapes::sphere(5, 0.3);
  for (Vector_3& p : soup.points) p = p.cwiseProduct(Vector_3(1, 0.7, 0.5));
  return shapes::mesh<Mesh>(soup);
}

std::vector<Case> cases()
{
  const Mesh sphere = shapes::mesh<Mesh>(shapes::sphere(5, 0.3)), torus = shapes::mesh<Mesh>(shapes::torus(170, 60, 0.3));
  std::vector<Case> list;
  for (const double distance : {0.5, 1000.0}) {
    list.push_back({"sphere", sphere, 10, distance});
    list.push_back({"ellipsoid", ellipsoid(), 10, distance});
    list.push_back({"torus", torus, 10, distance});
  }
  const auto add = [&](const std::string& name, double degrees, std::initializer_list<double> limits) {
    for (const double distance : limits) list.push_back({name, bench::read_mesh(name), degrees, distance});
  };
  add("bunny00", 10, {0.3, 1000});
  add("bunny00", 60, {1, 3});
  add("elephant", 10, {1000});
  add("elephant", 60, {3, 6});
  add("fandisk", 10, {0.3, 1000});
  add("anchor_dense", 10, {1, 1000});
  add("rotor_small", 10, {1, 1000});
  add("couplingdown", 10, {1000});
  add("couplingdown", 60, {3, 6});
  return list;
}

void print(const distances::Distance& d, double diagonal)
{
  std::printf(" %.3f, %.4f |", 1e3 * d.largest / diagonal, 1e3 * d.rms / diagonal);
  std::fflush(stdout);
}

template <class Quadrics>
void print_quadric_errors(const distances::Original& original, const Mesh& mesh, std::size_t vertices)
{
  print(original.distance_to(distances::simplified<Quadrics>(mesh, vertices), samples), original.diagonal());
}

void print_row(const Case& c)
{
  namespace params = bench::SMA::parameters;
  const distances::Original original(c.mesh);
  const double diagonal = original.diagonal();
  Mesh ours = c.mesh;
  const double start = bench::processor_seconds();
  // distances are to the triangles of the input, so these are the surface; no size: the limits decide
  bench::SMA::simplify(ours, bench::SMA::Uniform_metric_field(1e3 * diagonal),
                       params::maximum_normal_deviation(c.degrees)
                         .maximum_distance(1e-3 * c.distance * diagonal)
                         .surface_reconstruction(bench::SMA::Flat_reconstruction()));
  const double microseconds = 1e6 * (bench::processor_seconds() - start) / double(num_vertices(c.mesh));
  const std::string distance = c.distance < 1000 ? std::to_string(c.distance).substr(0, 3) : "none";
  std::printf("| %s, %.0f, %s | %zu | %zu | %.0f |", c.name.c_str(), c.degrees, distance.c_str(),
              std::size_t(num_vertices(c.mesh)), std::size_t(num_vertices(ours)), microseconds);
  print(original.distance_to(ours, samples), diagonal);
  print_quadric_errors<distances::Plane_quadrics>(original, c.mesh, num_vertices(ours));
  print_quadric_errors<distances::Triangle_quadrics>(original, c.mesh, num_vertices(ours));
  print_quadric_errors<distances::Probabilistic_quadrics>(original, c.mesh, num_vertices(ours));
  std::printf("\n");
}

} // namespace

int main()
{
  std::printf("| mesh, degrees, distance | vertices | left | us | `simplify` | plane quadrics | triangle quadrics "
              "| probabilistic |\n|---|---|---|---|---|---|---|---|\n");
  for (const Case& c : cases()) print_row(c);
  return 0;
}

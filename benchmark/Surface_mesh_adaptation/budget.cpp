// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far numbers of vertices are missed, in percent, for ratios of the number asked for to that of the input: sizes
// from the curvature on a sphere, a torus and a mechanical part, and from a field with a shock on the unit square. Each
// as it is, with bounds of .6 and 1.6 times the edges of a mesh of so many equilateral faces, without gradation, and
// from a mesh that is adapted already. Then, over all ratios, the least share of edges in range, the least mean quality
// and the most rounds.

#include "../../test/Surface_mesh_adaptation/analytic_fields.h"
#include "../../test/Surface_mesh_adaptation/shape_meshes.h"
#include "../../test/Surface_mesh_adaptation/shapes.h"
#include "common.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

using bench::Mesh;
namespace SMA = bench::SMA;

constexpr double ratios[] = {0.1, 0.3, 1, 1.2, 3, 10};

struct Request
{
  std::size_t vertices;
  bool anisotropic;
  double hmin = 0, hmax = 0;
  double gradation = SMA::default_gradation;

  template <class Field>
  SMA::Adaptation_report adapt(Mesh& mesh, Field field) const
  {
    field.vertices = vertices;
    field.anisotropic = anisotropic;
    field.hmin = hmin;
    field.hmax = hmax;
    field.gradation = gradation;
    return SMA::adapt_surface_mesh(mesh, field);
  }
};

struct Case
{
  std::string name;
  Mesh mesh;
  std::function<SMA::Adaptation_report(Mesh&, const Request&)> adapt;
};

SMA::Adaptation_report adapt_to_curvature(Mesh& mesh, const Request& request)
{
  return request.adapt(mesh, SMA::Curvature_metric_field(1));
}

SMA::Adaptation_report adapt_to_front(Mesh& mesh, const Request& request)
{
  const auto u = mesh.add_property_map<Mesh::Vertex_index, double>("v:u").first;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    u[v] = analytic::front(SMA::Vector_3(p.x(), p.y(), p.z()));
  }
  return request.adapt(mesh, SMA::Solution_metric_field(u, request.vertices));
}

std::vector<Case> cases()
{
  return {{"sphere", shapes::mesh<Mesh>(shapes::sphere(4, 0.3)), adapt_to_curvature},
          {"torus", shapes::mesh<Mesh>(shapes::torus(84, 30, 0.3)), adapt_to_curvature},
          {"anchor_dense", bench::read_mesh("anchor_dense"), adapt_to_curvature},
          {"square with a shock", shapes::mesh<Mesh>(shapes::square(50, 0.3)), adapt_to_front}};
}

/// The edges of equilateral triangles with `n` vertices on the area of `mesh`.
double mean_size(const Mesh& mesh, double n)
{
  double area = 0;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    area += std::sqrt(CGAL::squared_area(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                         mesh.point(mesh.target(mesh.next(h)))));
  }
  return std::sqrt(2 * area / (std::sqrt(3.0) * n));
}

/// `change(request, mesh)` may change what is asked for, and adapt the mesh beforehand.
template <class Change>
void print_row(const Case& c, const std::string& variant, bool anisotropic, const Change& change)
{
  std::printf("| %s, %s%s |", c.name.c_str(), anisotropic ? "anisotropic" : "isotropic", variant.c_str());
  double in_range = 1, quality = 1;
  std::size_t rounds = 0;
  for (const double ratio : ratios) {
    Mesh mesh = c.mesh;
    Request request{std::size_t(ratio * double(mesh.number_of_vertices())), anisotropic};
    change(request, mesh);
    const SMA::Adaptation_report r = c.adapt(mesh, request);
    std::printf(" %+.1f |", 100 * (double(r.final.vertices) / double(request.vertices) - 1));
    in_range = (std::min)(in_range, r.final.in_range);
    quality = (std::min)(quality, r.final.mean_quality);
    rounds = (std::max)(rounds, r.rounds);
  }
  std::printf(" %.1f %% | %.3f | %zu |\n", 100 * in_range, quality, rounds);
  std::fflush(stdout);
}

void print_rows(const Case& c, bool anisotropic)
{
  print_row(c, "", anisotropic, [](Request&, Mesh&) {});
  print_row(c, ", with bounds", anisotropic, [](Request& r, Mesh& mesh) {
    const double size = mean_size(mesh, double(r.vertices));
    r.hmin = 0.6 * size;
    r.hmax = 1.6 * size;
  });
  print_row(c, ", without gradation", anisotropic, [](Request& r, Mesh&) { r.gradation = 1; });
  print_row(c, ", adapted before", anisotropic, [&](Request&, Mesh& mesh) {
    c.adapt(mesh, {mesh.number_of_vertices(), anisotropic});
  });
}

} // namespace

int main()
{
  std::printf("| case |");
  for (const double ratio : ratios) std::printf(" %g |", ratio);
  std::printf(" in range | mean quality | rounds |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Case& c : cases())
    for (const bool anisotropic : {false, true}) print_rows(c, anisotropic);
  return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conformity and quality of the adapted meshes of CGAL's data, as a table: edges of half the mean length of the input,
// and sizes from the curvature for a thousandth of the diagonal, isotropic and anisotropic. Of the uniform mesh also
// without the edges that lead from one feature curve to another and the faces with all corners on such curves: these
// are as long and as wide as the surface has room there, whatever the size.
//
//     quality [--gradation RATIO] [MESH...]

#include "common.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using bench::Mesh;
using bench::Point;
namespace SMA = bench::SMA;

template <class Field>
SMA::Mesh_statistics adapt(Mesh mesh, const Field& field)
{
  return SMA::adapt_surface_mesh(mesh, field).final;
}

void print(const SMA::Mesh_statistics& s)
{
  std::printf(" %zu | %.2f | %.3f | %.3f |", std::size_t(s.vertices), 100 * s.in_range, s.mean_quality, s.min_quality);
}

SMA::Vector_3 from_to(const Point& p, const Point& q) { return {q.x() - p.x(), q.y() - p.y(), q.z() - p.z()}; }

/// How many per cent are in range of the edges on curves or with an end off them, and the mean quality of the faces
/// with a corner off them.
void print_away_from_curves(const Mesh& mesh, Mesh::Property_map<Mesh::Edge_index, bool> is_curve_edge, double size)
{
  std::vector<char> is_curve_vertex(mesh.num_vertices(), 0);
  for (const auto e : mesh.edges())
    if (is_curve_edge[e]) is_curve_vertex[mesh.vertex(e, 0)] = is_curve_vertex[mesh.vertex(e, 1)] = 1;

  const SMA::Isotropic_metric metric{1 / size};
  std::size_t edges = 0, in_range = 0, faces = 0;
  for (const auto e : mesh.edges()) {
    const auto p = mesh.vertex(e, 0), q = mesh.vertex(e, 1);
    if (is_curve_vertex[p] && is_curve_vertex[q] && !is_curve_edge[e]) continue;
    const double length = metric.length(from_to(mesh.point(p), mesh.point(q)));
    ++edges;
    in_range += length >= SMA::min_unit_length && length <= SMA::max_unit_length;
  }
  double quality = 0;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto p = mesh.source(h), q = mesh.target(h), r = mesh.target(mesh.next(h));
    if (is_curve_vertex[p] && is_curve_vertex[q] && is_curve_vertex[r]) continue;
    ++faces;
    quality += SMA::face_quality(metric, metric, metric, from_to(mesh.point(p), mesh.point(q)),
                                 from_to(mesh.point(p), mesh.point(r)));
  }
  std::printf(" %.2f | %.3f |", 100 * double(in_range) / double(edges), quality / double(faces));
}

void print_uniform(Mesh mesh)
{
  const double size = 0.5 * bench::mean_edge_length(mesh);
  const auto is_curve_edge = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_curve", false).first;
  const SMA::Mesh_statistics s = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size),
                                                         SMA::parameters::edge_is_constrained_map(is_curve_edge))
                                   .final;
  print(s);
  std::printf(" %.1f |", s.min_angle);
  print_away_from_curves(mesh, is_curve_edge, size);
}

void print_row(const std::string& name, double gradation)
{
  const Mesh mesh = bench::read_mesh(name);
  std::printf("| %s |", name.c_str());
  print_uniform(mesh);
  SMA::Curvature_metric_field curvature(0.001);
  curvature.gradation = gradation;
  print(adapt(mesh, curvature));
  curvature.anisotropic = true;
  print(adapt(mesh, curvature));
  std::printf("\n");
}

} // namespace

int main(int argc, char* argv[])
{
  const bool is_given = argc > 2 && std::string(argv[1]) == "--gradation";
  const double gradation = is_given ? std::stod(argv[2]) : SMA::default_gradation;
  std::vector<std::string> names(argv + (is_given ? 3 : 1), argv + argc);
  if (names.empty())
    names = {"elephant", "bunny00", "armadillo", "camel", "knot2", "fandisk", "anchor_dense", "couplingdown",
             "rotor_small", "turbine", "blade", "lion-head", "mannequin-devil"};
  std::printf("| mesh | uniform: vertices | in range [%%] | mean | worst | smallest angle "
              "| away from curves: in range | mean "
              "| curvature: vertices | in range | mean | worst | anisotropic: vertices | in range | mean | worst |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : names) print_row(name, gradation);
  return 0;
}

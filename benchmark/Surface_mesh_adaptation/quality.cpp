// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conformity and quality of the adapted meshes of CGAL's data, as a table: edges of half the mean length of the input,
// and sizes from the curvature for a thousandth of the diagonal, isotropic and anisotropic. Of the uniform mesh also
// without the edges that lead from one feature curve to another and the faces with all corners on such curves: these
// are as long and as wide as the surface has room there, whatever the size.
//
//     quality [--gradation RATIO] [--feature-angle DEGREES] [MESH...]

#include "common.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using bench::Mesh;
using bench::Point;
namespace SMA = bench::SMA;

struct Options
{
  double gradation = SMA::Curvature_metric_field(1).gradation;
  double feature_angle = SMA::Feature_parameters().ridge_angle;
};

template <class Field>
SMA::Mesh_statistics adapt(Mesh mesh, const Field& field, const Options& options)
{
  return SMA::adapt_surface_mesh(mesh, field, SMA::parameters::feature_angle(options.feature_angle)).final;
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

void print_uniform(Mesh mesh, const Options& options)
{
  const double size = 0.5 * bench::mean_edge_length(mesh);
  const auto is_curve_edge = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_curve", false).first;
  const auto parameters =
    SMA::parameters::edge_is_constrained_map(is_curve_edge).feature_angle(options.feature_angle);
  const SMA::Mesh_statistics s = SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size), parameters).final;
  print(s);
  std::printf(" %.1f |", s.min_angle);
  print_away_from_curves(mesh, is_curve_edge, size);
}

void print_row(const std::string& name, const Options& options)
{
  const Mesh mesh = bench::read_mesh(name);
  std::printf("| %s |", name.c_str());
  print_uniform(mesh, options);
  SMA::Curvature_metric_field curvature(0.001);
  curvature.gradation = options.gradation;
  print(adapt(mesh, curvature, options));
  curvature.anisotropic = true;
  print(adapt(mesh, curvature, options));
  std::printf("\n");
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--gradation" && i + 1 < argc) options.gradation = std::stod(argv[++i]);
    else if (word == "--feature-angle" && i + 1 < argc) options.feature_angle = std::stod(argv[++i]);
    else names.push_back(word);
  }
  if (names.empty())
    names = {"elephant", "bunny00", "armadillo", "camel", "knot2", "fandisk", "anchor_dense", "couplingdown",
             "rotor_small", "turbine", "blade", "lion-head", "mannequin-devil"};
  std::printf("| mesh | uniform: vertices | in range [%%] | mean | worst | smallest angle "
              "| away from curves: in range | mean "
              "| curvature: vertices | in range | mean | worst | anisotropic: vertices | in range | mean | worst |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : names) print_row(name, options);
  return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conformity and quality of the adapted meshes of CGAL's data, as a table: edges of half the mean length of the input,
// and sizes from the curvature for a thousandth of the diagonal, isotropic and anisotropic.
//
//     quality [--gradation RATIO] [MESH...]

#include "common.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using bench::Mesh;
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

void print_row(const std::string& name, double gradation)
{
  const Mesh mesh = bench::read_mesh(name);
  std::printf("| %s |", name.c_str());
  const SMA::Mesh_statistics uniform = adapt(mesh, SMA::Uniform_metric_field(0.5 * bench::mean_edge_length(mesh)));
  print(uniform);
  std::printf(" %.1f |", uniform.min_angle);
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
              "| curvature: vertices | in range | mean | worst | anisotropic: vertices | in range | mean | worst |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : names) print_row(name, gradation);
  return 0;
}

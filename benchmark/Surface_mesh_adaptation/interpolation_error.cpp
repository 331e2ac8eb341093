// SPDX-License-Identifier: GPL-3.0-or-later
//
// The error of the linear interpolation of scalar fields on meshes that are adapted to them, isotropic and anisotropic,
// and on uniform meshes, for N, 4 N, 16 N and 64 N vertices. As where the field is the solution of an equation, a mesh is
// adapted to samples of the field at its own vertices, several times at each N; each N starts from the last mesh of the
// one before. Orders are in the edge length: 2 where the error falls like 1 / N. The output is a table in Markdown, from
// which `scripts/plot_interpolation_error` draws.
//
//     interpolation_error [N = 2000 [SURFACE]]

#include "../../test/Surface_mesh_adaptation/analytic_fields.h"
#include "../../test/Surface_mesh_adaptation/interpolation_error.h"
#include "../../test/Surface_mesh_adaptation/shape_meshes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using analytic::Interpolation_error;
using SMA::Vector_3;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Scalar_map = Mesh::Property_map<Mesh::Vertex_index, double>;
using Field = std::function<double(const Vector_3&)>;

constexpr int levels = 4, adaptations = 4; // of N, at each N

struct Surface
{
  std::string name;
  double area;
  shapes::Soup mesh;                                     ///< a uniform one of about 2500 vertices
  std::function<Vector_3(const Vector_3&)> closest_point;
};

std::vector<Surface> surfaces()
{
  const double large = shapes::torus_large_radius, small = shapes::torus_small_radius;
  return {{"square", 1, shapes::square(50, 0.3), [](const Vector_3& p) { return p; }},
          {"sphere", 4 * shapes::pi, shapes::sphere(4, 0.3), [](const Vector_3& p) { return Vector_3(p.normalized()); }},
          {"torus", 4 * shapes::pi * shapes::pi * large * small, shapes::torus(84, 30, 0.2), [=](const Vector_3& p) {
             const Vector_3 center = large * Vector_3(p[0], p[1], 0).normalized();
             return Vector_3(center + small * (p - center).normalized());
           }}};
}

SMA::Adaptation_report adapt_to_samples(Mesh& mesh, const Field& u, std::size_t vertices, bool anisotropic)
{
  const Scalar_map values = mesh.add_property_map<Mesh::Vertex_index, double>("v:u").first;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    values[v] = u(Vector_3(p.x(), p.y(), p.z()));
  }
  SMA::Solution_metric_field<Scalar_map> field(values, vertices);
  field.gradation = 2.5; // the error asks for sizes that grow fast beside fronts
  field.anisotropic = anisotropic;
  return SMA::adapt_surface_mesh(mesh, field);
}

/// The edges of equilateral triangles, `2 vertices` of them on the area.
SMA::Adaptation_report make_uniform(Mesh& mesh, double area, std::size_t vertices)
{
  const double size = std::sqrt(2 * area / (std::sqrt(3.0) * double(vertices)));
  return SMA::adapt_surface_mesh(mesh, SMA::Uniform_metric_field(size));
}

double order(double coarse_error, double fine_error, double coarse_vertices, double fine_vertices)
{
  return 2 * std::log(coarse_error / fine_error) / std::log(fine_vertices / coarse_vertices);
}

/// Prints the rows of one way to adapt and returns their errors. `adapt(mesh, vertices)` returns a report.
template <class Adapt>
std::vector<Interpolation_error> print_rows(const std::string& name, const Surface& surface, const Field& u,
                                            std::size_t vertices, const Adapt& adapt)
{
  Mesh mesh = shapes::mesh<Mesh>(surface.mesh);
  std::vector<Interpolation_error> errors;
  double vertices_before = 0;
  for (int level = 0; level < levels; ++level, vertices *= 4) {
    const SMA::Mesh_statistics s = adapt(mesh, vertices).final;
    const Interpolation_error e = analytic::interpolation_error(shapes::soup(mesh), u);
    std::printf("| %s | %zu | %zu | %.2e |", name.c_str(), vertices, s.vertices, e.l1);
    if (level > 0) std::printf(" %.2f", order(errors.back().l1, e.l1, vertices_before, double(s.vertices)));
    std::printf(" | %.2e |", e.l2);
    if (level > 0) std::printf(" %.2f", order(errors.back().l2, e.l2, vertices_before, double(s.vertices)));
    std::printf(" | %.1f %% | %.3f | %.3f |\n", 100 * s.in_range, s.mean_quality, s.min_quality);
    std::fflush(stdout);
    errors.push_back(e);
    vertices_before = double(s.vertices);
  }
  return errors;
}

void print_table(const Surface& surface, const std::string& field_name, const Field& in_space, std::size_t vertices)
{
  const Field u = [&](const Vector_3& p) { return in_space(surface.closest_point(p)); };
  const std::string name = surface.name + ", " + field_name + ", ";
  std::printf("| case | N asked | vertices | L1 error | order | L2 error | order | in range | mean quality | worst |\n"
              "|---|---|---|---|---|---|---|---|---|---|\n");
  print_rows(name + "uniform", surface, u, vertices, [&](Mesh& mesh, std::size_t n) {
    return make_uniform(mesh, surface.area, n);
  });
  const auto loop = [&](bool anisotropic) {
    return print_rows(name + (anisotropic ? "anisotropic" : "isotropic"), surface, u, vertices,
                      [&](Mesh& mesh, std::size_t n) {
                        for (int i = 1; i < adaptations; ++i) adapt_to_samples(mesh, u, n, anisotropic);
                        return adapt_to_samples(mesh, u, n, anisotropic);
                      });
  };
  const auto isotropic = loop(false), anisotropic = loop(true);
  std::printf("\nIsotropic over anisotropic error, L1 and L2:");
  for (std::size_t i = 0; i < isotropic.size(); ++i)
    std::printf(" %.1f %.1f%s", isotropic[i].l1 / anisotropic[i].l1, isotropic[i].l2 / anisotropic[i].l2,
                i + 1 < isotropic.size() ? ";" : "\n\n");
}

} // namespace

int main(int argc, char** argv)
{
  const std::size_t vertices = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 2000;
  for (const Surface& surface : surfaces()) {
    if (argc > 2 && surface.name != argv[2]) continue;
    print_table(surface, "front", analytic::front, vertices);
    print_table(surface, "several scales", analytic::several_scales, vertices);
    print_table(surface, "fronts and waves", analytic::fronts_and_waves, vertices);
  }
  return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs that make faces intersect, without and with `avoid_self_intersections`, and what that costs, on random sheets near
// each other and on meshes of files that do not intersect themselves:
//
//     self_intersections SHAPES [FILE.off]... [--output FOLDER]
//
// SHAPES is the number of random shapes. Each mesh is adapted in eight modes. The output is a table in Markdown: a row for
// each mode over the shapes, then over the files. With --output the input and, for two modes, the outputs without and with
// are written there, and that of CGAL's `isotropic_remeshing`, for scripts/compare_tetgen.

#include "../../test/Surface_mesh_adaptation/near_sheets.h"
#include "../../test/Surface_mesh_adaptation/shape_meshes.h"
#include "common.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace {

namespace SMA = bench::SMA;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = SMA::parameters;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
using Field = std::variant<SMA::Uniform_metric_field, SMA::Curvature_metric_field>;

constexpr std::size_t largest_file = 60000; // faces

std::size_t number_of_pairs(const Mesh& mesh)
{
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

double mean_edge_length(const Mesh& mesh)
{
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / double(mesh.number_of_edges());
}

struct Mode
{
  std::string name;
  double sizes;     ///< in mean edges; 0: from the curvature
  double tolerance; ///< of that; 0: a tenth of the vertices
  bool anisotropic;
  const char* file; ///< of the outputs, if they are written

  Field field(const Mesh& mesh) const
  {
    if (sizes > 0) return SMA::Uniform_metric_field(sizes * mean_edge_length(mesh));
    SMA::Curvature_metric_field field(tolerance > 0 ? tolerance : 0.001);
    if (tolerance == 0) field.vertices = (std::max)(std::size_t(20), std::size_t(mesh.number_of_vertices()) / 10);
    field.anisotropic = anisotropic;
    return field;
  }
};

const std::vector<Mode> modes{
  {"1 mean edge", 1, 0, false, nullptr},       {"2 mean edges", 2, 0, false, "2"},
  {"4 mean edges", 4, 0, false, "4"},          {"8 mean edges", 8, 0, false, nullptr},
  {"curvature .005", 0, 0.005, false, nullptr}, {"curvature .05", 0, 0.05, false, nullptr},
  {"anisotropic .005", 0, 0.005, true, nullptr}, {"a tenth of the vertices", 0, 0, false, nullptr}};

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

/// What came of one mode.
class Row
{
public:
  void run(const Mode& mode, const Mesh& input, const std::string& folder, const std::string& name)
  {
    const Field field = mode.field(input);
    const Outcome plain = adapted(input, field, false), with = adapted(input, field, true);
    ++runs_;
    intersecting_ += plain.pairs > 0 ? 1 : 0;
    still_intersecting_ += with.pairs > 0 ? 1 : 0;
    failed_ += with.has_failed ? 1 : 0;
    plain_seconds_ += plain.seconds;
    seconds_ += with.seconds;
    (plain.pairs > 0 ? ratios_at_gaps_ : ratios_).push_back(with.seconds / plain.seconds);
    if (plain.pairs == 0) largest_loss_ = (std::max)(largest_loss_, plain.in_range - with.in_range);
    if (mode.file != nullptr && !folder.empty()) write(mode, input, plain.mesh, with.mesh, folder + '/' + name);
  }

  void print(const std::string& name) const
  {
    std::printf("| %s | %zu | %zu | %zu | %zu | %.2f | %.2f | %.2f | %.2f %% |\n", name.c_str(), runs_, intersecting_,
                still_intersecting_, failed_, median(ratios_), median(ratios_at_gaps_), seconds_ / plain_seconds_,
                100 * largest_loss_);
    std::fflush(stdout);
  }

private:
  struct Outcome
  {
    Mesh mesh;
    std::size_t pairs = 0;
    double seconds = 0;
    double in_range = 0;
    bool has_failed = false;
  };

  static Outcome adapted(const Mesh& input, const Field& field, bool avoids)
  {
    Outcome result;
    result.mesh = input;
    const double start = bench::processor_seconds();
    try {
      result.in_range =
        SMA::adapt_surface_mesh<CGAL::Sequential_tag>(result.mesh, field, params::avoid_self_intersections(avoids))
          .final.in_range;
    } catch (const SMA::Self_intersection_error&) {
      result.has_failed = true;
    }
    result.seconds = (std::max)(bench::processor_seconds() - start, 1e-4);
    result.pairs = number_of_pairs(result.mesh);
    return result;
  }

  static void write(const Mode& mode, const Mesh& input, const Mesh& plain, const Mesh& with, const std::string& path)
  {
    if (!CGAL::is_closed(input)) return;
    Mesh remeshed = input;
    PMP::isotropic_remeshing(remeshed.faces(), mode.sizes * mean_edge_length(input), remeshed,
                             CGAL::parameters::number_of_iterations(3));
    const auto save = [&](const std::string& what, const Mesh& mesh) {
      CGAL::IO::write_polygon_mesh(path + '-' + mode.file + '-' + what + ".off", mesh,
                                   CGAL::parameters::stream_precision(17));
    };
    save("input", input);
    save("plain", plain);
    save("avoiding", with);
    save("isotropic_remeshing", remeshed);
  }

  std::size_t runs_ = 0, intersecting_ = 0, still_intersecting_ = 0, failed_ = 0;
  double plain_seconds_ = 0, seconds_ = 0, largest_loss_ = 0;
  std::vector<double> ratios_, ratios_at_gaps_; // of the times where faces did not meet without, and where they did
};

struct Named_mesh
{
  std::string name;
  Mesh mesh;
};

void table(const std::string& title, const std::vector<Named_mesh>& meshes, const std::string& folder)
{
  std::printf("\n%s: %zu meshes\n\n| sizes | runs | intersect without | with | given up | time, where none | where some | "
              "all | in range: largest loss where none |\n|---|---|---|---|---|---|---|---|---|\n",
              title.c_str(), meshes.size());
  for (const Mode& mode : modes) {
    Row row;
    for (const Named_mesh& m : meshes) row.run(mode, m.mesh, folder, m.name);
    row.print(mode.name);
  }
}

void add(std::vector<Named_mesh>& meshes, const std::string& name, Mesh&& mesh)
{
  if (number_of_pairs(mesh) == 0) meshes.push_back({name, std::move(mesh)});
}

} // namespace

int main(int argc, char* argv[])
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  std::string folder;
  std::vector<Named_mesh> shapes, files;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--output") folder = arguments[++i];
    else if (i == 0)
      for (std::uint64_t seed = 0; seed < std::strtoull(arguments[0].c_str(), nullptr, 10); ++seed) {
        const auto shape = near_sheets::shape(seed);
        add(shapes, "shape" + std::to_string(seed), shapes::mesh<Mesh>(shape.soup));
      }
    else {
      Mesh mesh;
      if (!CGAL::IO::read_polygon_mesh(arguments[i], mesh) || !CGAL::is_triangle_mesh(mesh) || mesh.is_empty() ||
          mesh.number_of_faces() > largest_file)
        continue;
      const std::string name = arguments[i].substr(arguments[i].rfind('/') + 1);
      try { // what is no valid surface is left out
        Mesh copy = mesh;
        SMA::swap(copy, SMA::Uniform_metric_field(mean_edge_length(copy)), params::number_of_iterations(0));
      } catch (const SMA::Adaptation_error&) {
        continue;
      }
      add(files, name.substr(0, name.rfind('.')), std::move(mesh));
    }
  }
  if (!shapes.empty()) table("Random sheets", shapes, folder);
  if (!files.empty()) table("Files", files, folder);
}

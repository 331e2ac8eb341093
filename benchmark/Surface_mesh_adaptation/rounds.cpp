// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's figure 9: error and quality over the rounds of an adaptation to the curvature, isotropic for twice the
// vertices of the input and anisotropic for a third of them, as a table in Markdown. Distances, largest and rms, are
// sampled in both directions, in thousandths of the diagonal of the bounding box: to the surface that the input stands
// for, by a fine mesh of it, and to the triangles of the input.

#include "../../test/Surface_mesh_adaptation/distances.h"
#include "common.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

using bench::Mesh;
namespace SMA = bench::SMA;

constexpr double samples = 200000; // of each mesh

/// Stops at the end of a round.
struct Stop_after_rounds : SMA::Adaptation_visitor
{
  std::size_t rounds;
  bool is_over = false;

  explicit Stop_after_rounds(std::size_t rounds_) : rounds(rounds_) {}

  void kernel_done(const SMA::Kernel_report& k) { is_over = k.kernel == "relocate" && k.round + 1 == rounds; }
  bool go_on() const { return !is_over; }
};

/// The vertices of the input, and many more between them on its patches.
Mesh surface_of(Mesh mesh)
{
  SMA::refine(mesh, SMA::Uniform_metric_field(0.2 * bench::mean_edge_length(mesh)));
  return mesh;
}

/// What meshes are compared with.
struct References
{
  Mesh fine;
  distances::Original surface, input;

  explicit References(const Mesh& mesh) : fine(surface_of(mesh)), surface(fine), input(mesh) {}
};

void print_row(const std::string& name, std::size_t round, const SMA::Mesh_statistics& s, const References& references,
               const Mesh& mesh)
{
  std::printf("| %s | %zu | %zu | %.2f | %.3f | %.3f |", name.c_str(), round, s.vertices, 100 * s.in_range,
              s.mean_quality, s.min_quality);
  for (const auto* original : {&references.surface, &references.input}) {
    const distances::Distance d = original->distance_to(mesh, samples);
    std::printf(" %.2f | %.3f |", 1e3 * d.largest / original->diagonal(), 1e3 * d.rms / original->diagonal());
  }
  std::printf("\n");
  std::fflush(stdout);
}

/// A row for each round: runs are reproducible, so that those which are stopped are the beginnings of the whole one.
void print_rows(const std::string& name, const SMA::Curvature_metric_field& field, const Mesh& input)
{
  const References references(input);
  bool is_complete = false;
  for (std::size_t round = 1; !is_complete; ++round) {
    Mesh mesh = input;
    const auto report = SMA::adapt_surface_mesh(mesh, field, SMA::parameters::visitor(Stop_after_rounds(round)));
    if (round == 1) print_row(name, 0, report.initial, references, input);
    is_complete = report.rounds < round;
    if (!is_complete) print_row(name, round, report.final, references, mesh);
  }
}

void print_case(const std::string& name, bool is_enriched)
{
  const Mesh input = bench::read_mesh(name);
  SMA::Curvature_metric_field field(1);
  field.anisotropic = !is_enriched;
  field.vertices = is_enriched ? 2 * num_vertices(input) : num_vertices(input) / 3;
  print_rows(name + (is_enriched ? ", isotropic, twice" : ", anisotropic, a third"), field, input);
}

} // namespace

int main()
{
  std::printf("| mesh | round | vertices | in range [%%] | mean quality | worst | to the surface: largest | rms "
              "| to the input: largest | rms |\n|---|---|---|---|---|---|---|---|---|---|\n");
  try {
    for (const char* part : {"rotor_small", "blade"}) print_case(part, true);
    for (const char* part : {"anchor_dense", "couplingdown"}) print_case(part, false);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "rounds: %s\n", e.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

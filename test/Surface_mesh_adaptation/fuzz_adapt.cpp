// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adapts random small meshes in random modes: `fuzz_adapt [--seconds S] [--seed N] [--one N]`. Every run either throws an
// error of the package and leaves the mesh as it was, or gives a manifold with the topology of its input. The seed of each
// failure is printed; `--one` repeats it. To be built with sanitizers, see scripts/sanitize.

#include "checks.h"
#include "brute_force_intersections.h"
#include "random_meshes.h"
#include "shape_meshes.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/metric_fields.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>
#include <type_traits>

#include <sys/time.h>
#include <unistd.h>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using random_meshes::Random;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Metric_tensor_3;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

std::uint64_t current_seed = 0; // for the handler of signals

/// Seconds of processor time. A case takes far less than one: one that does not end is a failure.
constexpr long longest_case = 60;

void limit_time(long seconds)
{
  const itimerval limit{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

void report_hang(int)
{
  std::cerr << "seed " << current_seed << ": did not end\n";
  _exit(1);
}

double mean_edge(const Soup& soup)
{
  double sum = 0;
  for (const auto& t : soup.triangles)
    for (std::size_t i = 0; i < 3; ++i) sum += (soup.points[t[i]] - soup.points[t[(i + 1) % 3]]).norm();
  return sum / (3 * double(soup.triangles.size()));
}

/// What the run may ask for beside the metric.
template <class Reconstruction, class Field>
SMA::Adaptation_report adapt(Random& random, Mesh& mesh, bool avoids_intersections, const Field& field)
{
  auto edge_map = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
  auto vertex_map = mesh.add_property_map<Mesh::Vertex_index, bool>("v:constrained", false).first;
  if (random.chance(0.2))
    for (const auto e : mesh.edges()) edge_map[e] = random.chance(0.2);
  if (random.chance(0.2))
    for (const auto v : mesh.vertices()) vertex_map[v] = random.chance(0.2);
  const double infinity = std::numeric_limits<double>::infinity();
  const auto parameters =
    SMA::parameters::detect_features(!random.chance(0.2))
      .feature_angle(random.chance(0.7) ? 45 : random.uniform(1, 180))
      .smooth_borders(random.chance(0.3))
      .edge_is_constrained_map(edge_map)
      .vertex_is_constrained_map(vertex_map)
      .tolerance(random.chance(0.15) ? random.magnitude(1e-3, 1) * mean_edge(shapes::soup(mesh)) : infinity)
      .fit_to_surface(random.chance(0.1))
      .avoid_self_intersections(avoids_intersections)
      .maximum_number_of_vertices(5000)
      .surface_reconstruction(Reconstruction());
  return random.chance(0.2) ? SMA::adapt_surface_mesh<CGAL::Parallel_if_available_tag>(mesh, field, parameters)
                            : SMA::adapt_surface_mesh<CGAL::Sequential_tag>(mesh, field, parameters);
}

SMA::Curvature_metric_field curvature_field(Random& random)
{
  SMA::Curvature_metric_field field(random.magnitude(1e-3, 0.1));
  field.anisotropic = random.chance(0.6);
  if (random.chance(0.3)) field.vertices = 4 + random.below(2000);
  if (random.chance(0.2)) field.gradation = random.uniform(1, 2);
  return field;
}

Metric_tensor_3 random_tensor(Random& random, double size)
{
  const Vector_3 axis = random.vector().normalized(), sizes = size * (2.3 * random.vector()).array().exp().matrix();
  const auto rotation = Eigen::AngleAxisd(random.uniform(0, 6.28), axis).toRotationMatrix();
  return SMA::metric_tensor(sizes.cwiseAbs2().cwiseInverse(), rotation);
}

template <class Reconstruction>
SMA::Adaptation_report adapt(Random& random, Mesh& mesh, bool avoids_intersections)
{
  const double size = mean_edge(shapes::soup(mesh)) * random.magnitude(0.1, 8);
  switch (random.below(4)) {
  case 0: return adapt<Reconstruction>(random, mesh, avoids_intersections, SMA::Uniform_metric_field(size));
  case 1: {
    auto tensors = mesh.add_property_map<Mesh::Vertex_index, Metric_tensor_3>("v:tensor", Metric_tensor_3()).first;
    for (const auto v : mesh.vertices()) tensors[v] = random_tensor(random, size);
    return adapt<Reconstruction>(random, mesh, avoids_intersections, tensors);
  }
  case 2: {
    auto sizes = mesh.add_property_map<Mesh::Vertex_index, double>("v:size", size).first;
    for (const auto v : mesh.vertices()) sizes[v] = size * random.magnitude(0.3, 3);
    return adapt<Reconstruction>(random, mesh, avoids_intersections, sizes);
  }
  default: return adapt<Reconstruction>(random, mesh, avoids_intersections, curvature_field(random));
  }
}

/// What is wrong with the result for this seed; empty: nothing.
std::string failure(std::uint64_t seed, bool is_verbose)
{
  Random random(seed);
  const Soup generated = random_meshes::mesh(random);
  if (!checks::is_manifold(generated)) return "the input is no manifold";
  Mesh mesh = shapes::mesh<Mesh>(generated);
  const Soup before = shapes::soup(mesh);
  const bool avoids_intersections = random.chance(0.3);
  try {
    const auto report = random.chance(0.3) ? adapt<SMA::Flat_reconstruction>(random, mesh, avoids_intersections)
                                           : adapt<SMA::Gregory_reconstruction>(random, mesh, avoids_intersections);
    if (is_verbose) report.write_json(std::cout);
  } catch (const SMA::Adaptation_error& e) {
    if (is_verbose) std::cout << e.what() << '\n';
    return checks::is_identical(shapes::soup(mesh), before) ? "" : std::string("changed, and ") + e.what();
  } catch (const std::exception& e) {
    return std::string("another exception: ") + e.what();
  }
  const Soup after = shapes::soup(mesh);
  if (!checks::is_manifold(after)) return "no manifold";
  if (!(checks::topology(after) == checks::topology(before))) return "another topology";
  for (const Vector_3& p : after.points)
    if (!p.allFinite()) return "a coordinate that is not finite";
  if (avoids_intersections && brute_force_intersections::number_of_pairs(before) == 0 &&
      brute_force_intersections::number_of_pairs(after) > 0)
    return "faces intersect";
  return "";
}

} // namespace

int main(int argc, char* argv[])
{
  double seconds = 20;
  std::uint64_t seed = 0;
  bool is_one = false;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--seconds") seconds = std::atof(argv[i + 1]);
    else seed = std::strtoull(argv[i + 1], nullptr, 10);
    is_one = is_one || option == "--one";
  }
  std::signal(SIGPROF, report_hang);
  const auto start = std::chrono::steady_clock::now();
  std::size_t cases = 0, failures = 0;
  do {
    current_seed = seed++;
    if (std::getenv("FUZZ_TRACE")) std::cerr << "seed " << current_seed << std::endl;
    limit_time(longest_case);
    const std::string what = failure(current_seed, is_one);
    limit_time(0);
    ++cases;
    if (what.empty()) continue;
    ++failures;
    std::cerr << "seed " << current_seed << ": " << what << '\n';
  } while (!is_one && std::chrono::steady_clock::now() - start < std::chrono::duration<double>(seconds));
  std::cout << cases - failures << " passed, " << failures << " failed\n";
  return failures == 0 ? 0 : 1;
}

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every entry point does around its kernels: read the parameters, import the mesh, build the reference and the
// metric, run, and write the result back.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/driver/carried_jets.h>
#include <CGAL/Surface_mesh_adaptation/driver/carried_values.h>
#include <CGAL/Surface_mesh_adaptation/driver/domain.h>
#include <CGAL/Surface_mesh_adaptation/driver/size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/execution/Any_execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/background_of_field.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/parameters.h>

#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {

constexpr unsigned default_number_of_rounds = 8;

namespace internal {

template <class Domain, class Surface, class NamedParameters>
void write_metric(const Domain& domain, const Surface& surface, const NamedParameters& np)
{
  if constexpr (has_parameter<NamedParameters, internal_np::output_metric_map_t>) {
    auto map = CGAL::parameters::get_parameter(np, internal_np::output_metric_map);
    domain.for_each_vertex([&](Index i, const auto& v) { put(map, v, surface.metrics[i].tensor()); });
  }
}

constexpr double share_of_operations = 0.95; // of the tolerance, at first

/// The tolerance that the parameters ask for, if any.
/// \throws Invalid_parameter_error
template <class NamedParameters>
std::optional<Tolerance> tolerance_of(const Any_execution& execution, const Mesh_view& mesh,
                                      const std::vector<Vector_3>& points, const NamedParameters& np)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const double distance = choose(np, internal_np::tolerance, none);
  if (!(distance > 0)) throw Invalid_parameter_error("the tolerance must be positive");
  if (distance == none) return std::nullopt;
  return Tolerance{distance, share_of_operations * distance, Triangle_tree(execution, mesh, points)};
}

/// An upper bound of the distance between the input and the adapted mesh; a coarse one where that leaves the tolerance.
template <class Surface>
double certified_distance(const Any_execution& execution, const Tolerance& tolerance, const Surface& surface)
{
  constexpr double precision = 0.02; // of the tolerance
  const Triangle_tree output(execution, surface.mesh, surface.points);
  return hausdorff_distance_bound(execution, tolerance.input, output,
                                  {precision * tolerance.distance, tolerance.distance});
}

/// Calls `adapt()`, which returns a report with a certified distance, with ever stricter operations until that distance
/// is within the tolerance.
/// \throws Tolerance_error
template <class Adapt>
Adaptation_report adapt_within(Tolerance& tolerance, const Adapt& adapt)
{
  constexpr int max_attempts = 4;
  constexpr double safety = 0.9;
  for (int attempt = 1;; ++attempt) {
    const Adaptation_report report = adapt();
    if (report.certified_distance <= tolerance.distance) return report;
    if (attempt == max_attempts || report.stopped) throw Tolerance_error(report.certified_distance, tolerance.distance);
    tolerance.of_operations *= safety * tolerance.distance / report.certified_distance;
  }
}

/// `adapt_in_place` where it is not interrupted before the kernels begin.
/// \throws Interrupted
template <class Domain, class MetricField, class NamedParameters, class Kernels>
Adaptation_report adapt_uninterrupted(const Any_execution& execution, Domain& domain, const MetricField& field,
                                      const NamedParameters& np, const Kernels& kernels)
{
  using Reconstruction = std::decay_t<decltype(
    choose(np, internal_np::surface_reconstruction, Gregory_reconstruction()))>;
  const auto points = point_map(domain.graph(), np);
  auto imported = domain.import(execution, points);
  const Renumbering numbers = improve_locality(execution, imported);
  domain.check_fans(execution, imported, numbers);
  Carried_values<Domain, NamedParameters> values(domain, imported, np);
  const Feature_parameters& features = values.features();
  Given_jets given;
  with_input_numbers(domain.graph(), imported, [&] { given = given_jets(imported, np); });
  const Vertex_size_bounds bounds = vertex_size_bounds(domain.graph(), imported, np);
  std::optional<Tolerance> tolerance = tolerance_of(execution, imported.mesh, imported.points, np);
  values.swap_caps(execution, imported);
  const Reference_surface<Reconstruction> reference(execution, imported.mesh, imported.points, features, std::move(given));

  Adaptation_report report;
  const auto adapt = [&](const auto& background) {
    using Metric = std::decay_t<decltype(background.at(reference, Location(), Surface_point()))>;
    using Surface = Adapted_surface<Metric, Reconstruction>;
    const Tolerance* const asked = tolerance ? &*tolerance : nullptr;
    std::optional<Surface> adapted;
    const auto run = [&] {
      adapted.emplace(execution, reference, background, asked);
      adapted->max_number_of_vertices =
        largest_number_of_vertices(choose(np, internal_np::maximum_number_of_vertices, std::size_t(-1)));
      adapted->follow_protected_edges(execution, protected_gradation(np));
      check_expected_size(execution, *adapted, adapted->max_number_of_vertices);
      Adaptation_report result = [&] {
        const Effect_of_interruption leave_out(execution.interruption(), Interruption::Effect::leave_out);
        return kernels(execution, *adapted);
      }();
      if (!asked) return result;
      const Effect_of_interruption once(execution.interruption(), result.stopped ? Interruption::Effect::none
                                                                                 : Interruption::Effect::give_up);
      result.tolerance = asked->distance;
      result.certified_distance = certified_distance(execution, *asked, *adapted);
      return result;
    };
    report = asked ? adapt_within(*tolerance, run) : run();
    const Effect_of_interruption write_all(execution.interruption(), Interruption::Effect::none);
    Surface& surface = *adapted;
    values.prepare(execution, surface);
    const Carried_jets<NamedParameters> jets(execution, reference, surface.locations.size(), [&](std::size_t v) {
      return surface.locations[v];
    }, np);
    domain.write(execution, imported, surface, points, [&](Index f) { return values.is_inside(surface.mesh, f); });
    values.write(surface); // what nobody passed first
    write_metric(domain, surface, np);
    jets.write(domain);
    surface.release(execution);
  };
  with_input_numbers(domain.graph(), imported, [&] {
    with_background_within(execution, field, imported, reference, bounds, adapt);
  });
  const Effect_of_interruption count_all(execution.interruption(), Interruption::Effect::none);
  report.fallback_patches = reference.number_of_fallbacks(execution);
  report.threads = execution.concurrency();
  return report;
}

/// Runs `kernels(execution, surface)`, which returns a report, on `domain`.
template <class Domain, class MetricField, class NamedParameters, class Kernels>
Adaptation_report adapt_in_place(const Any_execution& execution, Domain domain, const MetricField& field,
                                 const NamedParameters& np, const Kernels& kernels)
{
  try {
    return adapt_uninterrupted(execution, domain, field, np, kernels);
  } catch (const Interrupted&) {
    Adaptation_report report;
    report.stopped = true;
    report.threads = execution.concurrency();
    return report;
  }
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H

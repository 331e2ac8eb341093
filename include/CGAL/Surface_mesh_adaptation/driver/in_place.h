// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every entry point does around its kernels: read the parameters, import the mesh, build the reference and the
// metric, run, and write the result back.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/driver/attribute_transfer.h>
#include <CGAL/Surface_mesh_adaptation/driver/carried_jets.h>
#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/execution/Any_execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/background_of_field.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/parameters.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

constexpr unsigned default_number_of_rounds = 8;

namespace internal {

/// Feature detection parameters from the named parameters, with the constraints read from the user's maps.
template <class FaceGraph, class NamedParameters>
Feature_parameters feature_parameters(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported,
                                      const NamedParameters& np)
{
  Feature_parameters p;
  p.ridge_angle = choose(np, internal_np::feature_angle, p.ridge_angle);
  p.detect_ridges = choose(np, internal_np::detect_features, p.detect_ridges);
  p.smooth_borders = choose(np, internal_np::smooth_borders, p.smooth_borders);
  if (!(p.ridge_angle > 0 && p.ridge_angle <= 180))
    throw Invalid_parameter_error("the feature angle must lie between 0 and 180 degrees");
  if constexpr (has_parameter<NamedParameters, CGAL::internal_np::edge_is_constrained_t>) {
    const auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::edge_is_constrained);
    for (const auto h : imported.halfedges) p.halfedge_is_constrained.push_back(get(map, edge(h, graph)) ? 1 : 0);
  }
  if constexpr (has_parameter<NamedParameters, CGAL::internal_np::vertex_is_constrained_t>) {
    const auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_is_constrained);
    for (const auto v : imported.vertices) p.vertex_is_constrained.push_back(get(map, v) ? 1 : 0);
  }
  return p;
}

/// Marks the constrained elements of the result in the user's maps, where these can be written.
template <class FaceGraph, class Surface, class NamedParameters>
void write_constraints(FaceGraph& graph, const Surface& surface, const Feature_parameters& features,
                       const NamedParameters& np)
{
  if constexpr (has_writable_map<NamedParameters, CGAL::internal_np::vertex_is_constrained_t>()) {
    auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_is_constrained);
    std::size_t i = 0;
    for (const auto v : vertices(graph)) {
      const Index o = surface.origin[i++];
      put(map, v, o != no_index && features.vertex_is_constrained[o] != 0);
    }
  }
  if constexpr (has_writable_map<NamedParameters, CGAL::internal_np::edge_is_constrained_t>()) {
    auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::edge_is_constrained);
    for (const auto e : edges(graph)) put(map, e, false);
    std::size_t h = 0;
    for (const auto f : faces(graph))
      for (const auto g : CGAL::halfedges_around_face(halfedge(f, graph), graph)) {
        if (surface.mesh.is_feature(Index(h))) put(map, edge(g, graph), true);
        ++h;
      }
  }
}

template <class FaceGraph, class Surface, class NamedParameters>
void write_metric(FaceGraph& graph, const Surface& surface, const NamedParameters& np)
{
  if constexpr (has_parameter<NamedParameters, internal_np::output_metric_map_t>) {
    auto map = CGAL::parameters::get_parameter(np, internal_np::output_metric_map);
    std::size_t i = 0;
    for (const auto v : vertices(graph)) put(map, v, surface.metrics[i++].tensor());
  }
}

/// Calls `use()`; an error in the metric or field at a vertex is reported with the place of that vertex in `graph`, not
/// with its number after the renumbering of the import.
template <class FaceGraph, class Use>
void with_input_numbers(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported, const Use& use)
{
  const auto place = [&](const Invalid_input_error& e) {
    const auto all = vertices(graph);
    return std::size_t(std::distance(all.begin(), std::find(all.begin(), all.end(), imported.vertices[e.index()])));
  };
  try {
    use();
  } catch (const Invalid_metric_error& e) {
    throw Invalid_metric_error(place(e));
  } catch (const Invalid_field_error& e) {
    throw Invalid_field_error(place(e));
  } catch (const Invalid_normal_error& e) {
    throw Invalid_normal_error(place(e));
  }
}

template <class FaceGraph, class... Maps>
Attribute_transfer<FaceGraph, Maps...> attribute_transfer(const FaceGraph&, const Imported_mesh<FaceGraph>& imported,
                                                          const std::tuple<Maps...>& maps)
{
  return {imported, maps};
}

constexpr double share_of_operations = 0.95; // of the tolerance, at first

/// The tolerance that the parameters ask for, if any.
/// \throws Invalid_parameter_error
template <class Reference, class NamedParameters>
std::optional<Tolerance> tolerance_of(const Any_execution& execution, const Reference& reference, const NamedParameters& np)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const double distance = choose(np, internal_np::tolerance, none);
  if (!(distance > 0)) throw Invalid_parameter_error("the tolerance must be positive");
  if (distance == none) return std::nullopt;
  return Tolerance{distance, share_of_operations * distance, Triangle_tree(execution, reference.mesh, reference.points)};
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
template <class FaceGraph, class MetricField, class NamedParameters, class Kernels>
Adaptation_report adapt_uninterrupted(const Any_execution& execution, FaceGraph& graph, const MetricField& field,
                                 const NamedParameters& np, const Kernels& kernels)
{
  using Reconstruction = std::decay_t<decltype(
    choose(np, internal_np::surface_reconstruction, Gregory_reconstruction()))>;
  const auto points = point_map(graph, np);
  auto imported = import_face_graph(execution, graph, points);
  Feature_parameters features = feature_parameters(graph, imported, np);
  const std::vector<Index> order = improve_locality(execution, imported, features);
  check_fans(execution, imported.mesh, [&](Index v) { return order.empty() ? v : order[v]; });
  Given_jets given;
  with_input_numbers(graph, imported, [&] { given = given_jets(imported, np); });
  const Reference_surface<Reconstruction> reference(execution, imported.mesh, imported.points, features, std::move(given));

  std::optional<Tolerance> tolerance = tolerance_of(execution, reference, np);

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
    auto attributes = attribute_transfer(graph, imported, choose(np, internal_np::vertex_attribute_maps, std::tuple<>()));
    const Carried_jets<NamedParameters> jets(execution, reference, surface.locations.size(), [&](std::size_t v) {
      return surface.locations[v];
    }, np);
    write_connectivity(execution, surface.mesh, graph);
    write_points(execution, surface.points, graph, points);
    write_constraints(graph, surface, features, np);
    write_metric(graph, surface, np);
    jets.write(graph);
    attributes.write(graph, surface);
    surface.release(execution);
  };
  with_input_numbers(graph, imported, [&] { with_background(execution, field, imported, reference, adapt); });
  const Effect_of_interruption count_all(execution.interruption(), Interruption::Effect::none);
  report.fallback_patches = reference.number_of_fallbacks(execution);
  report.threads = execution.concurrency();
  return report;
}

/// Runs `kernels(execution, surface)`, which returns a report, on `graph`.
template <class FaceGraph, class MetricField, class NamedParameters, class Kernels>
Adaptation_report adapt_in_place(const Any_execution& execution, FaceGraph& graph, const MetricField& field,
                                 const NamedParameters& np, const Kernels& kernels)
{
  try {
    return adapt_uninterrupted(execution, graph, field, np, kernels);
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

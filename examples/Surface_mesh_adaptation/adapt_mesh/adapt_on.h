// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_ADAPT_ON_H
#define ADAPT_MESH_ADAPT_ON_H

#include "Bad_input.h"
#include "adapt.h"
#include "execution.h"
#include "mesh_files.h"
#include "metric_fields.h"

#include <CGAL/surface_mesh_adaptation.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <string>

namespace adapt_mesh {

/// The option that says how fine the mesh is to be.
inline const char* option_of_size(const Options& options)
{
  return options.size > 0           ? "--size"
         : !options.metric.empty()  ? "--metric"
         : options.vertices > 0     ? "--vertices"
         : options.curvature > 0    ? "--curvature"
                                    : "--tolerance";
}

/// Calls `adapt()`; if there would be too many vertices, says what to do about it. \throws Usage_error
template <class Adapt>
SMA::Adaptation_report within_limits(const Options& options, const Adapt& adapt)
{
  try {
    return adapt();
  } catch (const SMA::Mesh_too_large_error& e) {
    throw Usage_error(std::string(e.what()) + "; check " + option_of_size(options) + " or raise --max-vertices");
  }
}

/// The maps of what is carried at vertices.
inline std::vector<Mesh::Property_map<Vertex, double>> maps_of_vertices(const Constrained_mesh& mesh,
                                                                       const Carried_fields& fields)
{
  auto result = maps(mesh.at_vertices);
  result.insert(result.end(), fields.maps().begin(), fields.maps().end());
  return result;
}

/// As `adapt.h` says, with a `Reconstruction` between the vertices of the input.
template <class Reconstruction>
SMA::Adaptation_report adapt_on(const Options& options, Constrained_mesh& mesh, const Output_metric& output_metric,
                                const Carried_fields& fields, Progress& progress)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const double tolerance = options.tolerance > 0 ? options.tolerance * diagonal(mesh.mesh) : none;
  const auto parameters =
    SMA::parameters::detect_features(!options.no_features)
      .feature_angle(options.feature_angle.value_or(SMA::Feature_parameters().ridge_angle))
      .smooth_borders(options.smooth_borders)
      .edge_is_constrained_map(mesh.edge_is_constrained)
      .edge_is_protected_map(mesh.edge_is_protected)
      .face_patch_map(mesh.label)
      .face_size_bounds_map(mesh.size_bounds)
      .face_deviation_map(mesh.deviation)
      .vertex_attribute_maps(maps_of_vertices(mesh, fields))
      .face_attribute_maps(maps_of_faces(mesh))
      .halfedge_attribute_maps(maps(mesh.at_corners))
      .vertex_is_constrained_map(mesh.vertex_is_constrained)
      .maximum_number_of_vertices(options.max_vertices > 0 ? std::size_t(options.max_vertices) : std::size_t(-1))
      .number_of_iterations(options.rounds > 0 ? unsigned(options.rounds) : SMA::default_number_of_rounds)
      .output_metric_map(output_metric)
      .tolerance(tolerance)
      .avoid_self_intersections(options.no_self_intersections)
      .count_self_intersections(!options.no_intersection_count)
      .surface_reconstruction(Reconstruction())
      .fit_to_surface(options.fit)
      .shape_weight_of_fit(options.shape_weight.value_or(SMA::default_shape_weight))
      .visitor(std::ref(progress));
  SMA::Adaptation_report report = with_metric_field(options, mesh, [&](const auto& field) {
    const auto adapt = [&](const auto& execution) {
      return SMA::adapt_surface_mesh(execution, mesh.mesh, field, parameters);
    };
    return blaming(options.input,
                   [&] { return within_limits(options, [&] { return with_execution(options, adapt); }); });
  });
  progress.finish();
  return report;
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_ADAPT_ON_H

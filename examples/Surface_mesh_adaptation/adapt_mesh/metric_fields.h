// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric field that the options ask for.

#ifndef ADAPT_MESH_METRIC_FIELDS_H
#define ADAPT_MESH_METRIC_FIELDS_H

#include "Bad_input.h"
#include "metric_files.h"
#include "options.h"
#include "solution_files.h"

#include <CGAL/Surface_mesh_adaptation/metric_fields.h>

#include <cstddef>
#include <string>

namespace adapt_mesh {

/// Sets what the options say of any metric that is made from data.
template <class Field>
Field configured(const Options& options, Field field)
{
  field.hmin = options.hmin;
  field.hmax = options.hmax;
  if (options.gradation) field.gradation = *options.gradation;
  return field;
}

inline SMA::Curvature_metric_field curvature_field(const Options& options)
{
  constexpr double any_tolerance = 0.001; // with a number of vertices the tolerance follows from it
  using Field = SMA::Curvature_metric_field;
  auto field = configured(options, options.curvature > 0  ? Field(options.curvature)
                                   : options.vertices > 0 ? Field(any_tolerance)
                                                          : Field::for_tolerance(options.tolerance));
  field.anisotropic = options.anisotropic;
  if (options.curvature == 0) field.vertices = std::size_t(options.vertices);
  return field;
}

/// As an option asks for it. \throws Bad_input
inline SMA::Medit_field field_of_file(const Wanted_field& wanted, Constrained_mesh& mesh)
{
  const auto warn = [&](const std::string& text) { mesh.warnings.push_back(text); };
  return reading(wanted.file, [&] { return read_field(wanted, mesh.vertex_of_point.size(), warn); });
}

inline auto solution_field(const Options& options, Constrained_mesh& mesh)
{
  const Wanted_field wanted{options.field, std::size_t(options.field_number), {1}, "a scalar"};
  const SMA::Medit_field values = field_of_file(wanted, mesh);
  auto field = configured(options, SMA::Solution_metric_field(scalar_map(values, mesh), std::size_t(options.vertices)));
  field.norm = options.norm.value_or(field.norm);
  field.anisotropic = options.anisotropic;
  return field;
}

/// What several fields ask for, or one that is to be scaled or graded.
template <class... Fields>
auto intersection(const Options& options, const Fields&... fields)
{
  auto field = configured(options, SMA::Intersection_metric_field(fields...));
  if (!options.gradation && !options.metric.empty()) field.gradation = 1;
  field.vertices = std::size_t(options.vertices);
  return field;
}

/// Calls `adapt(field)` with the metric of a file.
template <class Adapt>
SMA::Adaptation_report with_metric_of_file(const Options& options, Constrained_mesh& mesh, const Adapt& adapt)
{
  const Wanted_field wanted{options.metric, std::size_t(options.metric_number), {1, 6}, "a scalar or a tensor"};
  const SMA::Medit_field metric = field_of_file(wanted, mesh);
  const Size_bounds bounds(options.hmin, options.hmax);
  const auto adapt_to = [&](const auto& map) {
    return options.vertices > 0 || options.gradation ? adapt(intersection(options, map)) : adapt(map);
  };
  return metric.components == 1 ? adapt_to(reading(options.metric, [&] { return size_map(metric, mesh, bounds); }))
                                : adapt_to(reading(options.metric, [&] { return tensor_map(metric, mesh, bounds); }));
}

/// Calls `adapt(field)` with the metric field that the options ask for.
template <class Adapt>
SMA::Adaptation_report with_metric_field(const Options& options, Constrained_mesh& mesh, const Adapt& adapt)
{
  if (options.size > 0) return adapt(SMA::Uniform_metric_field(options.size));
  if (!options.metric.empty()) return with_metric_of_file(options, mesh, adapt);
  if (options.field.empty()) return adapt(curvature_field(options));
  const auto solution = solution_field(options, mesh);
  return options.curvature > 0 ? adapt(intersection(options, solution, curvature_field(options))) : adapt(solution);
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_METRIC_FIELDS_H

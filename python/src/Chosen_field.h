// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric field that the options ask for, as one type: what depends on the field is compiled for each, the kernels
// only once for sizes and once for tensors.

#ifndef SMA_PYTHON_CHOSEN_FIELD_H
#define SMA_PYTHON_CHOSEN_FIELD_H

#include "Array_surface.h"

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/metric_fields.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace sma_python {

inline double value_of(const double* row, double) { return *row; }
inline SMA::Metric_tensor_3 value_of(const double* row, const SMA::Metric_tensor_3&) { return tensor_of(row); }

/// Values in an array at the points that the vertices come from.
template <class Value>
struct Array_map
{
  using key_type = Vertex;
  using value_type = Value;
  using reference = Value;
  using category = boost::readable_property_map_tag;

  Array_view<double> values;
  const std::vector<std::size_t>* point_of_vertex;

  friend Value get(const Array_map& map, Vertex v)
  {
    return value_of(map.values.row((*map.point_of_vertex)[v]), Value());
  }
};

using Size_map = Array_map<double>;
using Tensor_map = Array_map<SMA::Metric_tensor_3>;
using Solution_field = SMA::Solution_metric_field<Size_map>;
using Curvature_field = SMA::Curvature_metric_field;

using Chosen_field =
  std::variant<SMA::Uniform_metric_field, Curvature_field, Size_map, Tensor_map, Solution_field,
               SMA::Intersection_metric_field<Size_map>, SMA::Intersection_metric_field<Tensor_map>,
               SMA::Intersection_metric_field<Size_map, Curvature_field>,
               SMA::Intersection_metric_field<Tensor_map, Curvature_field>,
               SMA::Intersection_metric_field<Solution_field, Curvature_field>>;

// From options to fields.

template <class Field>
Field configured(const Options& options, Field field)
{
  field.hmin = options.hmin;
  field.hmax = options.hmax;
  if (options.gradation > 0) field.gradation = options.gradation;
  return field;
}

template <class Field>
void stretch(const Options& options, Field& field)
{
  field.anisotropic = options.anisotropic;
  if (options.max_anisotropy > 0) field.max_anisotropy = options.max_anisotropy;
}

/// \param relative_tolerance the tolerance as a fraction of the diagonal, infinite if none was given
inline Curvature_field curvature_field(const Options& options, double relative_tolerance)
{
  constexpr double any_tolerance = 0.001; // with a number of vertices the tolerance follows from it
  auto field = configured(options, options.curvature > 0  ? Curvature_field(options.curvature)
                                   : options.vertices > 0 ? Curvature_field(any_tolerance)
                                                          : Curvature_field::for_tolerance(relative_tolerance));
  stretch(options, field);
  field.noisy = options.noisy;
  if (options.curvature == 0) field.vertices = options.vertices;
  return field;
}

/// What several fields ask for, or one that is to be scaled or graded.
template <class... Fields>
Chosen_field intersection(const Options& options, double gradation, const Fields&... fields)
{
  auto field = configured(options, SMA::Intersection_metric_field(fields...));
  if (options.gradation == 0) field.gradation = gradation;
  field.vertices = options.vertices;
  return field;
}

/// Without more to say, a metric that is given is taken as it is.
template <class Map>
Chosen_field field_of_map(const Options& options, const Map& map)
{
  if (options.curvature > 0) return intersection(options, SMA::default_gradation, map, curvature_field(options, 0));
  if (options.vertices > 0 || options.gradation > 0) return intersection(options, 1, map);
  return map;
}

inline Chosen_field field_of_solution(const Options& options, const Size_map& values)
{
  auto field = configured(options, Solution_field(values, options.vertices));
  stretch(options, field);
  if (options.norm > 0) field.norm = options.norm;
  if (options.curvature > 0) return intersection(options, SMA::default_gradation, field, curvature_field(options, 0));
  return field;
}

/// \param relative_tolerance the tolerance as a fraction of the diagonal, infinite if none was given
inline Chosen_field chosen_field(const Options& options, const Array_surface& surface, double relative_tolerance)
{
  const std::vector<std::size_t>* const points = &surface.point_of_vertex;
  if (options.size > 0) return SMA::Uniform_metric_field(options.size);
  if (!options.sizes.empty()) return field_of_map(options, Size_map{options.sizes, points});
  if (!options.tensors.empty()) return field_of_map(options, Tensor_map{options.tensors, points});
  if (!options.field.empty()) return field_of_solution(options, Size_map{options.field, points});
  return curvature_field(options, relative_tolerance);
}

} // namespace sma_python

#endif // SMA_PYTHON_CHOSEN_FIELD_H

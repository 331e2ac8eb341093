// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the field that a user asks for to the metric on the reference surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_BACKGROUND_OF_FIELD_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_BACKGROUND_OF_FIELD_H

#include <CGAL/Surface_mesh_adaptation/fields/Metric_background.h>
#include <CGAL/Surface_mesh_adaptation/fields/curvature.h>
#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/fields/hessian.h>
#include <CGAL/Surface_mesh_adaptation/fields/metric_normalization.h>
#include <CGAL/Surface_mesh_adaptation/fields/proximity.h>
#include <CGAL/Surface_mesh_adaptation/metric/Interpolation_norm.h>
#include <CGAL/Surface_mesh_adaptation/metric/Size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>
#include <CGAL/Surface_mesh_adaptation/metric_fields.h>
#include <CGAL/Surface_mesh_adaptation/numerics/bounding_box.h>

#include <CGAL/number_utils.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// The bounds that a user gave for a metric that is scaled to a number of vertices, or wide ones.
inline Size_bounds bounds_of_scaled_metric(double hmin, double hmax, double diagonal)
{
  const double upper = hmax > 0 ? hmax : diagonal;
  return Size_bounds(hmin > 0 ? hmin : (std::min)(1e-6 * diagonal, upper), upper);
}

inline void check_anisotropy(double max_anisotropy)
{
  if (!(max_anisotropy >= 1)) throw Invalid_parameter_error("the largest anisotropy must be at least 1");
}

/// \throws Invalid_metric_error for the first that is not positive and finite, or positive definite
/// @{
template <class Execution>
void check_metric(const Execution& execution, const std::vector<double>& sizes)
{
  const std::size_t bad = first_invalid(execution, sizes.size(), [&](std::size_t v) { return is_valid_size(sizes[v]); });
  if (bad < sizes.size()) throw Invalid_metric_error(bad);
}

template <class Execution>
void check_metric(const Execution& execution, const std::vector<Metric_tensor_3>& tensors)
{
  const std::size_t bad = first_invalid(execution, tensors.size(), [&](std::size_t v) {
    return is_positive_definite(tensors[v]);
  });
  if (bad < tensors.size()) throw Invalid_metric_error(bad);
}
/// @}

/// Sizes or tensors as tensors, once they are checked.
/// @{
template <class Execution>
std::vector<Metric_tensor_3> checked_tensors(const Execution& execution, const std::vector<double>& sizes)
{
  check_metric(execution, sizes);
  std::vector<Metric_tensor_3> tensors(sizes.size());
  for_each_index(execution, sizes.size(), [&](std::size_t v) { tensors[v] = Metric_tensor_3::isotropic(sizes[v]); });
  return tensors;
}

template <class Execution>
const std::vector<Metric_tensor_3>& checked_tensors(const Execution& execution, const std::vector<Metric_tensor_3>& tensors)
{
  check_metric(execution, tensors);
  return tensors;
}
/// @}

/// What fields are told of the input beside its surface.
template <class Vertex>
struct Field_input
{
  const std::vector<Vertex>& vertices;
  const std::vector<double>& deviations; ///< asked for above each face; 0: that of the field; empty: nothing but that
};

template <class Vertex>
Field_input(const std::vector<Vertex>&, const std::vector<double>&) -> Field_input<Vertex>;

/// `with_vertex_metric(execution, field, input, reference, use)` calls `use(values)` with the sizes or tensors that
/// `field` stands for at the vertices of the reference surface.
template <class Execution, class Input, class Reference, class Use>
void with_vertex_metric(const Execution&, const Uniform_metric_field& field, const Input&, const Reference& reference,
                        const Use& use)
{
  use(std::vector<double>(reference.points.size(), field.size));
}

template <class Execution, class Function, class Input, class Reference, class Use>
void with_vertex_metric(const Execution& execution, const Analytic_metric_field<Function>& field, const Input&,
                        const Reference& reference, const Use& use)
{
  std::vector<std::decay_t<decltype(field.function(std::declval<const Vector_3&>()))>> values(reference.points.size());
  for_each_index(execution, values.size(), [&](std::size_t v) { values[v] = field.function(reference.points[v]); });
  use(std::move(values));
}

/// Calls `use` with the metric of a number of vertices, or of a scale if that number is 0.
template <class Value, class Execution, class Reference, class Use>
void use_scaled(const Execution& execution, const Reference& reference, const Scalable_metric& metric,
                std::size_t vertices, double scale, const Use& use)
{
  if (vertices > 0)
    use(normalize_to_vertex_count<Value>(execution, reference.mesh, reference.points, reference.normals, metric,
                                         double(vertices)));
  else use(metric_at_scale<Value>(execution, reference.mesh, reference.points, reference.normals, metric, scale));
}

/// Whether sizes across narrow strips are to fit these.
template <class Field>
bool wants_proximity(const Field&)
{
  return false;
}

inline bool wants_proximity(const Curvature_metric_field& field)
{
  return field.anisotropic && field.proximity;
}

template <class... Fields>
bool wants_proximity(const Intersection_metric_field<Fields...>& field)
{
  return std::apply([](const auto&... f) { return (wants_proximity(f) || ...); }, field.fields);
}

/// The largest size that a field asks for.
inline double largest_size(const Curvature_metric_field& field, double diagonal)
{
  return field.hmax > 0 ? field.hmax : 0.1 * diagonal;
}

/// An edge over a bend of less than 45 degrees, which is no ridge, leaves it by a fifth of its length. Where a number of
/// vertices is given, smaller sizes than four deviations would go into noise.
constexpr double least_size_in_deviations = 4;

inline double gradation(const Curvature_metric_field& field)
{
  if (field.gradation > 0) return field.gradation;
  return field.anisotropic ? default_gradation : default_gradation_of_isotropic_curvature;
}

/// The deviations above the faces of the input, where the field aims at the `common` one; empty: everywhere at that.
inline std::vector<double> deviations_of_faces(const Curvature_metric_field& field, double common,
                                               std::vector<double> asked)
{
  if (field.vertices > 0) return {};
  std::replace(asked.begin(), asked.end(), 0.0, common);
  return asked;
}

inline double least_deviation(double common, const std::vector<double>& of_faces)
{
  return of_faces.empty() ? common : *std::min_element(of_faces.begin(), of_faces.end());
}

/// Scales tensors, which are for the `common` deviation, to the smallest one of the faces around each vertex.
template <class Execution>
void scale_to_deviations(const Execution& execution, const Mesh_view& mesh, double common,
                         const std::vector<double>& of_faces, std::vector<Metric_tensor_3>& tensors)
{
  for_each_index(execution, tensors.size(), [&](std::size_t v) {
    double least = std::numeric_limits<double>::infinity();
    mesh.for_each_outgoing(Index(v), [&](Index h) { least = (std::min)(least, of_faces[Mesh_view::face(h)]); });
    tensors[v] = common / least * tensors[v];
  });
}

template <class Execution, class Input, class Reference, class Use>
void with_vertex_metric(const Execution& execution, const Curvature_metric_field& field, const Input& input,
                        const Reference& reference, const Use& use)
{
  check_anisotropy(field.max_anisotropy);
  const double diagonal = diagonal_of_bounding_box(reference.points), tolerance = field.relative_tolerance * diagonal;
  const std::vector<double> deviations = deviations_of_faces(field, tolerance, input.deviations);
  const double hmax = largest_size(field, diagonal);
  const double hmin = field.hmin > 0 ? field.hmin : (std::min)(least_deviation(tolerance, deviations), hmax);
  const Size_bounds bounds = field.vertices > 0 ? bounds_of_scaled_metric(field.hmin, field.hmax, diagonal)
                                                : Size_bounds(hmin, hmax);
  Scalable_metric metric{curvature_tensors(execution, reference, field.anisotropic ? field.max_anisotropy : 1,
                                           field.noisy ? Jet_fit::noisy : Jet_fit::exact),
                         bounds, gradation(field)};
  if (!deviations.empty()) scale_to_deviations(execution, reference.mesh, tolerance, deviations, metric.tensors);
  if (wants_proximity(field)) metric.fixed = proximity_tensors(execution, reference, bounds);
  const double scale = 1 / (6 * tolerance);
  if (field.vertices > 0 && !(field.hmin > 0)) metric.least_size = least_size_in_deviations * tolerance * scale;
  if (field.anisotropic) use_scaled<Metric_tensor_3>(execution, reference, metric, field.vertices, scale, use);
  else use_scaled<double>(execution, reference, metric, field.vertices, scale, use);
}

/// Fits to a field that the mesh does not resolve miss most of its waves: adaptation to them would take away the
/// vertices that are needed to see more. Hence up to five times as much where values are not explained.
inline Metric_tensor_3 resolving_hessian(const Hessian_estimate& hessian)
{
  return (1 + 4 * hessian.unexplained) * hessian.tensor;
}

template <class Execution, class VertexScalarMap, class Input, class Reference, class Use>
void with_vertex_metric(const Execution& execution, const Solution_metric_field<VertexScalarMap>& field,
                        const Input& input, const Reference& reference, const Use& use)
{
  check_anisotropy(field.max_anisotropy);
  if (!(field.norm >= 1)) throw Invalid_parameter_error("the norm must be at least 1");
  const Interpolation_norm norm(field.norm);
  std::vector<double> values(input.vertices.size());
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = CGAL::to_double(get(field.values, input.vertices[v]));
  const Corner_jets jets = estimate_jets(execution, reference.mesh, reference.points);
  const Buffer<Hessian_estimate> hessians =
    estimate_hessians(execution, reference.mesh, reference.points, jets, values);
  const Scalable_metric metric{
    intersect_sectors(execution, reference.mesh, jets.of_corner, [&](Index sector) {
      return multiscale_tensor(resolving_hessian(hessians[sector]), norm, field.anisotropic ? field.max_anisotropy : 1);
    }, [](Index, const auto&) {}),
    bounds_of_scaled_metric(field.hmin, field.hmax, diagonal_of_bounding_box(reference.points)), field.gradation};
  if (field.anisotropic) use_scaled<Metric_tensor_3>(execution, reference, metric, field.vertices, 1, use);
  else use_scaled<double>(execution, reference, metric, field.vertices, 1, use);
}

/// Any readable property map of the vertices, with sizes or `Metric_tensor_3` as values.
template <class Execution, class PropertyMap, class Input, class Reference, class Use>
void with_vertex_metric(const Execution&, const PropertyMap& map, const Input& input, const Reference&, const Use& use)
{
  const std::size_t n = input.vertices.size();
  if constexpr (std::is_same_v<typename boost::property_traits<PropertyMap>::value_type, Metric_tensor_3>) {
    std::vector<Metric_tensor_3> tensors(n);
    for (std::size_t v = 0; v < n; ++v) tensors[v] = get(map, input.vertices[v]);
    use(std::move(tensors));
  } else {
    std::vector<double> sizes(n);
    for (std::size_t v = 0; v < n; ++v) sizes[v] = CGAL::to_double(get(map, input.vertices[v]));
    use(std::move(sizes));
  }
}

/// The number of vertices that a field asks for; 0: none.
template <class Field>
auto number_of_vertices(const Field& field, int) -> decltype(std::size_t(field.vertices))
{
  return field.vertices;
}

template <class Field>
std::size_t number_of_vertices(const Field&, long)
{
  return 0;
}

template <class... Fields>
std::size_t number_of_vertices(const std::variant<Fields...>& chosen, int)
{
  return std::visit([](const auto& field) { return number_of_vertices(field, 0); }, chosen);
}

/// A field as a part of an intersection: without what is not for a part to ask.
template <class Field>
auto as_part(Field field, int) -> decltype(void(field.gradation), Field(field))
{
  field.gradation = 1;
  return field;
}

inline Curvature_metric_field as_part(Curvature_metric_field field, int)
{
  field.gradation = 1;
  field.proximity = false; // that of the whole is not scaled
  return field;
}

template <class Field>
Field as_part(Field field, long)
{
  return field;
}

template <class... Fields>
Intersection_metric_field<Fields...> as_part(const Intersection_metric_field<Fields...>& field, int)
{
  auto part = std::apply([](const auto&... f) { return Intersection_metric_field<Fields...>(as_part(f, 0)...); },
                         field.fields);
  part.gradation = 1;
  part.vertices = field.vertices;
  part.hmin = field.hmin;
  part.hmax = field.hmax;
  return part;
}

template <class Execution, class... Fields, class Input, class Reference, class Use>
void with_vertex_metric(const Execution& execution, const Intersection_metric_field<Fields...>& field,
                        const Input& input, const Reference& reference, const Use& use)
{
  std::vector<std::vector<Metric_tensor_3>> asked; // by each field
  bool anisotropic = false;
  const auto add = [&](const auto& values) {
    anisotropic = anisotropic || std::is_same_v<std::decay_t<decltype(values)>, std::vector<Metric_tensor_3>>;
    asked.push_back(checked_tensors(execution, values));
  };
  std::apply([&](const auto&... f) {
    (with_vertex_metric(execution, as_part(f, 0), input, reference, add), ...);
  }, field.fields);

  const double diagonal = diagonal_of_bounding_box(reference.points);
  Scalable_metric metric{std::vector<Metric_tensor_3>(reference.points.size()),
                         bounds_of_scaled_metric(field.hmin, field.hmax, diagonal), field.gradation};
  for_each_index(execution, metric.tensors.size(), [&](std::size_t v) {
    Ring<Metric_tensor_3> tensors;
    for (const auto& of_field : asked) tensors.push_back(of_field[v]);
    metric.tensors[v] = intersection_of_all(tensors);
  }, heavy_chunk_length);
  if (wants_proximity(field)) metric.fixed = proximity_tensors(execution, reference, metric.bounds);
  if (anisotropic) use_scaled<Metric_tensor_3>(execution, reference, metric, field.vertices, 1, use);
  else use_scaled<double>(execution, reference, metric, field.vertices, 1, use);
}

/// The number of vertices that a field asks for or, where its bounds forbid that, that of its `values` at the vertices;
/// 0: any.
template <class Execution, class Field, class Reference, class Value>
double attainable_number_of_vertices(const Execution& execution, const Field& field, const Reference& reference,
                                     const std::vector<Value>& values)
{
  const double asked = double(number_of_vertices(field, 0));
  if (asked == 0) return 0;
  const Metric_complexity c = complexity(execution, reference.mesh, reference.points, reference.normals, values);
  const double expected = (std::max)(4.0, expected_number_of_vertices(execution, reference.mesh, c));
  return std::abs(std::log(expected / asked)) <= normalization_precision ? asked : expected;
}

/// What a field asks for beyond its metric, of which the `values` are those at the vertices.
template <class Execution, class Field, class Input, class Reference, class Value>
Metric_aims aims(const Execution& execution, const Field& field, [[maybe_unused]] const Input& input,
                 const Reference& reference, const std::vector<Value>& values)
{
  Metric_aims result;
  result.number_of_vertices = attainable_number_of_vertices(execution, field, reference, values);
  if constexpr (std::is_same_v<Field, Curvature_metric_field>) {
    if (field.vertices > 0 || !field.corrected) return result;
    result.deviation = field.relative_tolerance * diagonal_of_bounding_box(reference.points);
    result.deviation_of_face = deviations_of_faces(field, result.deviation, input.deviations);
    result.hmin = field.hmin > 0 ? field.hmin : least_deviation(result.deviation, result.deviation_of_face);
    result.gradation = gradation(field);
  }
  return result;
}

/// What `sizes` of a field may be inside of planes, where that says more than their interpolation.
/// @{
template <class Execution, class Field, class Reference, class Values>
Growth_on_planes growth_on_planes(const Execution&, const Field&, const Reference&, const Values&)
{
  return {};
}

template <class Execution, class Reference>
Growth_on_planes growth_on_planes(const Execution& execution, const Curvature_metric_field& field,
                                  const Reference& reference, const std::vector<double>& sizes)
{
  if (field.vertices > 0) return {};
  const double hmax = largest_size(field, diagonal_of_bounding_box(reference.points));
  return {execution, reference, sizes, gradation(field), hmax};
}
/// @}

/// Bounds of the sizes at each vertex; none at all if there are no vertices in them.
struct Vertex_size_bounds
{
  std::vector<double> lower, upper;

  bool empty() const { return lower.empty(); }
};

/// Puts sizes, or tensors, within bounds, and lets them grow from there as the gradation wants it.
/// @{
template <class Execution, class Reference>
void put_within(const Execution& execution, const Reference& reference, const Vertex_size_bounds& bounds, double ratio,
                std::vector<double>& sizes)
{
  for_each_index(execution, sizes.size(), [&](std::size_t v) {
    sizes[v] = (std::min)((std::max)(sizes[v], bounds.lower[v]), bounds.upper[v]);
  });
  apply_gradation(execution, reference.mesh, reference.points, ratio, sizes);
}

template <class Execution, class Reference>
void put_within(const Execution& execution, const Reference& reference, const Vertex_size_bounds& bounds, double ratio,
                std::vector<Metric_tensor_3>& tensors)
{
  for_each_index(execution, tensors.size(), [&](std::size_t v) {
    Eigen_decomposition_3 e = eigen_decomposition(tensors[v]);
    for (double& l : e.values) {
      const double size = (std::min)((std::max)(1 / std::sqrt(l), bounds.lower[v]), bounds.upper[v]);
      l = 1 / (size * size);
    }
    tensors[v] = metric_tensor(e.values, e.vectors);
  }, heavy_chunk_length);
  apply_gradation(execution, reference.mesh, reference.points, reference.normals, ratio, tensors);
}
/// @}

/// The gradation of sizes that are put within bounds.
template <class Field>
double gradation_within(const Field& field)
{
  if constexpr (std::is_same_v<Field, Curvature_metric_field>) return gradation(field);
  else return default_gradation;
}

/// `with_background(execution, field, input, reference, use)` calls `use(background)` with the metric background
/// that `field` stands for on the reference surface.
template <class Execution, class Input, class Reference, class Use>
void with_background(const Execution&, const Uniform_metric_field& field, const Input&, const Reference&, const Use& use)
{
  use(Metric_background<Isotropic_metric>(field.size));
}

template <class Execution, class Function, class Input, class Reference, class Use>
void with_background(const Execution&, const Analytic_metric_field<Function>& field, const Input&, const Reference&,
                     const Use& use)
{
  using Value = std::decay_t<decltype(field.function(std::declval<const Vector_3&>()))>;
  if constexpr (std::is_same_v<Value, Metric_tensor_3>)
    use(Metric_background<Anisotropic_metric>(Metric_background<Anisotropic_metric>::Formula(field.function)));
  else
    use(Metric_background<Isotropic_metric>(Metric_background<Isotropic_metric>::Formula(field.function)));
}

template <class Execution, class Field, class Input, class Reference, class Use>
void with_background(const Execution& execution, const Field& field, const Input& input, const Reference& reference,
                     const Use& use)
{
  with_vertex_metric(execution, field, input, reference, [&](auto values) {
    using Value = typename decltype(values)::value_type;
    using Metric = std::conditional_t<std::is_same_v<Value, Metric_tensor_3>, Anisotropic_metric, Isotropic_metric>;
    Metric_aims asked = aims(execution, field, input, reference, values);
    asked.growth = growth_on_planes(execution, field, reference, values);
    use(Metric_background<Metric>(execution, std::move(values), asked));
  });
}

/// The same, of a metric within `bounds`.
template <class Execution, class Field, class Input, class Reference, class Use>
void with_background_within(const Execution& execution, const Field& field, const Input& input,
                            const Reference& reference, const Vertex_size_bounds& bounds, const Use& use)
{
  if (bounds.empty()) return with_background(execution, field, input, reference, use);
  with_vertex_metric(execution, field, input, reference, [&](auto values) {
    using Value = typename decltype(values)::value_type;
    using Metric = std::conditional_t<std::is_same_v<Value, Metric_tensor_3>, Anisotropic_metric, Isotropic_metric>;
    check_metric(execution, values);
    put_within(execution, reference, bounds, gradation_within(field), values);
    const Metric_aims asked = aims(execution, field, input, reference, values);
    use(Metric_background<Metric>(execution, std::move(values), asked));
  });
}

/// The same, of the field that a variant holds: what is asked for may be chosen while the program runs.
template <class Execution, class... Fields, class Input, class Reference, class Use>
void with_background_within(const Execution& execution, const std::variant<Fields...>& chosen, const Input& input,
                            const Reference& reference, const Vertex_size_bounds& bounds, const Use& use)
{
  std::visit([&](const auto& field) {
    with_background_within(execution, field, input, reference, bounds, use);
  }, chosen);
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_BACKGROUND_OF_FIELD_H

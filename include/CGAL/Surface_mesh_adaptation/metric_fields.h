// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of the concept `MetricField`: what `adapt_surface_mesh` can be asked for.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_FIELDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_FIELDS_H

#include <CGAL/Surface_mesh_adaptation/Metric_background.h>
#include <CGAL/Surface_mesh_adaptation/curvature.h>
#include <CGAL/Surface_mesh_adaptation/gradation.h>

#include <CGAL/number_utils.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The same edge length everywhere.
/// \cgalModels `MetricField`
struct Uniform_metric_field
{
  double size;

  explicit Uniform_metric_field(double size_) : size(size_)
  {
    if (!(size > 0) || !std::isfinite(size)) throw Invalid_parameter_error("the edge length must be positive and finite");
  }
};

/// Sizes from the curvature of the surface, so that the distance between the surface and its faces stays near a
/// tolerance: the size along a principal direction of curvature `k` is `sqrt(6 tolerance / |k|)`.
/// \cgalModels `MetricField`
struct Curvature_metric_field
{
  double relative_tolerance;   ///< as a fraction of the diagonal of the bounding box
  double hmin = 0;             ///< smallest size; 0: the tolerance itself
  double hmax = 0;             ///< largest size; 0: a tenth of the diagonal
  bool anisotropic = false;    ///< keep the directions; else the smaller of the two sizes counts in all
  double gradation = 1.5;      ///< largest ratio of the sizes at two points one size apart

  explicit Curvature_metric_field(double relative_tolerance_) : relative_tolerance(relative_tolerance_)
  {
    if (!(relative_tolerance > 0) || !std::isfinite(relative_tolerance))
      throw Invalid_parameter_error("the tolerance must be positive and finite");
  }
};

/// A formula: a function object that takes a point (`Vector_3`) and returns a size (`double`) or a `Metric_tensor_3`.
/// It is called concurrently, and evaluated anew wherever a vertex is put.
/// \cgalModels `MetricField`
template <class Function>
struct Analytic_metric_field
{
  Function function;

  explicit Analytic_metric_field(Function f) : function(std::move(f)) {}
};

namespace internal {

inline double diagonal_of_bounding_box(const std::vector<Vector_3>& points)
{
  Vector_3 low = points[0], high = points[0];
  for (const Vector_3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

/// Squared inverse size for a curvature, within the bounds of `field`.
struct Curvature_sizing
{
  double tolerance, hmin, hmax;

  template <class Reference>
  Curvature_sizing(const Curvature_metric_field& field, const Reference& reference)
  {
    const double diagonal = diagonal_of_bounding_box(reference.points);
    tolerance = field.relative_tolerance * diagonal;
    hmax = field.hmax > 0 ? field.hmax : 0.1 * diagonal;
    hmin = field.hmin > 0 ? field.hmin : (std::min)(tolerance, hmax);
    if (hmin > hmax) throw Invalid_parameter_error("hmin is larger than hmax");
  }

  double eigenvalue(double curvature) const
  {
    const double l = std::abs(curvature) / (6 * tolerance);
    return (std::min)(1 / (hmin * hmin), (std::max)(1 / (hmax * hmax), l));
  }
};

/// `with_background(execution, field, imported, reference, use)` calls `use(background)` with the metric background
/// that `field` stands for on the reference surface.
template <class Execution, class Import, class Reference, class Use>
void with_background(const Execution&, const Uniform_metric_field& field, const Import&, const Reference&, const Use& use)
{
  use(Metric_background<Isotropic_metric>(field.size));
}

template <class Execution, class Function, class Import, class Reference, class Use>
void with_background(const Execution&, const Analytic_metric_field<Function>& field, const Import&, const Reference&,
                     const Use& use)
{
  using Value = std::decay_t<decltype(field.function(std::declval<const Vector_3&>()))>;
  if constexpr (std::is_same_v<Value, Metric_tensor_3>)
    use(Metric_background<Anisotropic_metric>(Metric_background<Anisotropic_metric>::Formula(field.function)));
  else
    use(Metric_background<Isotropic_metric>(Metric_background<Isotropic_metric>::Formula(field.function)));
}

template <class Execution, class Import, class Reference, class Use>
void with_background(const Execution& execution, const Curvature_metric_field& field, const Import&,
                     const Reference& reference, const Use& use)
{
  const Curvature_sizing sizing(field, reference);
  const std::vector<Metric_tensor_3> curvature = curvature_tensors(execution, reference);
  if (field.anisotropic) {
    std::vector<Metric_tensor_3> tensors(curvature.size());
    for_each_index(execution, curvature.size(), [&](std::size_t v) {
      const Eigen_decomposition_3 e = eigen_decomposition(curvature[v]);
      tensors[v] = metric_tensor(e.values.unaryExpr([&](double k) { return sizing.eigenvalue(k); }), e.vectors);
    });
    return use(Metric_background<Anisotropic_metric>(execution, tensors));
  }
  std::vector<double> sizes(curvature.size());
  for_each_index(execution, curvature.size(), [&](std::size_t v) {
    const double k = eigen_decomposition(curvature[v]).values.cwiseAbs().maxCoeff();
    sizes[v] = 1 / std::sqrt(sizing.eigenvalue(k));
  });
  apply_gradation(execution, reference.mesh, reference.points, field.gradation, sizes);
  use(Metric_background<Isotropic_metric>(execution, std::move(sizes)));
}

/// Any readable property map of the vertices, with sizes or `Metric_tensor_3` as values.
template <class Execution, class PropertyMap, class Import, class Reference, class Use>
void with_background(const Execution& execution, const PropertyMap& map, const Import& imported, const Reference&,
                     const Use& use)
{
  using Value = typename boost::property_traits<PropertyMap>::value_type;
  const std::size_t n = imported.vertices.size();
  if constexpr (std::is_same_v<Value, Metric_tensor_3>) {
    std::vector<Metric_tensor_3> tensors(n);
    for (std::size_t v = 0; v < n; ++v) tensors[v] = get(map, imported.vertices[v]);
    use(Metric_background<Anisotropic_metric>(execution, tensors));
  } else {
    std::vector<double> sizes(n);
    for (std::size_t v = 0; v < n; ++v) sizes[v] = CGAL::to_double(get(map, imported.vertices[v]));
    use(Metric_background<Isotropic_metric>(execution, std::move(sizes)));
  }
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_FIELDS_H

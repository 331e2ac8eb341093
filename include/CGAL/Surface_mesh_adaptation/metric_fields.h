// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of the concept `MetricField`: what `adapt_surface_mesh` can be asked for.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_FIELDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_FIELDS_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/metric/Interpolation_norm.h>

#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

/// The default gradation of isotropic sizes from the curvature. With as many vertices these are as near to the surface
/// as with `default_gradation`, and the faces are better; stretched ones are less near, so that it is not for tensors.
constexpr double default_gradation_of_isotropic_curvature = 1.3;

/// The same edge length everywhere, in the unit of the coordinates.
/// \cgalModels{MetricField}
struct Uniform_metric_field
{
  double size;  ///< the length of the edges

  /// \throws Invalid_parameter_error if the length is not positive and finite
  explicit Uniform_metric_field(double size_) : size(size_)
  {
    if (!(size > 0) || !std::isfinite(size)) throw Invalid_parameter_error("the edge length must be positive and finite");
  }
};

/// Sizes from the curvature of the surface, so that the distance between the surface and its faces stays near a
/// tolerance: the size along a principal direction of curvature `k` is `sqrt(6 tolerance / |k|)`, which is exact where
/// both curvatures have the same sign, and too small by a factor of up to `sqrt(4 / 3)` on saddles. The surface is the
/// smooth one over the faces of the input, or these with `Flat_reconstruction`. After the rounds sizes are tightened
/// around faces that are farther away than that, until there are ten times the vertices. Where faces still are, edges of the
/// input that turn by a third of the `feature_angle` become ridges, and all is done again, up to three times. The report warns
/// of that, and of more than 1.3 times the tolerance. No distance is certified, see the parameter `tolerance` for that,
/// and `for_tolerance()` where that alone counts.
///
/// Lengths are in the unit of the coordinates. An `hmin` above `hmax` or a `max_anisotropy` below 1 makes the adaptation
/// throw an `Invalid_parameter_error`.
/// \cgalModels{MetricField}
struct Curvature_metric_field
{
  double relative_tolerance;   ///< as a fraction of the diagonal of the bounding box; not used with `vertices`
  double hmin = 0;             ///< smallest size; 0: the tolerance itself, with a number of vertices four times that
                               ///< which these come to
  double hmax = 0;             ///< largest size; 0: a tenth of the diagonal, with a number of vertices the diagonal
  bool anisotropic = false;    ///< keep the directions; else the smaller of the two sizes counts in all
  double gradation = 0;        ///< largest ratio of the sizes at two points one size apart, 1: no bound;
                               ///< 0: 1.3, and 1.5 if `anisotropic`
  double max_anisotropy = default_max_anisotropy;  ///< largest ratio of the two sizes at a point
  bool noisy = false;          ///< the points are not quite on the surface (scans): smoother, less accurate curvatures
  std::size_t vertices = 0;    ///< if not 0, the tolerance is that with which the mesh has so many vertices
  bool proximity = true;       ///< let sizes across narrow strips between feature curves, which are kept, fit these,
                               ///< whatever the gradation and the anisotropy (`proximity_tensors()`); if `anisotropic`
  bool corrected = true;       ///< tighten sizes where faces turn out to be farther away than the tolerance

  /// \throws Invalid_parameter_error if the tolerance is not positive and finite
  explicit Curvature_metric_field(double relative_tolerance_) : relative_tolerance(relative_tolerance_)
  {
    if (!(relative_tolerance > 0) || !std::isfinite(relative_tolerance))
      throw Invalid_parameter_error("the tolerance must be positive and finite");
  }

  /// Few faces within a distance of `relative_tolerance` diagonals of the input, which the parameter `tolerance` keeps. Nothing
  /// is corrected: sizes need only be such that little is refused.
  static Curvature_metric_field for_tolerance(double relative_tolerance)
  {
    constexpr double share = 2.0 / 3;
    Curvature_metric_field field(share * relative_tolerance);
    field.corrected = false;
    return field;
  }
};

/// Sizes from a scalar field, given at the vertices, so that the L^p norm of the error of its linear interpolation on
/// the mesh is as small as a number of vertices allows (Loseille, Alauzet 2011). Where the field is linear nothing but
/// `hmax` bounds the sizes: intersect it with a `Curvature_metric_field` to keep the shape. Values that are not finite
/// make the adaptation throw an `Invalid_field_error`.
/// \tparam VertexScalarMap a `ReadablePropertyMap`, vertex descriptors as keys, values convertible to `double`
/// \cgalModels{MetricField}
template <class VertexScalarMap>
struct Solution_metric_field
{
  VertexScalarMap values;  ///< of the field
  std::size_t vertices;        ///< the number of vertices that the mesh is to have
  double norm = 2;             ///< p, at least 1: the smaller, the more weight for weak features; may be infinite
  double hmin = 0;             ///< smallest size; 0: 1e-6 diagonals of the bounding box
  double hmax = 0;             ///< largest size; 0: the diagonal
  bool anisotropic = false;    ///< keep the directions; else the smaller of the two sizes counts in all
  double gradation = default_gradation;            ///< largest ratio of the sizes at two points one size apart
  double max_anisotropy = default_max_anisotropy;  ///< largest ratio of the two sizes at a point

  /// \throws Invalid_parameter_error if the number of vertices is below 4
  Solution_metric_field(VertexScalarMap values_, std::size_t vertices_) : values(std::move(values_)), vertices(vertices_)
  {
    if (vertices < 4) throw Invalid_parameter_error("the number of vertices asked for must be at least 4");
  }
};

/// What several fields ask for at once: the intersection of their metrics at the vertices of the input, anisotropic if
/// one of them is. The gradation of the fields does not count, that of the intersection does. Of a single field, for
/// instance a property map, it is what bounds, grades and scales it to a number of vertices.
/// \tparam MetricFields models of `MetricField`, property maps of the vertices included
/// \cgalModels{MetricField}
template <class... MetricFields>
struct Intersection_metric_field
{
  std::tuple<MetricFields...> fields;  ///< whose metrics are intersected
  double gradation = default_gradation;  ///< largest ratio of the sizes at two points one size apart
  std::size_t vertices = 0;    ///< if not 0, the intersection is scaled so that the mesh has so many vertices
  double hmin = 0;             ///< smallest size once it is scaled; 0: 1e-6 diagonals of the bounding box
  double hmax = 0;             ///< largest size once it is scaled; 0: the diagonal

  /// \param fields_ one at least
  explicit Intersection_metric_field(MetricFields... fields_) : fields(std::move(fields_)...) {}
};

/// A formula: a function object that takes a point (`Vector_3`) and returns a size (`double`) or a `Metric_tensor_3`.
/// It is called concurrently, and evaluated anew wherever a vertex is put, at points of the surface. A value
/// that is not positive (definite) and finite makes the adaptation throw an `Invalid_parameter_error`.
/// \cgalModels{MetricField}
template <class Function>
struct Analytic_metric_field
{
  Function function;  ///< the formula

  /// \param f called concurrently
  explicit Analytic_metric_field(Function f) : function(std::move(f)) {}
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_FIELDS_H

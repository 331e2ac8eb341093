// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many vertices a metric asks for, and how to scale it so that it asks for a given number.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_METRIC_NORMALIZATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_METRIC_NORMALIZATION_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/Size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

/// What a metric measures on a surface, over the area and along the boundary.
struct Metric_complexity
{
  double area = 0;             ///< integral of sqrt(det M): the area in units of the metric
  double boundary_length = 0;  ///< length of the boundary in units of the metric
};

/// Number of faces per unit of area, over that of equilateral triangles with edges of length 1, `4 / sqrt(3)`: a mesh
/// fits its metric on average only. Measured with the driver of this package: 0.97 to 1.08 on spheres, tori and a
/// square with a shock, up to 1.17 on mechanical parts with many ridges.
constexpr double default_packing = 1.04;

/// How closely a metric is scaled to a number of vertices: relative.
constexpr double normalization_precision = 0.01;

/// The number of vertices of a mesh with unit edges in a metric of this complexity: `2 packing C / sqrt(3)`, plus half
/// the number of boundary edges and the Euler characteristic.
template <class Execution>
double expected_number_of_vertices(const Execution& execution, const Mesh_view& mesh,
                                   const Metric_complexity& complexity, double packing = default_packing)
{
  const std::size_t faces = mesh.number_of_faces();
  const std::size_t borders = count_if(execution, mesh.number_of_halfedges(), [&](std::size_t h) {
    return mesh.is_border(Index(h));
  });
  // V - E + F, with 3 F = 2 E - B
  const double euler = double(mesh.number_of_vertices()) - double(faces + borders) / 2;
  return packing * 2 / std::sqrt(3.0) * complexity.area + complexity.boundary_length / 2 + euler;
}

namespace internal {

/// Nodes and weights of the quadrature of degree 5 on a triangle (Radon 1948).
struct Triangle_quadrature
{
  static constexpr std::size_t size = 7;
  std::array<std::array<double, 3>, size> nodes;
  std::array<double, size> weights;

  Triangle_quadrature()
  {
    const double root = std::sqrt(15.0);
    nodes[0] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    weights[0] = 9.0 / 40;
    std::size_t n = 1;
    for (const double sign : {1.0, -1.0}) {
      const double a = (6 + sign * root) / 21, weight = (155 + sign * root) / 1200;
      for (std::size_t i = 0; i < 3; ++i, ++n) {
        nodes[n] = {a, a, a};
        nodes[n][i] = 1 - 2 * a;
        weights[n] = weight;
      }
    }
  }
};

/// How the background interpolates sizes between vertices: linearly.
struct Size_integrand
{
  const std::vector<double>& sizes;

  double at_corner(Index v, const Vector_3&) const { return sizes[v]; }
  static double density(double size) { return 1 / (size * size); }
  double length(Index v, const Vector_3& e) const { return e.norm() / sizes[v]; }
};

/// How the background interpolates tensors: in the log-Euclidean sense, so that densities vary exponentially.
struct Tensor_integrand
{
  const std::vector<Metric_tensor_3>& tensors;

  /// `log sqrt(n^T adj(M) n)`: the determinant of `M` in the plane across `n`.
  double at_corner(Index v, const Vector_3& n) const
  {
    const Metric_tensor_3& m = tensors[v];
    const double xx = m[2] * m[5] - m[4] * m[4], xy = m[3] * m[4] - m[1] * m[5], yy = m[0] * m[5] - m[3] * m[3],
                 xz = m[1] * m[4] - m[2] * m[3], yz = m[1] * m[3] - m[0] * m[4], zz = m[0] * m[2] - m[1] * m[1];
    return std::log((std::max)(Metric_tensor_3(xx, xy, yy, xz, yz, zz).squared_length(n),
                               (std::numeric_limits<double>::min)())) / 2;
  }
  static double density(double logarithm) { return std::exp(logarithm); }
  double length(Index v, const Vector_3& e) const { return tensors[v].length(e); }
};

template <class Execution, class Integrand>
Metric_complexity integrate(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                            const Corner_normals& normals, const Integrand& integrand)
{
  const Triangle_quadrature quadrature;
  return accumulate(execution, mesh.number_of_faces(), Metric_complexity(), [&](Metric_complexity& sum, std::size_t f) {
    std::array<double, 3> value;
    for (Index i = 0; i < 3; ++i) {
      const Index h = 3 * Index(f) + i;
      value[i] = integrand.at_corner(mesh.source(h), normals.at(h));
      if (!mesh.is_border(h)) continue;
      const Vector_3 e = points[mesh.target(h)] - points[mesh.source(h)];
      sum.boundary_length += (integrand.length(mesh.source(h), e) + integrand.length(mesh.target(h), e)) / 2;
    }
    double mean = 0;
    for (std::size_t k = 0; k < quadrature.size; ++k) {
      const auto& b = quadrature.nodes[k];
      mean += quadrature.weights[k] * Integrand::density(b[0] * value[0] + b[1] * value[1] + b[2] * value[2]);
    }
    sum.area += face_normal(mesh, points, 3 * Index(f)).norm() / 2 * mean;
  }, [](const Metric_complexity& a, const Metric_complexity& b) {
    return Metric_complexity{a.area + b.area, a.boundary_length + b.boundary_length};
  });
}

} // namespace internal

/// The complexity of a field of sizes at the vertices, interpolated linearly over the faces.
template <class Execution>
Metric_complexity complexity(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                             const Corner_normals& normals, const std::vector<double>& sizes)
{
  return internal::integrate(execution, mesh, points, normals, internal::Size_integrand{sizes});
}

/// The complexity of a field of tensors at the vertices. \pre all are positive definite
template <class Execution>
Metric_complexity complexity(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                             const Corner_normals& normals, const std::vector<Metric_tensor_3>& tensors)
{
  return internal::integrate(execution, mesh, points, normals, internal::Tensor_integrand{tensors});
}

/// A metric at the vertices up to scale: with scale `d` its eigenvalues are `d` times those of `tensors`, then kept
/// within the bounds, and its growth is limited; at last it is intersected with `fixed`. Where a tensor is zero the size
/// is `hmax`.
struct Scalable_metric
{
  std::vector<Metric_tensor_3> tensors;  ///< positive definite, or zero
  Size_bounds bounds;  ///< of the sizes
  double gradation = default_gradation;  ///< at most 1: off
  std::vector<Metric_tensor_3> fixed = {}; ///< at any scale, as `tensors`, or empty: counts for tensors, not for sizes
  double least_size = 0; ///< times 1 / d: a smallest size that falls as the metric gets finer

  /// Those of the sizes at the scale `d`.
  Size_bounds bounds_at(double d) const
  {
    return Size_bounds((std::min)((std::max)(bounds.hmin, least_size / d), bounds.hmax), bounds.hmax);
  }
};

namespace internal {

/// Sizes of the metric of scale `d`, for multiples of the identity, without gradation.
template <class Execution>
void scale(const Execution& execution, const Scalable_metric& m, double d, std::vector<double>& sizes)
{
  sizes.resize(m.tensors.size());
  const Size_bounds bounds = m.bounds_at(d);
  for_each_index(execution, sizes.size(), [&](std::size_t v) {
    sizes[v] = 1 / std::sqrt(bounds.clamped(d * m.tensors[v][0]));
  });
}

template <class Execution>
void scale(const Execution& execution, const Scalable_metric& m, double d, std::vector<Metric_tensor_3>& tensors)
{
  tensors.resize(m.tensors.size());
  const Size_bounds bounds = m.bounds_at(d);
  for_each_index(execution, tensors.size(), [&](std::size_t v) {
    const Eigen_decomposition_3 e = eigen_decomposition(m.tensors[v]);
    tensors[v] = metric_tensor(e.values.unaryExpr([&](double l) { return bounds.clamped(d * l); }), e.vectors);
  });
}

template <class Execution>
void grade(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points, const Corner_normals&,
           double ratio, std::vector<double>& sizes)
{
  apply_gradation(execution, mesh, points, ratio, sizes);
}

/// The smallest sizes that the tensors ask for in any direction, graded.
template <class Execution>
std::vector<double> isotropic_sizes(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                                    double ratio, const std::vector<Metric_tensor_3>& tensors)
{
  std::vector<double> sizes(tensors.size());
  for_each_index(execution, sizes.size(), [&](std::size_t v) {
    sizes[v] = 1 / std::sqrt(eigen_decomposition(tensors[v]).values[2]);
  });
  apply_gradation(execution, mesh, points, ratio, sizes);
  return sizes;
}

/// Tensors that meet in ever other directions, as on needles, may come out of the gradation asking for more vertices
/// than the isotropic sizes that give each what it asks for. These take their place then.
template <class Execution>
void grade(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
           const Corner_normals& normals, double ratio, std::vector<Metric_tensor_3>& tensors)
{
  if (!(ratio > 1)) return;
  const std::vector<double> sizes = isotropic_sizes(execution, mesh, points, ratio, tensors);
  apply_gradation(execution, mesh, points, normals, ratio, tensors);
  if (complexity(execution, mesh, points, normals, tensors).area <
      complexity(execution, mesh, points, normals, sizes).area)
    return;
  for_each_index(execution, sizes.size(), [&](std::size_t v) { tensors[v] = Metric_tensor_3::isotropic(sizes[v]); });
}

template <class Execution>
void intersect(const Execution&, const std::vector<Metric_tensor_3>&, std::vector<double>&)
{}

/// Intersects `tensors` with those of `others` that are not zero, if there are any.
template <class Execution>
void intersect(const Execution& execution, const std::vector<Metric_tensor_3>& others,
               std::vector<Metric_tensor_3>& tensors)
{
  for_each_index(execution, others.size(), [&](std::size_t v) {
    if (others[v].matrix().trace() > 0) tensors[v] = intersection(tensors[v], others[v]);
  });
}

/// The smallest and the largest trace, zeros not counted.
template <class Execution>
std::pair<double, double> range_of_traces(const Execution& execution, const std::vector<Metric_tensor_3>& tensors)
{
  using Range = std::pair<double, double>;
  const Range none(std::numeric_limits<double>::infinity(), 0);
  return reduce(execution, tensors.size(), none, [&](std::size_t v) {
    const double trace = tensors[v].matrix().trace();
    return trace > 0 ? Range(trace, trace) : none;
  }, [](const Range& a, const Range& b) {
    return Range((std::min)(a.first, b.first), (std::max)(a.second, b.second));
  });
}

/// The metric with sizes where nothing was asked for: the largest that are asked for elsewhere, or everywhere the same.
template <class Execution>
Scalable_metric without_zeros(const Execution& execution, const Scalable_metric& metric, double least_trace)
{
  Scalable_metric result = metric;
  const double eigenvalue = std::isfinite(least_trace) ? least_trace / 3 : 1;
  for_each_index(execution, result.tensors.size(), [&](std::size_t v) {
    Metric_tensor_3& m = result.tensors[v];
    if (!(m.matrix().trace() > 0)) m = Metric_tensor_3(eigenvalue, 0, eigenvalue, 0, 0, eigenvalue);
  });
  return result;
}

/// Finds `x` in `[low, high]` with `f(x) = 0` to within `tolerance`, or the end that is nearer to it, for `f` that does
/// not decrease: secants through the last two points, and halves of the bracket where they leave it. The slope of the
/// first is 1 below zero, and above as measured on metrics that gradation made that much too fine.
template <class F>
double solve_increasing(const F& f, double low, double high, double start, double tolerance)
{
  double x = start, slope = 0, last_x = 0, last_value = 0;
  for (int i = 0; high - low > tolerance / 16; ++i) {
    const double value = f(x);
    if (std::abs(value) <= tolerance) return x;
    (value < 0 ? low : high) = x;
    if (i == 0) slope = 1 / (1 + 0.6 * (std::max)(0.0, value));
    else if ((value - last_value) * (x - last_x) > 0) slope = std::clamp((value - last_value) / (x - last_x), 0.2, 5.0);
    last_x = x;
    last_value = value;
    x -= value / slope;
    if (!(x > low && x < high)) x = (low + high) / 2;
  }
  return x;
}

} // namespace internal

/// The metric of scale `d`, `metric_at_scale<double>` as sizes (for tensors that are multiples of the identity),
/// `metric_at_scale<Metric_tensor_3>` as tensors.
template <class Value, class Execution>
std::vector<Value> metric_at_scale(const Execution& execution, const Mesh_view& mesh,
                                   const std::vector<Vector_3>& points, const Corner_normals& normals,
                                   const Scalable_metric& metric, double d)
{
  std::vector<Value> values;
  internal::scale(execution, metric, d, values);
  internal::grade(execution, mesh, points, normals, metric.gradation, values);
  internal::intersect(execution, metric.fixed, values);
  return values;
}

/// The metric of the scale at which a mesh with unit edges has `number_of_vertices`, to within one percent, if the
/// bounds allow it: else as near as they do. Where a tensor is zero the size is the largest one elsewhere. The bounds and
/// the gradation hold in the result, for the scale is solved for with both: first with the bounds alone, whose number of
/// vertices is cheap to find, then with the gradation.
/// (Where tensors with different directions meet, the gradation may ask for sizes a little below `hmin`.)
/// \par Complexity
/// O(n) for each of about five to ten evaluations, and three to four gradations
template <class Value, class Execution>
std::vector<Value> normalize_to_vertex_count(const Execution& execution, const Mesh_view& mesh,
                                             const std::vector<Vector_3>& points, const Corner_normals& normals,
                                             const Scalable_metric& asked, double number_of_vertices,
                                             double packing = default_packing)
{
  if (!(number_of_vertices >= 4) || !std::isfinite(number_of_vertices))
    throw Invalid_parameter_error("the number of vertices asked for must be at least 4");
  const Scalable_metric metric =
    internal::without_zeros(execution, asked, internal::range_of_traces(execution, asked.tensors).first);
  const auto [least, largest] = internal::range_of_traces(execution, metric.tensors);
  std::vector<Value> values;
  const auto excess = [&] {
    const Metric_complexity c = complexity(execution, mesh, points, normals, values);
    return std::log((std::max)(1.0, expected_number_of_vertices(execution, mesh, c, packing)) / number_of_vertices);
  };
  // from where all sizes are hmax to where all are hmin
  const double low = -std::log(largest * metric.bounds.hmax * metric.bounds.hmax),
               high = (std::max)(low, std::log(1e12 / (least * metric.bounds.hmin * metric.bounds.hmin)));
  const double start = internal::solve_increasing([&](double log_scale) {
    internal::scale(execution, metric, std::exp(log_scale), values);
    return excess();
  }, low, high, low, normalization_precision);
  if (!(metric.gradation > 1) && metric.fixed.empty()) return values;
  internal::solve_increasing([&](double log_scale) {
    values = metric_at_scale<Value>(execution, mesh, points, normals, metric, std::exp(log_scale));
    return excess();
  }, low, high, start, normalization_precision);
  return values;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_METRIC_NORMALIZATION_H

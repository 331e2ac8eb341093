// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric as a function on the reference surface: interpolated between the vertices of the input, hence never
// diffused by repeated interpolation, or evaluated from a formula of the user.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_METRIC_BACKGROUND_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_METRIC_BACKGROUND_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/Growth_on_planes.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// The first index in `[0, n)` without `is_valid`, or `n`.
template <class Execution, class IsValid>
std::size_t first_invalid(const Execution& execution, std::size_t n, const IsValid& is_valid)
{
  return reduce(execution, n, n, [&](std::size_t i) { return is_valid(i) ? n : i; },
                [](std::size_t a, std::size_t b) { return (std::min)(a, b); });
}

/// Whether a size and its metric are positive and finite.
inline bool is_valid_size(double size) { return size > 0 && std::isnormal(size * size) && std::isnormal(1 / (size * size)); }

[[noreturn]] inline void throw_invalid_formula(const Vector_3& p)
{
  throw Invalid_parameter_error("the metric is not finite and positive definite at the point (" + std::to_string(p[0]) +
                                ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) + ")");
}

} // namespace internal

/// What an adapted mesh is to reach beyond unit edges.
struct Metric_aims
{
  double number_of_vertices = 0; ///< 0: any
  double deviation = 0;          ///< largest distance of its faces from the surface; 0: any
  std::vector<double> deviation_of_face = {}; ///< the same above each face of the input; empty: everywhere that one
  double hmin = 0;               ///< smallest size of a metric that is tightened for that
  double gradation = 1;          ///< and its gradation
  Growth_on_planes growth = {};  ///< of sizes between the vertices
};

template <class Metric> class Metric_background;

/// Sizes at the vertices of the reference, interpolated linearly, or a formula.
template <>
class Metric_background<Isotropic_metric>
{
public:
  using Formula = std::function<double(const Vector_3&)>;

  /// One size everywhere.
  explicit Metric_background(double size) : uniform_(1 / size)
  {
    if (!(size > 0) || !std::isfinite(size)) throw Invalid_parameter_error("the size must be positive and finite");
  }

  /// \throws Invalid_metric_error for a size that is not positive and finite
  template <class Execution>
  Metric_background(const Execution& execution, std::vector<double> sizes, const Metric_aims& aims = {})
    : sizes_(std::move(sizes)), aims_(aims)
  {
    const std::size_t bad = internal::first_invalid(execution, sizes_.size(), [&](std::size_t v) {
      return internal::is_valid_size(sizes_[v]);
    });
    if (bad < sizes_.size()) throw Invalid_metric_error(bad);
  }

  explicit Metric_background(Formula formula) : formula_(std::move(formula)) {}

  /// The number of vertices that an adapted mesh is to have; 0: any.
  const Metric_aims& aims() const { return aims_; }

  template <class Reference>
  Isotropic_metric at(const Reference& reference, const Location& l, const Surface_point& p) const
  {
    if (uniform_ > 0) return {uniform_};
    if (formula_) {
      const double size = formula_(p.position);
      if (!internal::is_valid_size(size)) internal::throw_invalid_formula(p.position);
      return {1 / size};
    }
    const auto i = reference.interpolation(l);
    const double size = i.weights[0] * sizes_[i.vertices[0]] + i.weights[1] * sizes_[i.vertices[1]] +
                        i.weights[2] * sizes_[i.vertices[2]];
    return {1 / aims_.growth.at(reference, l, p.position, size)};
  }

private:
  double uniform_ = 0;
  std::vector<double> sizes_;
  Metric_aims aims_;
  Formula formula_;
};

/// Tensors at the vertices of the reference, transported to the point by the minimal rotation between the normals and
/// interpolated there in the log-Euclidean sense, or a formula.
template <>
class Metric_background<Anisotropic_metric>
{
public:
  using Formula = std::function<Metric_tensor_3(const Vector_3&)>;

  /// \throws Invalid_metric_error for a tensor that is not finite and positive definite
  template <class Execution>
  Metric_background(const Execution& execution, const std::vector<Metric_tensor_3>& tensors,
                    const Metric_aims& aims = {})
    : logarithms_(tensors.size()), aims_(aims)
  {
    const std::size_t bad = internal::first_invalid(execution, tensors.size(), [&](std::size_t v) {
      return is_positive_definite(tensors[v]);
    });
    if (bad < tensors.size()) throw Invalid_metric_error(bad);
    for_each_index(execution, tensors.size(), [&](std::size_t v) { logarithms_[v] = log(tensors[v]); });
  }

  explicit Metric_background(Formula formula) : formula_(std::move(formula)) {}

  /// The number of vertices that an adapted mesh is to have; 0: any.
  const Metric_aims& aims() const { return aims_; }

  template <class Reference>
  Anisotropic_metric at(const Reference& reference, const Location& l, const Surface_point& p) const
  {
    if (formula_) {
      const Metric_tensor_3 m = formula_(p.position);
      if (!is_positive_definite(m)) internal::throw_invalid_formula(p.position);
      return {m};
    }
    const auto i = reference.interpolation(l);
    Metric_tensor_3 sum(0, 0, 0, 0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      if (i.weights[k] == 0) continue;
      const Metric_tensor_3& m = logarithms_[i.vertices[k]];
      if (l.kind == Vertex_class::smooth) {
        const Vector_3& n = reference.normals.at(3 * l.cell + Index(k));
        sum += i.weights[k] * rotated(m, minimal_rotation(n, p.normal));
      } else sum += i.weights[k] * m;
    }
    return {exp(sum)};
  }

private:
  std::vector<Metric_tensor_3> logarithms_;
  Metric_aims aims_;
  Formula formula_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_METRIC_BACKGROUND_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Intersection of metrics: the sizes that several metrics ask for at once.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_INTERSECTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_INTERSECTION_H

#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Cholesky.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

/// The largest metric whose unit ball lies in both unit balls, by simultaneous reduction. Commutative and
/// idempotent, not associative. In the form `R max(1, R^-1 B R^-T) R^T` with a root `R R^T` of `A`, here the factor of
/// Cholesky, it is exact for homothetic tensors, where the eigenvectors of `A^-1 B` are lost.
/// \pre both are positive definite
inline Metric_tensor_3 intersection(const Metric_tensor_3& a, const Metric_tensor_3& b)
{
  const internal::Cholesky<3> root(a.matrix());
  const Matrix_3 half = root.solve_lower(b.matrix());
  const Eigen_decomposition_3 e = eigen_decomposition(Metric_tensor_3(root.solve_lower(Matrix_3(half.transpose()))));
  const Matrix_3 q = root.lower() * e.vectors;
  return Metric_tensor_3(Matrix_3(q * e.values.cwiseMax(1.0).asDiagonal() * q.transpose()));
}

namespace internal {

/// A metric with its determinant, ordered by decreasing determinant, ties by the coefficients: an order that depends on
/// nothing but the metrics.
struct Ranked_metric
{
  Metric_tensor_3 metric;
  double determinant;

  explicit Ranked_metric(const Metric_tensor_3& m) : metric(m), determinant(m.matrix().determinant()) {}

  friend bool operator<(const Ranked_metric& a, const Ranked_metric& b)
  {
    if (a.determinant != b.determinant) return a.determinant > b.determinant;
    int i = 0;
    while (i < 5 && a.metric[i] == b.metric[i]) ++i;
    return a.metric[i] > b.metric[i];
  }
};

} // namespace internal

/// The intersection of all `metrics` (a range of `Metric_tensor_3`), folded by decreasing determinant, ties by the
/// coefficients: intersection is not associative, but the result does not depend on the order of the range. Zero if it
/// is empty. \pre all are positive definite
template <class Metrics>
Metric_tensor_3 intersection_of_all(const Metrics& metrics)
{
  boost::container::small_vector<internal::Ranked_metric, 16> ranked;
  for (const Metric_tensor_3& m : metrics) ranked.emplace_back(m);
  if (ranked.empty()) return Metric_tensor_3(0, 0, 0, 0, 0, 0);
  std::sort(ranked.begin(), ranked.end());
  Metric_tensor_3 result = ranked.front().metric;
  for (std::size_t i = 1; i < ranked.size(); ++i) result = intersection(result, ranked[i].metric);
  return result;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_METRIC_INTERSECTION_H

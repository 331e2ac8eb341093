// SPDX-License-Identifier: GPL-3.0-or-later
//
// Intersection of metrics: the sizes that several metrics ask for at once.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_INTERSECTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_INTERSECTION_H

#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The largest metric whose unit ball lies in both unit balls, by simultaneous reduction. Commutative and
/// idempotent, not associative. In the form `A^(1/2) max(1, A^(-1/2) B A^(-1/2)) A^(1/2)` it is exact for
/// homothetic tensors, where the eigenvectors of `A^-1 B` are lost. \pre both are positive definite
inline Metric_tensor_3 intersection(const Metric_tensor_3& a, const Metric_tensor_3& b)
{
  const Eigen_decomposition_3 ea = eigen_decomposition(a);
  const Vector_3 root = ea.values.array().sqrt().matrix();
  const Matrix_3 half = ea.vectors * root.asDiagonal() * ea.vectors.transpose();
  const Matrix_3 inverse_half = ea.vectors * root.cwiseInverse().asDiagonal() * ea.vectors.transpose();
  const Eigen_decomposition_3 es = eigen_decomposition(Metric_tensor_3(Matrix_3(inverse_half * b.matrix() * inverse_half)));
  const Matrix_3 q = half * es.vectors;
  return Metric_tensor_3(Matrix_3(q * es.values.cwiseMax(1.0).asDiagonal() * q.transpose()));
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

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_INTERSECTION_H

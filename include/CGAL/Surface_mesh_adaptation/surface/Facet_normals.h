// SPDX-License-Identifier: GPL-3.0-or-later
//
// The normals of the facets around a vertex as a sample of what the normal there may be.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACET_NORMALS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACET_NORMALS_H

#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Unit normals weighted by the areas of their facets. \pre of mean and variance: not `empty()`
class Facet_normals
{
public:
  /// A facet of which `n` is the normal, as long as twice its area; degenerate ones do not count.
  void add(const Vector_3& n)
  {
    const double area = n.norm();
    if (!(area > 0)) return;
    sum_ += n;
    squares_ += outer_product(n, n / area);
    area_ += area;
  }

  /// Whether no facet was added that has a normal, or all cancel.
  bool empty() const { return !(sum_.squaredNorm() > 0); }
  Vector_3 mean() const { return sum_.normalized(); }

  /// Mean square of the differences from their mean: of the angles to it, in radians, where these are small.
  double variance() const { return 1 - sum_.squaredNorm() / (area_ * area_); }

  /// The part of it along the unit vector `d`.
  double variance(const Vector_3& d) const
  {
    const double mean = sum_.dot(d) / area_;
    return d.dot(Vector_3(squares_ * d)) / area_ - mean * mean;
  }

private:
  Vector_3 sum_ = Vector_3::Zero();
  Matrix_3 squares_ = Matrix_3::Zero();
  double area_ = 0;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACET_NORMALS_H

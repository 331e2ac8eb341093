// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_QUADRIC_3_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_QUADRIC_3_H

#include <CGAL/Surface_mesh_adaptation/numerics/Cholesky.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// A weighted sum of squared distances from planes, as a function of the point (M. Garland, P. Heckbert, *Surface
/// simplification using quadric error metrics*, 1997), and the area that the planes stand for.
class Quadric_3
{
public:
  /// Adds the plane through `p` with the unit normal `n`.
  void add_plane(const Vector_3& p, const Vector_3& n, double weight)
  {
    const double height = n.dot(p);
    matrix_ += internal::outer_product(weight * n, n);
    vector_ += weight * height * n;
    constant_ += weight * height * height;
  }

  void add_area(double area) { area_ += area; }

  Quadric_3& operator+=(const Quadric_3& o)
  {
    matrix_ += o.matrix_;
    vector_ += o.vector_;
    constant_ += o.constant_;
    area_ += o.area_;
    return *this;
  }

  double operator()(const Vector_3& p) const
  {
    return (std::max)(0.0, p.dot(Vector_3(matrix_ * p)) - 2 * vector_.dot(p) + constant_);
  }

  double area() const { return area_; }

  /// Where the sum is least; `guess` decides as far as the planes leave that open.
  Vector_3 minimum(const Vector_3& guess, double attraction) const
  {
    const double pull = attraction * matrix_.trace();
    if (!(pull > 0)) return guess;
    const internal::Cholesky<3> factors(internal::shifted(matrix_, pull));
    const Vector_3 d = factors.solve(vector_ - Vector_3(matrix_ * guess));
    return d.allFinite() ? guess + d : guess;
  }

private:
  Matrix_3 matrix_ = Matrix_3::Zero();
  Vector_3 vector_ = Vector_3::Zero();
  double constant_ = 0;
  double area_ = 0;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_QUADRIC_3_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CLOSEST_POINT_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CLOSEST_POINT_H

#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

struct Closest_point
{
  std::array<double, 3> weights;  ///< barycentric coordinates
  Vector_3 offset;                ///< from the closest point to the one asked for
};

/// The point of the triangle `abc` that is closest to `p`: the corner, edge or inside in whose Voronoi cell `p` lies.
inline Closest_point closest_point_of_triangle(const Vector_3& p, const Vector_3& a, const Vector_3& b, const Vector_3& c)
{
  const Vector_3 ab = b - a, ac = c - a, ap = p - a;
  const auto at = [&](double v, double w) { return Closest_point{{1 - v - w, v, w}, ap - v * ab - w * ac}; };
  const double ab2 = ab.squaredNorm(), ac2 = ac.squaredNorm(), ab_ac = ab.dot(ac);
  const double b_at_a = ab.dot(ap), c_at_a = ac.dot(ap); // products of both edges with the way from a, b and c to p
  const double b_at_b = b_at_a - ab2, c_at_b = c_at_a - ab_ac;
  const double b_at_c = b_at_a - ab_ac, c_at_c = c_at_a - ac2;
  if (b_at_a <= 0 && c_at_a <= 0) return at(0, 0);
  if (b_at_b >= 0 && c_at_b <= b_at_b) return at(1, 0);
  if (c_at_c >= 0 && b_at_c <= c_at_c) return at(0, 1);

  const double c_weight = b_at_a * c_at_b - b_at_b * c_at_a; // times the squared double area, as the other two
  if (c_weight <= 0 && b_at_a >= 0 && b_at_b <= 0) return at(b_at_a / ab2, 0);
  const double b_weight = b_at_c * c_at_a - b_at_a * c_at_c;
  if (b_weight <= 0 && c_at_a >= 0 && c_at_c <= 0) return at(0, c_at_a / ac2);
  const double a_weight = b_at_b * c_at_c - b_at_c * c_at_b;
  const double from_b = c_at_b - b_at_b, from_c = b_at_c - c_at_c;
  if (a_weight <= 0 && from_b >= 0 && from_c >= 0) return at(from_c / (from_b + from_c), from_b / (from_b + from_c));
  const double sum = a_weight + b_weight + c_weight;
  return at(b_weight / sum, c_weight / sum);
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CLOSEST_POINT_H

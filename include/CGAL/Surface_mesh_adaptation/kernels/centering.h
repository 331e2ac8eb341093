// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the faces around a vertex draw it (paper, section 3, equation 1): to their centre of mass, which makes the mesh as
// dense as the metric asks for, and to where they would be equilateral.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CENTERING_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CENTERING_H

#include <CGAL/Surface_mesh_adaptation/metric/metric.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The mean of two displacements for each face, weighted by the masses of the faces: to its centre of mass, and to where
/// it would be equilateral in the metric.
struct Pull
{
  Vector_3 edges = Vector_3::Zero();        ///< masses times the sums of the two edge vectors of each face
  Vector_3 turned_sides = Vector_3::Zero(); ///< the sum of the weighted sides, each by a quarter turn
  double mass = 0;

  /// Adds a face but for its weighted side, which is returned. `ea` and `eb` are the edge vectors from the vertex, which
  /// has the metric `v`, to the two other corners.
  template <class Metric>
  Vector_3 add(const Metric& v, const Metric& a, const Metric& b, const Vector_3& ea, const Vector_3& eb, double area)
  {
    const double m = face_mass(v, a, b, ea, eb, area);
    edges += m * (ea + eb);
    mass += m;
    return weighted_side(v, a, b, eb - ea, area);
  }

  /// `share` of the way is that to where the faces would be equilateral.
  Vector_3 displacement(double share) const
  {
    if (!(mass > 0)) return Vector_3::Zero();
    const double height = std::sqrt(3.0) / 2; // of an equilateral triangle
    return (((1 - share) / 3 + share / 2) * edges + share * height * turned_sides) / mass;
  }
};

/// The displacement of a smooth vertex at `p` to the centre of the faces around it, in the tangent plane.
/// `for_each_face(f)` calls `f` with the points and metrics of the two other corners of each.
template <class Metric, class ForEachFace>
Vector_3 displacement_to_center(const Vector_3& p, const Vector_3& normal, const Metric& metric,
                                const ForEachFace& for_each_face)
{
  constexpr double share_of_shape = 0.4; // more shape costs conformity in length
  Pull pull;
  Vector_3 sides = Vector_3::Zero();
  for_each_face([&](const Vector_3& a, const Metric& metric_a, const Vector_3& b, const Metric& metric_b) {
    const Vector_3 ea = a - p, eb = b - p;
    sides += pull.add(metric, metric_a, metric_b, ea, eb, ea.cross(eb).dot(normal));
  });
  pull.turned_sides = normal.cross(sides);
  const Vector_3 sum = pull.displacement(share_of_shape);
  return sum - sum.dot(normal) * normal;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CENTERING_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cubic curve over an edge, by the normals or the tangents at its ends. All formulas are such that they give the
// same bits when the edge is seen from its other end.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CUBIC_CURVE_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CUBIC_CURVE_H

#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// From the ends of an edge to the inner control points next to them.
struct Cubic_handles
{
  Vector_3 start, end;
  bool is_straight;  ///< whether the normals or a tangent say nothing about the curve, so that the chord stands in
};

/// By how much the curve is off the middle of its edge.
inline Vector_3 bulge(const Cubic_handles& h) { return 0.375 * (h.start + h.end); }

/// The chord.
inline Cubic_handles straight_handles(const Vector_3& e)
{
  const Vector_3 third = (1.0 / 3) * e;
  return {third, -third, true};
}

/// How far the curve over `e` with the handles `h` gets from the points of `e` with the same parameters: at its middle or,
/// where one handle says more than the other, a third of the way. Too small by about a tenth at most.
inline double largest_bulge(const Cubic_handles& h, const Vector_3& e)
{
  const Vector_3 third = (1.0 / 3) * e;
  const double at_third = 4.0 / 9 * (std::max)((h.start - third).norm(), (h.end + third).norm());
  return (std::max)(bulge(h).norm(), at_third);
}

/// By which factor that curve is to be brought nearer to `e` so that it leaves it by no more than `largest`; less than 1 only if
/// it does.
inline double share_within(double largest, const Cubic_handles& h, const Vector_3& e)
{
  return std::isfinite(largest) ? largest / largest_bulge(h, e) : 1;
}

/// That curve brought nearer to `e` by the factor `share`.
inline Cubic_handles lowered(const Cubic_handles& h, const Vector_3& e, double share)
{
  const Vector_3 third = (1.0 / 3) * e;
  return {share * (h.start - third) + third, share * (h.end + third) - third, h.is_straight};
}

/// The curve over `e`, orthogonal to the unit normals at its ends, that has the least integral of its squared second
/// derivative: that of Walton and Meek (1996), with its division by the length of `e` cancelled.
inline Cubic_handles walton_meek_handles(const Vector_3& e, const Vector_3& na, const Vector_3& nb)
{
  const double length2 = e.squaredNorm(), x = na.dot(e), y = nb.dot(e), c = na.dot(nb);
  const Vector_3 third = (1.0 / 3) * e;
  // 35 degrees out of a tangent plane (an icosahedron has 32; a faceted bore, whose needles would bulge, more), or
  // normals 120 degrees apart
  if (!(3 * x * x < length2 && 3 * y * y < length2 && c > -0.5)) return straight_handles(e);
  const double k = 1 / (3 * (4 - c * c)), p = k * (2 * x + c * y), q = k * (2 * y + c * x);
  return {(third - 2 * p * na) + q * nb, (2 * q * nb - third) - p * na, false};
}

/// That curve with handles as long as those of a helix. Where the normals turn by an angle t along the edge, in any
/// direction, handles shorter by t^2 / 48 leave the middle of a geodesic with the curvature k inside by k t^2 e^2 / 384.
/// Measured: the rms distance of patches is .004 of what it is without on spheres and cylinders, .35 on the torus, .7 on
/// the ellipsoid.
inline Cubic_handles smooth_handles(const Vector_3& e, const Vector_3& na, const Vector_3& nb)
{
  const Cubic_handles h = walton_meek_handles(e, na, nb);
  if (h.is_straight) return h;
  const double scale = 1 + (nb - na).squaredNorm() / 48;
  return {scale * h.start, scale * h.end, false};
}

/// The handle of a curve with the unit tangent `tangent`, of either sign, at the start of `e`: that of a circle where
/// the other tangent is as steep.
inline Vector_3 feature_handle(const Vector_3& e, double length2, const Vector_3& tangent, bool& is_straight)
{
  const double along = e.dot(tangent);
  if (!(2 * along * along > length2)) { // 45 degrees off
    is_straight = true;
    return e / 3;
  }
  return length2 / (1.5 * (along + std::copysign(std::sqrt(length2), along))) * tangent;
}

/// The curve over `e` with the unit tangents `ta` and `tb`, of either sign.
inline Cubic_handles feature_handles(const Vector_3& e, const Vector_3& ta, const Vector_3& tb)
{
  const double length2 = e.squaredNorm();
  Cubic_handles h;
  h.is_straight = false;
  h.start = feature_handle(e, length2, ta, h.is_straight);
  h.end = -feature_handle(e, length2, tb, h.is_straight);
  return h;
}

/// Length of the cubic over `e` with the handles `h`, by Gauss's formula with five points.
inline double cubic_length(const Vector_3& e, const Cubic_handles& h)
{
  constexpr double node[] = {0.046910077030668, 0.23076534494715845, 0.5},
                   weight[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444};
  const Vector_3 w0 = h.start, w1 = e + h.end - h.start, w2 = -h.end;
  const auto speed = [&](double t) {
    const double s = 1 - t;
    return 3 * (s * s * w0 + 2 * s * t * w1 + t * t * w2).norm();
  };
  double length = weight[2] * speed(node[2]);
  for (int i = 0; i < 2; ++i) length += weight[i] * (speed(node[i]) + speed(1 - node[i]));
  return length;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_CUBIC_CURVE_H

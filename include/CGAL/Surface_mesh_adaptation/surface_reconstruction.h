// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of the concept `SurfaceReconstruction`: the surface between the vertices of a triangle.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_RECONSTRUCTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_RECONSTRUCTION_H

#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>

#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Surface_point
{
  Vector_3 position;
  Vector_3 normal;  ///< unit
};

/// What a patch may depend on: the corners of its own face and the marks of its edges. Edge `i` joins corners `i`
/// and `i + 1`.
struct Patch
{
  std::array<Vector_3, 3> points;
  std::array<Vector_3, 3> normals;                  ///< unit, of the smooth sector that the face belongs to
  std::array<bool, 3> is_feature{};                 ///< whether the edge lies on a feature curve
  std::array<std::array<Vector_3, 2>, 3> tangents;  ///< unit tangents of that curve at the ends of the edge
};

/// Flat facets: the surface is the input mesh itself.
/// \cgalModels `SurfaceReconstruction`
struct Flat_reconstruction
{
  /// The point with barycentric coordinates `(1 - u - v, u, v)`.
  static Surface_point evaluate(const Patch& p, double u, double v)
  {
    const Vector_3 e1 = p.points[1] - p.points[0], e2 = p.points[2] - p.points[0];
    const Vector_3 normal = (1 - u - v) * p.normals[0] + u * p.normals[1] + v * p.normals[2];
    return {p.points[0] + u * e1 + v * e2, normal.normalized()};
  }

  /// The point at parameter `t` of a feature curve between `a` and `b`.
  static Vector_3 evaluate_curve(const Vector_3& a, const Vector_3& b, const Vector_3&, const Vector_3&, double t)
  {
    return (1 - t) * a + t * b;
  }
};

/// Curved point-normal triangles (Vlachos et al. 2001): cubic, continuous, of third order in the distance where the
/// normals are exact. Edges on feature curves follow the tangents of the curve instead of the normals, and both faces
/// of an edge build the same curve. An edge that leaves its tangent plane by more than 45 degrees is kept straight,
/// for there the normals say nothing about it.
/// \cgalModels `SurfaceReconstruction`
struct PN_triangle_reconstruction
{
  static Surface_point evaluate(const Patch& p, double u, double v)
  {
    const double w = 1 - u - v;
    const Vector_3 &p0 = p.points[0], &p1 = p.points[1], &p2 = p.points[2];
    const Vector_3 b01 = p0 + handle(p, 0, 0), b10 = p1 + handle(p, 0, 1);
    const Vector_3 b12 = p1 + handle(p, 1, 0), b21 = p2 + handle(p, 1, 1);
    const Vector_3 b20 = p2 + handle(p, 2, 0), b02 = p0 + handle(p, 2, 1);
    const Vector_3 mean = (b01 + b10 + b12 + b21 + b20 + b02) / 6;
    const Vector_3 center = mean + (mean - (p0 + p1 + p2) / 3) / 2;

    const Vector_3 position = w * w * w * p0 + u * u * u * p1 + v * v * v * p2 +
                              3 * (w * w * (u * b01 + v * b02) + u * u * (w * b10 + v * b12) +
                                   v * v * (w * b20 + u * b21)) + 6 * w * u * v * center;
    // derivatives along edges 0 and 2, over three: the quadratic patches of differences of the control points
    const Vector_3 du = w * w * (b01 - p0) + u * u * (p1 - b10) + v * v * (b21 - b20) +
                        2 * (w * u * (b10 - b01) + u * v * (b12 - center) + w * v * (center - b02));
    const Vector_3 dv = w * w * (b02 - p0) + u * u * (b12 - b10) + v * v * (p2 - b20) +
                        2 * (w * u * (center - b01) + u * v * (b21 - center) + w * v * (b20 - b02));
    const Vector_3 normal = du.cross(dv);
    const double length = normal.norm();
    if (!(length > 0)) return Flat_reconstruction::evaluate(p, u, v);
    return {position, normal / length};
  }

  static Vector_3 evaluate_curve(const Vector_3& a, const Vector_3& b, const Vector_3& ta, const Vector_3& tb, double t)
  {
    const Vector_3 c = b - a, b1 = a + curve_handle(c, ta), b2 = b - curve_handle(c, tb);
    const double s = 1 - t;
    return s * s * s * a + 3 * s * t * (s * b1 + t * b2) + t * t * t * b;
  }

private:
  /// From end `end` of edge `edge` to the control point next to it.
  static Vector_3 handle(const Patch& p, int edge, int end)
  {
    const int i = end == 0 ? edge : (edge + 1) % 3, j = end == 0 ? (edge + 1) % 3 : edge;
    const Vector_3 c = p.points[j] - p.points[i];
    if (p.is_feature[edge]) return curve_handle(c, p.tangents[edge][end]);
    const double out = c.dot(p.normals[i]);
    if (2 * out * out > c.squaredNorm()) return c / 3;
    return (c - out * p.normals[i]) / 3;
  }

  static Vector_3 curve_handle(const Vector_3& c, const Vector_3& tangent)
  {
    const double along = c.dot(tangent);
    if (2 * along * along < c.squaredNorm()) return c / 3;
    return along / 3 * tangent;
  }
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_RECONSTRUCTION_H

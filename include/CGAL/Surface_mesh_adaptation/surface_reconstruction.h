// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models of the concept `SurfaceReconstruction`: the surface between the vertices of a triangle.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_RECONSTRUCTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_RECONSTRUCTION_H

#include <CGAL/Surface_mesh_adaptation/numerics/cubic_curve.h>
#include <CGAL/Surface_mesh_adaptation/surface/Gregory_patch_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// Flat facets: the surface is the input mesh itself.
/// \cgalModels{SurfaceReconstruction}
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
/// \cgalModels{SurfaceReconstruction}
struct PN_triangle_reconstruction
{
  /// The point with barycentric coordinates `(1 - u - v, u, v)`.
  static Surface_point evaluate(const Patch& p, double u, double v)
  {
    const Vector_3 &p0 = p.points[0], &p1 = p.points[1], &p2 = p.points[2];
    const internal::Cubic_handles h0 = handles(p, 0), h1 = handles(p, 1), h2 = handles(p, 2);
    const Vector_3 b01 = p0 + h0.start, b10 = p1 + h0.end, b12 = p1 + h1.start, b21 = p2 + h1.end,
                   b20 = p2 + h2.start, b02 = p0 + h2.end;
    // the mean of the inner control points of the edges, plus half of what separates it from the mean of the corners
    const Vector_3 center = (b01 + b10 + b12 + b21 + b20 + b02) / 4 - (p0 + p1 + p2) / 6;

    // de Casteljau: three linear interpolations, of which the last but one spans the tangent plane
    const double w = 1 - u - v;
    const auto blend = [=](const Vector_3& x, const Vector_3& y, const Vector_3& z) {
      return w * x + u * y + v * z;
    };
    const Vector_3 q00 = blend(p0, b01, b02), q11 = blend(b10, p1, b12), q22 = blend(b20, b21, p2);
    const Vector_3 q01 = blend(b01, b10, center), q02 = blend(b02, center, b20), q12 = blend(center, b12, b21);
    const Vector_3 r0 = blend(q00, q01, q02), r1 = blend(q01, q11, q12), r2 = blend(q02, q12, q22);
    const Vector_3 position = blend(r0, r1, r2), du = r1 - r0, dv = r2 - r0;
    const Vector_3 normal = du.cross(dv);
    const double length = normal.norm();
    if (!(length > 0)) return Flat_reconstruction::evaluate(p, u, v);
    return {position, normal / length};
  }

  /// The point at parameter `t` of a feature curve between `a` and `b`.
  static Vector_3 evaluate_curve(const Vector_3& a, const Vector_3& b, const Vector_3& ta, const Vector_3& tb, double t)
  {
    const Vector_3 c = b - a, b1 = a + curve_handle(c, ta), b2 = b - curve_handle(c, tb);
    const double s = 1 - t;
    return s * s * s * a + 3 * s * t * (s * b1 + t * b2) + t * t * t * b;
  }

private:
  static internal::Cubic_handles handles(const Patch& p, std::size_t edge)
  {
    const std::size_t i = edge, j = (edge + 1) % 3;
    const Vector_3 c = p.points[j] - p.points[i];
    if (p.is_feature[edge]) return {curve_handle(c, p.tangents[edge][0]), -curve_handle(c, p.tangents[edge][1]), false};
    if (p.is_straight[edge]) return {c / 3, c / -3, true};
    const double length2 = c.squaredNorm();
    const internal::Cubic_handles h{tangential_part(c, p.normals[i], length2) / 3,
                                    tangential_part(c, p.normals[j], length2) / -3, false};
    const double share = internal::share_within(p.largest_bulge_of_edge[edge], h, c);
    return share < 1 ? internal::lowered(h, c, share) : h;
  }

  static Vector_3 tangential_part(const Vector_3& c, const Vector_3& normal, double squared_length)
  {
    const double out = c.dot(normal);
    if (2 * out * out > squared_length) return c;
    return c - out * normal;
  }

  static Vector_3 curve_handle(const Vector_3& c, const Vector_3& tangent)
  {
    const double along = c.dot(tangent);
    if (2 * along * along < c.squaredNorm()) return c / 3;
    return along / 3 * tangent;
  }
};

/// `Gregory_patch_3`: quartic, with common tangent planes across smooth edges. With exact normals and shape operators
/// of fourth order in the distance and third in the normals; without shape operators, or by the construction of Walton
/// and Meek, of third and second order.
/// \cgalModels{SurfaceReconstruction}
template <Gregory_patch_3::Construction construction = Gregory_patch_3::Construction::mid_edge>
struct Basic_gregory_reconstruction
{
  /// The patch, made once for many points.
  struct Prepared_patch : Gregory_patch_3
  {
    /// \param p what it is made of
    explicit Prepared_patch(const Patch& p) : Gregory_patch_3(p, construction) {}
  };

  /// The point with barycentric coordinates `(1 - u - v, u, v)`.
  static Surface_point evaluate(const Patch& p, double u, double v)
  {
    return Gregory_patch_3(p, construction).evaluate(u, v);
  }

  /// The point at parameter `t` of a feature curve between `a` and `b`.
  static Vector_3 evaluate_curve(const Vector_3& a, const Vector_3& b, const Vector_3& ta, const Vector_3& tb, double t)
  {
    const internal::Cubic_handles h = internal::feature_handles(b - a, ta, tb);
    const double s = 1 - t;
    // summed so that it is the same, to the bit, from both ends
    return (s * s * s * a + t * t * t * b) + (3 * (s * s * t) * (a + h.start) + 3 * (t * t * s) * (b + h.end));
  }
};

/// The default: with the shape operators.
using Gregory_reconstruction = Basic_gregory_reconstruction<>;
/// By the construction of Walton and Meek.
using Walton_meek_reconstruction = Basic_gregory_reconstruction<Gregory_patch_3::Construction::walton_meek>;

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_RECONSTRUCTION_H

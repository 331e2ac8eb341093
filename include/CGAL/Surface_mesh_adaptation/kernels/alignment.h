// SPDX-License-Identifier: GPL-3.0-or-later
//
// What operations guard: no face may turn away from the normals of the surface at its corners, which would be a fold.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ALIGNMENT_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ALIGNMENT_H

#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>
#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Least cosine between a face and the surface normals at its corners that an operation may create, unless one of the
/// faces it replaces was worse: 60 degrees.
constexpr double min_alignment = 0.5;

/// The same where a face was worse: 84 degrees, or what it was. At the tip of a spike all faces are far off the normal,
/// and what takes their place is now nearer to it, now less near.
constexpr double min_alignment_at_spikes = 0.1;

/// The least cosine that may take the place of `before`.
inline double least_alignment_after(double before)
{
  return before >= min_alignment ? min_alignment : (std::min)(before, min_alignment_at_spikes);
}

/// The same for thin faces between smooth vertices, in anisotropic metrics: 84 degrees. A long edge along a thin layer
/// lies deeper below a curved surface than the face beside it is high. The face stands upright there, but next to the
/// surface.
constexpr double min_alignment_of_thin_faces = 0.1;

/// Height of a thin face, at most, in lengths of its longest edge.
constexpr double max_thin_height = 0.05;

/// Whether the triangle with the edge vectors `e1`, `e2` from its first corner, and their cross product `n`, is thin.
inline bool is_thin(const Vector_3& e1, const Vector_3& e2, const Vector_3& n)
{
  const double longest = (std::max)({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()});
  return n.squaredNorm() < max_thin_height * max_thin_height * longest * longest;
}

/// Height of a degenerate face, at most, in lengths of its longest edge: where its normal points is a matter of
/// rounding, and nothing follows from that.
constexpr double max_degenerate_height = 1e-6;

/// Unit normal of the triangle with the edge vectors `e1`, `e2` from its first corner; zero if it is degenerate.
inline Vector_3 unit_normal(const Vector_3& e1, const Vector_3& e2)
{
  const Vector_3 n = e1.cross(e2);
  const double length = n.norm();
  const bool is_degenerate = length <= max_degenerate_height * (std::max)(e1.squaredNorm(), e2.squaredNorm());
  return is_degenerate ? Vector_3(Vector_3::Zero()) : Vector_3(n / length);
}

/// Cosine between the unit normals of two faces; 1 if one of them is degenerate.
inline double cosine_of_turn(const Vector_3& m, const Vector_3& n)
{
  return m == Vector_3::Zero() || n == Vector_3::Zero() ? 1 : m.dot(n);
}

/// How a face with the normal `n`, as long as `length`, stands to the surface normals at its corners, of which those of
/// corners on curves are zero.
struct Corner_products
{
  double least;          ///< product of `n` with one of them, or `length`
  bool is_smooth = true; ///< whether none is zero

  Corner_products(const Vector_3& n, double length, const std::array<const Vector_3*, 3>& normals) : least(length)
  {
    for (const Vector_3* m : normals) {
      if (*m == Vector_3::Zero()) is_smooth = false;
      else least = (std::min)(least, n.dot(*m));
    }
  }
};

/// The least cosine between a thin face and the surface normals at its corners, as it counts among those of others:
/// from `min_alignment_of_thin_faces` on not less than `min_alignment`.
inline double alignment_of_thin_face(double cosine)
{
  return cosine >= min_alignment_of_thin_faces ? (std::max)(cosine, min_alignment) : cosine;
}

/// Cosine between a face and the surface normals at its corners from which on none of its edges can be a fold:
/// 30 degrees, for a face that is not flat may deviate by the other 60.
constexpr double flat_alignment = 0.87;

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ALIGNMENT_H

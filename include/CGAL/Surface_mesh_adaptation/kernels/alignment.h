// SPDX-License-Identifier: GPL-3.0-or-later
//
// What operations guard: no face may turn away from the normals of the surface at its corners, which would be a fold.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ALIGNMENT_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ALIGNMENT_H

#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>

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

/// Whether the face `abc` would be thin with `a` at `p`, and may stand on the surface, which curves and isotropic
/// metrics do not ask for. Where it is turned by less than 90 degrees from the normals at smooth corners, nothing is
/// folded around these.
template <class Surface>
bool is_thin_face(const Surface& surface, const Vector_3& p, Index a, Index b, Index c)
{
  if constexpr (is_anisotropic<typename Surface::Metric>) {
    for (const Index v : {a, b, c})
      if (surface.vertex_class(v) != Vertex_class::smooth) return false;
    const Vector_3 e1 = surface.points[b] - p, e2 = surface.points[c] - p;
    return is_thin(e1, e2, e1.cross(e2));
  }
  return false;
}

template <class Surface>
bool is_thin_face(const Surface& surface, Index a, Index b, Index c)
{
  return is_thin_face(surface, surface.points[a], a, b, c);
}

/// Smallest cosine between the normal of the face and the surface normals of its corners; 1 if none of them has one, or if
/// the face is degenerate.
/// Thin faces count as in `alignment_of_thin_face()`.
template <class Surface>
double alignment_of_face(const Surface& surface, const Vector_3& unit_normal, Index a, Index b, Index c)
{
  double least = 1;
  for (Index v : {a, b, c})
    if (surface.vertex_class(v) == Vertex_class::smooth)
      least = (std::min)(least, cosine_of_turn(unit_normal, surface.normals[v]));
  return least < min_alignment && is_thin_face(surface, a, b, c) ? alignment_of_thin_face(least) : least;
}

template <class Surface>
double alignment_of_face(const Surface& surface, Index a, Index b, Index c)
{
  return alignment_of_face(surface, surface.normal(a, b, c), a, b, c);
}

/// Whether the face is so near to the surface at all corners that it cannot be part of a fold.
template <class Surface>
bool is_flat_face(const Surface& surface, const Vector_3& unit_normal, Index a, Index b, Index c)
{
  for (Index v : {a, b, c})
    if (surface.vertex_class(v) != Vertex_class::smooth || unit_normal.dot(surface.normals[v]) < flat_alignment)
      return false;
  return true;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ALIGNMENT_H

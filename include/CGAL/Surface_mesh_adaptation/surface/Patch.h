// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the surface over a triangle is made from, and what is asked of it.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_H

#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <array>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// A point of a surface with the normal there.
struct Surface_point
{
  Vector_3 position;  ///< where it is
  Vector_3 normal;  ///< unit
};

/// What a patch may depend on: the corners of its own face and the marks of its edges. Edge `i` joins corners `i`
/// and `i + 1`.
struct Patch
{
  std::array<Vector_3, 3> points;  ///< the corners
  std::array<Vector_3, 3> normals;                  ///< unit, of the smooth sector that the face belongs to
  std::array<bool, 3> is_feature{};                 ///< whether the edge lies on a feature curve
  std::array<bool, 3> is_straight{};                ///< whether the edge, no feature, is to stay on its chord
  std::array<std::array<Vector_3, 2>, 3> tangents;  ///< unit tangents of that curve, of either sign, at corner `i` and
                                                    ///< at corner `i + 1`; only of feature edges
  /// Derivative of the unit normal along the surface, `(I - n n^T) / r` on a sphere of radius `r` with outward
  /// normals; zero where it is not known.
  std::array<Metric_tensor_3, 3> shape_operators{{{0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}}};
  std::array<bool, 3> has_shape_operator{};         ///< whether the shape operator of the corner is known
  /// Where the inside leaves the triangle by more, it follows the edges alone.
  double largest_bulge = std::numeric_limits<double>::infinity();
  /// Where the curve over an edge, no feature, leaves it by more, it is brought so near, and the inside follows the edges
  /// alone.
  std::array<double, 3> largest_bulge_of_edge{std::numeric_limits<double>::infinity(),
                                              std::numeric_limits<double>::infinity(),
                                              std::numeric_limits<double>::infinity()};
};

/// The same with the corners numbered from `first` on.
inline Patch renumbered(const Patch& p, std::size_t first)
{
  Patch q;
  q.largest_bulge = p.largest_bulge;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + first) % 3;
    q.points[i] = p.points[j];
    q.normals[i] = p.normals[j];
    q.is_feature[i] = p.is_feature[j];
    q.is_straight[i] = p.is_straight[j];
    q.largest_bulge_of_edge[i] = p.largest_bulge_of_edge[j];
    if (q.is_feature[i]) q.tangents[i] = p.tangents[j];
    q.shape_operators[i] = p.shape_operators[j];
    q.has_shape_operator[i] = p.has_shape_operator[j];
  }
  return q;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_H

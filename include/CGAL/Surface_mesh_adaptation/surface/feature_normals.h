// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals next to feature curves that agree with the tangents of the curves.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_NORMALS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_NORMALS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The unit vector next to `normal` that is orthogonal to the unit vectors `s` and `t`; where that is more than 30
/// degrees away because `normal` is wrong, and where they are parallel within one, so that rounding decides what is
/// orthogonal to both, only what `normal` has along each is removed.
inline Vector_3 orthogonalized_normal(const Vector_3& normal, const Vector_3& s, const Vector_3& t)
{
  constexpr double least_squared_cosine = 0.75, least_squared_sine = 3e-4;
  const Vector_3 x = s.cross(t);
  const double along = x.dot(normal);
  if (x.squaredNorm() > least_squared_sine && along * along > least_squared_cosine * x.squaredNorm())
    return x.normalized() * (along < 0 ? -1.0 : 1.0);
  Vector_3 n = normal - normal.dot(s) * s;
  n -= n.dot(t) * t;
  return n.squaredNorm() > 0 ? Vector_3(n.normalized()) : normal;
}

/// `normal` made orthogonal to the tangents of the feature curves that bound the sector of the `n` faces from `first`
/// on, counterclockwise, and on a curve to the direction `ruling`, if there is one; as it is if there are no curves.
inline Vector_3 normal_on_features(const Mesh_view& mesh, const Features& features, Index first, std::size_t n,
                                   const Vector_3& normal, const Vector_3& ruling = Vector_3::Zero())
{
  const Index v = mesh.source(first);
  if (features.vertex_class[v] == Vertex_class::smooth || !mesh.is_crease(first)) return normal;
  Index last = first;
  for (std::size_t i = 1; i < n; ++i) last = mesh.rotated_ccw(last);
  last = Mesh_view::previous(last); // towards the vertex, along the other curve
  const Vector_3& tangent = features.tangent(mesh.curve[first], v, mesh.target(first));
  if (features.vertex_class[v] == Vertex_class::curve && ruling.squaredNorm() > 0)
    return orthogonalized_normal(normal, tangent, ruling);
  return orthogonalized_normal(normal, tangent, features.tangent(mesh.curve[last], v, mesh.source(last)));
}

/// Makes the normal of every smooth sector orthogonal to the tangents of the feature curves that bound it, as
/// tangent planes common to the patches of the sector require. Writes only normals of feature vertices.
/// \pre `features` are those of `mesh`, and `normals` one for each of its sectors
template <class Execution>
void orthogonalize_normals(const Execution& execution, const Mesh_view& mesh, const Features& features,
                           Corner_normals& normals)
{
  for_each_index(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    if (features.vertex_class[v] == Vertex_class::smooth) return;
    internal::for_each_sector(mesh, Index(v), [&](Index first, std::size_t n) {
      Vector_3& normal = normals.normals[normals.of_corner[first]];
      normal = normal_on_features(mesh, features, first, n, normal);
    });
  });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_NORMALS_H

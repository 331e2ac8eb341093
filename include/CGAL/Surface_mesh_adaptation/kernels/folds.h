// SPDX-License-Identifier: GPL-3.0-or-later
//
// What operations guard beside `alignment.h`: no two faces may fold over each other at a smooth edge.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_FOLDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_FOLDS_H

#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <algorithm>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Least cosine between two faces at a smooth edge that an operation may create, unless it mends a sharper one.
constexpr double min_fold = 0.0;

/// Cosine between a face with the normal `n` on the side of `h` and the face behind `h`; 1 across features.
template <class Surface>
double fold_across(const Surface& surface, Index h, const Vector_3& n)
{
  return surface.mesh.is_feature(h) ? 1 : n.dot(surface.normal(surface.mesh.twin[h]));
}

/// Least cosine between two faces that meet at a smooth edge of a face around `v`, if `v` were at `p`; those of thin
/// faces do not count. Faces that degenerate there, as those of an edge that is collapsed, give their place to the
/// face behind them.
/// Reads the faces behind those around `v`, so no vertex may move meanwhile.
template <class Surface>
double sharpest_fold(const Surface& surface, Index v, const Vector_3& p)
{
  const Mesh_view& mesh = surface.mesh;
  const auto& points = surface.points;
  double least = 1;
  const auto meet = [&](const Vector_3& m, const Vector_3& n) {
    if (m != Vector_3::Zero() && n != Vector_3::Zero()) least = (std::min)(least, m.dot(n));
  };
  const auto is_crossed = [&](Index h) { return mesh.is_feature(h) || points[mesh.target(h)] == p; };
  Vector_3 first = Vector_3::Zero(), last = Vector_3::Zero();
  mesh.for_each_outgoing(v, [&](Index h) {
    const Index x = mesh.target(h), y = mesh.apex(h);
    const Vector_3 cross = (points[x] - p).cross(points[y] - p);
    const bool is_degenerate = !(cross.norm() > 0);
    Vector_3 n = is_degenerate || is_thin_face(surface, p, v, x, y) ? Vector_3(Vector_3::Zero())
                                                                    : Vector_3(cross.normalized());
    const Index ring_edge = Mesh_view::next(h);
    if (!mesh.is_feature(ring_edge)) {
      const Index t = mesh.twin[ring_edge], z = mesh.apex(t);
      const Vector_3 behind = is_thin_face(surface, y, x, z) ? Vector_3(Vector_3::Zero()) : surface.normal(t);
      meet(n, behind);
      if (is_degenerate) n = behind;
    }
    if (h == mesh.outgoing[v]) first = n;
    else if (!is_crossed(h)) meet(last, n);
    last = n;
  });
  if (!mesh.is_border_vertex(v) && !is_crossed(mesh.outgoing[v])) meet(last, first);
  return least;
}

/// Whether moving `v` to `p`, or collapsing it with the vertex there, folds no two faces more than is the case. That
/// takes a look at the faces behind those around `v`: where `is_seen(w)` denies one of their vertices `w`, which
/// another task may be changing, `is_put_off` is set and the answer is no.
template <class Surface, class IsSeen>
bool is_unfolded(const Surface& surface, Index v, const Vector_3& p, const IsSeen& is_seen, bool& is_put_off)
{
  surface.mesh.for_each_outgoing(v, [&](Index h) {
    const Index behind = surface.mesh.twin[Mesh_view::next(h)];
    if (behind != no_index && !is_seen(surface.mesh.apex(behind))) is_put_off = true;
  });
  return !is_put_off &&
         sharpest_fold(surface, v, p) >= (std::min)(min_fold, sharpest_fold(surface, v, surface.points[v]));
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_FOLDS_H

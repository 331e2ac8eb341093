// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the numbers of faces around vertices are from those of a regular mesh: six, or three on each side of a curve.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DEGREES_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DEGREES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The number of faces around the source of `h`, a vertex of a curve, on the side of the curve that `h` is on.
inline int faces_beside_curve(const Mesh_view& mesh, Index h)
{
  int n = 1;
  for (Index g = h; !mesh.is_feature(g); ++n)
    if ((g = mesh.rotated_cw(g)) == h) return n;
  for (Index g = h; !mesh.is_feature(Mesh_view::previous(g)); ++n) g = mesh.rotated_ccw(g);
  return n;
}

/// How many faces too many there are around a vertex, or on one side of its curve.
struct Excess_of_faces
{
  int faces = 0;
  bool counts = false; ///< not at a corner: what is ideal there depends on its angles

  /// What `by` more faces add to its square.
  int squared_change(int by) const { return counts ? by * (by + 2 * faces) : 0; }
};

/// That around the source of `h`, on the side of its curve that `h` is on.
template <class Surface>
Excess_of_faces excess_of_faces(const Surface& surface, Index h)
{
  const Index v = surface.mesh.source(h);
  switch (surface.vertex_class(v)) {
    case Vertex_class::smooth: return {int(surface.mesh.degree(v)) - 6, true};
    case Vertex_class::curve: return {faces_beside_curve(surface.mesh, h) - 3, true};
    default: return {};
  }
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_DEGREES_H

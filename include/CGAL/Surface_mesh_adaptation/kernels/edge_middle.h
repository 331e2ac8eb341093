// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where an edge is split: the middle of its arc on a feature curve, else the point of the surface next to about the
// middle of the edge.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_EDGE_MIDDLE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_EDGE_MIDDLE_H

#include <CGAL/Surface_mesh_adaptation/kernels/lattice.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>

#include <algorithm>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The point next to the middle of the edge of `h`, found by a walk from its ends or the vertices beside it, first from
/// those that are on no feature; from others within the sector of the edge. Where a walk ends at a feature that lies in
/// between, the next one is tried, and the best of all taken.
template <class Surface>
auto middle_in_sector(const Surface& surface, Index h)
{
  constexpr double precision = 0.02;     // of the edge: later moves undo the rest
  constexpr double near_the_middle = 0.2; // of the edge: more means that the walk did not get there
  const Mesh_view& mesh = surface.mesh;
  const Index t = mesh.twin[h];
  const Vector_3 &a = surface.points[mesh.source(h)], &b = surface.points[mesh.target(h)];
  const Vector_3 target = a + split_position(surface, mesh.source(h), mesh.target(h), h) * (b - a);
  const double length = (b - a).norm();
  using Located_point = typename Surface::Reference::Located_point;
  Located_point best;
  double best_distance = std::numeric_limits<double>::infinity();
  const auto try_from = [&](const Located_point& start) {
    const auto x = surface.reference().locate(start, target, precision * length);
    const double distance = (x.point.position - target).norm();
    if (distance >= best_distance) return;
    best = x;
    best_distance = distance;
  };
  for (const bool on_features : {false, true})
    for (const Index g : {h, t, Mesh_view::previous(h), Mesh_view::previous(t)}) {
      const Index v = mesh.source(g);
      if ((surface.vertex_class(v) != Vertex_class::smooth) != on_features || best_distance <= near_the_middle * length)
        continue;
      if (on_features) try_from(start_in_sector(surface, g));
      else try_from({surface.locations[v], {surface.points[v], surface.normals[v]}});
    }
  return surface.place(best.location, best.point);
}

} // namespace internal

/// The vertex that splits the edge of `h`, the same to the bit from both sides.
template <class Surface>
auto edge_middle(const Surface& surface, Index h)
{
  const Mesh_view& mesh = surface.mesh;
  const Index a = (std::min)(mesh.source(h), mesh.target(h)), b = (std::max)(mesh.source(h), mesh.target(h));
  if (!mesh.is_feature(h)) return internal::middle_in_sector(surface, a == mesh.source(h) ? h : mesh.twin[h]);
  const auto arc = surface.reference().arc(mesh.curve[h], surface.locations[a], surface.locations[b]);
  return surface.place(surface.reference().on_curve(mesh.curve[h], 0.5 * (arc.first + arc.second)));
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_EDGE_MIDDLE_H

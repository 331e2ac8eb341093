// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where an edge is split: the middle of its arc on a feature curve, else the point of the surface next to about the
// middle of the edge.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_EDGE_MIDDLE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_EDGE_MIDDLE_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// In which ratio the edge of `h`, from `a` to `b`, is split: in halves, but for the diagonals of a lattice of
/// right-angled faces. Halves would make a finer lattice, whose edges conform to the metric, and which is in balance
/// for moves and swaps, though the quality of its faces is .866. An uneven start lets these find better ones.
template <class Surface>
double split_position(const Surface& surface, Index a, Index b, Index h)
{
  constexpr double max_skew = 0.1;         // of a parallelogram, in lengths of the diagonal
  constexpr double lattice_quality = 0.87; // of a right-angled face: .866
  constexpr double max_shift = 0.2;        // of a split, in lengths of the edge
  const Mesh_view& mesh = surface.mesh;
  const auto& points = surface.points;
  const Index p = mesh.source(h), q = mesh.target(h), c = mesh.apex(h), d = mesh.apex(mesh.twin[h]);
  const Vector_3 skew = points[c] + points[d] - points[a] - points[b];
  if (skew.squaredNorm() > max_skew * max_skew * (points[b] - points[a]).squaredNorm() ||
      (surface.has_quality(p, q, c, lattice_quality) && surface.has_quality(q, p, d, lattice_quality)))
    return 0.5;
  const double random = double(hash_of_id(std::uint64_t(a) << 32 | b) >> 11) * 0x1p-53; // in [0, 1)
  return 0.5 + max_shift * (2 * random - 1);
}

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

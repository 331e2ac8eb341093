// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points each face stands for, or covers: what Represented_points.h and Covered_points.h hand on.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_POINT_LISTS_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_POINT_LISTS_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A list of points for each face, linked through the points. Tasks that write the lists of different faces do not
/// meet.
struct Point_lists
{
  Buffer<Index> first; ///< of each face, or `no_index`
  Buffer<Index> next;  ///< of each point

  /// The lists are still to be cleared.
  void resize(std::size_t faces, std::size_t points)
  {
    first.resize(faces);
    next.resize(points);
  }

  void link(Index i, Index f)
  {
    next[i] = first[f];
    first[f] = i;
  }
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_POINT_LISTS_H

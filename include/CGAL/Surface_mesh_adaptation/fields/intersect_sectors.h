// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a tensor for each smooth sector to one for each vertex.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_INTERSECT_SECTORS_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_INTERSECT_SECTORS_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The intersection of the tensors `of_sector(id)` of the sectors around each vertex `v` (`of_corner` as in
/// `Corner_normals`) and of what `append_of_vertex(v, append)` passes to `append`. Tensors are positive definite, or
/// zero, which asks for nothing. A sector that is met twice, on a fan that starts inside of it, counts like one.
template <class Execution, class OfSector, class AppendOfVertex>
std::vector<Metric_tensor_3> intersect_sectors(const Execution& execution, const Mesh_view& mesh,
                                               const Buffer<Index>& of_corner, const OfSector& of_sector,
                                               const AppendOfVertex& append_of_vertex)
{
  std::vector<Metric_tensor_3> result(mesh.number_of_vertices());
  for_each_index(execution, result.size(), [&](std::size_t v) {
    Ring<Metric_tensor_3> tensors;
    const auto append = [&](const Metric_tensor_3& m) {
      if (m.matrix().trace() > 0) tensors.push_back(m);
    };
    Index last = no_index;
    mesh.for_each_outgoing(Index(v), [&](Index h) {
      if (of_corner[h] == last) return;
      last = of_corner[h];
      append(of_sector(last));
    });
    append_of_vertex(Index(v), append);
    result[v] = intersection_of_all(tensors);
  });
  return result;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_INTERSECT_SECTORS_H

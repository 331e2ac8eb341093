// SPDX-License-Identifier: GPL-3.0-or-later
//
// Matchings of an implicit graph: independent sets of edges whose resources are their ends.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_TASKS_MATCHING_H
#define CGAL_SURFACE_MESH_ADAPTATION_TASKS_MATCHING_H

#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationTasks
/// @{

/// A maximal matching among `n` edges: its members are their indices. `ends(i)` is the pair of nodes of edge
/// `i`, below `number_of_nodes`; `priority(i)` is unique, and less goes first.
template <class Execution, class Priority, class Ends>
Maximal_independent_set maximal_matching(const Execution& execution, std::size_t n, std::size_t number_of_nodes,
                                         const Priority& priority, const Ends& ends)
{
  return maximal_independent_set(execution, n, number_of_nodes, priority, [&](std::size_t i, const auto& f) {
    const auto e = ends(i);
    f(e.first);
    if (e.second != e.first) f(e.second);
  });
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_TASKS_MATCHING_H

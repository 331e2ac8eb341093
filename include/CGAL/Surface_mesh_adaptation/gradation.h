// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradation: bounds how fast sizes grow over the surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_GRADATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_GRADATION_H

#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Lowers `sizes` (one per vertex) until the h-shock of every edge is at most `ratio`, that is
/// `|h_q - h_p| <= |pq| ln ratio` (Borouchaki, Hecht, Frey 1998). The result is the largest such field below the given
/// one, hence unique. Jacobi sweeps: each reads the old sizes and writes the new ones, until nothing changes.
/// `ratio <= 1` switches the gradation off.
template <class Execution>
void apply_gradation(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                     double ratio, std::vector<double>& sizes)
{
  if (!(ratio > 1)) return;
  const double slope = std::log(ratio);
  std::vector<double> lowered(sizes.size());
  for (bool changed = true; changed;) {
    for_each_index(execution, sizes.size(), [&](std::size_t v) {
      double h = sizes[v];
      mesh.for_each_neighbor(Index(v), [&](Index w) {
        h = (std::min)(h, sizes[w] + slope * (points[w] - points[v]).norm());
      });
      lowered[v] = h;
    });
    changed = count_if(execution, sizes.size(), [&](std::size_t v) { return lowered[v] < sizes[v]; }) > 0;
    sizes.swap(lowered);
  }
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_GRADATION_H

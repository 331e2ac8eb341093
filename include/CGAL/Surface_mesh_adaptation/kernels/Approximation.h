// SPDX-License-Identifier: GPL-3.0-or-later
//
// Approximation: contraction within limits on the distance and the normals of the faces, the collapses that cost least
// first, and the vertices fitted to the surface in between and at the end.
//
// The limit on the normals holds vertices where the surface bends. Once these are a good part of all, a higher bound
// saves few vertices and makes the faces elsewhere err ever more: that is where it ends.
//
// Greedy but for the bound on the cost, which rises by a fixed factor: within a level the order is that of the sweeps,
// so the result does not depend on the number of threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_APPROXIMATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_APPROXIMATION_H

#include <CGAL/Surface_mesh_adaptation/kernels/Contraction.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Fitting.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {

template <class Surface, class Execution>
class Approximation
{
public:
  Approximation(const Execution& execution, Surface& surface, const Simplification_thresholds& thresholds,
                const Deviation_limits& limits)
    : execution_(execution), represented_(execution, surface, limits), contraction_(execution, surface, thresholds, represented_)
    , fitting_(execution, surface, represented_, Fitting_thresholds{attraction}), left_(surface.mesh.number_of_vertices())
  {}

  /// Collapses at the present bound, or raises it where there is nothing left to collapse. Returns the number of
  /// vertices removed; 0: that was all, and the vertices are fitted for the last time.
  std::size_t sweep(Sweep_counts& counts)
  {
    while (!is_stopped(execution_)) {
      if (const std::size_t removed = contraction_.sweep(counts)) {
        since_fit_ += removed;
        left_ -= removed;
        return removed;
      }
      if (double(since_fit_) > noticeable_share * double(left_)) fit(1);
      const double next = contraction_.next_cost();
      if (!(next < std::numeric_limits<double>::infinity()) ||
          double(contraction_.number_of_held()) > max_share_of_held * double(left_))
        break;
      bound_ = (std::max)(growth * bound_, next);
      contraction_.set_bound(bound_);
    }
    fit(last_steps);
    return 0;
  }

private:
  void fit(int steps)
  {
    fitting_.sweep(steps, [] {});
    since_fit_ = 0;
  }

  static constexpr double growth = 1.2;            // of the bound
  static constexpr double noticeable_share = 0.3;  // of the vertices: removed since the last fit
  static constexpr double max_share_of_held = 0.125; // of the vertices, by the limit on the normals
  static constexpr int last_steps = 8;
  static constexpr double attraction = 0.05;       // of a vertex to where it is when it is fitted, of that to the points

  const Execution& execution_;
  Represented_points<Surface> represented_;
  Contraction<Surface, Execution> contraction_;
  Fitting<Surface, Execution, Represented_points<Surface>> fitting_;
  double bound_ = 0;
  std::size_t left_, since_fit_ = 0;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_APPROXIMATION_H

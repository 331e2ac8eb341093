// SPDX-License-Identifier: GPL-3.0-or-later
//
// Approximation: simplification as far as limits on the distance and the normals of the faces allow, the collapses that
// cost least first, and the vertices fitted to the surface in between, since what a collapse costs depends on them.
//
// Greedy but for the bound on the cost, which rises by a fixed factor: within a level the order is that of the
// sweeps, so the result does not depend on the number of threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_APPROXIMATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_APPROXIMATION_H

#include <CGAL/Surface_mesh_adaptation/kernels/Fitting.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Simplification.h>

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
    : represented_(execution, surface, limits), simplification_(execution, surface, thresholds, represented_)
    , fitting_(execution, surface, represented_, max_move * limits.distance)
    , left_(surface.mesh.number_of_vertices())
  {}

  /// Collapses at the present bound, or raises it where there is nothing left to collapse. Returns the number of
  /// vertices removed; 0: the limits allow no more, and the vertices are fitted for the last time.
  std::size_t sweep(Sweep_counts& counts)
  {
    for (;;) {
      if (const std::size_t removed = simplification_.sweep(counts)) {
        since_fit_ += removed;
        left_ -= removed;
        return removed;
      }
      if (double(since_fit_) > noticeable_share * double(left_)) fit(steps_between);
      const double next = simplification_.next_cost();
      if (!(next < std::numeric_limits<double>::infinity())) break;
      bound_ = (std::max)(growth * bound_, next);
      simplification_.set_bound(bound_);
    }
    fit(last_steps);
    return 0;
  }

private:
  void fit(int steps)
  {
    for (int i = 0; i < steps; ++i) fitting_.sweep();
    since_fit_ = 0;
  }

  static constexpr double growth = 1.2;           // of the bound: smaller ones gain nothing
  static constexpr double noticeable_share = 0.1; // of the vertices: removed since the last fit
  static constexpr int steps_between = 3, last_steps = 12;
  static constexpr double max_move = 0.75;        // of the distance allowed

  Represented_points<Surface> represented_;
  Simplification<Surface, Execution> simplification_;
  Fitting<Surface, Execution> fitting_;
  double bound_ = 0;
  std::size_t left_, since_fit_ = 0;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_APPROXIMATION_H

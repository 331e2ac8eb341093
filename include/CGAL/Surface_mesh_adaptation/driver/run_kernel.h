// SPDX-License-Identifier: GPL-3.0-or-later
//
// One kernel on its own: sweeps in place until nothing is left to do.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_RUN_KERNEL_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_RUN_KERNEL_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_visitor.h>
#include <CGAL/Surface_mesh_adaptation/driver/check_models.h>
#include <CGAL/Surface_mesh_adaptation/driver/in_place.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Refinement.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>

#include <functional>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// `make(execution, surface)` returns the kernel, `sweep(kernel, counts)` the number of operations of one sweep.
template <class Execution, class Domain, class MetricField, class NamedParameters, class Make, class Sweep>
std::size_t run_kernel(const Execution& execution, const Domain& domain, const MetricField& field,
                       const NamedParameters& np, unsigned default_sweeps, const Make& make, const Sweep& sweep)
{
  static_assert(check_models<typename Domain::Graph, MetricField, NamedParameters>());
  const std::size_t max_sweeps = choose(np, CGAL::internal_np::number_of_iterations, default_sweeps);
  Adaptation_visitor nothing;
  auto visitor_parameter = choose(np, CGAL::internal_np::visitor, std::ref(nothing));
  auto& visitor = unwrap(visitor_parameter);
  Sweep_counts counts;
  const auto interruptible = Any_execution(execution).interruptible([&] { return visitor.go_on(); });
  adapt_in_place(interruptible, domain, field, np, [&](const auto& policy, auto& surface) {
    auto kernel = make(policy, surface);
    Adaptation_report report;
    counts = Sweep_counts(); // with a tolerance there may be several attempts: the last one counts
    for (std::size_t i = 0; i < max_sweeps && !report.stopped && sweep(kernel, counts) > 0; ++i)
      report.stopped = is_stopped(policy) || !visitor.go_on();
    Refinement(policy, surface).compact();
    return report;
  });
  return counts.applied;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_RUN_KERNEL_H

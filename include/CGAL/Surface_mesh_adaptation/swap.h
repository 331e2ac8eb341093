// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SWAP_H
#define CGAL_SURFACE_MESH_ADAPTATION_SWAP_H

#include <CGAL/Surface_mesh_adaptation/driver/run_kernel.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Swapping.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

/*!
Swaps edges to improve the worst quality of their two faces, and the degrees of their vertices (paper, section 5).

\param execution, mesh, field, np as for `adapt_surface_mesh`; `number_of_iterations` is the largest number of sweeps
       (default: 24), and the visitor's `go_on` is asked after each of them

\returns the number of edges swapped
\throws as `adapt_surface_mesh`: the mesh is as it was then
*/
template <class Execution, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
auto swap(const Execution& execution, TriangleMesh& mesh, const MetricField& field,
          const NamedParameters& np = CGAL::parameters::default_values()) -> decltype(execution.concurrency(), std::size_t())
{
  return internal::run_kernel(execution, mesh, field, np, 24, [](const auto& policy, auto& surface) {
    return Swapping(policy, surface, Swapping_thresholds());
  }, [](auto& kernel, Sweep_counts& counts) { return kernel.sweep(counts); });
}

/// The same with the policy as a template parameter, as for `adapt_surface_mesh`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = std::enable_if_t<!internal::is_execution<TriangleMesh> && !std::is_same_v<TriangleMesh, MetricField>>>
std::size_t swap(TriangleMesh& mesh, const MetricField& field,
                 const NamedParameters& np = CGAL::parameters::default_values())
{
  return swap(typename internal::Execution_of<ConcurrencyTag>::type(), mesh, field, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SWAP_H

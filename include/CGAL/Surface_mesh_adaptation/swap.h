// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SWAP_H
#define CGAL_SURFACE_MESH_ADAPTATION_SWAP_H

#include <CGAL/Surface_mesh_adaptation/driver/run_kernel.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Swapping.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

namespace internal {

/// `swap` of a whole mesh or of a range of its faces.
template <class Execution, class Domain, class MetricField, class NamedParameters>
std::size_t swap_domain(const Execution& execution, const Domain& domain, const MetricField& field,
                        const NamedParameters& np)
{
  return run_kernel(execution, domain, field, np, 24, [](const auto& policy, auto& surface) {
    return Swapping(policy, surface, Swapping_thresholds());
  }, [](auto& kernel, Sweep_counts& counts) { return kernel.sweep(counts); });
}

} // namespace internal

/*!
Swaps edges to improve the worst quality of their two faces, and the degrees of their vertices (paper, section 5).

\param execution, mesh, field, np as for `adapt_surface_mesh`; `number_of_iterations` is the largest number of sweeps
       (default: 24), and the visitor's `go_on` is asked after each of them

\returns the number of edges swapped
\throws as `adapt_surface_mesh`: the mesh is as it was then
*/
template <class Execution, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
auto swap(const Execution& execution, TriangleMesh& mesh, const MetricField& field,
          const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::swap_domain(execution, internal::Whole_mesh<TriangleMesh>(mesh), field, np);
}

/// The same for the faces of a range alone, as for `adapt_surface_mesh`.
template <class Execution, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
auto swap(const Execution& execution, const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
          const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::swap_domain(execution, internal::Part_of_mesh<TriangleMesh>(faces, mesh), field, np);
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

/// The same for a range of faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
std::size_t swap(const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                 const NamedParameters& np = CGAL::parameters::default_values())
{
  return swap(typename internal::Execution_of<ConcurrencyTag>::type(), faces, mesh, field, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SWAP_H

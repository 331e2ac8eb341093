// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_REFINE_H
#define CGAL_SURFACE_MESH_ADAPTATION_REFINE_H

#include <CGAL/Surface_mesh_adaptation/driver/run_kernel.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Refinement.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

namespace internal {

/// `refine` of a whole mesh or of a range of its faces.
template <class Execution, class Domain, class MetricField, class NamedParameters>
std::size_t refine_domain(const Execution& execution, const Domain& domain, const MetricField& field,
                          const NamedParameters& np)
{
  return run_kernel(execution, domain, field, np, 24, [](const auto& policy, auto& surface) {
    return Refinement(policy, surface);
  }, [](auto& kernel, Sweep_counts& counts) { return kernel.sweep(0, counts); });
}

} // namespace internal

/*!
Splits the edges that are longer than `sqrt 2` in the metric, until none is left that can be split without turning a
face over (paper, section 5).

\param execution, mesh, field, np as for `adapt_surface_mesh`; `number_of_iterations` is the largest number of sweeps
       (default: 24), and the visitor's `go_on` is asked after each of them

\returns the number of edges split
\throws as `adapt_surface_mesh`: the mesh is as it was then
*/
template <class Execution, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
auto refine(const Execution& execution, TriangleMesh& mesh, const MetricField& field,
            const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::refine_domain(execution, internal::Whole_mesh<TriangleMesh>(mesh), field, np);
}

/// The same for the faces of a range alone, as for `adapt_surface_mesh`.
template <class Execution, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
auto refine(const Execution& execution, const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
            const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::refine_domain(execution, internal::Part_of_mesh<TriangleMesh>(faces, mesh), field, np);
}

/// The same with the policy as a template parameter, as for `adapt_surface_mesh`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
std::size_t refine(TriangleMesh& mesh, const MetricField& field,
                   const NamedParameters& np = CGAL::parameters::default_values())
{
  return refine(typename internal::Execution_of<ConcurrencyTag>::type(), mesh, field, np);
}

/// The same for a range of faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
std::size_t refine(const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                   const NamedParameters& np = CGAL::parameters::default_values())
{
  return refine(typename internal::Execution_of<ConcurrencyTag>::type(), faces, mesh, field, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_REFINE_H

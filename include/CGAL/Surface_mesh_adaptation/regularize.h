// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_REGULARIZE_H
#define CGAL_SURFACE_MESH_ADAPTATION_REGULARIZE_H

#include <CGAL/Surface_mesh_adaptation/driver/run_kernel.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Regularization.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

namespace internal {

/// `regularize` of a whole mesh or of a range of its faces.
template <class Execution, class Domain, class MetricField, class NamedParameters>
std::size_t regularize_domain(const Execution& execution, const Domain& domain, const MetricField& field,
                              const NamedParameters& np)
{
  return run_kernel(execution, domain, field, np, 24, [](const auto& policy, auto& surface) {
    return Regularization(policy, surface, Regularization_thresholds());
  }, [](auto& kernel, Sweep_counts& counts) { return kernel.sweep(counts); });
}

} // namespace internal

/*!
Takes vertices away and puts others in where that brings the numbers of faces around vertices nearer to those of a regular
mesh, six, or three on each side of a ridge or boundary; not more are put in than are taken away. `swap` and `relocate`
should follow.

\param execution, mesh, field, np as for `adapt_surface_mesh`; `number_of_iterations` is the largest number of sweeps
       (default: 24), and the visitor's `go_on` is asked after each of them

\returns the number of vertices taken away and put in
\throws as `adapt_surface_mesh`: the mesh is as it was then
*/
template <class Execution, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
auto regularize(const Execution& execution, TriangleMesh& mesh, const MetricField& field,
                const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::regularize_domain(execution, internal::Whole_mesh<TriangleMesh>(mesh), field, np);
}

/// The same for the faces of a range alone, as for `adapt_surface_mesh`.
template <class Execution, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
auto regularize(const Execution& execution, const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::regularize_domain(execution, internal::Part_of_mesh<TriangleMesh>(faces, mesh), field, np);
}

/// The same with the policy as a template parameter, as for `adapt_surface_mesh`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
std::size_t regularize(TriangleMesh& mesh, const MetricField& field,
                       const NamedParameters& np = CGAL::parameters::default_values())
{
  return regularize(typename internal::Execution_of<ConcurrencyTag>::type(), mesh, field, np);
}

/// The same for a range of faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
std::size_t regularize(const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                       const NamedParameters& np = CGAL::parameters::default_values())
{
  return regularize(typename internal::Execution_of<ConcurrencyTag>::type(), faces, mesh, field, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_REGULARIZE_H

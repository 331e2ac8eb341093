// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_RELOCATE_H
#define CGAL_SURFACE_MESH_ADAPTATION_RELOCATE_H

#include <CGAL/Surface_mesh_adaptation/driver/run_kernel.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Relocation.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

namespace internal {

/// `relocate` of a whole mesh or of a range of its faces.
template <class Execution, class Domain, class MetricField, class NamedParameters>
std::size_t relocate_domain(const Execution& execution, const Domain& domain, const MetricField& field,
                            const NamedParameters& np)
{
  Relocation_thresholds thresholds;
  thresholds.least_flatness = cosine_of_normal_deviation(np, thresholds.least_flatness);
  return run_kernel(execution, domain, field, np, 10, [&](const auto& policy, auto& surface) {
    return Relocation(policy, surface, thresholds);
  }, [](auto& kernel, Sweep_counts& counts) { return kernel.sweep(counts); });
}

} // namespace internal

/*!
Moves vertices on the surface to improve the faces around them (paper, section 3).

\param execution, mesh, field, np as for `adapt_surface_mesh`; `number_of_iterations` is the largest number of sweeps
       (default: 10), and the visitor's `go_on` is asked after each of them. Beside:

\cgalNamedParamsBegin
  \cgalParamNBegin{maximum_normal_deviation}
    \cgalParamDescription{the largest angle between the tangent plane at a vertex and the faces around it that its move
                          may leave, unless it was larger: the paper's theta_max. Along feature curves the normals at
                          the other corners of the faces count. Whatever it is, no face is turned by more than 60
                          degrees from a normal at its corners, 84 where one was already and, in anisotropic metrics,
                          for thin ones}
    \cgalParamType{`double`, in degrees, above 0 and up to 180}
    \cgalParamDefault{180: no further limit}
  \cgalParamNEnd
\cgalNamedParamsEnd

\returns the number of moves
\throws as `adapt_surface_mesh`: the mesh is as it was then
*/
template <class Execution, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
auto relocate(const Execution& execution, TriangleMesh& mesh, const MetricField& field,
              const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::relocate_domain(execution, internal::Whole_mesh<TriangleMesh>(mesh), field, np);
}

/// The same for the faces of a range alone, as for `adapt_surface_mesh`.
template <class Execution, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
auto relocate(const Execution& execution, const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
              const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::relocate_domain(execution, internal::Part_of_mesh<TriangleMesh>(faces, mesh), field, np);
}

/// The same with the policy as a template parameter, as for `adapt_surface_mesh`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
std::size_t relocate(TriangleMesh& mesh, const MetricField& field,
                     const NamedParameters& np = CGAL::parameters::default_values())
{
  return relocate(typename internal::Execution_of<ConcurrencyTag>::type(), mesh, field, np);
}

/// The same for a range of faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
std::size_t relocate(const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                     const NamedParameters& np = CGAL::parameters::default_values())
{
  return relocate(typename internal::Execution_of<ConcurrencyTag>::type(), faces, mesh, field, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_RELOCATE_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SIMPLIFY_H
#define CGAL_SURFACE_MESH_ADAPTATION_SIMPLIFY_H

#include <CGAL/Surface_mesh_adaptation/driver/run_kernel.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Approximation.h>

#include <algorithm>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

/// Long faces are good ones where the surface bends in one direction only.
constexpr double min_quality_of_approximation = 0.02;

namespace internal {

/// The limits that the parameters ask for.
/// \throws Invalid_parameter_error
template <class NamedParameters>
Deviation_limits deviation_limits(const NamedParameters& np)
{
  Deviation_limits limits;
  limits.min_cosine = cosine_of_normal_deviation(np, limits.min_cosine);
  limits.distance = choose(np, internal_np::maximum_distance, limits.distance);
  if (!(limits.distance > 0)) throw Invalid_parameter_error("the distance must be positive");
  return limits;
}

/// `simplify` of a whole mesh or of a range of its faces.
template <class Execution, class Domain, class MetricField, class NamedParameters>
std::size_t simplify_domain(const Execution& execution, const Domain& domain, const MetricField& field,
                            const NamedParameters& np)
{
  const auto sweep = [](auto& kernel, Sweep_counts& counts) { return kernel.sweep(counts); };
  if constexpr (has_parameter<NamedParameters, internal_np::maximum_normal_deviation_t> ||
                has_parameter<NamedParameters, internal_np::maximum_distance_t>) {
    const Deviation_limits asked = deviation_limits(np);
    return run_kernel(execution, domain, field, np, (std::numeric_limits<unsigned>::max)(),
                                [&](const auto& policy, auto& surface) {
      Simplification_thresholds thresholds;
      thresholds.min_quality = min_quality_of_approximation;
      Deviation_limits limits = asked; // a tolerance that is missed gets stricter
      if (surface.tolerance) limits.distance = (std::min)(limits.distance, surface.tolerance->of_operations());
      return Approximation(policy, surface, thresholds, limits);
    }, sweep);
  } else
    return run_kernel(execution, domain, field, np, 24, [](const auto& policy, auto& surface) {
      return Simplification(policy, surface, Simplification_thresholds());
    }, sweep);
}

} // namespace internal

/*!
Collapses the edges that are shorter than `1/sqrt 2` in the metric where that makes no edge too long, no face bad and
keeps the features (paper, section 5).

With a limit on the normals or on the distance, the collapses that cost least by quadric errors go first, each to the
place that is best by these, and go on until the limits allow no more, or until that on the normals holds an eighth of the
vertices: to go on would save few others, at an error that grows ever faster. In the end the vertices, but for corners,
are fitted to the surface, so that the faces run through it instead of touching it from one side. A large size in
`field` leaves everything to the limits. These are kept at the points that they name. A `tolerance` is a limit on the
distance, too, and is certified in the end for the whole surface, with stricter limits if need be.

\param execution, mesh, field, np as for `adapt_surface_mesh`; `number_of_iterations` is the largest number of sweeps
       (default: 24, or with limits as many as it takes), and the visitor's `go_on` is asked after each of them. Beside:

\cgalNamedParamsBegin
  \cgalParamNBegin{maximum_normal_deviation}
    \cgalParamDescription{the largest angle between the normal of a face and those of the faces of the input that it
                          stands for}
    \cgalParamType{`double`, in degrees, above 0 and up to 180}
    \cgalParamDefault{no limit}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance}
    \cgalParamDescription{the largest distance between the surface, at the vertices and at four points in each face of
                          the input, and the faces that stand for these}
    \cgalParamType{`double`, in the unit of the coordinates, positive}
    \cgalParamDefault{no limit}
  \cgalParamNEnd
\cgalNamedParamsEnd

\returns the number of vertices removed
\throws as `adapt_surface_mesh`: the mesh is as it was then
*/
template <class Execution, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
auto simplify(const Execution& execution, TriangleMesh& mesh, const MetricField& field,
              const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::simplify_domain(execution, internal::Whole_mesh<TriangleMesh>(mesh), field, np);
}

/// The same for the faces of a range alone, as for `adapt_surface_mesh`.
template <class Execution, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
auto simplify(const Execution& execution, const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
              const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), std::size_t())
{
  return internal::simplify_domain(execution, internal::Part_of_mesh<TriangleMesh>(faces, mesh), field, np);
}

/// The same with the policy as a template parameter, as for `adapt_surface_mesh`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
std::size_t simplify(TriangleMesh& mesh, const MetricField& field,
                     const NamedParameters& np = CGAL::parameters::default_values())
{
  return simplify(typename internal::Execution_of<ConcurrencyTag>::type(), mesh, field, np);
}

/// The same for a range of faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
std::size_t simplify(const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                     const NamedParameters& np = CGAL::parameters::default_values())
{
  return simplify(typename internal::Execution_of<ConcurrencyTag>::type(), faces, mesh, field, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SIMPLIFY_H

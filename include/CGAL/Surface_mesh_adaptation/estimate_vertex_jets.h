// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_ESTIMATE_VERTEX_JETS_H
#define CGAL_SURFACE_MESH_ADAPTATION_ESTIMATE_VERTEX_JETS_H

#include <CGAL/Surface_mesh_adaptation/driver/check_models.h>
#include <CGAL/Surface_mesh_adaptation/driver/in_place.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

/*!
Writes the normals and shape operators that an adaptation of `mesh` would estimate into property maps. Adaptations that
are given these maps go on with them, and leave in them what belongs to their results:

    const auto parameters = parameters::vertex_normal_map(normals).vertex_shape_operator_map(shape_operators);
    estimate_vertex_jets(mesh, parameters);
    for (double size : sizes) adapt_surface_mesh(mesh, Uniform_metric_field(size), parameters);

The parameters are those of `adapt_surface_mesh()`, of which `vertex_point_map`, `feature_angle`, `detect_features`,
`edge_is_constrained_map` and `vertex_is_constrained_map` count, and `vertex_normal_map` and `vertex_shape_operator_map`,
of which at least one is given. What these hold before is not read. Where several smooth sectors meet, at features, the
values are those of one of them; where there are too few points for a fit, shape operators are zero.

\throws as `adapt_surface_mesh()`: no map was written then
\par Complexity
O(n), about 2.3 microseconds a vertex
*/
template <class Execution, class TriangleMesh, class NamedParameters>
auto estimate_vertex_jets(const Execution& execution, const TriangleMesh& mesh, const NamedParameters& np)
  -> decltype(execution.concurrency(), void())
{
  static_assert(internal::check_reading<TriangleMesh, NamedParameters>());
  using Jets = internal::Carried_jets<NamedParameters>;
  static_assert(Jets::has_normals || Jets::has_shape_operators, "there is no map to write to");
  const internal::Any_execution policy(execution);
  const auto imported = read_face_graph(policy, mesh, internal::point_map(mesh, np));
  const Reference_surface<Gregory_reconstruction> reference(policy, imported.mesh, imported.points,
                                                            internal::feature_parameters(mesh, imported, np));
  Jets(policy, reference, imported.vertices.size(), [&](std::size_t v) {
    return reference.location_of_vertex(Index(v));
  }, np).write(internal::Whole_mesh<const TriangleMesh>(mesh));
}

/// The same with the policy as a template parameter, as for `adapt_surface_mesh()`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class NamedParameters,
          class = std::enable_if_t<!internal::is_execution<TriangleMesh>>>
void estimate_vertex_jets(const TriangleMesh& mesh, const NamedParameters& np)
{
  estimate_vertex_jets(typename internal::Execution_of<ConcurrencyTag>::type(), mesh, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_ESTIMATE_VERTEX_JETS_H

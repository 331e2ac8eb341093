// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature tensors at the vertices of a reference surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_CURVATURE_H
#define CGAL_SURFACE_MESH_ADAPTATION_CURVATURE_H

#include <CGAL/Surface_mesh_adaptation/Features.h>
#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/Size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>
#include <CGAL/Surface_mesh_adaptation/internal/intersect_sectors.h>
#include <CGAL/Surface_mesh_adaptation/vertex_jets.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// Curvature of the feature curve at a node, as a tensor along its tangent; zero if rounding explains it.
template <class Reference>
Metric_tensor_3 curvature_of_curve(const Reference& reference, Index v)
{
  const auto node = reference.features.node_of_vertex[v];
  const auto& c = reference.features.curves[node.curve];
  const std::size_t n = c.vertices.size(), i = node.index;
  const std::size_t before = i == 0 ? n - 2 : i - 1, after = i + 1;
  const double length = c.arc_length[after] - c.arc_length[i] +
                        (i == 0 ? c.length() - c.arc_length[before] : c.arc_length[i] - c.arc_length[before]);
  const Vector_3 a = (reference.points[v] - reference.points[c.vertices[before]]).normalized();
  const Vector_3 b = (reference.points[c.vertices[after]] - reference.points[v]).normalized();
  const double turn = (b - a).norm(), rounding = fit_rounding * (1 + reference.points[v].norm() / length);
  if (!(turn > rounding)) return Metric_tensor_3(0, 0, 0, 0, 0, 0);
  const double curvature = 2 * turn / length;
  return Metric_tensor_3(Matrix_3(curvature * c.tangents[i] * c.tangents[i].transpose()));
}

} // namespace internal

/// What the curvature asks for at every vertex, up to scale: a tensor with the principal directions as eigenvectors and
/// the absolute principal curvatures (unit: 1 / length) as eigenvalues, raised to the largest over `max_anisotropy`
/// squared. At vertices with several sectors it is the intersection of theirs, and on feature curves also with that of
/// the curve, so that the curve is resolved as well. Zero where all is flat.
/// \pre `max_anisotropy >= 1`
template <class Execution, class Reference>
std::vector<Metric_tensor_3> curvature_tensors(const Execution& execution, const Reference& reference,
                                               double max_anisotropy = default_max_anisotropy,
                                               Jet_fit samples = Jet_fit::exact)
{
  const Corner_jets jets = estimate_jets(execution, reference.mesh, reference.points, samples);
  return internal::intersect_sectors(execution, reference.mesh, jets.of_corner, [&](Index sector) {
    return with_bounded_anisotropy(jets.shape_operators[sector], max_anisotropy);
  }, [&](Index v, const auto& append) {
    if (reference.features.vertex_class[v] == Vertex_class::curve)
      append(with_bounded_anisotropy(internal::curvature_of_curve(reference, v), max_anisotropy));
  });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_CURVATURE_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature tensors at the vertices of a reference surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_CURVATURE_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_CURVATURE_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/intersect_sectors.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/Size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_jets.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <algorithm>
#include <cmath>
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
  return Metric_tensor_3(outer_product(curvature * c.tangents[i], c.tangents[i]));
}

/// Curvature of the bend at the edge from `a` to `b` between its faces with the apices `c` and `d`, as a tensor across it:
/// the turn of the normals over the distance of the centroids, at the geometric mean of the heights, for what a narrow
/// face bends beside a wide one it bends within its own height. That is a tenth of the edge at least: the normals of
/// slivers say little. Zero if rounding explains it.
inline Metric_tensor_3 curvature_of_bend(const Vector_3& a, const Vector_3& b, const Vector_3& c, const Vector_3& d)
{
  constexpr double least_height = 0.1;
  const Metric_tensor_3 none(0, 0, 0, 0, 0, 0);
  const Vector_3 edge = b - a, left = edge.cross(c - a), right = (d - a).cross(edge);
  const double length = edge.norm(), l = left.norm(), r = right.norm();
  if (!(l > 0 && r > 0)) return none;
  const Vector_3 m = left / l, n = right / r;
  const double half_turn = m.cross(n).norm() / (1 + m.dot(n)); // its tangent
  const auto height = [&](double twice_area) { return (std::max)(twice_area / length, least_height * length); };
  const double mean_height = std::sqrt(height(l) * height(r)), rounding = fit_rounding * (1 + a.norm() / mean_height);
  if (!(half_turn > rounding) || !std::isfinite(half_turn)) return none;
  const Vector_3 across = edge.cross(m + n).normalized();
  return Metric_tensor_3(outer_product(3 * half_turn / mean_height * across, across));
}

} // namespace internal

/// What the curvature asks for at every vertex, up to scale: a tensor with the principal directions as eigenvectors and
/// the absolute principal curvatures (unit: 1 / length) as eigenvalues, raised to the largest over `max_anisotropy`
/// squared. At vertices with several sectors it is the intersection of theirs, and on feature curves also with that of
/// the curve, so that the curve is resolved as well. Where a fit does not agree with the facets, or these are the surface
/// (`Flat_reconstruction`), the bends at the edges around count, too: fits smooth them. Zero where all is flat.
/// \pre `max_anisotropy >= 1`
template <class Execution, class Reference>
std::vector<Metric_tensor_3> curvature_tensors(const Execution& execution, const Reference& reference,
                                               double max_anisotropy = default_max_anisotropy,
                                               Jet_fit samples = Jet_fit::exact)
{
  const Mesh_view& mesh = reference.mesh;
  const std::vector<Vector_3>& points = reference.points;
  const Corner_jets jets = estimate_jets(execution, mesh, points, samples);
  const auto has_bend = [&](Index h) {
    if (samples == Jet_fit::noisy || mesh.is_feature(h) || mesh.is_border(h)) return false;
    return Reference::is_flat || (reference.features.vertex_class[mesh.source(h)] == Vertex_class::smooth &&
                                  !jets.agrees[jets.of_corner[h]]);
  };
  return internal::intersect_sectors(execution, mesh, jets.of_corner, [&](Index sector) {
    return with_bounded_anisotropy(jets.shape_operators[sector], max_anisotropy);
  }, [&](Index v, const auto& append) {
    if (reference.features.vertex_class[v] == Vertex_class::curve)
      append(with_bounded_anisotropy(internal::curvature_of_curve(reference, v), max_anisotropy));
    mesh.for_each_outgoing(v, [&](Index h) {
      if (!has_bend(h)) return;
      const Metric_tensor_3 bend = internal::curvature_of_bend(points[v], points[mesh.target(h)], points[mesh.apex(h)],
                                                               points[mesh.apex(mesh.twin[h])]);
      append(with_bounded_anisotropy(bend, max_anisotropy));
    });
  });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_CURVATURE_H

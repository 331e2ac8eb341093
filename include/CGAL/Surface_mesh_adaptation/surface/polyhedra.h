// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes to which fits say nothing: what a convex hull or a decimation has left of a shape is a polyhedron.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_POLYHEDRA_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_POLYHEDRA_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_jets.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Whether there is a fit at each sector that the facets around agree with.
template <class Execution>
Buffer<char> are_fitted(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                        const Corner_normals& normals)
{
  Buffer<char> result(normals.normals.size());
  for_each_index(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    for_each_sector(mesh, Index(v), [&](Index first, std::size_t n) {
      const Index sector = normals.of_corner[first];
      Jet_of_sector jet{normals.normals[sector], Metric_tensor_3(0, 0, 0, 0, 0, 0)};
      result[sector] = fit_jet(mesh, points, nullptr, first, n, normals.normals[sector], Jet_fit::exact,
                               Fit_purpose::patches, jet) != Fit_degree::none;
    });
  }, heavy_chunk_length);
  return result;
}

/// Of the length of the edges that are no features, the share with a fit at both ends; not a number if all are.
template <class Execution>
double share_of_fitted_edges(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  const Corner_normals normals = estimate_normals(execution, mesh, points);
  const Buffer<char> is_fitted = are_fitted(execution, mesh, points, normals);
  using Sums = std::array<double, 2>;
  const Sums sums = reduce(execution, mesh.number_of_halfedges(), Sums{}, [&](std::size_t i) -> Sums {
    const Index h = Index(i), next = Mesh_view::next(h);
    if (mesh.is_border(h) || mesh.is_shaped(h)) return {0, 0};
    const double length = (points[mesh.target(h)] - points[mesh.source(h)]).norm();
    const bool is_fit = is_fitted[normals.of_corner[h]] && is_fitted[normals.of_corner[next]];
    return {is_fit ? length : 0, length};
  }, [](const Sums& a, const Sums& b) -> Sums { return {a[0] + b[0], a[1] + b[1]}; });
  return sums[0] / sums[1];
}

/// Whether vertices are too few and too uneven for fits: less than that share of the edges has them, and triangles are bad
/// in the mean by area. Of hulls and decimated parts a tenth to a half of the edges has fits, of lofts and scans .44 to all;
/// meshes of solvers, however stretched, have them everywhere. Noise leaves no fits either, but triangles are better then.
///
/// \pre `mesh.curve` is set
/// \par Complexity
/// O(n), about 2 microseconds a vertex where triangles are bad
template <class Execution>
bool is_polyhedron(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  constexpr double poor = 0.67, bad = 0.5, largest_share_if_poor = 0.43, largest_share_if_bad = 0.75;
  const double quality = mean_quality_by_area(execution, mesh, points);
  if (!(quality <= poor)) return false;
  return share_of_fitted_edges(execution, mesh, points) <= (quality <= bad ? largest_share_if_bad : largest_share_if_poor);
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_POLYHEDRA_H

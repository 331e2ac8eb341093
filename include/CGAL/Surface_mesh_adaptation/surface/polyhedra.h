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

#include <CGAL/number_type_config.h>

#include <algorithm>
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

/// What speaks of a convex hull of a part that has flats.
struct Hull_signs
{
  double convex = 0, bend = 0; ///< of edges, lengths times angles: where the surface is convex, and all
  double flat = 0, area = 0;   ///< of faces: of those in flats, and of all

  Hull_signs operator+(const Hull_signs& s) const
  {
    return {convex + s.convex, bend + s.bend, flat + s.flat, area + s.area};
  }

  /// Faces of hulls of parts lie in planes with .11 to .45 of their area, of random points on ellipsoids with .05. Either
  /// side may be the outer one.
  bool is_hull() const
  {
    constexpr double least_convex = 0.9, least_flat = 0.1;
    return (std::max)(convex, bend - convex) >= least_convex * bend && flat >= least_flat * area;
  }
};

/// Whether the face is in one plane with another beside it, but for a twentieth of a degree, and with all around no corner
/// of it: hulls have no vertices inside of their faces.
inline bool is_in_flat_of_hull(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index f)
{
  const auto is_flat = [&](Index h) { return !mesh.is_border(h) && turn_at(mesh, points, h) < 0.05 * CGAL_PI / 180; };
  const auto is_inside = [&](Index v) {
    bool result = true;
    mesh.for_each_outgoing(v, [&](Index h) { result = result && is_flat(h); });
    return result;
  };
  const std::array<Index, 3> edges{3 * f, 3 * f + 1, 3 * f + 2};
  return std::any_of(edges.begin(), edges.end(), is_flat) &&
         std::none_of(edges.begin(), edges.end(), [&](Index h) { return is_inside(mesh.source(h)); });
}

inline Hull_signs hull_signs_at(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index f)
{
  const double area = area_of_face(mesh, points, f);
  Hull_signs result{0, 0, is_in_flat_of_hull(mesh, points, f) ? area : 0, area};
  for (Index h = 3 * f; h < 3 * f + 3; ++h) {
    if (mesh.is_border(h)) continue;
    const Vector_3 edge = points[mesh.target(h)] - points[mesh.source(h)];
    const double bend = edge.norm() * turn_at(mesh, points, h);
    result.bend += bend;
    if (face_normal(mesh, points, h).cross(face_normal(mesh, points, mesh.twin[h])).dot(edge) > 0) result.convex += bend;
  }
  return result;
}

template <class Execution>
bool is_hull(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  return reduce(execution, mesh.number_of_faces(), Hull_signs(), [&](std::size_t f) {
    return hull_signs_at(mesh, points, Index(f));
  }, [](const Hull_signs& a, const Hull_signs& b) { return a + b; }).is_hull();
}

/// Whether vertices are too few and too uneven for fits: less than that share of the edges has them, and triangles are
/// bad in the mean by area. Of hulls and decimated parts a tenth to a half of the edges has fits, of hulls with flats up to
/// .78, of lofts and scans .44 to all; meshes of solvers, however stretched, have them everywhere. Noise leaves no fits
/// either, but triangles are better then.
///
/// \pre `mesh.curve` is set
/// \par Complexity
/// O(n), about 2 microseconds a vertex where triangles are bad
template <class Execution>
bool is_polyhedron(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  constexpr double fair = 0.85, poor = 0.67, bad = 0.5;
  constexpr double largest_share_of_hull = 0.9, largest_share_if_poor = 0.43, largest_share_if_bad = 0.75;
  const double quality = mean_quality_by_area(execution, mesh, points);
  if (!(quality <= fair)) return false;
  const bool is_hull = internal::is_hull(execution, mesh, points);
  if (quality > poor && !is_hull) return false;
  const double largest = is_hull ? largest_share_of_hull : quality <= bad ? largest_share_if_bad : largest_share_if_poor;
  return share_of_fitted_edges(execution, mesh, points) <= largest;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_POLYHEDRA_H

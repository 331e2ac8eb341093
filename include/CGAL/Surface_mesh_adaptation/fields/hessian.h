// SPDX-License-Identifier: GPL-3.0-or-later
//
// Second derivatives along the surface of a scalar field that is known at the vertices.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_HESSIAN_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_HESSIAN_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_jets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

/// The second derivatives along the surface of a field at a vertex.
struct Hessian_estimate
{
  Metric_tensor_3 tensor = Metric_tensor_3(0, 0, 0, 0, 0, 0); ///< zero along the normal
  /// What the fit leaves of the squares of the values, over that and the squares of its quadratic part: 0 if the fit is
  /// exact, of fourth order in the distance of the samples where they resolve the field, near 1 where they do not.
  double unexplained = 0;
};

namespace internal {

/// `Hessian_estimate::unexplained` of the fit with the derivatives `f`.
template <class Value>
double unexplained_share(const Samples_over_plane& samples, const Derivatives_2& f, const Value& value)
{
  double all = 0, quadratic = 0;
  for (const Sample_over_plane& s : samples) {
    const Eigen::Vector2d hx = f.hessian * s.x;
    const double v = value(s), q = s.x.dot(hx) / 2;
    all += s.weight * v * v;
    quadratic += s.weight * q * q;
  }
  const double rest = (std::max)(0.0, all - f.explained);
  return rest > 0 ? rest / (rest + quadratic) : 0;
}

/// The Hessian at the source of `first`, in the sector of `n` faces with the unit normal `normal`; zero if the samples
/// do not determine it.
inline Hessian_estimate hessian_of_sector(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index first,
                                          std::size_t n, const Vector_3& normal, const std::vector<double>& values)
{
  Sector_neighborhood neighbors(mesh, first, n);
  grow_for_cubic_fit(neighbors);
  const Index v = mesh.source(first);
  const Tangent_frame frame(points[v], normal);
  const double radius = mean_distance(neighbors, points, frame.origin);
  if (!(radius > 0) || !std::isfinite(1 / radius)) return {};
  const auto value = [&](const Sample_over_plane& s) { return values[s.vertex] - values[v]; };
  const Samples_over_plane samples = samples_over_plane(neighbors, points, frame, radius, Jet_fit::exact);
  const Cubic_fit fit = fit_of(samples, value);
  Derivatives_2 f;
  if (!fit.solve_cubic(f) && !fit.solve_quadratic(f)) return {};
  // what the rounding of values and coordinates explains is none
  const double rounding = fit_rounding * (std::abs(values[v]) + f.gradient.lpNorm<Eigen::Infinity>() *
                                                                  (1 + frame.origin.lpNorm<Eigen::Infinity>() / radius));
  if (!f.hessian.allFinite() || f.bend <= rounding) return {};
  return {Metric_tensor_3(in_space(f.hessian / (radius * radius), frame.x, frame.y)),
          unexplained_share(samples, f, value)};
}

} // namespace internal

/// The covariant Hessian, for each smooth sector, of the field with the value `values[v]` at vertex `v`: a symmetric
/// tensor of space (unit: that of the values / length^2) that is zero along the normal. By cubic least squares over the
/// tangent plane on the two rings around the vertex that can be reached without crossing a feature, through the value
/// at the vertex: of second order, at boundaries as well; quadratic where there are too few neighbours.
///
/// \param execution, mesh, points, values the mesh, and the values of the field at its vertices
/// \param normals unit normals of the sectors, as `Corner_normals` or, to keep the order, `Corner_jets`; the result is
///        indexed like `normals.normals`
/// \pre `mesh.curve` is set (Features.h), all points are finite
/// \throws Invalid_field_error for the first value that is not finite
/// \par Complexity
/// O(n), about 2 microseconds a vertex
template <class Execution, class Normals>
Buffer<Hessian_estimate> estimate_hessians(const Execution& execution, const Mesh_view& mesh,
                                           const std::vector<Vector_3>& points, const Normals& normals,
                                           const std::vector<double>& values)
{
  const std::size_t n = values.size();
  const std::size_t bad = reduce(execution, n, n, [&](std::size_t v) { return std::isfinite(values[v]) ? n : v; },
                                 [](std::size_t a, std::size_t b) { return (std::min)(a, b); });
  if (bad < n) throw Invalid_field_error(bad);
  Buffer<Hessian_estimate> hessians;
  hessians.resize(normals.normals.size());
  for_each_index(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    internal::for_each_sector(mesh, Index(v), [&](Index first, std::size_t faces) {
      const Index sector = normals.of_corner[first];
      hessians[sector] =
        internal::hessian_of_sector(mesh, points, first, faces, normals.normals[sector], values);
    });
  }, heavy_chunk_length);
  return hessians;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_HESSIAN_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Proximity of features: what strips of the surface between two curves ask of a metric if they are narrower than the
// sizes that it has across. Curves are kept, so edges across a strip are as long as it is wide, whatever the metric says.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_PROXIMITY_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_PROXIMITY_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/Size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

namespace internal {

constexpr double height_of_equilateral_triangle = 0.866025403784438647;

/// The feature edge at which a path over the faces of the reference ended, at `end`; `no_index` if at none.
template <class Reference>
Index feature_at(const Reference& reference, const Location& end)
{
  constexpr double rounding = 1e-12;
  const std::array<double, 3> weights{1 - end.u - end.v, end.u, end.v};
  for (Index i = 0; i < 3; ++i) {
    const Index opposite = 3 * end.cell + (i + 1) % 3;
    if (weights[i] < rounding && reference.mesh.is_feature(opposite)) return opposite;
  }
  return no_index;
}

/// The vector across a strip, from the middle of the feature edge `h` at right angles to it over the face of `h`, to the
/// next feature. Zero if there is none within `longest`, or none that is about parallel: where curves meet, the way from
/// one to the other says nothing.
template <class Reference>
Vector_3 way_across_strip(const Reference& reference, Index h, double longest)
{
  constexpr double largest_sine = 0.25; // of the angle between the edges at both ends
  const Mesh_view& mesh = reference.mesh;
  const Vector_3& p = reference.points[mesh.source(h)];
  const Vector_3 edge = reference.points[mesh.target(h)] - p, side = reference.points[mesh.apex(h)] - p;
  const Vector_3 across = side - side.dot(edge) / edge.squaredNorm() * edge;
  const double height = across.norm();
  if (!(height > 0)) return Vector_3::Zero();
  std::array<double, 3> middle{};
  middle[h % 3] = middle[(h + 1) % 3] = 0.5;
  const Location start{Vertex_class::smooth, Mesh_view::face(h), middle[1], middle[2]};
  const Location end = reference.trace(start, longest / height * across, false);
  const Index met = feature_at(reference, end);
  if (met == no_index || met == h) return Vector_3::Zero();
  const Vector_3 way = reference.flat_point(end) - reference.flat_point(start);
  const Vector_3 other = reference.points[mesh.target(met)] - reference.points[mesh.source(met)];
  return std::abs(way.dot(other)) <= largest_sine * way.norm() * other.norm() ? way : Vector_3::Zero();
}

/// The tensor that makes `way`, which leaves the feature edge `h` over its face, as long as an equilateral triangle is
/// high. It measures nothing along the curve at the end `v` of the edge nor, unless the faces of the edge are nearly in
/// one plane or fold, on the other side of it: a strip is no reason to refine what is beside it.
template <class Reference>
Metric_tensor_3 tensor_across_strip(const Reference& reference, Index h, const Vector_3& way, Index v)
{
  constexpr double least_sine = 0.5; // of the angle between the faces
  const Mesh_view& mesh = reference.mesh;
  Vector_3 direction = way / way.norm();
  if (!mesh.is_border(h)) {
    const Vector_3 normal_of_other_side = face_normal(mesh, reference.points, mesh.twin[h]).normalized();
    if (std::abs(normal_of_other_side.dot(direction)) > least_sine) direction = normal_of_other_side;
  }
  const Index w = mesh.other_end(h, v);
  const Vector_3 tangent = reference.features.tangent(mesh.curve[h], v, w);
  const Vector_3 covector =
    height_of_equilateral_triangle / direction.dot(way) * (direction - direction.dot(tangent) * tangent);
  return Metric_tensor_3(outer_product(covector, covector));
}

/// Calls `f(edge, way)` for the feature edges at `v` and the ways over the faces beside them across strips between
/// `narrowest` and `widest`.
template <class Reference, class F>
void for_each_strip(const Reference& reference, Index v, double narrowest, double widest, const F& f)
{
  if (reference.features.vertex_class[v] == Vertex_class::smooth) return;
  reference.mesh.for_each_outgoing(v, [&](Index h) {
    for (const Index edge : {h, Mesh_view::previous(h)}) {
      if (!reference.mesh.is_feature(edge)) continue;
      const Vector_3 way = way_across_strip(reference, edge, widest);
      if (way.norm() > narrowest) f(edge, way);
    }
  });
}

} // namespace internal

/// What narrow strips between two feature curves, about parallel to each other, ask for at the vertices of these, whatever
/// the scale of the metric: a size across of 2 / sqrt 3 times the width, so that the triangles between the curves are
/// equilateral. With it, anisotropic metrics are met where features are near each other; it takes no more vertices, since
/// there are none between the curves. Widths are those of strips between the sizes `bounds.hmin` and `bounds.hmax`:
/// wider ones have room for more edges, narrower ones are noise. In other directions the tensors ask for next to nothing, a
/// size `default_max_anisotropy` times as large. Zero at smooth vertices, and where there is no strip.
/// \par Complexity
/// for each feature edge, the faces that a path of length `hmax` across it meets before the next feature
template <class Execution, class Reference>
std::vector<Metric_tensor_3> proximity_tensors(const Execution& execution, const Reference& reference,
                                               const Size_bounds& bounds)
{
  const double height = internal::height_of_equilateral_triangle;
  std::vector<Metric_tensor_3> result(reference.points.size());
  for_each_index(execution, result.size(), [&](std::size_t v) {
    Ring<Metric_tensor_3> tensors;
    const auto add = [&](Index edge, const Vector_3& way) {
      const Metric_tensor_3 across = internal::tensor_across_strip(reference, edge, way, Index(v));
      tensors.push_back(with_bounded_anisotropy(across, default_max_anisotropy));
    };
    internal::for_each_strip(reference, Index(v), height * bounds.hmin, height * bounds.hmax, add);
    result[v] = intersection_of_all(tensors);
  }, heavy_chunk_length);
  return result;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_PROXIMITY_H

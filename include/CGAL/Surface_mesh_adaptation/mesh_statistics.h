// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conformity and quality of an adapted surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_STATISTICS_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_STATISTICS_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// Smallest angle, in degrees, of the triangle of three points: the one with the largest product of its sides.
inline double smallest_angle(const Vector_3& a, const Vector_3& b, const Vector_3& c)
{
  const Vector_3 ab = b - a, ac = c - a, bc = c - b;
  return std::atan2(ab.cross(ac).norm(), (std::max)({ab.dot(ac), -ab.dot(bc), ac.dot(bc)})) * 180 / M_PI;
}

/// Sums over elements; the counts of `Mesh_statistics` with sums in place of means.
inline Mesh_statistics combined(const Mesh_statistics& a, const Mesh_statistics& b)
{
  Mesh_statistics r = a;
  r.vertices += b.vertices;
  r.edges += b.edges;
  r.faces += b.faces;
  r.in_range += b.in_range;
  r.mean_length += b.mean_length;
  r.mean_quality += b.mean_quality;
  r.min_quality = (std::min)(r.min_quality, b.min_quality);
  r.min_angle = (std::min)(r.min_angle, b.min_angle);
  for (std::size_t i = 0; i < 10; ++i) {
    r.quality_histogram[i] += b.quality_histogram[i];
    r.length_histogram[i] += b.length_histogram[i];
  }
  return r;
}

template <class Surface>
void add_edge(const Surface& surface, Index h, Mesh_statistics& s)
{
  const double length = surface.length(h);
  ++s.edges;
  s.mean_length += length;
  s.in_range += length >= min_unit_length && length <= max_unit_length ? 1 : 0;
  ++s.length_histogram[std::size_t((std::min)(9.0, (std::max)(0.0, 5 * length)))];
}

template <class Surface>
void add_face(const Surface& surface, Index f, Mesh_statistics& s)
{
  const Index a = surface.mesh.corner[3 * std::size_t(f)], b = surface.mesh.corner[3 * std::size_t(f) + 1],
              c = surface.mesh.corner[3 * std::size_t(f) + 2];
  const double q = surface.quality(a, b, c);
  ++s.faces;
  s.mean_quality += q;
  s.min_quality = (std::min)(s.min_quality, q);
  s.min_angle = (std::min)(s.min_angle, smallest_angle(surface.points[a], surface.points[b], surface.points[c]));
  ++s.quality_histogram[std::size_t((std::min)(9.0, (std::max)(0.0, 10 * q)))];
}

} // namespace internal

/// Statistics of `surface` in its own metric.
template <class Execution, class Surface>
Mesh_statistics mesh_statistics(const Execution& execution, const Surface& surface)
{
  const Mesh_view& mesh = surface.mesh;
  Mesh_statistics none;
  none.min_quality = 1;
  none.min_angle = 60;
  Mesh_statistics s = accumulate(execution, mesh.number_of_faces(), none, [&](Mesh_statistics& sum, std::size_t f) {
    if (mesh.is_removed_face(Index(f))) return;
    internal::add_face(surface, Index(f), sum);
    for (Index h = 3 * Index(f); h < 3 * Index(f) + 3; ++h)
      if (mesh.is_edge_owner(h)) internal::add_edge(surface, h, sum);
  }, internal::combined);
  s.vertices = count_if(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    return !mesh.is_removed_vertex(Index(v));
  });
  s.in_range /= double((std::max)(s.edges, std::size_t(1)));
  s.mean_length /= double((std::max)(s.edges, std::size_t(1)));
  s.mean_quality /= double((std::max)(s.faces, std::size_t(1)));
  return s;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_STATISTICS_H

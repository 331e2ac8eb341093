// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conformity and quality of an adapted surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_MESH_STATISTICS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_MESH_STATISTICS_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// Sums over some elements.
struct Statistics_sum
{
  Mesh_statistics s;           ///< with sums in place of means
  double max_cotangent = 0;    ///< of the smallest angle: at least that of 60 degrees

  Statistics_sum() { s.min_quality = 1; }

  Statistics_sum operator+(const Statistics_sum& o) const
  {
    Statistics_sum r = *this;
    r.max_cotangent = (std::max)(max_cotangent, o.max_cotangent);
    r.s.edges += o.s.edges;
    r.s.faces += o.s.faces;
    r.s.in_range += o.s.in_range;
    r.s.mean_length += o.s.mean_length;
    r.s.mean_quality += o.s.mean_quality;
    r.s.min_quality = (std::min)(s.min_quality, o.s.min_quality);
    for (std::size_t i = 0; i < s.quality_histogram.size(); ++i) {
      r.s.quality_histogram[i] += o.s.quality_histogram[i];
      r.s.length_histogram[i] += o.s.length_histogram[i];
    }
    return r;
  }

  void add_edge(double length)
  {
    ++s.edges;
    s.mean_length += length;
    s.in_range += length >= min_unit_length && length <= max_unit_length ? 1 : 0;
    ++s.length_histogram[std::size_t((std::min)(9.0, (std::max)(0.0, 5 * length)))];
  }

  template <class Metric>
  void add_face(const Metric& ma, const Metric& mb, const Metric& mc, const Vector_3& a,
                                 const Vector_3& b, const Vector_3& c)
  {
    const Vector_3 ab = b - a, ac = c - a, bc = c - b;
    const Vector_3 n = ab.cross(ac);
    const double q = squared_shape(ma, mb, mc, ab, ac, n).quality();
    ++s.faces;
    s.mean_quality += q;
    s.min_quality = (std::min)(s.min_quality, q);
    ++s.quality_histogram[std::size_t((std::min)(9.0, (std::max)(0.0, 10 * q)))];
    // the smallest angle has the largest product of its sides
    max_cotangent = (std::max)(max_cotangent, (std::max)({ab.dot(ac), -ab.dot(bc), ac.dot(bc)}) / n.norm());
  }
};

} // namespace internal

/// Statistics of `surface` in its own metric, but for edges that are protected and faces between these: they are what they
/// are.
template <class Execution, class Surface>
Mesh_statistics mesh_statistics(const Execution& execution, const Surface& surface)
{
  const Mesh_view& mesh = surface.mesh;
  using Sum = internal::Statistics_sum;
  const Sum sum = accumulate(execution, mesh.number_of_faces(), Sum(), [&](Sum& part, std::size_t f) {
    if (mesh.is_removed_face(Index(f))) return;
    const Index a = mesh.corner[3 * f], b = mesh.corner[3 * f + 1], c = mesh.corner[3 * f + 2];
    const Index first = 3 * Index(f);
    if (!(mesh.is_protected(first) && mesh.is_protected(first + 1) && mesh.is_protected(first + 2)))
      part.add_face(surface.metrics[a], surface.metrics[b], surface.metrics[c], surface.points[a], surface.points[b],
                    surface.points[c]);
    for (Index h = first; h < first + 3; ++h)
      if (mesh.is_edge_owner(h) && !mesh.is_protected(h)) part.add_edge(surface.length(h));
  }, std::plus<Sum>());
  Mesh_statistics s = sum.s;
  s.vertices = count_if(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    return !mesh.is_removed_vertex(Index(v));
  });
  s.in_range /= double((std::max)(s.edges, std::size_t(1)));
  s.mean_length /= double((std::max)(s.edges, std::size_t(1)));
  s.mean_quality /= double((std::max)(s.faces, std::size_t(1)));
  s.min_angle = std::atan2(1.0, sum.max_cotangent) * 180 / CGAL_PI;
  return s;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_MESH_STATISTICS_H

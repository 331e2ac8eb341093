// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces around a vertex that may move, gathered once for all trials, and what they would be like with the vertex
// somewhere else.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_STAR_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_STAR_H

#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>

#include <algorithm>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// How good the faces around a vertex are.
struct Star_shape
{
  double worst = 1;      ///< quality
  double alignment = 1;  ///< least cosine between a face and the surface normals at its corners
  double flatness = 1;   ///< the same with the normal at the vertex only, if it is not on a curve
};

/// The ring of the other corners of the faces around a vertex. Its functions take where that is or would be.
template <class Metric>
struct Relocation_star
{
  struct Neighbor
  {
    Index vertex;
    Vector_3 point;
    Vector_3 normal;   ///< zero on curves and at corners, which have several
    Metric metric;
  };

  Ring<Neighbor> ring;
  bool is_closed = true;

  template <class Surface>
  Relocation_star(const Surface& surface, Index v) : is_closed(!surface.mesh.is_border_vertex(v))
  {
    surface.mesh.for_each_neighbor(v, [&](Index w) {
      ring.push_back({w, surface.points[w], surface.normals[w], surface.metrics[w]});
    });
  }

  /// Calls `f(a, b)` for the pairs of consecutive neighbours, until it returns `false`; whether it never did.
  template <class F>
  bool for_each_face_while(const F& f) const
  {
    const Neighbor* const end = ring.data() + ring.size();
    const Neighbor* a = is_closed ? end - 1 : ring.data();
    for (const Neighbor* b = is_closed ? ring.data() : a + 1; b != end; a = b++)
      if (!f(*a, *b)) return false;
    return true;
  }

  /// Calls `f(a, b)` for the pairs of consecutive neighbours.
  template <class F>
  void for_each_face(const F& f) const
  {
    for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
      f(a, b);
      return true;
    });
  }

  Star_shape shape(const Placed_vertex<Metric>& v) const
  {
    Star_shape s;
    for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
      const Vector_3 n = ea.cross(eb);
      const double length = n.norm();
      const double q = internal::squared_shape(v.metric, a.metric, b.metric, ea, eb, n).quality();
      s.worst = (std::min)(s.worst, q);
      const Corner_products products(n, length, {&v.normal, &a.normal, &b.normal});
      const bool is_degenerate = unit_normal(ea, eb) == Vector_3::Zero();
      double alignment = is_degenerate ? 1 : products.least / length;
      const bool is_smooth = v.location.kind == Vertex_class::smooth;
      s.flatness = (std::min)(s.flatness, is_smooth && !is_degenerate ? n.dot(v.normal) / length : alignment);
      if (is_anisotropic<Metric> && products.is_smooth && is_thin(ea, eb, n))
        alignment = alignment_of_thin_face(alignment);
      s.alignment = (std::min)(s.alignment, alignment);
    });
    return s;
  }

  double total_quality(const Placed_vertex<Metric>& v) const
  {
    double total = 0;
    for_each_face([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
      total += internal::squared_shape(v.metric, a.metric, b.metric, ea, eb, ea.cross(eb)).quality();
    });
    return total;
  }

  /// Whether no face is worse than `q`.
  bool has_quality(const Placed_vertex<Metric>& v, double q) const
  {
    return for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
      const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
      return internal::squared_shape(v.metric, a.metric, b.metric, ea, eb, ea.cross(eb)).is_at_least(q);
    });
  }

  /// Whether a face turns by more than 90 degrees on the way from `start` to `p`.
  bool is_turned(const Vector_3& start, const Vector_3& p) const
  {
    return !for_each_face_while([&](const Neighbor& a, const Neighbor& b) {
      return (a.point - start).cross(b.point - start).dot((a.point - p).cross(b.point - p)) > 0;
    });
  }
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_STAR_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels that collapse edges share: along which edges a vertex may vanish, and what they keep.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_COLLAPSE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_COLLAPSE_H

#include <CGAL/Surface_mesh_adaptation/kernels/curve_spacing.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Least cosine between a face and the one that replaces it.
constexpr double min_turn_of_collapse = 0.3;

/// Cosine of the angle that a curve turns at a vertex that vanishes.
constexpr double min_curve_turn = 0.5;

/// An arc that replaces two others is shorter: a closed curve keeps enough of them to tell its sides apart.
constexpr double max_share_of_closed_curve = 0.4;

/// Whether the halfedge `h` at `s`, which is no corner, lies in the surface or along the curve in which `s` may move.
template <class Surface>
bool may_slide_along(const Surface& surface, Index s, Index h)
{
  return surface.vertex_class(s) == Vertex_class::smooth || surface.mesh.curve[h] == surface.locations[s].cell;
}

/// Calls `f(e)` for the collapses of `s`, which is no corner, along edges shorter than `max_length` in the metric.
template <class Surface, class F>
void for_each_collapse(const Surface& surface, Index s, double max_length, const F& f)
{
  const Mesh_view& mesh = surface.mesh;
  const auto consider = [&](const Mesh_view::Directed_edge& e) {
    if (surface.is_shorter(mesh.source(e.h), mesh.target(e.h), max_length) && may_slide_along(surface, s, e.h)) f(e);
  };
  Index last = no_index;
  mesh.for_each_outgoing(s, [&](Index h) {
    consider({h, true});
    last = Mesh_view::previous(h);
  });
  if (mesh.is_border(last)) consider({last, false});
}

/// Whether the curve through `s` may skip it towards `d`: it must not turn too much there, the new edge must not be an
/// edge of a curve already, and must leave a closed curve enough arcs.
template <class Surface>
bool is_curve_preserved(const Surface& surface, Index s, Index d)
{
  const Mesh_view& mesh = surface.mesh;
  const Index curve = surface.locations[s].cell;
  const Index other = next_on_curve(surface, s, d);
  if (other == no_index) return false;
  const Vector_3 a = surface.points[d] - surface.points[s], b = surface.points[s] - surface.points[other];
  if (a.dot(b) < min_curve_turn * a.norm() * b.norm()) return false;
  if (offset_of_drawn_curve(surface, surface.vertex(d), surface.vertex(other), curve) > max_offset_of_drawn) return false;
  for (const Index h : {mesh.halfedge(d, other), mesh.halfedge(other, d)})
    if (h != no_index && mesh.is_feature(h)) return false;
  const auto& c = surface.reference().features.curves[curve];
  const bool has_two_ends = !c.is_closed() && c.vertices.front() != c.vertices.back();
  if (has_two_ends) return true;
  const auto arc_d = surface.reference().arc(curve, surface.locations[s], surface.locations[d]);
  const auto arc_o = surface.reference().arc(curve, surface.locations[s], surface.locations[other]);
  return std::abs(arc_d.second - arc_o.second) < max_share_of_closed_curve * c.length();
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_COLLAPSE_H

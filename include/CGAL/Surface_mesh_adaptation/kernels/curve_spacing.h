// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many vertices a feature curve is to have. An edge on a curve cannot be swapped, and vertices leave the curve in
// one direction only, so edges that are split and collapsed one by one stay where halving left them: anywhere between
// 1/sqrt 2 and sqrt 2, while the faces beside them want unit edges. What counts here is the mean length over a few
// neighbouring edges, on the curve and beside it; moves along the curve equalise these.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CURVE_SPACING_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CURVE_SPACING_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>

#include <algorithm>
#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Metric lengths of an edge of a curve below and above which it is collapsed or split, whatever its neighbours.
constexpr double min_curve_length = 0.5;
constexpr double max_curve_length = 2.0;

/// The same up to which the faces beside may pull at its vertices: longer chords cut.
constexpr double balanced_length = 1.25;

/// Edges on each side of the one in question that decide with it: the mean length comes within 8 % of 1.
constexpr int curve_reach = 3;

/// Sizes beside a curve that are further than this factor from those on it count as if they were not.
constexpr double max_ratio_beside = 1.5;

/// The metric length of the curve edge of `h` as it counts here: the mean of that on the curve and that which it would
/// have at the apexes of the faces beside it. Where sizes grow off a curve, the next row has room for fewer vertices than
/// the curve has: with as many on the curve as it is long, faces would lean. The same to the bit from both sides.
template <class Surface>
double spacing_length(const Surface& surface, Index h)
{
  const Mesh_view& mesh = surface.mesh;
  const Vector_3 e = surface.points[mesh.target(h)] - surface.points[mesh.source(h)];
  const double on_curve = surface.length(h);
  const auto at_apex = [&](Index side) {
    return std::clamp(surface.metrics[mesh.apex(side)].length(e), on_curve / max_ratio_beside,
                      max_ratio_beside * on_curve);
  };
  const double beside = mesh.is_border(h) ? at_apex(h) : 0.5 * (at_apex(h) + at_apex(mesh.twin[h]));
  return 0.5 * (on_curve + beside);
}

/// Edges leave a drawn curve, such as the border of two labels, by at most this part of the size: nothing else tells
/// where it is.
constexpr double max_offset_of_drawn = 0.1;

/// How far the edge between two neighbours on `curve` is from the vertices that the input has between them, in the metric
/// of the first; 0 on curves that are not drawn, which are as smooth as they look.
template <class Surface, class Placed_vertex>
double offset_of_drawn_curve(const Surface& surface, const Placed_vertex& a, const Placed_vertex& b, Index curve)
{
  if (!surface.mesh.curves.is_drawn(curve)) return 0;
  const Feature_curve& c = surface.reference().features.curves[curve];
  const auto arc = surface.reference().arc(curve, a.location, b.location);
  const double low = (std::min)(arc.first, arc.second), high = (std::max)(arc.first, arc.second);
  const Vector_3 e = b.point - a.point;
  double largest = 0;
  const auto look_between = [&](double from, double to) {
    const auto first = std::upper_bound(c.arc_length.begin(), c.arc_length.end(), from);
    for (auto s = first; s != c.arc_length.end() && *s < to; ++s) {
      const Vector_3 d = surface.reference().points[c.vertices[std::size_t(s - c.arc_length.begin())]] - a.point;
      const double t = e.squaredNorm() > 0 ? std::clamp(d.dot(e) / e.squaredNorm(), 0.0, 1.0) : 0;
      largest = (std::max)(largest, a.metric.length(d - t * e));
    }
  };
  look_between(low, high);
  if (c.is_closed()) { // arcs across its start reach beyond one of its ends
    look_between(low + c.length(), high + c.length());
    look_between(low - c.length(), high - c.length());
  }
  return largest;
}

/// Consecutive edges of a feature curve, with their lengths in the metric as they count here. Corners end it.
struct Curve_window
{
  double length = 0;
  double longest = 0;
  int edges = 0;

  void add(double l)
  {
    length += l;
    longest = (std::max)(longest, l);
    ++edges;
  }

  // Of n and n + 1 edges those whose mean length is nearer to 1 as a ratio: what has been split is not collapsed again.
  bool has_too_few_edges() const { return length * length > edges * (edges + 1); }
  bool has_too_many_edges() const { return length * length < edges * (edges - 1); }
};

/// The edge of the curve vertex `v` along its curve that does not lead to `from`, as a halfedge in either direction;
/// `no_index` if there is none or `v` is a corner.
template <class Surface>
Index next_edge_on_curve(const Surface& surface, Index v, Index from)
{
  if (surface.vertex_class(v) != Vertex_class::curve) return no_index;
  const Mesh_view& mesh = surface.mesh;
  const Index curve = surface.locations[v].cell;
  Index next = no_index, last = no_index;
  mesh.for_each_outgoing(v, [&](Index h) {
    if (mesh.curve[h] == curve && mesh.target(h) != from) next = h;
    last = Mesh_view::previous(h);
  });
  if (mesh.is_border(last) && mesh.curve[last] == curve && mesh.source(last) != from) next = last;
  return next;
}

/// The neighbour of the curve vertex `v` along its curve that is not `from`; `no_index` if there is none or `v` is a
/// corner.
template <class Surface>
Index next_on_curve(const Surface& surface, Index v, Index from)
{
  const Index h = next_edge_on_curve(surface, v, from);
  return h == no_index ? no_index : surface.mesh.other_end(h, v);
}

/// The two neighbours of `v` along its curve; `no_index` for those that there are not.
template <class Surface>
std::array<Index, 2> neighbors_on_curve(const Surface& surface, Index v)
{
  const Index a = next_on_curve(surface, v, no_index);
  return {a, a == no_index ? no_index : next_on_curve(surface, v, a)};
}

/// Adds up to `n` edges that follow the one from `a` to `b`, but none that starts at `end` or at a vertex that
/// `may_pass` forbids. (On a closed curve of a few edges, some are found from both sides.)
template <class Surface, class MayPass>
void add_edges_behind(const Surface& surface, Index a, Index b, Index end, int n, const MayPass& may_pass,
                      Curve_window& window)
{
  for (; n > 0 && b != end && may_pass(b); --n) {
    const Index h = next_edge_on_curve(surface, b, a);
    if (h == no_index) return;
    window.add(spacing_length(surface, h));
    a = b;
    b = surface.mesh.other_end(h, b);
  }
}

/// Whether the curve edge of `h` is to be split: the longest of too few.
template <class Surface>
bool is_split_on_curve(const Surface& surface, Index h)
{
  // the order of the sum must be the same from both sides
  const Index a = (std::min)(surface.mesh.source(h), surface.mesh.target(h));
  const Index b = (std::max)(surface.mesh.source(h), surface.mesh.target(h));
  const double length = surface.length(a, b);
  if (length < 1) return false;
  if (length >= max_curve_length) return true;
  Curve_window window;
  const double spacing = spacing_length(surface, h);
  window.add(spacing);
  const auto always = [](Index) { return true; };
  add_edges_behind(surface, b, a, b, curve_reach, always, window);
  add_edges_behind(surface, a, b, a, curve_reach, always, window);
  return window.has_too_few_edges() && spacing == window.longest;
}

/// Whether the curve vertex `v` is one of too many, as far as can be seen without the rings of other vertices than
/// those that `may_pass` allows.
template <class Surface, class MayPass>
bool is_collapsed_on_curve(const Surface& surface, Index v, const MayPass& may_pass)
{
  const auto [a, b] = neighbors_on_curve(surface, v);
  if (b == no_index) return false;
  Curve_window window;
  add_edges_behind(surface, b, v, b, 1 + curve_reach, may_pass, window);
  add_edges_behind(surface, a, v, a, 1 + curve_reach, may_pass, window);
  return window.has_too_many_edges();
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CURVE_SPACING_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tangents of feature curves at their vertices and along their edges.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_CURVE_GEOMETRY_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_CURVE_GEOMETRY_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/cubic_curve.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Strokes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Tangents of feature curves.
class Curve_geometry
{
public:
  Curve_geometry(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Feature_parameters& parameters,
                 const Facets& facets)
    : mesh_(mesh), points_(points), parameters_(parameters), facets_(facets)
  {}

  /// Fills the tangents of `c`, and those at the ends of its edges. \pre `c` has its vertices
  void operator()(Feature_curve& c) const
  {
    const Strokes strokes(c, points_, facets_);
    for (std::size_t i = 0; i < c.vertices.size(); ++i) c.tangents.push_back(tangent(c, strokes, i));
    for (std::size_t i = 0; i + 1 < c.vertices.size(); ++i) c.ends.push_back(ends(c, strokes, i));
  }

private:
  /// Three-point tangent, of second order on uneven points: of the parabola through the vertex and the ends of the
  /// strokes there, or at an end through the first three of these. The stroke, if there are no three, and the longer
  /// stroke where it is too long to be of one arc with the other.
  static Vector_3 tangent(const Feature_curve& c, const Strokes& strokes, std::size_t i)
  {
    const std::size_t n = c.vertices.size();
    if (!c.closed && i == 0) return end_tangent(strokes, strokes.after(0), strokes.second());
    if (!c.closed && i + 1 == n) return -end_tangent(strokes, -strokes.before(i), -strokes.last_but_one());
    const Vector_3 dm = strokes.before(i), dp = strokes.after(i);
    const double lm = dm.norm(), lp = dp.norm();
    if (strokes.is_line_before(i)) return dm / lm;
    if (strokes.is_line_after(i)) return dp / lp;
    return (lm * lp > 0 ? dp * (lm / lp) + dm * (lp / lm) : dp + dm).normalized();
  }

  /// The tangent at the start of two strokes that follow each other; the first one if it is not of one arc with the
  /// second, or if the parabola turns off by more than 30 degrees, which says that the chain is too coarse for it.
  static Vector_3 end_tangent(const Strokes& strokes, const Vector_3& first, const Vector_3& second)
  {
    constexpr double least_cosine = 0.866;
    const double l1 = first.norm(), l2 = second.norm();
    if (!(l1 * l2 > 0) || strokes.is_longer(l1, l2)) return first.normalized();
    const Vector_3 t = (first / l1 + (first / l1 - second / l2) * (l1 / (l1 + l2))).normalized();
    return t.dot(first) > least_cosine * l1 ? t : first / l1;
  }

  std::array<Vector_3, 2> ends(const Feature_curve& c, const Strokes& strokes, std::size_t i) const
  {
    const Vector_3 e = points_[c.vertices[i + 1]] - points_[c.vertices[i]];
    const std::array<Vector_3, 2> straight{e.normalized(), e.normalized()};
    const Index a = mesh_.any_halfedge(c.vertices[i], c.vertices[i + 1]), b = mesh_.twin[a];
    const bool is_side = b == no_index && strokes.are_sides(); // of an outline
    const bool is_of_plane = is_beside_plane(a) && is_beside_plane(b);
    if (facets_.are_decimated || is_side || !strokes.is_on_arc(i) || is_of_plane) return straight;
    const Vector_3 ta = tangent_in_planes(a, b, c.tangents[i]), tb = tangent_in_planes(a, b, c.tangents[i + 1]);
    const Cubic_handles handles = feature_handles(e, ta, tb);
    const Vector_3 off = bulge(handles);
    if (leaves_facet(a, off) || (b != no_index ? leaves_facet(b, off) : leaves_sideways(a, off))) return straight;
    const double share =
      share_within(largest_bulge_of_edge(parameters_.largest_bulge, c.vertices[i], c.vertices[i + 1]), handles, e);
    if (!(share < 1)) return {ta, tb};
    return {lowered(straight[0], ta, share), lowered(straight[1], tb, share)};
  }

  /// `tangent` with a share of its slope over the direction of the chord.
  static Vector_3 lowered(const Vector_3& chord, const Vector_3& tangent, double share)
  {
    return (chord + share * (tangent / tangent.dot(chord) - chord)).normalized();
  }

  bool is_beside_plane(Index h) const { return h != no_index && facets_.is_plane(Mesh_view::face(h)); }

  /// `t` without what leaves a plane on either side of an edge, which has the halfedges `a` and `b`.
  Vector_3 tangent_in_planes(Index a, Index b, const Vector_3& t) const
  {
    for (const Index h : {a, b}) {
      if (!is_beside_plane(h)) continue;
      const Vector_3& n = facets_.at(Mesh_view::face(h)).normal;
      const Vector_3 in_plane = t - t.dot(n) * n;
      return in_plane.squaredNorm() > 0 ? Vector_3(in_plane.normalized()) : t;
    }
    return t;
  }

  /// Whether a curve over the edge of `h` that is off it by `bulge` in the middle would leave the facet, as a parabola:
  /// slivers that fill an arc turn over where their edge becomes that arc.
  bool leaves_facet(Index h, const Vector_3& bulge) const
  {
    const Apex apex = apex_beside(h);
    return 4 * bulge.dot(apex.height) * (std::max)(apex.t, 1 - apex.t) > apex.height.squaredNorm();
  }

  /// Whether the curve is farther off the plane of the facet than the apex is from the edge, where that is next to it: at a
  /// boundary the surface goes through the apex alone, and would be a wall from there to the curve.
  bool leaves_sideways(Index h, const Vector_3& bulge) const
  {
    const Apex apex = apex_beside(h);
    if (!(apex.t > 0 && apex.t < 1)) return false;
    const double height2 = apex.height.squaredNorm();
    const Vector_3 sideways = 4 * apex.t * (1 - apex.t) * (bulge - bulge.dot(apex.height) / height2 * apex.height);
    return sideways.squaredNorm() > height2;
  }

  /// Where the apex of a facet is beside an edge: at `t` of that, with `height` from there.
  struct Apex
  {
    double t;
    Vector_3 height;
  };

  Apex apex_beside(Index h) const
  {
    const Vector_3 e = points_[mesh_.target(h)] - points_[mesh_.source(h)];
    const Vector_3 side = points_[mesh_.apex(h)] - points_[mesh_.source(h)];
    const double t = side.dot(e) / e.squaredNorm();
    return {t, side - t * e};
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Feature_parameters& parameters_;
  const Facets& facets_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_CURVE_GEOMETRY_H

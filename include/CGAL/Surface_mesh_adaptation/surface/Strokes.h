// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curves as rows of straight pieces.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_STROKES_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_STROKES_H

#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/inflection.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Edges of a curve that follow each other belong to one arc if neither is longer than the other by more than this: CAD
/// systems cut arcs evenly, other edges are what they happen to be.
constexpr double largest_ratio_on_arcs = 10, largest_ratio_on_even_arcs = 3;

inline double largest_ratio_of_edges(const Facets& facets)
{
  return facets.are_chords() ? largest_ratio_on_even_arcs : largest_ratio_on_arcs;
}

/// The straight pieces of a curve: what follows in one line belongs together, however many edges it has. Closed curves
/// start where they bend.
class Strokes
{
public:
  Strokes(const Feature_curve& c, const std::vector<Vector_3>& points, const Facets& facets)
    : c_(c), points_(points), stroke_of_edge_(c.vertices.size() - 1, 0)
    , largest_ratio_(largest_ratio_of_edges(facets))
  {
    bounds_.push_back(0);
    for (std::size_t i = 1; i + 1 < c.vertices.size(); ++i) {
      const auto at = [&](std::size_t j) -> const Vector_3& { return points[c.vertices[j]]; };
      if (!facets.is_on_line(at(bounds_.back()), at(i), at(i + 1))) bounds_.push_back(i);
      stroke_of_edge_[i] = bounds_.size() - 1;
    }
    bounds_.push_back(c.vertices.size() - 1);
  }

  Vector_3 before(std::size_t i) const { return stroke(index_before(i)); }
  Vector_3 after(std::size_t i) const { return stroke(index_after(i)); }

  /// The stroke that follows the first one, or precedes the last one; zero if there is one only.
  Vector_3 second() const { return size() > 1 ? stroke(1) : Vector_3::Zero(); }
  Vector_3 last_but_one() const { return size() > 1 ? stroke(size() - 2) : Vector_3::Zero(); }

  /// Whether a stroke beside that of edge `i` is about as long, or the curve changes the way it bends there: one alone
  /// may as well be straight.
  bool is_on_arc(std::size_t i) const
  {
    const std::size_t s = stroke_of_edge_[i], n = size();
    const bool has_before = s > 0 || (c_.closed && n > 2), has_after = s + 1 < n || (c_.closed && n > 2);
    return (has_before && are_like(s, (s + n - 1) % n)) || (has_after && are_like(s, (s + 1) % n)) || is_inflection(s);
  }

  /// Whether of the strokes at vertex `i` that before it, or that after it, is a line beside an arc.
  bool is_line_before(std::size_t i) const
  {
    return is_longer(before(i).norm(), after(i).norm()) && !is_inflection(index_before(i));
  }
  bool is_line_after(std::size_t i) const
  {
    return is_longer(after(i).norm(), before(i).norm()) && !is_inflection(index_after(i));
  }

  /// Whether there are so few that they may as well be the sides of a polygon.
  bool are_sides() const { return size() < 3; }

  /// Whether a stroke of length `a` is too long to be of one arc with one of length `b`.
  bool is_longer(double a, double b) const { return a > largest_ratio_ * b; }

private:
  std::size_t size() const { return bounds_.size() - 1; }

  std::size_t index_before(std::size_t i) const { return i == 0 ? size() - 1 : stroke_of_edge_[i - 1]; }
  std::size_t index_after(std::size_t i) const { return i + 1 == c_.vertices.size() ? 0 : stroke_of_edge_[i]; }

  Vector_3 stroke(std::size_t s) const
  {
    return points_[c_.vertices[bounds_[s + 1]]] - points_[c_.vertices[bounds_[s]]];
  }

  bool are_like(std::size_t s, std::size_t t) const
  {
    return are_alike(stroke(s).norm(), stroke(t).norm(), largest_ratio_);
  }

  bool is_inflection(std::size_t s) const
  {
    const std::size_t n = size();
    if (c_.closed ? n < 5 : s < 2 || s + 2 >= n) return false;
    const std::size_t p = (s + n - 1) % n, q = (s + 1) % n;
    const Vector_3 axis = stroke(p).cross(stroke(s));
    return internal::is_inflection(stroke(s).norm(), chords({s, p, (p + n - 1) % n}, -axis),
                                   chords({s, q, (q + 1) % n}, axis));
  }

  /// Those after the first of `s`; they turn about `axis`.
  Chords_beside chords(const std::array<std::size_t, 3>& s, const Vector_3& axis) const
  {
    Chords_beside result;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector_3 a = stroke(s[i]), b = stroke(s[i + 1]), n = a.cross(b);
      result.length[i] = b.norm();
      result.turn[i] = std::copysign(std::atan2(n.norm(), a.dot(b)), n.dot(axis));
    }
    return result;
  }

  const Feature_curve& c_;
  const std::vector<Vector_3>& points_;
  std::vector<std::size_t> bounds_; ///< vertices of the chain where strokes begin, and its last one
  std::vector<std::size_t> stroke_of_edge_;
  double largest_ratio_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_STROKES_H

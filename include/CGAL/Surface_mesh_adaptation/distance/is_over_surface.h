// SPDX-License-Identifier: GPL-3.0-or-later
//
// A quick test whether a triangle is near a surface, which nearly all triangles of a mesh pass that approximates it well.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_IS_OVER_SURFACE_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_IS_OVER_SURFACE_H

#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <optional>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Space seen along the normal of a triangle.
class View_along_normal
{
public:
  struct Point
  {
    std::array<double, 3> weights; ///< barycentric coordinates
    double height;                 ///< over the plane of the triangle
  };

  /// \pre the triangle is not degenerate
  explicit View_along_normal(const Triangle_points& t) : origin_(t[0])
  {
    const Vector_3 e = t[1] - t[0], f = t[2] - t[0], n = e.cross(f);
    const double squared_double_area = n.squaredNorm();
    normal_ = n / std::sqrt(squared_double_area);
    u_ = f.cross(n) / squared_double_area;
    v_ = n.cross(e) / squared_double_area;
  }

  Point at(const Vector_3& p) const
  {
    const Vector_3 d = p - origin_;
    const double u = u_.dot(d), v = v_.dot(d);
    return {{1 - u - v, u, v}, normal_.dot(d)};
  }

private:
  Vector_3 origin_, normal_, u_, v_; // the latter: gradients of coordinates
};

/// Twice the area of a triangle as it is seen, positive if counterclockwise, of that of the triangle along whose normal.
inline double seen_area(const View_along_normal::Point& a, const View_along_normal::Point& b,
                        const View_along_normal::Point& c)
{
  return (b.weights[1] - a.weights[1]) * (c.weights[2] - a.weights[2]) -
         (b.weights[2] - a.weights[2]) * (c.weights[1] - a.weights[1]);
}

/// The part of an edge that is seen in a triangle, moved inwards by `margin` in barycentric coordinates.
struct Seen_part
{
  double begin = 0, end = 1; ///< from the first end of the edge to the other one; in the wrong order if it is not seen

  Seen_part(const View_along_normal::Point& a, const View_along_normal::Point& b, double margin)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      const double at_a = a.weights[i] - margin, at_b = b.weights[i] - margin;
      if (at_a >= 0 && at_b >= 0) continue;
      if (at_a < 0 && at_b < 0) {
        begin = 2;
        return;
      }
      if (at_a < 0) begin = (std::max)(begin, at_a / (at_a - at_b));
      else end = (std::min)(end, at_a / (at_a - at_b));
    }
  }

  bool is_empty() const { return begin > end; }
};

/// Walks over the triangles of a surface that are seen along the normal of a triangle in its place.
class Walk_over_surface
{
public:
  /// `surface` and `t` must live as long as this. \pre `t` is not degenerate
  Walk_over_surface(const Triangle_tree& surface, const Triangle_points& t, double limit)
    : surface_(surface), t_(t), view_(t), centroid_((t[0] + t[1] + t[2]) / 3)
  {
    const double radius = std::sqrt((std::max)(
      {(t[0] - centroid_).squaredNorm(), (t[1] - centroid_).squaredNorm(), (t[2] - centroid_).squaredNorm()}));
    const double shrinking = (std::min)(share_of_shrinking * limit / radius, most_shrinking);
    margin_ = shrinking / 3;
    largest_height_ = limit - shrinking * radius;
  }

  /// Whether these are all on the side of `t`, where they are seen in `t` at most `limit` from its plane, and leave no
  /// gap.
  bool run(std::size_t start)
  {
    add(surface_.towards(centroid_, start));
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (!visit(seen_[i])) return false;
    return is_center_covered_;
  }

  /// A point of `t` where `run()` has met a triangle that is farther from its plane, if that is why it stopped.
  const std::optional<Vector_3>& too_far() const { return too_far_; }

private:
  static constexpr double share_of_shrinking = 0.03; // of the limit
  static constexpr double most_shrinking = 0.5;      // of the triangle
  static constexpr std::size_t most_triangles = 512; // that a face of a far coarser mesh may lie over
  using Point = View_along_normal::Point;
  using Points = std::array<Point, 3>;

  bool visit(std::size_t i)
  {
    const Triangle_points& s = surface_[i];
    const Points p{view_.at(s[0]), view_.at(s[1]), view_.at(s[2])};
    if (!(seen_area(p[0], p[1], p[2]) > 0)) return false;
    is_center_covered_ = is_center_covered_ || covers(p, {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 0});
    const bool is_all_low = is_low(p[0].height) && is_low(p[1].height) && is_low(p[2].height);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t beyond = surface_.beyond(i)[k];
      if (is_all_low && beyond != i && is_noted(beyond)) continue; // nothing is left to look at
      const Point &a = p[k], &b = p[(k + 1) % 3];
      const Seen_part part(a, b, margin_);
      if (part.is_empty()) continue;
      const double rise = b.height - a.height;
      if (!is_all_low)
        for (const double at : {part.begin, part.end})
          if (!is_low(a.height + at * rise)) return stop_at(a, b, at);
      if (beyond == i || !note(beyond)) return false;
    }
    return is_all_low || is_low_at_corners(p);
  }

  bool is_low(double height) const { return std::abs(height) <= largest_height_; }

  bool stop_at(const Point& a, const Point& b, double at)
  {
    too_far_ = Vector_3::Zero();
    for (std::size_t i = 0; i < 3; ++i) *too_far_ += (a.weights[i] + at * (b.weights[i] - a.weights[i])) * t_[i];
    return false;
  }

  static bool covers(const Points& p, const Point& q)
  {
    return seen_area(p[0], p[1], q) >= 0 && seen_area(p[1], p[2], q) >= 0 && seen_area(p[2], p[0], q) >= 0;
  }

  /// Whether the triangle `p` is low at those corners of the one that is shrunk which it covers.
  bool is_low_at_corners(const Points& p) const
  {
    for (std::size_t k = 0; k < 3; ++k) {
      Point corner{{margin_, margin_, margin_}, 0};
      corner.weights[k] = 1 - 2 * margin_;
      if (!covers(p, corner)) continue;
      const double sum = seen_area(p[1], p[2], corner) * p[0].height + seen_area(p[2], p[0], corner) * p[1].height +
                         seen_area(p[0], p[1], corner) * p[2].height;
      if (!is_low(sum / seen_area(p[0], p[1], p[2]))) return false;
    }
    return true;
  }

  /// Those that are met again are mostly among the last.
  bool is_noted(std::size_t i) const
  {
    return may_be_noted_[i % may_be_noted_.size()] && std::find(seen_.rbegin(), seen_.rend(), i) != seen_.rend();
  }

  /// Whether there is room for one more triangle to visit.
  bool note(std::size_t i)
  {
    if (is_noted(i)) return true;
    if (seen_.size() == most_triangles) return false;
    add(i);
    return true;
  }

  void add(std::size_t i)
  {
    seen_.push_back(i);
    may_be_noted_.set(i % may_be_noted_.size());
  }

  const Triangle_tree& surface_;
  const Triangle_points& t_;
  View_along_normal view_;
  Vector_3 centroid_;
  double margin_, largest_height_;
  std::optional<Vector_3> too_far_;
  boost::container::static_vector<std::size_t, most_triangles> seen_;
  std::bitset<1024> may_be_noted_; // a bit for each number modulo its size
  bool is_center_covered_ = false;
};

inline bool is_degenerate(const Triangle_points& t)
{
  return !((t[1] - t[0]).cross(t[2] - t[0]).squaredNorm() > 0);
}

/// Whether the triangles of the surface that are seen along the normal of `t` in its place are on the same side as `t`,
/// there at most `limit` from its plane, and leave no gap: then all points of `t` lie within `limit` of the surface. Walks
/// across all edges that are seen in `t`: with all triangles on one side and none missing, what is there covers `t`, once
/// one of them covers its centroid. `start` is the place of a triangle near `t`. `false` says nothing.
///
/// `t` is shrunk about its centroid a little, by what its points may be off the limit for that: across its edges the
/// surface may turn away.
inline bool is_over_surface(const Triangle_tree& surface, const Triangle_points& t, double limit, std::size_t start)
{
  return !is_degenerate(t) && Walk_over_surface(surface, t, limit).run(start);
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_IS_OVER_SURFACE_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances between triangulated surfaces that are bounds, not samples.
//
// The distance to one triangle is a convex function, so that on another triangle it is largest at a corner. Hence the
// distance from a triangle to a surface is at most that of its farthest corner to any one triangle of the surface; for
// the one nearest to the centre that is a good bound once the triangle is small or lies above it, and it is cut until
// then (after M. Tang, M. Lee, Y. J. Kim, *Interactive Hausdorff distance computation for general polygonal models*,
// 2009). All bounds hold up to rounding.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SURFACE_DISTANCE_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SURFACE_DISTANCE_H

#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/distance/is_over_surface.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

namespace internal {

/// A convex part of a triangle.
struct Triangle_piece
{
  boost::container::small_vector<Vector_3, 10> corners;
  std::size_t guess;  ///< a triangle of the other surface near it
  double largest_squared_length = std::numeric_limits<double>::infinity(); ///< beyond which it is about as long as what it
                                                                           ///< was cut from

  Vector_3 longest_edge() const
  {
    Vector_3 longest = Vector_3::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector_3 e = corners[(i + 1) % corners.size()] - corners[i];
      if (e.squaredNorm() > longest.squaredNorm()) longest = e;
    }
    return longest;
  }

  Vector_3 center() const
  {
    Vector_3 sum = Vector_3::Zero();
    for (const Vector_3& p : corners) sum += p;
    return sum / double(corners.size());
  }

  double largest_squared_distance(const Prepared_triangle& to) const
  {
    double largest = 0;
    for (const Vector_3& p : corners) largest = (std::max)(largest, to.squared_distance(p).squared);
    return largest;
  }

  bool is_within(const Prepared_triangle& of, double squared_limit) const
  {
    return std::all_of(corners.begin(), corners.end(), [&](const Vector_3& p) {
      return of.squared_distance(p).squared <= squared_limit;
    });
  }
};

/// Cuts off what lies on the side of a plane that `normal` points to, and returns it. Either part may have no corner: what
/// sticks out by rounding is not cut off, so that each part that there is is smaller than the piece.
inline Triangle_piece cut_off(Triangle_piece& piece, const Vector_3& origin, const Vector_3& normal)
{
  const std::size_t n = piece.corners.size();
  boost::container::small_vector<double, 10> height;
  for (const Vector_3& p : piece.corners) height.push_back(normal.dot(p - origin));
  const auto [lowest, highest] = std::minmax_element(height.begin(), height.end());
  const double on_plane = 1e-6 * (std::max)(-*lowest, *highest);
  Triangle_piece above{{}, piece.guess};
  if (*highest <= on_plane) return above;
  if (*lowest >= -on_plane) {
    std::swap(above.corners, piece.corners);
    return above;
  }
  boost::container::small_vector<Vector_3, 10> below;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector_3 &p = piece.corners[i], &q = piece.corners[(i + 1) % n];
    const double dp = height[i], dq = height[(i + 1) % n];
    if (dp <= on_plane) below.push_back(p);
    if (dp >= -on_plane) above.corners.push_back(p);
    if ((std::min)(dp, dq) < -on_plane && (std::max)(dp, dq) > on_plane) {
      const Vector_3 x = p + dp / (dp - dq) * (q - p);
      below.push_back(x);
      above.corners.push_back(x);
    }
  }
  piece.corners = below;
  return above;
}

/// Calls `use(part)` for the halves of a piece across its longest edge.
template <class Use>
void halve(Triangle_piece piece, const Vector_3& longest_edge, const Use& use)
{
  const Triangle_piece half = cut_off(piece, piece.center(), longest_edge);
  piece.largest_squared_length = half.largest_squared_length;
  if (!piece.corners.empty()) use(piece);
  if (!half.corners.empty()) use(half);
}

/// Calls `use(part)` for the part of `piece` above the triangle `t` and for what is left at its sides; for halves if
/// that would be the whole piece. Where surfaces are nearly parallel, parts above one triangle need not be cut further.
/// Slivers cut off next to nothing, so what stays long is halved the next time.
template <class Use>
void split(const Triangle_piece& piece, const Triangle_points& t, const Use& use)
{
  constexpr double share_of_length = 0.9;
  const Vector_3 longest_edge = piece.longest_edge();
  const double squared_length = longest_edge.squaredNorm();
  if (squared_length > piece.largest_squared_length) return halve(piece, longest_edge, use);
  const Vector_3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  Triangle_piece rest = piece;
  boost::container::static_vector<Triangle_piece, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    Triangle_piece side = cut_off(rest, t[i], (t[(i + 1) % 3] - t[i]).cross(n));
    if (rest.corners.empty()) return halve(piece, longest_edge, use);
    if (!side.corners.empty()) sides.push_back(std::move(side));
  }
  if (sides.empty()) return halve(piece, longest_edge, use);
  rest.largest_squared_length = share_of_length * share_of_length * squared_length;
  for (Triangle_piece& side : sides) {
    side.largest_squared_length = rest.largest_squared_length;
    use(side);
  }
  use(rest);
}

/// See `is_within()`: cuts the triangle into pieces that lie over single triangles of the surface.
template <class Guesses>
bool are_pieces_within(const Triangle_tree& tree, const Triangle_points& t, double limit, const Guesses& guesses,
                       std::size_t max_pieces)
{
  const double squared_limit = limit * limit;
  Ring<internal::Triangle_piece> pieces{{{t.begin(), t.end()}, 0}};
  for (const std::size_t guess : guesses) {
    if (pieces[0].is_within(internal::Prepared_triangle(tree[guess]), squared_limit)) return true;
    pieces[0].guess = guess;
  }
  for (std::size_t looked_at = 0; !pieces.empty(); ++looked_at) {
    if (looked_at == max_pieces) return false;
    const internal::Triangle_piece piece = std::move(pieces.back());
    pieces.pop_back();
    const Vector_3 center = piece.center();
    std::size_t near = tree.towards(center, piece.guess); // any triangle that is near enough will do
    internal::Prepared_triangle to(tree[near]);
    if (to.squared_distance(center).squared > squared_limit) {
      near = tree.nearer_than({squared_limit, tree.size()}, center).triangle;
      if (near == tree.size()) return false; // none is
      to = internal::Prepared_triangle(tree[near]);
    }
    if (piece.is_within(to, squared_limit)) continue;
    internal::split(piece, tree[near], [&](const internal::Triangle_piece& part) {
      if (part.is_within(to, squared_limit)) return;
      pieces.push_back(part);
      pieces.back().guess = near;
    });
  }
  return true;
}

} // namespace internal

/// Whether all points of `t` lie within `limit` of the surface. `false` may be wrong, for no more than `max_pieces`
/// pieces of `t` are looked at. `guesses` are places of triangles of the surface near the corners.
template <class Guesses>
bool is_within(const Triangle_tree& tree, const Triangle_points& t, double limit, const Guesses& guesses,
               std::size_t max_pieces)
{
  if (!internal::is_degenerate(t)) {
    internal::Walk_over_surface walk(tree, t, limit);
    if (walk.run(*guesses.begin())) return true;
    if (walk.too_far() && !tree.is_near(*walk.too_far(), limit)) return false;
  }
  return internal::are_pieces_within(tree, t, limit, guesses, max_pieces);
}

/// How close upper bounds of distances are to these.
struct Distance_precision
{
  double absolute; ///< no bound is by more than this too large
  double limit;    ///< but those of distances beyond this, by a tenth

  /// Bounds of distances beyond `limit_` may be coarser.
  Distance_precision(double absolute_, double limit_ = std::numeric_limits<double>::infinity())
    : absolute(absolute_), limit(limit_)
  {}

  /// How much a bound of `distance` may be too large.
  double of(double distance) const { return distance > limit ? (std::max)(absolute, distance / 10) : absolute; }
};

/// An upper bound of the distance from the points of `t` to the surface, at most `enough`, or else by no more than
/// `precision` too large, unless that takes more than `max_pieces` pieces of `t`. `guess` is a triangle of the surface
/// near `t`.
inline double distance_bound(const Triangle_tree& tree, const Triangle_points& t, double enough,
                             const Distance_precision& precision, std::size_t guess = 0,
                             std::size_t max_pieces = 1 << 16)
{
  std::size_t looked_at = 0;
  double upper = 0, lower = 0;
  const auto allowed = [&] { return (std::max)(enough, lower + precision.of(lower)); };
  Ring<internal::Triangle_piece> pieces{{{t.begin(), t.end()}, guess}};
  while (!pieces.empty()) {
    const internal::Triangle_piece piece = pieces.back();
    pieces.pop_back();
    const Vector_3 center = piece.center();
    std::size_t near = tree.towards(center, piece.guess);
    const auto bound_by = [&](std::size_t i) {
      return std::sqrt(piece.largest_squared_distance(internal::Prepared_triangle(tree[i])));
    };
    double bound = bound_by(near);
    if (bound > allowed()) {
      const auto nearest = tree.nearest(center, near);
      near = nearest.triangle;
      lower = (std::max)(lower, std::sqrt(nearest.squared_distance));
      bound = bound_by(near);
    }
    if (bound <= allowed() || ++looked_at >= max_pieces) {
      upper = (std::max)(upper, bound);
      continue;
    }
    internal::split(piece, tree[near], [&](const internal::Triangle_piece& part) {
      pieces.push_back(part);
      pieces.back().guess = near;
    });
  }
  return upper;
}

/// The largest distance of points, each near the one before, from a surface. Most are nearer to a triangle that a walk
/// finds than one before them was to any, and do not ask for the nearest.
class Largest_distance
{
public:
  /// `guess` is the place of a triangle near the first point.
  explicit Largest_distance(std::size_t guess = 0) : near_(guess) {}

  /// Looks at the distance of `p` from the triangles of `tree`, the same in each call.
  void add(const Triangle_tree& tree, const Vector_3& p)
  {
    near_ = tree.towards(p, near_);
    if (squared_distance_to_triangle(p, tree[near_]) <= squared_) return;
    const auto nearest = tree.nearest(p, near_);
    near_ = nearest.triangle;
    squared_ = (std::max)(squared_, nearest.squared_distance);
  }

  std::size_t near_last() const { return near_; } ///< a triangle near the last point
  double squared() const { return squared_; } ///< the square of the largest distance so far

private:
  double squared_ = 0;
  std::size_t near_;
};

/// The larger one.
inline const Largest_distance& larger(const Largest_distance& a, const Largest_distance& b)
{
  return a.squared() < b.squared() ? b : a;
}

/// An upper bound, by no more than `precision` too large, of the distance that points of one surface have from the
/// other, or `least`, if that is larger. A precision that is lost in rounding is replaced by one that is not.
template <class Execution>
double one_sided_distance_bound(const Execution& execution, const Triangle_tree& from, const Triangle_tree& to,
                                Distance_precision precision, double least = 0)
{
  constexpr double rounding = 1e-13;
  constexpr std::size_t stride = 4; // of the triangles of which points tell how large the distance is at least
  precision.absolute = (std::max)(precision.absolute, rounding * (std::max)(to.magnitude(), from.magnitude()));
  std::vector<std::size_t> guess((from.size() + stride - 1) / stride);
  const double lower = std::sqrt(accumulate(execution, guess.size(), Largest_distance(), [&](Largest_distance& d, std::size_t j) {
    const Triangle_points& t = from[stride * j];
    d.add(to, j % 2 == 0 ? t[0] : Vector_3((t[0] + t[1] + t[2]) / 3));
    guess[j] = d.near_last();
  }, larger).squared());
  const double enough = (std::max)(least, lower + precision.of(lower));
  return reduce(execution, from.size(), least, [&](std::size_t i) {
    const std::size_t near = guess[i / stride];
    return internal::is_over_surface(to, from[i], enough, near) ? enough
                                                                : distance_bound(to, from[i], enough, precision, near);
  }, [](double a, double b) { return (std::max)(a, b); });
}

/// An upper bound of the Hausdorff distance between two surfaces, by no more than `precision` too large. O(n log n) for
/// surfaces that are near each other, and more where the distance is nearly the largest over large parts.
template <class Execution>
double hausdorff_distance_bound(const Execution& execution, const Triangle_tree& a, const Triangle_tree& b,
                                const Distance_precision& precision)
{
  return one_sided_distance_bound(execution, b, a, precision, one_sided_distance_bound(execution, a, b, precision));
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SURFACE_DISTANCE_H

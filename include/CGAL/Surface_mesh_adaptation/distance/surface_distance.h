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
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
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
  bool is_to_be_halved = false; ///< since the last cut left it about as long as what it was cut from

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

  double largest_squared_distance(const Triangle_points& to) const
  {
    const Prepared_triangle triangle(to);
    double largest = 0;
    for (const Vector_3& p : corners) largest = (std::max)(largest, triangle.squared_distance(p).squared);
    return largest;
  }
};

/// The parts of `piece` on both sides of a plane, the one that `normal` points to last. Either may have no corner: what
/// sticks out by rounding is not cut off, so that each part that there is is smaller than the piece.
inline std::array<Triangle_piece, 2> cut(const Triangle_piece& piece, const Vector_3& origin, const Vector_3& normal)
{
  const std::size_t n = piece.corners.size();
  boost::container::small_vector<double, 10> height;
  for (const Vector_3& p : piece.corners) height.push_back(normal.dot(p - origin));
  const auto [lowest, highest] = std::minmax_element(height.begin(), height.end());
  const double on_plane = 1e-6 * (std::max)(-*lowest, *highest);
  const Triangle_piece nothing{{}, piece.guess};
  if (*highest <= on_plane) return {piece, nothing};
  if (*lowest >= -on_plane) return {nothing, piece};
  std::array<Triangle_piece, 2> parts{nothing, nothing};
  for (std::size_t i = 0; i < n; ++i) {
    const Vector_3 &p = piece.corners[i], &q = piece.corners[(i + 1) % n];
    const double dp = height[i], dq = height[(i + 1) % n];
    if (dp <= on_plane) parts[0].corners.push_back(p);
    if (dp >= -on_plane) parts[1].corners.push_back(p);
    if ((std::min)(dp, dq) < -on_plane && (std::max)(dp, dq) > on_plane) {
      const Vector_3 x = p + dp / (dp - dq) * (q - p);
      for (Triangle_piece& part : parts) part.corners.push_back(x);
    }
  }
  return parts;
}

/// Calls `use(part)` for the halves of a piece across its longest edge.
template <class Use>
void halve(const Triangle_piece& piece, const Use& use)
{
  for (Triangle_piece& half : cut(piece, piece.center(), piece.longest_edge())) {
    half.is_to_be_halved = false;
    if (!half.corners.empty()) use(half);
  }
}

/// Calls `use(part)` for the part of `piece` above the triangle `t` and for what is left at its sides; for halves if
/// that would be the whole piece. Where surfaces are nearly parallel, parts above one triangle need not be cut further.
/// Slivers cut off next to nothing, so what stays long is halved the next time.
template <class Use>
void split(const Triangle_piece& piece, const Triangle_points& t, const Use& use)
{
  constexpr double share_of_length = 0.9;
  if (piece.is_to_be_halved) return halve(piece, use);
  const Vector_3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  Triangle_piece rest = piece;
  boost::container::static_vector<Triangle_piece, 4> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto parts = cut(rest, t[i], (t[(i + 1) % 3] - t[i]).cross(n));
    if (parts[0].corners.empty()) return halve(piece, use);
    rest = parts[0];
    if (!parts[1].corners.empty()) sides.push_back(parts[1]);
  }
  if (sides.empty()) return halve(piece, use);
  sides.push_back(rest);
  const double squared_length = share_of_length * share_of_length * piece.longest_edge().squaredNorm();
  for (Triangle_piece& part : sides) {
    part.is_to_be_halved = part.longest_edge().squaredNorm() > squared_length;
    use(part);
  }
}

} // namespace internal

/// Whether all points of `t` lie within `limit` of the surface. `false` may be wrong, for no more than `max_pieces`
/// pieces of `t` are looked at. `guesses` are places of triangles of the surface near the corners.
template <class Guesses>
bool is_within(const Triangle_tree& tree, const Triangle_points& t, double limit, const Guesses& guesses,
               std::size_t max_pieces)
{
  const double squared_limit = limit * limit;
  Ring<internal::Triangle_piece> pieces{{{t.begin(), t.end()}, 0}};
  for (const std::size_t guess : guesses) {
    if (pieces[0].largest_squared_distance(tree[guess]) <= squared_limit) return true;
    pieces[0].guess = guess;
  }
  for (std::size_t looked_at = 0; !pieces.empty(); ++looked_at) {
    if (looked_at == max_pieces) return false;
    const internal::Triangle_piece piece = pieces.back();
    pieces.pop_back();
    const Vector_3 center = piece.center();
    std::size_t near = tree.towards(center, piece.guess); // any triangle that is near enough will do
    if (squared_distance_to_triangle(center, tree[near]) > squared_limit) {
      const auto nearest = tree.nearest(center, near);
      if (nearest.squared_distance > squared_limit) return false;
      near = nearest.triangle;
    }
    const Triangle_points& to = tree[near];
    if (piece.largest_squared_distance(to) <= squared_limit) continue;
    internal::split(piece, to, [&](internal::Triangle_piece part) {
      part.guess = near;
      if (part.largest_squared_distance(to) > squared_limit) pieces.push_back(part);
    });
  }
  return true;
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
    double bound = std::sqrt(piece.largest_squared_distance(tree[near]));
    if (bound > allowed()) {
      const auto nearest = tree.nearest(center, near);
      near = nearest.triangle;
      lower = (std::max)(lower, std::sqrt(nearest.squared_distance));
      bound = std::sqrt(piece.largest_squared_distance(tree[near]));
    }
    if (bound <= allowed() || ++looked_at >= max_pieces) {
      upper = (std::max)(upper, bound);
      continue;
    }
    internal::split(piece, tree[near], [&](internal::Triangle_piece part) {
      part.guess = near;
      pieces.push_back(part);
    });
  }
  return upper;
}

/// An upper bound, by no more than `precision` too large, of the distance that points of one surface have from the
/// other. A precision that is lost in rounding is replaced by one that is not.
template <class Execution>
double one_sided_distance_bound(const Execution& execution, const Triangle_tree& from, const Triangle_tree& to,
                                Distance_precision precision)
{
  constexpr double rounding = 1e-13;
  precision.absolute = (std::max)(precision.absolute, rounding * (std::max)(to.magnitude(), from.magnitude()));
  const auto larger = [](double a, double b) { return (std::max)(a, b); };
  std::vector<std::size_t> guess(from.size());
  const double lower = std::sqrt(reduce(execution, from.size(), 0.0, [&](std::size_t i) {
    const Vector_3 center = (from[i][0] + from[i][1] + from[i][2]) / 3;
    // both are in order along the same curve, more or less
    const auto nearest = to.nearest(center, to.towards(center, i * to.size() / from.size()));
    guess[i] = nearest.triangle;
    return nearest.squared_distance;
  }, larger));
  return reduce(execution, from.size(), 0.0, [&](std::size_t i) {
    return distance_bound(to, from[i], lower + precision.of(lower), precision, guess[i]);
  }, larger);
}

/// An upper bound of the Hausdorff distance between two surfaces, by no more than `precision` too large. O(n log n) for
/// surfaces that are near each other, and more where the distance is nearly the largest over large parts.
template <class Execution>
double hausdorff_distance_bound(const Execution& execution, const Triangle_tree& a, const Triangle_tree& b,
                                const Distance_precision& precision)
{
  return (std::max)(one_sided_distance_bound(execution, a, b, precision),
                    one_sided_distance_bound(execution, b, a, precision));
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SURFACE_DISTANCE_H

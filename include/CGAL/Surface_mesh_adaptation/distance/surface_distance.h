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

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <boost/container/static_vector.hpp>

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

/// The corners of a triangle.
using Triangle_points = std::array<Vector_3, 3>;

/// Squared distance from `p` to the segment from `a` to `b`.
inline double squared_distance_to_segment(const Vector_3& p, const Vector_3& a, const Vector_3& b)
{
  const Vector_3 e = b - a;
  const double squared_length = e.squaredNorm();
  const double t = squared_length > 0 ? std::clamp((p - a).dot(e) / squared_length, 0.0, 1.0) : 0;
  return (p - a - t * e).squaredNorm();
}

namespace internal {

/// A triangle, which may be degenerate, of which the distance is asked for by many points.
class Prepared_triangle
{
public:
  explicit Prepared_triangle(const Triangle_points& corners)
    : corners_(corners), normal_((corners[1] - corners[0]).cross(corners[2] - corners[0]))
    , squared_area_(normal_.squaredNorm())
  {
    for (std::size_t i = 0; i < 3; ++i) inwards_[i] = normal_.cross(corners[(i + 1) % 3] - corners[i]);
  }

  /// The unit normal; zero if the triangle is degenerate.
  Vector_3 normal() const { return squared_area_ > 0 ? normal_ / std::sqrt(squared_area_) : normal_; }

  struct Distance
  {
    double squared;
    bool is_above;
  };

  /// The squared distance of `p` from the triangle. What is next to `p` lies on an edge that `p` is beyond, or inside.
  Distance squared_distance(const Vector_3& p) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i)
      if (!(squared_area_ > 0) || inwards_[i].dot(p - corners_[i]) < 0)
        least = (std::min)(least, squared_distance_to_segment(p, corners_[i], corners_[(i + 1) % 3]));
    if (least < std::numeric_limits<double>::infinity()) return {least, false};
    const double height = normal_.dot(p - corners_[0]);
    return {height * height / squared_area_, true};
  }

private:
  Triangle_points corners_;
  Vector_3 normal_;
  double squared_area_;             // times four
  std::array<Vector_3, 3> inwards_; // in the plane, orthogonal to the edges
};

} // namespace internal

/// Squared distance from `p` to a triangle, which may be degenerate.
inline double squared_distance_to_triangle(const Vector_3& p, const Triangle_points& t)
{
  return internal::Prepared_triangle(t).squared_distance(p).squared;
}

/// The triangles of a surface in a tree of bounding boxes: four in order along a Hilbert curve in a leaf, and half as
/// many boxes in each level as in the one below. May be asked concurrently.
class Triangle_tree
{
public:
  /// \pre `mesh` has a face that was not removed
  template <class Execution, class Points>
  Triangle_tree(const Execution& execution, const Mesh_view& mesh, const Points& points)
  {
    const std::vector<Index> faces = pack(execution, mesh.number_of_faces(), [&](std::size_t f) {
      return !mesh.is_removed_face(Index(f));
    });
    std::vector<Triangle_points> unsorted(faces.size());
    std::vector<Vector_3> centers(faces.size());
    for_each_index(execution, faces.size(), [&](std::size_t i) {
      for (std::size_t k = 0; k < 3; ++k) unsorted[i][k] = points[mesh.corner[3 * std::size_t(faces[i]) + k]];
      centers[i] = (unsorted[i][0] + unsorted[i][1] + unsorted[i][2]) / 3;
    });
    const std::vector<Index> order = internal::hilbert_order(execution, centers);
    triangles_.resize(order.size());
    place_.resize(mesh.number_of_faces());
    for_each_index(execution, order.size(), [&](std::size_t i) {
      triangles_[i] = unsorted[order[i]];
      place_[faces[order[i]]] = i;
    });
    beyond_.resize(order.size());
    for_each_index(execution, order.size(), [&](std::size_t i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index t = mesh.twin[3 * std::size_t(faces[order[i]]) + k];
        beyond_[i][k] = t == no_index ? i : place_[Mesh_view::face(t)];
      }
    });
    build(execution);
  }

  /// The place in the tree of a face of the mesh.
  std::size_t place(Index face) const { return place_[face]; }

  std::size_t size() const { return triangles_.size(); }  ///< number of triangles
  const Triangle_points& operator[](std::size_t i) const { return triangles_[i]; }  ///< the one at place `i`

  /// The diagonal of the bounding box.
  double extent() const { return (levels_.back()[0].high - levels_.back()[0].low).norm(); }

  /// About the distance of the farthest point from the origin, by which coordinates are rounded.
  double magnitude() const
  {
    const Box& box = levels_.back()[0];
    return (std::max)(box.low.norm(), box.high.norm());
  }

  /// What `nearest()` finds.
  struct Nearest
  {
    double squared_distance = std::numeric_limits<double>::infinity();  ///< of that triangle
    std::size_t triangle = 0;  ///< its place in the tree
  };

  /// The triangle next to `p`; a guess for it saves time. Near O(log n).
  Nearest nearest(const Vector_3& p, std::size_t guess = 0) const
  {
    Nearest best{squared_distance_to_triangle(p, triangles_[guess]), guess};
    boost::container::static_vector<Entry, 64> stack;
    stack.push_back({levels_.size() - 1, 0, 0});
    while (!stack.empty()) {
      const Entry e = stack.back();
      stack.pop_back();
      if (e.squared_distance >= best.squared_distance) continue;
      if (e.level == 0) visit_leaf(e.index, p, best);
      else push_children(e, p, stack);
    }
    return best;
  }

  /// A triangle near `p`, reached from `start` across edges that `p` lies beyond. Where the surface is nearly flat it
  /// is the one next to `p`; it may be any.
  std::size_t towards(const Vector_3& p, std::size_t start) const
  {
    constexpr int max_steps = 8;
    std::size_t i = start;
    for (int step = 0; step < max_steps; ++step) {
      const std::size_t next = step_towards(p, i);
      if (next == i) break;
      i = next;
    }
    return i;
  }

private:
  struct Box
  {
    Vector_3 low, high;

    double squared_distance(const Vector_3& p) const
    {
      return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
    }
  };

  struct Entry
  {
    std::size_t level, index;
    double squared_distance;
  };

  static constexpr std::size_t leaf_size = 4;

  template <class Execution>
  void build(const Execution& execution)
  {
    levels_.emplace_back((size() + leaf_size - 1) / leaf_size);
    for_each_index(execution, levels_[0].size(), [&](std::size_t i) {
      Box box{triangles_[leaf_size * i][0], triangles_[leaf_size * i][0]};
      for (std::size_t j = leaf_size * i; j < (std::min)(leaf_size * (i + 1), size()); ++j)
        for (const Vector_3& p : triangles_[j]) box = {box.low.cwiseMin(p), box.high.cwiseMax(p)};
      levels_[0][i] = box;
    });
    while (levels_.back().size() > 1) {
      const std::vector<Box>& below = levels_.back();
      std::vector<Box> level((below.size() + 1) / 2);
      for_each_index(execution, level.size(), [&](std::size_t i) {
        const Box &a = below[2 * i], &b = below[(std::min)(2 * i + 1, below.size() - 1)];
        level[i] = {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
      });
      levels_.push_back(std::move(level));
    }
  }

  /// The triangle across the edge of triangle `i` beyond which `p` lies farthest, or `i`.
  std::size_t step_towards(const Vector_3& p, std::size_t i) const
  {
    const Triangle_points& t = triangles_[i];
    const Vector_3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    double farthest = 0;
    std::size_t next = i;
    for (std::size_t k = 0; k < 3; ++k) {
      const double inside = n.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k]));
      if (inside < farthest) {
        farthest = inside;
        next = beyond_[i][k];
      }
    }
    return next;
  }

  void visit_leaf(std::size_t leaf, const Vector_3& p, Nearest& best) const
  {
    for (std::size_t i = leaf_size * leaf; i < (std::min)(leaf_size * (leaf + 1), size()); ++i) {
      const double d = squared_distance_to_triangle(p, triangles_[i]);
      if (d < best.squared_distance) best = {d, i};
    }
  }

  /// The nearer child last, so that it is next.
  template <class Stack>
  void push_children(const Entry& e, const Vector_3& p, Stack& stack) const
  {
    const std::vector<Box>& below = levels_[e.level - 1];
    Entry first{e.level - 1, 2 * e.index, below[2 * e.index].squared_distance(p)};
    if (2 * e.index + 1 < below.size()) {
      Entry second{e.level - 1, 2 * e.index + 1, below[2 * e.index + 1].squared_distance(p)};
      if (second.squared_distance < first.squared_distance) std::swap(first, second);
      stack.push_back(second);
    }
    stack.push_back(first);
  }

  std::vector<Triangle_points> triangles_;
  std::vector<std::size_t> place_;        ///< of each face
  std::vector<std::array<std::size_t, 3>> beyond_; ///< the triangle across each edge; itself at the boundary
  std::vector<std::vector<Box>> levels_;  ///< from the leaves to the root
};

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

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which triangle of a surface is nearest to a point.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_TRIANGLE_TREE_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_TRIANGLE_TREE_H

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
#include <utility>
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

/// The corners of the face of `h`, that of `h` first.
template <class Points>
Triangle_points corners_from(const Mesh_view& mesh, const Points& points, Index h)
{
  return {points[mesh.source(h)], points[mesh.target(h)], points[mesh.apex(h)]};
}

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

/// Where the line through `p` with the unit direction `d` meets the triangle, from `p`; infinite if nowhere. Lines between
/// two triangles meet one of them.
inline double distance_along_line(const Vector_3& p, const Vector_3& d, const Triangle_points& t)
{
  constexpr double rounding = 1e-9, none = std::numeric_limits<double>::infinity();
  const Vector_3 e = t[1] - t[0], f = t[2] - t[0], df = d.cross(f), x = p - t[0], xe = x.cross(e);
  const double determinant = e.dot(df);
  if (determinant == 0) return none;
  const double u = x.dot(df) / determinant, v = d.dot(xe) / determinant;
  return u >= -rounding && v >= -rounding && u + v <= 1 + rounding ? f.dot(xe) / determinant : none;
}

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
    for_each_index(execution, faces.size(), [&](std::size_t i) {
      for (std::size_t k = 0; k < 3; ++k) unsorted[i][k] = points[mesh.corner[3 * std::size_t(faces[i]) + k]];
    });
    const std::vector<Index> order = sort(execution, unsorted);
    face_.resize(order.size());
    place_.resize(mesh.number_of_faces());
    for_each_index(execution, order.size(), [&](std::size_t i) {
      face_[i] = faces[order[i]];
      place_[face_[i]] = i;
    });
    beyond_.resize(order.size());
    for_each_index(execution, order.size(), [&](std::size_t i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index t = mesh.twin[3 * std::size_t(face_[i]) + k];
        beyond_[i][k] = t == no_index ? i : place_[Mesh_view::face(t)];
      }
    });
    build(execution);
  }

  /// Of triangles that are no faces of a mesh, with nothing beyond their edges. \pre there is one
  template <class Execution>
  Triangle_tree(const Execution& execution, const std::vector<Triangle_points>& triangles)
  {
    face_ = sort(execution, triangles);
    place_.resize(face_.size());
    beyond_.resize(face_.size());
    for_each_index(execution, face_.size(), [&](std::size_t i) {
      place_[face_[i]] = i;
      beyond_[i] = {i, i, i};
    });
    build(execution);
  }

  /// The place in the tree of a face of the mesh.
  std::size_t place(Index face) const { return place_[face]; }

  /// The face of the mesh at place `i`.
  Index face(std::size_t i) const { return face_[i]; }

  /// The places of the triangles across the edges of the one at place `i`; its own at the boundary.
  const std::array<std::size_t, 3>& beyond(std::size_t i) const { return beyond_[i]; }

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
    return nearer_than({squared_distance_to_triangle(p, triangles_[guess]), guess}, p);
  }

  /// The triangle next to `p`, if one is nearer than `best`; `best` if none is. The nearer that is, the less is looked at.
  Nearest nearer_than(Nearest best, const Vector_3& p) const
  {
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

  /// Whether a triangle is nearer to `p` than `distance`.
  bool is_near(const Vector_3& p, double distance) const
  {
    return nearer_than({distance * distance, size()}, p).triangle != size();
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

  /// What a ray meets.
  struct Hit
  {
    double distance = std::numeric_limits<double>::infinity();  ///< from its start; infinite: nothing
    std::size_t triangle = 0;  ///< its place in the tree
  };

  /// The first triangles, of those that are not `is_ignored(i)`, that the line through `p` with the unit direction `d`
  /// meets within `reach` of `p`, on the side of `d` and on the other one. Near O(log n).
  template <class IsIgnored>
  std::array<Hit, 2> first_hits(const Vector_3& p, const Vector_3& d, double reach, const IsIgnored& is_ignored) const
  {
    std::array<Hit, 2> best;
    best[0].distance = best[1].distance = reach;
    const Vector_3 inverse = d.cwiseInverse();
    descend([&](std::size_t level, std::size_t index) {
      return levels_[level][index].is_met(p, inverse, -best[1].distance, best[0].distance);
    }, [&](std::size_t leaf_met) { visit_leaf(leaf_met, p, d, is_ignored, best); });
    for (Hit& hit : best)
      if (hit.distance == reach) hit = Hit();
    return best;
  }

  /// Calls `f(i, j)` for the places `i <= j` of triangles, with `i` in the leaf `leaf`, whose bounding boxes meet.
  template <class F>
  void for_each_pair_of_boxes(std::size_t leaf, const F& f) const
  {
    const Box& box = levels_[0][leaf];
    descend([&](std::size_t level, std::size_t index) {
      return ((index + 1) << level) > leaf && levels_[level][index].meets(box);
    }, [&](std::size_t other) { visit_pairs(leaf, other, f); });
  }

  /// Calls `f(i)` for the places of triangles whose bounding boxes meet that of `t`.
  template <class F>
  void for_each_box_at(const Triangle_points& t, const F& f) const
  {
    const Box box = box_of(t);
    descend([&](std::size_t level, std::size_t index) { return levels_[level][index].meets(box); },
            [&](std::size_t leaf) {
      for (std::size_t i = leaf_size * leaf; i < end_of_leaf(leaf); ++i)
        if (box.meets(box_of(triangles_[i]))) f(i);
    });
  }

  std::size_t number_of_leaves() const { return levels_[0].size(); }

private:
  struct Box
  {
    Vector_3 low, high;

    double squared_distance(const Vector_3& p) const
    {
      return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
    }

    /// Whether the line through `p` in a direction, of which the coordinates have these inverses, comes there between
    /// the distances `begin` and `end` from `p`.
    bool is_met(const Vector_3& p, const Vector_3& inverse, double begin, double end) const
    {
      for (int k = 0; k < 3; ++k) {
        const double a = (low[k] - p[k]) * inverse[k], b = (high[k] - p[k]) * inverse[k];
        begin = (std::max)(begin, (std::min)(a, b)); // in this order a NaN, of 0 times infinity, does not count
        end = (std::min)(end, (std::max)(a, b));
      }
      return begin <= end;
    }

    bool meets(const Box& other) const
    {
      return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
    }
  };

  static Box box_of(const Triangle_points& t)
  {
    return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
  }

  struct Entry
  {
    std::size_t level, index;
    double squared_distance;
  };

  static constexpr std::size_t leaf_size = 4;

  static Box hull(const Box& a, const Box& b) { return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)}; }

  std::size_t end_of_leaf(std::size_t leaf) const { return (std::min)(leaf_size * (leaf + 1), size()); }

  /// Takes over the triangles in order along a Hilbert curve; returns which of them comes where.
  template <class Execution>
  std::vector<Index> sort(const Execution& execution, const std::vector<Triangle_points>& unsorted)
  {
    std::vector<Vector_3> centers(unsorted.size());
    for_each_index(execution, centers.size(), [&](std::size_t i) {
      centers[i] = (unsorted[i][0] + unsorted[i][1] + unsorted[i][2]) / 3;
    });
    std::vector<Index> order = internal::hilbert_order(execution, centers);
    triangles_.resize(order.size());
    for_each_index(execution, order.size(), [&](std::size_t i) { triangles_[i] = unsorted[order[i]]; });
    return order;
  }

  template <class Execution>
  void build(const Execution& execution)
  {
    levels_.emplace_back((size() + leaf_size - 1) / leaf_size);
    for_each_index(execution, levels_[0].size(), [&](std::size_t i) {
      Box box = box_of(triangles_[leaf_size * i]);
      for (std::size_t j = leaf_size * i + 1; j < end_of_leaf(i); ++j) box = hull(box, box_of(triangles_[j]));
      levels_[0][i] = box;
    });
    while (levels_.back().size() > 1) {
      const std::vector<Box>& below = levels_.back();
      std::vector<Box> level((below.size() + 1) / 2);
      for_each_index(execution, level.size(), [&](std::size_t i) {
        level[i] = hull(below[2 * i], below[(std::min)(2 * i + 1, below.size() - 1)]);
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
    for (std::size_t i = leaf_size * leaf; i < end_of_leaf(leaf); ++i) {
      const double d = squared_distance_to_triangle(p, triangles_[i]);
      if (d < best.squared_distance) best = {d, i};
    }
  }

  template <class IsIgnored>
  void visit_leaf(std::size_t leaf, const Vector_3& p, const Vector_3& d, const IsIgnored& is_ignored,
                  std::array<Hit, 2>& best) const
  {
    for (std::size_t i = leaf_size * leaf; i < end_of_leaf(leaf); ++i) {
      const double along = internal::distance_along_line(p, d, triangles_[i]), distance = std::abs(along);
      Hit& hit = best[along < 0];
      if (distance < hit.distance && !is_ignored(i)) hit = {distance, i};
    }
  }

  /// Calls `visit(leaf)` for the leaves below boxes that `is_entered(level, index)`, in order.
  template <class IsEntered, class Visit>
  void descend(const IsEntered& is_entered, const Visit& visit) const
  {
    boost::container::static_vector<std::pair<std::size_t, std::size_t>, 64> stack{{levels_.size() - 1, 0}};
    while (!stack.empty()) {
      const std::size_t level = stack.back().first, index = stack.back().second;
      stack.pop_back();
      if (!is_entered(level, index)) continue;
      if (level == 0) visit(index);
      else
        for (const std::size_t child : {2 * index + 1, 2 * index})
          if (child < levels_[level - 1].size()) stack.push_back({level - 1, child});
    }
  }

  /// Calls `f(i, j)` for the places `i <= j` in two leaves whose boxes meet.
  template <class F>
  void visit_pairs(std::size_t first, std::size_t second, const F& f) const
  {
    for (std::size_t i = leaf_size * first; i < end_of_leaf(first); ++i) {
      const Box box = box_of(triangles_[i]);
      for (std::size_t j = (std::max)(leaf_size * second, i); j < end_of_leaf(second); ++j)
        if (box.meets(box_of(triangles_[j]))) f(i, j);
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
  std::vector<Index> face_;               ///< of each triangle
  std::vector<std::size_t> place_;        ///< of each face
  std::vector<std::array<std::size_t, 3>> beyond_; ///< the triangle across each edge; itself at the boundary
  std::vector<std::vector<Box>> levels_;  ///< from the leaves to the root
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_TRIANGLE_TREE_H

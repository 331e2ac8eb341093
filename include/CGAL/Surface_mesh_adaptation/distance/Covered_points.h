// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of the input that the faces of an adapted mesh cover: its vertices, the centroids of its faces, and some on edges
// where it bends so much that a face between these points may cut the edge off. An operation that replaces faces keeps the
// distance from the input to the mesh if the points that the old ones cover are near the new ones, to which they are handed
// on. However many operations there are, nothing adds up.
//
// Each face has a list of its points, linked through them. Operations write the lists of the faces that they replace
// alone.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_COVERED_POINTS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_COVERED_POINTS_H

#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Point_lists.h>
#include <CGAL/Surface_mesh_adaptation/mesh/restructure.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Where edges are covered, too.
struct Covered_edges
{
  double least_height;   ///< of their middle above the line between the centroids of their faces
  double least_distance; ///< of points on them
  std::size_t points;    ///< on each of them, at most
};

class Covered_points
{
public:
  /// The faces of `mesh`, none of which is removed, cover themselves. Work: O(n).
  template <class Execution, class Points>
  Covered_points(const Execution& execution, const Mesh_view& mesh, const Points& points, const Covered_edges& edges)
  {
    const std::size_t n = mesh.number_of_faces();
    Buffer<Index> offset;
    const std::size_t size = exclusive_scan(execution, n, offset, [&](std::size_t f) {
      Index count = 0;
      for_each_own_point(mesh, points, edges, Index(f), [&](const Vector_3&) { ++count; });
      return count;
    });
    lists_.resize(n, size);
    points_.resize(size);
    for_each_index(execution, n, [&](std::size_t f) {
      lists_.first[f] = no_index;
      Index i = offset[f];
      for_each_own_point(mesh, points, edges, Index(f), [&](const Vector_3& p) {
        points_[i] = p;
        lists_.link(i++, Index(f));
      });
    });
  }

  /// Whether all points that `faces` cover are within `distance` of `triangles`: looked at first for those of the k-th face
  /// is the k-th of these.
  template <class Faces, class Triangles>
  bool are_near(const Faces& faces, const Triangles& triangles, double distance) const
  {
    return for_each_point_while(faces, triangles, [&](Index i, const auto& prepared, std::size_t& hint) {
      return is_near(points_[i], prepared, distance * distance, hint);
    });
  }

  /// For points of faces that are to be replaced: which of the triangles that do so covers them then.
  using Owners = boost::container::small_vector<std::pair<Index, std::size_t>, 96>;

  /// Finds the `owners` of the points that `faces` cover among `triangles`, looked at first for those of the k-th face is the
  /// k-th of these. Returns `false` once a point is not within `distance` of all.
  template <class Faces, class Triangles>
  bool find_owners(const Faces& faces, const Triangles& triangles, double distance, Owners& owners) const
  {
    return for_each_point_while(faces, triangles, [&](Index i, const auto& prepared, std::size_t& hint) {
      const Nearest nearest = nearest_of(points_[i], prepared, distance * distance, hint);
      hint = nearest.triangle;
      owners.emplace_back(i, hint);
      return nearest.squared_distance <= distance * distance;
    });
  }

  /// Hands the points that `faces` cover on to their owners among these, which `find_owners()` has found.
  template <class Faces>
  void hand_over(const Faces& faces, const Owners& owners)
  {
    for (const Index f : faces) lists_.first[f] = no_index;
    for (const auto& [point, k] : owners) lists_.link(point, faces[k]);
  }

  /// Hands the points of `faces` on to those of them that are left: to one that they are above, within `distance`, or to the
  /// nearest.
  template <class Faces>
  void hand_over(const Mesh_view& mesh, const Buffer<Vector_3>& points, const Faces& faces, double distance)
  {
    Ring<Index> moving;
    for (const Index f : faces) {
      for (Index i = lists_.first[f]; i != no_index; i = lists_.next[i]) moving.push_back(i);
      lists_.first[f] = no_index;
    }
    Ring<Index> left;
    for (const Index f : faces)
      if (!mesh.is_removed_face(f)) left.push_back(f);
    link_to_nearest(moving, mesh, points, left, distance);
  }

  /// Hands the points of all faces on to their children; `mesh` and `points` are as the plan made them.
  template <class Execution>
  void hand_to_children(const Execution& execution, const Restructuring& plan, const Mesh_view& mesh,
                        const Buffer<Vector_3>& points, double distance)
  {
    Buffer<Index> first_of_parents;
    first_of_parents.swap(lists_.first);
    fill(execution, lists_.first, mesh.number_of_faces(), Index(no_index));
    for_each_index(execution, first_of_parents.size(), [&](std::size_t parent) {
      Ring<Index> moving, children;
      for (Index i = first_of_parents[parent]; i != no_index; i = lists_.next[i]) moving.push_back(i);
      const Index end = plan.first_child(Index(parent) + 1);
      for (Index f = plan.first_child(Index(parent)); f < end; ++f) children.push_back(f);
      if (!children.empty()) link_to_nearest(moving, mesh, points, children, distance);
    }, heavy_chunk_length);
  }

private:
  /// Calls `add(p)` for the centroid of `f`, and those of its corners and points on its edges that no other face has.
  template <class Points, class Add>
  static void for_each_own_point(const Mesh_view& mesh, const Points& points, const Covered_edges& edges, Index f,
                                 const Add& add)
  {
    const auto corner = [&](Index k) -> const Vector_3& { return points[mesh.corner[3 * std::size_t(f) + k]]; };
    for (Index k = 0; k < 3; ++k)
      if (mesh.outgoing[mesh.corner[3 * std::size_t(f) + k]] == 3 * f + k) add(corner(k));
    add((corner(0) + corner(1) + corner(2)) / 3);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (!mesh.is_edge_owner(h) || mesh.is_border(h) || height_of_bend(mesh, points, h) <= edges.least_height) continue;
      const Vector_3 &p = points[mesh.source(h)], way = points[mesh.target(h)] - p;
      const double n = (std::min)(double(edges.points), std::floor(way.norm() / edges.least_distance));
      for (double i = 1; i <= n; ++i) add(p + i / (n + 1) * way);
    }
  }

  /// How far the middle of an edge is from the line between the centroids of its faces.
  template <class Points>
  static double height_of_bend(const Mesh_view& mesh, const Points& points, Index h)
  {
    const Vector_3 ends = points[mesh.source(h)] + points[mesh.target(h)];
    return std::sqrt(squared_distance_to_segment(ends / 2, (ends + points[mesh.apex(h)]) / 3,
                                                 (ends + points[mesh.apex(mesh.twin[h])]) / 3));
  }

  /// Calls `use(i, prepared, hint)` for the points `i` that `faces` cover, until it returns `false`; whether it never did.
  /// `hint` is the place of the triangle to look at first, which `use` may change: at first the k-th for the k-th face.
  template <class Faces, class Triangles, class Use>
  bool for_each_point_while(const Faces& faces, const Triangles& triangles, const Use& use) const
  {
    Ring<internal::Prepared_triangle> prepared;
    for (const Triangle_points& t : triangles) prepared.emplace_back(t);
    std::size_t k = 0;
    for (const Index f : faces) {
      std::size_t hint = (std::min)(k++, prepared.size() - 1);
      for (Index i = lists_.first[f]; i != no_index; i = lists_.next[i])
        if (!use(i, prepared, hint)) return false;
    }
    return true;
  }

  template <class Triangles>
  static bool is_near(const Vector_3& p, const Triangles& triangles, double squared_distance, std::size_t& hint)
  {
    for (std::size_t n = triangles.size(), i = hint; n > 0; --n, i = i + 1 < triangles.size() ? i + 1 : 0)
      if (triangles[i].squared_distance(p).squared <= squared_distance) {
        hint = i;
        return true;
      }
    return false;
  }

  void link_to_nearest(const Ring<Index>& moving, const Mesh_view& mesh, const Buffer<Vector_3>& points,
                       const Ring<Index>& faces, double distance)
  {
    Ring<internal::Prepared_triangle> triangles;
    for (const Index f : faces) triangles.emplace_back(internal::corners_from(mesh, points, 3 * f));
    std::size_t hint = 0; // points that follow each other mostly belong to one face
    for (const Index i : moving) {
      hint = nearest_of(points_[i], triangles, distance * distance, hint).triangle;
      lists_.link(i, faces[hint]);
    }
  }

  struct Nearest
  {
    double squared_distance;
    std::size_t triangle;
  };

  /// The triangle next to `p`, or the first one from `hint` on that `p` is above and near enough to.
  static Nearest nearest_of(const Vector_3& p, const Ring<internal::Prepared_triangle>& triangles,
                            double squared_near_enough, std::size_t hint)
  {
    Nearest result{std::numeric_limits<double>::infinity(), hint};
    for (std::size_t n = triangles.size(), i = hint; n > 0; --n, i = i + 1 < triangles.size() ? i + 1 : 0) {
      const auto d = triangles[i].squared_distance(p);
      if (d.is_above && d.squared <= squared_near_enough) return {d.squared, i};
      if (d.squared < result.squared_distance) result = {d.squared, i};
    }
    return result;
  }

  internal::Point_lists lists_;
  Buffer<Vector_3> points_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_COVERED_POINTS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of the input that the faces of an adapted mesh cover: its vertices, the middles of its edges and the centroids
// of its faces. An operation that replaces faces keeps the distance from the input to the mesh if the points that the
// old ones cover are near the new ones, to which they are handed on. However many operations there are, nothing adds
// up.
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

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {

class Covered_points
{
public:
  /// The faces of `mesh`, none of which is removed, cover themselves. Work: O(n).
  template <class Execution, class Points>
  Covered_points(const Execution& execution, const Mesh_view& mesh, const Points& points)
  {
    const std::size_t n = mesh.number_of_faces();
    Buffer<Index> offset;
    const std::size_t size = exclusive_scan(execution, n, offset, [&](std::size_t f) {
      Index count = 0;
      for_each_own_point(mesh, points, Index(f), [&](const Vector_3&) { ++count; });
      return count;
    });
    lists_.resize(n, size);
    points_.resize(size);
    for_each_index(execution, n, [&](std::size_t f) {
      lists_.first[f] = no_index;
      Index i = offset[f];
      for_each_own_point(mesh, points, Index(f), [&](const Vector_3& p) {
        points_[i] = p;
        lists_.link(i++, Index(f));
      });
    });
  }

  /// Whether all points that `faces` cover are within `distance` of `triangles`.
  template <class Faces, class Triangles>
  bool are_near(const Faces& faces, const Triangles& triangles, double distance) const
  {
    Ring<internal::Prepared_triangle> prepared;
    for (const Triangle_points& t : triangles) prepared.emplace_back(t);
    std::size_t hint = 0; // points that follow each other are mostly near the same triangle
    for (const Index f : faces)
      for (Index i = lists_.first[f]; i != no_index; i = lists_.next[i])
        if (!is_near(points_[i], prepared, distance * distance, hint)) return false;
    return true;
  }

  /// Hands the points of `faces` on to the nearest of those of them that are left.
  template <class Faces>
  void hand_over(const Mesh_view& mesh, const Buffer<Vector_3>& points, const Faces& faces)
  {
    Ring<Index> moving;
    for (const Index f : faces) {
      for (Index i = lists_.first[f]; i != no_index; i = lists_.next[i]) moving.push_back(i);
      lists_.first[f] = no_index;
    }
    Ring<Index> left;
    for (const Index f : faces)
      if (!mesh.is_removed_face(f)) left.push_back(f);
    link_to_nearest(moving, mesh, points, left);
  }

  /// Hands the points of all faces on to their children; `mesh` and `points` are as the plan made them.
  template <class Execution>
  void hand_to_children(const Execution& execution, const Restructuring& plan, const Mesh_view& mesh,
                        const Buffer<Vector_3>& points)
  {
    Buffer<Index> first_of_parents;
    first_of_parents.swap(lists_.first);
    fill(execution, lists_.first, mesh.number_of_faces(), Index(no_index));
    for_each_index(execution, first_of_parents.size(), [&](std::size_t parent) {
      Ring<Index> moving, children;
      for (Index i = first_of_parents[parent]; i != no_index; i = lists_.next[i]) moving.push_back(i);
      const Index end = plan.first_child(Index(parent) + 1);
      for (Index f = plan.first_child(Index(parent)); f < end; ++f) children.push_back(f);
      if (!children.empty()) link_to_nearest(moving, mesh, points, children);
    }, heavy_chunk_length);
  }

private:
  /// Calls `add(p)` for the centroid of `f` and those of its corners and middles of edges that no other face has.
  template <class Points, class Add>
  static void for_each_own_point(const Mesh_view& mesh, const Points& points, Index f, const Add& add)
  {
    const auto corner = [&](Index k) -> const Vector_3& { return points[mesh.corner[3 * std::size_t(f) + k % 3]]; };
    for (Index k = 0; k < 3; ++k) {
      if (mesh.outgoing[mesh.corner[3 * std::size_t(f) + k]] == 3 * f + k) add(corner(k));
      if (mesh.is_edge_owner(3 * f + k)) add((corner(k) + corner(k + 1)) / 2);
    }
    add((corner(0) + corner(1) + corner(2)) / 3);
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
                       const Ring<Index>& faces)
  {
    Ring<internal::Prepared_triangle> triangles;
    for (const Index f : faces) {
      const auto corner = [&](std::size_t k) { return points[mesh.corner[3 * std::size_t(f) + k]]; };
      triangles.emplace_back(Triangle_points{corner(0), corner(1), corner(2)});
    }
    for (const Index i : moving) {
      std::pair<double, Index> nearest{std::numeric_limits<double>::infinity(), faces.front()};
      for (std::size_t k = 0; k < faces.size(); ++k)
        nearest = (std::min)(nearest, {triangles[k].squared_distance(points_[i]).squared, faces[k]});
      lists_.link(i, nearest.second);
    }
  }

  internal::Point_lists lists_;
  Buffer<Vector_3> points_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_COVERED_POINTS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of a surface intersect others, as CGAL's exact predicates see it. Nearly all of the pairs whose bounding
// boxes meet are told apart by a plane between them first, with room for the rounding of it.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SELF_INTERSECTIONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SELF_INTERSECTIONS_H

#include <CGAL/Surface_mesh_adaptation/distance/Surroundings.h>
#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// The numbers of two faces.
using Face_pair = std::array<Index, 2>;

namespace internal {

/// What the terms of a product of three vectors are rounded by, at most, in the lengths of these.
constexpr double rounding_of_products = 1e-14;

/// Whether all of `points` are on the side of the plane through `o` that `normal` points to, or all on the other one; the
/// normal is rounded by `rounding_of_products` times `size`.
template <class Points>
bool are_beside_plane(const Vector_3& o, const Vector_3& normal, double size, const Points& points)
{
  int above = 0, below = 0;
  for (const Vector_3& p : points) {
    const Vector_3 d = p - o;
    const double height = normal.dot(d), rounding = rounding_of_products * size * d.norm();
    if (height > rounding) ++above;
    else if (height < -rounding) ++below;
    else return false;
  }
  return above == 0 || below == 0;
}

/// Whether the plane of `t` has no point of `other`.
inline bool is_beside_plane_of(const Triangle_points& t, const Triangle_points& other)
{
  const Vector_3 e = t[1] - t[0], f = t[2] - t[0];
  return are_beside_plane(t[0], e.cross(f), e.norm() * f.norm(), other);
}

/// Whether a plane through the corner 0 of both has nothing else of them and parts them: the one between their middles.
inline bool are_parted_at_corner(const Triangle_points& s, const Triangle_points& t)
{
  const auto middle = [](const Triangle_points& x) -> Vector_3 {
    return (x[1] - x[0]).normalized() + (x[2] - x[0]).normalized();
  };
  const Vector_3 normal = middle(s) - middle(t);
  const auto is_above = [&](const Vector_3& d) { return normal.dot(d) > rounding_of_products * d.norm(); };
  return is_above(s[1] - s[0]) && is_above(s[2] - s[0]) && is_above(t[0] - t[1]) && is_above(t[0] - t[2]);
}

/// Whether the faces on both sides of an edge, from corner 0 to 1 of `s` and from 1 to 0 of `t`, are turned by less than
/// 90 degrees.
inline bool are_unfolded(const Triangle_points& s, const Triangle_points& t)
{
  const Vector_3 e = s[1] - s[0], f = s[2] - s[0], g = t[2] - s[0];
  return e.cross(f).dot(g.cross(e)) > rounding_of_products * e.squaredNorm() * f.norm() * g.norm();
}

class Exact_intersections
{
public:
  /// Whether the triangle has no area.
  static bool is_degenerate(const Triangle_points& t) { return CGAL::collinear(point(t[0]), point(t[1]), point(t[2])); }

  /// Whether triangles that share nothing meet.
  static bool meet(const Triangle_points& s, const Triangle_points& t)
  {
    return !is_beside_plane_of(s, t) && !is_beside_plane_of(t, s) && CGAL::do_intersect(triangle(s), triangle(t));
  }

  /// Whether triangles that share their corner 0 meet elsewhere.
  static bool meet_beyond_corner(const Triangle_points& s, const Triangle_points& t)
  {
    return !are_parted_at_corner(s, t) && (CGAL::do_intersect(triangle(s), Segment(point(t[1]), point(t[2]))) ||
                                           CGAL::do_intersect(triangle(t), Segment(point(s[1]), point(s[2]))));
  }

  /// Whether triangles with the edge from corner 0 to 1 of `s`, and from 1 to 0 of `t`, meet elsewhere.
  static bool meet_beyond_edge(const Triangle_points& s, const Triangle_points& t)
  {
    if (are_unfolded(s, t)) return false;
    const auto a = point(s[0]), b = point(s[1]), c = point(s[2]), d = point(t[2]);
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Segment = Kernel::Segment_3;

  static Kernel::Point_3 point(const Vector_3& p) { return {p[0], p[1], p[2]}; }

  static Kernel::Triangle_3 triangle(const Triangle_points& t) { return {point(t[0]), point(t[1]), point(t[2])}; }
};

/// Whether the faces `f` and `g`, of which none is degenerate, meet in more than the vertices and edges that they share.
template <class Points>
bool do_intersect(const Mesh_view& mesh, const Points& points, Index f, Index g)
{
  Index shared = 0, at_f = 3 * f, at_g = 3 * g;
  for (Index h = 3 * f; h < 3 * f + 3; ++h) {
    if (mesh.twin[h] != no_index && Mesh_view::face(mesh.twin[h]) == g)
      return Exact_intersections::meet_beyond_edge(corners_from(mesh, points, h), corners_from(mesh, points, mesh.twin[h]));
    for (Index k = 3 * g; k < 3 * g + 3; ++k)
      if (mesh.source(h) == mesh.source(k)) {
        ++shared;
        at_f = h;
        at_g = k;
      }
  }
  const Triangle_points s = corners_from(mesh, points, at_f), t = corners_from(mesh, points, at_g);
  return shared == 0 ? Exact_intersections::meet(s, t) : Exact_intersections::meet_beyond_corner(s, t);
}

/// Whether the triangle `t` meets one of `tree`. Those without an area meet nothing.
inline bool do_intersect(const Triangle_tree& tree, const Triangle_points& t)
{
  using Exact = Exact_intersections;
  bool is_met = false;
  tree.for_each_box_at(t, [&](std::size_t i) {
    is_met = is_met || (!Exact::is_degenerate(t) && !Exact::is_degenerate(tree[i]) && Exact::meet(t, tree[i]));
  });
  return is_met;
}

} // namespace internal

/// The pairs of faces that meet in more than the vertices and edges that they share, and each degenerate face as a pair
/// with itself, in the order of `tree`, which has the faces of `mesh`. As `self_intersections` of Polygon Mesh Processing.
/// \pre no two edges have the same ends
/// \par Complexity
/// O(n log n) where few bounding boxes of faces meet others than those of neighbours
template <class Execution, class Points>
std::vector<Face_pair> self_intersections(const Execution& execution, const Mesh_view& mesh, const Points& points,
                                          const Triangle_tree& tree)
{
  std::vector<std::uint8_t> is_degenerate(tree.size());
  for_each_index(execution, tree.size(), [&](std::size_t i) {
    is_degenerate[i] = internal::Exact_intersections::is_degenerate(tree[i]) ? 1 : 0;
  });
  const auto intersect = [&](std::size_t i, std::size_t j) {
    if (i == j || is_degenerate[i] || is_degenerate[j]) return i == j && is_degenerate[i];
    return internal::do_intersect(mesh, points, tree.face(i), tree.face(j));
  };
  return gather<Face_pair>(execution, tree.number_of_leaves(), heavy_chunk_length,
                           [&](std::size_t begin, std::size_t end, std::vector<Face_pair>& pairs) {
    for (std::size_t leaf = begin; leaf < end; ++leaf)
      tree.for_each_pair_of_boxes(leaf, [&](std::size_t i, std::size_t j) {
        if (intersect(i, j)) pairs.push_back({tree.face(i), tree.face(j)});
      });
  });
}

/// The same with a tree of its own; and each face that meets the surroundings, if there are any, as a pair with itself.
template <class Execution, class Points>
std::vector<Face_pair> self_intersections(const Execution& execution, const Mesh_view& mesh, const Points& points,
                                          const Surroundings& surroundings = {})
{
  std::vector<Face_pair> pairs = self_intersections(execution, mesh, points, Triangle_tree(execution, mesh, points));
  if (!surroundings.triangles) return pairs;
  const auto [low, high] = internal::bounding_box(points);
  const std::vector<Triangle_points> around = surroundings.triangles(low, high);
  if (around.empty()) return pairs;
  const Triangle_tree tree(execution, around);
  const auto met = pack(execution, mesh.number_of_faces(), [&](std::size_t f) {
    return !mesh.is_removed_face(Index(f)) && surroundings.is_inside(mesh, Index(f)) &&
           internal::do_intersect(tree, internal::corners_from(mesh, points, Index(3 * f)));
  }, heavy_chunk_length);
  for (const Index f : met) pairs.push_back({f, f});
  return pairs;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SELF_INTERSECTIONS_H

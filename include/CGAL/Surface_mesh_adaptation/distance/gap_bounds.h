// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far sheets of a surface may be left so that they do not meet others which are near them in space, but not along the
// surface: by less than half the gap, on either side of it. Gaps are measured at the vertices, along the normals.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_GAP_BOUNDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_GAP_BOUNDS_H

#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The width of the gap at a triangle of a tree.
struct Gap
{
  std::size_t triangle;
  double width;
};

/// Calls `add(gap)` for the triangles that the normal of the vertex `v` meets on either side within `reach`, and for those
/// around `v`. Triangles that a neighbour of `v` has are near along the surface.
template <class Points, class Add>
void for_each_gap(const Mesh_view& mesh, const Points& points, const Triangle_tree& tree, Index v, double reach,
                  const Add& add)
{
  Ring<Index> near{v}, around;
  Vector_3 normal = Vector_3::Zero();
  mesh.for_each_neighbor(v, [&](Index w) { near.push_back(w); });
  mesh.for_each_outgoing(v, [&](Index h) {
    around.push_back(Mesh_view::face(h));
    normal += (points[mesh.target(h)] - points[v]).cross(points[mesh.apex(h)] - points[v]);
  });
  if (!(normal.norm() > 0)) return;
  normal.normalize();
  const auto is_near = [&](std::size_t i) {
    const std::size_t h = 3 * std::size_t(tree.face(i));
    return std::any_of(near.begin(), near.end(), [&](Index w) {
      return mesh.corner[h] == w || mesh.corner[h + 1] == w || mesh.corner[h + 2] == w;
    });
  };
  for (const auto& hit : tree.first_hits(points[v], normal, reach, is_near)) {
    if (!(hit.distance < reach)) continue;
    add(Gap{hit.triangle, hit.distance});
    for (const Index f : around) add(Gap{tree.place(f), hit.distance});
  }
}

/// Lets `bounds` of triangles grow by no more than `slope` with the distance from others along the surface, where that is
/// less than `largest`.
template <class Execution>
void grade(const Execution& execution, const Triangle_tree& tree, const std::vector<double>& largest, double slope,
           std::vector<double>& bounds)
{
  std::vector<double> next(bounds.size());
  const auto center = [&](std::size_t i) { return (tree[i][0] + tree[i][1] + tree[i][2]) / 3; };
  for (bool is_changing = true; is_changing; bounds.swap(next))
    is_changing = count_if(execution, bounds.size(), [&](std::size_t i) {
      double least = (std::min)(bounds[i], largest[i]);
      for (const std::size_t j : tree.beyond(i))
        if (bounds[j] < least) least = (std::min)(least, bounds[j] + slope * (center(i) - center(j)).norm());
      next[i] = least < largest[i] ? least : bounds[i];
      return next[i] < bounds[i];
    }) > 0;
}

} // namespace internal

/// For each triangle of `tree`, which has the faces of `mesh`, how far the surface may be left there; infinite where there
/// is no gap within `reach[v]` of vertices `v` near it.
/// \par Complexity
/// near O(n log n)
template <class Execution, class Points>
std::vector<double> gap_bounds(const Execution& execution, const Mesh_view& mesh, const Points& points,
                               const Triangle_tree& tree, const std::vector<double>& reach)
{
  constexpr double share = 0.35; // of the gap: less than half of it, for it is narrower than it is along the normals
  constexpr double slope = 0.5;
  const auto gaps = gather<internal::Gap>(execution, mesh.number_of_vertices(), heavy_chunk_length,
                                          [&](std::size_t begin, std::size_t end, std::vector<internal::Gap>& list) {
    for (std::size_t v = begin; v < end; ++v)
      internal::for_each_gap(mesh, points, tree, Index(v), reach[v], [&](const internal::Gap& g) { list.push_back(g); });
  });
  std::vector<double> bounds(tree.size(), std::numeric_limits<double>::infinity()), largest(tree.size());
  for (const internal::Gap& g : gaps) bounds[g.triangle] = (std::min)(bounds[g.triangle], share * g.width);
  if (gaps.empty()) return bounds;
  for_each_index(execution, tree.size(), [&](std::size_t i) {
    const std::size_t h = 3 * std::size_t(tree.face(i));
    largest[i] = share * (std::max)({reach[mesh.corner[h]], reach[mesh.corner[h + 1]], reach[mesh.corner[h + 2]]});
  });
  internal::grade(execution, tree, largest, slope, bounds);
  return bounds;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_GAP_BOUNDS_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_THIN_FACES_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_THIN_FACES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>
#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// What those who swap and collapse edges of caps and needles ask of a mesh. Nothing that lives as long as this is copied.
template <class Points>
class Thin_faces
{
public:
  using Triangle = std::array<Index, 3>;

  Thin_faces(const Mesh_view& mesh, const Points& points) : mesh_(mesh), points_(points) {}

  const Vector_3& point(Index v) const { return points_[v]; }
  Triangle corners(Index f) const { return {mesh_.corner[3 * f], mesh_.corner[3 * f + 1], mesh_.corner[3 * f + 2]}; }

  double length(Index a, Index b) const { return (point(b) - point(a)).norm(); }
  double length(Index h) const { return length(mesh_.source(h), mesh_.target(h)); }
  double longest(const Triangle& t) const { return (std::max)({length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])}); }
  Index longest_edge(Index f) const { return (std::max)({3 * f, 3 * f + 1, 3 * f + 2}, shorter()); }
  Index shortest_edge(Index f) const { return (std::min)({3 * f, 3 * f + 1, 3 * f + 2}, shorter()); }

  /// Its length is twice the area.
  Vector_3 normal(const Triangle& t) const { return (point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0])); }

  /// Whether `after` does not turn from `before`, which it takes the place of.
  bool is_kept(const Triangle& before, const Triangle& after) const
  {
    constexpr double max_turn = 0.9; // cosine
    const Vector_3 m = normal(before), n = normal(after);
    return m.dot(n) > max_turn * m.norm() * n.norm();
  }

  /// Whether the other diagonal instead of `h`, the longest edge of its face, gives better faces, by `quality`, that lie as
  /// the one behind does; or is shorter, where that one `is_thin` as well: step by step these get beside good ones.
  template <class IsThin, class Quality>
  bool is_mended_by_swap(Index h, const IsThin& is_thin, const Quality& quality) const
  {
    constexpr double max_share = 0.99; // of the length of an edge between two such faces
    const Index t = mesh_.twin[h], p = mesh_.source(h), q = mesh_.target(h), b = mesh_.apex(h), a = mesh_.apex(t);
    if (mesh_.are_adjacent(a, b)) return false;
    const Triangle behind{q, p, a}, first{a, b, p}, second{b, a, q};
    if (is_thin(behind)) return length(a, b) < max_share * length(h);
    return (std::min)(quality(first), quality(second)) > quality({p, q, b}) && is_kept(behind, first) &&
           is_kept(behind, second);
  }

  /// Whether `predicate(before, after)` holds for all faces that keep two corners when `e` is collapsed.
  template <class Predicate>
  bool all_of_moved(const Mesh_view::Directed_edge& e, const Predicate& predicate) const
  {
    const Index s = mesh_.vanishing_vertex(e), d = mesh_.kept_vertex(e);
    bool result = true;
    mesh_.for_each_outgoing(s, [&](Index h) {
      const Triangle before{s, mesh_.target(h), mesh_.apex(h)}, after{d, before[1], before[2]};
      if (before[1] != d && before[2] != d) result = result && predicate(before, after);
    });
    return result;
  }

private:
  auto shorter() const
  {
    return [this](Index g, Index h) { return length(g) < length(h); };
  }

  const Mesh_view& mesh_;
  const Points& points_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_THIN_FACES_H

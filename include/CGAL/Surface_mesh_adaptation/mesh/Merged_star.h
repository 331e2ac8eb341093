// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_MERGED_STAR_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_MERGED_STAR_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The faces around the two ends of an edge that is to be collapsed, and on which side of the feature curves through
/// them each lies.
class Merged_star
{
public:
  struct Face
  {
    Index halfedge;  ///< that leaves one of the two ends
    int side;        ///< equal for faces between which no feature edge at one of the ends lies
    bool vanishes;   ///< as those of the edge itself
  };

  Merged_star(const Mesh_view& mesh, const Mesh_view::Directed_edge& e)
  {
    const Index s = mesh.vanishing_vertex(e), d = mesh.kept_vertex(e);
    const int sides = add_fan(mesh, s, d, 0, [](Index) { return std::size_t(-1); });
    const std::size_t n = faces_.size();
    add_fan(mesh, d, s, sides, [&](Index f) {
      return std::size_t(std::find_if(faces_.begin(), faces_.begin() + std::ptrdiff_t(n), [&](const Face& g) {
        return Mesh_view::face(g.halfedge) == f;
      }) - faces_.begin());
    });
  }

  const Ring<Face>& faces() const { return faces_; }

private:
  /// Adds the faces around `v`, with sides from `first_side` on; of those that the star has already, which
  /// `find(face)` tells, the sides are made one. Returns the first unused side.
  template <class Find>
  int add_fan(const Mesh_view& mesh, Index v, Index other, int first_side, const Find& find)
  {
    const Index first = mesh.outgoing[v];
    int curves = 0;
    mesh.for_each_outgoing(v, [&](Index h) { curves += mesh.is_feature(h) ? 1 : 0; });
    // around a closed fan, what comes before the first feature edge is on the side of the last
    const bool wraps = !mesh.is_border(first) && !mesh.is_feature(first);
    int crossed = 0;
    Ring<std::pair<int, int>> equal;
    mesh.for_each_outgoing(v, [&](Index h) {
      if (h != first && mesh.is_feature(h)) ++crossed;
      const int side = first_side + (wraps && crossed == curves ? 0 : crossed);
      const bool vanishes = mesh.target(h) == other || mesh.apex(h) == other;
      const std::size_t known = vanishes ? find(Mesh_view::face(h)) : std::size_t(-1);
      if (known < faces_.size()) equal.emplace_back(side, int(known));
      else faces_.push_back({h, side, vanishes});
    });
    for (std::size_t i = 0; i < equal.size(); ++i) {
      const int from = equal[i].first, to = faces_[std::size_t(equal[i].second)].side;
      replace_side(from, to);
      for (auto& e : equal)
        if (e.first == from) e.first = to;
    }
    return first_side + crossed + 1;
  }

  void replace_side(int side, int by)
  {
    for (Face& f : faces_)
      if (f.side == side) f.side = by;
  }

  Ring<Face> faces_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_MERGED_STAR_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The short way from triangles to a view, for those that are an oriented surface as they are.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_JOIN_TRIANGLES_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_JOIN_TRIANGLES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Joins triangles along their edges.
template <class Poll>
class Triangle_joiner
{
public:
  /// \param view has corners, all of which are vertices, and nothing else
  Triangle_joiner(Mesh_view& view, std::size_t number_of_vertices, const Poll& poll)
    : view_(view), poll_(poll), first_(number_of_vertices + 1, 0), leaving_(view.corner.size())
  {
    for (const Index v : view_.corner) ++first_[v + 1];
    for (std::size_t v = 0; v < number_of_vertices; ++v) first_[v + 1] += first_[v];
    std::vector<Index> end(first_.begin(), first_.end() - 1);
    for (Index h = 0; h < view_.corner.size(); ++h) leaving_[end[view_.source(h)]++] = {view_.target(h), h};
  }

  /// Whether no edge has more than two faces, or two that look to different sides.
  bool find_twins()
  {
    view_.twin.resize(view_.corner.size());
    for (Index h = 0; h < view_.corner.size(); ++h) {
      if (h % polling_period == 0) poll_();
      const Index v = view_.source(h), w = view_.target(h);
      std::size_t here = 0, back = 0;
      find(v, w, here);
      view_.twin[h] = find(w, v, back);
      if (v == w || here > 1 || back > 1) return false;
    }
    return true;
  }

  /// Whether each vertex has a triangle. Inside, its halfedge is that of the last face around, which CGAL's functions
  /// for soups choose, too.
  bool find_outgoing()
  {
    view_.outgoing.resize(first_.size() - 1);
    for (std::size_t v = 0; v < view_.outgoing.size(); ++v) {
      if (first_[v] == first_[v + 1]) return false;
      view_.outgoing[v] = leaving_[first_[v + 1] - 1].halfedge;
      for (std::size_t i = first_[v]; i < first_[v + 1]; ++i)
        if (view_.is_border(leaving_[i].halfedge)) view_.outgoing[v] = leaving_[i].halfedge;
    }
    return true;
  }

private:
  struct Leaving
  {
    Index target, halfedge;
  };

  /// How many halfedges lead from `v` to `w`, and the last of them.
  Index find(Index v, Index w, std::size_t& count) const
  {
    Index found = no_index;
    for (std::size_t i = first_[v]; i < first_[v + 1]; ++i)
      if (leaving_[i].target == w) {
        found = leaving_[i].halfedge;
        ++count;
      }
    return found;
  }

  static constexpr Index polling_period = 1 << 16;

  Mesh_view& view_;
  const Poll& poll_;
  std::vector<Index> first_;     // of what leaves each vertex
  std::vector<Leaving> leaving_; // side by side for each vertex
};

/// Makes a view of which only the corners are set, with an index below `number_of_vertices` each, a whole one, but for
/// curves. Returns whether the triangles allow that: no edge has more than two of them, or two that look to different
/// sides, and each vertex has one. Whether those around a vertex form one fan is not checked. `poll()` is called now
/// and then.
template <class Poll>
bool join_triangles(Mesh_view& view, std::size_t number_of_vertices, const Poll& poll)
{
  Triangle_joiner<Poll> joiner(view, number_of_vertices, poll);
  return joiner.find_twins() && joiner.find_outgoing();
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_JOIN_TRIANGLES_H

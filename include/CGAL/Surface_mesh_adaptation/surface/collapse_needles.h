// SPDX-License-Identifier: GPL-3.0-or-later
//
// Needles: faces with an edge that is too short to mean anything, as tessellations of CAD systems have them where two
// faces have almost the same point. Curves that end on either side of that edge would have nothing but degenerate faces
// between them. So before anything is estimated, such points become one.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_COLLAPSE_NEEDLES_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_COLLAPSE_NEEDLES_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Thin_faces.h>
#include <CGAL/Surface_mesh_adaptation/surface/negligible_length.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// What was done.
struct Collapsed_needles
{
  std::size_t number = 0;
  double moved = 0; ///< how far the surface is from what it was, at most
};

class Needle_collapsing
{
public:
  /// Edges up to `most` may be negligible.
  Needle_collapsing(Mesh_view& mesh, const std::vector<Vector_3>& points, const Feature_parameters& constraints, double most)
    : mesh_(mesh), points_(points), faces_(mesh, points), constraints_(constraints), negligible_(most)
  {}

  /// Collapses until nothing is left: an edge may have to wait for others beside it.
  template <class Execution>
  Collapsed_needles run(const Execution& execution)
  {
    if (edges(execution, [&](Index h) { return is_short(h); }).empty()) return {};
    negligible_ = internal::negligible_length(execution, points_, negligible_);
    moved_.resize(points_.size(), 0);
    Collapsed_needles result;
    for (std::size_t before = std::size_t(-1); before != result.number;) {
      before = result.number;
      for (const Index h : edges(execution, [&](Index e) { return is_negligible(e); }))
        if (collapse(h)) ++result.number;
    }
    result.moved = *std::max_element(moved_.begin(), moved_.end());
    return result;
  }

private:
  using Thin_faces = internal::Thin_faces<std::vector<Vector_3>>;
  using Triangle = Thin_faces::Triangle;

  double length(Index a, Index b) const { return faces_.length(a, b); }

  template <class Execution, class Predicate>
  std::vector<Index> edges(const Execution& execution, const Predicate& predicate) const
  {
    return pack(execution, mesh_.number_of_halfedges(), [&](std::size_t h) {
      return !mesh_.is_removed_face(Mesh_view::face(Index(h))) && mesh_.is_edge_owner(Index(h)) && predicate(Index(h));
    });
  }

  /// Whether the edge is short beside another one of its faces.
  bool is_short(Index h) const
  {
    const Index a = mesh_.source(h), t = mesh_.twin[h];
    const double beside = t == no_index ? 0 : length(a, mesh_.apex(t));
    return length(a, mesh_.target(h)) < internal::negligible_share * (std::max)(length(a, mesh_.apex(h)), beside);
  }

  /// Whether the edge is negligible, and short beside another one at its ends: within clusters of points faces are small.
  bool is_negligible(Index h) const
  {
    const std::array<Index, 2> ends{mesh_.source(h), mesh_.target(h)};
    const double l = length(ends[0], ends[1]);
    if (l > negligible_) return false;
    double longest = 0;
    for (const Index v : ends)
      mesh_.for_each_neighbor(v, [&](Index w) { longest = (std::max)(longest, length(v, w)); });
    return l < internal::negligible_share * longest;
  }

  /// Whether the edge is still there, negligible, and collapsed now.
  bool collapse(Index h)
  {
    if (mesh_.is_removed_face(Mesh_view::face(h)) || !is_negligible(h)) return false;
    for (const bool source_vanishes : {true, false}) {
      const Mesh_view::Directed_edge e{h, source_vanishes};
      if (!may_collapse(e)) continue;
      double& moved = moved_[mesh_.kept_vertex(e)];
      moved = (std::max)(moved, moved_[mesh_.vanishing_vertex(e)] + length(mesh_.source(h), mesh_.target(h)));
      mesh_.collapse(e);
      return true;
    }
    return false;
  }

  bool may_collapse(const Mesh_view::Directed_edge& e) const
  {
    return is_free(mesh_.vanishing_vertex(e)) && mesh_.is_collapsible(e) && keeps_faces(e);
  }

  /// Whether no constraint is lost with `s`.
  bool is_free(Index s) const
  {
    if (!constraints_.vertex_is_constrained.empty() && constraints_.vertex_is_constrained[s] != 0) return false;
    if (constraints_.halfedge_constraint.empty()) return true;
    bool result = true;
    mesh_.for_each_outgoing(s, [&](Index h) {
      for (const Index g : {h, Mesh_view::previous(h)})
        result = result && constraints_.halfedge_constraint[g] == Edge_constraint::none;
    });
    return result;
  }

  /// Whether no face turns whose height is not negligible.
  bool keeps_faces(const Mesh_view::Directed_edge& e) const
  {
    return faces_.all_of_moved(e, [&](const Triangle& before, const Triangle& after) {
      return faces_.normal(before).norm() <= negligible_ * faces_.longest(before) || faces_.is_kept(before, after);
    });
  }

  Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Thin_faces faces_;
  const Feature_parameters& constraints_;
  double negligible_;         // length
  std::vector<double> moved_; // how far what became this vertex has moved, at most
};

/// Collapses edges that are negligible, and shorter than `most`, in faces that are far longer. What is removed stays as holes;
/// constrained vertices and edges stay.
/// \par Complexity
/// O(n), and the collapses one after the other
template <class Execution>
Collapsed_needles collapse_needles(const Execution& execution, Mesh_view& mesh, const std::vector<Vector_3>& points,
                                   const Feature_parameters& constraints, double most)
{
  return Needle_collapsing(mesh, points, constraints, most).run(execution);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_COLLAPSE_NEEDLES_H

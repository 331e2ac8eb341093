// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mending: takes away faces without height that are left in the end. They are where features come nearer to each other than
// any size: no kernel takes vertices or edges from one feature to another. Here features may meet. The shape stays what it
// is but for the height of these faces.
//
// Few faces, one after the other. Invariants: validity and topology; no other face turns; boundaries, labels, and what
// the user has constrained stay.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_MENDING_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_MENDING_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Quality, in space and in the metric, below which a face has no height to speak of.
constexpr double min_quality_of_mended = 1e-3;

template <class Surface>
class Mending
{
public:
  /// `constraints` is what the user asks of the input; both live as long as this.
  Mending(Surface& surface, const Feature_parameters& constraints)
    : surface_(surface), mesh_(surface.mesh), constraints_(constraints)
  {
    if (surface.tolerance) largest_change_ = share_of_tolerance * surface.tolerance->of_operations();
  }

  /// Until nothing is left that can be mended: what is mended may make room for others. Leaves holes. Returns the number of
  /// edges swapped and collapsed.
  template <class Execution>
  std::size_t run(const Execution& execution, Sweep_counts& counts)
  {
    faces_ = pack(execution, mesh_.number_of_faces(), [&](std::size_t f) {
      return !mesh_.is_removed_face(Index(f)) && is_degenerate(corners(Index(f)));
    });
    counts.candidates += faces_.size();
    std::size_t left = max_operations * faces_.size();
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      ++counts.sweeps;
      for (std::size_t i = 0; i < faces_.size() && left > 0; ++i) {
        if (mesh_.is_removed_face(faces_[i]) || !is_degenerate(corners(faces_[i])) || !mend(faces_[i])) continue;
        is_changed = true;
        ++counts.applied;
        --left;
      }
    }
    return counts.applied;
  }

private:
  static constexpr double share_of_tolerance = 0.01;
  static constexpr double length_of_needle = 1e-3;  // of its shortest edge, in lengths of the longest
  static constexpr double quality_of_thin = 1e-2;   // of faces that may be as bad as others beside them
  static constexpr double max_share = 0.99;         // of the length of an edge beside such a face
  static constexpr double max_turn = 0.9;           // cosine between a face and those that take its place
  static constexpr double max_offset = 1e-3;        // of a vertex that vanishes from these faces, in edges of a mended one
  static constexpr std::size_t max_operations = 16; // for each face: so this ends

  using Triangle = std::array<Index, 3>;

  const Vector_3& point(Index v) const { return surface_.points[v]; }
  double length(Index a, Index b) const { return (point(b) - point(a)).norm(); }
  double length(Index h) const { return length(mesh_.source(h), mesh_.target(h)); }

  Triangle corners(Index f) const { return {mesh_.corner[3 * f], mesh_.corner[3 * f + 1], mesh_.corner[3 * f + 2]}; }
  /// In space or in the metric, whichever is better: in anisotropic metrics narrow faces may be good, and good ones narrow.
  double quality(const Triangle& t) const
  {
    const Isotropic_metric unit;
    const double in_space = face_quality(unit, unit, unit, point(t[1]) - point(t[0]), point(t[2]) - point(t[0]));
    return (std::max)(in_space, surface_.quality(t[0], t[1], t[2]));
  }
  Vector_3 normal(const Triangle& t) const { return surface_.normal(t[0], t[1], t[2]); }

  bool is_degenerate(const Triangle& t) const { return quality(t) < min_quality_of_mended; }
  bool is_thin(const Triangle& t) const { return quality(t) < quality_of_thin; }

  /// Mends one face, if that is possible.
  bool mend(Index f)
  {
    const std::array<Index, 3> edges{3 * f, 3 * f + 1, 3 * f + 2};
    const auto range =
      std::minmax_element(edges.begin(), edges.end(), [&](Index g, Index h) { return length(g) < length(h); });
    const Index shortest = *range.first, longest = *range.second;
    const bool is_needle = length(shortest) < length_of_needle * length(longest);
    const double largest_offset = (std::min)(max_offset * length(longest), largest_change_);
    return (is_needle && collapse(shortest, largest_offset)) || swap(longest) || collapse(shortest, largest_offset);
  }

  /// Gives the longest edge of a face for the other diagonal: the corner across comes onto the edge of the face behind.
  bool swap(Index h)
  {
    if (!may_swap(h)) return false;
    for (const Index g : {Mesh_view::next(h), Mesh_view::previous(h)})
      if (mesh_.is_feature(h) && !mesh_.is_feature(g)) mesh_.set_curve(g, merged_curve);
    mesh_.set_curve(h, no_curve);
    mesh_.flip(h);
    faces_.push_back(Mesh_view::face(mesh_.twin[h]));
    return true;
  }

  bool may_swap(Index h) const
  {
    const Index t = mesh_.twin[h];
    if (t == no_index || is_constrained(h)) return false;
    const Index p = mesh_.source(h), q = mesh_.target(h), b = mesh_.apex(h), a = mesh_.apex(t);
    if (height(p, q, b) > largest_change_ || mesh_.are_adjacent(a, b)) return false;
    const Triangle face{p, q, b}, behind{q, p, a}, first{a, b, p}, second{b, a, q};
    if (is_thin(behind)) return length(a, b) < max_share * length(p, q);
    return (std::min)(quality(first), quality(second)) > quality(face) && is_kept(behind, first) && is_kept(behind, second);
  }

  double height(Index p, Index q, Index b) const
  {
    return (point(q) - point(p)).cross(point(b) - point(p)).norm() / length(p, q);
  }

  /// Whether `after` does not turn from `before`, which it takes the place of.
  bool is_kept(const Triangle& before, const Triangle& after) const { return normal(before).dot(normal(after)) > max_turn; }

  /// Collapses an edge where that moves the other faces by no more than `largest_offset`.
  bool collapse(Index h, double largest_offset)
  {
    for (const bool source_vanishes : {true, false}) {
      const Mesh_view::Directed_edge e{h, source_vanishes};
      const Index s = mesh_.vanishing_vertex(e);
      if (!is_free(s) || !mesh_.is_collapsible(e) || !keeps_faces(e, largest_offset)) continue;
      mesh_.for_each_outgoing(s, [&](Index o) {
        for (const Index g : {o, Mesh_view::previous(o)})
          if (mesh_.is_feature(g)) mesh_.set_curve(g, merged_curve);
      });
      mesh_.collapse(e);
      return true;
    }
    return false;
  }

  /// Whether nothing that is asked for is lost with `s`.
  bool is_free(Index s) const
  {
    const Index before = surface_.origin[s];
    if (!constraints_.vertex_is_constrained.empty() && before != no_index && constraints_.vertex_is_constrained[before] != 0)
      return false;
    bool result = true;
    mesh_.for_each_outgoing(s, [&](Index h) {
      result = result && !is_constrained(h) && !is_constrained(Mesh_view::previous(h));
    });
    return result;
  }

  /// Whether the other faces around the vertex that vanishes neither turn nor become degenerate, and pass by it that near.
  bool keeps_faces(const Mesh_view::Directed_edge& e, double largest_offset) const
  {
    const Index s = mesh_.vanishing_vertex(e), d = mesh_.kept_vertex(e);
    bool result = true;
    mesh_.for_each_outgoing(s, [&](Index h) {
      const Triangle before{s, mesh_.target(h), mesh_.apex(h)}, after{d, before[1], before[2]};
      if (before[1] == d || before[2] == d || is_degenerate(before)) return;
      result = result && !is_degenerate(after) && is_kept(before, after) &&
               std::abs(normal(after).dot(point(s) - point(d))) <= largest_offset;
    });
    return result;
  }

  /// Whether the edge of `h` is on a curve of which the user has asked something.
  bool is_constrained(Index h) const
  {
    const Index curve = mesh_.curve[h];
    if (curve >= merged_curve) return false;
    if (mesh_.curves.is_protected(curve) || mesh_.curves.is_drawn(curve)) return true;
    if (constraints_.halfedge_constraint.empty()) return false;
    const auto& reference = surface_.reference();
    const std::vector<Index>& chain = reference.features.curves[curve].vertices;
    const auto is_asked_for = [&](Index v, Index w) {
      return constraints_.halfedge_constraint[reference.mesh.any_halfedge(v, w)] != Edge_constraint::none;
    };
    return std::adjacent_find(chain.begin(), chain.end(), is_asked_for) != chain.end();
  }

  Surface& surface_;
  Mesh_view& mesh_;
  const Feature_parameters& constraints_;
  double largest_change_ = std::numeric_limits<double>::infinity(); // length
  std::vector<Index> faces_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_MENDING_H

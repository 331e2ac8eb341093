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
#include <CGAL/Surface_mesh_adaptation/surface/Thin_faces.h>

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
    : surface_(surface), mesh_(surface.mesh), faces_(surface.mesh, surface.points), constraints_(constraints)
  {
    if (surface.tolerance) largest_change_ = share_of_tolerance * surface.tolerance->of_operations();
  }

  /// Until nothing is left that can be mended: what is mended may make room for others. Leaves holes. Returns the number of
  /// edges swapped and collapsed.
  template <class Execution>
  std::size_t run(const Execution& execution, Sweep_counts& counts)
  {
    left_ = pack(execution, mesh_.number_of_faces(), [&](std::size_t f) {
      return !mesh_.is_removed_face(Index(f)) && is_degenerate(faces_.corners(Index(f)));
    });
    counts.candidates += left_.size();
    std::size_t operations = max_operations * left_.size();
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      ++counts.sweeps;
      for (std::size_t i = 0; i < left_.size() && operations > 0; ++i) {
        if (mesh_.is_removed_face(left_[i]) || !is_degenerate(faces_.corners(left_[i])) || !mend(left_[i])) continue;
        is_changed = true;
        ++counts.applied;
        --operations;
      }
    }
    return counts.applied;
  }

private:
  static constexpr double share_of_tolerance = 0.01;
  static constexpr double length_of_needle = 1e-3;  // of its shortest edge, in lengths of the longest
  static constexpr double quality_of_thin = 1e-2;   // of faces that may be as bad as others beside them
  static constexpr double max_offset = 1e-3;        // of a vertex that vanishes from these faces, in edges of a mended one
  static constexpr std::size_t max_operations = 16; // for each face: so this ends

  using Thin_faces = internal::Thin_faces<decltype(Surface::points)>;
  using Triangle = typename Thin_faces::Triangle;

  /// In space or in the metric, whichever is better: in anisotropic metrics narrow faces may be good, and good ones narrow.
  double quality(const Triangle& t) const
  {
    const Isotropic_metric unit;
    const Vector_3& origin = faces_.point(t[0]);
    const double in_space = face_quality(unit, unit, unit, faces_.point(t[1]) - origin, faces_.point(t[2]) - origin);
    return (std::max)(in_space, surface_.quality(t[0], t[1], t[2]));
  }

  bool is_degenerate(const Triangle& t) const { return quality(t) < min_quality_of_mended; }
  bool is_thin(const Triangle& t) const { return quality(t) < quality_of_thin; }

  /// Mends one face, if that is possible.
  bool mend(Index f)
  {
    const Index shortest = faces_.shortest_edge(f), longest = faces_.longest_edge(f);
    const bool is_needle = faces_.length(shortest) < length_of_needle * faces_.length(longest);
    const double largest_offset = (std::min)(max_offset * faces_.length(longest), largest_change_);
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
    left_.push_back(Mesh_view::face(mesh_.twin[h]));
    return true;
  }

  bool may_swap(Index h) const
  {
    return mesh_.twin[h] != no_index && !is_constrained(h) && height(h) <= largest_change_ &&
           faces_.is_mended_by_swap(h, [&](const Triangle& t) { return is_thin(t); },
                                    [&](const Triangle& t) { return quality(t); });
  }

  /// Of the corner across.
  double height(Index h) const { return faces_.normal(faces_.corners(Mesh_view::face(h))).norm() / faces_.length(h); }

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
    const Vector_3& vanishing = faces_.point(mesh_.vanishing_vertex(e));
    return faces_.all_of_moved(e, [&](const Triangle& before, const Triangle& after) {
      return is_degenerate(before) ||
             (!is_degenerate(after) && faces_.is_kept(before, after) && offset(vanishing, after) <= largest_offset);
    });
  }

  /// How far `p` is from the plane of the face.
  double offset(const Vector_3& p, const Triangle& t) const
  {
    return std::abs(faces_.normal(t).normalized().dot(p - faces_.point(t[0])));
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
  const Thin_faces faces_;
  const Feature_parameters& constraints_;
  double largest_change_ = std::numeric_limits<double>::infinity(); // length
  std::vector<Index> left_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_MENDING_H

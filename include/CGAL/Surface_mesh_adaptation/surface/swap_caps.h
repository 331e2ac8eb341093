// SPDX-License-Identifier: GPL-3.0-or-later
//
// Caps: faces of which one corner lies on the opposite edge but for rounding, as tessellations of CAD systems have them
// where the vertices of one face end on an edge of another. Where a cap's normal points is a matter of rounding, and
// features and normals that are estimated with it go astray. So before anything is estimated, caps give their longest
// edge for the other diagonal: their corner is put on the edge of the face behind.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SWAP_CAPS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SWAP_CAPS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Thin_faces.h>
#include <CGAL/Surface_mesh_adaptation/surface/negligible_length.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Where the corners and faces of a mesh come from whose caps were swapped. Both tables are empty where none was.
struct Swapped_caps
{
  std::vector<Index> corners; ///< for each halfedge one that had the corner at its source
  std::vector<Index> faces;   ///< for each face the one whose plane it lies in

  Index corner_before(Index h) const { return corners.empty() ? h : corners[h]; }
  Index face_before(Index f) const { return faces.empty() ? f : faces[f]; }
};

class Cap_swapping
{
public:
  /// `constraints` has a value for each halfedge, or none at all; heights up to `most` may be negligible.
  Cap_swapping(Mesh_view& mesh, const std::vector<Vector_3>& points, std::vector<Edge_constraint>& constraints, double most)
    : mesh_(mesh), points_(points), faces_(mesh, points), constraints_(constraints), negligible_(most)
  {}

  /// Swaps until no cap can be mended. Those that lie one upon the other get at good faces step by step, while the
  /// edges between them get shorter.
  template <class Execution>
  Swapped_caps run(const Execution& execution)
  {
    std::vector<Index> caps = pack(execution, mesh_.number_of_faces(), [&](std::size_t f) {
      return is_flat(faces_.corners(Index(f)));
    });
    if (caps.empty()) return {};
    negligible_ = internal::negligible_length(execution, points_, negligible_);
    caps.erase(std::remove_if(caps.begin(), caps.end(), [&](Index f) { return !is_cap(faces_.corners(f)); }), caps.end());
    std::size_t left = max_swaps * caps.size();
    for (bool is_changed = true; is_changed && left > 0;) {
      is_changed = false;
      for (std::size_t i = 0; i < caps.size() && left > 0; ++i) {
        const Index h = faces_.longest_edge(caps[i]);
        if (!is_cap(faces_.corners(caps[i])) || !may_swap(h)) continue;
        const Index behind = Mesh_view::face(mesh_.twin[h]);
        if (is_cap(faces_.corners(behind))) caps.push_back(behind);
        swap(h);
        is_changed = true;
        --left;
      }
    }
    return std::move(origins_);
  }

private:
  static constexpr double max_height = 1e-5;   // of a cap, in lengths of its longest edge
  static constexpr std::size_t max_swaps = 16; // for each cap: so this ends

  using Thin_faces = internal::Thin_faces<std::vector<Vector_3>>;
  using Triangle = Thin_faces::Triangle;

  /// In lengths of the longest edge.
  double height(const Triangle& t) const
  {
    const double longest = faces_.longest(t);
    return longest > 0 ? faces_.normal(t).norm() / (longest * longest) : 0;
  }

  bool is_flat(const Triangle& t) const { return height(t) < internal::negligible_share; }

  bool is_cap(const Triangle& t) const
  {
    return is_flat(t) && height(t) < (std::max)(max_height, negligible_ / faces_.longest(t));
  }

  bool may_swap(Index h) const
  {
    return mesh_.twin[h] != no_index && (constraints_.empty() || constraints_[h] == Edge_constraint::none) &&
           faces_.is_mended_by_swap(h, [&](const Triangle& t) { return is_cap(t); },
                                    [&](const Triangle& t) { return height(t); });
  }

  void swap(Index h)
  {
    const Index t = mesh_.twin[h], f = Mesh_view::face(h), g = Mesh_view::face(t);
    const Index hn = Mesh_view::next(h), hp = Mesh_view::previous(h);
    const Index tn = Mesh_view::next(t), tp = Mesh_view::previous(t);
    mesh_.flip(h);
    if (!constraints_.empty()) { // the outer edges move on by one
      auto& c = constraints_;
      const Edge_constraint first = c[hn];
      c[hn] = std::exchange(c[hp], std::exchange(c[tn], std::exchange(c[tp], first)));
    }
    if (origins_.faces.empty()) start_origins();
    // the corners p, q, b of the cap and q, p, a of the face behind become a, b, p and b, a, q
    auto& corner = origins_.corners;
    const Index of_b = corner[hp], of_a = corner[tp], of_p = corner[tn], of_q = corner[t];
    corner[h] = corner[tn] = of_a;
    corner[hn] = corner[t] = of_b;
    corner[hp] = of_p;
    corner[tp] = of_q;
    origins_.faces[f] = origins_.faces[g];
  }

  void start_origins()
  {
    origins_.corners.resize(mesh_.number_of_halfedges());
    origins_.faces.resize(mesh_.number_of_faces());
    std::iota(origins_.corners.begin(), origins_.corners.end(), Index(0));
    std::iota(origins_.faces.begin(), origins_.faces.end(), Index(0));
  }

  Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Thin_faces faces_;
  std::vector<Edge_constraint>& constraints_;
  double negligible_; // height
  Swapped_caps origins_;
};

/// Swaps the longest edges of caps where that changes the shape by less than their height: a hundred thousandth of that edge,
/// or up to `most` what is negligible. Boundaries and constrained edges stay; `constraints` has a value for each halfedge, or
/// none at all.
/// \par Complexity
/// O(n), and the swaps one after the other
template <class Execution>
Swapped_caps swap_caps(const Execution& execution, Mesh_view& mesh, const std::vector<Vector_3>& points,
                       std::vector<Edge_constraint>& constraints, double most)
{
  return Cap_swapping(mesh, points, constraints, most).run(execution);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SWAP_CAPS_H

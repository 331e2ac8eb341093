// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the input bends sharply along an edge that is no ridge, since it turns by less or was taken for noise, faces cross
// the edge, and no size brings them near enough, or very small ones only. Such edges become creases once a run has shown it,
// and all is done again. Where the triangles of the input are bad, as in tessellations and decimated parts, they do so before
// sizes are corrected: most of what corrections would do there is in vain.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_LATE_CREASES_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_LATE_CREASES_H

#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/distance/input_faces_near.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

class Late_creases
{
public:
  /// `mesh` and `points` are the input; both live as long as this. Where no ridges are wanted there are no late ones.
  Late_creases(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Feature_parameters& features)
    : mesh_(mesh), points_(points), attempts_left_(features.detect_ridges ? max_attempts : 0)
    , cosine_(std::cos(share_of_angle * features.ridge_angle * CGAL_PI / 180)), is_first_(features.detect_ridges)
  {}

  /// Before sizes are corrected for the first time. Where the faces of the input are the surface: marks edges around faces
  /// of `surface` that are not much nearer to it than `asked`, if they are as long as those of the face. Finer sizes there
  /// would take several times the vertices. On patches, if the input is coarse: as `mark()` does.
  /// \par Complexity
  /// O(n), on patches for all faces of the input, else for those around them
  template <class Execution, class Surface, class Deviations>
  void mark_at_first(const Execution& execution, const Surface& surface, const Deviations& deviations, double asked)
  {
    if (!std::exchange(is_first_, false)) return;
    mark_long(surface, deviations, asked);
    if (Surface::Reference::is_flat) return;
    is_coarse_ = mean_quality_by_area(execution, mesh_, points_) <= quality_of_coarse;
    if (is_coarse_) mark_around(surface, deviations, asked, share_of_length);
  }

  /// Where corrections of the sizes were in vain: marks edges around faces that are farther away than `asked`, too, but none
  /// that are much shorter than those of the face. On patches, none where a face is no farther away than it would be from
  /// something round, of which creases would make facets. A few times only.
  /// \par Complexity
  /// O(n) for the faces of the input around them
  template <class Surface, class Deviations>
  void mark(const Surface& surface, const Deviations& deviations, double asked)
  {
    if (attempts_left_ == 0) return;
    mark_around(surface, deviations, asked, share_of_length);
    mark_long(surface, deviations, asked);
    if (are_new_) --attempts_left_;
  }

  /// Whether there are some since `take_new()`: then all is to be done again with `constrained()`.
  bool are_new() const { return are_new_; }

  void take_new() { are_new_ = false; }

  /// Whether patches are the surface and the triangles of the input are bad, as far as `mark_at_first()` has looked.
  bool is_coarse() const { return is_coarse_; }

  std::size_t number() const { return number_; } ///< of those marked

  /// `features`, with all that were marked.
  Feature_parameters constrained(Feature_parameters features) const
  {
    if (number_ > 0) features.constrain(mesh_, Edge_constraint::crease, [&](Index h) -> bool { return is_marked_[h]; });
    return features;
  }

private:
  static constexpr int max_attempts = 3;
  static constexpr double quality_of_coarse = 0.65; // mean by area, of which few scans and hardly any mesher has less
  static constexpr double distance_of_arc = 0.2; // of its middle from a chord of length 1, if it has 90 degrees
  static constexpr double share_of_angle = 1.0 / 3; // of that of ridges: below, finer sizes do
  static constexpr double share_of_asked = 0.7;     // of the distance
  static constexpr double share_of_length = 0.5;    // of the longest edge of a face, for those that sizes cannot mend

  static double longest_edge(const Triangle_points& t)
  {
    return (std::max)({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
  }

  template <class Surface, class Deviations>
  void mark_long(const Surface& surface, const Deviations& deviations, double asked)
  {
    if (Surface::Reference::is_flat) mark_around(surface, deviations, share_of_asked * asked, 1);
  }

  /// Marks edges around faces that are farther away than `distance`, of at least `share` of their longest edge, and beside no
  /// triangles that are thinner.
  template <class Surface, class Deviations>
  void mark_around(const Surface& surface, const Deviations& deviations, double distance, double share)
  {
    is_marked_.resize(mesh_.number_of_halfedges(), false);
    const std::size_t before = number_;
    for (Index f = 0; f < Index(surface.mesh.number_of_faces()); ++f) {
      if (!(deviations[f] > distance)) continue;
      const double longest = longest_edge(corners_from(surface.mesh, surface.points, 3 * f));
      const double of_face = deviations.least_distance(f);
      if (!Surface::Reference::is_flat && of_face < distance_of_arc * longest) continue;
      for (const Index face : input_faces_near(surface, f, of_face))
        mark_face(surface.reference().mesh, face, share * longest);
    }
    are_new_ = are_new_ || number_ > before;
  }

  void mark_face(const Mesh_view& with_features, Index f, double least_length)
  {
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (with_features.is_border(h) || with_features.is_shaped(h) || with_features.is_protected(h)) continue;
      if (is_marked_[h] || !turns(h) || least_extent(h) < least_length) continue;
      is_marked_[h] = is_marked_[mesh_.twin[h]] = true;
      ++number_;
    }
  }

  /// The length of the edge of `h`, or how high a face beside is above it.
  double least_extent(Index h) const
  {
    const double length = (points_[mesh_.target(h)] - points_[mesh_.source(h)]).norm();
    const double area = (std::min)(face_normal(mesh_, points_, h).norm(), face_normal(mesh_, points_, mesh_.twin[h]).norm());
    return (std::min)(length, area / length);
  }

  /// Degenerate faces turn at no edge.
  bool turns(Index h) const
  {
    const Vector_3 n = face_normal(mesh_, points_, h), behind = face_normal(mesh_, points_, mesh_.twin[h]);
    return n.dot(behind) < cosine_ * n.norm() * behind.norm();
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  int attempts_left_;
  double cosine_; // of the angle from which edges may become creases
  std::vector<bool> is_marked_; // both halfedges of each edge
  std::size_t number_ = 0;      // of edges that are
  bool are_new_ = false;
  bool is_first_; // time that faces are looked at
  bool is_coarse_ = false;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_LATE_CREASES_H

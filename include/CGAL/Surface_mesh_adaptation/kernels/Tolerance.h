// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tolerance, a largest distance between the input and the adapted mesh, and how operations keep it: no face that
// they create leaves the input farther, and what the faces that they replace cover of the input stays covered.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_TOLERANCE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_TOLERANCE_H

#include <CGAL/Surface_mesh_adaptation/distance/Covered_points.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// How far the adapted mesh may be from the input, and the faces of that.
struct Tolerance
{
  double distance;      ///< that is asked for; infinite if there are only `bounds`
  double of_operations; ///< that each operation keeps: less, for operations add up
  Triangle_tree input;
  std::vector<double> bounds; ///< of the distance at each triangle of `input`, for other reasons; empty if there are none

  bool is_asked() const { return distance < std::numeric_limits<double>::infinity(); }

  /// What operations keep near triangle `i`.
  double limit(std::size_t i) const { return bounds.empty() ? of_operations : (std::min)(of_operations, bounds[i]); }
};

/// Pieces of a face of which the distance from the input is bounded where it may stand for hundreds of others.
constexpr std::size_t max_pieces_of_face = 1024;

/// A corner of a face that may come to be.
struct Located_corner
{
  const Location& location;
  const Vector_3& point;
};

/// Keeps a tolerance while a copy of the mesh of `Reference` is adapted.
template <class Reference>
class Tolerance_guard
{
public:
  /// Both must live as long as the guard.
  template <class Execution>
  Tolerance_guard(const Execution& execution, const Reference& reference, const Tolerance& tolerance)
    : reference_(&reference), tolerance_(&tolerance)
  {
    if (tolerance.is_asked()) covered_.emplace(execution, reference.mesh, reference.points);
  }

  double of_operations() const { return tolerance_->of_operations; }

  /// Whether a face with these corners stays within the tolerance of the input. `false` may be wrong, the less often
  /// the more pieces of the face are looked at.
  bool is_kept(const Located_corner& a, const Located_corner& b, const Located_corner& c,
               std::size_t max_pieces = 64) const
  {
    Ring<std::size_t> guesses;
    for (const Located_corner* corner : {&a, &b, &c}) {
      const std::size_t i = tolerance_->input.place(reference_->face_at(corner->location));
      if (tolerance_->limit(i) < none) guesses.push_back(i);
    }
    return guesses.empty() || is_within(tolerance_->input, {a.point, b.point, c.point},
                                        [&](std::size_t i) { return tolerance_->limit(i); }, guesses, max_pieces);
  }

  /// Whether the points of the input that `faces` cover stay within the tolerance of `triangles`, which are to replace
  /// these. Nothing is said of what lies between, which is why the distance is measured in the end.
  template <class Faces, class Triangles>
  bool are_covered(const Faces& faces, const Triangles& triangles) const
  {
    return !covered_ || covered_->are_near(faces, triangles, of_operations());
  }

  /// Hands what `faces` of the adapted mesh cover on to those of them that are left.
  template <class Surface, class Faces>
  void hand_over(const Surface& surface, const Faces& faces)
  {
    if (covered_) covered_->hand_over(surface.mesh, surface.points, faces);
  }

  /// Hands what all faces cover on to their children, after `plan` was carried out.
  template <class Execution, class Surface>
  void hand_to_children(const Execution& execution, const Restructuring& plan, const Surface& surface)
  {
    if (covered_) covered_->hand_to_children(execution, plan, surface.mesh, surface.points);
  }

private:
  static constexpr double none = std::numeric_limits<double>::infinity();

  const Reference* reference_;
  const Tolerance* tolerance_;
  std::optional<Covered_points> covered_; // if a tolerance is asked for
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_TOLERANCE_H

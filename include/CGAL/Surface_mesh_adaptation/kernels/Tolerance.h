// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tolerance, a largest distance between the input and the adapted mesh, and how operations keep it: no face that
// they create leaves the input farther, and what the faces that they replace cover of the input stays covered.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_TOLERANCE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_TOLERANCE_H

#include <CGAL/Surface_mesh_adaptation/distance/Covered_points.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// How far the adapted mesh may be from the input, and the faces of that.
struct Tolerance
{
  double distance;      ///< that is asked for
  double of_operations; ///< that each operation keeps: less, for operations add up
  Triangle_tree input;
  std::size_t points_on_edges = 3; ///< at most, where the input bends, that operations stay near
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
    , covered_(execution, reference.mesh, reference.points,
               {share_of_height * tolerance.of_operations, tolerance.of_operations, tolerance.points_on_edges})
  {}

  double of_operations() const { return tolerance_->of_operations; }

  /// Whether a face with these corners stays within the tolerance of the input. `false` may be wrong, the less often
  /// the more pieces of the face are looked at.
  bool is_kept(const Located_corner& a, const Located_corner& b, const Located_corner& c,
               std::size_t max_pieces = 64) const
  {
    Ring<std::size_t> guesses;
    for (const Located_corner* corner : {&a, &b, &c}) {
      guesses.push_back(tolerance_->input.place(reference_->face_at(corner->location)));
    }
    return is_within(tolerance_->input, {a.point, b.point, c.point}, of_operations(), guesses, max_pieces);
  }

  /// Whether the points of the input that `faces` cover stay within the tolerance of `triangles`, which are to replace
  /// these. Nothing is said of what lies between, which is why the distance is measured in the end.
  template <class Faces, class Triangles>
  bool are_covered(const Faces& faces, const Triangles& triangles) const
  {
    return covered_.are_near(faces, triangles, of_operations());
  }

  /// As `are_covered()`, with what `hand_over()` needs once the k-th triangle has replaced the k-th face.
  template <class Faces, class Triangles>
  bool are_covered(const Faces& faces, const Triangles& triangles, Covered_points::Owners& owners) const
  {
    return covered_.find_owners(faces, triangles, of_operations(), owners);
  }

  template <class Faces>
  void hand_over(const Faces& faces, const Covered_points::Owners& owners)
  {
    covered_.hand_over(faces, owners);
  }

  /// Hands what `faces` of the adapted mesh cover on to those of them that are left.
  template <class Surface, class Faces>
  void hand_over(const Surface& surface, const Faces& faces)
  {
    covered_.hand_over(surface.mesh, surface.points, faces, of_operations());
  }

  /// Hands what all faces cover on to their children, after `plan` was carried out.
  template <class Execution, class Surface>
  void hand_to_children(const Execution& execution, const Restructuring& plan, const Surface& surface)
  {
    covered_.hand_to_children(execution, plan, surface.mesh, surface.points, of_operations());
  }

private:
  static constexpr double share_of_height = 0.25;

  const Reference* reference_;
  const Tolerance* tolerance_;
  Covered_points covered_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_TOLERANCE_H

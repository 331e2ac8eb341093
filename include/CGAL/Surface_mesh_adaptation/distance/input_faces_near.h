// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of the input that a face of the adapted mesh is about.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_INPUT_FACES_NEAR_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_INPUT_FACES_NEAR_H

#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The faces of the input at the corners of the face `f` of `surface`, and those from there that are within `margin` of the
/// ball around its middle that it lies in.
/// \par Complexity
/// O(n) for so many faces
template <class Surface>
std::vector<Index> input_faces_near(const Surface& surface, Index f, double margin = 0)
{
  const auto& input = surface.reference();
  std::vector<Index> faces;
  std::unordered_set<Index> found;
  const auto add = [&](Index face) {
    if (found.insert(face).second) faces.push_back(face);
  };
  const Triangle_points t = corners_from(surface.mesh, surface.points, 3 * f);
  for (Index h = 3 * f; h < 3 * f + 3; ++h) add(input.face_at(surface.locations[surface.mesh.source(h)]));
  const Vector_3 middle = (t[0] + t[1] + t[2]) / 3;
  const double radius = (std::max)({(t[0] - middle).norm(), (t[1] - middle).norm(), (t[2] - middle).norm()}) + margin;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
      const Index twin = input.mesh.twin[h];
      if (twin != no_index &&
          squared_distance_to_triangle(middle, corners_from(input.mesh, input.points, twin)) <= radius * radius)
        add(Mesh_view::face(twin));
    }
  return faces;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_INPUT_FACES_NEAR_H

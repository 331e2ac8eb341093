// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SURROUNDINGS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SURROUNDINGS_H

#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// What is around a part of a surface, which shares nothing with the faces inside of that part.
struct Surroundings
{
  std::function<std::vector<Triangle_points>(const Vector_3&, const Vector_3&)> triangles; ///< in a box, from low to high
  std::function<bool(const Mesh_view&, Index)> is_inside; ///< whether a face of the mesh is inside
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SURROUNDINGS_H

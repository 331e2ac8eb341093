// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_MESH_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_MESH_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFiles
/// @{

/// The content of a `.mesh` or `.meshb` file, as far as surfaces go.
struct Medit_mesh
{
  /// Elements of `N` corners each.
  template <std::size_t N>
  using Tuples = std::vector<std::array<std::uint32_t, N>>;
  using Indices = std::vector<std::uint32_t>;  ///< in the order of the file, from 0

  std::vector<std::array<double, 3>> points;  ///< their coordinates
  std::vector<int> point_references;         ///< as many as points
  Tuples<3> triangles;                    ///< indices of points
  std::vector<int> triangle_references;      ///< as many as triangles
  Tuples<4> quadrilaterals;               ///< indices of points
  std::vector<int> quadrilateral_references; ///< as many as quadrilaterals
  Tuples<2> edges;                        ///< indices of points
  std::vector<int> edge_references;          ///< as many as edges
  Indices ridges;                            ///< indices of edges: sharp edges of the surface
  Indices required_edges;                    ///< indices of edges
  Indices required_triangles;                ///< indices of triangles
  Indices corners;                           ///< indices of points: where the surface has a tip, or ridges end or turn
  Indices required_vertices;                 ///< indices of points
  std::vector<std::string> ignored_sections; ///< names of the sections that were skipped, tetrahedra for instance
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_MESH_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_SOLUTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_SOLUTION_H

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFiles
/// @{

/// A field at the vertices.
struct Medit_field
{
  int components = 1;         ///< 1: a scalar; 3: a vector; 6: a symmetric tensor, as xx xy yy xz yz zz; 9: a matrix
  std::vector<double> values; ///< `components` for each vertex

  /// For each of which there is a value.
  std::size_t number_of_vertices() const { return values.size() / std::size_t(components); }
};

/// The content of a `.sol` or `.solb` file: fields at the same vertices, one at least.
using Medit_solution = std::vector<Medit_field>;

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_SOLUTION_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_LAYOUT_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_LAYOUT_H

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFiles
/// @{

/// How the numbers of a binary file are laid out.
struct Medit_binary_layout
{
  int version = 2;      ///< 1: single precision; 2: double precision; 3: also long positions; 4: also long integers
  bool swapped = false; ///< whether its bytes are in the order that this machine does not use

  bool has_long_positions() const { return version >= 3; }  ///< of 64 bits
  bool has_long_integers() const { return version >= 4; }  ///< of 64 bits
  std::size_t size_of_integer() const { return has_long_integers() ? 8 : 4; }  ///< in bytes
  std::size_t size_of_real() const { return version == 1 ? 4 : 8; }  ///< in bytes
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_LAYOUT_H

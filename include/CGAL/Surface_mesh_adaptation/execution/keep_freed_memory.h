// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory that is freed and soon needed again. Sweeps and, in the end, the arrays of the user's mesh take large buffers
// one after the other. By default glibc gives each back to the system when it is freed, and the next one is fetched
// page by page, the mesh's by a single thread.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_KEEP_FREED_MEMORY_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_KEEP_FREED_MEMORY_H

#include <cstdlib> // defines __GLIBC__ where that is the library
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationExecution
/// @{

/// Lets this process keep the memory that it frees, for what it needs next. It concerns the whole program, so it is up
/// to `main()`, before the first adaptation; no function of this package calls it. Without effect where the C library
/// is not glibc, or another allocator takes its place.
inline void keep_freed_memory() noexcept
{
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0); // large blocks come from the heap, too
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_KEEP_FREED_MEMORY_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PHYSICAL_MEMORY_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PHYSICAL_MEMORY_H

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Bytes of memory that this process can have at most: what the machine has, or its limit on the process. The largest
/// number where the system does not tell.
inline std::uint64_t physical_memory()
{
  std::uint64_t bytes = (std::numeric_limits<std::uint64_t>::max)();
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0) bytes = std::uint64_t(pages) * std::uint64_t(page);
  rlimit limit;
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = (std::min)(bytes, std::uint64_t(limit.rlim_cur));
#endif
  return bytes;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_PHYSICAL_MEMORY_H

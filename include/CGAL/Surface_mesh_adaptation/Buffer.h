// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_BUFFER_H
#define CGAL_SURFACE_MESH_ADAPTATION_BUFFER_H

#include <boost/core/noinit_adaptor.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// A vector of which `resize` does not initialise: what is filled in parallel must not be cleared in series before, and
/// its pages are first touched by the threads that use them.
template <class T>
using Buffer = std::vector<T, boost::noinit_adaptor<std::allocator<T>>>;

/// Resizes without keeping the content, which `resize` would copy in series when it needs more memory.
template <class T>
void resize_and_forget(Buffer<T>& buffer, std::size_t n)
{
  buffer.clear();
  buffer.resize(n);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_BUFFER_H

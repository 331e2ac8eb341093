// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_BUFFER_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_BUFFER_H

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// Leaves elements that are made without arguments as the memory is, whatever their default constructor would do.
template <class T>
struct Uninitialized_allocator : std::allocator<T>
{
  template <class U> struct rebind { using other = Uninitialized_allocator<U>; };

  Uninitialized_allocator() = default;
  template <class U> Uninitialized_allocator(const Uninitialized_allocator<U>&) noexcept {}

  template <class U>
  void construct(U*) noexcept
  {
    static_assert(std::is_trivially_destructible_v<U>, "only plain values may be left uninitialised");
  }

  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

} // namespace internal

/// A vector of which `resize` does not initialise: what is filled in parallel must not be cleared in series before, and
/// its pages are first touched by the threads that use them.
template <class T>
using Buffer = std::vector<T, internal::Uninitialized_allocator<T>>;

/// Resizes without keeping the content, which `resize` would copy in series when it needs more memory. If more has to
/// be fetched, then for `expected` elements at once: pages that nobody touches cost nothing, but giving back and
/// fetching large blocks takes the system long.
template <class T>
void resize_and_forget(Buffer<T>& buffer, std::size_t n, std::size_t expected = 0)
{
  buffer.clear();
  if (n > buffer.capacity()) {
    Buffer<T>().swap(buffer);
    buffer.reserve((std::max)(n, expected));
  }
  buffer.resize(n);
}

/// Gives back the memory of buffers, each in a task: the system takes its time over large ones.
template <class Execution, class... T>
void release(const Execution& execution, Buffer<T>&... buffers)
{
  execution.run(sizeof...(T), [&](std::size_t task) {
    std::size_t i = 0;
    ((i++ == task ? Buffer<T>().swap(buffers) : void()), ...);
  });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_BUFFER_H

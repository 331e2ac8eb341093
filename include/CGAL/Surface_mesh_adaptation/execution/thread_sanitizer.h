// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tells ThreadSanitizer where tasks fork and join. The libraries that run them synchronise in code that it does not
// see into, so that without this every task seems to race with what came before and after it.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_THREAD_SANITIZER_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_THREAD_SANITIZER_H

#if defined(__SANITIZE_THREAD__)
#define CGAL_SMA_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CGAL_SMA_THREAD_SANITIZER
#endif
#endif

#ifdef CGAL_SMA_THREAD_SANITIZER
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#endif

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Lives on the stack of the thread that forks: what it did before `fork()` is visible to `task()`, and what that does
/// is visible after `join()`.
class Fork_join_annotation
{
public:
  void fork() { release(&fork_); }

  template <class Task>
  void run(const Task& task)
  {
    acquire(&fork_);
    task();
    release(&join_);
  }

  void join() { acquire(&join_); }

private:
#ifdef CGAL_SMA_THREAD_SANITIZER
  static void acquire(char* p) { __tsan_acquire(p); }
  static void release(char* p) { __tsan_release(p); }
#else
  static void acquire(char*) {}
  static void release(char*) {}
#endif

  char fork_ = 0, join_ = 0; // only their addresses count
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXECUTION_THREAD_SANITIZER_H

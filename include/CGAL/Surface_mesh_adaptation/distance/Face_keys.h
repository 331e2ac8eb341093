// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of faces that last while the mesh around them changes and all of them get other numbers: made of their points.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_KEYS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_KEYS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The keys of all faces of a mesh, in a table that finds faces by them.
class Face_keys
{
public:
  Face_keys() = default; ///< of no faces

  /// Work: O(n).
  template <class Execution, class Points>
  Face_keys(const Execution& execution, const Mesh_view& mesh, const Points& points) : keys_(mesh.number_of_faces())
  {
    while (mask_ < 2 * keys_.size()) mask_ = 2 * mask_ + 1;
    slots_.reset(new std::atomic<Index>[mask_ + 1]);
    for_each_index(execution, mask_ + 1, [&](std::size_t i) { slots_[i].store(no_index, std::memory_order_relaxed); });
    for_each_index(execution, keys_.size(), [&](std::size_t f) {
      keys_[f] = key(points[mesh.corner[3 * f]], points[mesh.corner[3 * f + 1]], points[mesh.corner[3 * f + 2]]);
    });
    for_each_index(execution, keys_.size(), [&](std::size_t f) { insert(Index(f)); });
  }

  std::size_t size() const { return keys_.size(); }
  std::uint64_t operator[](Index f) const { return keys_[f]; }

  /// The face with this key, the first one if there are more, or `no_index`.
  Index face(std::uint64_t key) const
  {
    if (keys_.empty()) return no_index;
    for (std::size_t i = key & mask_;; i = (i + 1) & mask_) {
      const Index f = slots_[i].load(std::memory_order_relaxed);
      if (f == no_index || keys_[f] == key) return f;
    }
  }

private:
  static std::uint64_t key(const Vector_3& a, const Vector_3& b, const Vector_3& c)
  {
    std::uint64_t result = 0;
    for (const Vector_3* p : {&a, &b, &c})
      for (const double x : *p) {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        result = hash_of_id(result ^ bits);
      }
    return result;
  }

  /// In the first slot that is free; what is found there later does not depend on who comes first.
  void insert(Index f)
  {
    for (std::size_t i = keys_[f] & mask_;; i = (i + 1) & mask_) {
      Index other = no_index;
      if (slots_[i].compare_exchange_strong(other, f, std::memory_order_relaxed)) return;
      if (keys_[other] != keys_[f]) continue;
      while (f < other && !slots_[i].compare_exchange_weak(other, f, std::memory_order_relaxed)) {}
      return;
    }
  }

  std::vector<std::uint64_t> keys_;
  std::size_t mask_ = 0;                       // number of slots, a power of two, less one
  std::unique_ptr<std::atomic<Index>[]> slots_; // at least twice as many as faces; linear probing
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_KEYS_H

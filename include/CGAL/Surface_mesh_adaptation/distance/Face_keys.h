// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names of faces that last while the mesh around them changes and all of them get other numbers: made of their points.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_KEYS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_KEYS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

class Face_keys
{
public:
  Face_keys() = default; ///< of no faces

  /// Work: O(n log n).
  template <class Execution, class Points>
  Face_keys(const Execution& execution, const Mesh_view& mesh, const Points& points) : keys_(mesh.number_of_faces())
  {
    for_each_index(execution, keys_.size(), [&](std::size_t f) {
      keys_[f] = key(points[mesh.corner[3 * f]], points[mesh.corner[3 * f + 1]], points[mesh.corner[3 * f + 2]]);
    });
    order_ = internal::sorted_by_key(execution, keys_);
  }

  std::size_t size() const { return keys_.size(); }
  std::uint64_t operator[](Index f) const { return keys_[f]; }

  /// The face with this key, or `no_index`.
  Index face(std::uint64_t key) const
  {
    const auto is_less = [&](Index f, std::uint64_t k) { return keys_[f] < k; };
    const auto at = std::lower_bound(order_.begin(), order_.end(), key, is_less);
    return at != order_.end() && keys_[*at] == key ? *at : no_index;
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

  std::vector<std::uint64_t> keys_;
  std::vector<Index> order_; // of the faces by their keys
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_KEYS_H

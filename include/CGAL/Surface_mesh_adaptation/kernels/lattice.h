// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lattices of right-angled faces: their edges conform to a metric, and they are in balance for every local operation,
// at a quality of .866. What breaks this balance, at random, lets moves and swaps find better faces.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_LATTICE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_LATTICE_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// In [-1, 1), by `id`.
inline double random_by_id(std::uint64_t id) { return double(hash_of_id(id) >> 11) * 0x1p-52 - 1; }

/// In which ratio the edge of `h`, from `a` to `b`, is split: in halves, but for the diagonals of a lattice. Halves
/// would make a finer one.
template <class Surface>
double split_position(const Surface& surface, Index a, Index b, Index h)
{
  constexpr double max_skew = 0.1;  // of a parallelogram, in lengths of the diagonal
  constexpr double quality = 0.87;  // of a right-angled face: .866
  constexpr double max_shift = 0.2; // of a split, in lengths of the edge
  const Mesh_view& mesh = surface.mesh;
  const auto& points = surface.points;
  const Index p = mesh.source(h), q = mesh.target(h), c = mesh.apex(h), d = mesh.apex(mesh.twin[h]);
  const Vector_3 skew = points[c] + points[d] - points[a] - points[b];
  if (skew.squaredNorm() > max_skew * max_skew * (points[b] - points[a]).squaredNorm() ||
      (surface.has_quality(p, q, c, quality) && surface.has_quality(q, p, d, quality)))
    return 0.5;
  return 0.5 + max_shift * random_by_id(std::uint64_t(a) << 32 | b);
}

/// Whether a vertex at `v` is in the middle of a lattice with parallel diagonals: of three pairs of neighbours that are
/// opposite to each other, with faces of its quality all around. Others do not last.
template <class Star, class Vertex>
bool is_in_lattice(const Star& star, const Vertex& v)
{
  constexpr double max_skew = 0.3; // of two opposite edges, in lengths of one
  constexpr double quality = 0.9;  // faces of curved ones may be better than .866
  if (star.ring.size() != 6 || !star.is_closed) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector_3 a = star.ring[i].point - v.point, b = star.ring[i + 3].point - v.point;
    if ((a + b).squaredNorm() > max_skew * max_skew * a.squaredNorm()) return false;
  }
  return star.for_each_face_while([&](const auto& a, const auto& b) {
    const Vector_3 ea = a.point - v.point, eb = b.point - v.point;
    return !squared_shape(v.metric, a.metric, b.metric, ea, eb, ea.cross(eb)).is_at_least(quality);
  });
}

/// A step off the place of the vertex `id` at `v`, in a random direction.
template <class Star, class Vertex>
Vector_3 step_out_of_lattice(const Star& star, const Vertex& v, Index id)
{
  constexpr double length = 0.5; // in those of the shortest edge
  double shortest2 = std::numeric_limits<double>::infinity();
  for (const auto& n : star.ring) shortest2 = (std::min)(shortest2, (n.point - v.point).squaredNorm());
  const auto random = [&](std::uint64_t i) { return random_by_id(std::uint64_t(id) << 2 | i); };
  const Vector_3 direction = v.normal.cross(Vector_3(random(0), random(1), random(2)));
  const double norm2 = direction.squaredNorm();
  return norm2 > 0 ? Vector_3(length * std::sqrt(shortest2 / norm2) * direction) : direction;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_LATTICE_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex normals, one per smooth sector: creases cut the fan of a vertex into sectors with a normal each.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_VERTEX_NORMALS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_VERTEX_NORMALS_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// A unit normal at every corner of every face, shared by the corners of a smooth sector.
struct Corner_normals
{
  Buffer<Vector_3> normals;
  Buffer<Index> of_corner;  ///< index into `normals` for each corner

  const Vector_3& at(Index corner) const { return normals[of_corner[corner]]; }
};

namespace internal {

/// Twice the area of the face of `h` times its unit normal.
inline Vector_3 face_normal(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index h)
{
  const Vector_3& p = points[mesh.source(h)];
  return (points[mesh.target(h)] - p).cross(points[mesh.apex(h)] - p);
}

/// Calls `sector(first, n)` for each smooth sector of `v`: `n` consecutive faces from that of `first` on.
template <class Sector>
void for_each_sector(const Mesh_view& mesh, Index v, const Sector& sector)
{
  std::size_t n = 0, creases = 0;
  mesh.for_each_outgoing(v, [&](Index h) {
    ++n;
    creases += mesh.is_crease(h);
  });
  if (creases == 0) return sector(mesh.outgoing[v], n);
  Ring<Index> fan;
  mesh.for_each_outgoing(v, [&](Index h) { fan.push_back(h); });
  std::size_t start = 0;
  while (!mesh.is_crease(fan[start])) ++start;
  for (std::size_t i = 0; i < n;) {
    std::size_t length = 1;
    while (i + length < n && !mesh.is_crease(fan[(start + i + length) % n])) ++length;
    sector(fan[(start + i) % n], length);
    i += length;
  }
}

/// Mean of the face normals with the weights of Max (1999), exact on the sphere: the cross product of two edges over
/// the product of their squared lengths.
inline Vector_3 sector_normal(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index first, std::size_t n)
{
  Vector_3 weighted = Vector_3::Zero(), sum = Vector_3::Zero();
  for (Index h = first; n > 0; --n, h = mesh.rotated_ccw(h)) {
    const Vector_3& p = points[mesh.source(h)];
    const Vector_3 a = points[mesh.target(h)] - p, b = points[mesh.apex(h)] - p;
    const double weight = a.squaredNorm() * b.squaredNorm();
    sum += a.cross(b);
    if (weight > 0) weighted += a.cross(b) / weight;
  }
  const Vector_3& normal = weighted.squaredNorm() > 0 ? weighted : sum;
  return normal.squaredNorm() > 0 ? Vector_3(normal.normalized()) : Vector_3::UnitZ();
}

} // namespace internal

/// Estimates the normals of all sectors from the positions. \pre `mesh.curve` is set
template <class Execution>
Corner_normals estimate_normals(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  Corner_normals result;
  Buffer<Index> offset;
  const Index total = exclusive_scan(execution, mesh.number_of_vertices(), offset, [&](std::size_t v) {
    Index sectors = 0;
    internal::for_each_sector(mesh, Index(v), [&](Index, std::size_t) { ++sectors; });
    return sectors;
  });
  result.normals.resize(total);
  result.of_corner.resize(mesh.number_of_halfedges());
  for_each_index(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    Index id = offset[v];
    internal::for_each_sector(mesh, Index(v), [&](Index first, std::size_t n) {
      result.normals[id] = internal::sector_normal(mesh, points, first, n);
      Index h = first;
      for (std::size_t i = 0; i < n; ++i, h = mesh.rotated_ccw(h)) result.of_corner[h] = id;
      ++id;
    });
  });
  return result;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_VERTEX_NORMALS_H

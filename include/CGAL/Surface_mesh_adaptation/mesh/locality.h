// SPDX-License-Identifier: GPL-3.0-or-later
//
// Renumbers an imported mesh along a curve that fills space, if its own order is poor.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_LOCALITY_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_LOCALITY_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/sort.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

constexpr int hilbert_bits = 21; // three coordinates in one 64-bit key

/// The lower 21 bits of `x`, two zeros between each and the next.
inline std::uint64_t spread_bits(std::uint64_t x)
{
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// Position of a cell of a grid with `2^hilbert_bits` cells a side along the Hilbert curve (Skilling 2004). Without
/// branches, for nobody can foresee them.
inline std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x)
{
  for (int bit = hilbert_bits - 1; bit > 0; --bit) {
    const std::uint32_t below = (1u << bit) - 1;
    for (std::uint32_t& xi : x) {
      const std::uint32_t if_set = 0u - (xi >> bit & 1u); // all bits or none
      const std::uint32_t exchanged = (x[0] ^ xi) & below & ~if_set;
      x[0] ^= exchanged | (below & if_set);
      xi ^= exchanged;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t parity = x[2] >> 1; // of all bits from there on
  for (const int shift : {1, 2, 4, 8, 16}) parity ^= parity >> shift;
  return spread_bits(x[0] ^ parity) << 2 | spread_bits(x[1] ^ parity) << 1 | spread_bits(x[2] ^ parity);
}

/// The place in `order` of each number below `n` that is there.
template <class Execution>
std::vector<Index> inverse(const Execution& execution, const std::vector<Index>& order, std::size_t n)
{
  std::vector<Index> result(n);
  for_each_index(execution, order.size(), [&](std::size_t i) { result[order[i]] = Index(i); });
  return result;
}

/// `result[i] = items[order[i / width] * width + i % width]`
template <class Execution, class Items>
void reorder(const Execution& execution, const std::vector<Index>& order, std::size_t width, Items& items)
{
  if (items.empty()) return;
  Items result;
  result.resize(order.size() * width);
  for_each_index(execution, result.size(), [&](std::size_t i) { result[i] = items[order[i / width] * width + i % width]; });
  items.swap(result);
}

/// The least and the largest coordinates.
template <class Points>
std::pair<Vector_3, Vector_3> bounding_box(const Points& points)
{
  Vector_3 low = points[0], high = points[0];
  for (const Vector_3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {low, high};
}

/// The order of the vertices along the Hilbert curve through the bounding box.
template <class Execution>
std::vector<Index> hilbert_order(const Execution& execution, const std::vector<Vector_3>& points)
{
  const auto box = bounding_box(points);
  const Vector_3 &low = box.first, &high = box.second;
  const double side = (high - low).maxCoeff();
  const double scale = side > 0 ? double((1u << hilbert_bits) - 1) / side : 0;
  std::vector<std::uint64_t> key(points.size());
  for_each_index(execution, points.size(), [&](std::size_t v) {
    const Vector_3 x = scale * (points[v] - low);
    key[v] = hilbert_key({std::uint32_t(x[0]), std::uint32_t(x[1]), std::uint32_t(x[2])});
  });
  return sorted_by_key(execution, key);
}

/// Share of the halfedges between vertices of which the numbers differ by less than `small_distance`.
template <class Execution>
double share_of_near_ends(const Execution& execution, const Mesh_view& mesh)
{
  constexpr Index small_distance = 64;
  const std::size_t n = mesh.number_of_halfedges();
  return double(count_if(execution, n, [&](std::size_t h) {
    const Index v = mesh.source(Index(h)), w = mesh.target(Index(h));
    return (v < w ? w - v : v - w) < small_distance;
  })) / double(n);
}

/// A Hilbert order and what refinement makes of it reach 0.8. The distance is small on purpose: long strips look good
/// at the scale of blocks, and are a poor order once they are refined.
constexpr double good_locality = 0.7;

/// The numbers that vertices had before; none if they keep them.
struct Renumbering
{
  std::vector<Index> vertices;

  Index vertex(Index v) const { return vertices.empty() ? v : vertices[v]; }
};

/// Brings the vertices and faces of `imported` into these orders; those that are not in them are holes, and go.
/// `new_vertex` is the inverse of `vertex_order`.
template <class Execution, class Import>
void renumber(const Execution& execution, const std::vector<Index>& vertex_order, const std::vector<Index>& new_vertex,
              const std::vector<Index>& face_order, Import& imported)
{
  Mesh_view& mesh = imported.mesh;
  const std::vector<Index> new_face = inverse(execution, face_order, mesh.number_of_faces());
  const auto new_halfedge = [&](Index h) { return h == no_index ? h : 3 * new_face[h / 3] + h % 3; };
  reorder(execution, face_order, 3, mesh.corner);
  reorder(execution, face_order, 3, mesh.twin);
  reorder(execution, face_order, 3, imported.halfedges);
  reorder(execution, vertex_order, 1, mesh.outgoing);
  reorder(execution, vertex_order, 1, imported.points);
  reorder(execution, vertex_order, 1, imported.vertices);
  for_each_index(execution, mesh.number_of_halfedges(), [&](std::size_t h) {
    mesh.corner[h] = new_vertex[mesh.corner[h]];
    mesh.twin[h] = new_halfedge(mesh.twin[h]);
  });
  for_each_index(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    mesh.outgoing[v] = new_halfedge(mesh.outgoing[v]);
  });
}

/// Renumbers vertices along the Hilbert curve, and faces by their smallest vertex, unless the order is good already.
template <class Execution, class Import>
Renumbering improve_locality(const Execution& execution, Import& imported)
{
  const Mesh_view& mesh = imported.mesh;
  if (share_of_near_ends(execution, mesh) >= good_locality) return {};
  std::vector<Index> vertex_order = hilbert_order(execution, imported.points);
  const std::vector<Index> new_vertex = inverse(execution, vertex_order, mesh.number_of_vertices());
  std::vector<std::uint64_t> face_key(mesh.number_of_faces());
  for_each_index(execution, face_key.size(), [&](std::size_t f) {
    face_key[f] = (std::min)({new_vertex[mesh.corner[3 * f]], new_vertex[mesh.corner[3 * f + 1]],
                              new_vertex[mesh.corner[3 * f + 2]]});
  });
  renumber(execution, vertex_order, new_vertex, sorted_by_key(execution, face_key), imported);
  return {std::move(vertex_order)};
}

/// Numbers what is no hole anew, in the same order. \pre `mesh.curve` and `mesh.label` hold nothing yet
template <class Execution, class Import>
void remove_holes(const Execution& execution, Import& imported)
{
  Mesh_view& mesh = imported.mesh;
  const auto vertices = pack(execution, mesh.number_of_vertices(), [&](std::size_t v) {
    return !mesh.is_removed_vertex(Index(v));
  });
  const auto faces = pack(execution, mesh.number_of_faces(), [&](std::size_t f) { return !mesh.is_removed_face(Index(f)); });
  renumber(execution, vertices, inverse(execution, vertices, mesh.number_of_vertices()), faces, imported);
  mesh.curve.resize(mesh.number_of_halfedges());
  mesh.label.clear();
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_LOCALITY_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closes the holes that a few removed elements leave, by the last vertices and faces: work in proportion to the holes,
// where a rewrite of the mesh (restructure.h) would touch everything.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_FILL_HOLES_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_FILL_HOLES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// Which elements move to which holes, as pairs (from, to), when `holes` of `n` elements, in increasing order, are
/// filled from the end; `is_hole(i)` tells the same of one element.
template <class Holes, class IsHole>
std::vector<std::pair<Index, Index>> moves_into_holes(std::size_t n, const Holes& holes, const IsHole& is_hole)
{
  std::vector<std::pair<Index, Index>> moves;
  Index last = Index(n);
  for (const Index hole : holes) {
    do --last; while (last > hole && is_hole(last));
    if (last <= hole) break;
    moves.emplace_back(last, hole);
  }
  return moves;
}

inline void move_face(Mesh_view& mesh, Index from, Index to)
{
  for (Index i = 0; i < 3; ++i) {
    const Index h = 3 * from + i, g = 3 * to + i;
    mesh.corner[g] = mesh.corner[h];
    mesh.twin[g] = mesh.twin[h];
    mesh.curve[g] = mesh.curve[h];
    if (mesh.twin[h] != no_index) mesh.twin[mesh.twin[h]] = g;
    if (mesh.outgoing[mesh.corner[h]] == h) mesh.outgoing[mesh.corner[h]] = g;
  }
  if (mesh.has_labels()) mesh.label[to] = mesh.label[from];
}

} // namespace internal

/// Moves the last elements of `mesh` into the holes, given in increasing order, and cuts off the end. Calls
/// `move_vertex(from, to)` for the vertices that change their numbers. No edge may lead from a face to itself.
template <class Holes, class MoveVertex>
void fill_holes(Mesh_view& mesh, const Holes& vertex_holes, const Holes& face_holes, const MoveVertex& move_vertex)
{
  const std::size_t nv = mesh.number_of_vertices() - vertex_holes.size();
  const std::size_t nf = mesh.number_of_faces() - face_holes.size();
  for (const auto& [from, to] : internal::moves_into_holes(mesh.number_of_vertices(), vertex_holes, [&](Index v) {
         return mesh.is_removed_vertex(v);
       })) {
    const Index id = to;
    mesh.for_each_outgoing(from, [&](Index h) { mesh.corner[h] = id; });
    mesh.outgoing[to] = mesh.outgoing[from];
    move_vertex(from, to);
  }
  for (const auto& [from, to] : internal::moves_into_holes(mesh.number_of_faces(), face_holes, [&](Index f) {
         return mesh.is_removed_face(f);
       }))
    internal::move_face(mesh, from, to);
  mesh.outgoing.resize(nv);
  mesh.corner.resize(3 * nf);
  mesh.twin.resize(3 * nf);
  mesh.curve.resize(3 * nf);
  if (mesh.has_labels()) mesh.label.resize(nf);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_FILL_HOLES_H

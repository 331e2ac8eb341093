// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a sweep finds its independent tasks. Vertices are numbered along a curve that fills the surface, so the vertices
// of a range of ids, a block, are neighbours in space. An operation all of whose vertices lie in one block can touch no
// operation of another: blocks are worked through in parallel, each in the order of its ids and at the speed of
// sequential code. What straddles a block border is deferred and then made independent by claims or by colours.
// The blocks depend on the ids alone, never on the number of threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_BLOCK_SWEEP_H
#define CGAL_SURFACE_MESH_ADAPTATION_BLOCK_SWEEP_H

#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Vertices in a block: its data fit a second-level cache, and about 15 % of its operations touch another block.
constexpr std::size_t block_length = 1024;

struct Block
{
  Index begin, end;

  bool contains(Index v) const { return begin <= v && v < end; }

  /// Whether `v`, its neighbours and hence its faces lie in the block.
  bool contains_ring(const Mesh_view& mesh, Index v) const
  {
    bool inside = true;
    mesh.for_each_outgoing_while(v, [&](Index h) {
      inside = contains(mesh.target(h)) && contains(mesh.apex(h));
      return inside;
    });
    return inside;
  }
};

struct Sweep_counts
{
  std::size_t sweeps = 0;
  std::size_t candidates = 0;
  std::size_t applied = 0;
  std::size_t deferred = 0;

  Sweep_counts& operator+=(const Sweep_counts& o)
  {
    sweeps += o.sweeps;
    candidates += o.candidates;
    applied += o.applied;
    deferred += o.deferred;
    return *this;
  }
};

/// Calls `visit(v, block, counts, deferred)` for the vertices of all blocks, the vertices of one block in order.
/// Adds to `counts`, and returns the concatenated `deferred` lists.
template <class Execution, class Visit>
std::vector<Index> sweep_blocks(const Execution& execution, std::size_t number_of_vertices, Sweep_counts& counts,
                                const Visit& visit)
{
  std::vector<Sweep_counts> partial(number_of_chunks(number_of_vertices, block_length));
  std::vector<Index> deferred = gather<Index>(execution, number_of_vertices, block_length,
                                              [&](std::size_t begin, std::size_t end, std::vector<Index>& list) {
    const Block block{Index(begin), Index(end)};
    Sweep_counts local; // of this task: counters in shared lines would cost more than the work
    for (std::size_t v = begin; v < end; ++v) visit(Index(v), block, local, list);
    partial[begin / block_length] = local;
  });
  for (const Sweep_counts& p : partial) counts += p;
  counts.deferred += deferred.size();
  return deferred;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_BLOCK_SWEEP_H

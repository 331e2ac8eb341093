// SPDX-License-Identifier: GPL-3.0-or-later
//
// How collapses at the borders of blocks are made independent: all vertices propose, proposals in conflict claim
// vertices, the winners are applied, and the losers propose anew.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_BORDER_CLAIMS_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_BORDER_CLAIMS_H

#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Removes vertices among `vertices` by collapses, `Collapse` being a `Mesh_view::Directed_edge` or derived from it.
/// `propose(v)` returns the collapse that removes `v`, with `h == no_index` if there is none, and may write what belongs
/// to `v` alone; `cost(c)` is the share, from 0 to 1, of the largest cost; `for_each_claimed(c, f)` calls `f(w)` for the
/// vertices `w` whose claim makes `apply(c)` independent of other winners. Adds to `counts`.
template <class Collapse, class Execution, class Propose, class Cost, class ForEachClaimed, class Apply>
void sweep_border_by_claims(const Execution& execution, const Mesh_view& mesh, std::vector<Index> vertices,
                            Reservations& reservations, Sweep_counts& counts, const Propose& propose, const Cost& cost,
                            const ForEachClaimed& for_each_claimed, const Apply& apply)
{
  std::vector<Collapse> proposals;
  reservations.resize(execution, mesh.number_of_vertices());
  for (std::uint32_t round = 0; !vertices.empty() && round < max_border_rounds; ++round) {
    counts.candidates += vertices.size();
    proposals.resize(vertices.size());
    for_each_index(execution, vertices.size(), [&](std::size_t i) {
      const bool is_left_out = mesh.is_removed_vertex(vertices[i]) || is_stopped(execution);
      proposals[i] = is_left_out ? Collapse() : propose(vertices[i]);
    }, heavy_chunk_length);
    const auto valid = pack(execution, vertices.size(), [&](std::size_t i) { return proposals[i].h != no_index; });
    const auto winners = independent_set(
      execution, valid.size(), reservations,
      [&](std::size_t i) {
        const std::uint32_t bucket = (std::min)(7u, std::uint32_t(8 * cost(proposals[valid[i]])));
        return task_priority(bucket, vertices[valid[i]], round);
      },
      [&](std::size_t i, const auto& claim) { for_each_claimed(proposals[valid[i]], claim); });
    for_each_index(execution, winners.size(), [&](std::size_t i) { apply(proposals[valid[winners[i]]]); },
                   heavy_chunk_length);
    counts.applied += winners.size();
    vertices = gather<Index>(execution, valid.size(), default_chunk_length,
                             [&](std::size_t begin, std::size_t end, std::vector<Index>& losers) {
      for (std::size_t i = begin; i < end; ++i)
        if (!mesh.is_removed_vertex(vertices[valid[i]])) losers.push_back(vertices[valid[i]]);
    });
  }
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_BORDER_CLAIMS_H

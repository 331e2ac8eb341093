// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a sweep finds its independent tasks. Vertices are numbered along a curve that fills the surface, so the vertices
// of a range of ids, a block, are neighbours in space. An operation all of whose vertices lie in one block can touch no
// operation of another: blocks are worked through in parallel, each in the order of its ids and at the speed of
// sequential code. What straddles a block border is deferred and then made independent by claims, or block by block
// with blocks of one colour at a time.
// The blocks depend on the ids and their number alone, never on the number of threads.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_BLOCK_SWEEP_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_BLOCK_SWEEP_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/tasks/graph_coloring.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Vertices in a block: its data fit a second-level cache, and about 15 % of its operations touch another block.
constexpr std::size_t block_length = 1024;

/// The same for work that is long at each vertex, as moves are. There are more blocks then where there are too few for many
/// threads, since those of one colour take turns; below 256 more is deferred than that wins. Small meshes are done before
/// that counts.
inline std::size_t length_of_short_blocks(std::size_t number_of_vertices)
{
  constexpr std::size_t shortest = 256, enough_blocks = 512, small = 32 * block_length;
  if (number_of_vertices <= small) return block_length;
  std::size_t length = shortest;
  while (length < block_length && number_of_vertices > enough_blocks * length) length *= 2;
  return length;
}

struct Block
{
  Index begin, end;

  bool contains(Index v) const { return begin <= v && v < end; }
};

/// Whether `vertices` contain those around `v`.
template <class Vertices>
bool contains_ring(const Vertices& vertices, const Mesh_view& mesh, Index v)
{
  bool inside = true;
  mesh.for_each_outgoing_while(v, [&](Index h) {
    inside = vertices.contains(mesh.target(h)) && vertices.contains(mesh.apex(h));
    return inside;
  });
  return inside;
}

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
                                const Visit& visit, std::size_t length = block_length)
{
  std::vector<Sweep_counts> partial(number_of_chunks(number_of_vertices, length));
  std::vector<Index> deferred = gather<Index>(execution, number_of_vertices, length,
                                              [&](std::size_t begin, std::size_t end, std::vector<Index>& list) {
    if (is_stopped(execution)) return;
    const Block block{Index(begin), Index(end)};
    Sweep_counts local; // of this task: counters in shared lines would cost more than the work
    for (std::size_t v = begin; v < end; ++v) visit(Index(v), block, local, list);
    partial[begin / length] = local;
  });
  for (const Sweep_counts& p : partial) counts += p;
  counts.deferred += deferred.size();
  return deferred;
}

/// A block and those next to it.
struct Block_neighborhood
{
  Index block, length;
  const Ring<Index>& adjacent;

  bool contains(Index v) const
  {
    const Index b = v / length;
    return b == block || std::find(adjacent.begin(), adjacent.end(), b) != adjacent.end();
  }
};

/// Vertices in increasing order, by the blocks they belong to, and a colour for each block. Two blocks are adjacent if
/// an edge leads from one of the vertices in one to the other.
class Border_of_blocks
{
public:
  /// Blocks of one colour are not adjacent, and if `distance` is 2 instead of 1, not adjacent to a common one either.
  template <class Execution>
  Border_of_blocks(const Execution& execution, const Mesh_view& mesh, const std::vector<Index>& vertices, int distance,
                   std::size_t length = block_length)
    : length_(Index(length)), first_(number_of_chunks(mesh.number_of_vertices(), length) + 1), adjacent_(first_.size() - 1)
  {
    for_each_index(execution, first_.size(), [&](std::size_t b) {
      const auto found = std::lower_bound(vertices.begin(), vertices.end(), Index(b * length_));
      first_[b] = std::size_t(found - vertices.begin());
    });
    const auto add = [&](std::size_t b, std::size_t other) {
      Ring<Index>& list = adjacent_[b];
      if (other != b && std::find(list.begin(), list.end(), Index(other)) == list.end()) list.push_back(Index(other));
    };
    for_each_index(execution, adjacent_.size(), [&](std::size_t b) {
      for (std::size_t i = first_[b]; i < first_[b + 1]; ++i)
        mesh.for_each_neighbor(vertices[i], [&](Index w) { add(b, w / length_); });
    }, 1);
    for (std::size_t b = 0; b < adjacent_.size(); ++b)
      for (std::size_t i = 0; i < adjacent_[b].size(); ++i) add(adjacent_[b][i], b);
    coloring_ = first_fit_coloring(adjacent_.size(), [&](std::size_t b, const auto& f) {
      for (const Index other : adjacent_[b]) {
        f(other);
        if (distance > 1) std::for_each(adjacent_[other].begin(), adjacent_[other].end(), f);
      }
    });
  }

  std::size_t number_of_blocks() const { return first_.size() - 1; }
  std::vector<std::vector<std::uint32_t>> blocks_by_color() const { return color_classes(coloring_); }

  /// The positions of the vertices of a block among the vertices.
  std::size_t begin(std::size_t block) const { return first_[block]; }
  std::size_t end(std::size_t block) const { return first_[block + 1]; }

  /// Whether no task visits `w` while another one works through `block`.
  bool stands_still(Index w, std::size_t block) const
  {
    const std::size_t other = w / length_;
    return other == block || coloring_.color[other] != coloring_.color[block];
  }

  Block_neighborhood neighborhood(std::size_t block) const { return {Index(block), length_, adjacent_[block]}; }

private:
  Index length_; // of a block
  std::vector<std::size_t> first_; // of each block, and the end
  std::vector<Ring<Index>> adjacent_;
  Graph_coloring coloring_;
};

/// Calls `visit(k, b, counts, list)` for the `k`-th of the `vertices`, in the block `b`: blocks of one colour in
/// parallel, the vertices of one block in order. Adds to `counts`, and returns the concatenated lists.
template <class Execution, class Visit>
std::vector<Index> sweep_colors(const Execution& execution, const Border_of_blocks& border, Sweep_counts& counts,
                                const Visit& visit)
{
  std::vector<Sweep_counts> partial(border.number_of_blocks());
  std::vector<std::vector<Index>> lists(border.number_of_blocks());
  for (const std::vector<std::uint32_t>& blocks : border.blocks_by_color())
    for_each_index(execution, blocks.size(), [&](std::size_t i) {
      if (is_stopped(execution)) return;
      const std::size_t b = blocks[i];
      Sweep_counts local;
      for (std::size_t k = border.begin(b); k < border.end(b); ++k) visit(k, b, local, lists[b]);
      partial[b] = local;
    }, 1);
  std::vector<Index> result;
  for (std::size_t b = 0; b < lists.size(); ++b) {
    counts += partial[b];
    result.insert(result.end(), lists[b].begin(), lists[b].end());
  }
  return result;
}

/// Calls `visit(v, stands_still, counts, list)` for the `vertices`, which are in increasing order: one block after the
/// other where an edge leads from one to the other, else in parallel. `stands_still(w)` tells whether no other task
/// visits `w` meanwhile, which is so for the neighbours of `v`. Adds to `counts`, and returns the concatenated lists.
template <class Execution, class Visit>
std::vector<Index> sweep_block_borders(const Execution& execution, const Mesh_view& mesh,
                                       const std::vector<Index>& vertices, Sweep_counts& counts, const Visit& visit,
                                       std::size_t length = block_length)
{
  if (vertices.empty()) return {};
  const Border_of_blocks border(execution, mesh, vertices, 1, length);
  return sweep_colors(execution, border, counts,
                      [&](std::size_t k, std::size_t b, Sweep_counts& c, std::vector<Index>& list) {
    visit(vertices[k], [&](Index w) { return border.stands_still(w, b); }, c, list);
  });
}

/// Calls `visit(v, neighborhood, counts, list)` for the `vertices`, which are in increasing order. `neighborhood` has
/// the block of `v` and those next to it, which no other task may touch meanwhile. Adds to `counts`, and returns the
/// concatenated lists.
template <class Execution, class Visit>
std::vector<Index> sweep_block_neighborhoods(const Execution& execution, const Mesh_view& mesh,
                                             const std::vector<Index>& vertices, Sweep_counts& counts,
                                             const Visit& visit)
{
  if (vertices.empty()) return {};
  const Border_of_blocks border(execution, mesh, vertices, 2);
  return sweep_colors(execution, border, counts,
                      [&](std::size_t k, std::size_t b, Sweep_counts& c, std::vector<Index>& list) {
    visit(vertices[k], border.neighborhood(b), c, list);
  });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_BLOCK_SWEEP_H

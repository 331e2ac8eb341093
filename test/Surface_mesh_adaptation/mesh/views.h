// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small surfaces with random connectivity, and the operations on them that are allowed.

#ifndef TEST_SURFACE_MESH_ADAPTATION_MESH_VIEWS_H
#define TEST_SURFACE_MESH_ADAPTATION_MESH_VIEWS_H

#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace views_of_tests {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::no_index;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Mesh_view;

// Operations

inline bool is_flippable(const Mesh_view& m, Index h)
{
  return !m.is_removed_face(h / 3) && !m.is_border(h) && !m.is_feature(h) &&
         !m.are_adjacent(m.apex(h), m.apex(m.twin[h]));
}

inline std::vector<Mesh_view::Directed_edge> collapsible_edges(const Mesh_view& m)
{
  std::vector<Mesh_view::Directed_edge> result;
  for (Index h = 0; h < m.number_of_halfedges(); ++h) {
    if (m.is_removed_face(h / 3)) continue;
    for (const bool source_vanishes : {true, false}) {
      const Mesh_view::Directed_edge e{h, source_vanishes};
      if ((source_vanishes || m.is_border(h)) && m.is_collapsible(e)) result.push_back(e);
    }
  }
  return result;
}

inline std::vector<Index> flippable_edges(const Mesh_view& m)
{
  std::vector<Index> result;
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (is_flippable(m, h) && m.is_edge_owner(h)) result.push_back(h);
  return result;
}

inline std::vector<Index> closed_ring(const Mesh_view& m, Index v)
{
  std::vector<Index> ring{v};
  m.for_each_neighbor(v, [&](Index w) { ring.push_back(w); });
  return ring;
}

inline std::vector<Index> four_vertices(const Mesh_view& m, Index h)
{
  return {m.source(h), m.target(h), m.apex(h), m.apex(m.twin[h])};
}

/// A random maximal set of operations whose claims are disjoint, in random order.
template <class Operation, class Claims>
std::vector<Operation> independent(const Mesh_view& m, std::vector<Operation> candidates, Random& random,
                                   const Claims& claims)
{
  random.shuffle(candidates);
  std::vector<bool> is_claimed(m.number_of_halfedges(), false); // claims are vertices or faces
  std::vector<Operation> chosen;
  for (const Operation& o : candidates) {
    const std::vector<Index> mine = claims(o);
    if (std::any_of(mine.begin(), mine.end(), [&](Index v) { return is_claimed[v]; })) continue;
    for (const Index v : mine) is_claimed[v] = true;
    chosen.push_back(o);
  }
  random.shuffle(chosen);
  return chosen;
}

// Surfaces

/// Flips edges at random, which gives vertices of degree 3 and of high degree.
inline void scramble(Mesh_view& m, std::size_t flips, Random& random)
{
  for (std::size_t i = 0; i < flips; ++i) {
    const Index h = Index(random.below(m.number_of_halfedges()));
    if (is_flippable(m, h)) m.flip(h);
  }
}

/// Marks random edges, and the boundary, as feature curves.
inline void add_features(Mesh_view& m, double share, Random& random)
{
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (m.is_border(h) || random.real() < share) m.set_curve(h, Index(random.below(5)));
}

inline std::vector<Soup> small_surfaces()
{
  return {shapes::tetrahedron(),
          shapes::octahedron(),
          shapes::icosahedron(),
          shapes::sphere(1),
          shapes::torus(4, 3),
          shapes::torus(7, 5),
          shapes::square(1),
          shapes::square(2),
          shapes::square(5),
          shapes::cube(2),
          shapes::open_cylinder(3, 1, 1),
          shapes::open_cylinder(6, 3, 1),
          {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
}

/// Calls `test(view, random)` for many scrambled versions of the small surfaces.
template <class Test>
void for_many_views(std::size_t trials, const Test& test)
{
  Random random(7);
  for (const Soup& soup : small_surfaces())
    for (std::size_t i = 0; i < trials; ++i) {
      Mesh_view m = shapes::view(soup);
      scramble(m, i % 4 == 0 ? 0 : 3 * soup.triangles.size(), random);
      test(m, random);
      if (::testing::Test::HasFatalFailure()) return;
    }
}

/// The edges between the ends of which a vertex may be put, as halfedges that leave an inner vertex.
inline std::vector<Index> splittable_edges(const Mesh_view& m)
{
  std::vector<Index> result;
  for (Index h = 0; h < m.number_of_halfedges(); ++h)
    if (!m.is_removed_face(Mesh_view::face(h)) && !m.is_border(h) && !m.is_feature(h) &&
        !m.is_border_vertex(m.source(h)))
      result.push_back(h);
  return result;
}

/// Splits the edge of `h` with new elements at the end.
inline Index split(Mesh_view& m, Index h)
{
  const Index v = Index(m.number_of_vertices()), f = Index(m.number_of_faces());
  m.outgoing.resize(v + 1);
  for (auto* table : {&m.corner, &m.twin, &m.curve}) table->resize(3 * (f + 2));
  m.split_edge(h, v, f, f + 1);
  return v;
}

/// Claims of a collapse.
inline std::vector<Index> ring_of_vanishing(const Mesh_view& m, const Mesh_view::Directed_edge& e)
{
  return closed_ring(m, m.vanishing_vertex(e));
}

/// Collapses at most `most` edges at random.
inline void make_holes(Mesh_view& m, std::size_t most, Random& random)
{
  std::vector<Mesh_view::Directed_edge> chosen = independent(
    m, collapsible_edges(m), random, [&](const Mesh_view::Directed_edge& e) { return ring_of_vanishing(m, e); });
  chosen.resize((std::min)(most, chosen.size()));
  for (const auto& e : chosen) m.collapse(e);
}

} // namespace views_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_MESH_VIEWS_H

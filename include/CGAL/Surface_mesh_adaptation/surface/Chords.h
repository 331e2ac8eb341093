// SPDX-License-Identifier: GPL-3.0-or-later
//
// How coarse the chords are that a tessellation puts in place of curved surfaces, and whether they are chords at all.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_CHORDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_CHORDS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Edge_section.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// In sags of chords: that of a square is twice the sag of its sides, and not all sides are as long as each other.
constexpr double largest_bulge_of_facets = 2.5;

/// Chords in the middle of rows that bend evenly: of these nobody doubts that they are of something curved. The largest
/// values are not of one chord.
struct Chords
{
  std::size_t number = 0;
  double turn = 0;   ///< from one to the next, in radians
  double width = 0;
  double sag = 0;    ///< of an arc that is as wide and turns by as much

  Chords operator+(const Chords& c) const
  {
    return {number + c.number, (std::max)(turn, c.turn), (std::max)(width, c.width), (std::max)(sag, c.sag)};
  }
};

/// How alike the chords of a row are, at least.
struct Evenness
{
  double largest_ratio = 1.5;    ///< of the widths of two beside each other
  double least_turn_again = 0.5; ///< on both sides, in turns at the edge between them
};

/// The chords at the edge of `h`: none at the border of a plane and where an edge is marked.
inline Chords chords_at(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Facets& facets,
                        const std::vector<std::uint8_t>& marks, Index h, const Evenness& even)
{
  constexpr double reach = 1.5;
  const Index t = mesh.twin[h];
  if (mesh.is_border(h) || marks[h] != 0) return {};
  const Index f = Mesh_view::face(h), g = Mesh_view::face(t);
  if (facets.are_one(f, g) || facets.is_plane(f) || facets.is_plane(g)) return {};
  const Edge_section section(mesh, points, facets, marks, h);
  const double width = (std::min)(section.length(h), section.length(t));
  const auto goes_on = [&](Index side) { return section.turns_again(side, even.least_turn_again, reach * section.length()); };
  if (!are_alike(section.length(h), section.length(t), even.largest_ratio) || !goes_on(h) || !goes_on(t)) return {};
  return {1, section.turn(), width, width * section.turn() / 8};
}

/// All chords that turn by less than `turn`.
template <class Execution>
Chords chords_below(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                    const Facets& facets, const std::vector<std::uint8_t>& marks, double turn,
                    const Evenness& even = {})
{
  return reduce(execution, mesh.number_of_halfedges(), Chords(), [&](std::size_t h) {
    if (!mesh.is_edge_owner(Index(h))) return Chords();
    const Chords c = chords_at(mesh, points, facets, marks, Index(h), even);
    return c.turn < turn ? c : Chords();
  }, [](const Chords& a, const Chords& b) { return a + b; });
}

/// What a tessellation bends at its edges: lengths times angles.
struct Bends
{
  double all = 0;
  double convex = 0;
  double smooth = 0;  ///< between facets that are no planes, where no edge is marked
  double regular = 0; ///< of these, at chords
  Chords chords;

  Bends operator+(const Bends& b) const
  {
    return {all + b.all, convex + b.convex, smooth + b.smooth, regular + b.regular, chords + b.chords};
  }

  /// Whether its chords are chance. Of what is smooth in tessellations of a CAD kernel .65 and more is at chords, of coarse
  /// boxes with round edges .34, of others that are not convex .11; convex hulls, which bridge hollows, and what a
  /// decimation leaves of them mostly have less. Of those that are known to be that, `are_decimated`, half is asked for.
  bool are_chords_chance(bool are_decimated) const
  {
    constexpr double least_share = 0.1, least_share_if_convex = 0.33, least_share_if_decimated = 0.5;
    constexpr double least_convex = 0.95, least_smooth = 0.25;
    const double least = are_decimated ? least_share_if_decimated
                         : convex >= least_convex * all ? least_share_if_convex : least_share;
    return regular > 0 && regular < least * smooth && smooth >= least_smooth * all;
  }
};

inline Bends bend_at(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Facets& facets,
                     const std::vector<std::uint8_t>& marks, Index h)
{
  const Index f = Mesh_view::face(h), g = Mesh_view::face(mesh.twin[h]);
  const Vector_3 edge = points[mesh.target(h)] - points[mesh.source(h)], &n = facets.at(f).normal, &m = facets.at(g).normal;
  const double bend = edge.norm() * angle_between(n, m);
  const bool is_smooth = marks[h] == 0 && !facets.is_plane(f) && !facets.is_plane(g);
  const Chords chords = chords_at(mesh, points, facets, marks, h, {});
  return {bend, n.cross(m).dot(edge) > 0 ? bend : 0, is_smooth ? bend : 0, chords.number > 0 ? bend : 0, chords};
}

template <class Execution>
Bends bends(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points, const Facets& facets,
            const std::vector<std::uint8_t>& marks)
{
  return reduce(execution, mesh.number_of_halfedges(), Bends(), [&](std::size_t h) {
    const bool counts = !mesh.is_border(Index(h)) && mesh.is_edge_owner(Index(h));
    return counts ? bend_at(mesh, points, facets, marks, Index(h)) : Bends();
  }, [](const Bends& a, const Bends& b) { return a + b; });
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_CHORDS_H

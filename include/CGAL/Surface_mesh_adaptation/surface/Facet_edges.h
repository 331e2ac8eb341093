// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which edges between the facets of a tessellation are edges of the shape, and which are smooth borders of its pieces.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACET_EDGES_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACET_EDGES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Edge_section.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Where a plane ends smoothly in something curved, the turn is half of that from facet to facet there. If it is more
/// than all of it by this, five degrees, the plane ends in an edge.
constexpr double least_turn_beside_rows = 0.087;

/// Tells what edges are from how the surface turns there and beside them.
class Facet_edges
{
public:
  /// `marks` are those of the edges that are known already, by halfedges, and not 0.
  Facet_edges(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Facets& facets,
              const std::vector<std::uint8_t>& marks)
    : mesh_(mesh), points_(points), facets_(facets), marks_(marks)
  {}

  /// Whether a plane ends in an edge at `h`: beside a row by the turn of that, beside what is like nothing else by its own.
  bool ends_plane(Index h) const
  {
    const Facet &f = facet(h), &g = facet(mesh_.twin[h]);
    if (&f == &g || !(f.is_plane || g.is_plane)) return false;
    const double turn = angle_between(f.normal, g.normal);
    if (f.is_plane && g.is_plane) return turn > least_turn_between_planes;
    const Facet& curved = f.is_plane ? g : f;
    const bool is_of_row = curved.faces > 1 && curved.turn > 0;
    if (is_of_row) return turn > curved.turn + least_turn_beside_rows;
    return turn > usual_turn_of_triangles && !turns_more_behind(f.is_plane ? mesh_.twin[h] : h);
  }

  /// Whether the surface turns at `h` and next to it on neither side again alike: from one row of strips to another
  /// one, say.
  bool is_single_turn(Index h) const
  {
    if (are_one(h)) return false;
    const Index t = mesh_.twin[h];
    const Edge_section section(mesh_, points_, facets_, marks_, h);
    if (!(section.turn() > least_single_turn(section, h)) || (are_triangles(h) && is_beside_sliver(section, h)))
      return false;
    return is_straight_beside(section, h, h) && is_straight_beside(section, h, t) && !bends_to_and_fro(section, h);
  }

  /// Whether the surface turns at `h` by more than `turn`, between facets that are no triangles.
  bool turns_more(Index h, double turn) const
  {
    return !are_one(h) && facet(h).faces > 1 && facet(mesh_.twin[h]).faces > 1 && this->turn(h) > turn;
  }

  /// Whether both facets at `h` are wider than `width`.
  bool is_wider(Index h, double width) const
  {
    const Edge_section section(mesh_, points_, facets_, marks_, h);
    return (std::min)(section.length(h), section.length(mesh_.twin[h])) > width;
  }

  /// Whether the surface turns at `h` by what it does at the edge `last`.
  bool turns_as_much(Index last, Index h) const
  {
    return !are_one(h) && are_alike(turn(h), turn(last), largest_change_along_edges);
  }

  /// Whether the edge `last` may fade in `h`: the surface turns there, but less.
  bool turns_less(Index last, Index h) const
  {
    if (are_one(h)) return false;
    const Edge_section section(mesh_, points_, facets_, marks_, h);
    return section.turn() < turn(last) && section.turn() > least_turn_of_facets && !is_beside_sliver(section, h);
  }

  /// Whether it does: the turn at `h` is what the edge `before` says that is left of that at `last`.
  bool fades_evenly(Index before, Index last, Index h) const
  {
    const Edge_section section(mesh_, points_, facets_, marks_, h);
    return are_alike(section.turn(), turn_after(before, last, h), largest_error_of_fading);
  }

  /// Or the surface does not turn beside `h` as it does there.
  bool turns_alone(Index h) const
  {
    const Edge_section section(mesh_, points_, facets_, marks_, h);
    return !section.turns_again(h, largest_turn_beside_fading, section.length()) &&
           !section.turns_again(mesh_.twin[h], largest_turn_beside_fading, section.length());
  }

  /// Whether a plane ends at `h` in something curved, or strips do that are straight across it.
  bool is_smooth_border(Index h) const
  {
    const Index t = mesh_.twin[h];
    if (facet(h).is_plane || facet(t).is_plane) return facet(h).is_plane != facet(t).is_plane;
    return !are_one(h) && (begins_to_bend(h) || begins_to_bend(t));
  }

private:
  /// Factor between the turn where an edge fades and what the edges before it say.
  static constexpr double largest_error_of_fading = 1.5;

  /// From one part to the next of an edge that goes on evenly.
  static constexpr double largest_change_along_edges = 1.2;

  /// A turn is a single one if the surface turns no more than this part of it again on either side; more may follow
  /// where it is known from the edges before it.
  static constexpr double largest_turn_again = 1.0 / 3, largest_turn_beside_fading = 2.0 / 3;

  static constexpr double least_turn_back = 2.0 / 3;

  /// Turns that are less than this, five degrees, or ten where the facets are longer along the edge than across, are
  /// what diagonals make of something smooth.
  static constexpr double least_turn_across_strips = 0.087, least_turn_along_strips = 0.174;

  /// Triangles alone turn as they happen to: less than this, 15 degrees, is a single turn only if it stands out more.
  static constexpr double usual_turn_of_triangles = 0.262;

  double least_single_turn(const Edge_section& section, Index h) const
  {
    const bool is_across = section.length() > edge_length(h);
    return is_across || are_triangles(h) ? least_turn_across_strips : least_turn_along_strips;
  }

  /// Whether the surface does not turn again on `side` of `h` as it does there: triangles neither way.
  bool is_straight_beside(const Edge_section& section, Index h, Index side) const
  {
    if (!are_triangles(h)) return !section.turns_again(side, largest_turn_again, section.length());
    const double part = largest_turn_again * (std::min)(section.turn() / usual_turn_of_triangles, 1.0);
    return !section.turns_at_all(side, part, few * section.length());
  }

  /// Whether the surface turns back on both sides of `h` as it turns there, as chords of a saddle do; beside a triangle
  /// alone, on one.
  bool bends_to_and_fro(const Edge_section& section, Index h) const
  {
    const auto turns_back = [&](Index side) { return section.turns_back(side, least_turn_back, section.length()); };
    const Index t = mesh_.twin[h];
    const bool is_beside_triangle = facet(h).faces == 1 || facet(t).faces == 1;
    return is_beside_triangle ? turns_back(h) || turns_back(t) : turns_back(h) && turns_back(t);
  }

  /// Whether the facets on both sides are triangles alone: behind one of them the same strip may go on.
  bool are_triangles(Index h) const { return facet(h).faces + facet(mesh_.twin[h]).faces < 3; }

  /// Whether one of the facets is so low over the edge that its normal is what rounding and noise make of it.
  bool is_beside_sliver(const Edge_section& section, Index h) const
  {
    constexpr double least_extent = 0.05;
    return (std::min)(section.length(h), section.length(mesh_.twin[h])) < least_extent * edge_length(h);
  }

  double turn(Index h) const { return angle_between(facet(h).normal, facet(mesh_.twin[h]).normal); }

  /// The turn at the edge `h` behind `last` if it changes with the length as it does from `before` to `last`.
  double turn_after(Index before, Index last, Index h) const
  {
    const double change = (turn(last) - turn(before)) / (edge_length(before) + edge_length(last));
    return turn(last) + change * (edge_length(last) + edge_length(h));
  }

  double edge_length(Index h) const { return (points_[mesh_.target(h)] - points_[mesh_.source(h)]).norm(); }

  static constexpr double few = 3; // facets

  /// Where a surface begins to bend it turns by half of what it does from facet to facet then: more than so many times
  /// as much, if that is more than half a degree.
  static constexpr double least_turn_after_half = 1.5, least_turn_of_facets = 0.009;

  /// Whether the surface is straight across the edge of `h` up to there, for the length of a few facets, and bends from
  /// there on in the facet of `h`. Of a triangle alone nobody knows whether it is straight.
  bool begins_to_bend(Index h) const
  {
    const Index t = mesh_.twin[h];
    if (facet(t).faces == 1) return false;
    const Edge_section section(mesh_, points_, facets_, marks_, h);
    return section.turn() > least_turn_of_facets &&
           section.turns_again(h, least_turn_after_half, section.length()) &&
           !section.turns_again(t, largest_turn_again, few * section.length(h));
  }

  /// Whether the surface turns in the facet of `h` and behind it by clearly more than at the edge.
  bool turns_more_behind(Index h) const
  {
    const Edge_section section(mesh_, points_, facets_, marks_, h);
    return section.turns_again(h, least_turn_after_half, few * section.length(h));
  }

  const Facet& facet(Index h) const { return facets_.at(Mesh_view::face(h)); }
  bool are_one(Index h) const { return facets_.are_one(Mesh_view::face(h), Mesh_view::face(mesh_.twin[h])); }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Facets& facets_;
  const std::vector<std::uint8_t>& marks_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACET_EDGES_H

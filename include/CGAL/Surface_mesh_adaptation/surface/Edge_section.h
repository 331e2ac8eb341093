// SPDX-License-Identifier: GPL-3.0-or-later
//
// The section of a tessellation with the plane across the middle of an edge: how it turns there, and beside it.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_EDGE_SECTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_EDGE_SECTION_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A line over the two facets at an edge and on over those behind them. Angles are in radians.
class Edge_section
{
public:
  /// It ends at edges whose mark is not 0. \pre `h` is between two facets
  Edge_section(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Facets& facets,
               const std::vector<std::uint8_t>& marks, Index h)
    : mesh_(mesh), points_(points), facets_(facets), marks_(marks), h_(h)
    , middle_((points[mesh.source(h)] + points[mesh.target(h)]) / 2)
    , axis_((points[mesh.target(h)] - points[mesh.source(h)]).normalized())
    , turn_(turn_between(normal(mesh.twin[h]), normal(h)))
    , on_left_(extent(h)), on_right_(extent(mesh.twin[h]))
  {}

  /// By how much the line turns at the edge.
  double turn() const { return std::abs(turn_); }

  /// How long it is on the two facets at the edge, and on that of `side`, the edge or its twin.
  double length() const { return on_left_ + on_right_; }
  double length(Index side) const { return side == h_ ? on_left_ : on_right_; }

  /// Whether the line goes on from the facet of `side` to a turn by more than `part` of that at the edge, and the same
  /// way: within `distance`, before it turns back by as much, and before it ends.
  bool turns_again(Index side, double part, double distance) const
  {
    return next_turn(side, part, distance) > part * std::abs(turn_);
  }

  /// The same of a turn either way.
  bool turns_at_all(Index side, double part, double distance) const
  {
    return std::abs(next_turn(side, part, distance)) > part * std::abs(turn_);
  }

  /// Whether it turns back there, by more than `part` of the turn at the edge.
  bool turns_back(Index side, double part, double distance) const
  {
    return next_turn(side, part, distance) < -part * std::abs(turn_);
  }

private:
  static constexpr int most_faces = 64;

  /// The last turn that is looked at, positive if it is the same way: the first by more than `part` of that at the edge,
  /// either way, if there is one.
  double next_turn(Index side, double part, double distance) const
  {
    const double sign = (turn_ > 0) == (side == h_) ? 1 : -1;
    double walked = 0, turn = 0;
    walk(side, [&](Index g, double step) {
      walked += step;
      turn = 0;
      if (walked > distance || mesh_.is_border(g) || marks_[g] != 0) return false;
      turn = sign * turn_between(normal(g), normal(mesh_.twin[g]));
      return std::abs(turn) <= part * std::abs(turn_);
    });
    return turn;
  }

  /// Calls `step(g, length)` for the halfedges where the line leaves a face, from that of `side` on, until it returns
  /// `false`.
  template <class Step>
  void walk(Index side, const Step& step) const
  {
    Vector_3 at = middle_;
    for (int i = 0; i < most_faces; ++i) {
      const Index g = exit(side);
      const Vector_3 next = crossing(g);
      if (!step(g, (next - at).norm())) return;
      at = next;
      side = mesh_.twin[g];
    }
  }

  /// How long the line is on the facet of `side`.
  double extent(Index side) const
  {
    double length = 0;
    walk(side, [&](Index g, double step) {
      length += step;
      return !mesh_.is_border(g) && facets_.are_one(Mesh_view::face(side), Mesh_view::face(mesh_.twin[g]));
    });
    return length;
  }

  const Vector_3& normal(Index h) const { return facets_.at(Mesh_view::face(h)).normal; }

  double height(Index v) const { return axis_.dot(points_[v] - middle_); }

  /// Where the line leaves the face of `h`, which it enters there.
  Index exit(Index h) const
  {
    const bool is_with_source = (height(mesh_.apex(h)) < 0) == (height(mesh_.source(h)) < 0);
    return is_with_source ? Mesh_view::next(h) : Mesh_view::previous(h);
  }

  Vector_3 crossing(Index h) const
  {
    const Vector_3 &a = points_[mesh_.source(h)], &b = points_[mesh_.target(h)];
    const double at_a = height(mesh_.source(h)), at_b = height(mesh_.target(h));
    return a + at_a / (at_a - at_b) * (b - a);
  }

  /// From the normal `a` on to `b`, about the edge.
  double turn_between(const Vector_3& a, const Vector_3& b) const
  {
    const Vector_3 x = a - a.dot(axis_) * axis_, y = b - b.dot(axis_) * axis_;
    return std::atan2(axis_.dot(x.cross(y)), x.dot(y));
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Facets& facets_;
  const std::vector<std::uint8_t>& marks_;
  Index h_;
  Vector_3 middle_, axis_;
  double turn_, on_left_, on_right_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_EDGE_SECTION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a row of chords changes the sign of its curvature: the longest of them is no straight piece of the shape.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_INFLECTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_INFLECTION_H

#include <array>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The chords on one side of a long one, from that on.
struct Chords_beside
{
  std::array<double, 2> length;
  std::array<double, 2> turn; ///< signed angles, in radians: from the long one to the first, and from that to the second
};

/// Whether a chord of `length` between two rows of others is where a curve changes the sign of its curvature.
///
/// The turn between two chords over half of their length is the curvature at the mean of their three vertices, exactly
/// so for one that changes linearly. The line through the curvatures at both ends says what they are at the vertices
/// beside these. Where the long chord is a straight piece between two arcs that touch it, the turns at its ends are
/// half of those beside: the line reaches 3 / (1 + r) of the curvatures of arcs with chords r times shorter.
inline bool is_inflection(double length, const Chords_beside& before, const Chords_beside& behind)
{
  constexpr double least_share = 2.0 / 3, clearly_more = 1.25;
  if (!(before.turn[0] * behind.turn[0] < 0)) return false;
  const auto at_end = [&](const Chords_beside& c) { return 2 * c.turn[0] / (length + c.length[0]); };
  const double slope = 3 * (at_end(before) - at_end(behind)) / (length + before.length[0] + behind.length[0]);
  const auto share = [&](const Chords_beside& c, double away) {
    const double beside = 2 * c.turn[1] / (c.length[0] + c.length[1]);
    return (at_end(c) + away * (length + c.length[0] + c.length[1]) / 3) / beside;
  };
  const auto more_than_arcs = [&](const Chords_beside& c, double part) {
    return part * (1 + length / c.length[0]) > clearly_more * 3;
  };
  const double a = share(before, slope), b = share(behind, -slope);
  const auto is_about_one = [](double x) { return x > least_share && x * least_share < 1; };
  return is_about_one(a) && is_about_one(b) && (more_than_arcs(before, a) || more_than_arcs(behind, b));
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_INFLECTION_H

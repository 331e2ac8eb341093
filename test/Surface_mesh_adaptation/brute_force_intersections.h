// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pairs of triangles that meet, of all pairs, by exact arithmetic.

#ifndef TEST_SURFACE_MESH_ADAPTATION_BRUTE_FORCE_INTERSECTIONS_H
#define TEST_SURFACE_MESH_ADAPTATION_BRUTE_FORCE_INTERSECTIONS_H

#include "shapes.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace brute_force_intersections {

using shapes::Soup;
using shapes::Vector_3;

/// Whether two triangles of a soup meet in more than what they share, by exact constructions, with no filter.
class Exact_soup
{
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;

public:
  explicit Exact_soup(const Soup& soup) : soup_(soup)
  {
    for (const Vector_3& p : soup.points) points_.emplace_back(p[0], p[1], p[2]);
    for (const shapes::Triangle& t : soup.triangles)
      boxes_.push_back(points_[t[0]].bbox() + points_[t[1]].bbox() + points_[t[2]].bbox());
  }

  std::size_t number_of_pairs() const
  {
    std::size_t n = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      n += is_degenerate(i);
      for (std::size_t j = i + 1; j < boxes_.size(); ++j)
        n += CGAL::do_overlap(boxes_[i], boxes_[j]) && !is_degenerate(i) && !is_degenerate(j) && meet(i, j);
    }
    return n;
  }

private:
  const Kernel::Point_3& point(std::size_t t, std::size_t k) const { return points_[soup_.triangles[t][k % 3]]; }

  bool is_degenerate(std::size_t t) const { return CGAL::collinear(point(t, 0), point(t, 1), point(t, 2)); }

  Kernel::Triangle_3 triangle(std::size_t t) const { return {point(t, 0), point(t, 1), point(t, 2)}; }

  /// Beyond a common corner, one triangle reaches the edge of the other one that is opposite to it; beyond a common edge,
  /// both lie on the same side of it in one plane.
  bool meet(std::size_t s, std::size_t t) const
  {
    std::vector<std::array<std::size_t, 2>> shared;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (soup_.triangles[s][i] == soup_.triangles[t][j]) shared.push_back({i, j});
    if (shared.empty()) return CGAL::do_intersect(triangle(s), triangle(t));
    if (shared.size() == 1) {
      const auto [i, j] = shared[0];
      return CGAL::do_intersect(triangle(s), Kernel::Segment_3(point(t, j + 1), point(t, j + 2))) ||
             CGAL::do_intersect(triangle(t), Kernel::Segment_3(point(s, i + 1), point(s, i + 2)));
    }
    const auto& a = point(s, shared[0][0]);
    const auto& b = point(s, shared[1][0]);
    const auto& c = point(s, 3 - shared[0][0] - shared[1][0]);
    const auto& d = point(t, 3 - shared[0][1] - shared[1][1]);
    return CGAL::coplanar(a, b, c, d) &&
           CGAL::scalar_product(CGAL::cross_product(b - a, c - a), CGAL::cross_product(b - a, d - a)) > 0;
  }

  const Soup& soup_;
  std::vector<Kernel::Point_3> points_;
  std::vector<CGAL::Bbox_3> boxes_;
};

/// Those and the degenerate triangles.
inline std::size_t number_of_pairs(const Soup& soup) { return Exact_soup(soup).number_of_pairs(); }

} // namespace brute_force_intersections

#endif // TEST_SURFACE_MESH_ADAPTATION_BRUTE_FORCE_INTERSECTIONS_H

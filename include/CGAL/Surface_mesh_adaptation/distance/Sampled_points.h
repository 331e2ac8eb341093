// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of the reference next to four places of each face of an adapted mesh: what its faces should run through.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SAMPLED_POINTS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SAMPLED_POINTS_H

#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/closest_point.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {

template <class Surface>
class Sampled_points
{
public:
  /// \pre no face of `surface` is removed
  template <class Execution>
  Sampled_points(const Execution& execution, const Surface& surface) : surface_(surface), mesh_(surface.mesh)
  {
    locations_.resize(places * mesh_.number_of_faces());
    points_.resize(places * mesh_.number_of_faces());
    weights_.resize(mesh_.number_of_faces());
    for_each_index(execution, mesh_.number_of_faces(), [&](std::size_t f) {
      if (is_stopped(execution)) return;
      for (std::size_t i = 0; i < places; ++i) locations_[places * f + i] = start(Index(f), i);
    }, heavy_chunk_length);
    sample(execution);
  }

  /// Finds the points anew, for the faces as they are now. Work: O(n), a walk on the reference for each place, from
  /// where the last one ended.
  template <class Execution>
  void sample(const Execution& execution)
  {
    for_each_index(execution, mesh_.number_of_faces(), [&](std::size_t f) {
      if (is_stopped(execution)) return;
      const Triangle_points p = corners(Index(f));
      for (std::size_t i = 0; i < places; ++i) {
        Location& l = locations_[places * f + i];
        const Vector_3 target = place(p, i);
        const auto nearest = surface_.reference().locate({l, surface_.reference().evaluate(l)}, target,
                                                         share_of_way * (p[i % 3] - target).norm());
        l = nearest.location;
        points_[places * f + i] = surface_.near_input(l, nearest.point.position);
      }
      weights_[f] = (p[1] - p[0]).cross(p[2] - p[0]).norm() / (2 * places);
    }, heavy_chunk_length);
  }

  /// Calls `g(closest, weight)` for the points of face `f`.
  template <class G>
  void for_each_point(Index f, const G& g) const
  {
    const Triangle_points p = corners(f);
    for (std::size_t i = 0; i < places; ++i)
      g(internal::closest_point_of_triangle(points_[places * f + i], p[0], p[1], p[2]), weights_[f]);
  }

  /// Whether the points of face `f` are no further away than `max_distance`, and what it covers stays in the tolerance.
  bool are_within_limits(Index f, double max_distance) const
  {
    return squared_distance(f) <= max_distance * max_distance &&
           (!surface_.tolerance ||
            surface_.tolerance->are_covered(std::array<Index, 1>{f}, std::array<Triangle_points, 1>{corners(f)}));
  }

  /// The largest distance of a point from its face.
  template <class Execution>
  double largest_distance(const Execution& execution) const
  {
    return std::sqrt(reduce(execution, mesh_.number_of_faces(), 0.0, [&](std::size_t f) {
      return squared_distance(Index(f));
    }, [](double a, double b) { return (std::max)(a, b); }));
  }

private:
  static constexpr std::size_t places = 4; // the centroids of the quarters of a face: one towards each corner, its own

  double squared_distance(Index f) const
  {
    double largest = 0;
    for_each_point(f, [&](const internal::Closest_point& closest, double) {
      largest = (std::max)(largest, closest.offset.squaredNorm());
    });
    return largest;
  }

  /// Place `i` of a face with corners `p`.
  static Vector_3 place(const Triangle_points& p, std::size_t i)
  {
    const Vector_3 centroid = (p[0] + p[1] + p[2]) / 3;
    return i < 3 ? (p[i] + centroid) / 2 : centroid;
  }

  /// Where the first walk to place `i` starts: at the next corner that is smooth.
  Location start(Index f, std::size_t i) const
  {
    const auto corner = [&](std::size_t k) { return mesh_.corner[3 * std::size_t(f) + (i + k) % 3]; };
    for (std::size_t k = 0; k < 3; ++k)
      if (surface_.vertex_class(corner(k)) == Vertex_class::smooth) return surface_.locations[corner(k)];
    return start_in_sector(surface_, Index(3 * std::size_t(f) + i % 3)).location;
  }

  Triangle_points corners(Index f) const
  {
    const std::size_t h = 3 * std::size_t(f);
    return {surface_.points[mesh_.corner[h]], surface_.points[mesh_.corner[h + 1]], surface_.points[mesh_.corner[h + 2]]};
  }

  static constexpr double share_of_way = 0.1; // to a place: how precisely its point is found

  const Surface& surface_;
  const Mesh_view& mesh_;
  Buffer<Location> locations_;
  Buffer<Vector_3> points_; // at these
  Buffer<double> weights_; // areas
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_SAMPLED_POINTS_H

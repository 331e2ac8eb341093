// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the faces of an adapted mesh are from the surface, while it changes at some places.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_DEVIATIONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_DEVIATIONS_H

#include <CGAL/Surface_mesh_adaptation/distance/Face_keys.h>
#include <CGAL/Surface_mesh_adaptation/distance/Input_deviations.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// For each face of an adapted mesh its largest distance from the surface, at its centroid and the middles of its
/// edges, and that of the vertices and edges of the input next to it. Where the faces of the input are the surface, the
/// former are bounds for all points of the face. Where the aims of the metric have a deviation of its own for a face of the
/// input, distances above that count as many times as it is smaller than the common one.
template <class Surface>
class Face_deviations
{
public:
  /// Beyond `allowed` it is worth to look for a nearer point of the surface. The surface must outlive this.
  template <class Execution>
  Face_deviations(const Execution& execution, const Surface& surface, double allowed)
    : surface_(surface), mesh_(surface.mesh), allowed_(allowed), of_input_(surface)
  {
    if (is_flat) input_.emplace(execution, surface.reference().mesh, surface.reference().points);
  }

  /// Measures the faces that were not there the last time. \pre no face is removed
  /// \par Complexity
  /// O(n log n); a few short walks on the reference for each of these faces, and a search for the faces next
  /// to what of the input is next to them
  template <class Execution>
  void update(const Execution& execution)
  {
    Face_keys keys(execution, mesh_, surface_.points);
    std::vector<double> deviations(keys.size());
    for_each_index(execution, keys.size(), [&](std::size_t f) {
      const Index known = keys_.face(keys[Index(f)]);
      if (known != no_index) deviations[f] = deviations_[known];
      else if (!is_stopped(execution)) deviations[f] = largest_distance(Index(f));
    }, heavy_chunk_length);
    keys_ = std::move(keys);
    deviations_ = std::move(deviations);
    const auto weight_of = [&](Index f) { return weight(f); };
    for (const auto& e : of_input_.update(execution, keys_, allowed_, weight_of))
      deviations_[e.face] = (std::max)(deviations_[e.face], e.distance);
  }

  double allowed() const { return allowed_; }

  double operator[](Index f) const { return deviations_[f]; }

  /// No more than how far the face `f` is, where distances count more than once.
  double least_distance(Index f) const
  {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
      largest = (std::max)(largest, weight(surface_.reference().face_at(surface_.locations[corner(f, i)])));
    return deviations_[f] / largest;
  }

  template <class Execution>
  double largest(const Execution& execution) const
  {
    return reduce(execution, deviations_.size(), 0.0, [&](std::size_t f) { return deviations_[f]; },
                  [](double a, double b) { return (std::max)(a, b); });
  }

  /// The integral over the mesh of what deviations exceed `asked` by.
  template <class Execution>
  double excess(const Execution& execution, double asked) const
  {
    return reduce(execution, deviations_.size(), 0.0, [&](std::size_t f) {
      const Vector_3 e = point(Index(f), 1) - point(Index(f), 0), g = point(Index(f), 2) - point(Index(f), 0);
      return (std::max)(0.0, deviations_[f] - asked) * e.cross(g).norm() / 2;
    }, [](double a, double b) { return a + b; });
  }

  /// Of the faces, those that are farther away than is allowed.
  template <class Execution>
  std::size_t number_above(const Execution& execution) const
  {
    return count_if(execution, deviations_.size(), [&](std::size_t f) { return deviations_[f] > allowed(); });
  }

  /// What at most `n` faces exceed.
  double nth_largest(std::size_t n) const
  {
    if (n >= deviations_.size()) return 0;
    std::vector<double> sorted = deviations_;
    const auto nth = sorted.begin() + std::ptrdiff_t(n);
    std::nth_element(sorted.begin(), nth, sorted.end(), std::greater<double>());
    return *nth;
  }

private:
  using Located_point = typename Surface::Reference::Located_point;

  Index corner(Index f, std::size_t i) const { return mesh_.corner[3 * std::size_t(f) + i % 3]; }
  const Vector_3& point(Index f, std::size_t i) const { return surface_.points[corner(f, i)]; }

  double largest_distance(Index f) const
  {
    const double bound = is_flat ? bound_of_distance(f) : std::numeric_limits<double>::infinity();
    if (is_flat && bound > allowed_) return bound;
    const Vector_3 centroid = (point(f, 0) + point(f, 1) + point(f, 2)) / 3;
    const double precision = share_of_length * (point(f, 0) - centroid).norm();
    const Located_point start = surface_.reference().locate(start_at(f, 0), centroid, precision);
    const double weight = this->weight(start.location.cell);
    const auto distance_of = [&](const Vector_3& p) {
      double d = distance(surface_.reference().locate(start, p, precision), p);
      for (std::size_t i = 0; i < 3 && weight * d > allowed_; ++i)
        d = (std::min)(d, distance(surface_.reference().locate(start_at(f, i), p, precision), p));
      return d;
    };
    double result = distance_of(centroid);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index h = Index(3 * std::size_t(f) + i);
      if (mesh_.is_feature(h)) result = (std::max)(result, distance_of_curve(h));
      else if (is_owner(h)) result = (std::max)(result, distance_of((point(f, i) + point(f, i + 1)) / 2));
    }
    return (std::min)(weight * result, bound);
  }

  /// Of all points of a face from those of the input; what is allowed, if it is not beyond.
  double bound_of_distance(Index f) const
  {
    const Index near = surface_.reference().face_at(surface_.locations[corner(f, 0)]);
    const double weight = this->weight(near), enough = allowed_ / weight;
    const Triangle_points t{point(f, 0), point(f, 1), point(f, 2)};
    if (internal::is_over_surface(*input_, t, enough, input_->place(near))) return allowed_;
    return weight * distance_bound(*input_, t, enough, {precision_of_bounds * enough, enough}, input_->place(near),
                                   max_pieces);
  }

  /// As what a distance of 1 counts above a face of the input.
  double weight(Index face_of_input) const
  {
    const auto& aims = surface_.background().aims();
    return aims.deviation_of_face.empty() ? 1 : aims.deviation / aims.deviation_of_face[face_of_input];
  }

  /// Whether the edge of `h` counts for its face and not for that across: whatever their numbers are.
  bool is_owner(Index h) const
  {
    const Vector_3 &a = surface_.points[mesh_.source(h)], &b = surface_.points[mesh_.target(h)];
    return mesh_.twin[h] == no_index || std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }

  /// Next to corner `i` of face `f`.
  Located_point start_at(Index f, std::size_t i) const
  {
    const Index v = corner(f, i);
    if (surface_.vertex_class(v) != Vertex_class::smooth) return start_in_sector(surface_, Index(3 * std::size_t(f) + i));
    return {surface_.locations[v], {surface_.points[v], surface_.normals[v]}};
  }

  double distance(const Located_point& nearest, const Vector_3& p) const
  {
    return (surface_.near_input(nearest.location, nearest.point.position) - p).norm();
  }

  /// How far the curve below the edge of `h` bends away from it.
  double distance_of_curve(Index h) const
  {
    const Index a = mesh_.source(h), b = mesh_.target(h), curve = mesh_.curve[h];
    const auto arc = surface_.reference().arc(curve, surface_.locations[a], surface_.locations[b]);
    const Vector_3 middle = surface_.point(surface_.reference().on_curve(curve, (arc.first + arc.second) / 2));
    const Vector_3 along = (surface_.points[b] - surface_.points[a]).normalized(), way = middle - surface_.points[a];
    return (way - way.dot(along) * along).norm();
  }

  static constexpr bool is_flat = Surface::Reference::is_flat;
  static constexpr double share_of_length = 0.1;      // how precisely the point next to a place is found
  static constexpr double precision_of_bounds = 0.05; // in what is allowed
  static constexpr std::size_t max_pieces = 1024;     // of a face, for its bound

  const Surface& surface_;
  const Mesh_view& mesh_;
  double allowed_;
  std::optional<Triangle_tree> input_; // where its faces are the surface
  Input_deviations<Surface> of_input_;
  Face_keys keys_;
  std::vector<double> deviations_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_DEVIATIONS_H

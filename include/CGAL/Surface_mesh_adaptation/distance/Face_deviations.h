// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the faces of an adapted mesh are from the surface, while it changes at some places.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_DEVIATIONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_DEVIATIONS_H

#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// For each face of an adapted mesh its largest distance from the surface, at its centroid and the middles of its
/// edges, and that of the vertices of the input next to it. Where the aims of the metric have a deviation of its own for a
/// face of the input, distances above that count as many times as it is smaller than the common one.
template <class Surface>
class Face_deviations
{
public:
  /// Beyond `allowed` it is worth to look for a nearer point of the surface. The surface must outlive this.
  Face_deviations(const Surface& surface, double allowed)
    : surface_(surface), mesh_(surface.mesh), allowed_(allowed), face_of_input_(surface.reference().points.size(), 0)
  {}

  /// Measures the faces that were not there the last time. \pre no face is removed
  /// \par Complexity
  /// O(n log n); a few short walks on the reference for each of these faces, and a search for the face next
  /// to each vertex of the input next to them
  template <class Execution>
  void update(const Execution& execution)
  {
    std::vector<std::uint64_t> keys(mesh_.number_of_faces());
    deviations_.resize(keys.size());
    for_each_index(execution, keys.size(), [&](std::size_t f) {
      keys[f] = key(Index(f));
      const std::size_t known = place(keys[f]);
      if (known < keys_.size()) deviations_[f] = of_keys_[known];
      else if (!is_stopped(execution)) deviations_[f] = largest_distance(Index(f));
    }, heavy_chunk_length);
    const std::vector<Index> order = internal::sorted_by_key(execution, keys);
    keys_.resize(keys.size());
    for_each_index(execution, keys.size(), [&](std::size_t i) { keys_[i] = keys[order[i]]; });
    add_vertices_of_input(execution, keys);
    of_keys_.resize(keys.size());
    for_each_index(execution, keys.size(), [&](std::size_t i) { of_keys_[i] = deviations_[order[i]]; });
  }

  double allowed() const { return allowed_; }

  double operator[](Index f) const { return deviations_[f]; }

  template <class Execution>
  double largest(const Execution& execution) const
  {
    return reduce(execution, deviations_.size(), 0.0, [&](std::size_t f) { return deviations_[f]; },
                  [](double a, double b) { return (std::max)(a, b); });
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

  /// What tells a face from others: its points.
  std::uint64_t key(Index f) const
  {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint64_t bits;
        std::memcpy(&bits, &point(f, i)[Eigen::Index(k)], sizeof bits);
        result = hash_of_id(result ^ bits);
      }
    return result;
  }

  /// Where `key` is among the faces of the last time, or behind them.
  std::size_t place(std::uint64_t key) const
  {
    const auto at = std::lower_bound(keys_.begin(), keys_.end(), key);
    return at != keys_.end() && *at == key ? std::size_t(at - keys_.begin()) : keys_.size();
  }

  double largest_distance(Index f) const
  {
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
    return weight * result;
  }

  /// As what a distance of 1 counts above a face of the input.
  double weight(Index face_of_input) const
  {
    const auto& aims = surface_.background().aims();
    return aims.deviation_of_face.empty() ? 1 : aims.deviation / aims.deviation_of_face[face_of_input];
  }

  double weight_at_vertex(Index vertex_of_input) const
  {
    const Mesh_view& input = surface_.reference().mesh;
    double largest = 0;
    input.for_each_outgoing(vertex_of_input, [&](Index h) { largest = (std::max)(largest, weight(Mesh_view::face(h))); });
    return largest;
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

  /// Raises the deviations by the distances of vertices of the input of which the next face is not known any more.
  template <class Execution>
  void add_vertices_of_input(const Execution& execution, const std::vector<std::uint64_t>& keys)
  {
    const std::vector<Vector_3>& points = surface_.reference().points;
    const std::vector<Index> lost = pack(execution, points.size(), [&](std::size_t v) {
      return place(face_of_input_[v]) == keys_.size();
    });
    if (lost.empty()) return;
    const Triangle_tree tree(execution, mesh_, surface_.points);
    std::vector<Index> face(tree.size());
    for_each_index(execution, face.size(), [&](std::size_t f) { face[tree.place(Index(f))] = Index(f); });
    std::vector<Triangle_tree::Nearest> nearest(lost.size());
    for_each_chunk(execution, lost.size(), default_chunk_length, [&](std::size_t, std::size_t begin, std::size_t end) {
      std::size_t guess = lost[begin] * tree.size() / points.size(); // both are in order along one curve, more or less
      for (std::size_t i = begin; i < end; ++i) {
        nearest[i] = tree.nearest(points[lost[i]], tree.towards(points[lost[i]], guess));
        guess = nearest[i].triangle;
        face_of_input_[lost[i]] = keys[face[guess]];
      }
    });
    for (std::size_t i = 0; i < lost.size(); ++i) {
      double& deviation = deviations_[face[nearest[i].triangle]];
      deviation = (std::max)(deviation, weight_at_vertex(lost[i]) * std::sqrt(nearest[i].squared_distance));
    }
  }

  static constexpr double share_of_length = 0.1; // how precisely the point next to a place is found

  const Surface& surface_;
  const Mesh_view& mesh_;
  double allowed_;
  std::vector<double> deviations_;
  std::vector<std::uint64_t> keys_;          // of the faces, sorted
  std::vector<double> of_keys_;              // their deviations
  std::vector<std::uint64_t> face_of_input_; // key of the face next to each vertex of the input
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_FACE_DEVIATIONS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the faces of an adapted mesh leave the surface by more than they may, and what to ask of the metric there.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXCESS_DEVIATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXCESS_DEVIATION_H

#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/Sampled_points.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>
#include <CGAL/Surface_mesh_adaptation/surface_distance.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Distances of the faces of an adapted mesh from the surface, at a few places of each, and of the vertices of the input from
/// the faces.
class Excess_deviation
{
public:
  /// \pre no face of `surface` is removed
  /// Work: O(n log n), a short walk on the reference for each place, and a search for the face next to each vertex.
  template <class Execution, class Surface>
  Excess_deviation(const Execution& execution, const Surface& surface, double allowed)
  {
    const Sampled_points<Surface> points(execution, surface);
    const std::vector<double> of_faces = distances_of_faces(execution, surface, points);
    const std::vector<Nearest_face> nearest = nearest_faces(execution, surface);
    const auto larger = [](double a, double b) { return (std::max)(a, b); };
    largest_ = reduce(execution, of_faces.size(), 0.0, [&](std::size_t f) { return of_faces[f]; }, larger);
    largest_ = reduce(execution, nearest.size(), largest_, [&](std::size_t v) { return nearest[v].distance; }, larger);
    if (!(largest_ > allowed)) return;
    excess_.assign(nearest.size(), 1);
    for (const Index f : pack(execution, of_faces.size(), [&](std::size_t i) { return of_faces[i] > allowed; }))
      add(surface, points, f, of_faces[f] / allowed);
    for (const Index v : pack(execution, nearest.size(), [&](std::size_t i) { return nearest[i].distance > allowed; })) {
      raise(v, nearest[v].distance / allowed);
      add(surface, points, nearest[v].face, nearest[v].distance / allowed);
    }
  }

  double largest() const { return largest_; }

  /// How many times as large as allowed it is around each vertex of the reference, at least 1; empty if it is nowhere.
  const std::vector<double>& excess() const { return excess_; }

private:
  struct Nearest_face
  {
    double distance;
    Index face;
  };

  /// The largest distance of the places of each face and of the middles of edges that it owns.
  template <class Execution, class Surface>
  static std::vector<double> distances_of_faces(const Execution& execution, const Surface& surface,
                                                const Sampled_points<Surface>& points)
  {
    std::vector<double> distances(surface.mesh.number_of_faces());
    for_each_index(execution, distances.size(), [&](std::size_t i) {
      const Index f = Index(i);
      distances[i] = points.largest_distance_of(f);
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (surface.mesh.is_edge_owner(h)) distances[i] = (std::max)(distances[i], distance_of_middle(surface, points, h));
    }, heavy_chunk_length);
    return distances;
  }

  /// Of the edge of `h`.
  template <class Surface>
  static double distance_of_middle(const Surface& surface, const Sampled_points<Surface>& points, Index h)
  {
    const Index a = surface.mesh.source(h), b = surface.mesh.target(h);
    const Vector_3 middle = (surface.points[a] + surface.points[b]) / 2;
    const auto& reference = surface.reference();
    if (surface.mesh.is_feature(h)) {
      const Index curve = surface.mesh.curve[h];
      const auto arc = reference.arc(curve, surface.locations[a], surface.locations[b]);
      const Location l = reference.on_curve(curve, (arc.first + arc.second) / 2);
      return (surface.near_input(l, reference.evaluate(l).position) - middle).norm();
    }
    constexpr double precision = 0.05; // of the edge
    const Location start = points.location_at_centroid(Mesh_view::face(h));
    const auto nearest = reference.locate({start, reference.evaluate(start)}, middle,
                                          precision * (surface.points[b] - surface.points[a]).norm());
    return (surface.near_input(nearest.location, nearest.point.position) - middle).norm();
  }

  /// The faces next to the vertices of the input.
  template <class Execution, class Surface>
  static std::vector<Nearest_face> nearest_faces(const Execution& execution, const Surface& surface)
  {
    const Triangle_tree tree(execution, surface.mesh, surface.points);
    std::vector<Index> face(tree.size());
    for_each_index(execution, face.size(), [&](std::size_t f) { face[tree.place(Index(f))] = Index(f); });
    std::vector<Nearest_face> result(surface.reference().points.size());
    for_each_index(execution, result.size(), [&](std::size_t v) {
      const std::size_t guess = v * tree.size() / result.size(); // both are in order along the same curve, more or less
      const auto nearest = tree.nearest(surface.reference().points[v], guess);
      result[v] = {std::sqrt(nearest.squared_distance), face[nearest.triangle]};
    });
    return result;
  }

  void raise(Index v, double excess) { excess_[v] = (std::max)(excess_[v], excess); }

  /// What is below face `f` and its corners needs smaller sizes.
  template <class Surface>
  void add(const Surface& surface, const Sampled_points<Surface>& points, Index f, double excess)
  {
    const auto raise_at = [&](const Location& l) {
      const auto at = surface.reference().interpolation(l);
      for (std::size_t i = 0; i < 3; ++i)
        if (at.weights[i] > 0) raise(at.vertices[i], excess);
    };
    points.for_each_location(f, raise_at);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) raise_at(surface.locations[surface.mesh.corner[h]]);
  }

  double largest_ = 0;
  std::vector<double> excess_;
};

/// The largest distance of the patches of `reference` from its faces, at the centroids and the middles of the edges of those
/// whose edges are longer than `least_length`.
template <class Execution, class Reference>
double largest_bulge(const Execution& execution, const Reference& reference, double least_length)
{
  constexpr double places[4][2] = {{1.0 / 3, 1.0 / 3}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  return reduce(execution, reference.mesh.number_of_faces(), 0.0, [&](std::size_t f) {
    const auto corner = [&](std::size_t i) -> const Vector_3& { return reference.points[reference.mesh.corner[3 * f + i]]; };
    double longest = 0, largest = 0;
    for (std::size_t i = 0; i < 3; ++i) longest = (std::max)(longest, (corner((i + 1) % 3) - corner(i)).norm());
    if (longest <= least_length) return 0.0;
    for (const auto& p : places) {
      const Location l{Vertex_class::smooth, Index(f), p[0], p[1]};
      largest = (std::max)(largest, (reference.evaluate(l).position - reference.flat_point(l)).norm());
    }
    return largest;
  }, [](double a, double b) { return (std::max)(a, b); });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXCESS_DEVIATION_H

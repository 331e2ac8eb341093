// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners, and the chains of feature edges between them.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_CHAINING_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_CHAINING_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Curve_geometry.h>
#include <CGAL/Surface_mesh_adaptation/surface/Feature_marks.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Strokes.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Vertices around which the angles of the faces add up to less than this, 240 degrees, are points of cones or spikes.
/// On meshes of smooth shapes they add up to about 300 degrees at least.
constexpr double angle_around_point = 4 * CGAL_PI / 3;

/// Length of the mean of the unit normals of the faces at such a point, at most: .67 for a cone with that angle.
constexpr double cosine_at_point = 0.8;

/// From the edges that are features to curves and corners.
class Feature_chaining
{
public:
  Feature_chaining(Mesh_view& mesh, const std::vector<Vector_3>& points, const Feature_parameters& parameters,
                   const Feature_marks& marks, Facets facets)
    : mesh_(mesh), points_(points), parameters_(parameters), marks_(marks)
  {
    features_.facets = std::move(facets);
  }

  template <class Execution>
  Features run(const Execution& execution)
  {
    feature_vertices_ = marks_.vertices_on_features(execution); // what follows is sequential, but only along these
    features_.vertex_class.assign(mesh_.number_of_vertices(), Vertex_class::smooth);
    features_.node_of_vertex.assign(mesh_.number_of_vertices(), Curve_node());
    for_each_index(execution, mesh_.number_of_vertices(), [&](std::size_t v) {
      if (is_fixed(Index(v))) features_.vertex_class[v] = Vertex_class::corner;
    });
    for (const Index v : feature_vertices_) features_.vertex_class[v] = classify(v);
    make_corners_on_tiny_cycles();
    chain_curves();
    return std::move(features_);
  }

private:
  /// Whether `v` is a corner whatever the features at it.
  bool is_fixed(Index v) const
  {
    return (!parameters_.vertex_is_constrained.empty() && parameters_.vertex_is_constrained[v]) ||
           (parameters_.detect_ridges && is_point(v));
  }

  /// Whether `v` is the point of a cone. The cheap test of the normals comes first.
  bool is_point(Index v) const
  {
    if (mesh_.is_border_vertex(v)) return false;
    Vector_3 sum = Vector_3::Zero();
    double faces = 0, angles = 0;
    mesh_.for_each_outgoing(v, [&](Index h) {
      sum += face_normal(mesh_, points_, 3 * Mesh_view::face(h)).normalized();
      ++faces;
    });
    if (sum.norm() >= cosine_at_point * faces) return false;
    mesh_.for_each_outgoing(v, [&](Index h) {
      angles += angle_between(points_[mesh_.target(h)] - points_[v], points_[mesh_.apex(h)] - points_[v]);
    });
    return angles < angle_around_point;
  }

  /// The class of a vertex with features, of which those that are fixed are known.
  Vertex_class classify(Index v) const
  {
    if (features_.vertex_class[v] == Vertex_class::corner) return Vertex_class::corner;
    Ring<Index> along;
    std::uint8_t first = Feature_marks::none;
    bool may_pass = true;
    marks_.for_each_neighbor(v, [&](Index w, std::uint8_t mark) {
      if (along.empty()) first = mark;
      along.push_back(w);
      may_pass = may_pass && Feature_marks::is_smooth(mark) == Feature_marks::is_smooth(first) &&
                 (mark == Feature_marks::smooth) == (first == Feature_marks::smooth) &&
                 !Feature_marks::is_protected(mark);
    });
    if (along.empty()) return Vertex_class::smooth;
    if (along.size() != 2 || !may_pass) return Vertex_class::corner;
    const Vector_3 a = points_[v] - points_[along[0]], b = points_[along[1]] - points_[v];
    const bool straight = a.dot(b) >= std::cos(parameters_.corner_angle * CGAL_PI / 180) * a.norm() * b.norm();
    return straight && !is_bend_of_lines(v, along) ? Vertex_class::curve : Vertex_class::corner;
  }

  /// Whether two straight lines meet in `v`, between its neighbours `along` two features: edges of lengths that no arc
  /// has beside each other, of which the shorter one begins no arc either.
  bool is_bend_of_lines(Index v, const Ring<Index>& along) const
  {
    const double ratio = largest_ratio_of_edges(features_.facets);
    const Vector_3 a = points_[v] - points_[along[0]], b = points_[along[1]] - points_[v];
    const bool is_first_shorter = a.squaredNorm() < b.squaredNorm();
    const double shorter = (is_first_shorter ? a : b).norm(), longer = (is_first_shorter ? b : a).norm();
    if (!(longer > ratio * shorter) || angle_between(a, b) < least_turn_beside_rows) return false;
    const Index w = along[is_first_shorter ? 0 : 1];
    bool begins_arc = false;
    marks_.for_each_neighbor(w, [&](Index x, std::uint8_t) {
      begins_arc = begins_arc || (x != v && are_alike((points_[x] - points_[w]).norm(), shorter, ratio));
    });
    return !begins_arc;
  }

  /// The vertices from `start` along the feature edge to `second`, up to a corner or back to `start`.
  std::vector<Index> chain_from(Index start, Index second) const
  {
    std::vector<Index> chain{start};
    for (Index previous = start, current = second;;) {
      chain.push_back(current);
      if (features_.vertex_class[current] != Vertex_class::curve || current == start) return chain;
      Index next = no_index;
      marks_.for_each_neighbor(current, [&](Index w, std::uint8_t) {
        if (w != previous) next = w;
      });
      previous = current;
      current = next;
    }
  }

  /// A cycle of few edges, or of which one edge is a large part, cannot be parametrised by its arc length once it is
  /// coarser: its vertices are kept, or the ends of such edges.
  void make_corners_on_tiny_cycles()
  {
    std::vector<std::uint8_t> visited(mesh_.number_of_vertices(), 0);
    for (const Index v : feature_vertices_) {
      if (visited[v] || features_.vertex_class[v] != Vertex_class::curve) continue;
      Index second = no_index;
      marks_.for_each_neighbor(v, [&](Index w, std::uint8_t) { second = w; });
      const std::vector<Index> chain = chain_from(v, second);
      for (Index w : chain) visited[w] = 1;
      if (chain.front() == chain.back()) make_corners_on(chain);
    }
  }

  void make_corners_on(const std::vector<Index>& cycle)
  {
    constexpr std::size_t few = 8;
    constexpr double large_part = 0.25;
    const auto step = [&](std::size_t i) { return (points_[cycle[i]] - points_[cycle[i - 1]]).norm(); };
    double length = 0;
    for (std::size_t i = 1; i < cycle.size(); ++i) length += step(i);
    for (std::size_t i = 1; i < cycle.size(); ++i)
      if (cycle.size() <= few || step(i) > large_part * length)
        features_.vertex_class[cycle[i - 1]] = features_.vertex_class[cycle[i]] = Vertex_class::corner;
  }

  void chain_curves()
  {
    mesh_.curve.assign(mesh_.number_of_halfedges(), no_curve);
    using Marks = Feature_marks;
    const auto chain = [&](const auto& is_of_kind) {
      add_curves_from(Vertex_class::corner, is_of_kind);
      add_curves_from(Vertex_class::curve, is_of_kind); // what is left are cycles
      return Index(features_.curves.size());
    };
    mesh_.curves.first_protected = chain([](std::uint8_t m) { return m == Marks::ridge || m == Marks::kept; });
    mesh_.curves.first_smooth = chain([](std::uint8_t m) { return m == Marks::protected_crease; });
    mesh_.curves.end_of_protected = chain([](std::uint8_t m) { return m == Marks::protected_smooth; });
    mesh_.curves.first_plane_border = chain([](std::uint8_t m) { return m == Marks::kept_smooth; });
    chain([](std::uint8_t m) { return m == Marks::smooth; });
  }

  /// Adds the curves of marks for which `is_of_kind(mark)` that start at vertices of one class.
  template <class IsOfKind>
  void add_curves_from(Vertex_class vertex_class, const IsOfKind& is_of_kind)
  {
    for (const Index v : feature_vertices_) {
      if (features_.vertex_class[v] != vertex_class) continue;
      Ring<Index> along;
      marks_.for_each_neighbor(v, [&](Index w, std::uint8_t mark) {
        if (is_of_kind(mark)) along.push_back(w);
      });
      for (Index w : along)
        if (mesh_.curve[mesh_.any_halfedge(v, w)] == no_curve) add_curve(chain_from(v, w));
    }
  }

  void add_curve(std::vector<Index> chain)
  {
    const Index id = Index(features_.curves.size());
    Feature_curve c;
    c.closed = features_.vertex_class[chain.front()] == Vertex_class::curve;
    if (c.closed) start_at_bend(chain);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const double step = i == 0 ? 0 : (points_[chain[i]] - points_[chain[i - 1]]).norm();
      c.arc_length.push_back(i == 0 ? 0 : c.arc_length.back() + step);
      if (i > 0) mesh_.set_curve(mesh_.any_halfedge(chain[i - 1], chain[i]), id);
      if (features_.vertex_class[chain[i]] == Vertex_class::curve && !(c.closed && i + 1 == chain.size()))
        features_.node_of_vertex[chain[i]] = {id, Index(i)};
    }
    c.vertices = std::move(chain);
    Curve_geometry(mesh_, points_, parameters_, features_.facets)(c);
    features_.curves.push_back(std::move(c));
  }

  /// Turns the closed `chain` so that it starts where it is not straight, if it is somewhere.
  void start_at_bend(std::vector<Index>& chain) const
  {
    const std::size_t n = chain.size() - 1;
    const auto is_straight = [&](std::size_t i) {
      return features_.facets.is_on_line(points_[chain[(i + n - 1) % n]], points_[chain[i]], points_[chain[i + 1]]);
    };
    std::size_t start = 0;
    while (start < n && is_straight(start)) ++start;
    if (start == 0 || start == n) return;
    chain.pop_back();
    std::rotate(chain.begin(), chain.begin() + std::ptrdiff_t(start), chain.end());
    chain.push_back(chain.front());
  }

  Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Feature_parameters& parameters_;
  const Feature_marks& marks_;
  std::vector<Index> feature_vertices_;
  Features features_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_CHAINING_H

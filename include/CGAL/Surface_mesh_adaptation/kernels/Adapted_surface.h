// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh under adaptation: connectivity, and for each vertex its location on the reference with what follows from
// it. The kernels read and write this and nothing else.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ADAPTED_SURFACE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ADAPTED_SURFACE_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/fields/Metric_background.h>
#include <CGAL/Surface_mesh_adaptation/fields/expected_size.h>
#include <CGAL/Surface_mesh_adaptation/fields/tightened_metric.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Late_creases.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Tolerance.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/protected_sizes.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {
class Self_intersection_guard; // its exact predicates are slow to compile
}

/// Everything that belongs to one vertex and follows from its location.
template <class Metric>
struct Placed_vertex
{
  Location location;
  Vector_3 point;
  Vector_3 normal;  ///< unit; zero on curves and at corners
  Metric metric;
};

/// Where nobody asks for `AvoidsIntersections`, what keeps faces from meeting need not be compiled.
template <class Metric_, class Reconstruction_, bool AvoidsIntersections = false>
class Adapted_surface
{
public:
  using Metric = Metric_;
  using Reconstruction = Reconstruction_;
  static constexpr bool avoids_intersections = AvoidsIntersections;
  using Reference = Reference_surface<Reconstruction>;
  using Background = Metric_background<Metric>;

  Mesh_view mesh;
  Buffer<Vector_3> points;
  Buffer<Vector_3> normals;
  Buffer<Metric> metrics;
  Buffer<Location> locations;
  Buffer<Index> origin;         ///< vertex of the input that a vertex was, or `no_index`
  Buffer<std::uint8_t> active;  ///< a bit for each kernel that has to look at the vertex
  std::optional<Tolerance_guard<Reference>> tolerance; ///< if there is one
  internal::Self_intersection_guard* intersections = nullptr; ///< what keeps the mesh from them, if anything
  internal::Late_creases* creases = nullptr; ///< what is told where faces stay too far from the surface, if anything
  const Feature_parameters* constraints = nullptr; ///< what the user asks of the input, if features may meet in the result
  bool is_on_facets = false; ///< whether vertices on faces of the input that are smaller than the metric asks for are put
                             ///< on these, not on patches: cheap, and most moves are not the last ones
  std::size_t max_number_of_vertices = largest_number_of_vertices(std::size_t(-1)); ///< beyond which it is not refined

  /// `asked`, a tolerance, may be null; all must live as long as the surface.
  template <class Execution>
  Adapted_surface(const Execution& execution, const Reference& reference, const Background& background,
                  const Tolerance* asked = nullptr)
    : mesh(reference.mesh), reference_(&reference), background_(&background)
  {
    if (asked) tolerance.emplace(execution, reference, *asked);
    const std::size_t n = mesh.number_of_vertices();
    resize_vertices(n);
    for_each_index(execution, n, [&](std::size_t v) {
      const Location l = reference_->location_of_vertex(Index(v));
      const bool is_smooth = l.kind == Vertex_class::smooth;
      set(Index(v), place(l, {reference_->points[v], is_smooth ? reference_->normals.at(mesh.outgoing[v])
                                                              : Vector_3(Vector_3::Zero())}));
      origin[v] = Index(v);
      active[v] = 0xff;
    });
  }

  const Reference& reference() const { return *reference_; }
  const Background& background() const { return *background_; }

  Placed_vertex<Metric> place(const Location& l) const
  {
    if (is_on_facets && l.kind == Vertex_class::smooth) {
      const Placed_vertex<Metric> p = place(l, reference_->flat_surface_point(l));
      if (is_small_face(l.cell, p.metric)) return p;
    }
    return place(l, reference_->evaluate(l));
  }

  /// The same for the point `p` of the surface at `l`.
  Placed_vertex<Metric> place(const Location& l, const Surface_point& p) const
  {
    return {l, near_input(l, p.position), p.normal, metric(l, p)};
  }

  Placed_vertex<Metric> vertex(Index v) const { return {locations[v], points[v], normals[v], metrics[v]}; }

  void set(Index v, const Placed_vertex<Metric>& p)
  {
    locations[v] = p.location;
    points[v] = p.point;
    normals[v] = p.normal;
    metrics[v] = p.metric;
  }

  Vertex_class vertex_class(Index v) const { return locations[v].kind; }

  /// Metric length of the edge between `a` and `b`, the same to the bit from both sides.
  double length(Index a, Index b) const
  {
    return a < b ? edge_length(metrics[a], metrics[b], points[b] - points[a])
                 : edge_length(metrics[b], metrics[a], points[a] - points[b]);
  }

  double length(Index h) const { return length(mesh.source(h), mesh.target(h)); }

  /// `length(a, b) < l`, up to rounding.
  bool is_shorter(Index a, Index b, double l) const
  {
    return Surface_mesh_adaptation::is_shorter(metrics[a], metrics[b], points[b] - points[a], l);
  }

  double quality(Index a, Index b, Index c) const { return squared_shape(a, b, c).quality(); }

  /// `quality(a, b, c) >= q`, without a root.
  bool has_quality(Index a, Index b, Index c, double q) const
  {
    return squared_shape(a, b, c).is_at_least(q);
  }

  /// Unit normal of the face, zero if it is degenerate.
  Vector_3 normal(Index a, Index b, Index c) const
  {
    return unit_normal(points[b] - points[a], points[c] - points[a]);
  }

  Vector_3 normal(Index h) const { return normal(mesh.source(h), mesh.target(h), mesh.apex(h)); }

  /// The point of the surface where a vertex with the location `l` is put.
  Vector_3 point(const Location& l) const { return near_input(l, reference_->evaluate(l).position); }

  /// The point `p` of the surface at `l`, drawn towards the point of the input that it lies above where the patch bulges
  /// by much of what the mesh may be away from the input.
  Vector_3 near_input(const Location& l, const Vector_3& p) const
  {
    const double largest = share_of_bulge * largest_distance(l);
    if (largest == infinity) return p;
    const Vector_3 flat = reference_->flat_point(l), bulge = p - flat;
    const double length = bulge.norm();
    return length > largest ? flat + largest / length * bulge : p;
  }

  /// Places all vertices so that the surface bulges by no more than a share of `bounds`, one for each vertex of the input.
  /// \pre no vertex is removed
  template <class Execution>
  void bound_distance(const Execution& execution, std::vector<double> bounds)
  {
    bounds_ = std::move(bounds);
    for_each_index(execution, points.size(), [&](std::size_t v) { points[v] = point(locations[v]); });
  }

  Located_corner corner(Index v) const { return {locations[v], points[v]}; }

  /// The faces around `v`.
  Ring<Index> faces_around(Index v) const
  {
    Ring<Index> faces;
    mesh.for_each_outgoing(v, [&](Index h) { faces.push_back(Mesh_view::face(h)); });
    return faces;
  }

  /// Multiplies the metric by `factor`: the vertices it asks for, but for boundaries, too.
  template <class Execution>
  void scale_metric(const Execution& execution, double factor)
  {
    scale_ *= factor;
    if (!limits_.empty()) update_metrics(execution);
    else for_each_index(execution, metrics.size(), [&](std::size_t v) { metrics[v] = scaled(metrics[v], factor); });
  }

  /// Lets sizes near protected edges, which cannot change, follow their lengths, larger and smaller ones, and come back to
  /// those of the metric with the distance. Nothing for a `gradation` of at most 1.
  template <class Execution>
  void follow_protected_edges(const Execution& execution, double gradation)
  {
    if (!(gradation > 1)) return;
    const Sizes_at_protected_edges sizes(*this, gradation);
    if (sizes.upper.empty()) return;
    limits_ = {Graded_bounds(execution, sizes.upper), Graded_bounds(execution, sizes.negated_lower)};
    update_metrics(execution);
  }

  /// What follows from protected edges, and from tightening.
  const Size_limits& limits() const { return limits_; }

  /// Takes over those of another attempt. \pre no vertex is removed
  template <class Execution>
  void limit_sizes(const Execution& execution, Size_limits limits)
  {
    limits_ = std::move(limits);
    update_metrics(execution);
  }

  /// Multiplies the sizes at the vertices by those `factors` that are below 1, and around them as the gradation wants
  /// it. Returns a 1 for each vertex of which that changes the metric. \pre no vertex is removed
  template <class Execution>
  std::vector<std::uint8_t> tighten_metric(const Execution& execution, const std::vector<double>& factors,
                                           const Limits_of_tightening& allowed)
  {
    std::vector<Graded_bounds::Source> sources;
    for (const Index v : pack(execution, factors.size(), [&](std::size_t i) { return factors[i] < 1; })) {
      const Metric unlimited = background_->at(*reference_, locations[v], surface_point(v));
      sources.push_back(tightening(unlimited, limits_, points[v], factors[v], allowed));
    }
    const Graded_bounds tighter(execution, std::move(sources));
    sources = limits_.upper.sources();
    sources.insert(sources.end(), tighter.sources().begin(), tighter.sources().end());
    limits_.upper = Graded_bounds(execution, std::move(sources));
    return update_metrics(execution, [&](Index v) {
      const double now = limited_value(metrics[v]);
      return tighter.least(points[v], now) < now;
    });
  }

  /// Gives back the memory; nothing but the destructor may be called afterwards.
  template <class Execution>
  void release(const Execution& execution)
  {
    Surface_mesh_adaptation::release(execution, mesh.corner, mesh.twin, mesh.curve, mesh.outgoing, mesh.label, points,
                                     normals, metrics, locations, origin, active);
  }

  void resize_vertices(std::size_t n)
  {
    points.resize(n);
    normals.resize(n);
    metrics.resize(n);
    locations.resize(n);
    origin.resize(n);
    active.resize(n);
  }

  /// Whether the face `f` of the input is smaller than the metric `m` asks for.
  bool is_small_face(Index f, const Metric& m) const
  {
    const std::size_t h = 3 * std::size_t(f);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = reference_->mesh.corner[h + i], b = reference_->mesh.corner[h + (i + 1) % 3];
      if (!(m.length(reference_->points[b] - reference_->points[a]) < longest_edge_of_small_faces)) return false;
    }
    return true;
  }

private:
  /// How far the mesh may be away from the input at `l`, without jumps from face to face.
  double largest_distance(const Location& l) const
  {
    if (bounds_.empty()) return infinity;
    const auto at = reference_->interpolation(l);
    double inverse = 0;
    for (std::size_t i = 0; i < 3; ++i) inverse += at.weights[i] / bounds_[at.vertices[i]];
    return 1 / inverse;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double longest_edge_of_small_faces = 0.8; // in the metric
  static constexpr double share_of_bulge = 0.25; // of the distance: the rest is for the faces between the points

  Surface_point surface_point(Index v) const { return {points[v], normals[v]}; }

  template <class Execution>
  void update_metrics(const Execution& execution)
  {
    update_metrics(execution, [](Index) { return true; });
  }

  /// Those of the vertices for which `may_change(v)`. Returns a 1 for each of which the metric is another one now.
  /// \pre no vertex is removed
  template <class Execution, class May_change>
  std::vector<std::uint8_t> update_metrics(const Execution& execution, const May_change& may_change)
  {
    std::vector<std::uint8_t> is_changed(metrics.size());
    for_each_index(execution, metrics.size(), [&](std::size_t v) {
      if (!may_change(Index(v))) return;
      const Metric now = metric(locations[v], surface_point(Index(v)));
      is_changed[v] = now == metrics[v] ? 0 : 1;
      metrics[v] = now;
    });
    return is_changed;
  }

  internal::Squared_shape squared_shape(Index a, Index b, Index c) const
  {
    const Vector_3 e1 = points[b] - points[a], e2 = points[c] - points[a];
    return internal::squared_shape(metrics[a], metrics[b], metrics[c], e1, e2, e1.cross(e2));
  }

  Metric metric(const Location& l, const Surface_point& p) const
  {
    const Metric of_background = background_->at(*reference_, l, p);
    return limited(scale_ == 1 ? of_background : scaled(of_background, scale_), limits_, p.position);
  }

  const Reference* reference_;
  const Background* background_;
  double scale_ = 1; ///< of the metric
  Size_limits limits_;   ///< the same
  std::vector<double> bounds_; ///< of the distance from the input at each vertex of it; empty: none
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ADAPTED_SURFACE_H

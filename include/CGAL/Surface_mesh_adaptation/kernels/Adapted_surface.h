// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh under adaptation: connectivity, and for each vertex its location on the reference with what follows from
// it. The kernels read and write this and nothing else.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ADAPTED_SURFACE_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ADAPTED_SURFACE_H

#include <CGAL/Surface_mesh_adaptation/distance/Covered_points.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/fields/Metric_background.h>
#include <CGAL/Surface_mesh_adaptation/fields/expected_size.h>
#include <CGAL/Surface_mesh_adaptation/fields/tightened_metric.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/protected_sizes.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Everything that belongs to one vertex and follows from its location.
template <class Metric>
struct Placed_vertex
{
  Location location;
  Vector_3 point;
  Vector_3 normal;  ///< unit; zero on curves and at corners
  Metric metric;
};

/// Pieces of a face of which the distance from the input is bounded where it may stand for hundreds of others.
constexpr std::size_t max_pieces_of_face = 1024;

/// How far the adapted mesh may be from the input, and the faces of that.
struct Tolerance
{
  double distance;      ///< that is asked for
  double of_operations; ///< that each operation keeps: less, for operations add up
  Triangle_tree input;
};

template <class Metric_, class Reconstruction_>
class Adapted_surface
{
public:
  using Metric = Metric_;
  using Reconstruction = Reconstruction_;
  using Reference = Reference_surface<Reconstruction>;
  using Background = Metric_background<Metric>;

  Mesh_view mesh;
  Buffer<Vector_3> points;
  Buffer<Vector_3> normals;
  Buffer<Metric> metrics;
  Buffer<Location> locations;
  Buffer<Index> origin;         ///< vertex of the input that a vertex was, or `no_index`
  Buffer<std::uint8_t> active;  ///< a bit for each kernel that has to look at the vertex
  std::size_t max_number_of_vertices = largest_number_of_vertices(std::size_t(-1)); ///< beyond which it is not refined

  /// `tolerance` may be null, and must live as long as the surface.
  template <class Execution>
  Adapted_surface(const Execution& execution, const Reference& reference, const Background& background,
                  const Tolerance* tolerance = nullptr)
    : mesh(reference.mesh), reference_(&reference), background_(&background), tolerance_(tolerance)
  {
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
    if (has_tolerance()) covered_.emplace(execution, mesh, reference_->points);
  }

  const Reference& reference() const { return *reference_; }
  const Background& background() const { return *background_; }

  Placed_vertex<Metric> place(const Location& l) const { return place(l, reference_->evaluate(l)); }

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

  /// Smallest cosine between the normal of the face and the surface normals of its corners; 1 if none of them has one, or
  /// if the face is degenerate.
  /// Thin faces count as in `alignment_of_thin_face()`.
  double alignment(Index a, Index b, Index c) const
  {
    return alignment(normal(a, b, c), a, b, c);
  }

  double alignment(const Vector_3& unit_normal, Index a, Index b, Index c) const
  {
    double least = 1;
    for (Index v : {a, b, c})
      if (vertex_class(v) == Vertex_class::smooth) least = (std::min)(least, cosine_of_turn(unit_normal, normals[v]));
    return least < min_alignment && is_thin(a, b, c) ? alignment_of_thin_face(least) : least;
  }

  /// Whether the face is thin and may stand on the surface, which curves and isotropic metrics do not ask for. Where it
  /// is turned by less than 90 degrees from the normals at smooth corners, nothing is folded around these.
  bool is_thin(Index a, Index b, Index c) const { return is_thin(points[a], a, b, c); }

  /// Whether the face is so near to the surface at all corners that it cannot be part of a fold.
  bool is_flat(const Vector_3& unit_normal, Index a, Index b, Index c) const
  {
    for (Index v : {a, b, c})
      if (vertex_class(v) != Vertex_class::smooth || unit_normal.dot(normals[v]) < flat_alignment) return false;
    return true;
  }

  /// Unit normal of the face, zero if it is degenerate.
  Vector_3 normal(Index a, Index b, Index c) const
  {
    return unit_normal(points[b] - points[a], points[c] - points[a]);
  }

  Vector_3 normal(Index h) const { return normal(mesh.source(h), mesh.target(h), mesh.apex(h)); }

  /// Least cosine between two faces that meet at a smooth edge of a face around `v`, if `v` were at `p`; those of thin
  /// faces do not count. Faces that degenerate there, as those of an edge that is collapsed, give their place to the
  /// face behind them.
  /// Reads the faces behind those around `v`, so no vertex may move meanwhile.
  double sharpest_fold(Index v, const Vector_3& p) const
  {
    double least = 1;
    const auto meet = [&](const Vector_3& m, const Vector_3& n) {
      if (m != Vector_3::Zero() && n != Vector_3::Zero()) least = (std::min)(least, m.dot(n));
    };
    const auto is_crossed = [&](Index h) { return mesh.is_feature(h) || points[mesh.target(h)] == p; };
    Vector_3 first = Vector_3::Zero(), last = Vector_3::Zero();
    mesh.for_each_outgoing(v, [&](Index h) {
      const Index x = mesh.target(h), y = mesh.apex(h);
      const Vector_3 cross = (points[x] - p).cross(points[y] - p);
      const bool is_degenerate = !(cross.norm() > 0);
      Vector_3 n = is_degenerate || is_thin(p, v, x, y) ? Vector_3(Vector_3::Zero()) : Vector_3(cross.normalized());
      const Index ring_edge = Mesh_view::next(h);
      if (!mesh.is_feature(ring_edge)) {
        const Index t = mesh.twin[ring_edge], z = mesh.apex(t);
        const Vector_3 behind = is_thin(y, x, z) ? Vector_3(Vector_3::Zero()) : normal(t);
        meet(n, behind);
        if (is_degenerate) n = behind;
      }
      if (h == mesh.outgoing[v]) first = n;
      else if (!is_crossed(h)) meet(last, n);
      last = n;
    });
    if (!mesh.is_border_vertex(v) && !is_crossed(mesh.outgoing[v])) meet(last, first);
    return least;
  }

  /// Where an edge is split: the middle of its arc on a feature curve, else the point of the surface next to about the
  /// middle of the edge.
  Placed_vertex<Metric> middle(Index h) const
  {
    const Index a = (std::min)(mesh.source(h), mesh.target(h)), b = (std::max)(mesh.source(h), mesh.target(h));
    if (!mesh.is_feature(h)) return middle_in_sector(a == mesh.source(h) ? h : mesh.twin[h]);
    const auto arc = reference_->arc(mesh.curve[h], locations[a], locations[b]);
    return place(reference_->on_curve(mesh.curve[h], 0.5 * (arc.first + arc.second)));
  }

  /// The point of the surface where a vertex with the location `l` is put.
  Vector_3 point(const Location& l) const { return near_input(l, reference_->evaluate(l).position); }

  /// The point `p` of the surface at `l`, drawn towards the point of the input that it lies above where the patch bulges
  /// by much of the tolerance.
  Vector_3 near_input(const Location& l, const Vector_3& p) const
  {
    if (!has_tolerance()) return p;
    const Vector_3 flat = reference_->flat_point(l), bulge = p - flat;
    const double length = bulge.norm(), largest = share_of_bulge * tolerance_->of_operations;
    return length > largest ? flat + largest / length * bulge : p;
  }

  bool has_tolerance() const { return tolerance_ != nullptr; }

  /// What operations keep of the tolerance; infinite if there is none.
  double tolerance_of_operations() const
  {
    return has_tolerance() ? tolerance_->of_operations : std::numeric_limits<double>::infinity();
  }

  /// A corner of a face that may come to be.
  struct Corner
  {
    const Location& location;
    const Vector_3& point;
  };

  Corner corner(Index v) const { return {locations[v], points[v]}; }

  /// Whether a face with these corners stays within the tolerance of the input. `false` may be wrong, the less often the
  /// more pieces of the face are looked at. \pre `has_tolerance()`
  bool keeps_tolerance(const Corner& a, const Corner& b, const Corner& c, std::size_t max_pieces = 64) const
  {
    Ring<std::size_t> guesses;
    for (const Corner* corner : {&a, &b, &c}) {
      const Location& l = corner->location;
      const auto of_vertex = [&] { return reference_->mesh.outgoing[reference_->interpolation(l).vertices[0]]; };
      guesses.push_back(tolerance_->input.place(l.kind == Vertex_class::smooth ? l.cell : Mesh_view::face(of_vertex())));
    }
    return is_within(tolerance_->input, {a.point, b.point, c.point}, tolerance_->of_operations, guesses, max_pieces);
  }

  /// Whether the points of the input that `faces` cover stay within the tolerance of `triangles`, which are to replace
  /// these. Nothing is said of what lies between, which is why the distance is measured in the end. \pre `has_tolerance()`
  template <class Faces, class Triangles>
  bool are_covered(const Faces& faces, const Triangles& triangles) const
  {
    return covered_->are_near(faces, triangles, tolerance_->of_operations);
  }

  /// Hands what `faces` cover on to those of them that are left.
  template <class Faces>
  void hand_over(const Faces& faces)
  {
    covered_->hand_over(mesh, points, faces);
  }

  /// Hands what all faces cover on to their children, after `plan` was carried out.
  template <class Execution>
  void hand_to_children(const Execution& execution, const Restructuring& plan)
  {
    if (has_tolerance()) covered_->hand_to_children(execution, plan, mesh, points);
  }

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

  /// Multiplies the sizes at the vertices by those `factors` that are below 1, and around them as the gradation wants
  /// it. Returns a 1 for each vertex of which that changes the metric. \pre no vertex is removed
  template <class Execution>
  std::vector<std::uint8_t> tighten_metric(const Execution& execution, const std::vector<double>& factors)
  {
    std::vector<Graded_bounds::Source> sources = limits_.upper.sources();
    for (const Index v : pack(execution, factors.size(), [&](std::size_t i) { return factors[i] < 1; })) {
      const Metric unlimited = background_->at(*reference_, locations[v], surface_point(v));
      sources.push_back(tightening(unlimited, limits_, points[v], factors[v], background_->aims()));
    }
    limits_.upper = Graded_bounds(execution, std::move(sources));
    return update_metrics(execution);
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

private:
  Surface_point surface_point(Index v) const { return {points[v], normals[v]}; }

  /// Returns a 1 for each vertex of which the metric is another one now. \pre no vertex is removed
  template <class Execution>
  std::vector<std::uint8_t> update_metrics(const Execution& execution)
  {
    std::vector<std::uint8_t> is_changed(metrics.size());
    for_each_index(execution, metrics.size(), [&](std::size_t v) {
      const Metric now = metric(locations[v], surface_point(Index(v)));
      is_changed[v] = now == metrics[v] ? 0 : 1;
      metrics[v] = now;
    });
    return is_changed;
  }

  /// The point next to the middle of the edge of `h`, found by a walk from its ends or the vertices beside it, first from
  /// those that are on no feature; from others within the sector of the edge. Where a walk ends at a feature that lies in
  /// between, the next one is tried, and the best of all taken.
  Placed_vertex<Metric> middle_in_sector(Index h) const
  {
    const Index t = mesh.twin[h];
    const Vector_3 &a = points[mesh.source(h)], &b = points[mesh.target(h)];
    const Vector_3 target = a + split_position(mesh.source(h), mesh.target(h), h) * (b - a);
    const double length = (b - a).norm();
    typename Reference::Located_point best;
    double best_distance = std::numeric_limits<double>::infinity();
    const auto try_from = [&](const typename Reference::Located_point& start) {
      const auto x = reference_->locate(start, target, split_precision * length);
      const double distance = (x.point.position - target).norm();
      if (distance >= best_distance) return;
      best = x;
      best_distance = distance;
    };
    for (const bool on_features : {false, true})
      for (const Index g : {h, t, Mesh_view::previous(h), Mesh_view::previous(t)}) {
        const Index v = mesh.source(g);
        if ((vertex_class(v) != Vertex_class::smooth) != on_features || best_distance <= split_distance * length) continue;
        if (on_features) try_from(start_in_sector(*this, g));
        else try_from({locations[v], {points[v], normals[v]}});
      }
    return place(best.location, best.point);
  }

  /// In which ratio the edge of `h`, from `a` to `b`, is split: in halves, but for the diagonals of a lattice of
  /// right-angled faces. Halves would make a finer lattice, whose edges conform to the metric, and which is in balance
  /// for moves and swaps, though the quality of its faces is .866. An uneven start lets these find better ones.
  double split_position(Index a, Index b, Index h) const
  {
    const Index p = mesh.source(h), q = mesh.target(h), c = mesh.apex(h), d = mesh.apex(mesh.twin[h]);
    const Vector_3 skew = points[c] + points[d] - points[a] - points[b];
    if (skew.squaredNorm() > max_skew * max_skew * (points[b] - points[a]).squaredNorm() ||
        (has_quality(p, q, c, lattice_quality) && has_quality(q, p, d, lattice_quality)))
      return 0.5;
    const double random = double(hash_of_id(std::uint64_t(a) << 32 | b) >> 11) * 0x1p-53; // in [0, 1)
    return 0.5 + max_shift * (2 * random - 1);
  }

  /// The same if `a` were at `p`.
  bool is_thin(const Vector_3& p, Index a, Index b, Index c) const
  {
    if constexpr (is_anisotropic<Metric>) {
      for (const Index v : {a, b, c})
        if (vertex_class(v) != Vertex_class::smooth) return false;
      const Vector_3 e1 = points[b] - p, e2 = points[c] - p;
      return Surface_mesh_adaptation::is_thin(e1, e2, e1.cross(e2));
    }
    return false;
  }

  internal::Squared_shape squared_shape(Index a, Index b, Index c) const
  {
    const Vector_3 e1 = points[b] - points[a], e2 = points[c] - points[a];
    return internal::squared_shape(metrics[a], metrics[b], metrics[c], e1, e2, e1.cross(e2));
  }

  Placed_vertex<Metric> place(const Location& l, const Surface_point& p) const
  {
    return {l, near_input(l, p.position), p.normal, metric(l, p)};
  }

  Metric metric(const Location& l, const Surface_point& p) const
  {
    const Metric of_background = background_->at(*reference_, l, p);
    return limited(scale_ == 1 ? of_background : scaled(of_background, scale_), limits_, p.position);
  }

  static constexpr double max_skew = 0.1;         // of a parallelogram, in lengths of the diagonal
  static constexpr double lattice_quality = 0.87; // of a right-angled face: .866
  static constexpr double max_shift = 0.2;        // of a split, in lengths of the edge
  static constexpr double split_precision = 0.02; // of the edge: later moves undo the rest
  static constexpr double split_distance = 0.2;   // of the edge: more means that the walk did not get there

  static constexpr double share_of_bulge = 0.25;  // of the tolerance: the rest is for the faces between the points

  const Reference* reference_;
  const Background* background_;
  const Tolerance* tolerance_;
  std::optional<Covered_points> covered_; // if there is a tolerance
  double scale_ = 1; ///< of the metric
  Size_limits limits_;   ///< the same
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_ADAPTED_SURFACE_H

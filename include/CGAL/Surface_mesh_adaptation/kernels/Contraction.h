// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contraction: merges the ends of edges where quadrics say that it costs least, each pair at the point that is best by
// the quadrics (M. Garland, P. Heckbert, *Surface simplification using quadric error metrics*, 1997), and where the
// points that the faces stand for stay within limits. The cost is bounded, and the bound rises from sweep to sweep.
// Quadrics are sums over areas, so a place that errs much more than others may cost as little where it is small: the
// largest distance has a cost, too.
//
// What a collapse costs hardly ever falls while its surroundings are simplified. Hence a vertex is looked at again only
// when the bound reaches what its cheapest collapse cost the last time, or, if none was allowed then, when something
// changed around it.
//
// Conflict neighbourhood of s -> d: the closed one-rings of both, since d moves.
// Invariants: simplicial 2-manifold, components, genus, boundary cycles; corners stay; curve vertices vanish only along
// their curve; no face turns away from the surface; the limits.
// Work: O(vertices whose turn it is) a sweep; span: the work of a block and the passes of the border.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CONTRACTION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CONTRACTION_H

#include <CGAL/Surface_mesh_adaptation/distance/Represented_points.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Simplification.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/border_claims.h>
#include <CGAL/Surface_mesh_adaptation/kernels/collapse.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/folds.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Merged_star.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Quadric_3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

template <class Surface, class Execution>
class Contraction
{
public:
  Contraction(const Execution& execution, Surface& surface, const Simplification_thresholds& thresholds,
              Represented_points<Surface>& represented)
    : execution_(execution), surface_(surface), mesh_(surface.mesh), thresholds_(thresholds), represented_(represented)
    , origin_(mesh_.number_of_vertices() > 0 ? surface.points[0] : Vector_3::Zero())
  {
    fill(execution, least_cost_, mesh_.number_of_vertices(), 0.0);
    fill(execution, is_held_, mesh_.number_of_vertices(), std::uint8_t(0));
    quadrics_.resize(mesh_.number_of_vertices());
    for_each_index(execution, mesh_.number_of_vertices(), [&](std::size_t v) {
      quadrics_[v] = quadric_of_star(Index(v));
    }, heavy_chunk_length);
    area_ = reduce(execution, mesh_.number_of_vertices(), 0.0, [&](std::size_t v) { return quadrics_[v].area(); },
                   std::plus<double>());
    set_bound(0);
  }

  /// Collapses that cost more wait.
  void set_bound(double cost)
  {
    bound_ = cost;
    const std::size_t left = count_if(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
      return !mesh_.is_removed_vertex(Index(v));
    });
    mean_area_ = area_ / double((std::max)(left, std::size_t(1)));
  }

  /// The least cost of a collapse that waits for a higher bound, or infinity.
  double next_cost() const
  {
    return reduce(execution_, mesh_.number_of_vertices(), none, [&](std::size_t v) {
      return mesh_.is_removed_vertex(Index(v)) ? none : least_cost_[v];
    }, [](double a, double b) { return (std::min)(a, b); });
  }

  /// How many vertices the limit on the normals holds.
  std::size_t number_of_held() const
  {
    return count_if(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
      return !mesh_.is_removed_vertex(Index(v)) && is_held_[v] != 0;
    });
  }

  /// Examines every vertex whose turn it is once. Returns the number of vertices removed.
  std::size_t sweep(Sweep_counts& counts)
  {
    Sweep_counts local;
    const std::vector<Index> deferred = sweep_blocks(
      execution_, mesh_.number_of_vertices(), local,
      [&](Index v, const Block& block, Sweep_counts& c, std::vector<Index>& list) {
        if (mesh_.is_removed_vertex(v) || least_cost_[v] > bound_) return;
        if (!contains_ring(block, mesh_, v)) return list.push_back(v);
        ++c.candidates;
        bool is_put_off = false;
        const Collapse best = propose(v, [&](Index d) { return contains_ring(block, mesh_, d); }, is_put_off);
        if (is_put_off) list.push_back(v);
        if (best.h == no_index) return;
        apply(best);
        ++c.applied;
      });
    sweep_border(deferred, local);
    ++local.sweeps;
    counts += local;
    return local.applied;
  }

private:
  struct Collapse : Mesh_view::Directed_edge
  {
    Vector_3 point = Vector_3::Zero(); ///< of the vertex that is kept
    double cost = 0;
    Location location; ///< of that vertex on the reference, once the collapse is chosen
  };

  static constexpr double none = std::numeric_limits<double>::infinity();
  static constexpr double precision = 0.02;   // of a location, of the length of the edge
  static constexpr double typical_share = 0.25; // of the largest squared distance: their mean
  static constexpr double attraction = 1e-7;  // of the middle of an edge, of that of the planes

  /// The planes of the faces around `v` and, through feature edges, those across them.
  Quadric_3 quadric_of_star(Index v) const
  {
    Quadric_3 q;
    const auto add_curve = [&](Index h, const Vector_3& normal) {
      const Vector_3 edge = surface_.points[mesh_.target(h)] - surface_.points[mesh_.source(h)];
      const Vector_3 across = edge.cross(normal);
      if (across.norm() > 0) q.add_plane(local(v), across.normalized(), edge.squaredNorm());
    };
    mesh_.for_each_outgoing(v, [&](Index h) {
      const Vector_3 &p = surface_.points[v], &x = surface_.points[mesh_.target(h)], &y = surface_.points[mesh_.apex(h)];
      const Vector_3 n = surface_.normal(h);
      const double share = (x - p).cross(y - p).norm() / 6;
      q.add_plane(local(v), n, share);
      q.add_area(share);
      if (mesh_.is_feature(h) || mesh_.is_border(h)) add_curve(h, n);
      const Index arriving = Mesh_view::previous(h);
      if (mesh_.is_feature(arriving) || mesh_.is_border(arriving)) add_curve(arriving, n);
    });
    return q;
  }

  /// Coordinates of which the squares lose little precision.
  Vector_3 local(Index v) const { return surface_.points[v] - origin_; }

  /// The cheapest collapse that removes `s`, if its turn has come and it is allowed; else `h == no_index`, and
  /// `is_put_off` is set if the ring of the other end is not free for change.
  template <class IsFree>
  Collapse propose(Index s, const IsFree& is_free, bool& is_put_off)
  {
    is_held_[s] = 0;
    Ring<Collapse> collapses;
    if (surface_.vertex_class(s) != Vertex_class::corner) list_collapses(s, collapses);
    double later = none; // the bound at which one that errs too much now may come
    for (Collapse& c : collapses) {
      least_cost_[s] = (std::min)(later, c.cost);
      if (c.cost > bound_) return {};
      if (!mesh_.is_collapsible(c)) continue;
      is_put_off = !is_free(mesh_.kept_vertex(c));
      if (is_put_off) return {};
      const Merged_star star(mesh_, c);
      if (!is_valid(c, star)) continue;
      const Deviation deviation = represented_.deviation(star, c.point);
      if (deviation.excess == Excess::normal) is_held_[s] = 1;
      if (deviation.excess != Excess::none) continue;
      const double cost = cost_of_distance(deviation.squared_distance);
      if (cost > bound_) {
        later = (std::min)(later, cost);
        continue;
      }
      c.location = location_near(s, mesh_.kept_vertex(c), c.point);
      if (represented_.is_within_distance(surface_.point(c.location) - c.point) && keeps_tolerance(c, star)) return c;
    }
    least_cost_[s] = later;
    return {};
  }

  /// The edges along which `s` may vanish, the cheapest first.
  void list_collapses(Index s, Ring<Collapse>& collapses) const
  {
    for_each_collapse(surface_, s, thresholds_.min_length, [&](const Mesh_view::Directed_edge& e) {
      collapses.push_back(collapse(e));
    });
    std::sort(collapses.begin(), collapses.end(), [&](const Collapse& a, const Collapse& b) {
      return a.cost < b.cost || (a.cost == b.cost && mesh_.kept_vertex(a) < mesh_.kept_vertex(b));
    });
  }

  Collapse collapse(const Mesh_view::Directed_edge& e) const
  {
    const Index s = mesh_.vanishing_vertex(e), d = mesh_.kept_vertex(e);
    Quadric_3 q = quadrics_[s];
    q += quadrics_[d];
    const bool is_fixed = surface_.vertex_class(d) == Vertex_class::corner;
    const bool are_alike = surface_.vertex_class(s) == surface_.vertex_class(d);
    const Vector_3 guess = are_alike ? (local(s) + local(d)) / 2 : local(d);
    const Vector_3 point = is_fixed ? local(d) : q.minimum(guess, attraction);
    return {e, is_fixed ? surface_.points[d] : point + origin_, cost(q(point), q.area()), {}};
  }

  /// Between the mean distance from the planes, by which the largest one is small, and the sum over the area, by which
  /// the mean is: `area^(3/4)` times the mean square.
  static double cost(double error, double area) { return area > 0 ? std::sqrt(error / std::sqrt(std::sqrt(area))) : 0; }

  /// Of a place with the mean area that errs up to that far.
  double cost_of_distance(double squared_distance) const
  {
    return cost(typical_share * squared_distance * mean_area_, mean_area_);
  }

  bool is_valid(const Collapse& c, const Merged_star& star) const
  {
    const Index s = mesh_.vanishing_vertex(c), d = mesh_.kept_vertex(c);
    if (surface_.vertex_class(s) == Vertex_class::curve && !is_curve_preserved(surface_, s, d)) return false;
    double quality_limit = thresholds_.min_quality, alignment_limit = min_alignment;
    double length_limit = thresholds_.max_length;
    for (const Merged_star::Face& f : star.faces()) {
      const Index v = mesh_.source(f.halfedge), x = mesh_.target(f.halfedge), y = mesh_.apex(f.halfedge);
      quality_limit = (std::min)(quality_limit, surface_.quality(v, x, y));
      alignment_limit = (std::min)(alignment_limit, alignment_of_face(surface_, v, x, y));
      length_limit = (std::max)({length_limit, surface_.length(v, x), surface_.length(v, y)});
    }
    for (const Merged_star::Face& f : star.faces()) {
      if (f.vanishes) continue;
      const Index x = mesh_.target(f.halfedge), y = mesh_.apex(f.halfedge);
      const Vector_3 to_x = surface_.points[x] - c.point, to_y = surface_.points[y] - c.point;
      const Vector_3 cross = to_x.cross(to_y);
      const double double_area = cross.norm();
      if (!(double_area > 0)) return false;
      const Vector_3 n = cross / double_area;
      const double quality = face_quality(surface_.metrics[d], surface_.metrics[x], surface_.metrics[y], to_x, to_y);
      if (!(quality > quality_limit && quality > 0) ||
          edge_length(surface_.metrics[d], surface_.metrics[x], to_x) > length_limit ||
          edge_length(surface_.metrics[d], surface_.metrics[y], to_y) > length_limit ||
          alignment_of_face(surface_, n, d, x, y) < alignment_limit ||
          cosine_of_turn(n, surface_.normal(f.halfedge)) < min_turn_of_collapse ||
          is_folded(n, Mesh_view::next(f.halfedge)))
        return false;
    }
    return true;
  }

  bool keeps_tolerance(const Collapse& c, const Merged_star& star) const
  {
    if (!surface_.tolerance) return true;
    return std::all_of(star.faces().begin(), star.faces().end(), [&](const Merged_star::Face& f) {
      return f.vanishes ||
             surface_.tolerance->is_kept({c.location, c.point}, surface_.corner(mesh_.target(f.halfedge)),
                                         surface_.corner(mesh_.apex(f.halfedge)), max_pieces_of_face);
    });
  }

  /// Whether a face with the normal `n` makes a sharp fold, that was not there, with the face behind the edge of `h`.
  bool is_folded(const Vector_3& n, Index h) const
  {
    return fold_across(surface_, h, n) < (std::min)(min_fold, fold_across(surface_, h, surface_.normal(h)));
  }

  void apply(const Collapse& c)
  {
    const Index s = mesh_.vanishing_vertex(c), d = mesh_.kept_vertex(c);
    represented_.hand_over(Merged_star(mesh_, c), c.point);
    quadrics_[d] += quadrics_[s];
    mesh_.collapse(c);
    surface_.set(d, surface_.place(c.location));
    surface_.points[d] = c.point;
    mesh_.for_each_neighbor(d, [&](Index x) {
      if (least_cost_[x] == none) least_cost_[x] = bound_;
    });
    least_cost_[d] = (std::min)(least_cost_[d], bound_);
  }

  /// Where on the reference the vertex that `s` and `d` become is, if its place is `p`.
  Location location_near(Index s, Index d, const Vector_3& p) const
  {
    const Location &of_s = surface_.locations[s], &of_d = surface_.locations[d];
    const Vector_3 way = surface_.points[d] - surface_.points[s];
    if (of_s.kind != of_d.kind) return of_d;
    const auto& reference = surface_.reference();
    if (of_s.kind == Vertex_class::smooth)
      return reference.locate({of_d, {surface_.points[d], surface_.normals[d]}}, p, precision * way.norm()).location;
    const auto arc = reference.arc(of_d.cell, of_s, of_d);
    const double squared_length = way.squaredNorm();
    const double t = squared_length > 0 ? std::clamp((p - surface_.points[s]).dot(way) / squared_length, 0.0, 1.0) : 1;
    return reference.on_curve(of_d.cell, (1 - t) * arc.first + t * arc.second);
  }

  void sweep_border(const std::vector<Index>& vertices, Sweep_counts& counts)
  {
    sweep_border_by_claims<Collapse>(
      execution_, mesh_, vertices, reservations_, counts,
      [&](Index v) {
        bool is_put_off = false;
        return propose(v, [](Index) { return true; }, is_put_off);
      },
      [&](const Collapse& c) { return bound_ > 0 ? c.cost / bound_ : 0; },
      [&](const Collapse& c, const auto& claim) {
        mesh_.for_each_neighbor(mesh_.vanishing_vertex(c), claim);
        mesh_.for_each_neighbor(mesh_.kept_vertex(c), claim);
      },
      [&](const Collapse& c) { apply(c); });
  }

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Simplification_thresholds thresholds_;
  Represented_points<Surface>& represented_;
  Vector_3 origin_;
  Buffer<Quadric_3> quadrics_;
  Buffer<std::uint8_t> is_held_; // by the limit on the normals
  Buffer<double> least_cost_; // of the collapses of each vertex, when it was last looked at
  double bound_ = 0;
  double area_ = 0, mean_area_ = 0; // of all, and for each vertex
  Reservations reservations_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_CONTRACTION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refinement: splits the edges that are too long in the metric (paper, figure 2 and section 5).
//
// A sweep marks edges, evaluates their midpoints on the surface, and cuts every face by the pattern of its marks, all
// at once and without a conflict graph: a new vertex is written by the face that owns its edge, a new face by its
// parent. A face of which a child would be inverted, or no smaller than itself, takes marks back, its longest edge last;
// the midpoints of the others stay as they are. Beside edges that must stay long, a face takes all back that would make a
// needle.
// The sweep also closes the holes that simplification left.
//
// Invariants: simplicial 2-manifold, features, boundary cycles. Work: O(n) a sweep; span: O(log n).

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_REFINEMENT_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_REFINEMENT_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/expected_size.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/curve_spacing.h>
#include <CGAL/Surface_mesh_adaptation/kernels/edge_middle.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Splitting.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/mesh/fill_holes.h>
#include <CGAL/Surface_mesh_adaptation/mesh/restructure.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Refinement_thresholds
{
  double max_length = max_unit_length;  ///< edges of this length or more are split
  bool weigh_neighbors = false;         ///< decide by all edges that change: in an anisotropic metric by their mean
                                        ///< misfit, on curves by the mean length of neighbouring ones
};

template <class Surface, class Execution>
class Refinement
{
public:
  using Metric = typename Surface::Metric;

  Refinement(const Execution& execution, Surface& surface, const Refinement_thresholds& thresholds = {})
    : execution_(execution), surface_(surface), mesh_(surface.mesh), thresholds_(thresholds)
  {}

  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;

  ~Refinement()
  {
    release(execution_, points_, normals_, metrics_, locations_, origin_, active_, middles_, spare_.corner, spare_.twin,
            spare_.curve, spare_.outgoing, spare_.label);
  }

  /// Where a small part of the mesh is worked on: what cannot be split is looked at again once something has changed
  /// there, and a few edges are split where they are. Else all is looked at and rewritten in each sweep.
  void work_locally(bool is_local) { is_local_ = is_local; }

  /// Splits every edge that is too long, once, if there are more than `negligible`, but on needles only once those of
  /// curves are short enough: swaps remove fans then. Returns the number of edges split.
  std::size_t sweep(std::size_t negligible, Sweep_counts& counts)
  {
    counts.candidates += mesh_.number_of_halfedges() / 2;
    mark();
    is_waiting_ = is_curve_marked() && unmark_needles();
    std::size_t marked = settle_marks(negligible);
    if (is_waiting_ && marked == 0) { // the curves cannot be split
      is_waiting_ = false;
      mark();
      marked = settle_marks(negligible);
    }
    if (marked == 0) return 0;
    if (may_split_in_place(marked)) split_in_place();
    else rewrite();
    if (is_at_limit_) return 0;
    ++counts.sweeps;
    counts.applied += marked;
    return marked;
  }

  /// Whether the last sweep left all as it was, since the mesh would have had far more vertices than the metric asks for, or
  /// than are possible.
  bool is_at_limit() const { return is_at_limit_; }

  /// Whether the last sweep left edges of needles for the next one.
  bool is_waiting() const { return is_waiting_; }

  /// Closes the holes of removed elements, if there are any.
  void compact()
  {
    const auto vertices = pack(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
      return mesh_.is_removed_vertex(Index(v));
    });
    if (vertices.empty()) return;
    if (double(vertices.size()) > max_share_of_holes * double(mesh_.number_of_vertices())) {
      fill(execution_, codes_, mesh_.number_of_faces(), std::uint8_t(0));
      const Restructuring plan(execution_, mesh_, codes_);
      place_vertices(plan, all_kernels);
      return commit(plan);
    }
    const auto faces = pack(execution_, mesh_.number_of_faces(), [&](std::size_t f) {
      return mesh_.is_removed_face(Index(f));
    });
    fill_holes(mesh_, vertices, faces, [&](Index from, Index to) {
      surface_.set(to, surface_.vertex(from));
      surface_.origin[to] = surface_.origin[from];
      surface_.active[to] = surface_.active[from];
    });
    surface_.resize_vertices(mesh_.number_of_vertices());
  }

private:
  static constexpr double min_turn = 0.5;  // cosine between a face and its children
  static constexpr double in_plane = 0.98; // the same, of children that are as upright as the face
  static constexpr double max_length_to_keep = 3; // of an edge that fits better than its parts: not worth a look beyond
  static constexpr double quality_of_needle = 0.1;
  static constexpr std::uint8_t for_shape = 8; // added to marks that are taken back so that no face gets too thin
  static constexpr double max_half = 0.8;  // of an edge: the middle of a bulging arc lies well within
  static constexpr double max_share_of_holes = 0.01; // that are filled in series
  static constexpr double max_share_in_place = 0.02; // of new vertices: what is new gets far from its neighbours
  static constexpr double room_for_splits = 1.25;    // in place, in vertices
  static constexpr double expected_excess = 1.2;   // vertices beyond those of a mesh of equilateral unit triangles
  static constexpr std::size_t max_growth = 100;   // that is prepared for: metrics may ask for anything

  /// Vertices to make room for.
  std::size_t expected_number_of_vertices() const
  {
    const double limit = double(max_growth * mesh_.number_of_vertices());
    return std::size_t((std::min)(limit, expected_excess * limit_->vertices_of_area()));
  }

  /// Whether there is so little to split that the rest better stays where it is, and room for it. What faces cover
  /// within a tolerance goes by the numbers of a rewrite.
  bool may_split_in_place(std::size_t marked) const
  {
    return is_local_ && !surface_.tolerance && double(marked) <= max_share_in_place * double(mesh_.number_of_vertices()) &&
           mesh_.number_of_vertices() + marked <= surface_.points.capacity();
  }

  /// Kernels that look again where nothing was split.
  std::uint8_t kept_activity() const
  {
    return std::uint8_t(all_kernels & ~(is_waiting_ ? 0u : unsigned(Activity::refine)));
  }

  void split_in_place()
  {
    const Splitting plan(execution_, mesh_, codes_, marked_faces_);
    if ((is_at_limit_ = is_beyond_limit(plan))) return;
    choose_diagonals();
    const std::uint8_t kept = kept_activity();
    for_each_index(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
      surface_.active[v] = std::uint8_t(surface_.active[v] & kept);
    });
    surface_.resize_vertices(plan.number_of_vertices());
    for_each_marked_face([&](Index f) {
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (codes_[f] != 0) activate(surface_, mesh_.corner[h]);
        if (!is_marked(h) || !mesh_.is_edge_owner(h)) continue;
        const Index m = plan.midpoint(h);
        surface_.set(m, middle(h));
        surface_.origin[m] = no_index;
        surface_.active[m] = all_kernels;
      }
    });
    plan.apply(execution_, mesh_);
  }

  void rewrite()
  {
    const Restructuring plan(execution_, mesh_, codes_);
    if ((is_at_limit_ = is_beyond_limit(plan))) return;
    if (expected_vertices_ == 0) expected_vertices_ = expected_number_of_vertices();
    if (is_local_)
      expected_vertices_ = (std::max)(expected_vertices_, std::size_t(room_for_splits * plan.number_of_vertices()));
    choose_diagonals();
    place_vertices(plan, kept_activity());
    commit(plan);
  }

  template <class Plan>
  bool is_beyond_limit(const Plan& plan)
  {
    if (!limit_) limit_.emplace(execution_, surface_);
    return plan.number_of_faces() > max_number_of_faces ||
           limit_->is_exceeded(execution_, surface_, plan.number_of_vertices());
  }

  template <class F>
  void for_each_face(const F& f) const
  {
    for_each_index(execution_, mesh_.number_of_faces(), [&](std::size_t i) {
      if (!mesh_.is_removed_face(Index(i))) f(Index(i));
    });
  }

  /// Of those that had marked edges at first: no other ever has.
  template <class F>
  void for_each_marked_face(const F& f, std::size_t chunk_length = default_chunk_length) const
  {
    for_each_index(execution_, marked_faces_.size(), [&](std::size_t i) { f(marked_faces_[i]); }, chunk_length);
  }

  void mark()
  {
    mark_long_edges();
    marked_faces_ = pack(execution_, mesh_.number_of_faces(), [&](std::size_t f) { return codes_[f] != 0; });
    if (is_anisotropic<Metric> && thresholds_.weigh_neighbors) unmark_fitting_edges();
  }

  void mark_long_edges()
  {
    fill(execution_, codes_, mesh_.number_of_faces(), std::uint8_t(0));
    fill(execution_, blocked_, mesh_.number_of_faces(), std::uint8_t(0));
    resize_and_forget(taken_back_, codes_.size());
    for_each_face([&](Index f) {
      for (Index i = 0; i < 3; ++i)
        if (is_candidate(3 * f + i) && is_too_long(3 * f + i)) codes_[f] = std::uint8_t(codes_[f] | 1u << i);
    });
  }

  bool is_candidate(Index h) const
  {
    const auto is_changed = [&](Index v) { return is_active(surface_, v, Activity::refine); };
    return !mesh_.is_protected(h) && (!is_local_ || is_changed(mesh_.source(h)) || is_changed(mesh_.target(h)));
  }

  bool is_too_long(Index h) const
  {
    if (thresholds_.weigh_neighbors && mesh_.is_feature(h)) return is_split_on_curve(surface_, h);
    return !surface_.is_shorter(mesh_.source(h), mesh_.target(h), thresholds_.max_length);
  }

  /// Takes back the marks of edges that are too long but fit the metric better than what would replace them.
  void unmark_fitting_edges()
  {
    for_each_marked_face([&](Index f) {
      taken_back_[f] = 0;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (is_marked(h) && mesh_.is_edge_owner(h) && is_better_than_its_parts(h))
          taken_back_[f] = std::uint8_t(taken_back_[f] | 1u << h % 3);
    }, heavy_chunk_length);
    take_back_marks();
  }

  bool is_curve_marked() const
  {
    return count_marked_faces([&](Index f) {
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (is_marked(h) && mesh_.is_feature(h)) return true;
      return false;
    }) > 0;
  }

  /// Takes back the marks of edges of needles but those on curves, if most faces to be split are needles; whether so.
  bool unmark_needles()
  {
    for_each_marked_face([&](Index f) {
      taken_back_[f] = 0;
      if (codes_[f] == 0 || !is_needle(f)) return;
      for (Index i = 0; i < 3; ++i)
        if (!mesh_.is_feature(3 * f + i)) taken_back_[f] = std::uint8_t(taken_back_[f] | (codes_[f] & 1u << i));
    });
    const std::size_t needles = count_marked_faces([&](Index f) { return taken_back_[f] != 0; });
    const bool is_fan = 2 * needles > count_marked_faces([&](Index f) { return codes_[f] != 0; });
    if (is_fan) take_back_marks();
    return is_fan;
  }

  bool is_needle(Index f) const
  {
    return !surface_.has_quality(mesh_.corner[3 * f], mesh_.corner[3 * f + 1], mesh_.corner[3 * f + 2],
                                 quality_of_needle);
  }

  template <class Predicate>
  std::size_t count_marked_faces(const Predicate& predicate) const
  {
    return count_if(execution_, marked_faces_.size(), [&](std::size_t i) { return predicate(marked_faces_[i]); });
  }

  /// Unmarks the edges that one of their faces has taken back, and notes those that are `for_shape`.
  void take_back_marks()
  {
    for_each_marked_face([&](Index f) {
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (!is_marked(h)) continue;
        const std::uint8_t taken = taken_back(h) | (mesh_.is_border(h) ? 0 : taken_back(mesh_.twin[h]));
        if (taken != 0) codes_[f] = std::uint8_t(codes_[f] & ~(1u << h % 3));
        if ((taken & for_shape) != 0) blocked_[f] = std::uint8_t(blocked_[f] | 1u << h % 3);
      }
    });
  }

  /// Bits that are not 0 if the face of `h` has taken its mark back.
  std::uint8_t taken_back(Index h) const
  {
    return std::uint8_t(taken_back_[Mesh_view::face(h)] >> h % 3 & (1 | for_shape));
  }

  /// Whether the four edges that splitting that of `h` makes fit the metric less than it does.
  bool is_better_than_its_parts(Index h) const
  {
    const double length = surface_.length(h);
    if (mesh_.is_feature(h) || length > max_length_to_keep) return false;
    Mean_misfit before, after;
    before.add(length);
    const Placed_vertex<Metric> m = edge_middle(surface_, h);
    for (const Index v : {mesh_.source(h), mesh_.target(h), mesh_.apex(h), mesh_.apex(mesh_.twin[h])})
      after.add(edge_length(surface_.metrics[v], m.metric, m.point - surface_.points[v]));
    return !after.is_at_most(1, before);
  }

  std::size_t count_marked() const
  {
    return reduce(execution_, marked_faces_.size(), std::size_t(0), [&](std::size_t i) {
      std::size_t n = 0;
      for (Index h = 3 * marked_faces_[i]; h < 3 * marked_faces_[i] + 3; ++h)
        if (is_marked(h) && mesh_.is_edge_owner(h)) ++n;
      return n;
    }, [](std::size_t a, std::size_t b) { return a + b; });
  }

  /// Places the middles of the marked edges, and takes marks back until no face would be cut badly. Returns the number of
  /// those left, or 0 where that is negligible.
  std::size_t settle_marks(std::size_t negligible)
  {
    const std::size_t least = is_waiting_ ? 0 : negligible;
    if (count_marked() <= least) return 0;
    place_middles();
    while (!is_stopped(execution_) && take_back_marks_of_bad_faces()) {}
    const std::size_t marked = is_stopped(execution_) ? 0 : count_marked(); // some middles were left out
    return marked > least ? marked : 0;
  }

  /// Those of the marked edges, with room for all edges of their faces: where they are does not change when marks are
  /// taken back.
  void place_middles()
  {
    const Index n = exclusive_scan(execution_, marked_faces_.size(), offsets_, [&](std::size_t i) {
      return owned_edges(3 * marked_faces_[i], 3 * marked_faces_[i] + 3);
    });
    resize_and_forget(middles_, n);
    resize_and_forget(first_middle_, mesh_.number_of_faces());
    for_each_index(execution_, offsets_.size(), [&](std::size_t i) { first_middle_[marked_faces_[i]] = offsets_[i]; });
    for_each_marked_face([&](Index f) {
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (is_marked(h) && mesh_.is_edge_owner(h) && !is_stopped(execution_))
          middles_[place_of_middle(h)] = edge_middle(surface_, h);
    }, heavy_chunk_length);
  }

  bool is_marked(Index h) const { return (codes_[Mesh_view::face(h)] >> h % 3 & 1) != 0; }

  Index place_of_middle(Index owner) const
  {
    const Index f = Mesh_view::face(owner);
    return first_middle_[f] + owned_edges(3 * f, owner);
  }

  /// The number of halfedges in `[begin, end)` that own their edge.
  Index owned_edges(Index begin, Index end) const
  {
    Index n = 0;
    for (Index h = begin; h < end; ++h) n += mesh_.is_edge_owner(h) ? 1 : 0;
    return n;
  }

  const Placed_vertex<Metric>& middle(Index h) const { return middles_[place_of_middle(mesh_.edge_owner(h))]; }

  /// Corner `label` of face `f`, or, from 3 on, the middle of a marked edge of it.
  Placed_vertex<Metric> vertex_of_label(Index f, std::uint8_t label) const
  {
    return label < 3 ? surface_.vertex(mesh_.corner[3 * f + label]) : middle(3 * f + label - 3);
  }

  using Child = std::array<Placed_vertex<Metric>, 3>;

  Child child(Index f, const std::array<std::uint8_t, 3>& labels) const
  {
    return {vertex_of_label(f, labels[0]), vertex_of_label(f, labels[1]), vertex_of_label(f, labels[2])};
  }

  /// Fills the new vertex arrays with the vertices that stay and the middles of marked edges. Only kernels of `kept` look
  /// again where nothing is split.
  void place_vertices(const Restructuring& plan, std::uint8_t kept)
  {
    const std::size_t n = plan.number_of_vertices();
    resize_and_forget(points_, n, expected_vertices_);
    resize_and_forget(normals_, n, expected_vertices_);
    resize_and_forget(metrics_, n, expected_vertices_);
    resize_and_forget(locations_, n, expected_vertices_);
    resize_and_forget(origin_, n, expected_vertices_);
    resize_and_forget(active_, n, expected_vertices_);
    for_each_face([&](Index f) {
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index v = mesh_.corner[h];
        if (mesh_.outgoing[v] == h)
          write(plan.vertex(v), surface_.vertex(v), surface_.origin[v],
                is_at_split(v) ? all_kernels : std::uint8_t(surface_.active[v] & kept));
        if (plan.is_split(h) && mesh_.is_edge_owner(h)) write(plan.midpoint(h), middle(h), no_index, all_kernels);
      }
    });
  }

  bool is_at_split(Index v) const
  {
    bool found = false;
    mesh_.for_each_outgoing_while(v, [&](Index h) {
      found = codes_[Mesh_view::face(h)] != 0;
      return !found;
    });
    return found;
  }

  void write(Index v, const Placed_vertex<Metric>& p, Index origin, std::uint8_t active)
  {
    locations_[v] = p.location;
    points_[v] = p.point;
    normals_[v] = p.normal;
    metrics_[v] = p.metric;
    origin_[v] = origin;
    active_[v] = active;
  }

  /// Whether the midpoints of the face lie between the ends of their edges: else splitting would go on for ever.
  bool are_halves_shorter(Index f) const
  {
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (!is_marked(h)) continue;
      const Vector_3 &a = surface_.points[mesh_.source(h)], &b = surface_.points[mesh_.target(h)];
      const Vector_3& m = middle(h).point;
      if ((std::max)((m - a).norm(), (m - b).norm()) > max_half * (b - a).norm()) return false;
    }
    return true;
  }

  /// Unmarks edges of faces with a child that turns away from its parent; whether there was one. The longest edge keeps
  /// its mark unless it had the only one: it can be split where the others can not, as on needles, and would else keep
  /// the edges around it long.
  bool take_back_marks_of_bad_faces()
  {
    for_each_marked_face([&](Index f) {
      const std::uint8_t code = codes_[f];
      if (code != 0 && makes_needle_at_blocked_edge(f, code)) taken_back_[f] = std::uint8_t(code * (1 + for_shape));
      else if (code == 0 || (are_halves_shorter(f) && are_children_upright(f, code))) taken_back_[f] = 0;
      else taken_back_[f] = has_several_marks(code) ? all_but_longest(f) : code;
    });
    const bool is_any = count_marked_faces([&](Index f) { return taken_back_[f] != 0; }) > 0;
    if (is_any) take_back_marks();
    return is_any;
  }

  /// Whether a child would be a needle along an edge that is too long and stays so: the other edges of the faces beside it
  /// are too long, too, however thin splits make these.
  bool makes_needle_at_blocked_edge(Index f, std::uint8_t code) const
  {
    for (Index i = 0; i < 3; ++i)
      if (is_blocked(3 * f + i) && quality(child_at_edge(f, code, i)) < quality_of_needle) return true;
    return false;
  }

  /// Whether the edge of `h` is too long and protected, or would make a needle along one that is blocked.
  bool is_blocked(Index h) const
  {
    if (mesh_.is_protected(h)) return !surface_.is_shorter(mesh_.source(h), mesh_.target(h), thresholds_.max_length);
    return (blocked_[Mesh_view::face(h)] >> h % 3 & 1) != 0;
  }

  /// That which has the edge between the corners `i` and `i + 1` of its parent, of which the edge is not split.
  Child child_at_edge(Index f, std::uint8_t code, Index i) const
  {
    const auto& pattern = internal::Split_pattern::of(code);
    std::size_t c = 0;
    const auto has = [&](Index label) {
      return std::find(pattern.child[c].begin(), pattern.child[c].end(), label) != pattern.child[c].end();
    };
    while (!(has(i) && has((i + 1) % 3))) ++c;
    return child(f, pattern.child[c]);
  }

  static double quality(const Child& v)
  {
    return face_quality(v[0].metric, v[1].metric, v[2].metric, v[1].point - v[0].point, v[2].point - v[0].point);
  }

  static bool has_several_marks(std::uint8_t code) { return (code & (code - 1)) != 0; }

  /// The marks of the face but that of its longest marked edge.
  std::uint8_t all_but_longest(Index f) const
  {
    const std::uint8_t code = codes_[f];
    const auto length_of_marked = [&](Index i) { return (code >> i & 1) != 0 ? surface_.length(3 * f + i) : -1; };
    Index longest = 0;
    for (Index i = 1; i < 3; ++i)
      if (length_of_marked(i) > length_of_marked(longest)) longest = i;
    return std::uint8_t(code & ~(1u << longest));
  }

  /// Of the two ways to cut the quadrilateral that two marks leave, takes the one with the better worst face.
  void choose_diagonals()
  {
    for_each_marked_face([&](Index f) {
      const std::uint8_t marks = codes_[f];
      if (marks != 3 && marks != 5 && marks != 6) return;
      const std::uint8_t other = std::uint8_t(marks | 8);
      if (worst_child(f, other) > worst_child(f, marks) && are_children_upright(f, other)) codes_[f] = other;
    });
  }

  /// Whether the children turn neither far from their parent, unless they are thin, nor from the surface normals at
  /// their corners, see `least_alignment_after()`.
  bool are_children_upright(Index f, std::uint8_t code) const
  {
    const auto& pattern = internal::Split_pattern::of(code);
    const Index a = mesh_.corner[3 * f], b = mesh_.corner[3 * f + 1], c = mesh_.corner[3 * f + 2];
    const Vector_3 parent = surface_.normal(a, b, c);
    const double limit = least_alignment_after(alignment_of_face(surface_, parent, a, b, c));
    Ring<Triangle_points> children;
    for (std::size_t i = 0; i < std::size_t(pattern.number_of_children); ++i) {
      const Child v = child(f, pattern.child[i]);
      if (!is_child_upright(v, parent, limit)) return false;
      if (!surface_.tolerance) continue;
      if (!child_keeps_tolerance(v)) return false;
      children.push_back({v[0].point, v[1].point, v[2].point});
    }
    return !surface_.tolerance || surface_.tolerance->are_covered(std::array{f}, children);
  }

  bool is_child_upright(const Child& v, const Vector_3& parent, double limit) const
  {
    const Vector_3 e1 = v[1].point - v[0].point, e2 = v[2].point - v[0].point, normal = e1.cross(e2);
    const double length = normal.norm();
    const bool is_parent_degenerate = parent == Vector_3::Zero();
    if (is_parent_degenerate && unit_normal(e1, e2) == Vector_3::Zero()) return true;
    if (normal.dot(parent) > in_plane * length) return true; // at sharp edges that are no features normals say little
    const Corner_products products(normal, length, {&v[0].normal, &v[1].normal, &v[2].normal});
    const bool is_turned = !is_parent_degenerate && normal.dot(parent) <= min_turn * length;
    if (!is_turned && products.least >= limit * length) return true;
    return is_anisotropic<Metric> && products.is_smooth && length > 0 && is_thin(e1, e2, normal) &&
           alignment_of_thin_face(products.least / length) >= limit;
  }

  bool child_keeps_tolerance(const Child& v) const
  {
    const auto corner = [&](std::size_t i) { return Located_corner{v[i].location, v[i].point}; };
    return surface_.tolerance->is_kept(corner(0), corner(1), corner(2));
  }

  double worst_child(Index f, std::uint8_t code) const
  {
    double worst = 1;
    for (std::size_t c = 0; c < 3; ++c) worst = (std::min)(worst, quality(child(f, internal::Split_pattern::of(code).child[c])));
    return worst;
  }

  void commit(const Restructuring& plan)
  {
    plan.build(execution_, spare_, expected_vertices_);
    std::swap(mesh_, spare_);
    surface_.points.swap(points_);
    surface_.normals.swap(normals_);
    surface_.metrics.swap(metrics_);
    surface_.locations.swap(locations_);
    surface_.origin.swap(origin_);
    surface_.active.swap(active_);
    if (surface_.tolerance) surface_.tolerance->hand_to_children(execution_, plan, surface_);
  }

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Refinement_thresholds thresholds_;
  std::size_t expected_vertices_ = 0; // for all sweeps
  std::optional<Limit_of_refinement> limit_; // the same
  bool is_at_limit_ = false, is_waiting_ = false, is_local_ = false;
  Buffer<std::uint8_t> codes_, taken_back_, blocked_;
  std::vector<Index> marked_faces_; // of the last sweep, before marks were taken back
  Buffer<Index> offsets_, first_middle_; // in `middles_`: of each of these, and by face
  Buffer<Placed_vertex<Metric>> middles_;
  // the other half of a double buffer: swapped with the surface by `commit`
  Mesh_view spare_;
  Buffer<Vector_3> points_, normals_;
  Buffer<Metric> metrics_;
  Buffer<Location> locations_;
  Buffer<Index> origin_;
  Buffer<std::uint8_t> active_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_REFINEMENT_H

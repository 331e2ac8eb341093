// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which edges of a mesh are features: its boundary, what the user constrains, ridges, edges of facets, and borders of
// planes.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_MARKS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_MARKS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/bounding_box.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Chords.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facet_edges.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Plane_search.h>
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

/// Open chains of fewer ridges than this are taken for noise of the surface: those that touch nothing else, and those
/// that branch off others.
constexpr std::size_t shortest_isolated_ridge = 5, shortest_branch = 3;

/// Faces that are less high than this part of their longest edge are slivers.
constexpr double sliver_height = 0.125;

/// Cosine of the angle, 150 degrees, by which faces turn where one of them is folded over.
constexpr double cosine_of_fold = -0.866;

/// Cosine of the angle, 30 degrees, by which a ridge may bend where it fades.
constexpr double cosine_of_fading = 0.866;

/// In degrees: chamfers have exactly the angle that ridges begin with, and rounding shall not decide between the edges
/// of one. On scans and meshes of a mesher no angle is meant exactly.
constexpr double rounding_of_angles = 0.01;

/// In degrees: chords of something curved turn by no less from one to the next.
constexpr double least_turn_of_chords = 1;

/// In diagonals: where chords are chance, the largest of them says little.
constexpr double largest_sag_of_chance = 0.002;

/// Of the angle of ridges: where most edges turn by less than this, coarser chords are none.
constexpr double largest_part_of_fine_chords = 2.0 / 3;

/// In degrees: chords of a circle take so much of the angle of a chamfer along it, from twelve on.
constexpr double loss_to_chords = 1;

/// What goes on behind a ridge, and turns by no less than this part of the angle of ridges, is one as well.
constexpr double least_part_of_ridge = 0.9;

/// Whoever asks for ridges from this angle on, in degrees, wants no edges between planes either.
constexpr double largest_angle_for_planes = 90;

/// Which edges are features. \pre `mesh`, `points` and `parameters` live as long as this
class Feature_marks
{
public:
  /// Those from `kept` on are on the boundary or constrained, and never filtered. The normals on both sides of smooth
  /// ones are one. Protected ones stay in one piece.
  enum Mark : std::uint8_t { none, ridge, smooth, kept, kept_smooth, protected_crease, protected_smooth };

  static bool is_smooth(std::uint8_t mark) { return mark == smooth || mark == kept_smooth || mark == protected_smooth; }
  static bool is_protected(std::uint8_t mark) { return mark >= protected_crease; }

  template <class Execution>
  Feature_marks(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                const Feature_parameters& parameters, Facets facets)
    : mesh_(mesh), points_(points), parameters_(parameters), facets_(std::move(facets))
    , cosine_of_ridge_(cosine_of_ridge(0))
    , cosine_below_(cosine_of_ridge(facets_.are_chords() ? -loss_to_chords : -rounding_of_angles))
    , cosine_above_(cosine_of_ridge(rounding_of_angles))
    , cosine_behind_ridge_(cosine_of_ridge((least_part_of_ridge - 1) * parameters.ridge_angle))
    , is_feature_(mesh.number_of_halfedges(), 0)
  {
    are_chords_finer_ = are_chords_finer(execution);
    mark_feature_edges(execution);
    if (finds_edges_of_facets())
      while (extend_ridges(execution, [&](Index last, Index h) { return is_almost_ridge(last) && is_almost_ridge(h); })) {}
    if (!facets_.empty()) find_planes();
    if (finds_edges_of_facets()) {
      mark_edges_of_facets(execution);
      find_planes(); // once more, for chamfers are not of one row with what the edges part them from
    }
    if (parameters.detect_ridges) {
      unmark_folds(execution);
      unmark_wrong_diagonals(execution);
      remove_short_ridges(execution);
    }
    if (facets_.are_chords()) find_sag(execution);
    mark_constraints(execution);
    if (parameters.smooth_borders && facets_.are_chords()) mark_smooth_borders(execution);
  }

  /// To be called once, for it moves them.
  Facets take_facets() { return std::move(facets_); }

  /// Calls `f(w, mark)` for the neighbours `w` of `v` along feature edges.
  template <class F>
  void for_each_neighbor(Index v, const F& f) const
  {
    Index last = no_index;
    mesh_.for_each_outgoing(v, [&](Index h) {
      if (is_feature_[h] != none) f(mesh_.target(h), is_feature_[h]);
      last = Mesh_view::previous(h);
    });
    if (mesh_.is_border(last)) f(mesh_.source(last), is_feature_[last]);
  }

  std::size_t degree(Index v) const
  {
    std::size_t n = 0;
    for_each_neighbor(v, [&](Index, std::uint8_t) { ++n; });
    return n;
  }

  template <class Execution>
  std::vector<Index> vertices_on_features(const Execution& execution) const
  {
    return pack(execution, mesh_.number_of_vertices(), [&](std::size_t v) { return degree(Index(v)) > 0; });
  }

private:
  double cosine_of_ridge(double more) const { return std::cos((parameters_.ridge_angle + more) * CGAL_PI / 180); }

  Vector_3 normal(Index f) const { return face_normal(mesh_, points_, 3 * f); }

  bool is_ridge(Index h) const
  {
    if (facets_.empty()) return is_turned(h, cosine_of_ridge_);
    const Index f = Mesh_view::face(h), g = Mesh_view::face(mesh_.twin[h]);
    const double cosine = cosine_at(h);
    return !facets_.are_one(f, g) &&
           (cosine < cosine_above_ || (cosine < cosine_below_ && (are_chords_finer_ || !are_regular(f, g))));
  }

  /// Whether most edges that are no clear ridges turn by far less than these, between facets that turn so at no edge: then
  /// eight facets around are an octagon, and not what chords have made of something round.
  template <class Execution>
  bool are_chords_finer(const Execution& execution) const
  {
    if (facets_.empty()) return false;
    const double fine = cosine_of_ridge((largest_part_of_fine_chords - 1) * parameters_.ridge_angle);
    const double flat = std::cos(least_turn_of_chords * CGAL_PI / 180);
    const std::vector<Index> coarse = edges_between(execution, cosine_above_, fine);
    std::vector<std::uint8_t> has_coarse(facets_.facets.size(), 0);
    for (const Index h : coarse)
      for (const Index f : {Mesh_view::face(h), Mesh_view::face(mesh_.twin[h])}) has_coarse[facets_.of_face[f]] = 1;
    const auto is_coarse = [&](Index h) { return has_coarse[facets_.of_face[Mesh_view::face(h)]] != 0; };
    std::size_t finer = 0;
    for (const Index h : edges_between(execution, fine, flat)) finer += !is_coarse(h) && !is_coarse(mesh_.twin[h]);
    return finer > coarse.size();
  }

  /// Of the angle between the facets on both sides of `h`.
  double cosine_at(Index h) const
  {
    return facets_.at(Mesh_view::face(h)).normal.dot(facets_.at(Mesh_view::face(mesh_.twin[h])).normal);
  }

  /// Halfedges, one each, of edges between facets whose normals have a cosine from `least` on and below `largest`.
  template <class Execution>
  std::vector<Index> edges_between(const Execution& execution, double least, double largest) const
  {
    return pack(execution, mesh_.number_of_halfedges(), [&](std::size_t i) {
      const Index h = Index(i);
      if (mesh_.is_border(h) || !mesh_.is_edge_owner(h)) return false;
      const double cosine = cosine_at(h);
      return least <= cosine && cosine < largest;
    });
  }

  /// Whether the facets of two faces are as large as each other, as those of a round bore are: at the very angle of
  /// ridges that decides, since chamfers are narrower than what they are between.
  bool are_regular(Index f, Index g) const
  {
    constexpr double largest_ratio = 1.25;
    return internal::are_alike(facets_.at(f).area, facets_.at(g).area, largest_ratio);
  }

  bool is_turned(Index h, double cosine) const
  {
    return is_turned(normal(Mesh_view::face(h)), normal(Mesh_view::face(mesh_.twin[h])), cosine);
  }

  static bool is_turned(const Vector_3& a, const Vector_3& b, double cosine)
  {
    return a.dot(b) < cosine * std::sqrt(a.squaredNorm() * b.squaredNorm());
  }

  template <class Execution>
  void mark_feature_edges(const Execution& execution)
  {
    for_each_index(execution, mesh_.number_of_halfedges(), [&](std::size_t i) {
      const Index h = Index(i);
      if (!mesh_.is_edge_owner(h)) return;
      const Mark mark = first_mark(h);
      is_feature_[h] = mark;
      if (!mesh_.is_border(h)) is_feature_[mesh_.twin[h]] = mark;
    });
  }

  Mark first_mark(Index h) const
  {
    const Edge_constraint asked = constraint(h);
    if (mesh_.is_border(h) || asked == Edge_constraint::crease || asked == Edge_constraint::protected_crease) return kept;
    return parameters_.detect_ridges && is_ridge(h) ? ridge : none;
  }

  Edge_constraint constraint(Index h) const
  {
    return parameters_.halfedge_constraint.empty() ? Edge_constraint::none : parameters_.halfedge_constraint[h];
  }

  /// Marks borders of labels and protected edges, once it is known where the surface is sharp: where they lie says
  /// nothing of its shape.
  template <class Execution>
  void mark_constraints(const Execution& execution)
  {
    if (parameters_.halfedge_constraint.empty()) return;
    for_each_index(execution, mesh_.number_of_halfedges(), [&](std::size_t i) {
      const Index h = Index(i);
      const bool is_crease = is_marked(h);
      if (constraint(h) == Edge_constraint::border) is_feature_[h] = is_crease ? kept : kept_smooth;
      if (constraint(h) >= Edge_constraint::protect) is_feature_[h] = is_crease ? protected_crease : protected_smooth;
    });
  }

  bool is_marked(Index h) const { return is_feature_[h] != none; }

  void find_planes()
  {
    Surface_mesh_adaptation::find_planes(mesh_, points_, [&](Index h) { return !is_marked(h); }, facets_);
  }

  template <class Execution>
  void find_sag(const Execution& execution)
  {
    const Bends found = bends(execution, mesh_, points_, facets_, is_feature_);
    if (found.chords.number > 0) facets_.sag = found.chords.sag;
    if (!found.are_chords_chance(facets_.are_decimated)) return;
    facets_.are_decimated = true;
    facets_.sag = (std::min)(facets_.sag, largest_sag_of_chance * diagonal_of_bounding_box(points_));
  }

  /// Marks edges between facets that are coarser than all chords, in angle and in width: whatever a tessellation keeps to,
  /// angles, lengths or distances, these are walls of the shape.
  template <class Execution>
  void mark_edges_of_walls(const Execution& execution)
  {
    constexpr double far_more = 1.5, radians = CGAL_PI / 180;
    const std::vector<Index> coarse = unmarked_edges(execution, [&](Index h) {
      return facet_edges().turns_more(h, far_more * least_turn_of_chords * radians);
    });
    if (coarse.empty()) return; // and save the search for chords
    const double fine = largest_part_of_fine_chords * parameters_.ridge_angle * radians;
    const Chords chords = chords_below(execution, mesh_, points_, facets_, is_feature_, fine);
    if (chords.number == 0) return mark_edges_of_polygons(execution, fine);
    const std::vector<Index> walls = pack(execution, coarse.size(), [&](std::size_t i) {
      return facet_edges().turns_more(coarse[i], far_more * chords.turn) &&
             facet_edges().is_wider(coarse[i], far_more * chords.width);
    });
    if (walls.size() < chords.number)
      for (const Index i : walls) set_mark(coarse[i], ridge);
  }

  /// Where nothing bends evenly there are no chords, and edges that turn by more than these may are of the shape as well.
  template <class Execution>
  void mark_edges_of_polygons(const Execution& execution, double turn)
  {
    constexpr Evenness even{1.1, 0.4}; // less than half, which is left where chords end in a plane
    if (chords_below(execution, mesh_, points_, facets_, is_feature_, CGAL_PI, even).number > 0) return;
    mark_all(execution, ridge, [&](Index h) { return facet_edges().turns_more(h, turn); });
  }

  /// Not where a mesher has been at work, to whose small facets any angles happen.
  bool finds_edges_of_facets() const
  {
    return facets_.are_chords() && parameters_.detect_ridges &&
           parameters_.ridge_angle < largest_angle_for_planes;
  }

  Facet_edges facet_edges() const { return {mesh_, points_, facets_, is_feature_}; }

  /// Marks where planes end at an angle, and then where else the surface turns once.
  template <class Execution>
  void mark_edges_of_facets(const Execution& execution)
  {
    mark_edges_of_walls(execution);
    mark_all(execution, ridge, [&](Index h) { return facet_edges().ends_plane(h); });
    mark_all(execution, ridge, [&](Index h) { return facet_edges().is_single_turn(h); });
    while (extend_ridges(execution, [&](Index last, Index h) { return goes_on_in(last, h); })) {}
  }

  /// Extends ridges that end by edges for which `goes_on(last, h)`, and returns whether there were any. What is on a
  /// feature then may be what another one lacks.
  template <class Execution, class Goes_on>
  bool extend_ridges(const Execution& execution, const Goes_on& goes_on)
  {
    bool result = false;
    for (const Index v : vertices_on_features(execution))
      for (Index w = extended(v, goes_on); w != no_index; w = extended(w, goes_on)) result = true;
    return result;
  }

  /// Marks the edge by which the ridge that ends at `v` goes on straight, and returns its other end, or `no_index` if
  /// there is none.
  template <class Goes_on>
  Index extended(Index v, const Goes_on& goes_on)
  {
    const Index last = only_edge(v, ridge); // back from there
    if (last == no_index) return no_index;
    Index straightest = no_index;
    double largest_cosine = cosine_of_fading;
    mesh_.for_each_outgoing(v, [&](Index h) {
      const double cosine = -cosine_between(h, last);
      if (!(cosine > largest_cosine) || is_convex(h) != is_convex(last) || !goes_on(last, h)) return;
      largest_cosine = cosine;
      straightest = h;
    });
    if (straightest == no_index) return no_index;
    set_mark(straightest, ridge);
    return mesh_.target(straightest);
  }

  /// Whether the ridge that ends in `last` goes on in `h` as it is, or fades: evenly if it does so from the angle of ridges
  /// on, or `h` is all that it lacks to the next feature.
  bool goes_on_in(Index last, Index h) const
  {
    if (facet_edges().turns_as_much(last, h) && facet_edges().turns_alone(h)) return true;
    if (!facet_edges().turns_less(last, h)) return false;
    const Index before = only_edge(mesh_.target(last), ridge, mesh_.source(last));
    if (before != no_index && facet_edges().fades_evenly(before, last, h)) return true;
    return !is_ridge(last) && (degree(mesh_.target(h)) > 0 || facet_edges().turns_alone(h));
  }

  /// Whether `h` is a ridge, or what chords have left of one. Facets that are as large as each other bend.
  bool is_almost_ridge(Index h) const
  {
    const Index f = Mesh_view::face(h), g = Mesh_view::face(mesh_.twin[h]);
    return !facets_.are_one(f, g) && !are_regular(f, g) && cosine_at(h) < cosine_behind_ridge_;
  }

  /// The halfedge from `v` along the only feature edge there, but for one to the vertex `from`, if it has the mark `mark`;
  /// else `no_index`, as on the boundary.
  Index only_edge(Index v, Mark mark, Index from = no_index) const
  {
    Index only = no_index;
    std::size_t degree = 0;
    mesh_.for_each_outgoing(v, [&](Index h) {
      if (!is_marked(h) || mesh_.target(h) == from) return;
      ++degree;
      only = is_feature_[h] == mark ? h : no_index;
    });
    return degree == 1 ? only : no_index;
  }

  double cosine_between(Index g, Index h) const
  {
    const auto direction = [&](Index i) { return Vector_3(points_[mesh_.target(i)] - points_[mesh_.source(i)]); };
    return direction(g).normalized().dot(direction(h).normalized());
  }

  /// Marks the edges without a mark for which `predicate(h)`, which sees none of the new marks.
  template <class Execution, class Predicate>
  void mark_all(const Execution& execution, Mark mark, const Predicate& predicate)
  {
    for (const Index h : unmarked_edges(execution, predicate)) set_mark(h, mark);
  }

  /// A halfedge each of those without a mark for which `predicate(h)`.
  template <class Execution, class Predicate>
  std::vector<Index> unmarked_edges(const Execution& execution, const Predicate& predicate) const
  {
    return pack(execution, mesh_.number_of_halfedges(), [&](std::size_t h) {
      return mesh_.is_edge_owner(Index(h)) && !is_marked(Index(h)) && predicate(Index(h));
    });
  }

  /// Borders neither end nor begin within a smooth piece: what does is a few facets that happen to be so.
  template <class Execution>
  void mark_smooth_borders(const Execution& execution)
  {
    mark_all(execution, smooth, [&](Index h) { return facet_edges().is_smooth_border(h); });
    for (const Index v : vertices_on_features(execution))
      for (Index w = v; w != no_index;) w = retracted(w);
  }

  /// Unmarks the smooth edge that ends at `v`, where no other feature is, and returns its other end, or `no_index` if
  /// there is none.
  Index retracted(Index v)
  {
    const Index last = only_edge(v, smooth);
    if (last == no_index) return no_index;
    set_mark(last, none);
    return mesh_.target(last);
  }

  /// Folds are noise rather than shapes, and their normals mean nothing: that of the face behind the longest edge, on
  /// which a sliver lies, takes their place. Boundaries and constrained edges stay what they are.
  template <class Execution>
  void unmark_folds(const Execution& execution)
  {
    const std::vector<Index> folds = pack(execution, mesh_.number_of_faces(), [&](std::size_t f) {
      return is_fold(Index(f));
    });
    for (const Index f : folds) {
      const Index longest = longest_edge(f);
      const Vector_3 n = normal(Mesh_view::face(mesh_.twin[longest]));
      set_mark(longest, none);
      for (const Index h : {Mesh_view::next(longest), Mesh_view::previous(longest)})
        if (is_feature_[h] < kept)
          set_mark(h, is_turned(n, normal(Mesh_view::face(mesh_.twin[h])), cosine_of_ridge_) ? ridge : none);
    }
  }

  /// Whether two of three hold: a face is a sliver; it turns away from all its neighbours; it is turned over at its
  /// longest edge and another one. One alone may be a shape: slivers fill arcs, and plates have tips.
  bool is_fold(Index f) const
  {
    const Index longest = longest_edge(f), a = Mesh_view::next(longest), b = Mesh_view::previous(longest);
    if (is_feature_[longest] != ridge) return false;
    const auto is_over = [&](Index h) { return is_feature_[h] == ridge && is_turned(h, cosine_of_fold); };
    const bool is_sliver = normal(f).norm() < sliver_height * squared_length(longest);
    const bool turns_away = is_feature_[a] == ridge && is_feature_[b] == ridge;
    const bool lies_over = is_over(longest) && (is_over(a) || is_over(b));
    return int(is_sliver) + int(turns_away) + int(lies_over) >= 2;
  }

  /// Where long faces cross a bend of the surface, some of their edges are the wrong diagonals, and the bend becomes a
  /// row of dents.
  template <class Execution>
  void unmark_wrong_diagonals(const Execution& execution)
  {
    const std::vector<Index> wrong = pack(execution, mesh_.number_of_halfedges(), [&](std::size_t h) {
      return bends_to_and_fro(Index(h)) && is_flatter_across(Index(h));
    });
    for (const Index h : wrong) set_mark(h, none);
  }

  /// Whether `h` is the middle stroke of a Z of three ridges along its two faces, and bends the other way than the
  /// others.
  bool bends_to_and_fro(Index h) const
  {
    if (!mesh_.is_edge_owner(h) || is_feature_[h] != ridge) return false;
    const bool is_convex_itself = is_convex(h);
    const auto bends_back = [&](Index g) { return is_feature_[g] == ridge && is_convex(g) != is_convex_itself; };
    const Index t = mesh_.twin[h];
    return (bends_back(Mesh_view::next(h)) && bends_back(Mesh_view::next(t))) ||
           (bends_back(Mesh_view::previous(h)) && bends_back(Mesh_view::previous(t)));
  }

  /// Whether the two faces of `h` would turn by less if they met at the other diagonal, and all five edges of the two
  /// together would, too.
  bool is_flatter_across(Index h) const
  {
    const Index t = mesh_.twin[h];
    const Vector_3 &a = points_[mesh_.source(h)], &b = points_[mesh_.target(h)];
    const Vector_3 &c = points_[mesh_.apex(h)], &d = points_[mesh_.apex(t)];
    const Vector_3 at_a = (d - a).cross(c - a), at_b = (c - b).cross(d - b); // normals on both sides of c d
    const double now = angle_between(normal(Mesh_view::face(h)), normal(Mesh_view::face(t))), across = angle_between(at_a, at_b);
    double gain = now - across;
    const auto compare = [&](Index g, const Vector_3& with) {
      if (mesh_.is_border(g)) return;
      const Vector_3 behind = normal(Mesh_view::face(mesh_.twin[g]));
      gain += angle_between(normal(Mesh_view::face(g)), behind) - angle_between(with, behind);
    };
    for (const Index g : {Mesh_view::previous(h), Mesh_view::next(t)}) compare(g, at_a);
    for (const Index g : {Mesh_view::next(h), Mesh_view::previous(t)}) compare(g, at_b);
    return across < now && gain > 0;
  }

  bool is_convex(Index h) const
  {
    const Vector_3 to_other_apex = points_[mesh_.apex(mesh_.twin[h])] - points_[mesh_.source(h)];
    return to_other_apex.dot(normal(Mesh_view::face(h))) < 0;
  }

  Index longest_edge(Index f) const
  {
    const Index h = 3 * f;
    return (std::max)({h, h + 1, h + 2}, [&](Index a, Index b) { return squared_length(a) < squared_length(b); });
  }

  double squared_length(Index h) const { return (points_[mesh_.target(h)] - points_[mesh_.source(h)]).squaredNorm(); }

  /// \pre `h` is not kept, and thus not on the boundary
  void set_mark(Index h, Mark mark) { is_feature_[h] = is_feature_[mesh_.twin[h]] = mark; }

  /// Ridges that form a short chain with an open end: touching nothing else, or still shorter, branching off others.
  template <class Execution>
  void remove_short_ridges(const Execution& execution)
  {
    for (const Index v : vertices_on_features(execution)) {
      if (degree(v) != 1) continue;
      const std::vector<Index> chain = open_chain_from(v);
      const std::size_t shortest = degree(chain.back()) == 1 ? shortest_isolated_ridge : shortest_branch;
      if (chain.size() <= shortest) unmark(chain);
    }
  }

  /// The vertices of the ridges from the open end `v` on to where they end or branch, or turn into other features; no
  /// more of them than are of interest.
  std::vector<Index> open_chain_from(Index v) const
  {
    std::vector<Index> chain{v};
    Index previous = no_index;
    do {
      Index next = no_index;
      std::uint8_t mark_of_next = none;
      for_each_neighbor(chain.back(), [&](Index w, std::uint8_t mark) {
        if (w == previous) return;
        next = w;
        mark_of_next = mark;
      });
      if (mark_of_next != ridge) break;
      previous = chain.back();
      chain.push_back(next);
    } while (degree(chain.back()) == 2 && chain.size() <= shortest_isolated_ridge);
    return chain;
  }

  void unmark(const std::vector<Index>& chain)
  {
    for (std::size_t i = 1; i < chain.size(); ++i) set_mark(mesh_.halfedge(chain[i - 1], chain[i]), none);
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Feature_parameters& parameters_;
  Facets facets_;
  double cosine_of_ridge_, cosine_below_, cosine_above_; // of the angle, and on both sides of what may have become of it
  double cosine_behind_ridge_;
  bool are_chords_finer_ = false;
  std::vector<std::uint8_t> is_feature_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURE_MARKS_H

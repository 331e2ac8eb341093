// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feature classification: ridges, boundaries, constrained edges and smooth borders of planes, chained into curves
// between corners.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FEATURES_H
#define CGAL_SURFACE_MESH_ADAPTATION_FEATURES_H

#include <CGAL/Surface_mesh_adaptation/Facets.h>
#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>
#include <CGAL/Surface_mesh_adaptation/internal/Facet_edges.h>
#include <CGAL/Surface_mesh_adaptation/internal/cubic_curve.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// How a vertex may move: on the surface, along its feature curve, or not at all.
enum class Vertex_class : std::uint8_t { smooth, curve, corner };

/// A chain of feature edges from corner to corner, or closed without a corner (first and last vertex equal).
struct Feature_curve
{
  std::vector<Index> vertices;
  std::vector<double> arc_length;  ///< of each vertex from the first, along the chords
  std::vector<Vector_3> tangents;  ///< unit, in the direction of the chain
  std::vector<std::array<Vector_3, 2>> ends; ///< tangents at the ends of each edge: as above, or the direction of the
                                             ///< edge where the curve stays on it
  bool closed = false;             ///< whether the chain is a cycle that no corner interrupts

  bool is_closed() const { return closed; }
  double length() const { return arc_length.back(); }

  /// The edge of the chain that contains arc length `s`.
  std::size_t segment(double s) const
  {
    const auto after = std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, s);
    return std::size_t(after - arc_length.begin()) - 1;
  }

  /// Position of arc length `s` in segment `i`, in [0, 1].
  double parameter(std::size_t i, double s) const
  {
    const double length_of_segment = arc_length[i + 1] - arc_length[i];
    return length_of_segment > 0 ? (std::min)(1.0, (std::max)(0.0, (s - arc_length[i]) / length_of_segment)) : 0;
  }
};

/// The place of a curve vertex on its curve.
struct Curve_node
{
  Index curve = no_curve;
  Index index = 0;
};

/// What the user asks for and constrains; flags are per element of the mesh view, empty for "none".
struct Feature_parameters
{
  bool detect_ridges = true;
  double ridge_angle = 45;    ///< degrees: an edge is a ridge if the normals of its faces differ by more
  double corner_angle = 60;   ///< degrees: a curve that turns by more at a vertex has a corner there
  bool smooth_borders = false; ///< whether planes keep their outlines where something curved joins them smoothly
  std::vector<std::uint8_t> halfedge_is_constrained;
  std::vector<std::uint8_t> vertex_is_constrained;
};

struct Features
{
  std::vector<Vertex_class> vertex_class;
  std::vector<Curve_node> node_of_vertex;  ///< of curve vertices; of a closed chain's first vertex, index 0
  std::vector<Feature_curve> curves;
  Facets facets;

  /// Unit tangent, in the direction of the chain, of `curve` at the vertex `v` of its edge between `v` and `w`.
  const Vector_3& tangent(Index curve, Index v, Index w) const
  {
    const Feature_curve& c = curves[curve];
    const std::size_t i = vertex_class[v] == Vertex_class::curve ? node_of_vertex[v].index : 0;
    if (c.vertices[i] == v && c.vertices[i + 1] == w) return c.ends[i][0];
    return vertex_class[v] == Vertex_class::curve && i > 0 ? c.ends[i - 1][1] : c.ends.back()[1];
  }
};

namespace internal {

/// Open chains of fewer ridges than this are taken for noise of the surface: those that touch nothing else, and those
/// that branch off others.
constexpr std::size_t shortest_isolated_ridge = 5, shortest_branch = 3;

/// Faces that are less high than this part of their longest edge are slivers.
constexpr double sliver_height = 0.125;

/// Vertices around which the angles of the faces add up to less than this, 240 degrees, are points of cones or spikes.
/// On meshes of smooth shapes they add up to about 300 degrees at least.
constexpr double angle_around_point = 4 * CGAL_PI / 3;

/// Length of the mean of the unit normals of the faces at such a point, at most: .67 for a cone with that angle.
constexpr double cosine_at_point = 0.8;

/// Cosine of the angle, 150 degrees, by which faces turn where one of them is folded over.
constexpr double cosine_of_fold = -0.866;

/// Whoever asks for ridges from this angle on, in degrees, wants no edges between planes either.
constexpr double largest_angle_for_planes = 90;

/// Edges of a curve that follow each other belong to one arc if neither is longer than the other by more than this: CAD
/// systems cut arcs evenly, other edges are what they happen to be.
constexpr double largest_ratio_on_arcs = 10, largest_ratio_on_even_arcs = 3;

inline double largest_ratio_of_edges(const Facets& facets)
{
  return facets.are_chords() ? largest_ratio_on_even_arcs : largest_ratio_on_arcs;
}

/// The straight pieces of a curve: what follows in one line belongs together, however many edges it has. Closed curves
/// start where they bend.
class Strokes
{
public:
  Strokes(const Feature_curve& c, const std::vector<Vector_3>& points, const Facets& facets)
    : c_(c), points_(points), stroke_of_edge_(c.vertices.size() - 1, 0)
    , largest_ratio_(largest_ratio_of_edges(facets))
  {
    bounds_.push_back(0);
    for (std::size_t i = 1; i + 1 < c.vertices.size(); ++i) {
      const auto at = [&](std::size_t j) -> const Vector_3& { return points[c.vertices[j]]; };
      if (!facets.is_on_line(at(bounds_.back()), at(i), at(i + 1))) bounds_.push_back(i);
      stroke_of_edge_[i] = bounds_.size() - 1;
    }
    bounds_.push_back(c.vertices.size() - 1);
  }

  Vector_3 before(std::size_t i) const { return stroke(i == 0 ? size() - 1 : stroke_of_edge_[i - 1]); }
  Vector_3 after(std::size_t i) const { return stroke(i + 1 == c_.vertices.size() ? 0 : stroke_of_edge_[i]); }

  /// The stroke that follows the first one, or precedes the last one; zero if there is one only.
  Vector_3 second() const { return size() > 1 ? stroke(1) : Vector_3::Zero(); }
  Vector_3 last_but_one() const { return size() > 1 ? stroke(size() - 2) : Vector_3::Zero(); }

  /// Whether a stroke beside that of edge `i` is about as long: one alone may as well be straight.
  bool is_on_arc(std::size_t i) const
  {
    const std::size_t s = stroke_of_edge_[i], n = size();
    const bool has_before = s > 0 || (c_.closed && n > 2), has_after = s + 1 < n || (c_.closed && n > 2);
    return (has_before && are_like(s, (s + n - 1) % n)) || (has_after && are_like(s, (s + 1) % n));
  }

  /// Whether there are so few that they may as well be the sides of a polygon.
  bool are_sides() const { return size() < 3; }

  /// Whether a stroke of length `a` is too long to be of one arc with one of length `b`.
  bool is_longer(double a, double b) const { return a > largest_ratio_ * b; }

private:
  std::size_t size() const { return bounds_.size() - 1; }

  Vector_3 stroke(std::size_t s) const
  {
    return points_[c_.vertices[bounds_[s + 1]]] - points_[c_.vertices[bounds_[s]]];
  }

  bool are_like(std::size_t s, std::size_t t) const
  {
    return are_alike(stroke(s).norm(), stroke(t).norm(), largest_ratio_);
  }

  const Feature_curve& c_;
  const std::vector<Vector_3>& points_;
  std::vector<std::size_t> bounds_; ///< vertices of the chain where strokes begin, and its last one
  std::vector<std::size_t> stroke_of_edge_;
  double largest_ratio_;
};

/// One run of the detection: marks, corners, chains.
class Feature_detection
{
public:
  Feature_detection(Mesh_view& mesh, const std::vector<Vector_3>& points, const Feature_parameters& parameters)
    : mesh_(mesh), points_(points), parameters_(parameters)
    , cosine_of_ridge_(std::cos(parameters.ridge_angle * CGAL_PI / 180)), is_feature_(mesh.number_of_halfedges(), 0)
  {}

  template <class Execution>
  Features run(const Execution& execution)
  {
    features_.facets = find_facets(execution, mesh_, points_);
    mark_feature_edges(execution);
    if (!features_.facets.empty())
      find_planes(mesh_, points_, [&](Index h) { return !is_marked(h); }, features_.facets);
    if (finds_edges_of_facets()) mark_edges_of_facets(execution);
    if (parameters_.detect_ridges) {
      unmark_folds(execution);
      unmark_wrong_diagonals(execution);
      remove_short_ridges(execution);
    }
    if (parameters_.smooth_borders && features_.facets.are_chords()) mark_smooth_borders(execution);
    feature_vertices_ = vertices_on_features(execution); // what follows is sequential, but only along these
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
  /// Those that are `kept` are on the boundary or constrained, and never filtered; the normals on both sides of those
  /// that are `smooth` are one.
  enum Mark : std::uint8_t { none, ridge, kept, smooth };

  Vector_3 normal(Index f) const
  {
    const std::size_t h = 3 * std::size_t(f);
    const Vector_3& p = points_[mesh_.corner[h]];
    return (points_[mesh_.corner[h + 1]] - p).cross(points_[mesh_.corner[h + 2]] - p);
  }

  bool is_ridge(Index h) const
  {
    const Facets& facets = features_.facets;
    if (facets.empty()) return is_turned(h, cosine_of_ridge_);
    const Index f = Mesh_view::face(h), g = Mesh_view::face(mesh_.twin[h]);
    return !facets.are_one(f, g) && facets.at(f).normal.dot(facets.at(g).normal) < cosine_of_ridge_;
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
      const bool constrained = !parameters_.halfedge_is_constrained.empty() &&
                               parameters_.halfedge_is_constrained[h] != 0;
      std::uint8_t mark = none;
      if (mesh_.is_border(h) || constrained) mark = kept;
      else if (parameters_.detect_ridges && is_ridge(h)) mark = ridge;
      is_feature_[h] = mark;
      if (!mesh_.is_border(h)) is_feature_[mesh_.twin[h]] = mark;
    });
  }

  bool is_marked(Index h) const { return is_feature_[h] != none; }

  /// Not where a mesher has been at work, to whose small facets any angles happen.
  bool finds_edges_of_facets() const
  {
    return features_.facets.are_chords() && parameters_.detect_ridges &&
           parameters_.ridge_angle < largest_angle_for_planes;
  }

  Facet_edges facet_edges() const { return {mesh_, points_, features_.facets, is_feature_}; }

  /// Marks where planes end at an angle, and then where else the surface turns once.
  template <class Execution>
  void mark_edges_of_facets(const Execution& execution)
  {
    mark_all(execution, ridge, [&](Index h) { return facet_edges().ends_plane(h); });
    mark_all(execution, ridge, [&](Index h) { return facet_edges().is_single_turn(h); });
  }

  /// Marks the edges without a mark for which `predicate(h)`, which sees none of the new marks.
  template <class Execution, class Predicate>
  void mark_all(const Execution& execution, Mark mark, const Predicate& predicate)
  {
    const std::vector<Index> found = pack(execution, mesh_.number_of_halfedges(), [&](std::size_t h) {
      return mesh_.is_edge_owner(Index(h)) && !is_marked(Index(h)) && predicate(Index(h));
    });
    for (const Index h : found) set_mark(h, mark);
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
    Index other = no_index;
    std::size_t degree = 0;
    for_each_feature_neighbor(v, [&](Index w, std::uint8_t mark) {
      ++degree;
      other = mark == smooth ? w : no_index;
    });
    if (degree != 1 || other == no_index) return no_index;
    set_mark(any_halfedge(v, other), none);
    return other;
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
        if (is_feature_[h] != kept)
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
    const double now = turn(normal(Mesh_view::face(h)), normal(Mesh_view::face(t))), across = turn(at_a, at_b);
    double gain = now - across;
    const auto compare = [&](Index g, const Vector_3& with) {
      if (mesh_.is_border(g)) return;
      const Vector_3 behind = normal(Mesh_view::face(mesh_.twin[g]));
      gain += turn(normal(Mesh_view::face(g)), behind) - turn(with, behind);
    };
    for (const Index g : {Mesh_view::previous(h), Mesh_view::next(t)}) compare(g, at_a);
    for (const Index g : {Mesh_view::next(h), Mesh_view::previous(t)}) compare(g, at_b);
    return across < now && gain > 0;
  }

  static double turn(const Vector_3& a, const Vector_3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

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

  /// \pre `h` is not marked as `kept`, and thus not on the boundary
  void set_mark(Index h, Mark mark) { is_feature_[h] = is_feature_[mesh_.twin[h]] = mark; }

  /// Calls `f(w, mark)` for the neighbours `w` of `v` along feature edges.
  template <class F>
  void for_each_feature_neighbor(Index v, const F& f) const
  {
    Index last = no_index;
    mesh_.for_each_outgoing(v, [&](Index h) {
      if (is_feature_[h] != none) f(mesh_.target(h), is_feature_[h]);
      last = Mesh_view::previous(h);
    });
    if (mesh_.is_border(last)) f(mesh_.source(last), is_feature_[last]);
  }

  std::size_t feature_degree(Index v) const
  {
    std::size_t n = 0;
    for_each_feature_neighbor(v, [&](Index, std::uint8_t) { ++n; });
    return n;
  }

  template <class Execution>
  std::vector<Index> vertices_on_features(const Execution& execution) const
  {
    return pack(execution, mesh_.number_of_vertices(), [&](std::size_t v) { return feature_degree(Index(v)) > 0; });
  }

  /// Ridges that form a short chain with an open end: touching nothing else, or still shorter, branching off others.
  template <class Execution>
  void remove_short_ridges(const Execution& execution)
  {
    for (const Index v : vertices_on_features(execution)) {
      if (feature_degree(v) != 1) continue;
      const std::vector<Index> chain = open_chain_from(v);
      const std::size_t shortest = feature_degree(chain.back()) == 1 ? shortest_isolated_ridge : shortest_branch;
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
      for_each_feature_neighbor(chain.back(), [&](Index w, std::uint8_t mark) {
        if (w == previous) return;
        next = w;
        mark_of_next = mark;
      });
      if (mark_of_next != ridge) break;
      previous = chain.back();
      chain.push_back(next);
    } while (feature_degree(chain.back()) == 2 && chain.size() <= shortest_isolated_ridge);
    return chain;
  }

  void unmark(const std::vector<Index>& chain)
  {
    for (std::size_t i = 1; i < chain.size(); ++i) set_mark(mesh_.halfedge(chain[i - 1], chain[i]), none);
  }

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
      sum += normal(Mesh_view::face(h)).normalized();
      ++faces;
    });
    if (sum.norm() >= cosine_at_point * faces) return false;
    mesh_.for_each_outgoing(v, [&](Index h) {
      angles += turn(points_[mesh_.target(h)] - points_[v], points_[mesh_.apex(h)] - points_[v]);
    });
    return angles < angle_around_point;
  }

  /// The class of a vertex with features, of which those that are fixed are known.
  Vertex_class classify(Index v) const
  {
    if (features_.vertex_class[v] == Vertex_class::corner) return Vertex_class::corner;
    Ring<Index> along;
    std::size_t n_smooth = 0;
    for_each_feature_neighbor(v, [&](Index w, std::uint8_t mark) {
      along.push_back(w);
      n_smooth += mark == smooth;
    });
    if (along.empty()) return Vertex_class::smooth;
    if (along.size() != 2 || n_smooth == 1) return Vertex_class::corner;
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
    for_each_feature_neighbor(w, [&](Index x, std::uint8_t) {
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
      for_each_feature_neighbor(current, [&](Index w, std::uint8_t) {
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
      for_each_feature_neighbor(v, [&](Index w, std::uint8_t) { second = w; });
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
    const auto start_chains = [&](Vertex_class kind, bool are_smooth) {
      for (const Index v : feature_vertices_) {
        if (features_.vertex_class[v] != kind) continue;
        Ring<Index> along;
        for_each_feature_neighbor(v, [&](Index w, std::uint8_t mark) {
          if ((mark == smooth) == are_smooth) along.push_back(w);
        });
        for (Index w : along)
          if (mesh_.curve[any_halfedge(v, w)] == no_curve) add_curve(chain_from(v, w));
      }
    };
    for (const bool are_smooth : {false, true}) {
      if (are_smooth) mesh_.first_smooth_curve = Index(features_.curves.size());
      start_chains(Vertex_class::corner, are_smooth);
      start_chains(Vertex_class::curve, are_smooth); // what is left are cycles
    }
  }

  Index any_halfedge(Index v, Index w) const
  {
    const Index h = mesh_.halfedge(v, w);
    return h != no_index ? h : mesh_.halfedge(w, v);
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
      if (i > 0) mesh_.set_curve(any_halfedge(chain[i - 1], chain[i]), id);
      if (features_.vertex_class[chain[i]] == Vertex_class::curve && !(c.closed && i + 1 == chain.size()))
        features_.node_of_vertex[chain[i]] = {id, Index(i)};
    }
    c.vertices = std::move(chain);
    const Strokes strokes(c, points_, features_.facets);
    for (std::size_t i = 0; i < c.vertices.size(); ++i) c.tangents.push_back(tangent(c, strokes, i));
    for (std::size_t i = 0; i + 1 < c.vertices.size(); ++i) c.ends.push_back(ends(c, strokes, i));
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

  /// Three-point tangent, of second order on uneven points: of the parabola through the vertex and the ends of the
  /// strokes there, or at an end through the first three of these. The stroke, if there are no three, and the longer
  /// stroke where it is too long to be of one arc with the other.
  static Vector_3 tangent(const Feature_curve& c, const Strokes& strokes, std::size_t i)
  {
    const std::size_t n = c.vertices.size();
    if (!c.closed && i == 0) return end_tangent(strokes, strokes.after(0), strokes.second());
    if (!c.closed && i + 1 == n) return -end_tangent(strokes, -strokes.before(i), -strokes.last_but_one());
    const Vector_3 dm = strokes.before(i), dp = strokes.after(i);
    const double lm = dm.norm(), lp = dp.norm();
    if (strokes.is_longer(lm, lp)) return dm / lm;
    if (strokes.is_longer(lp, lm)) return dp / lp;
    return (lm * lp > 0 ? dp * (lm / lp) + dm * (lp / lm) : dp + dm).normalized();
  }

  /// The tangent at the start of two strokes that follow each other; the first one if it is not of one arc with the
  /// second, or if the parabola turns off by more than 30 degrees, which says that the chain is too coarse for it.
  static Vector_3 end_tangent(const Strokes& strokes, const Vector_3& first, const Vector_3& second)
  {
    constexpr double least_cosine = 0.866;
    const double l1 = first.norm(), l2 = second.norm();
    if (!(l1 * l2 > 0) || strokes.is_longer(l1, l2)) return first.normalized();
    const Vector_3 t = (first / l1 + (first / l1 - second / l2) * (l1 / (l1 + l2))).normalized();
    return t.dot(first) > least_cosine * l1 ? t : first / l1;
  }

  std::array<Vector_3, 2> ends(const Feature_curve& c, const Strokes& strokes, std::size_t i) const
  {
    const Vector_3 e = points_[c.vertices[i + 1]] - points_[c.vertices[i]];
    const std::array<Vector_3, 2> straight{e.normalized(), e.normalized()};
    const Index a = any_halfedge(c.vertices[i], c.vertices[i + 1]), b = mesh_.twin[a];
    const bool is_side = b == no_index && strokes.are_sides(); // of an outline
    if (is_side || !strokes.is_on_arc(i) || (is_beside_plane(a) && is_beside_plane(b))) return straight;
    const Vector_3 ta = tangent_in_planes(a, b, c.tangents[i]), tb = tangent_in_planes(a, b, c.tangents[i + 1]);
    const Cubic_handles h = feature_handles(e, ta, tb);
    const Vector_3 bulge = 0.375 * (h.start + h.end);
    if (leaves_facet(a, bulge) || (b != no_index && leaves_facet(b, bulge))) return straight;
    return {ta, tb};
  }

  bool is_beside_plane(Index h) const { return h != no_index && features_.facets.is_plane(Mesh_view::face(h)); }

  /// `t` without what leaves a plane on either side of an edge, which has the halfedges `a` and `b`.
  Vector_3 tangent_in_planes(Index a, Index b, const Vector_3& t) const
  {
    for (const Index h : {a, b}) {
      if (!is_beside_plane(h)) continue;
      const Vector_3& n = features_.facets.at(Mesh_view::face(h)).normal;
      const Vector_3 in_plane = t - t.dot(n) * n;
      return in_plane.squaredNorm() > 0 ? Vector_3(in_plane.normalized()) : t;
    }
    return t;
  }

  /// Whether a curve over the edge of `h` that is off it by `bulge` in the middle would leave the facet, as a parabola:
  /// slivers that fill an arc turn over where their edge becomes that arc.
  bool leaves_facet(Index h, const Vector_3& bulge) const
  {
    const Vector_3 e = points_[mesh_.target(h)] - points_[mesh_.source(h)];
    const Vector_3 side = points_[mesh_.apex(h)] - points_[mesh_.source(h)];
    const double length2 = e.squaredNorm(), along = side.dot(e);
    const Vector_3 height = side - along / length2 * e; // at `along` of `length2`
    return 4 * bulge.dot(height) * (std::max)(along, length2 - along) > height.squaredNorm() * length2;
  }

  Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Feature_parameters& parameters_;
  double cosine_of_ridge_;
  std::vector<std::uint8_t> is_feature_;
  std::vector<Index> feature_vertices_;
  Features features_;
};

} // namespace internal

/// Detects the features of a mesh and writes the curve of every halfedge into `mesh.curve`. A vertex on one feature
/// curve that does not turn sharply there is a curve vertex; one at which curves end, meet, branch or turn, which is
/// constrained, or which is the point of a cone is a corner.
template <class Execution>
Features detect_features(const Execution& execution, Mesh_view& mesh, const std::vector<Vector_3>& points,
                         const Feature_parameters& parameters)
{
  return internal::Feature_detection(mesh, points, parameters).run(execution);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FEATURES_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface that is adapted, as an immutable reference: the input mesh, its normals and feature curves, and a patch
// over each of its faces. Every vertex of the adapted mesh is anchored in it by a `Location`; positions and normals
// are functions of the location, so repeated moves cannot drift, and concurrent ones cannot conflict.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_REFERENCE_SURFACE_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_REFERENCE_SURFACE_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/bounding_box.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Lazy_jets.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch_cache.h>
#include <CGAL/Surface_mesh_adaptation/surface/detect_features.h>
#include <CGAL/Surface_mesh_adaptation/surface/feature_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Where a vertex sits on the reference surface.
struct Location
{
  Vertex_class kind = Vertex_class::smooth;
  Index cell = 0;             ///< smooth: face; curve: feature curve; corner: vertex of the reference
  double u = 0, v = 0;        ///< smooth: barycentric coordinates of corners 1 and 2 of the face; curve: `u` is the
                              ///< arc length from the start of the curve
};

/// The location on the edge of the halfedge `h`, in its face, `t` of the way from its source.
inline Location location_on_edge(Index h, double t)
{
  std::array<double, 3> weights{};
  weights[h % 3] = 1 - t;
  weights[(h + 1) % 3] = t;
  return {Vertex_class::smooth, Mesh_view::face(h), weights[1], weights[2]};
}

template <class Reconstruction>
class Reference_surface
{
public:
  /// Whether the faces of the input themselves are the surface.
  static constexpr bool is_flat = std::is_same_v<Reconstruction, Flat_reconstruction>;

  Mesh_view mesh;
  std::vector<Vector_3> points;
  Features features;
  Corner_normals normals;  ///< of Max: a first estimate; patches have those of jets

  /// Takes over the mesh, detects its features and estimates its normals.
  template <class Execution>
  Reference_surface(const Execution& execution, Mesh_view mesh_, std::vector<Vector_3> points_,
                    const Feature_parameters& parameters, internal::Given_jets given = {})
    : mesh(std::move(mesh_)), points(std::move(points_))
    , features(detect_features(execution, mesh, points, parameters))
    , normals(estimate_normals(execution, mesh, points))
    , largest_bulge_(parameters.largest_bulge)
    , largest_doubtful_bulge_(features.facets.empty() ? infinity : doubtful_bulge())
    , given_(std::move(given))
    , jets_(execution, normals.normals.size())
    , has_fallback_(new std::atomic<bool>[mesh.number_of_faces()])
  {
    orthogonalize_normals(execution, mesh, features, normals);
    for_each_index(execution, mesh.number_of_faces(), [&](std::size_t f) {
      has_fallback_[f].store(false, std::memory_order_relaxed);
    }, fill_chunk_length);
  }

  /// The location of vertex `v` of the reference.
  Location location_of_vertex(Index v) const
  {
    const Vertex_class c = features.vertex_class[v];
    if (c == Vertex_class::corner) return {c, v, 0, 0};
    if (c == Vertex_class::curve) {
      const Curve_node node = features.node_of_vertex.at(v);
      return {c, node.curve, features.curves[node.curve].arc_length[node.index], 0};
    }
    const Index h = mesh.outgoing[v];
    return {c, Mesh_view::face(h), h % 3 == 1 ? 1.0 : 0.0, h % 3 == 2 ? 1.0 : 0.0};
  }

  /// A face of the reference that has the location.
  Index face_at(const Location& l) const
  {
    return l.kind == Vertex_class::smooth ? l.cell : Mesh_view::face(mesh.outgoing[interpolation(l).vertices[0]]);
  }

  /// Whether `f` is of a plane of the shape. Normals that are given know better.
  bool is_plane(Index f) const { return given_.normals.empty() && features.facets.is_plane(f); }

  /// What the patch over face `f` is made from.
  Patch patch(Index f) const
  {
    Patch p;
    const std::size_t h = 3 * std::size_t(f);
    for (std::size_t i = 0; i < 3; ++i) {
      p.points[i] = points[mesh.corner[h + i]];
      const internal::Jet jet = jet_at(Index(h + i));
      p.normals[i] = jet.normal;
      p.shape_operators[i] = jet.shape_operator;
      p.has_shape_operator[i] = jet.has_shape_operator;
    }
    if (is_plane(f)) flatten(p, features.facets.at(f).normal);
    limit_bulge(p, f);
    if (!is_fitted(p) || features.facets.are_decimated) p.largest_bulge = (std::min)(p.largest_bulge, largest_bulge());
    for (std::size_t i = 0; i < 3; ++i) {
      const bool bulges_too_far = this->bulges_too_far(Index(h + i), p, i);
      if (bulges_too_far) p.largest_bulge = 0; // for these normals say nothing of the inside either
      p.is_straight[i] = bulges_too_far || is_straight(Index(h + i), p, i);
      const Index curve = mesh.curve[h + i];
      p.is_feature[i] = mesh.is_shaped(Index(h + i));
      if (!p.is_feature[i]) continue;
      const Index v = mesh.corner[h + i], w = mesh.corner[h + (i + 1) % 3];
      p.tangents[i] = {features.tangent(curve, v, w), features.tangent(curve, w, v)};
    }
    return p;
  }

  /// Position and normal at `l`; the normal is zero on curves and at corners, which have several.
  Surface_point evaluate(const Location& l) const
  {
    switch (l.kind) {
    case Vertex_class::smooth: return prepared_patch(l.cell).evaluate(l.u, l.v);
    case Vertex_class::curve: return {curve_point(l), Vector_3::Zero()};
    default: return {points[l.cell], Vector_3::Zero()};
    }
  }

  /// The normal and the shape operator at `l`, on curves those of one side: at vertices of the input what is given or
  /// estimated there. In between the normal is that of the patch, and the shape operator the mean of two, that of the
  /// patch and the one interpolated between the corners. Measured: over many runs the errors of the two nearly cancel,
  /// while with the latter alone it fades, and with the former alone the largest error is up to 3 times larger; where
  /// it is far off, as in needles, it does not count.
  internal::Jet jet(const Location& l) const
  {
    const Interpolation at = interpolation(l);
    for (std::size_t i = 0; i < 3; ++i)
      if (at.weights[i] == 1) return given_.at(at.vertices[i], jet_at(mesh.outgoing[at.vertices[i]]));
    if (l.kind == Vertex_class::curve) return jet(location_beside(at));
    const std::array<internal::Jet, 3> corners{jet_at(3 * l.cell), jet_at(3 * l.cell + 1), jet_at(3 * l.cell + 2)};
    const Vector_3 normal = evaluate(l).normal;
    internal::Jet mean = internal::mean_jet(corners, at.weights, normal.norm() > 0 ? normal : corners[0].normal);
    const Matrix_3 interpolated = mean.shape_operator.matrix(), of_patch = patch_shape_operator(l, mean.normal).matrix();
    constexpr double largest_change = 0.5;
    if ((of_patch - interpolated).norm() <= largest_change * interpolated.norm())
      mean.shape_operator = Metric_tensor_3((interpolated + of_patch) / 2);
    return mean;
  }

  /// The point of the input mesh itself, without its patches, at `l`.
  Vector_3 flat_point(const Location& l) const
  {
    const Interpolation i = interpolation(l);
    return i.weights[0] * points[i.vertices[0]] + i.weights[1] * points[i.vertices[1]] +
           i.weights[2] * points[i.vertices[2]];
  }

  /// That point with the normal between those of Max at the corners. \pre `l.kind` is smooth
  Surface_point flat_surface_point(const Location& l) const
  {
    const Index h = 3 * l.cell;
    const Vector_3 n = (1 - l.u - l.v) * normals.at(h) + l.u * normals.at(h + 1) + l.v * normals.at(h + 2);
    return {flat_point(l), n.normalized()};
  }

  /// The faces of the input over which a patch was asked for so far and is of lower order.
  template <class Execution>
  std::size_t number_of_fallbacks(const Execution& execution) const
  {
    return count_if(execution, mesh.number_of_faces(), [&](std::size_t f) {
      return has_fallback_[f].load(std::memory_order_relaxed);
    });
  }

  /// Moves `l` along the surface by the vector `d`: the straightest path over the faces of the reference that leaves
  /// in the direction of the projection of `d` onto the face of `l`, with the length of that projection, or of `d` if
  /// `keep_length`. The path ends early where it meets a feature or the boundary.
  /// \pre `l.kind` is smooth
  Location trace(const Location& l, const Vector_3& d, bool keep_length) const
  {
    Index f = l.cell;
    double b[3] = {1 - l.u - l.v, l.u, l.v};
    Face_frame frame = face_frame(f);
    if (!(frame.squared_double_area > 0)) return l;
    Vector_3 step = d - d.dot(frame.normal) / frame.squared_double_area * frame.normal;
    if (keep_length) {
      const double squared_length = step.squaredNorm();
      if (squared_length > 0) step *= std::sqrt(d.squaredNorm() / squared_length);
    }
    for (int crossings = 0; crossings < max_crossings; ++crossings) {
      const int exit = advance(frame, step, b);
      if (exit < 0) break;
      const Index h = 3 * f + Index((exit + 1) % 3);
      if (mesh.is_feature(h) || mesh.is_border(h)) break;
      const Index t = mesh.twin[h];
      const Face_frame next = face_frame(Mesh_view::face(t));
      if (!(next.squared_double_area > 0)) break;
      step = unfolded(step, (points[mesh.target(h)] - points[mesh.source(h)]).normalized(), frame, next);
      f = Mesh_view::face(t);
      frame = next;
      const double at_target = b[(exit + 2) % 3], at_source = b[(exit + 1) % 3];
      const int k = int(t % 3);
      b[k] = at_target;
      b[(k + 1) % 3] = at_source;
      b[(k + 2) % 3] = 0;
    }
    return {Vertex_class::smooth, f, b[1], b[2]};
  }

  /// A smooth location and the point there.
  struct Located_point
  {
    Location location;
    Surface_point point;
  };

  /// The location near `start` whose point is closest to `target`, found by walking: the residual is projected onto the
  /// tangent plane and traced, until it is shorter than `precision`. The nearest point of the way counts, and no step leads
  /// far away: where patches are much longer than their triangles, all of the residual would.
  /// \pre `start.location.kind` is smooth
  Located_point locate(const Located_point& start, const Vector_3& target, double precision) const
  {
    Located_point x = start, best = start;
    double share = 1; // of the residual
    for (int i = 0; i < max_corrections; ++i) {
      const Vector_3 d = target - x.point.position, normal = normal_of_walks(x), residual = d - d.dot(normal) * normal;
      if (residual.squaredNorm() <= precision * precision) break;
      const Location l = trace(x.location, share * residual, false);
      const Located_point next{l, evaluate(l)};
      const double distance2 = (next.point.position - target).squaredNorm();
      if (distance2 < (best.point.position - target).squaredNorm()) best = next;
      if (distance2 < largest_detour * largest_detour * d.squaredNorm()) x = next;
      else share /= 2;
    }
    return best;
  }

  /// Arc lengths on `curve` of two adjacent vertices on it: those of the ends of the shorter arc between them, so
  /// that the second may exceed the length of the curve or be negative on a closed curve.
  std::pair<double, double> arc(Index curve, const Location& a, const Location& b) const
  {
    const Feature_curve& c = features.curves[curve];
    const double sa = arc_position(c, a, b), sb = arc_position(c, b, a);
    if (!c.is_closed()) return {sa, sb};
    const double length = c.length();
    const double d = sb - sa;
    return {sa, d > length / 2 ? sb - length : d < -length / 2 ? sb + length : sb};
  }

  /// The location at arc length `s` of `curve`, which wraps around on a closed curve. The ends of an open one are
  /// corners, so `s` must lie inside.
  Location on_curve(Index curve, double s) const
  {
    const Feature_curve& c = features.curves[curve];
    if (c.is_closed()) s -= c.length() * std::floor(s / c.length());
    return {Vertex_class::curve, curve, s, 0};
  }

  /// Unit tangent at a location on a curve, in the direction of increasing arc length.
  Vector_3 curve_tangent(const Location& l) const
  {
    const Feature_curve& c = features.curves[l.cell];
    const std::size_t i = c.segment(l.u);
    const double t = c.parameter(i, l.u);
    return ((1 - t) * c.ends[i][0] + t * c.ends[i][1]).normalized();
  }

  /// Barycentric coordinates and vertices of the reference that `l` lies between: for what is interpolated linearly.
  struct Interpolation
  {
    std::array<Index, 3> vertices;
    std::array<double, 3> weights;
  };

  Interpolation interpolation(const Location& l) const
  {
    if (l.kind == Vertex_class::corner) return {{l.cell, l.cell, l.cell}, {1, 0, 0}};
    if (l.kind == Vertex_class::curve) {
      const Feature_curve& c = features.curves[l.cell];
      const std::size_t i = c.segment(l.u);
      const double t = c.parameter(i, l.u);
      return {{c.vertices[i], c.vertices[i + 1], c.vertices[i + 1]}, {1 - t, t, 0}};
    }
    const std::size_t h = 3 * std::size_t(l.cell);
    return {{mesh.corner[h], mesh.corner[h + 1], mesh.corner[h + 2]}, {1 - l.u - l.v, l.u, l.v}};
  }

  /// That of a curve in a coarse part where nothing else speaks for it: by half more than that of the largest regular chord, or
  /// a share of the part.
  double doubtful_bulge() const
  {
    constexpr double share_of_diagonal = 0.005, share_of_sag = 1.5;
    const double least = share_of_diagonal * internal::diagonal_of_bounding_box(points), sag = share_of_sag * features.facets.sag;
    return std::isfinite(sag) ? (std::max)(least, sag) : least;
  }

private:
  using Cache = internal::Patch_cache<Reconstruction>;

  const typename Cache::Prepared& prepared_patch(Index f) const
  {
    return Cache::at(id_, f, [&] { return patch(f); }, [&](const auto& prepared) {
      if (internal::has_fallback(prepared, 0)) has_fallback_[f].store(true, std::memory_order_relaxed);
    });
  }

  void limit_bulge(Patch& p, Index f) const
  {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index h = 3 * f + Index(i);
      const double asked = largest_bulge_of_edge(largest_bulge_, mesh.source(h), mesh.target(h));
      const double limit = is_doubtful(p, i) ? (std::min)(asked, largest_doubtful_bulge_) : asked;
      p.largest_bulge_of_edge[i] = limit;
      p.largest_bulge = (std::min)(p.largest_bulge, 4 * limit / 3); // so an inside bulges over edges that do so
    }
  }

  /// Whether the curve over edge `i` bulges by much, and the curvatures at its ends are not those of an arc that does so. Where
  /// none is known, regular chords tell.
  bool is_doubtful(const Patch& p, std::size_t i) const
  {
    constexpr double largest_ratio = 1.5;
    const double bulge = largest_doubtful_bulge_ < infinity ? this->bulge(p, i) : 0;
    if (bulge <= largest_doubtful_bulge_) return false;
    const std::size_t j = (i + 1) % 3;
    if (!p.has_shape_operator[i] && !p.has_shape_operator[j])
      return features.facets.are_decimated || !std::isfinite(features.facets.sag);
    const auto agrees = [&](std::size_t k) {
      return !p.has_shape_operator[k] || internal::are_alike(bulge_of_fit(p, i, k), bulge, largest_ratio);
    };
    return !(agrees(i) && agrees(j));
  }

  /// How far the arc over edge `i` with the curvature that the fit at corner `k` has along it is off its middle.
  static double bulge_of_fit(const Patch& p, std::size_t i, std::size_t k)
  {
    const Vector_3 e = p.points[(i + 1) % 3] - p.points[i];
    return std::abs(e.dot(p.shape_operators[k] * e)) / 8;
  }

  static void flatten(Patch& p, const Vector_3& normal)
  {
    p.normals = {normal, normal, normal};
    p.has_shape_operator = {};
  }

  /// By so much may patches leave the facets of a tessellation where no fits know better.
  double largest_bulge() const { return internal::largest_bulge_of_facets * features.facets.sag; }

  static bool is_fitted(const Patch& p)
  {
    return p.has_shape_operator[0] && p.has_shape_operator[1] && p.has_shape_operator[2];
  }

  /// Whether the patches `p` and its neighbour meet along the chord of their common edge `i`, which has the halfedge
  /// `h`: at planes, and where the curve would be off it by a large part of their heights and no fit agrees with that.
  bool is_straight(Index h, const Patch& p, std::size_t i) const
  {
    const Index t = mesh.twin[h];
    if (t == no_index || mesh.is_shaped(h)) return false;
    if (is_plane(Mesh_view::face(h)) || is_plane(Mesh_view::face(t))) return true;
    const std::size_t j = (i + 1) % 3;
    if (p.has_shape_operator[i] && p.has_shape_operator[j]) return false;
    const double height = (std::min)(least_height(Mesh_view::face(h)), least_height(Mesh_view::face(t)));
    constexpr double least_doubtful = 0.5, least_doubtful_of_facets = 0.25; // of the height: an icosahedron has .16
    return bulge(p, i) > (features.facets.are_chords() ? least_doubtful_of_facets : least_doubtful) * height;
  }

  /// Whether the normals at the ends of edge `i`, the halfedge `h`, say more of a bulge than chords of a tessellation have,
  /// and no fit does, or none counts.
  bool bulges_too_far(Index h, const Patch& p, std::size_t i) const
  {
    if (!features.facets.are_chords() || mesh.is_shaped(h)) return false;
    const double bulge = this->bulge(p, i);
    return bulge > largest_bulge() && (features.facets.are_decimated || !agrees_with_fit(p, i, bulge));
  }

  /// Whether the fits at both ends of edge `i` are known, or the curvature of one of them is that of an arc with this bulge.
  static bool agrees_with_fit(const Patch& p, std::size_t i, double bulge)
  {
    constexpr double largest_ratio = 1.2;
    const std::size_t j = (i + 1) % 3;
    if (p.has_shape_operator[i] == p.has_shape_operator[j]) return p.has_shape_operator[i];
    return internal::are_alike(bulge_of_fit(p, i, p.has_shape_operator[i] ? i : j), bulge, largest_ratio);
  }

  /// How far the curve that the normals say is off the middle of edge `i`.
  static double bulge(const Patch& p, std::size_t i)
  {
    const std::size_t j = (i + 1) % 3;
    return internal::bulge(internal::smooth_handles(p.points[j] - p.points[i], p.normals[i], p.normals[j])).norm();
  }

  double least_height(Index f) const
  {
    const Face_frame frame = face_frame(f);
    const double longest2 =
      (std::max)({frame.e1.squaredNorm(), frame.e2.squaredNorm(), (frame.e2 - frame.e1).squaredNorm()});
    return longest2 > 0 ? std::sqrt(frame.squared_double_area / longest2) : 0;
  }

  internal::Jet jet_at(Index h) const
  {
    return jets_.at(normals.of_corner[h], [&] {
      return internal::estimate_jet(mesh, points, features, normals, given_, h);
    });
  }

  /// A place on a curve as one of a face beside it.
  Location location_beside(const Interpolation& at) const
  {
    Index h = mesh.halfedge(at.vertices[0], at.vertices[1]);
    double t = at.weights[1]; // along `h`
    if (h == no_index) {
      h = mesh.halfedge(at.vertices[1], at.vertices[0]);
      t = at.weights[0];
    }
    return location_on_edge(h, t);
  }

  /// The shape operator of the patch at `l`, where it has the normal `normal`, from a small triangle around.
  Metric_tensor_3 patch_shape_operator(const Location& l, const Vector_3& normal) const
  {
    constexpr double size = 1e-3; // of that of the face: what is left is of that order, rounding far below
    const auto& patch = prepared_patch(l.cell);
    std::array<Vector_3, 3> points_around, normals_around;
    for (std::size_t i = 0; i < 3; ++i) {
      const Surface_point p =
        patch.evaluate((1 - size) * l.u + (i == 1 ? size : 0), (1 - size) * l.v + (i == 2 ? size : 0));
      points_around[i] = p.position;
      normals_around[i] = p.normal;
    }
    const Vector_3 across = (points_around[1] - points_around[0]).cross(points_around[2] - points_around[0]);
    return rotated(internal::shape_operator_of_face(points_around, normals_around),
                   minimal_rotation(across.normalized(), normal));
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int max_crossings = 256; // a path this long means a metric far coarser than the reference
  static constexpr double largest_detour = 1.2; // of distances in a step: over a bend they may grow
  static constexpr int max_corrections = 4; // each one squares the error of a smooth surface

  struct Face_frame
  {
    Vector_3 e1, e2, normal; // of length: twice the area
    double squared_double_area;
  };

  Face_frame face_frame(Index f) const
  {
    const std::size_t h = 3 * std::size_t(f);
    const Vector_3& p = points[mesh.corner[h]];
    Face_frame frame;
    frame.e1 = points[mesh.corner[h + 1]] - p;
    frame.e2 = points[mesh.corner[h + 2]] - p;
    frame.normal = frame.e1.cross(frame.e2);
    frame.squared_double_area = frame.normal.squaredNorm();
    return frame;
  }

  /// `step` turned about the common edge from the plane of `from` into that of `to`.
  static Vector_3 unfolded(const Vector_3& step, const Vector_3& edge, const Face_frame& from, const Face_frame& to)
  {
    const double across = step.dot(edge.cross(from.normal)) / std::sqrt(from.squared_double_area * to.squared_double_area);
    return step.dot(edge) * edge + across * edge.cross(to.normal);
  }

  /// Along which walks do not count distances: where triangles are the surface, their own, for normals that are
  /// interpolated are far off beside bends that are no features.
  Vector_3 normal_of_walks(const Located_point& x) const
  {
    if constexpr (is_flat)
      return face_frame(x.location.cell).normal.normalized();
    else
      return x.point.normal;
  }

  /// Moves `b` by `step`, or to the border of the face: then `step` is shortened by what was used and the corner
  /// opposite to the edge that was met is returned, else -1.
  static int advance(const Face_frame& frame, Vector_3& step, double (&b)[3])
  {
    const double d1 = step.cross(frame.e2).dot(frame.normal) / frame.squared_double_area;
    const double d2 = frame.e1.cross(step).dot(frame.normal) / frame.squared_double_area;
    const double db[3] = {-d1 - d2, d1, d2};
    double s = 1;
    int exit = -1;
    for (int i = 0; i < 3; ++i) {
      if (db[i] >= 0 || b[i] + db[i] >= 0) continue;
      const double si = b[i] / -db[i];
      if (si < s) {
        s = si;
        exit = i;
      }
    }
    for (int i = 0; i < 3; ++i) b[i] = (std::max)(0.0, b[i] + s * db[i]);
    if (exit >= 0) b[exit] = 0;
    const double sum = b[0] + b[1] + b[2];
    for (double& x : b) x /= sum;
    step *= 1 - s;
    return exit;
  }

  Vector_3 curve_point(const Location& l) const
  {
    if (mesh.curves.is_drawn(l.cell)) return evaluate(location_beside(interpolation(l))).position;
    const Feature_curve& c = features.curves[l.cell];
    const std::size_t i = c.segment(l.u);
    return Reconstruction::evaluate_curve(points[c.vertices[i]], points[c.vertices[i + 1]], c.ends[i][0],
                                          c.ends[i][1], c.parameter(i, l.u));
  }

  /// The arc length of `a` on `c`; a corner is at the end that is nearer to its neighbour `b`.
  double arc_position(const Feature_curve& c, const Location& a, const Location& b) const
  {
    if (a.kind == Vertex_class::curve) return a.u;
    const bool first = c.vertices.front() == a.cell, last = c.vertices.back() == a.cell;
    if (first && last) return b.kind == Vertex_class::curve && b.u > c.length() / 2 ? c.length() : 0;
    return last ? c.length() : 0;
  }

  std::vector<double> largest_bulge_; // of curves over the edges that end at a vertex; empty: any
  double largest_doubtful_bulge_;     // where fits do not agree with it
  internal::Given_jets given_;
  internal::Lazy_jets jets_;
  std::unique_ptr<std::atomic<bool>[]> has_fallback_; ///< of the faces whose patches were asked for
  std::uint64_t id_ = internal::unique_surface_id();
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_REFERENCE_SURFACE_H

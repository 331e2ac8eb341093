// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fitting: moves the vertices of a mesh off the reference so that its faces run through the points that they stand for
// instead of touching them from one side: with vertices on the surface, faces of edge length h are up to h^2 k / 6 and on
// average h^2 k / 8 inside of it where both curvatures are k, and fitted ones within h^2 k / 8 on both sides and 0 on
// average. Those are `Represented_points` of a simplified mesh or `Sampled_points` of an adapted one.
//
// Least squares over these points of their distance from the faces, in the direction of the closest point: damped block
// Jacobi steps of Gauss-Newton, with a share of the last one. Where on the surface a vertex comes to lie, the points decide
// at bends of the input, along which edges come to run, and elsewhere what it is attracted to.
//
// Conflict neighbourhood: none. Phases: faces (normal equations of their corners), vertices (step), faces (limits).
// Invariants: connectivity and locations; corners stay; no face comes to violate a limit, turns by more than 60 degrees or
// gets worse below a quality; the largest distance does not grow.
// Work: O(points) a sweep; span: the points of a face.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_FITTING_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_FITTING_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/centering.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Cholesky.h>
#include <CGAL/Surface_mesh_adaptation/numerics/closest_point.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Fitting_thresholds
{
  double attraction;         ///< of a vertex to where it is, of that to the points
  double min_quality = 0;    ///< no face below gets worse
  bool is_centering = false; ///< smooth vertices are attracted to the centre of their faces: that keeps these in shape
};

template <class Surface, class Execution, class Points>
class Fitting
{
public:
  Fitting(const Execution& execution, Surface& surface, const Points& points, const Fitting_thresholds& thresholds)
    : execution_(execution), surface_(surface), mesh_(surface.mesh), target_(points), thresholds_(thresholds)
  {}

  /// Steps of all vertices, none of which takes a point nearly as far from its face as the farthest one is; `renew` is
  /// called between them, and may find other points for the faces. Returns the number of vertices moved.
  template <class Renew>
  std::size_t sweep(int steps, const Renew& renew)
  {
    max_distance_ = share_of_largest * target_.largest_distance(execution_);
    places_ = surface_.points;
    before_ = surface_.points;
    for (int i = 0; i < steps && !is_stopped(execution_); ++i) {
      if (i > 0) renew();
      step();
    }
    take_back(places_, [&](Index f) { return is_bad(f, places_) || (surface_.tolerance && !keeps_tolerance(f)); });
    return count_if(execution_, mesh_.number_of_vertices(), [&](std::size_t v) { return surface_.points[v] != places_[v]; });
  }

private:
  void step()
  {
    equations_.resize(mesh_.number_of_halfedges());
    for_each_index(execution_, mesh_.number_of_faces(), [&](std::size_t f) {
      if (!mesh_.is_removed_face(Index(f)) && !is_stopped(execution_)) assemble(Index(f));
    }, heavy_chunk_length);
    std::swap(last_, before_);
    before_ = surface_.points;
    for_each_index(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
      if (mesh_.is_removed_vertex(Index(v)) || surface_.vertex_class(Index(v)) == Vertex_class::corner) return;
      if (!is_stopped(execution_)) step(Index(v));
    }, heavy_chunk_length);
    take_back(before_, [&](Index f) { return is_bad(f, before_); });
  }

  struct Equations
  {
    Matrix_3 matrix = Matrix_3::Zero();
    Vector_3 right_side = Vector_3::Zero();
  };

  /// What the points of `f` ask of each of its corners while the two others stay.
  void assemble(Index f)
  {
    std::array<Equations, 3> of_corner;
    const Vector_3 normal = surface_.normal(3 * f);
    target_.for_each_point(f, [&](const internal::Closest_point& closest, double weight) {
      const double distance = closest.offset.norm();
      const bool is_inside = *std::min_element(closest.weights.begin(), closest.weights.end()) > 0;
      const Vector_3 direction = is_inside || !(distance > 0) ? normal : closest.offset / distance;
      const double residual = direction.dot(closest.offset);
      for (std::size_t i = 0; i < 3; ++i) {
        const double w = weight * closest.weights[i];
        of_corner[i].matrix += internal::outer_product(w * closest.weights[i] * direction, direction);
        of_corner[i].right_side += w * residual * direction;
      }
    });
    for (std::size_t i = 0; i < 3; ++i) equations_[3 * std::size_t(f) + i] = of_corner[i];
  }

  void step(Index v)
  {
    Equations e;
    mesh_.for_each_outgoing(v, [&](Index h) {
      e.matrix += equations_[h].matrix;
      e.right_side += equations_[h].right_side;
    });
    const double pull = thresholds_.attraction * e.matrix.trace();
    if (!(pull > 0)) return;
    if (thresholds_.is_centering && surface_.vertex_class(v) == Vertex_class::smooth)
      e.right_side += pull * to_center(v);
    const internal::Cholesky<3> factors(internal::shifted(e.matrix, pull));
    const Vector_3 d = damping * factors.solve(e.right_side) + momentum * (before_[v] - last_[v]);
    if (!d.allFinite()) return;
    const double length = d.norm(), longest = max_move * max_distance_;
    surface_.points[v] += length > longest ? longest / length * d : d;
  }

  /// From where the smooth vertex `v` was before the step.
  Vector_3 to_center(Index v) const
  {
    const auto& metrics = surface_.metrics;
    return displacement_to_center(before_[v], surface_.normals[v], metrics[v], [&](const auto& add) {
      mesh_.for_each_outgoing(v, [&](Index h) {
        const Index a = mesh_.target(h), b = mesh_.apex(h);
        add(before_[a], metrics[a], before_[b], metrics[b]);
      });
    });
  }

  /// Takes half of their way since `before` back from the corners of the faces that have become bad, a few times, then all
  /// of it, until there are none: a face with no corner away from there counts as good.
  template <class IsBad>
  void take_back(const Buffer<Vector_3>& before, const IsBad& is_bad)
  {
    is_bad_.resize(mesh_.number_of_faces());
    fill(execution_, is_changed_, mesh_.number_of_vertices(), std::uint8_t(1));
    const auto find_bad = [&] {
      return count_if(execution_, mesh_.number_of_faces(), [&](std::size_t f) {
        return is_bad_[f] = !mesh_.is_removed_face(Index(f)) && is_changed(Index(f)) && has_moved(Index(f), before) &&
                            is_bad(Index(f));
      });
    };
    for (int i = 0; find_bad() > 0; ++i)
      for_each_index(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
        is_changed_[v] = has_bad_face(Index(v));
        if (is_changed_[v])
          surface_.points[v] = i < max_halvings ? (surface_.points[v] + before[v]) / 2 : before[v];
      });
  }

  bool has_bad_face(Index v) const
  {
    bool result = false;
    if (!mesh_.is_removed_vertex(v))
      mesh_.for_each_outgoing(v, [&](Index h) { result = result || is_bad_[Mesh_view::face(h)] != 0; });
    return result;
  }

  bool has_moved(Index f, const Buffer<Vector_3>& before) const
  {
    const std::array<Index, 3> v = corners(f);
    return std::any_of(v.begin(), v.end(), [&](Index w) { return surface_.points[w] != before[w]; });
  }

  /// Whether it may have become bad, or good, since it was last looked at.
  bool is_changed(Index f) const
  {
    const std::array<Index, 3> v = corners(f);
    return is_changed_[v[0]] != 0 || is_changed_[v[1]] != 0 || is_changed_[v[2]] != 0;
  }

  /// Whether a face turned far, became worse than is allowed or came to violate a limit.
  bool is_bad(Index f, const Buffer<Vector_3>& before) const
  {
    const auto [a, b, c] = corners(f);
    const Vector_3 old = (before[b] - before[a]).cross(before[c] - before[a]);
    return surface_.normal(3 * f).dot(old) < min_turn * old.norm() || loses_quality(f, before) ||
           !target_.are_within_limits(f, max_distance_);
  }

  bool loses_quality(Index f, const Buffer<Vector_3>& before) const
  {
    const auto [a, b, c] = corners(f);
    if (surface_.has_quality(a, b, c, thresholds_.min_quality)) return false;
    const auto& m = surface_.metrics;
    return surface_.quality(a, b, c) < face_quality(m[a], m[b], m[c], before[b] - before[a], before[c] - before[a]);
  }

  bool keeps_tolerance(Index f) const
  {
    const auto [a, b, c] = corners(f);
    return surface_.tolerance->is_kept(surface_.corner(a), surface_.corner(b), surface_.corner(c), max_pieces_of_face);
  }

  std::array<Index, 3> corners(Index f) const
  {
    const std::size_t h = 3 * std::size_t(f);
    return {mesh_.corner[h], mesh_.corner[h + 1], mesh_.corner[h + 2]};
  }

  static constexpr double share_of_largest = 0.95; // faces that reach it stay: the largest distance does not grow
  static constexpr double max_move = 0.5;   // of a vertex in a step, in largest distances
  static constexpr double damping = 0.8;    // the block Jacobi iteration has eigenvalues from 1/2 to 2
  static constexpr double momentum = 0.3;
  static constexpr double min_turn = 0.5;
  static constexpr int max_halvings = 3;    // of a way that makes a face bad

  const Execution& execution_;
  Surface& surface_;
  const Mesh_view& mesh_;
  const Points& target_;
  Fitting_thresholds thresholds_;
  double max_distance_ = 0;
  Buffer<Vector_3> places_, last_, before_; ///< at the start of the sweep, of the last step, of this one
  Buffer<Equations> equations_;
  Buffer<std::uint8_t> is_bad_, is_changed_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_FITTING_H

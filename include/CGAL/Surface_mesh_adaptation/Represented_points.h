// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of the reference that the faces of a simplified mesh stand for: of each face of the input its corners, the
// middles of its edges and its centroid. A collapse hands the points of the faces that it changes on to the nearest of
// the new ones. So what is known of distances and normals is measured, however many collapses there were.
//
// Each face has a list of its points, linked through them. Points at features are there once for each side and stay
// with it: a face of another side may be nearer and yet say nothing about theirs.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_REPRESENTED_POINTS_H
#define CGAL_SURFACE_MESH_ADAPTATION_REPRESENTED_POINTS_H

#include <CGAL/Surface_mesh_adaptation/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/internal/closest_point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// How far a face may be from what it stands for.
struct Deviation_limits
{
  double distance = std::numeric_limits<double>::infinity();  ///< of each point from the face
  double min_cosine = -1;                                     ///< between its normal and those of the input
};

template <class Surface>
class Represented_points
{
public:
  static constexpr double too_much = std::numeric_limits<double>::infinity();

  /// The faces of `surface` stand for themselves. Work: O(n).
  template <class Execution>
  Represented_points(const Execution& execution, const Surface& surface, const Deviation_limits& limits)
    : surface_(surface), mesh_(surface.mesh), limits_(limits)
  {
    const std::size_t n = mesh_.number_of_faces();
    first_.resize(n);
    normals_.resize(n);
    Buffer<Index> offset;
    const std::size_t others = exclusive_scan(execution, n, offset, [&](std::size_t f) {
      Index count = 0;
      for_each_other_point(Index(f), [&](double, double, double) { ++count; });
      return count;
    });
    next_.resize(n + others);
    points_.resize(n + others);
    weights_.resize(n + others);
    for_each_index(execution, n, [&](std::size_t f) {
      normals_[f] = surface_.normal(Index(3 * f));
      first_[f] = no_index;
      Index i = Index(n) + offset[f];
      for_each_other_point(Index(f), [&](double u, double v, double weight) { add(i++, Index(f), u, v, weight); });
      add(Index(f), Index(f), 1.0 / 3, 1.0 / 3, 9.0 / 20 * area(Index(3 * f)));
    }, heavy_chunk_length);
  }

  /// How far the collapse of `e` takes the points around the vanishing vertex from their faces: between the largest
  /// distance, which large faces decide, and the mean square over the area, which many do: their geometric mean.
  /// `too_much` if a limit is exceeded or the cost reaches `enough`.
  double cost(const Mesh_view::Directed_edge& e, double enough) const
  {
    const Star star(surface_, e);
    const double product_limit = enough * enough * (enough * enough);
    double largest = 0, sum = 0;
    for (const Side_face& old : star.old_faces)
      for (Index i = first_[old.face]; i != no_index; i = next_[i]) {
        const auto nearest = star.nearest(points_[i], old.side);
        if (nearest.first == nullptr || !is_within_limits(i, nearest.first->normal, nearest.second)) return too_much;
        largest = (std::max)(largest, nearest.second);
        sum += weights_[i] * nearest.second;
        if (largest * sum >= product_limit) return too_much;
      }
    return std::sqrt(std::sqrt(largest * sum));
  }

  /// Hands the points around the vanishing vertex of `e` on. Writes the lists of the faces there.
  /// \pre the cost of `e` is within the limits, and `e` is still to be collapsed
  void hand_over(const Mesh_view::Directed_edge& e)
  {
    const Star star(surface_, e);
    Ring<std::pair<Index, Index>> moves;
    for (const Side_face& old : star.old_faces) {
      for (Index i = first_[old.face]; i != no_index; i = next_[i])
        moves.emplace_back(i, star.nearest(points_[i], old.side).first->face);
      first_[old.face] = no_index;
    }
    for (const auto& m : moves) link(m.first, m.second);
  }

  /// Whether all points of face `f` are within the limits.
  bool are_within_limits(Index f) const
  {
    const std::array<Vector_3, 3> p = corners(f);
    const Vector_3 normal = surface_.normal(3 * f);
    for (Index i = first_[f]; i != no_index; i = next_[i])
      if (!is_within_limits(i, normal, internal::closest_point_of_triangle(points_[i], p[0], p[1], p[2]).offset.squaredNorm()))
        return false;
    return true;
  }

  /// Calls `g(closest, weight)` for the points of face `f`.
  template <class G>
  void for_each_point(Index f, const G& g) const
  {
    const std::array<Vector_3, 3> p = corners(f);
    for (Index i = first_[f]; i != no_index; i = next_[i])
      g(internal::closest_point_of_triangle(points_[i], p[0], p[1], p[2]), weights_[i]);
  }

private:
  struct Side_face
  {
    Index face;
    int side;
  };

  struct New_face : Side_face
  {
    std::array<Vector_3, 3> corners;
    Vector_3 normal;
  };

  /// The faces around a vertex before and after its collapse, and on which side of the curve through it they are.
  struct Star
  {
    Ring<Side_face> old_faces;
    Ring<New_face> new_faces;

    Star(const Surface& surface, const Mesh_view::Directed_edge& e)
    {
      const Mesh_view& mesh = surface.mesh;
      const Index s = mesh.vanishing_vertex(e), d = mesh.kept_vertex(e), first = mesh.outgoing[s];
      int side = 0, sides = 0;
      mesh.for_each_outgoing(s, [&](Index h) { sides += mesh.is_feature(h) ? 1 : 0; });
      const bool is_closed = !mesh.is_border(first);
      mesh.for_each_outgoing(s, [&](Index h) {
        if (h != first && mesh.is_feature(h)) ++side;
        // around a closed fan, what comes before the first feature edge is on the side of the last
        const int own = is_closed && !mesh.is_feature(first) && side == sides ? 0 : side;
        const Index f = Mesh_view::face(h), x = mesh.target(h), y = mesh.apex(h);
        old_faces.push_back({f, own});
        if (x == d || y == d) return;
        const Vector_3 &p = surface.points[d], &q = surface.points[x], &r = surface.points[y];
        new_faces.push_back({{f, own}, {p, q, r}, surface.normal(d, x, y)});
      });
    }

    /// The nearest new face on `side`, or null, and the squared distance.
    std::pair<const New_face*, double> nearest(const Vector_3& p, int side) const
    {
      std::pair<const New_face*, double> best{nullptr, too_much};
      for (const New_face& f : new_faces) {
        if (f.side != side) continue;
        const auto closest = internal::closest_point_of_triangle(p, f.corners[0], f.corners[1], f.corners[2]);
        const double squared_distance = closest.offset.squaredNorm();
        if (squared_distance < best.second) best = {&f, squared_distance};
      }
      return best;
    }
  };

  /// Only the centroids, of which the numbers are those of their faces, know a normal.
  bool is_within_limits(Index i, const Vector_3& normal, double squared_distance) const
  {
    if (squared_distance > limits_.distance * limits_.distance) return false;
    return i >= normals_.size() || normals_[i] == Vector_3::Zero() || normals_[i].dot(normal) >= limits_.min_cosine;
  }

  /// Calls `g(u, v, weight)` for the corners and middles of edges that are listed with face `f`, each of which is
  /// listed once for each side. The weights, with 9/20 for the centroid, integrate cubic functions over a triangle.
  template <class G>
  void for_each_other_point(Index f, const G& g) const
  {
    for (Index i = 0; i < 3; ++i) {
      const Index h = 3 * f + i, t = mesh_.twin[h];
      const bool has_two_sides = mesh_.is_feature(h) || t == no_index;
      if (has_two_sides || mesh_.is_edge_owner(h)) {
        const double weight = 2.0 / 15 * (area(h) + (has_two_sides ? 0 : area(t)));
        g(i == 2 ? 0 : 0.5, i == 0 ? 0 : 0.5, weight);
      }
      if (leads_its_side(h)) g(i == 1 ? 1 : 0, i == 2 ? 1 : 0, 1.0 / 20 * area_of_side(h));
    }
  }

  /// Whether `h` is the first halfedge of its side of the curves through its source.
  bool leads_its_side(Index h) const
  {
    if (mesh_.is_feature(h)) return true;
    const Index v = mesh_.source(h);
    if (mesh_.outgoing[v] != h) return false;
    bool is_on_curve = false;
    mesh_.for_each_outgoing(v, [&](Index o) { is_on_curve = is_on_curve || mesh_.is_feature(o); });
    return !is_on_curve;
  }

  double area_of_side(Index h) const
  {
    double sum = 0;
    for (Index o = h;;) {
      sum += area(o);
      o = mesh_.rotated_ccw(o);
      if (o == no_index || o == h || mesh_.is_feature(o)) return sum;
    }
  }

  double area(Index h) const
  {
    const std::array<Vector_3, 3> p = corners(Mesh_view::face(h));
    return (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
  }

  std::array<Vector_3, 3> corners(Index f) const
  {
    const std::size_t h = 3 * std::size_t(f);
    return {surface_.points[mesh_.corner[h]], surface_.points[mesh_.corner[h + 1]], surface_.points[mesh_.corner[h + 2]]};
  }

  void add(Index i, Index f, double u, double v, double weight)
  {
    points_[i] = surface_.reference().evaluate({Vertex_class::smooth, f, u, v}).position;
    weights_[i] = weight;
    link(i, f);
  }

  void link(Index i, Index f)
  {
    next_[i] = first_[f];
    first_[f] = i;
  }

  const Surface& surface_;
  const Mesh_view& mesh_;
  Deviation_limits limits_;
  Buffer<Index> first_;      // of each face
  Buffer<Index> next_;       // of each point
  Buffer<Vector_3> points_;
  Buffer<double> weights_;
  Buffer<Vector_3> normals_; // of the faces of the input
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_REPRESENTED_POINTS_H

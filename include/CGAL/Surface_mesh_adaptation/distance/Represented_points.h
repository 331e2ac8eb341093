// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of the reference that the faces of a simplified mesh stand for: of each face of the input its corners, its
// centroid and a point towards each corner. A collapse hands the points of the faces that it changes on to the new ones.
// So what is known of distances and normals is measured, however many collapses there were.
//
// Each face has a list of its points, linked through them. Points at features are there once for each side and stay
// with it: a face of another side may be nearer and yet say nothing about theirs.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_REPRESENTED_POINTS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_REPRESENTED_POINTS_H

#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Merged_star.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Point_lists.h>
#include <CGAL/Surface_mesh_adaptation/numerics/closest_point.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

/// Which limit is exceeded.
enum class Excess { none, distance, normal };

/// How far faces are from what they stand for.
struct Deviation
{
  Excess excess = Excess::none;
  double squared_distance = 0; ///< the largest of a point, where no limit is exceeded
};

template <class Surface>
class Represented_points
{
public:
  /// The faces of `surface` stand for themselves. Work: O(n).
  template <class Execution>
  Represented_points(const Execution& execution, const Surface& surface, const Deviation_limits& limits)
    : surface_(surface), mesh_(surface.mesh), limits_(limits)
  {
    const std::size_t n = mesh_.number_of_faces();
    normals_.resize(n);
    Buffer<Index> offset;
    const std::size_t corners = exclusive_scan(execution, n, offset, [&](std::size_t f) {
      Index count = 0;
      for_each_listed_corner(Index(f), [&](Index, double, double) { ++count; });
      return count;
    });
    const std::size_t size = n + corners + 3 * n;
    lists_.resize(n, size);
    points_.resize(size);
    weights_.resize(size);
    for_each_index(execution, n, [&](std::size_t f) {
      normals_[f] = surface_.normal(Index(3 * f));
      lists_.first[f] = no_index;
      Index i = Index(n) + offset[f];
      for_each_listed_corner(Index(f), [&](Index h, double u, double v) {
        add(i++, Index(f), u, v, weight_of_corner * area_of_side(h));
      });
      const double face_area = area(Index(3 * f));
      add(Index(f), Index(f), 1.0 / 3, 1.0 / 3, weight_of_centroid * face_area);
      for (Index k = 0; k < 3; ++k)
        add(Index(n + corners + 3 * f) + k, Index(f), k == 1 ? 2.0 / 3 : 1.0 / 6, k == 2 ? 2.0 / 3 : 1.0 / 6,
            weight_of_inner_point * face_area);
    }, heavy_chunk_length);
  }

  /// That of the faces of `star` if its edge is collapsed and the vertex that is kept comes to be at `p`.
  Deviation deviation(const Merged_star& star, const Vector_3& p) const
  {
    const New_faces faces = new_faces(star, p);
    std::size_t hint = 0;
    Deviation d;
    for (const Merged_star::Face& old : star.faces())
      for (Index i = lists_.first[Mesh_view::face(old.halfedge)]; i != no_index; i = lists_.next[i]) {
        const auto nearest = faces.nearest(points_[i], old.side, hint);
        if (nearest.first == nullptr || nearest.second > limits_.distance * limits_.distance)
          return {Excess::distance};
        if (!is_normal_within_limits(i, nearest.first->normal())) return {Excess::normal};
        d.squared_distance = (std::max)(d.squared_distance, nearest.second);
      }
    return d;
  }

  /// Whether a vertex may be that far from the surface.
  bool is_within_distance(const Vector_3& way) const
  {
    return way.squaredNorm() <= limits_.distance * limits_.distance;
  }

  /// Hands the points of the faces of `star` on. Writes the lists of these faces.
  /// \pre they are within the limits, and the edge is still to be collapsed
  void hand_over(const Merged_star& star, const Vector_3& p)
  {
    const New_faces faces = new_faces(star, p);
    std::size_t hint = 0;
    Ring<std::pair<Index, Index>> moves;
    for (const Merged_star::Face& old : star.faces()) {
      Index& first = lists_.first[Mesh_view::face(old.halfedge)];
      for (Index i = first; i != no_index; i = lists_.next[i])
        moves.emplace_back(i, faces.nearest(points_[i], old.side, hint).first->face);
      first = no_index;
    }
    for (const auto& m : moves) lists_.link(m.first, m.second);
  }

  /// Whether all points of face `f` are within the limits and no further away than `max_distance`.
  bool are_within_limits(Index f, double max_distance) const
  {
    const internal::Prepared_triangle face(corners(f));
    const Vector_3 normal = face.normal();
    const double limit = (std::min)(limits_.distance, max_distance);
    for (Index i = lists_.first[f]; i != no_index; i = lists_.next[i])
      if (face.squared_distance(points_[i]).squared > limit * limit || !is_normal_within_limits(i, normal))
        return false;
    return true;
  }

  /// The largest distance of a point from its face.
  template <class Execution>
  double largest_distance(const Execution& execution) const
  {
    return std::sqrt(reduce(execution, mesh_.number_of_faces(), 0.0, [&](std::size_t f) {
      if (mesh_.is_removed_face(Index(f))) return 0.0;
      const internal::Prepared_triangle face(corners(Index(f)));
      double largest = 0;
      for (Index i = lists_.first[f]; i != no_index; i = lists_.next[i])
        largest = (std::max)(largest, face.squared_distance(points_[i]).squared);
      return largest;
    }, [](double a, double b) { return (std::max)(a, b); }));
  }

  /// Calls `g(closest, weight)` for the points of face `f`.
  template <class G>
  void for_each_point(Index f, const G& g) const
  {
    const std::array<Vector_3, 3> p = corners(f);
    for (Index i = lists_.first[f]; i != no_index; i = lists_.next[i])
      g(internal::closest_point_of_triangle(points_[i], p[0], p[1], p[2]), weights_[i]);
  }

private:
  static constexpr double none = std::numeric_limits<double>::infinity();
  // exact for quadratic functions
  static constexpr double weight_of_corner = 1.0 / 40, weight_of_centroid = 9.0 / 40, weight_of_inner_point = 7.0 / 30;

  /// A face as it will be.
  struct New_face : internal::Prepared_triangle
  {
    Index face;
    int side;
  };

  struct New_faces
  {
    Ring<New_face> faces;

    /// A face on `side` that `p` lies above, or else the nearest one, or null if there is none there; and the squared
    /// distance. What is above one face could be nearer to another only at a fold.
    /// The search starts at `hint`, which is set: points that follow each other are mostly above the same face.
    std::pair<const New_face*, double> nearest(const Vector_3& p, int side, std::size_t& hint) const
    {
      std::pair<const New_face*, double> best{nullptr, none};
      for (std::size_t n = faces.size(), i = hint; n > 0; --n, i = i + 1 < faces.size() ? i + 1 : 0) {
        const New_face& f = faces[i];
        if (f.side != side) continue;
        const auto [squared_distance, is_above] = f.squared_distance(p);
        if (is_above) {
          hint = i;
          return {&f, squared_distance};
        }
        if (squared_distance < best.second) best = {&f, squared_distance};
      }
      return best;
    }
  };

  New_faces new_faces(const Merged_star& star, const Vector_3& p) const
  {
    New_faces result;
    for (const Merged_star::Face& f : star.faces()) {
      if (f.vanishes) continue;
      const Vector_3 &q = surface_.points[mesh_.target(f.halfedge)], &r = surface_.points[mesh_.apex(f.halfedge)];
      result.faces.push_back({internal::Prepared_triangle({p, q, r}), Mesh_view::face(f.halfedge), f.side});
    }
    return result;
  }

  /// Only the centroids, of which the numbers are those of their faces, know a normal.
  bool is_normal_within_limits(Index i, const Vector_3& normal) const
  {
    return i >= normals_.size() || normals_[i] == Vector_3::Zero() || normals_[i].dot(normal) >= limits_.min_cosine;
  }

  /// Calls `g(h, u, v)` for the corners, sources of `h`, that are listed with face `f`: each once for each side.
  template <class G>
  void for_each_listed_corner(Index f, const G& g) const
  {
    for (Index i = 0; i < 3; ++i)
      if (leads_its_side(3 * f + i)) g(3 * f + i, i == 1 ? 1 : 0, i == 2 ? 1 : 0);
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
    points_[i] = surface_.point({Vertex_class::smooth, f, u, v});
    weights_[i] = weight;
    lists_.link(i, f);
  }

  const Surface& surface_;
  const Mesh_view& mesh_;
  Deviation_limits limits_;
  internal::Point_lists lists_;
  Buffer<Vector_3> points_;
  Buffer<double> weights_;
  Buffer<Vector_3> normals_; // of the faces of the input
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_REPRESENTED_POINTS_H

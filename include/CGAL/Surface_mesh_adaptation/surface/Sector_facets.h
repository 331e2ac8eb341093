// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facets around a vertex of a tessellation, and what they say of the normal there.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_FACETS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_FACETS_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The corners that the facets of a smooth sector have at its vertex: each facet counts once, with whole sides, however
/// it is cut into triangles.
class Sector_facets
{
public:
  /// In the sector of the `n` faces from that of `first` on. \pre `facets` is not empty
  Sector_facets(const Facets& facets, const Mesh_view& mesh, const std::vector<Vector_3>& points, Index first,
                std::size_t n)
    : facets_(facets)
  {
    const bool is_closed = !mesh.is_crease(first) && !mesh.is_border(first);
    if (is_closed) first = start_of_facet(mesh, first, n);
    for (Index h = first; n > 0; --n, h = mesh.rotated_ccw(h)) {
      const Index face = Mesh_view::face(h);
      if (corners_.empty() || corners_.back().facet != facets.of_face[face])
        corners_.push_back({facets.of_face[face], h, h, mesh.target(h), Vector_3::Zero(), Vector_3::Zero(), 0});
      corners_.back().last = h;
    }
    is_closed_ = is_closed;
    if (is_closed && corners_.size() == 1) return; // inside of a facet
    for (Corner& c : corners_) {
      c.right = facets.side(mesh, points, c.first);
      c.left = side_to(mesh, points, Mesh_view::previous(c.last));
      c.depth = is_wide(c) ? depth(mesh, points, c) : 0;
      const double next2 = (points[mesh.target(c.first)] - points[mesh.source(c.first)]).squaredNorm();
      has_split_side_ = has_split_side_ || c.right.squaredNorm() > next2;
    }
    is_in_one_row_ = !is_closed && is_row([&](Index end, const Vector_3& side) {
      return is_on_crease(mesh, end) || !goes_on(mesh, points, end, side);
    });
    is_between_creases_ = !is_closed && is_row([&](Index end, const Vector_3&) { return is_on_crease(mesh, end); });
  }

  /// The largest plane of the shape among them, or null.
  const Facet* plane() const
  {
    const Facet* largest = nullptr;
    for (const Corner& c : corners_) {
      const Facet& f = facet(c);
      if (f.is_plane && (!largest || f.area > largest->area)) largest = &f;
    }
    return largest;
  }

  /// Whether one of them has more than one triangle: if not, there is nothing that triangles do not say.
  bool has_polygon() const
  {
    for (const Corner& c : corners_)
      if (facet(c).faces > 1) return true;
    return false;
  }

  /// Whether they are of one net that goes on around the vertex, so that a fit over it means something: about as large
  /// as each other, and with sides about as long where the vertex is inside. Where rulings of a cylinder end in a
  /// fillet, say, the curvature jumps. At the margin of a net, only a fit knows how it bends across that; a row alone
  /// does not.
  bool are_of_one_net() const
  {
    const Corner& first = corners_.front();
    if (is_in_one_row_ || has_split_side_) return false; // the latter by a vertex on a chord, not on the surface
    for (const Corner& c : corners_) {
      if (!are_alike(facet(c).area, facet(first).area, largest_ratio_in_nets) || !(sine(c) > least_sine)) return false;
      for (const Vector_3* s : {&c.right, &c.left})
        if (is_closed_ && !are_alike(s->norm(), first.right.norm(), largest_ratio_of_sides)) return false;
    }
    return true;
  }

  /// A unit vector along which the surface is straight, nearly: the mean of their sides, turned one way, if they are
  /// rulings, and parallel enough to say one; else zero.
  Vector_3 ruling() const
  {
    if (!are_sides_rulings()) return Vector_3::Zero();
    Vector_3 mean = Vector_3::Zero();
    for (std::size_t i = 1; i < corners_.size(); ++i)
      mean += corners_[i].right.normalized() * (corners_[i].right.dot(corners_[1].right) < 0 ? -1 : 1);
    mean.normalize();
    const bool are_parallel = std::all_of(corners_.begin() + 1, corners_.end(), [&](const Corner& c) {
      return std::abs(c.right.dot(mean)) > least_cosine_of_rulings * c.right.norm();
    });
    return are_parallel ? mean : Vector_3(Vector_3::Zero());
  }

  /// Whether `n` is across the rulings that end at a vertex inside. Fits over what goes on behind it, in a fillet, say,
  /// may have any normal.
  bool is_across_rulings(const Vector_3& n) const
  {
    for (std::size_t i = 0; is_closed_ && i < corners_.size(); ++i) {
      const Vector_3& d = corners_[i].right;
      if (std::abs(n.dot(d)) > largest_slope_of_rulings * d.norm() && is_ending_ruling(i)) return false;
    }
    return true;
  }

  /// The mean of their normals with the weights of Max for whole facets, made orthogonal to sides that are too long to
  /// be chords of what goes on behind the vertex; zero if they say nothing.
  Vector_3 normal() const
  {
    Vector_3 n = weighted_normal();
    double largest2 = 0;
    Ring<double> ratio2;
    for (const Corner& c : corners_) {
      ratio2.push_back(squared_ratio_to_opposite(c));
      largest2 = (std::max)(largest2, ratio2.back());
    }
    const double least2 = (std::max)(squared(largest_ratio_of_sides), squared(least_part_of_straightest) * largest2);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vector_3& d = corners_[i].right;
      if (ratio2[i] > least2) n -= n.dot(d) / d.squaredNorm() * d;
    }
    return n.squaredNorm() > 0 ? Vector_3(n.normalized()) : n;
  }

private:
  /// Of one thing; rulings of a straight pipe may be no more than twice as long as what goes on around its bend.
  static constexpr double largest_ratio_of_sides = 2;

  /// Of how straight the straightest side is: beside rulings, what is just longer than twice is a chord.
  static constexpr double least_part_of_straightest = 0.25;

  /// In radians: a surface that bends alike in all directions turns by less over one chord.
  static constexpr double largest_turn_of_chords = 1;

  /// Of the angle, 30 degrees, between rulings at one vertex and their mean: facets between them are longer than wide.
  static constexpr double least_cosine_of_rulings = 0.866;

  /// By which normals may not be across them: about two degrees.
  static constexpr double largest_slope_of_rulings = 0.03;

  static double squared(double x) { return x * x; }

  struct Corner
  {
    Index facet, first, last; // halfedges that leave the vertex in its first and last face
    Index end;                // of the first
    Vector_3 right, left; // sides from the vertex on
    double depth;         // of the facet between them, if the corner is wide
  };

  const Facet& facet(const Corner& c) const { return facets_.facets[c.facet]; }

  /// The halfedge among the `n` that leave a vertex, from `first` on, behind which another facet begins.
  Index start_of_facet(const Mesh_view& mesh, Index first, std::size_t n) const
  {
    Index h = first;
    for (std::size_t i = 0; i < n; ++i, h = mesh.rotated_ccw(h))
      if (!facets_.are_one(Mesh_view::face(h), Mesh_view::face(mesh.twin[h]))) return h;
    return first;
  }

  /// Whether the sides of an open sector are rulings: those that reach from one crease to another, or several where the
  /// surface bends along them less than across. The latter goes for polygons anyway; beside triangles, what polygons there
  /// are know their normals better.
  bool are_sides_rulings() const
  {
    if (is_closed_ || (has_polygon() && !has_only_polygons())) return false;
    if (is_between_creases_ && !has_polygon()) return true;
    return (is_between_creases_ || corners_.size() > 2) && bends_across();
  }

  bool has_only_polygons() const
  {
    return std::all_of(corners_.begin(), corners_.end(), [&](const Corner& c) { return facet(c).faces > 1; });
  }

  /// Whether their sides are chords of nothing that bends along them as it does across.
  bool bends_across() const
  {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < corners_.size(); ++i) shortest = (std::min)(shortest, corners_[i].right.norm());
    return bends_across(1, corners_.size() - 1, shortest);
  }

  /// The same of the right sides of the corners from `begin` to `last`, as if they were of this length.
  bool bends_across(std::size_t begin, std::size_t last, double length) const
  {
    double width = 0;
    for (std::size_t i = begin; i <= last; ++i)
      width += (facet(before(i)).area + facet(corners_[i]).area) / (2 * corners_[i].right.norm());
    return angle_between(facet(before(begin)).normal, facet(corners_[last]).normal) * length >
           largest_turn_of_chords * width;
  }

  /// Whether the right side of corner `i` is far longer than what goes on behind the vertex, and the surface does not bend
  /// along it as across, or it is so much longer that it need not be asked.
  bool is_ending_ruling(std::size_t i) const
  {
    const double ratio2 = squared_ratio_to_opposite(corners_[i]);
    return ratio2 > squared(2 * far_longer) ||
           (ratio2 > squared(far_longer) && bends_across(i, i, corners_[i].right.norm()));
  }

  const Corner& before(std::size_t i) const { return i > 0 ? corners_[i - 1] : corners_.back(); }

  /// Whether all sides between the facets of an open sector end where `is_end(vertex, side)`: on creases, say, or where
  /// what goes on is far shorter.
  template <class End>
  bool is_row(const End& is_end) const
  {
    return corners_.size() > 1 &&
           std::all_of(corners_.begin() + 1, corners_.end(), [&](const Corner& c) { return is_end(c.end, c.right); });
  }

  static bool is_on_crease(const Mesh_view& mesh, Index v)
  {
    bool result = false;
    mesh.for_each_outgoing(v, [&](Index h) { result |= mesh.is_crease(h); });
    return result;
  }

  /// Whether the `side` that ends at `v` goes on there.
  static bool goes_on(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index v, const Vector_3& side)
  {
    bool result = false;
    mesh.for_each_outgoing(v, [&](Index h) { result |= is_continued(side, points[mesh.target(h)] - points[v]); });
    return result;
  }

  /// Whether the side `d` goes on in `next`, straight and not much shorter.
  static bool is_continued(const Vector_3& d, const Vector_3& next)
  {
    return next.squaredNorm() * largest_ratio_of_sides * largest_ratio_of_sides >= d.squaredNorm() &&
           d.dot(next) > straight * std::sqrt(d.squaredNorm() * next.squaredNorm());
  }

  /// From the target of the border halfedge `h` back to where the border ceases to be straight.
  Vector_3 side_to(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index h) const
  {
    if (!mesh.is_border(h)) return facets_.side(mesh, points, mesh.twin[h]);
    return points[mesh.source(h)] - points[mesh.target(h)];
  }

  Vector_3 weighted_normal() const
  {
    Vector_3 by_corners = Vector_3::Zero(), by_areas = Vector_3::Zero();
    double largest_sine = 0;
    for (const Corner& c : corners_) {
      const double s = c.depth > 0 ? 1 : sine(c);
      if (s > 0) by_corners += weight(c) * facet(c).normal;
      if (facet(c).area > 0) by_areas += facet(c).normal / facet(c).area;
      largest_sine = (std::max)(largest_sine, s);
    }
    return largest_sine > least_sine ? by_corners : by_areas; // the latter for slivers
  }

  /// That of Max; a wide corner is cut in two, so that a facet counts whose side just goes on at the vertex.
  double weight(const Corner& c) const
  {
    const double right = c.right.norm(), left = c.left.norm();
    if (!(c.depth > 0)) return sine(c) / (right * left);
    const double sine_of_half = (c.right / right - c.left / left).norm() / 2;
    return sine_of_half / c.depth * (1 / right + 1 / left);
  }

  static constexpr double least_sine = 0.01; // of a corner; less: it belongs to a sliver
  static constexpr double straight = 0.7;    // cosine: 45 degrees from straight on
  static constexpr double almost_across = 0.17; // cosine: 80 degrees; triangles may have no side any straighter
  static constexpr double far_longer = 4;       // times as long as it is

  /// Of the angle at the corner `c`; negative where it is reflex.
  double sine(const Corner& c) const
  {
    return c.right.cross(c.left).dot(facet(c).normal) / std::sqrt(c.right.squaredNorm() * c.left.squaredNorm());
  }

  static bool is_wide(const Corner& c)
  {
    return c.right.dot(c.left) < -straight * std::sqrt(c.right.squaredNorm() * c.left.squaredNorm());
  }

  /// How far the triangles of a facet reach from the vertex along the line that bisects its corner there.
  double depth(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Corner& c) const
  {
    const Vector_3 inwards = facet(c).normal.cross(c.right.normalized() - c.left.normalized()).normalized();
    double depth = 0;
    for (Index h = c.first; h != c.last; h = mesh.rotated_ccw(h))
      depth = (std::max)(depth, inwards.dot(points[mesh.apex(h)] - points[mesh.source(h)]));
    return depth;
  }

  /// How many times as long, squared, the right side of `corner` is as the one that goes on best across the vertex: 0 if
  /// none does, and on creases. Inside, one that is more than 45 degrees off straight counts as far longer than it is.
  double squared_ratio_to_opposite(const Corner& corner) const
  {
    if (&corner == &corners_.front() && !is_closed_) return 0;
    const Vector_3& d = corner.right;
    double ratio2 = 0, least_cosine = is_closed_ ? -almost_across : -straight;
    for (const Corner& c : corners_)
      for (const Vector_3* s : {&c.right, &c.left}) {
        const double cosine = s->dot(d) / std::sqrt(s->squaredNorm() * d.squaredNorm());
        if (!(cosine < least_cosine)) continue;
        least_cosine = cosine;
        ratio2 = d.squaredNorm() / s->squaredNorm();
      }
    return least_cosine < -straight ? ratio2 : ratio2 / squared(far_longer);
  }

  const Facets& facets_;
  Ring<Corner> corners_;
  bool is_closed_ = false, has_split_side_ = false, is_in_one_row_ = false, is_between_creases_ = false;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_FACETS_H

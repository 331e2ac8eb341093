// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facets of a tessellation: coplanar triangles that belong together, whatever the diagonals between them.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACETS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACETS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Facet
{
  Vector_3 normal;        ///< unit
  double area = 0;
  Index faces = 0;        ///< number of its triangles
  double turn = 0;        ///< mean angle, in radians, to the facets like it beside it
  bool has_inner_vertices = false;
  bool is_plane = false;  ///< whether it is a plane of the shape, not a chord of something curved
};

/// The facets of a mesh, if it is the tessellation of a CAD system or the like, or a polyhedron that a convex hull or a
/// decimation has left of one: else, and where a mesher has made good triangles of it, there are none.
struct Facets
{
  double rounding = 0;          ///< how far the rounding of its coordinates may have moved a point
  std::vector<Facet> facets;
  std::vector<Index> of_face;   ///< index into `facets` for each face; empty if there are none

  bool are_meshed = false;      ///< whether a mesher has been over them: many vertices lie inside of facets, curved ones
                                ///< among these

  bool are_decimated = false;   ///< whether they are those of a polyhedron of few and uneven vertices, which say of no surface
                                ///< nor arc between them

  double sag = std::numeric_limits<double>::infinity();  ///< the largest of regular chords, if there are such

  bool empty() const { return of_face.empty(); }

  /// Whether facets that are no planes are chords of something curved. Those of a mesher are what its triangles happen
  /// to be.
  bool are_chords() const { return !empty() && !are_meshed; }

  const Facet& at(Index face) const { return facets[of_face[face]]; }
  bool are_one(Index f, Index g) const { return !empty() && of_face[f] == of_face[g]; }
  bool is_plane(Index face) const { return !empty() && at(face).is_plane; }

  /// From the source of the halfedge `h`, on the border of a facet or on a feature in it, to where that ceases to be
  /// straight.
  /// \pre `mesh.curve` is set
  Vector_3 side(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index h) const
  {
    const Vector_3& start = points[mesh.source(h)];
    Index end = mesh.target(h);
    for (int i = 0; i < longest_side; ++i) {
      h = next_on_border(mesh, h);
      if (!is_on_line(start, points[end], points[mesh.target(h)])) break;
      end = mesh.target(h);
    }
    return points[end] - start;
  }

  /// Whether `c` is on the line from `a` to `b`, further on, but for the rounding of the three.
  bool is_on_line(const Vector_3& a, const Vector_3& b, const Vector_3& c) const
  {
    const Vector_3 d = b - a, e = c - b;
    const double length = d.norm();
    return d.dot(e) > 0 && d.cross(e).norm() <= 2 * rounding * (2 * length + e.norm());
  }

private:
  static constexpr int longest_side = 16; // edges; more of them on one side are rare, and then long enough

  /// The halfedge on the border of a facet, or on a feature in it, that follows `h`, which is one.
  Index next_on_border(const Mesh_view& mesh, Index h) const
  {
    Index g = Mesh_view::next(h);
    while (!mesh.is_border(g) && !mesh.is_feature(g) && are_one(Mesh_view::face(g), Mesh_view::face(mesh.twin[g])))
      g = Mesh_view::next(mesh.twin[g]);
    return g;
  }
};

namespace internal {

/// Whether two sizes differ by the factor `ratio` at most.
inline bool are_alike(double a, double b, double ratio) { return a <= ratio * b && b <= ratio * a; }

/// Largest ratio of the areas of facets of one net: near poles of spheres they shrink fast.
constexpr double largest_ratio_in_nets = 4;

inline double angle_between(const Vector_3& a, const Vector_3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Between the faces beside an edge that is not on the border.
inline double turn_at(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index h)
{
  return angle_between(face_normal(mesh, points, h), face_normal(mesh, points, mesh.twin[h]));
}

/// Two planes of the shape meet in an edge if their normals are farther apart than this, in radians: two degrees.
constexpr double least_turn_between_planes = 0.035;

/// Whether `x` is a decimal number of so many digits, but for the rounding of `double`.
inline bool is_decimal(double x, int digits)
{
  if (x == 0) return true;
  const double scaled = std::abs(x) * std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(x))));
  return std::abs(scaled - std::round(scaled)) <= 1e-9 + 4 * std::numeric_limits<double>::epsilon() * scaled;
}

/// How far the rounding of coordinates may have moved the points: to the least of some numbers of decimal digits that
/// all coordinates agree with, as in files of text, or else to single or to double precision. Half a unit of the last
/// digit is the same from 100 to 999: for its part of the largest coordinate alone chords of small arcs would be one.
template <class Execution>
double coordinate_rounding(const Execution& execution, const std::vector<Vector_3>& points)
{
  const auto all = [&](const auto& predicate) {
    const auto fails = [&](const Vector_3& p) { return !(predicate(p[0]) && predicate(p[1]) && predicate(p[2])); };
    constexpr std::size_t few = 64; // that tell most predicates that do not hold, before all points are looked at
    const auto first = points.begin(), last = first + std::ptrdiff_t((std::min)(few, points.size()));
    return std::none_of(first, last, fails) &&
           count_if(execution, points.size(), [&](std::size_t i) { return fails(points[i]); }) == 0;
  };
  const double largest = reduce(execution, points.size(), 0.0, [&](std::size_t i) {
    return points[i].template lpNorm<Eigen::Infinity>();
  }, [](double a, double b) { return (std::max)(a, b); });
  constexpr double diagonal_of_cube = 1.7320508075688772;
  const auto moved_by = [&](double relative) { return diagonal_of_cube * relative * largest; };
  const auto are_decimals = [&](int digits) { return all([=](double x) { return is_decimal(x, digits); }); };
  const double power = largest > 0 ? std::pow(10.0, std::floor(std::log10(largest))) / largest : 1;
  const auto half_a_digit = [&](int digits) { return moved_by(5 * power * std::pow(10.0, -digits)); };
  if (are_decimals(6)) return half_a_digit(6);
  if (all([](double x) { return double(float(x)) == x; })) return moved_by(std::numeric_limits<float>::epsilon() / 2);
  for (const int digits : {9, 12, 14})
    if (are_decimals(digits)) return half_a_digit(digits);
  return moved_by(4 * std::numeric_limits<double>::epsilon()); // after a rotation or the like
}

inline double area_of_face(const Mesh_view& mesh, const std::vector<Vector_3>& points, std::size_t f)
{
  return face_normal(mesh, points, Index(3 * f)).norm() / 2;
}

/// Of the triangles, with these weights: 1 if they are equilateral.
template <class Execution, class Weight>
double weighted_mean_quality(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                             const Weight& weight)
{
  const auto sum = [&](const auto& value) {
    return reduce(execution, mesh.number_of_faces(), 0.0, value, std::plus<double>());
  };
  return sum([&](std::size_t f) {
    const Isotropic_metric m{1};
    const Vector_3& a = points[mesh.corner[3 * f]];
    return weight(f) * face_quality(m, m, m, points[mesh.corner[3 * f + 1]] - a, points[mesh.corner[3 * f + 2]] - a);
  }) / sum(weight);
}

template <class Execution>
double mean_quality_by_area(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  return weighted_mean_quality(execution, mesh, points, [&](std::size_t f) { return area_of_face(mesh, points, f); });
}

/// Finds facets: triangles are taken in the order of their areas, each with all that can be reached from it in its
/// plane. Larger triangles know their planes better; slivers follow them, whatever their own normals say.
///
/// Work O(n log n), sequential but for the test whether there are facets at all.
class Facet_search
{
public:
  Facet_search(const Mesh_view& mesh, const std::vector<Vector_3>& points) : mesh_(mesh), points_(points) {}

  template <class Execution>
  Facets run(const Execution& execution)
  {
    facets_.rounding = coordinate_rounding(execution, points_);
    if (!is_tessellation(execution)) return std::move(facets_);
    return grown(execution);
  }

  /// Those of a polyhedron, whatever its faces look like.
  template <class Execution>
  Facets run_on_polyhedron(const Execution& execution)
  {
    facets_.rounding = coordinate_rounding(execution, points_);
    facets_.are_decimated = true;
    return grown(execution);
  }

private:
  template <class Execution>
  Facets grown(const Execution& execution)
  {
    facets_.of_face.assign(mesh_.number_of_faces(), no_index);
    for (const Index f : faces_by_area(execution))
      if (facets_.of_face[f] == no_index) grow(f);
    if (find_inner_vertices() > largest_share_inside * double(mesh_.number_of_vertices())) {
      if (mean_quality(execution) > least_quality_of_meshers) return {facets_.rounding, {}, {}};
      facets_.are_meshed = true;
    }
    return std::move(facets_);
  }

  // Of faces with a coplanar neighbour: scans and the like have far fewer, crossing pipes, all needles, some or none.
  static constexpr double least_share = 0.25, usual_share = 0.4, least_share_of_area = 0.5;

  static constexpr double largest_share_inside = 0.3; // of vertices; CAD systems put next to none there

  static constexpr double least_quality_of_meshers = 0.6; // of their triangles; facets cut into more of these have .3

  /// Mean quality of triangles that reach across faces of the shape, as those of no scan do. Such a share of their corners is
  /// on edges that turn by this, 45 degrees.
  static constexpr double largest_quality_of_needles = 0.3, least_share_on_creases = 0.5, least_turn_of_creases = 0.785;

  /// The same of the mean by area, where such a share of it is in planes: long triangles of straight walls, which are large,
  /// beside many small ones of fillets.
  static constexpr double largest_quality_of_walls = 0.47, least_share_beside_walls = 0.25;

  /// Whether enough of the faces have a coplanar neighbour: of their number, or of their area where these are few and
  /// large.
  template <class Execution>
  bool is_tessellation(const Execution& execution) const
  {
    using Sums = std::array<double, 4>; // number and area of these faces, and of all
    const Sums sums = reduce(execution, mesh_.number_of_faces(), Sums{}, [&](std::size_t f) -> Sums {
      const double area = this->area(f);
      return has_coplanar_neighbor(Index(f)) ? Sums{1, area, 1, area} : Sums{0, 0, 1, area};
    }, [](const Sums& a, const Sums& b) -> Sums { return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}; });
    const double share = sums[0] / sums[2];
    if (share >= usual_share || sums[1] >= least_share_of_area * sums[3]) return true;
    if (sums[1] >= least_share_beside_walls * sums[3] &&
        mean_quality_by_area(execution, mesh_, points_) <= largest_quality_of_walls)
      return true;
    const double largest_quality = share >= least_share ? least_quality_of_meshers : largest_quality_of_needles;
    return mean_quality(execution) <= largest_quality && share_on_creases(execution) >= least_share_on_creases;
  }

  /// Of the vertices, those on edges where the surface ends or turns sharply.
  template <class Execution>
  double share_on_creases(const Execution& execution) const
  {
    return double(count_if(execution, mesh_.number_of_vertices(), [&](std::size_t v) {
      bool result = mesh_.is_border_vertex(Index(v));
      mesh_.for_each_outgoing(Index(v), [&](Index h) { result = result || turns_sharply(h); });
      return result;
    })) / double(mesh_.number_of_vertices());
  }

  bool turns_sharply(Index h) const
  {
    return !mesh_.is_border(h) && turn_at(mesh_, points_, h) > least_turn_of_creases;
  }

  double area(std::size_t f) const { return area_of_face(mesh_, points_, f); }

  template <class Execution>
  double mean_quality(const Execution& execution) const
  {
    return weighted_mean_quality(execution, mesh_, points_, [](std::size_t) { return 1.0; });
  }

  /// A plane that is known no better than a triangle says.
  struct Plane
  {
    Vector_3 point, normal;
    Vector_3 longest; ///< edge of the triangle
    double height;    ///< over that, 0 for degenerate ones
  };

  Plane plane(Index f) const
  {
    const Index h = 3 * f;
    const Vector_3 &a = points_[mesh_.corner[h]], &b = points_[mesh_.corner[h + 1]], &c = points_[mesh_.corner[h + 2]];
    const Vector_3 n = (b - a).cross(c - a);
    Vector_3 longest = b - a;
    for (const Vector_3& e : {Vector_3(c - b), Vector_3(a - c)})
      if (e.squaredNorm() > longest.squaredNorm()) longest = e;
    const double twice_area = n.norm();
    if (!(twice_area > 0)) return {a, Vector_3::Zero(), longest, 0};
    return {(a + b + c) / 3, n / twice_area, longest, twice_area / longest.norm()};
  }

  /// Whether rounding explains the distance of `p` from `plane`: what it does to the corners of the triangle grows with
  /// the distance from that, and along a narrow one far less than across.
  bool is_on(const Plane& plane, const Vector_3& p) const
  {
    const Vector_3 d = p - plane.point;
    const double length = plane.longest.norm(), along = std::abs(d.dot(plane.longest)) / length,
                 across = plane.longest.cross(d).norm() / length;
    return std::abs(d.dot(plane.normal)) <= 2 * facets_.rounding * (1 + along / length + across / plane.height);
  }

  /// Whether a plane is known well enough to say which points are on it: its normal to .01.
  bool is_known(const Plane& plane) const { return plane.height > 100 * facets_.rounding; }

  bool has_coplanar_neighbor(Index f) const
  {
    const Plane p = plane(f);
    if (!is_known(p)) return false;
    for (Index h = 3 * f; h < 3 * f + 3; ++h)
      if (!mesh_.is_border(h) && continues(p, mesh_.twin[h])) return true;
    return false;
  }

  /// Whether the face of `h` lies in `plane`, as its edge `h` does, and is not turned over.
  bool continues(const Plane& plane, Index h) const
  {
    if (!is_on(plane, points_[mesh_.apex(h)])) return false;
    const Vector_3 n = face_normal(mesh_, points_, h);
    return n.dot(plane.normal) >= 0 || n.norm() <= 4 * facets_.rounding * squared_length(h);
  }

  double squared_length(Index h) const { return (points_[mesh_.target(h)] - points_[mesh_.source(h)]).squaredNorm(); }

  template <class Execution>
  std::vector<Index> faces_by_area(const Execution& execution) const
  {
    std::vector<double> area(mesh_.number_of_faces());
    for_each_index(execution, area.size(), [&](std::size_t f) {
      area[f] = face_normal(mesh_, points_, Index(3 * f)).squaredNorm();
    });
    std::vector<Index> faces(area.size());
    std::iota(faces.begin(), faces.end(), Index(0));
    std::stable_sort(faces.begin(), faces.end(), [&](Index a, Index b) { return area[a] > area[b]; });
    return faces;
  }

  /// Makes a facet of what can be reached from `seed` in its plane.
  void grow(Index seed)
  {
    const Plane p = plane(seed);
    const Index id = Index(facets_.facets.size());
    Facet facet;
    Vector_3 twice_area = Vector_3::Zero();
    std::vector<Index> pending{seed};
    facets_.of_face[seed] = id;
    while (!pending.empty()) {
      const Index f = pending.back();
      pending.pop_back();
      twice_area += face_normal(mesh_, points_, 3 * f);
      ++facet.faces;
      for (Index h = 3 * f; is_known(p) && h < 3 * f + 3; ++h) {
        const Index t = mesh_.twin[h];
        if (t == no_index || facets_.of_face[Mesh_view::face(t)] != no_index || !continues(p, t)) continue;
        facets_.of_face[Mesh_view::face(t)] = id;
        pending.push_back(Mesh_view::face(t));
      }
    }
    facet.area = twice_area.norm() / 2;
    facet.normal = facet.area > 0 ? Vector_3(twice_area / (2 * facet.area)) : p.normal;
    facets_.facets.push_back(facet);
  }

  /// Returns their number. Vertices inside of the sides of two facets count half: the neighbours of these may have put
  /// them there.
  double find_inner_vertices()
  {
    double inside = 0;
    for (std::size_t v = 0; v < mesh_.number_of_vertices(); ++v) {
      if (mesh_.is_border_vertex(Index(v))) continue;
      const int n = number_of_facets_at(Index(v));
      if (n == 1) facets_.facets[facets_.of_face[Mesh_view::face(mesh_.outgoing[v])]].has_inner_vertices = true;
      inside += n == 1 ? 1 : n == 2 ? 0.5 : 0;
    }
    return inside;
  }

  /// The number of facets around `v`; those that come back count again.
  int number_of_facets_at(Index v) const
  {
    int n = 0;
    mesh_.for_each_outgoing(v, [&](Index h) {
      const Index t = mesh_.twin[h];
      if (t == no_index || !facets_.are_one(Mesh_view::face(h), Mesh_view::face(t))) ++n;
    });
    return (std::max)(n, 1);
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  Facets facets_;
};

} // namespace internal

/// Finds the facets of a mesh; which of them are planes is left open, but for those with vertices inside.
template <class Execution>
Facets find_facets(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  return internal::Facet_search(mesh, points).run(execution);
}

/// The same of a polyhedron (`polyhedra.h`), whatever its faces look like.
template <class Execution>
Facets find_facets_of_polyhedron(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points)
{
  return internal::Facet_search(mesh, points).run_on_polyhedron(execution);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FACETS_H

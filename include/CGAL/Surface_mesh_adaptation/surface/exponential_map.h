// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exponential map of a vertex on the patches around it, and its inverse.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_EXPONENTIAL_MAP_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_EXPONENTIAL_MAP_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/numerics/cubic_curve.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// The faces around a vertex, or those of one of its smooth sectors, counterclockwise. Neighbours share an edge.
struct One_ring
{
  /// A face of the ring.
  struct Cell
  {
    Index face;  ///< which one
    std::size_t corner;  ///< of the face, at the center
    Patch patch;         ///< with the center as its corner 0, whatever the numbering of the face
  };

  Ring<Cell> cells;  ///< counterclockwise
  bool is_closed;        ///< whether the last cell has an edge in common with the first

  const Vector_3& center() const { return cells[0].patch.points[0]; }  ///< the vertex
  const Vector_3& normal() const { return cells[0].patch.normals[0]; }  ///< unit, at the vertex
};

/// The faces around the source of `h`, as far as one gets from that of `h` without crossing a feature.
/// `patch(f)` returns the `Patch` of face `f`. Allocates only for more than 16 faces.
template <class PatchOfFace>
One_ring one_ring(const Mesh_view& mesh, Index h, const PatchOfFace& patch)
{
  Index first = h;
  bool is_closed = false;
  while (!mesh.is_feature(first) && !mesh.is_border(first) && !is_closed) {
    first = mesh.rotated_cw(first);
    is_closed = first == h;
  }
  One_ring ring{{}, is_closed};
  Index g = first;
  do {
    const std::size_t corner = g % 3;
    ring.cells.push_back({Mesh_view::face(g), corner, renumbered(patch(Mesh_view::face(g)), corner)});
    g = mesh.rotated_ccw(g);
  } while (g != first && g != no_index && !mesh.is_feature(g));
  return ring;
}

/// The tangent vector at `p` whose geodesic of its own length ends in `q`, up to the fourth power of the distance:
/// the direction of the chord in the tangent plane, corrected by a sixth of the product of the tangential and the
/// lateral component of the other normal, for a geodesic leaves its normal plane by that much where it has torsion;
/// with the length of the cubic curve between the points. Zero if the chord is normal to the surface at `p`.
/// \pre `np` and `nq` are unit normals, `q` is so close to `p` that they differ by less than 90 degrees
inline Vector_3 logarithm_map(const Vector_3& p, const Vector_3& np, const Vector_3& q, const Vector_3& nq)
{
  const Vector_3 e = q - p, chord = e - e.dot(np) * np;
  const double squared_length = chord.squaredNorm();
  if (!(squared_length > 0)) return Vector_3::Zero();
  const Vector_3 d = chord / std::sqrt(squared_length), b = np.cross(d);
  const Vector_3 direction = d + nq.dot(d) * nq.dot(b) / 6 * b;
  return internal::cubic_length(e, internal::smooth_handles(e, np, nq)) * direction.normalized();
}

/// How a tangent vector is laid onto the surface.
enum class Exponential_map_method : std::uint8_t
{
  /// The vector is lifted along the normal of the vertex onto the cell that it points to, keeps its length there, and
  /// is rescaled once by the length of the curve to the point of the patch (section 2 of the paper, which turns it
  /// onto the cell instead; lifting is continuous across the edges of the ring). Error of third order in the size of
  /// the ring.
  length_kept,
  /// One step of Newton's method on `logarithm_map(point) = t`, taken if it reduces the residual: fourth order.
  shooting
};

/// Where a tangent vector leads to.
struct Exponential_map_result
{
  Surface_point point;  ///< where the vector ends
  Index face;              ///< of the ring, on whose patch the point lies
  double u;                ///< barycentric coordinate of its corner 1
  double v;                ///< barycentric coordinate of its corner 2
  bool is_on_border;       ///< whether the ring ends before the vector does: then the point is on its border
};

namespace internal {

/// A place in a one-ring, by the coordinates of the two other corners of a cell.
struct Ring_location
{
  std::size_t cell;
  double a, b;
  bool is_on_border;
};

/// The place below the end of the tangent vector `t`, seen along the normal of the center; on the border of the ring if
/// `t` leaves it, which an open ring has at the center too.
inline Ring_location lift(const One_ring& ring, const Vector_3& t)
{
  const Vector_3 nt = t.cross(ring.normal());
  for (std::size_t i = 0; i < ring.cells.size(); ++i) {
    const std::array<Vector_3, 3>& p = ring.cells[i].patch.points;
    const Vector_3 e = p[1] - p[0], f = p[2] - p[0];
    const double a = -f.dot(nt), b = e.dot(nt), area = ring.normal().dot(e.cross(f));
    if (!(a >= 0 && b >= 0 && area > 0)) continue;
    const double scale = 1 / (std::max)(area, a + b);
    return {i, scale * a, scale * b, a + b > area};
  }
  return {0, 0, 0, true};
}

inline Vector_3 tangent_vector(const One_ring& ring, const Ring_location& l)
{
  const std::array<Vector_3, 3>& p = ring.cells[l.cell].patch.points;
  const Vector_3 e = l.a * (p[1] - p[0]) + l.b * (p[2] - p[0]);
  return e - e.dot(ring.normal()) * ring.normal();
}

inline Ring_location scaled(Ring_location l, double s)
{
  const double sum = s * (l.a + l.b);
  if (sum > 1) s /= sum;
  return {l.cell, s * l.a, s * l.b, sum > 1};
}

/// A place in a one-ring, the point of the patch there, and its logarithm.
template <class Reconstruction>
struct Ring_point
{
  Ring_location location;
  Surface_point point;
  Vector_3 logarithm;

  Ring_point(const One_ring& ring, const Ring_location& l)
    : location(l), point(Reconstruction::evaluate(ring.cells[l.cell].patch, l.a, l.b))
    , logarithm(logarithm_map(ring.center(), ring.normal(), point.position, point.normal))
  {}

  Exponential_map_result result(const One_ring& ring) const
  {
    const One_ring::Cell& cell = ring.cells[location.cell];
    double b[3];
    b[cell.corner] = 1 - location.a - location.b;
    b[(cell.corner + 1) % 3] = location.a;
    b[(cell.corner + 2) % 3] = location.b;
    return {point, cell.face, b[1], b[2], location.is_on_border};
  }
};

template <class Reconstruction>
Ring_point<Reconstruction> keep_length(const One_ring& ring, const Vector_3& t)
{
  using Point = Ring_point<Reconstruction>;
  Ring_location l = lift(ring, t);
  const std::array<Vector_3, 3>& p = ring.cells[l.cell].patch.points;
  const double length = t.norm(), on_cell = (l.a * (p[1] - p[0]) + l.b * (p[2] - p[0])).norm();
  if (l.is_on_border || !(on_cell > 0)) return Point(ring, l);
  l = scaled(l, length / on_cell);
  const Point x(ring, l);
  const double on_curve = x.logarithm.norm();
  return l.is_on_border || !(on_curve > 0) ? x : Point(ring, scaled(l, length / on_curve));
}

template <class Reconstruction>
Ring_point<Reconstruction> shoot(const One_ring& ring, const Vector_3& t)
{
  const Ring_point<Reconstruction> first(ring, lift(ring, t));
  const Vector_3 residual = t - first.logarithm;
  const Ring_point<Reconstruction> second(ring, lift(ring, tangent_vector(ring, first.location) + residual));
  return (t - second.logarithm).squaredNorm() < residual.squaredNorm() ? second : first;
}

} // namespace internal

/// The end of the geodesic that leaves the center of `ring` with the tangent vector `t` and is as long. Stops at the
/// border of the ring, at the center itself if that is on the border and `t` points away from the ring, and says so.
/// \pre `t` is orthogonal to the normal of the center, and the ring seen along that normal is not folded
template <class Reconstruction = Gregory_reconstruction>
Exponential_map_result exponential_map(const One_ring& ring, const Vector_3& t,
                                       Exponential_map_method method = Exponential_map_method::shooting)
{
  if (method == Exponential_map_method::shooting) return internal::shoot<Reconstruction>(ring, t).result(ring);
  return internal::keep_length<Reconstruction>(ring, t).result(ring);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_EXPONENTIAL_MAP_H

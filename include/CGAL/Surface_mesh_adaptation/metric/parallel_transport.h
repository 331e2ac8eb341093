// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parallel transport over a short step of a surface of which the points and normals at both ends are known.
//
// A transport from `p` to `q` is a rotation `R` that takes the normal `np` to the normal `nq`: it takes the vector `v`
// to `R v` and the tensor `M` to `R M R^T`, which keeps lengths, angles and eigenvalues. What the models differ in is
// the angle by which they turn the tangent plane. Its error over a step of the length `h`, with the largest curvature
// `k`, and the order over many steps:
//
//   minimal_rotation   below 0.15 (k h)^3   second order; exact on spheres
//   chord_rotation     below 0.15 (k h)^3   second order; exact on spheres
//   schild_rotation    of order (k h)^2     first order
//
// All take a few nanoseconds and allocate no memory.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_METRIC_PARALLEL_TRANSPORT_H
#define CGAL_SURFACE_MESH_ADAPTATION_METRIC_PARALLEL_TRANSPORT_H

#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// The rotation of least angle that takes the unit vector `from` to the unit vector `to`:
/// `c I + [x] + x x^T / (1 + c)`, where `x` is their cross product and `c` their scalar product; the identity if they
/// are opposite, where it is not unique. Needs no more than the normals: the transport along the great circle between
/// them on the Gauss map.
inline Matrix_3 minimal_rotation(const Vector_3& from, const Vector_3& to)
{
  const double c = from.dot(to);
  if (c < -1 + 1e-12) return Matrix_3::Identity();
  const Vector_3 x = from.cross(to);
  Matrix_3 r = internal::outer_product(x, x);
  r /= 1 + c;
  for (int i = 0; i < 3; ++i) r(i, i) += c;
  r(0, 1) -= x[2]; r(1, 0) += x[2];
  r(0, 2) += x[1]; r(2, 0) -= x[1];
  r(1, 2) -= x[0]; r(2, 1) += x[0];
  return r;
}

namespace internal {

/// The rotation that takes the unit normal `np` to `nq` and the part of `u` across `np` to that of `v` across `nq`;
/// the minimal one if a part vanishes.
inline Matrix_3 frame_rotation(const Vector_3& np, const Vector_3& u, const Vector_3& nq, const Vector_3& v)
{
  // b = n x u is across the normal, and so is b x n, to the last bit of the latter
  const Vector_3 bp = np.cross(u), bq = nq.cross(v);
  const double lp = bp.norm(), lq = bq.norm();
  if (!(lp > 0 && lq > 0)) return minimal_rotation(np, nq);
  Matrix_3 from, to;
  from << bp / lp, bp.cross(np) / lp, np;
  to << bq / lq, bq.cross(nq) / lq, nq;
  return to * from.transpose();
}

} // namespace internal

/// The rotation that takes the normal and the projected chord `q - p` at `p` to those at `q`: the chord stands for the
/// geodesic, whose tangent is parallel along it. The minimal rotation if the chord is normal to the surface.
/// \pre `np` and `nq` are unit vectors
inline Matrix_3 chord_rotation(const Vector_3& p, const Vector_3& np, const Vector_3& q, const Vector_3& nq)
{
  return internal::frame_rotation(np, q - p, nq, q - p);
}

/// Schild's ladder on straight segments, Algorithm 1 of the paper: the tangent vector `v` at `p` is one side of a
/// parallelogram whose diagonals, from `p + v` to `q` and from `p` to the result, halve each other. In space that is a
/// translation, whatever the length of `v`, and only the projection onto the tangent plane of `q` turns it. The other
/// directions follow `v`, as in the paper; `v` is scaled back to its length, which the paper leaves out. First order:
/// for comparison, prefer `chord_rotation()`.
/// \pre `np` and `nq` are unit vectors, `v` is orthogonal to `np`
inline Matrix_3 schild_rotation(const Vector_3& v, const Vector_3& p, const Vector_3& np, const Vector_3& q,
                                const Vector_3& nq)
{
  const Vector_3 middle = ((p + v) + q) / 2, s = p + 2 * (middle - p);
  return internal::frame_rotation(np, v, nq, s - q);
}

/// Takes tensors from several points to one and averages them there: the log-Euclidean mean
/// `exp(sum w_i R_i log(M_i) R_i^T / sum w_i)` (Arsigny et al. 2006), which keeps anisotropy where an average of the
/// coefficients would wash it out. Terms are added in the order of the calls.
class Transported_mean
{
public:
  /// Adds the positive definite tensor `m`, carried along by the rotation `r`, with the given weight.
  void add(double weight, const Metric_tensor_3& m, const Matrix_3& r) { add_log(weight, log(m), r); }

  /// The same for a tensor of which the logarithm is at hand.
  void add_log(double weight, const Metric_tensor_3& log_of_m, const Matrix_3& r)
  {
    sum_ += weight * rotated(log_of_m, r);
    weight_ += weight;
  }

  /// \pre the sum of the weights is positive
  Metric_tensor_3 value() const { return exp(1 / weight_ * sum_); }

private:
  Metric_tensor_3 sum_{0, 0, 0, 0, 0, 0};
  double weight_ = 0;
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_METRIC_PARALLEL_TRANSPORT_H

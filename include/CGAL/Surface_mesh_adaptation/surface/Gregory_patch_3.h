// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle of degree four that meets its neighbours with a common tangent plane.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_GREGORY_PATCH_3_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_GREGORY_PATCH_3_H

#include <CGAL/Surface_mesh_adaptation/numerics/cubic_curve.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// The quartic Gregory patch of Walton and Meek (A triangular G1 patch from boundary curves, 1996) over the cubic
/// boundary curves of numerics/cubic_curve.h. It interpolates corners and corner normals; two patches that share a
/// smooth edge have the same curve there, to the bit, and the same tangent planes, for any corner normals.
///
/// Along an edge the tangent planes are spanned by the derivative `W` of the curve and a conormal `A`, quadratic in
/// the parameter. Both depend on the ends of the edge alone, which is all that the continuity needs.
///
/// Where the corners say too little about the surface the patch falls back, and says so: an edge to its chord
/// (`Curve::straight`) if a normal leaves the plane across the edge by more than 35 degrees or the normals are more
/// than 120 degrees apart, the interior to that of a cubic triangle (`Interior::cubic`) if a normal is more than 30
/// degrees off that of the facet, if that is a sliver, or if a curve leaves its edge by more than the patch allows and
/// is brought so near (`Curve::lowered`). The former follows from the ends of the edge, so that
/// neighbours still meet; the latter gives up the common tangent planes.
///
/// For tangent planes common to all faces around a vertex on a feature curve its normals must be orthogonal to the
/// tangents of the curves that bound its sector.
class Gregory_patch_3
{
public:
  /// Where the conormal at the middle of an edge comes from, and how long the handles of its curve are.
  enum class Construction : std::uint8_t
  {
    mid_edge,     ///< cubic Hermite interpolation of the normal, by the shape operators: the distance to a smooth
                  ///< surface is of fourth order in the size of the face, the normal of third; an edge with an end
                  ///< whose shape operator is not known has the conormals below. Handles are those of a circle
    walton_meek   ///< mean of the conormals at the ends: third and second order. The curve has the least integral of
                  ///< its squared second derivative
  };
  /// What the curve over an edge is: a cubic by the normals, that with a smaller bulge, one by the tangents of a
  /// feature, or the chord.
  enum class Curve : std::uint8_t { smooth, lowered, feature, straight };
  /// What the inside is: that of a Gregory patch, or of a cubic triangle.
  enum class Interior : std::uint8_t { gregory, cubic };

  /// A point of the patch and its derivatives by the barycentric coordinates `u` and `v`.
  struct Derivatives
  {
    Vector_3 point;  ///< itself
    Vector_3 du;     ///< by `u`
    Vector_3 dv;     ///< by `v`
  };

  /// \pre the normals are unit vectors, and so are the tangents of the feature edges
  explicit Gregory_patch_3(const Patch& p, Construction construction = Construction::mid_edge)
    : corners_(p.points), normals_(p.normals)
  {
    std::array<Handles, 3> handles;
    for (std::size_t i = 0; i < 3; ++i) handles[i] = boundary_curve(p, i, construction);
    for (std::size_t i = 0; i < 3; ++i) raise_degree(i, handles[i]);
    interior_ = supports_gregory(p) && !is_lowered() ? Interior::gregory : Interior::cubic;
    if (interior_ == Interior::cubic) {
      set_cubic_interior(handles);
      return;
    }
    for (std::size_t i = 0; i < 3; ++i)
      set_twists(i, tangent_planes(p, i, handles[i], construction), handles[(i + 2) % 3].end,
                 handles[(i + 1) % 3].start);
    if (!bulges_beyond(p.largest_bulge)) return;
    interior_ = Interior::cubic;
    set_cubic_interior(handles);
  }

  /// The point with barycentric coordinates `(1 - u - v, u, v)`. \pre none of them is negative
  Vector_3 point(double u, double v) const { return blend(u, v).point(); }

  /// The point there, and its derivatives: those of the rational weights of the twists included.
  Derivatives derivatives(double u, double v) const
  {
    const Blend b = blend(u, v);
    return {b.point(), 4 * (b.r[1] - b.r[0]), 4 * (b.r[2] - b.r[0])};
  }

  /// The point there and the unit normal; where the derivatives are parallel, the mean of the corner normals.
  Surface_point evaluate(double u, double v) const
  {
    const Blend b = blend(u, v);
    return {b.point(), unit_normal((b.r[1] - b.r[0]).cross(b.r[2] - b.r[0]), u, v)};
  }

  Vector_3 normal(double u, double v) const { return evaluate(u, v).normal; }  ///< that of `evaluate()`

  /// Control point `i`, from 0 to 4, of the curve over the edge from corner `edge` to the next.
  const Vector_3& control_point(std::size_t edge, std::size_t i) const
  {
    return i == 0 ? corners_[edge] : i == 4 ? corners_[(edge + 1) % 3] : edges_[edge][i - 1];
  }

  Curve curve(std::size_t edge) const { return curves_[edge]; }  ///< what the curve of an edge is
  Interior interior() const { return interior_; }  ///< what the interior is

private:
  using Handles = internal::Cubic_handles;

  // cosines squared of the 30 degrees that a normal may be off that of the facet, and the squared ratio of twice the
  // area to the squared longest edge below which a facet has no normal worth the name
  static constexpr double least_squared_cosine = 0.75, sliver = 1e-12;
  // a normal at the middle of an edge that is off the mean of the normals at its ends by more, in radians, is
  // taken for noise of the shape operators: on a sphere it takes an edge of 1.4 radii
  static constexpr double largest_correction = 0.25;

  Handles boundary_curve(const Patch& p, std::size_t i, Construction construction)
  {
    const std::size_t j = (i + 1) % 3;
    const Vector_3 e = p.points[j] - p.points[i];
    const Handles h = p.is_feature[i]    ? internal::feature_handles(e, p.tangents[i][0], p.tangents[i][1])
                      : p.is_straight[i] ? internal::straight_handles(e)
                      : construction == Construction::walton_meek
                        ? internal::walton_meek_handles(e, p.normals[i], p.normals[j])
                        : internal::smooth_handles(e, p.normals[i], p.normals[j]);
    curves_[i] = h.is_straight ? Curve::straight : p.is_feature[i] ? Curve::feature : Curve::smooth;
    if (curves_[i] != Curve::smooth) return h;
    const double share = internal::share_within(p.largest_bulge_of_edge[i], h, e);
    if (!(share < 1)) return h;
    curves_[i] = Curve::lowered;
    return internal::lowered(h, e, share);
  }

  bool is_lowered() const { return std::find(curves_.begin(), curves_.end(), Curve::lowered) != curves_.end(); }

  void raise_degree(std::size_t i, const Handles& h)
  {
    const Vector_3 &a = corners_[i], &b = corners_[(i + 1) % 3];
    edges_[i] = {a + 0.75 * h.start, ((a + h.start) + (b + h.end)) / 2, b + 0.75 * h.end};
  }

  static bool supports_gregory(const Patch& p)
  {
    const Vector_3 e0 = p.points[1] - p.points[0], e1 = p.points[2] - p.points[1], e2 = p.points[0] - p.points[2];
    const Vector_3 n = e0.cross(e1);
    const double n2 = n.squaredNorm(),
                 length2 = (std::max)({e0.squaredNorm(), e1.squaredNorm(), e2.squaredNorm()});
    if (!(n2 > sliver * length2 * length2)) return false;
    for (const Vector_3& normal : p.normals) {
      const double c = n.dot(normal);
      if (!(c > 0 && c * c > least_squared_cosine * n2)) return false;
    }
    return true;
  }

  /// Whether the middle leaves the triangle by more than `distance`.
  bool bulges_beyond(double distance) const
  {
    if (distance == std::numeric_limits<double>::infinity()) return false;
    constexpr double third = 1.0 / 3;
    return (point(third, third) - third * (corners_[0] + corners_[1] + corners_[2])).squaredNorm() > distance * distance;
  }

  /// Bernstein coefficients of the two vectors that span the tangent planes along an edge.
  struct Tangent_planes
  {
    std::array<Vector_3, 3> w, a;
  };

  static Tangent_planes tangent_planes(const Patch& p, std::size_t i, const Handles& h, Construction construction)
  {
    const std::size_t j = (i + 1) % 3;
    Tangent_planes s;
    s.w = {h.start, (p.points[j] + h.end) - (p.points[i] + h.start), -h.end};
    s.a[0] = p.normals[i].cross(s.w[0]);
    s.a[2] = p.normals[j].cross(s.w[2]);
    if (construction == Construction::mid_edge && p.has_shape_operator[i] && p.has_shape_operator[j]) {
      // n' = S c' at both ends, with c' = 3 W
      const Vector_3 correction = 0.375 * (p.shape_operators[i] * s.w[0] - p.shape_operators[j] * s.w[2]);
      const Vector_3 w = (s.w[0] + 2 * s.w[1] + s.w[2]) / 4;
      const Vector_3 conormal = ((p.normals[i] + p.normals[j]) / 2 + correction).cross(w);
      const double squared_length = conormal.squaredNorm();
      if (correction.squaredNorm() < largest_correction * largest_correction && squared_length > 0) {
        const double stretch = mid_edge_stretch(p, i, j) * std::sqrt(w.squaredNorm() / squared_length);
        s.a[1] = 2 * stretch * conormal - (s.a[0] + s.a[2]) / 2;
        return s;
      }
    }
    s.a[0].normalize();
    s.a[2].normalize();
    s.a[1] = (s.a[0] + s.a[2]).normalized();
    return s;
  }

  /// The length of the conormal at the middle of an edge over that of W: for the edge e on a surface with the Gauss
  /// curvature K, 1 + K e^2 / 16. The twists that the two edges of a corner ask for differ, in its tangent plane, by
  /// third order terms. On a sphere this factor, and no other, takes them away for triangles of any shape: without it the
  /// middle of one with the area A is A^2 / (80 r^3) inside. Of the factors with the same value on spheres it is the one
  /// that leaves cylinders, which are as good as planes, as they are.
  static double mid_edge_stretch(const Patch& p, std::size_t i, std::size_t j)
  {
    const double curvature = second_invariant(p.shape_operators[i] + p.shape_operators[j]) / 4; // of their mean
    const double turn = curvature * (p.points[j] - p.points[i]).squaredNorm();
    return 1 + std::clamp(turn, -1.0, 1.0) / 16; // beyond, shape operators are noise
  }

  /// The twists next to edge `i`: the derivative across it is `(l0 (1 - t) + l1 t) W(t) + (m0 (1 - t) + m1 t) A(t)`,
  /// with the coefficients that the neighbouring edges, which leave its ends with the handles `ac` and `bc`, ask for.
  void set_twists(std::size_t i, const Tangent_planes& s, const Vector_3& ac, const Vector_3& bc)
  {
    const Vector_3 d0 = 0.75 * ac - 0.375 * s.w[0], d3 = 0.75 * bc + 0.375 * s.w[2];
    // a third of each coefficient; two of them for one division
    const double w0 = s.w[0].squaredNorm(), w2 = s.w[2].squaredNorm(), w = 1 / (3 * w0 * w2),
                 a0 = s.a[0].squaredNorm(), a2 = s.a[2].squaredNorm(), a = 1 / (3 * a0 * a2),
                 l0 = d0.dot(s.w[0]) * (w2 * w), l1 = d3.dot(s.w[2]) * (w0 * w),
                 m0 = d0.dot(s.a[0]) * (a2 * a), m1 = d3.dot(s.a[2]) * (a0 * a);
    const Vector_3 &e1 = edges_[i][0], &e2 = edges_[i][1], &e3 = edges_[i][2];
    twists_[i][0] = (e1 + e2) / 2 + (2 * l0 * s.w[1] + l1 * s.w[0]) + (2 * m0 * s.a[1] + m1 * s.a[0]);
    twists_[(i + 1) % 3][1] = (e2 + e3) / 2 + (l0 * s.w[2] + 2 * l1 * s.w[1]) + (m0 * s.a[2] + 2 * m1 * s.a[1]);
  }

  /// Those of the cubic triangle over the same curves whose inner control point is that of Vlachos et al. (2001).
  void set_cubic_interior(const std::array<Handles, 3>& handles)
  {
    Vector_3 center = (corners_[0] + corners_[1] + corners_[2]) / 3;
    for (const Handles& h : handles) center += (h.start + h.end) / 4;
    for (std::size_t i = 0; i < 3; ++i)
      twists_[i][0] = twists_[i][1] = center / 2 + corners_[i] / 2 + (handles[i].start + handles[(i + 2) % 3].end) / 4;
  }

  /// The point as `w r0 + u r1 + v r2`, with a quarter of its partial derivative by each coordinate.
  struct Blend
  {
    double w, u, v;
    std::array<Vector_3, 3> r;
    Vector_3 point() const { return (w * r[0] + u * r[1]) + v * r[2]; }
  };

  /// A twist as a function of the coordinates of the other two corners, which are `b` and `c` of their sum.
  struct Twist
  {
    Vector_3 value, difference;
    double b, c;
  };

  Twist twist(std::size_t corner, double b, double c) const
  {
    const double sum = b + c;
    const double scale = sum > (std::numeric_limits<double>::min)() ? 1 / sum : 0; // it has no weight at the corner
    const Vector_3 &x = twists_[corner][0], &y = twists_[corner][1];
    b *= scale;
    c *= scale;
    return {b * x + c * y, x - y, b, c};
  }

  /// Bernstein polynomials of degree three; sums run so that on an edge they are the same, to the bit, both ways.
  using Weights = std::array<double, 10>;

  static Vector_3 sum(const Weights& b, const Vector_3& p300, const Vector_3& p030, const Vector_3& p003,
                      const Vector_3& p210, const Vector_3& p120, const Vector_3& p021, const Vector_3& p012,
                      const Vector_3& p102, const Vector_3& p201, const Vector_3& p111)
  {
    return (((b[0] * p300 + b[1] * p030) + b[2] * p003) +
            (((b[3] * p210 + b[4] * p120) + (b[5] * p021 + b[6] * p012)) + (b[7] * p102 + b[8] * p201))) +
           b[9] * p111;
  }

  Blend blend(double u, double v) const
  {
    const double w = 1 - u - v, ww = w * w, uu = u * u, vv = v * v;
    const Weights b = {w * ww,       u * uu,       v * vv,       3 * (ww * u), 3 * (uu * w),
                       3 * (uu * v), 3 * (vv * u), 3 * (vv * w), 3 * (ww * v), 6 * ((w * u) * v)};
    const Twist t0 = twist(0, u, v), t1 = twist(1, v, w), t2 = twist(2, w, u);
    const auto& c = corners_;
    const auto &e01 = edges_[0], &e12 = edges_[1], &e20 = edges_[2];
    Blend result{w, u, v,
                 {sum(b, c[0], e01[2], e20[0], e01[0], e01[1], t1.value, t2.value, e20[1], e20[2], t0.value),
                  sum(b, e01[0], c[1], e12[2], e01[1], e01[2], e12[0], e12[1], t2.value, t0.value, t1.value),
                  sum(b, e20[2], e12[0], c[2], t0.value, t1.value, e12[1], e12[2], e20[0], e20[1], t2.value)}};
    add_rational_part(result.r[1], result.r[2], t0, w, u, v);
    add_rational_part(result.r[2], result.r[0], t1, u, v, w);
    add_rational_part(result.r[0], result.r[1], t2, v, w, u);
    return result;
  }

  /// A quarter of the derivatives, by `b` and by `c`, of the weights within a twist, which has the Bernstein
  /// polynomial `12 a^2 b c`.
  static void add_rational_part(Vector_3& by_b, Vector_3& by_c, const Twist& t, double a, double b, double c)
  {
    const Vector_3 d = 3 * ((a * a) * (t.b * t.c)) * t.difference;
    by_b += c * d;
    by_c -= b * d;
  }

  Vector_3 unit_normal(const Vector_3& direction, double u, double v) const
  {
    const double length = direction.norm();
    if (length > 0) return 1 / length * direction;
    return ((1 - u - v) * normals_[0] + u * normals_[1] + v * normals_[2]).normalized();
  }

  std::array<Vector_3, 3> corners_, normals_;
  std::array<std::array<Vector_3, 3>, 3> edges_;   ///< inner control points, from corner `i` to corner `i + 1`
  std::array<std::array<Vector_3, 2>, 3> twists_;  ///< of each corner: next to its edges `i` and `i - 1`
  std::array<Curve, 3> curves_;
  Interior interior_;
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_GREGORY_PATCH_3_H

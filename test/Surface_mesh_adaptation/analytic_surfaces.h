// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces of which everything is known: irregular triangulations with their vertices on the surface, in levels that
// halve the edges, and the exact normal, shape operator, closest point and geodesics.

#ifndef TEST_SURFACE_MESH_ADAPTATION_ANALYTIC_SURFACES_H
#define TEST_SURFACE_MESH_ADAPTATION_ANALYTIC_SURFACES_H

#include "checks.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>

#include <array>
#include <cmath>
#include <vector>

namespace analytic {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Random;
using shapes::Soup;
using shapes::Triangle;
using shapes::Vector_3;
using SMA::Matrix_3;
using SMA::Metric_tensor_3;

/// Derivative of the unit normal along the level set of a function with this gradient and Hessian.
inline Metric_tensor_3 shape_operator(const Vector_3& gradient, const Matrix_3& hessian)
{
  const double length = gradient.norm();
  const Matrix_3 tangential = Matrix_3::Identity() - gradient * gradient.transpose() / (length * length);
  return Metric_tensor_3(Matrix_3(tangential * hessian * tangential / length));
}

/// The ellipsoid with the given half axes around the origin.
struct Ellipsoid
{
  Vector_3 axes = Vector_3(1, 0.7, 0.5);

  /// The inverse of the length on which the surface changes: here, its largest curvature.
  double scale() const { return axes.maxCoeff() / std::pow(axes.minCoeff(), 2); }

  Soup coarse_mesh(int level) const
  {
    Soup s = shapes::sphere(level + 1);
    Random random(3);
    const double h = s.mean_edge_length();
    for (Vector_3& p : s.points) p = (p + 0.3 * h * random.vector().normalized()).normalized().cwiseProduct(axes);
    return s;
  }

  Vector_3 gradient(const Vector_3& p) const { return p.cwiseQuotient(axes.cwiseAbs2()); }
  Vector_3 normal(const Vector_3& p) const { return gradient(p).normalized(); }

  Metric_tensor_3 shape_operator(const Vector_3& p) const
  {
    return analytic::shape_operator(gradient(p), axes.cwiseAbs2().cwiseInverse().asDiagonal());
  }

  /// The point `x` with `x + l gradient(x) = p`: the equation of the ellipsoid is solved for `l` by Newton's method.
  Vector_3 closest_point(const Vector_3& p) const
  {
    const Eigen::Array3d a2 = axes.array().square();
    double l = 0;
    for (int i = 0; i < 5; ++i) {
      const Eigen::Array3d x = a2 * p.array() / (a2 + l);
      l += ((x * x / a2).sum() - 1) / (2 * x * x / (a2 * (a2 + l))).sum();
    }
    return (a2 * p.array() / (a2 + l)).matrix();
  }
};

struct Sphere : Ellipsoid
{
  Sphere() : Ellipsoid{Vector_3(1, 1, 1)} {}
};

struct Torus
{
  double large_radius = 1, small_radius = 0.35;

  double scale() const { return 1 / small_radius; }

  Soup coarse_mesh(int level) const
  {
    const std::size_t n = std::size_t(1) << level;
    return shapes::grid(12 * n, 5 * n, true, true, 0.3, [&](double u, double v) {
      const double a = 2 * shapes::pi * u, b = 2 * shapes::pi * v, r = large_radius + small_radius * std::cos(b);
      return Vector_3(r * std::cos(a), r * std::sin(a), small_radius * std::sin(b));
    });
  }

  /// The closest point of the circle within.
  Vector_3 center(const Vector_3& p) const { return large_radius * Vector_3(p[0], p[1], 0).normalized(); }
  Vector_3 normal(const Vector_3& p) const { return (p - center(p)).normalized(); }
  Vector_3 closest_point(const Vector_3& p) const { return center(p) + small_radius * normal(p); }

  Metric_tensor_3 shape_operator(const Vector_3& p) const
  {
    const Vector_3 radial = center(p) / large_radius, around(-radial[1], radial[0], 0), n = normal(p),
                   meridian = n.cross(around);
    const double distance = p.dot(radial);
    return Metric_tensor_3(Matrix_3(meridian * meridian.transpose() / small_radius +
                                    n.dot(radial) / distance * around * around.transpose()));
  }
};

/// The graph of a function without symmetries over [-1, 1]^2.
struct Graph
{
  double scale() const { return std::sqrt(5.0); } // the wave number of its sine, larger than its curvatures

  Soup coarse_mesh(int level) const
  {
    const std::size_t n = std::size_t(4) << level;
    return shapes::grid(n, n, false, false, 0.3,
                        [&](double u, double v) { return lifted(2 * u - 1, 2 * v - 1); });
  }

  /// Value, gradient and Hessian of the function.
  struct Jet
  {
    double f, x, y, xx, xy, yy;
  };

  Jet jet(double x, double y) const
  {
    const double s = std::sin(2 * x + y), c = std::cos(2 * x + y);
    return {0.3 * x * x - 0.25 * y * y + 0.2 * x * y + 0.15 * s,
            0.6 * x + 0.2 * y + 0.3 * c,
            -0.5 * y + 0.2 * x + 0.15 * c,
            0.6 - 0.6 * s,
            0.2 - 0.3 * s,
            -0.5 - 0.15 * s};
  }

  Vector_3 lifted(double x, double y) const { return Vector_3(x, y, jet(x, y).f); }

  Vector_3 gradient(const Vector_3& p) const
  {
    const Jet j = jet(p[0], p[1]);
    return Vector_3(-j.x, -j.y, 1);
  }

  Vector_3 normal(const Vector_3& p) const { return gradient(p).normalized(); }

  Metric_tensor_3 shape_operator(const Vector_3& p) const
  {
    const Jet j = jet(p[0], p[1]);
    Matrix_3 hessian = Matrix_3::Zero();
    hessian.topLeftCorner<2, 2>() << -j.xx, -j.xy, -j.xy, -j.yy;
    return analytic::shape_operator(gradient(p), hessian);
  }

  /// Newton's method on the squared distance.
  Vector_3 closest_point(const Vector_3& p) const
  {
    Eigen::Vector2d x = p.head<2>();
    for (int i = 0; i < 4; ++i) {
      const Jet j = jet(x[0], x[1]);
      const double height = j.f - p[2];
      const Eigen::Vector2d residual(x[0] - p[0] + height * j.x, x[1] - p[1] + height * j.y);
      Eigen::Matrix2d hessian;
      hessian << 1 + j.x * j.x + height * j.xx, j.x * j.y + height * j.xy,
                 j.x * j.y + height * j.xy, 1 + j.y * j.y + height * j.yy;
      x -= hessian.inverse() * residual;
    }
    return lifted(x[0], x[1]);
  }
};

/// A triangulation with edges of half the length at each level: irregular, of angles and of degrees, for on symmetric
/// ones everything converges faster than it does in general. Edges are flipped as long as that makes the worse of their
/// triangles better.
template <class Surface>
Soup mesh(const Surface& surface, int level)
{
  Soup s = surface.coarse_mesh(level);
  SMA::Mesh_view m = shapes::view(s);
  const auto quality = [&](Index a, Index b, Index c) {
    const Vector_3 &p = s.points[a], &q = s.points[b], &r = s.points[c];
    const bool is_outward = (q - p).cross(r - p).dot(surface.normal(surface.closest_point(p))) > 0;
    return is_outward ? checks::quality(p, q, r) : -1;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (Index h = 0; h < m.number_of_halfedges(); ++h) {
      if (!m.is_edge_owner(h) || m.is_border(h)) continue;
      const Index p = m.source(h), q = m.target(h), b = m.apex(h), a = m.apex(m.twin[h]);
      if ((std::min)(quality(a, b, p), quality(b, a, q)) <= (std::min)(quality(p, q, b), quality(q, p, a))) continue;
      if (m.are_adjacent(a, b)) continue;
      m.flip(h);
      changed = true;
    }
  }
  s.triangles.clear();
  for (std::size_t h = 0; h < m.number_of_halfedges(); h += 3)
    s.triangles.push_back({m.corner[h], m.corner[h + 1], m.corner[h + 2]});
  return s;
}

/// A face with exact normals and shape operators.
template <class Surface>
SMA::Patch patch(const Surface& surface, const Soup& soup, const Triangle& t)
{
  SMA::Patch p;
  for (std::size_t i = 0; i < 3; ++i) {
    p.points[i] = soup.points[t[i]];
    p.normals[i] = surface.normal(p.points[i]);
    p.shape_operators[i] = surface.shape_operator(p.points[i]);
    p.has_shape_operator[i] = true;
  }
  return p;
}

/// Position and velocity on a geodesic.
struct Geodesic_point
{
  Vector_3 position, velocity;
};

/// The geodesic from `p` with the velocity `t` after the time 1, by the classical Runge-Kutta method in space:
/// the acceleration is `-(S v . v) n`.
template <class Surface>
Geodesic_point geodesic(const Surface& surface, const Vector_3& p, const Vector_3& t, int steps)
{
  const auto acceleration = [&](const Vector_3& x, const Vector_3& v) -> Vector_3 {
    const Vector_3 c = surface.closest_point(x);
    return -surface.shape_operator(c).squared_length(v) * surface.normal(c);
  };
  Vector_3 x = p, v = t;
  const double h = 1.0 / steps;
  for (int i = 0; i < steps; ++i) {
    const Vector_3 a1 = acceleration(x, v), v2 = v + h / 2 * a1;
    const Vector_3 a2 = acceleration(x + h / 2 * v, v2), v3 = v + h / 2 * a2;
    const Vector_3 a3 = acceleration(x + h / 2 * v2, v3), v4 = v + h * a3;
    const Vector_3 a4 = acceleration(x + h * v3, v4);
    x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return {x, v};
}

/// Largest and root mean square error of a patch over a triangulation, in the distance and in the normal.
struct Patch_errors
{
  double h, distance, rms_distance, normal, rms_normal;
};

/// 33 points of each patch: on its edges and inside, without the corners. `select(patch)` may mark features, and says
/// whether the face counts.
template <class Reconstruction, class Surface, class Select>
Patch_errors patch_errors(const Surface& surface, const Soup& soup, const Select& select)
{
  Patch_errors e{soup.mean_edge_length(), 0, 0, 0, 0};
  std::size_t samples = 0;
  constexpr int n = 7;
  for (const Triangle& t : soup.triangles) {
    SMA::Patch p = patch(surface, soup, t);
    if (!select(p)) continue;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        if (i == n || j == n || i + j == 0) continue;
        const SMA::Surface_point x = Reconstruction::evaluate(p, double(i) / n, double(j) / n);
        const Vector_3 c = surface.closest_point(x.position);
        const double distance = (c - x.position).norm(), angle = (x.normal - surface.normal(c)).norm();
        e.distance = (std::max)(e.distance, distance);
        e.normal = (std::max)(e.normal, angle);
        e.rms_distance += distance * distance;
        e.rms_normal += angle * angle;
        ++samples;
      }
  }
  e.rms_distance = std::sqrt(e.rms_distance / double(samples));
  e.rms_normal = std::sqrt(e.rms_normal / double(samples));
  return e;
}

template <class Reconstruction, class Surface>
Patch_errors patch_errors(const Surface& surface, int level)
{
  return patch_errors<Reconstruction>(surface, mesh(surface, level), [](const SMA::Patch&) { return true; });
}

} // namespace analytic

#endif // TEST_SURFACE_MESH_ADAPTATION_ANALYTIC_SURFACES_H

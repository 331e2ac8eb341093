// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces and scalar fields of which everything is known in closed form, and meshes of them at several levels.

#ifndef TEST_SURFACE_MESH_ADAPTATION_ANALYTIC_FIELDS_H
#define TEST_SURFACE_MESH_ADAPTATION_ANALYTIC_FIELDS_H

#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/surface/detect_features.h>

#include <functional>
#include <string>
#include <vector>

namespace analytic {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Soup;
using SMA::Matrix_3;
using SMA::Vector_3;

/// A function of space with its first and second derivatives.
struct Function
{
  std::function<double(const Vector_3&)> value;
  std::function<Vector_3(const Vector_3&)> gradient;
  std::function<Matrix_3(const Vector_3&)> hessian;
};

/// A level set of `implicit`, oriented along its gradient, with jittered meshes of it: the edges of a level are half as
/// long as those of the level before.
struct Surface
{
  std::string name;
  double largest_curvature;
  Function implicit;
  std::function<Soup(int level)> mesh;

  Vector_3 normal(const Vector_3& p) const { return implicit.gradient(p).normalized(); }

  /// `dn`, as a tensor of space.
  Matrix_3 shape_operator(const Vector_3& p) const
  {
    const Vector_3 g = implicit.gradient(p), n = g.normalized();
    const Matrix_3 across = Matrix_3::Identity() - n * n.transpose();
    return across * implicit.hessian(p) * across / g.norm();
  }

  /// The covariant hessian of the restriction of `u`: `P D2u P - (grad u . n) dn`.
  Matrix_3 covariant_hessian(const Function& u, const Vector_3& p) const
  {
    const Vector_3 n = normal(p);
    const Matrix_3 across = Matrix_3::Identity() - n * n.transpose();
    return across * u.hessian(p) * across - u.gradient(p).dot(n) * shape_operator(p);
  }
};

/// A smooth function with no symmetry.
inline Function waves()
{
  return {[](const Vector_3& p) {
            return std::sin(2 * p[0] + p[1]) + 0.5 * p[2] * p[0] + 0.3 * std::cos(3 * p[2]);
          },
          [](const Vector_3& p) {
            const double c = std::cos(2 * p[0] + p[1]);
            return Vector_3(2 * c + 0.5 * p[2], c, 0.5 * p[0] - 0.9 * std::sin(3 * p[2]));
          },
          [](const Vector_3& p) {
            const double s = std::sin(2 * p[0] + p[1]);
            Matrix_3 h;
            h << -4 * s, -2 * s, 0.5, -2 * s, -s, 0, 0.5, 0, -2.7 * std::cos(3 * p[2]);
            return h;
          }};
}

/// A quadratic function with the second derivatives `h`.
inline Function quadratic(const Matrix_3& h, const Vector_3& slope)
{
  return {[=](const Vector_3& p) { return p.dot(h * p) / 2 + slope.dot(p); },
          [=](const Vector_3& p) { return Vector_3(h * p + slope); }, [=](const Vector_3&) { return h; }};
}

/// Zero on a line that winds through the unit square upwards, and on one across it.
inline double off_upward_line(const Vector_3& p) { return p[0] - 0.5 + 0.1 * std::sin(2 * shapes::pi * p[1]); }
inline double off_line_across(const Vector_3& p) { return p[1] - 0.3 - 0.1 * std::sin(2 * shapes::pi * p[0]); }

/// A steep front across the unit square.
inline double front(const Vector_3& p) { return std::tanh(50 * off_upward_line(p)); }

/// Three fronts as steep as `front`, each ten times fainter than the one before.
inline double several_scales(const Vector_3& p)
{
  return front(p) + 0.1 * std::tanh(50 * off_line_across(p)) + 0.01 * std::tanh(50 * (p.sum() - 1));
}

/// Two fronts, one of them faint and steeper, and weak waves all over.
inline double fronts_and_waves(const Vector_3& p)
{
  return std::tanh(20 * off_upward_line(p)) + 0.1 * std::tanh(100 * off_line_across(p)) +
         0.02 * std::sin(8 * shapes::pi * (p[0] * p[1] + p[2]));
}

inline std::vector<double> samples(const Function& f, const std::vector<Vector_3>& points)
{
  std::vector<double> values;
  for (const Vector_3& p : points) values.push_back(f.value(p));
  return values;
}

inline Soup mapped(Soup soup, const std::function<Vector_3(const Vector_3&)>& map)
{
  for (Vector_3& p : soup.points) p = map(p);
  return soup;
}

inline Surface ellipsoid()
{
  const Vector_3 axes(1, 0.7, 0.5), weights = axes.cwiseAbs2().cwiseInverse();
  return {"ellipsoid", 1 / (0.5 * 0.5),
          {[=](const Vector_3& p) { return (p.dot(weights.cwiseProduct(p)) - 1) / 2; },
           [=](const Vector_3& p) { return Vector_3(weights.cwiseProduct(p)); },
           [=](const Vector_3&) { return Matrix_3(weights.asDiagonal()); }},
          [=](int level) {
            return mapped(shapes::sphere(level + 1, 0.3), [=](const Vector_3& p) { return axes.cwiseProduct(p); });
          }};
}

inline Surface torus()
{
  const auto from_circle = [](const Vector_3& p) {
    return Vector_3(p - shapes::torus_large_radius * Vector_3(p[0], p[1], 0).normalized());
  };
  return {"torus", 1 / shapes::torus_small_radius,
          {[=](const Vector_3& p) { return from_circle(p).squaredNorm() / 2; }, from_circle,
           [=](const Vector_3& p) {
             const double rho = std::hypot(p[0], p[1]);
             const Vector_3 east(-p[1] / rho, p[0] / rho, 0);
             return Matrix_3(Matrix_3::Identity() - shapes::torus_large_radius / rho * east * east.transpose());
           }},
          [](int level) {
            const std::size_t n = std::size_t(1) << level;
            return shapes::torus(20 * n, 8 * n, 0.3);
          }};
}

/// A saddle over a square, with boundary.
inline Surface graph()
{
  const auto height = [](double x, double y) {
    return 0.3 * x * x - 0.25 * y * y + 0.2 * x * y + 0.15 * std::sin(2 * x + y);
  };
  return {"graph", 1.5,
          {[=](const Vector_3& p) { return p[2] - height(p[0], p[1]); },
           [](const Vector_3& p) {
             const double c = 0.15 * std::cos(2 * p[0] + p[1]);
             return Vector_3(-(0.6 * p[0] + 0.2 * p[1] + 2 * c), -(-0.5 * p[1] + 0.2 * p[0] + c), 1);
           },
           [](const Vector_3& p) {
             const double s = 0.15 * std::sin(2 * p[0] + p[1]);
             Matrix_3 h = Matrix_3::Zero();
             h(0, 0) = -(0.6 - 4 * s);
             h(0, 1) = h(1, 0) = -(0.2 - 2 * s);
             h(1, 1) = -(-0.5 - s);
             return h;
           }},
          [=](int level) {
            const std::size_t n = std::size_t(8) << level;
            return shapes::grid(n, n, false, false, 0.3, [=](double u, double v) {
              const double x = 2 * u - 1, y = 2 * v - 1;
              return Vector_3(x, y, height(x, y));
            });
          }};
}

/// The view of a soup with its features.
struct Featured_mesh
{
  SMA::Mesh_view view;
  SMA::Features features;

  explicit Featured_mesh(const Soup& soup, const SMA::Feature_parameters& parameters = {})
    : view(shapes::view(soup))
    , features(SMA::detect_features(SMA::Sequential_execution(), view, soup.points, parameters))
  {}
};

/// Moves all points at random by `amount` times the mean edge length (standard deviation, in each direction).
inline Soup with_noise(Soup soup, double amount)
{
  const double sigma = amount * soup.mean_edge_length();
  shapes::Random random(77);
  const auto normal = [&] { // Box, Muller 1958
    const double radius = std::sqrt(-2 * std::log(1 - random.real()));
    return radius * std::cos(2 * shapes::pi * random.real());
  };
  for (Vector_3& p : soup.points) {
    const double x = normal(), y = normal(), z = normal();
    p += sigma * Vector_3(x, y, z);
  }
  return soup;
}

} // namespace analytic

#endif // TEST_SURFACE_MESH_ADAPTATION_ANALYTIC_FIELDS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// A vertex that may move, in the plane.

#ifndef TEST_SURFACE_MESH_ADAPTATION_NUMERICS_PLANE_STAR_H
#define TEST_SURFACE_MESH_ADAPTATION_NUMERICS_PLANE_STAR_H

#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/numerics/minimize_worst.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stars_of_tests {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Vector_3;
using SMA::Linear_function_2;
using SMA::Vector_2;

/// A star-shaped ring around a vertex of the plane that may move, in a metric of ratio `stretch`.
struct Plane_star
{
  std::vector<Vector_2> ring;
  SMA::Anisotropic_metric metric;

  Plane_star(shapes::Random& random, double stretch)
    : metric{SMA::Metric_tensor_3(1 / (stretch * stretch), 0, 1, 0, 0, 1)}
  {
    const std::size_t n = 5 + random.below(4);
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * shapes::pi * (double(i) + random.real(-0.35, 0.35)) / double(n);
      const double r = random.real(0.5, 1.5);
      ring.emplace_back(stretch * r * std::cos(angle), r * std::sin(angle));
    }
  }

  SMA::Ring<Linear_function_2> distortions(const Vector_2& p) const
  {
    SMA::Ring<Linear_function_2> functions;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector_2 a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
      const bool is_upright = a.x() * b.y() > a.y() * b.x();
      const Vector_3 ea(a.x(), a.y(), 0), eb(b.x(), b.y(), 0);
      const SMA::Distortion d = face_distortion(metric, metric, metric, ea, eb);
      functions.push_back({is_upright ? d.value : INFINITY, d.gradient.head<2>()});
    }
    return functions;
  }

  double worst(const Vector_2& p) const { return maximum(distortions(p), Vector_2(0, 0)); }

  /// Mean of the ring, weighted by areas: where diffusion leaves the vertex.
  Vector_2 centroid() const
  {
    Vector_2 sum(0, 0);
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector_2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const double w = a.x() * b.y() - a.y() * b.x();
      sum += w * (a + b) / 3;
      area += w;
    }
    return sum / area;
  }

  /// `worst`, continued outside of where all faces are upright such that the way back is downhill.
  double continued_worst(const Vector_2& p) const
  {
    double least = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector_2 a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
      least = (std::min)(least, a.x() * b.y() - a.y() * b.x());
    }
    return least < 0 ? 1e9 - least : (std::min)(1e9, worst(p));
  }

  /// The least worst distortion, by nested line searches: the points where a face is no worse than some bound form a
  /// disc in the metric, so that all functions here have one minimum.
  double optimum() const
  {
    const auto least_on = [](double low, double high, const auto& f) {
      constexpr double golden = 0.6180339887498949;
      double a = high - golden * (high - low), b = low + golden * (high - low), fa = f(a), fb = f(b);
      for (int i = 0; i < 60; ++i)
        if (fa < fb) {
          high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
        } else {
          low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
        }
      return (std::min)(fa, fb);
    };
    const double stretch = 1 / std::sqrt(metric.m[0]);
    return least_on(-1.5 * stretch, 1.5 * stretch, [&](double x) {
      return least_on(-1.5, 1.5, [&](double y) { return continued_worst(Vector_2(x, y)); });
    });
  }
};

} // namespace stars_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_NUMERICS_PLANE_STAR_H

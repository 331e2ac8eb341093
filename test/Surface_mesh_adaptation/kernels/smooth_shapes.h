// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces that are known, for kernels to work on.

#ifndef TEST_SURFACE_MESH_ADAPTATION_KERNELS_SMOOTH_SHAPES_H
#define TEST_SURFACE_MESH_ADAPTATION_KERNELS_SMOOTH_SHAPES_H

#include "shapes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace kernels_of_tests {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Soup;
using shapes::Vector_3;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// A surface of which the normal is known between its ridges.
struct Shape
{
  const char* name;
  Soup soup;
  std::function<Vector_3(const Vector_3&)> normal;
  std::function<double(const Vector_3&)> distance;
};

constexpr double cylinder_height = 2;

inline std::vector<Shape> smooth_shapes()
{
  const auto radial = [](const Vector_3& p) { return Vector_3(p[0], p[1], 0); };
  return {{"sphere", shapes::sphere(3, 0.5), [](const Vector_3& p) { return p; },
           [](const Vector_3& p) { return std::abs(p.norm() - 1); }},
          {"torus", shapes::torus(48, 24, 0.25), shapes::torus_normal, shapes::torus_distance},
          {"square", shapes::square(16, 0.25), [](const Vector_3&) { return Vector_3(0, 0, 1); },
           [](const Vector_3& p) { return std::abs(p[2]); }},
          {"open cylinder", shapes::open_cylinder(32, 12, cylinder_height, 0.25), radial,
           [](const Vector_3& p) { return std::abs(std::hypot(p[0], p[1]) - 1); }}};
}

/// A tube of so many columns and rows of quadrilaterals, cut one way in even rows and the other way in odd ones.
/// `point(column, row)`.
template <class Point>
Soup tube(std::size_t columns, std::size_t rows, const Point& point)
{
  Soup s;
  for (std::size_t r = 0; r <= rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) s.points.push_back(point(c, r));
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t d = (c + 1) % columns;
      const SMA::Index a = SMA::Index(r * columns + c), b = SMA::Index(r * columns + d);
      const SMA::Index above_a = SMA::Index(a + columns), above_b = SMA::Index(b + columns);
      if (r % 2 == 0) {
        s.triangles.push_back({a, b, above_b});
        s.triangles.push_back({a, above_b, above_a});
      } else {
        s.triangles.push_back({a, b, above_a});
        s.triangles.push_back({b, above_b, above_a});
      }
    }
  return s;
}

} // namespace kernels_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_KERNELS_SMOOTH_SHAPES_H

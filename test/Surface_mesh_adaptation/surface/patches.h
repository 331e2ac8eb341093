// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches at random, alone and over the faces of a torus.

#ifndef TEST_SURFACE_MESH_ADAPTATION_SURFACE_PATCHES_H
#define TEST_SURFACE_MESH_ADAPTATION_SURFACE_PATCHES_H

#include "analytic_surfaces.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/surface/Gregory_patch_3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace patches_of_tests {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::Random;
using shapes::Soup;
using shapes::Triangle;
using shapes::Vector_3;
using SMA::Gregory_patch_3;
using SMA::Mesh_view;
using SMA::Metric_tensor_3;
using SMA::Patch;
using SMA::Surface_point;
using Construction = Gregory_patch_3::Construction;
using Curve = Gregory_patch_3::Curve;
using Interior = Gregory_patch_3::Interior;

inline const SMA::Sequential_execution sequential;

/// A symmetric tensor with `n` in its kernel and otherwise at random.
inline Metric_tensor_3 random_shape_operator(const Vector_3& n, Random& random)
{
  const SMA::Matrix_3 tangential = SMA::Matrix_3::Identity() - n * n.transpose();
  SMA::Matrix_3 s;
  for (int i = 0; i < 3; ++i) s.col(i) = random.vector();
  return Metric_tensor_3(SMA::Matrix_3(tangential * (s + s.transpose()) * tangential));
}

/// A face near the plane z = 0 with normals up to 20 degrees off the vertical.
inline Patch random_patch(Random& random)
{
  Patch p;
  p.points = {Vector_3(0, 0, 0) + 0.1 * random.vector(), Vector_3(1, 0, 0) + 0.1 * random.vector(),
              Vector_3(0.3, 0.8, 0) + 0.1 * random.vector()};
  for (std::size_t i = 0; i < 3; ++i) {
    p.normals[i] = (Vector_3::UnitZ() + 0.2 * random.vector()).normalized();
    p.shape_operators[i] = 0.5 * random_shape_operator(p.normals[i], random);
    p.has_shape_operator[i] = random.below(4) > 0;
    p.is_feature[i] = random.below(3) == 0;
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (Vector_3& t : p.tangents[i]) t = (p.points[(i + 1) % 3] - p.points[i] + 0.1 * random.vector()).normalized();
  return p;
}

/// Barycentric coordinates, for corners 1 and 2, of the point that lies by `t` between the ends of an edge.
inline std::array<double, 2> on_edge(std::size_t edge, double t)
{
  if (edge == 0) return {t, 0};
  if (edge == 1) return {1 - t, t};
  return {0, 1 - t};
}

/// A closed mesh with a patch on each face.
struct Patches
{
  Mesh_view mesh;
  std::vector<Patch> of_face;
};

/// The torus with normals tilted at random by up to `tilt` radians, each vertex with a shape operator out of the blue
/// or none.
inline Patches tilted_torus(double tilt)
{
  const analytic::Torus torus;
  const Soup soup = analytic::mesh(torus, 2);
  Random random(9);
  std::vector<Vector_3> normals;
  std::vector<Metric_tensor_3> operators;
  for (const Vector_3& p : soup.points) {
    const Vector_3 n = torus.normal(p), axis = n.cross(random.vector()).normalized();
    normals.push_back(Eigen::AngleAxisd(random.real(0, tilt), axis) * n);
    operators.push_back(random_shape_operator(normals.back(), random));
  }
  Patches result{shapes::view(soup), {}};
  for (const Triangle& t : soup.triangles) {
    Patch p;
    for (std::size_t i = 0; i < 3; ++i) {
      p.points[i] = soup.points[t[i]];
      p.normals[i] = normals[t[i]];
      p.shape_operators[i] = operators[t[i]];
      p.has_shape_operator[i] = t[i] % 5 > 0;
      p.tangents[i].fill(Vector_3::Zero());
    }
    result.of_face.push_back(p);
  }
  return result;
}

inline bool is_gregory(const Patch& p) { return Gregory_patch_3(p).interior() == Interior::gregory; }

} // namespace patches_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_SURFACE_PATCHES_H

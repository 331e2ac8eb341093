// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature tensors at the vertices of a reference surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_CURVATURE_H
#define CGAL_SURFACE_MESH_ADAPTATION_CURVATURE_H

#include <CGAL/Surface_mesh_adaptation/Features.h>
#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>

#include <Eigen/Cholesky>

#include <array>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// The shape operator of a face as a tensor of space: the symmetric map that takes, in the sense of least squares,
/// each edge to the difference of the normals at its ends (Rusinkiewicz 2004). Zero for degenerate faces.
inline Metric_tensor_3 shape_operator_of_face(const std::array<Vector_3, 3>& p, const std::array<Vector_3, 3>& n)
{
  const Metric_tensor_3 zero(0, 0, 0, 0, 0, 0);
  const Vector_3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  if (!(normal.squaredNorm() > 0)) return zero;
  const Vector_3 u = (p[1] - p[0]).normalized(), v = normal.normalized().cross(u);
  Matrix_3 a = Matrix_3::Zero();
  Vector_3 b = Vector_3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector_3 e = p[(i + 1) % 3] - p[i], dn = n[(i + 1) % 3] - n[i];
    const double x = e.dot(u), y = e.dot(v);
    Eigen::Matrix<double, 2, 3> rows;
    rows << x, y, 0, 0, x, y;
    a += rows.transpose() * rows;
    b += rows.transpose() * Eigen::Vector2d(dn.dot(u), dn.dot(v));
  }
  const Vector_3 s = a.ldlt().solve(b);
  if (!s.allFinite()) return zero;
  return Metric_tensor_3(Matrix_3(s[0] * u * u.transpose() + s[1] * (u * v.transpose() + v * u.transpose()) +
                                  s[2] * v * v.transpose()));
}

/// Curvature of the feature curve at a node, as a tensor along its tangent.
template <class Reference>
Metric_tensor_3 curvature_of_curve(const Reference& reference, Index v)
{
  const auto node = reference.features.node_of_vertex[v];
  const auto& c = reference.features.curves[node.curve];
  const std::size_t n = c.vertices.size(), i = node.index;
  const std::size_t before = i == 0 ? n - 2 : i - 1, after = i + 1;
  const double length = c.arc_length[after] - c.arc_length[i] +
                        (i == 0 ? c.length() - c.arc_length[before] : c.arc_length[i] - c.arc_length[before]);
  const Vector_3 a = (reference.points[v] - reference.points[c.vertices[before]]).normalized();
  const Vector_3 b = (reference.points[c.vertices[after]] - reference.points[v]).normalized();
  if (!(length > 0)) return Metric_tensor_3(0, 0, 0, 0, 0, 0);
  const double curvature = 2 * (b - a).norm() / length;
  return Metric_tensor_3(Matrix_3(curvature * c.tangents[i] * c.tangents[i].transpose()));
}

} // namespace internal

/// The shape operator (eigenvalues: principal curvatures, eigenvectors: principal directions and the normal) at every
/// vertex: the mean over the faces around it, weighted by area. At curve vertices the curvature of the curve is added,
/// so that the curve is resolved as well.
template <class Execution, class Reference>
std::vector<Metric_tensor_3> curvature_tensors(const Execution& execution, const Reference& reference)
{
  const Mesh_view& mesh = reference.mesh;
  const std::size_t faces = mesh.number_of_faces(), n = mesh.number_of_vertices();
  std::vector<Metric_tensor_3> of_face(faces), result(n);
  std::vector<double> area(faces);
  for_each_index(execution, faces, [&](std::size_t f) {
    std::array<Vector_3, 3> p, normals;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = reference.points[mesh.corner[3 * f + i]];
      normals[i] = reference.normals.at(Index(3 * f + i));
    }
    of_face[f] = internal::shape_operator_of_face(p, normals);
    area[f] = (p[1] - p[0]).cross(p[2] - p[0]).norm();
  });
  for_each_index(execution, n, [&](std::size_t v) {
    Metric_tensor_3 sum(0, 0, 0, 0, 0, 0);
    double weight = 0;
    mesh.for_each_outgoing(Index(v), [&](Index h) {
      sum += area[h / 3] * of_face[h / 3];
      weight += area[h / 3];
    });
    result[v] = weight > 0 ? (1 / weight) * sum : sum;
    if (reference.features.vertex_class[v] == Vertex_class::curve)
      result[v] += internal::curvature_of_curve(reference, Index(v));
  });
  return result;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_CURVATURE_H

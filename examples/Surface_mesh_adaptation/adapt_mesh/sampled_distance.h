// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_SAMPLED_DISTANCE_H
#define ADAPT_MESH_SAMPLED_DISTANCE_H

#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace adapt_mesh {

template <class Execution>
SMA::Triangle_tree tree_of_faces(const Execution& execution, const Mesh& mesh)
{
  const auto surface = SMA::read_face_graph(execution, mesh, mesh.points());
  return SMA::Triangle_tree(execution, surface.mesh, surface.points);
}

/// Points spread evenly over the area, in the order of the tree, every second one at a corner: the same number on any
/// mesh, the same points in any run. Within the triangles they follow a sequence that leaves no gaps (M. Roberts, *The
/// unreasonable effectiveness of quasirandom sequences*, 2018).
inline std::vector<SMA::Vector_3> samples(const SMA::Triangle_tree& tree)
{
  constexpr std::size_t number_of_samples = 50000;
  constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
  const auto area = [&](std::size_t i) {
    return (tree[i][1] - tree[i][0]).cross(tree[i][2] - tree[i][0]).norm();
  };
  const auto fraction = [](double x) { return x - std::floor(x); };
  const auto inside = [&](std::size_t i, std::size_t n) {
    const double u = fraction(0.5 + double(n) * step_u), v = fraction(0.5 + double(n) * step_v);
    const auto [s, t] = u + v > 1 ? std::pair(1 - u, 1 - v) : std::pair(u, v);
    return SMA::Vector_3(tree[i][0] + s * (tree[i][1] - tree[i][0]) + t * (tree[i][2] - tree[i][0]));
  };
  double whole = 0, passed = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) whole += area(i);
  std::vector<SMA::Vector_3> result;
  result.reserve(number_of_samples);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    passed += area(i);
    for (std::size_t n = result.size(); n < number_of_samples && (double(n) + 0.5) * whole < passed * number_of_samples; ++n)
      result.push_back(n % 2 == 0 ? inside(i, n / 2) : tree[i][n / 2 % 3]);
  }
  return result;
}

/// The largest distance of samples of one surface from the other.
template <class Execution>
double one_sided_sampled_distance(const Execution& execution, const SMA::Triangle_tree& from, const SMA::Triangle_tree& to)
{
  const std::vector<SMA::Vector_3> points = samples(from);
  return std::sqrt(SMA::accumulate(execution, points.size(), SMA::Largest_distance(), [&](auto& largest, std::size_t i) {
    largest.add(to, points[i]);
  }, SMA::larger).squared());
}

/// Two-sided Hausdorff distance between samples.
template <class Execution>
double sampled_distance(const Execution& execution, const Mesh& a, const Mesh& b)
{
  const SMA::Triangle_tree tree_a = tree_of_faces(execution, a), tree_b = tree_of_faces(execution, b);
  return (std::max)(one_sided_sampled_distance(execution, tree_a, tree_b),
                    one_sided_sampled_distance(execution, tree_b, tree_a));
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_SAMPLED_DISTANCE_H

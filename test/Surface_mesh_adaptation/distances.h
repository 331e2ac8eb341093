// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sampled distances between two meshes, and CGAL's simplification by quadric errors to compare with. Shares no code
// with the library.

#ifndef TEST_SURFACE_MESH_ADAPTATION_DISTANCES_H
#define TEST_SURFACE_MESH_ADAPTATION_DISTANCES_H

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // since CGAL 6
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace distances {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif

struct Distance
{
  double largest = 0;
  double rms = 0;      ///< over the area
};

/// Calls `f(point, weight)` for points on a grid in each triangle, about `n` in all, with weights that sum to 1.
template <class F>
void for_each_sample(const Mesh& mesh, double n, const F& f)
{
  std::vector<double> areas;
  double sum = 0;
  const auto corner = [&](Mesh::Halfedge_index h) { return mesh.point(mesh.source(h)); };
  for (const auto face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    const Kernel::Point_3 a = corner(h), b = corner(mesh.next(h)), c = corner(mesh.prev(h));
    areas.push_back(std::sqrt(CGAL::cross_product(b - a, c - a).squared_length()) / 2);
    sum += areas.back();
  }
  std::size_t i = 0;
  for (const auto face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    const Kernel::Point_3 a = corner(h), b = corner(mesh.next(h)), c = corner(mesh.prev(h));
    const double share = areas[i++] / sum;
    const int k = (std::max)(1, int(std::ceil(std::sqrt(2 * n * share)))); // parts of each edge
    for (int p = 0; p <= k; ++p)
      for (int q = 0; p + q <= k; ++q) {
        const int sides = (p == 0 ? 1 : 0) + (q == 0 ? 1 : 0) + (p + q == k ? 1 : 0);
        const double small_triangles = sides == 0 ? 6 : sides == 1 ? 3 : 1;
        f(a + double(p) / k * (b - a) + double(q) / k * (c - a), share * small_triangles / (3.0 * k * k));
      }
  }
}

/// From `n` samples of `mesh` to the triangles in `tree`.
inline Distance distance(const Mesh& mesh, const Tree& tree, double n)
{
  Distance d;
  double mean_square = 0;
  for_each_sample(mesh, n, [&](const Kernel::Point_3& p, double weight) {
    const double square = tree.squared_distance(p);
    d.largest = (std::max)(d.largest, std::sqrt(square));
    mean_square += weight * square;
  });
  d.rms = std::sqrt(mean_square);
  return d;
}

/// A mesh that others are compared with.
class Original
{
public:
  explicit Original(const Mesh& mesh) : mesh_(mesh), tree_(faces(mesh).begin(), faces(mesh).end(), mesh)
  {
    tree_.accelerate_distance_queries();
  }

  /// In both directions: the larger of the largest, and the root of the mean of the squares.
  Distance distance_to(const Mesh& other, double n) const
  {
    Tree tree(faces(other).begin(), faces(other).end(), other);
    tree.accelerate_distance_queries();
    const Distance to = distance(mesh_, tree, n), from = distance(other, tree_, n);
    return {(std::max)(to.largest, from.largest), std::sqrt((to.rms * to.rms + from.rms * from.rms) / 2)};
  }

  double diagonal() const
  {
    const auto box = tree_.bbox();
    return std::sqrt(CGAL::squared_distance(Kernel::Point_3(box.xmin(), box.ymin(), box.zmin()),
                                            Kernel::Point_3(box.xmax(), box.ymax(), box.zmax())));
  }

private:
  const Mesh& mesh_;
  Tree tree_;
};

/// `mesh` with at most `vertices` vertices, by edge collapses with the cost and placement of `Policies` for quadric
/// errors, without those that turn a face over.
template <class Policies>
Mesh simplified(Mesh mesh, std::size_t vertices)
{
  namespace SMS = CGAL::Surface_mesh_simplification;
  const Policies policies(mesh);
  const auto stop = [&](const auto&...) { return mesh.number_of_vertices() <= vertices; };
  SMS::edge_collapse(mesh, stop,
                     CGAL::parameters::get_cost(policies.get_cost())
                       .get_placement(policies.get_placement())
                       .filter(SMS::Bounded_normal_change_filter<>()));
  mesh.collect_garbage();
  return mesh;
}

using Plane_quadrics = CGAL::Surface_mesh_simplification::GarlandHeckbert_plane_policies<Mesh, Kernel>;
using Triangle_quadrics = CGAL::Surface_mesh_simplification::GarlandHeckbert_triangle_policies<Mesh, Kernel>;
using Probabilistic_quadrics = CGAL::Surface_mesh_simplification::GarlandHeckbert_probabilistic_plane_policies<Mesh, Kernel>;

} // namespace distances

#endif // TEST_SURFACE_MESH_ADAPTATION_DISTANCES_H

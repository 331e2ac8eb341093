// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes beside edges that cannot change. Where these are shorter than what is asked for, sizes grow from there by a
// gradation. Where they are longer, no face beside them can be small: sizes are as large there, and come back soon.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_PROTECTED_SIZES_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_PROTECTED_SIZES_H

#include <CGAL/Surface_mesh_adaptation/fields/Graded_bounds.h>
#include <CGAL/Surface_mesh_adaptation/fields/tightened_metric.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Bounds of sizes, or of the factors of tensors, at protected edges that are beside others.
class Sizes_at_protected_edges
{
public:
  std::vector<Graded_bounds::Source> upper;
  std::vector<Graded_bounds::Source> negated_lower;

  template <class Surface>
  Sizes_at_protected_edges(const Surface& surface, double gradation)
  {
    const Mesh_view& mesh = surface.mesh;
    find_shortest(surface);
    for (Index v = 0; v < shortest_.size(); ++v)
      if (shortest_[v] < none)
        upper.push_back({surface.points[v], shortest_[v] * limited_value(surface.metrics[v]),
                         slope(surface.metrics[v], gradation)});
    for (Index h = 0; h < mesh.number_of_halfedges(); ++h)
      if (mesh.is_protected(h) && mesh.is_edge_owner(h) && is_beside_others(mesh, h)) add_long_edge(surface, h, gradation);
  }

private:
  static constexpr double none = std::numeric_limits<double>::infinity();
  static constexpr double reach = 3;             // sizes from a long edge to where the metric is as it was
  static constexpr double growth = 2;            // of sizes along such an edge, from its ends on
  static constexpr std::size_t most_places = 64; // on one edge

  static bool is_beside_others(const Mesh_view& mesh, Index h)
  {
    for (const Index g : {h, mesh.twin[h]})
      if (g != no_index && !(mesh.is_protected(Mesh_view::next(g)) && mesh.is_protected(Mesh_view::previous(g))))
        return true;
    return false;
  }

  /// The length in the metric of the shortest protected edge at each vertex that has other edges, too.
  template <class Surface>
  void find_shortest(const Surface& surface)
  {
    const Mesh_view& mesh = surface.mesh;
    shortest_.assign(mesh.number_of_vertices(), none);
    for (Index h = 0; h < mesh.number_of_halfedges(); ++h) {
      if (!mesh.is_protected(h) || !mesh.is_edge_owner(h) || !is_beside_others(mesh, h)) continue;
      for (const Index v : {mesh.source(h), mesh.target(h)}) shortest_[v] = (std::min)(shortest_[v], surface.length(h));
    }
  }

  /// Sizes along the edge are no larger than it is, and than they can grow from its ends on.
  template <class Surface>
  void add_long_edge(const Surface& surface, Index h, double gradation)
  {
    const Index a = surface.mesh.source(h), b = surface.mesh.target(h);
    const double length = surface.length(h);
    if (length <= 1) return;
    const std::size_t n = (std::min)(most_places, std::size_t(std::ceil(2 * length)));
    for (std::size_t i = 0; i <= n; ++i) {
      const double t = double(i) / double(n);
      const auto& metric = surface.metrics[t < 0.5 ? a : b];
      const double factor = (std::min)({length, shortest_[a] + growth * t * length,
                                        shortest_[b] + growth * (1 - t) * length});
      const double size = limited_value(metric);
      negated_lower.push_back({(1 - t) * surface.points[a] + t * surface.points[b], -factor * size,
                               (std::max)(slope(metric, gradation), (factor - 1) * slope_to_come_back(metric))});
    }
  }

  /// By which a bound of twice the size is back at that within `reach`.
  template <class Metric>
  static double slope_to_come_back(const Metric& metric)
  {
    return slope(metric, std::exp(1.0)) / reach;
  }

  std::vector<double> shortest_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_PROTECTED_SIZES_H

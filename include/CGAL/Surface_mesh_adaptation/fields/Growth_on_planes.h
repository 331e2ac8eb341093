// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes inside of the planes of a CAD tessellation, whose triangles may be far longer than the sizes at their corners.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GROWTH_ON_PLANES_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GROWTH_ON_PLANES_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/Graded_bounds.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Lets sizes from the curvature grow inside of planes of the shape. A tessellation has vertices on the borders of a
/// plane only, and where these are curved tightly the interpolation asks for that size all over the plane. There is no
/// curvature inside: sizes are at least a quarter of what the gradation allows from the border on. No more, so that
/// nothing changes but where faces are some twenty times as long as the sizes at their corners.
class Growth_on_planes
{
public:
  Growth_on_planes() = default; ///< none

  /// Of `sizes` at the vertices, which grow by `gradation` up to `largest`.
  template <class Execution, class Reference>
  Growth_on_planes(const Execution& execution, const Reference& reference, const std::vector<double>& sizes,
                   double gradation, double largest)
    : slope_(std::log(gradation)), largest_(largest)
  {
    if (!(slope_ > 0) || reference.features.facets.empty()) return;
    std::vector<std::uint8_t> is_long(reference.mesh.number_of_faces());
    for_each_index(execution, is_long.size(), [&](std::size_t f) {
      is_long[f] = reference.is_plane(Index(f)) && is_long_face(reference, sizes, Index(f));
    });
    if (std::find(is_long.begin(), is_long.end(), 1) == is_long.end()) return;
    is_long_ = std::move(is_long);
    bounds_ = Graded_bounds(execution, sources(reference, sizes));
  }

  /// The size at `p`, where that of the interpolation is `size`.
  template <class Reference>
  double at(const Reference& reference, const Location& l, const Vector_3& p, double size) const
  {
    if (is_long_.empty() || share * largest_ <= size || !is_inside(reference, l)) return size;
    return (std::max)(size, share * bounds_.least(p, largest_));
  }

private:
  static constexpr double share = 0.25; // of what the gradation allows

  /// Whether growth may matter anywhere in the face `f`.
  template <class Reference>
  bool is_long_face(const Reference& reference, const std::vector<double>& sizes, Index f) const
  {
    double longest = 0, least = largest_;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      longest = (std::max)(longest, length(reference, h));
      least = (std::min)(least, sizes[reference.mesh.source(h)]);
    }
    return share * (least + slope_ * longest) > least;
  }

  template <class Reference>
  static double length(const Reference& reference, Index h)
  {
    return (reference.points[reference.mesh.target(h)] - reference.points[reference.mesh.source(h)]).norm();
  }

  /// All corners of planes; and where a plane ends in something curved, which keeps the sizes of the interpolation,
  /// points of the border, so near to each other that the growth between them does not matter.
  template <class Reference>
  std::vector<Graded_bounds::Source> sources(const Reference& reference, const std::vector<double>& sizes) const
  {
    constexpr double spacing = 4, most = 1024; // sizes from one to the next, points on an edge
    std::vector<Graded_bounds::Source> result;
    for (std::size_t i = 0; i < reference.mesh.number_of_halfedges(); ++i) {
      const Index h = Index(i), v = reference.mesh.source(h), w = reference.mesh.target(h), t = reference.mesh.twin[h];
      if (!reference.is_plane(Mesh_view::face(h))) continue;
      const bool is_flat = t == no_index || reference.is_plane(Mesh_view::face(t));
      const double length_in_sizes = length(reference, h) / (std::min)(sizes[v], sizes[w]);
      const double n = is_flat ? 1 : std::ceil((std::min)(most, length_in_sizes / spacing));
      for (double k = 0; k < n; ++k) {
        const Vector_3 p = reference.points[v] + k / n * (reference.points[w] - reference.points[v]);
        result.push_back({p, sizes[v] + k / n * (sizes[w] - sizes[v]), slope_});
      }
    }
    return result;
  }

  /// Whether there are only planes around `l`, and long faces among them.
  template <class Reference>
  bool is_inside(const Reference& reference, const Location& l) const
  {
    if (l.kind == Vertex_class::smooth) return is_long_[l.cell];
    if (l.kind == Vertex_class::corner) return false;
    const auto [vertices, weights] = reference.interpolation(l);
    const Index h = reference.mesh.any_halfedge(vertices[0], vertices[1]), t = reference.mesh.twin[h];
    return is_long_[Mesh_view::face(h)] && (t == no_index || is_long_[Mesh_view::face(t)]);
  }

  double slope_ = 0, largest_ = 0;
  std::vector<std::uint8_t> is_long_;
  Graded_bounds bounds_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GROWTH_ON_PLANES_H

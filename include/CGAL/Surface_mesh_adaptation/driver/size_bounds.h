// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the user asks for in faces, by their material for instance: bounds of sizes, at the vertices, and distances of the
// mesh from the surface.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_SIZE_BOUNDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_SIZE_BOUNDS_H

#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/fields/background_of_field.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Adds the bounds of a face with the corners from halfedge `h` on; 0 is no bound. At vertices of faces with several the
/// smaller ones count.
/// \throws Invalid_parameter_error
inline void add_bounds(const Mesh_view& mesh, Index h, const std::pair<double, double>& of_face, Vertex_size_bounds& bounds)
{
  const auto [hmin, hmax] = of_face;
  if (!(hmin >= 0 && hmax >= 0 && std::isfinite(hmin) && (hmax == 0 || hmin <= hmax)))
    throw Invalid_parameter_error("bounds of sizes must be positive or 0, and the lower one at most the upper one");
  for (Index corner = h; corner < h + 3; ++corner) {
    double &lower = bounds.lower[mesh.corner[corner]], &upper = bounds.upper[mesh.corner[corner]];
    lower = (std::min)(lower, hmin);
    if (hmax > 0) upper = (std::min)(upper, hmax);
  }
}

/// The bounds that `face_size_bounds_map` gives; none if there is no such map, or no bound in it.
/// \throws Invalid_parameter_error
template <class FaceGraph, class NamedParameters>
Vertex_size_bounds vertex_size_bounds(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported,
                                      const NamedParameters& np)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  Vertex_size_bounds bounds;
  if constexpr (has_parameter<NamedParameters, internal_np::face_size_bounds_map_t>) {
    const auto map = CGAL::parameters::get_parameter(np, internal_np::face_size_bounds_map);
    const auto at = [&](Index h) -> std::pair<double, double> { return get(map, face(imported.halfedges[h], graph)); };
    const std::size_t n = imported.halfedges.size();
    bool is_bounded = false;
    for (Index h = 0; h < n && !is_bounded; h += 3) is_bounded = at(h) != std::pair<double, double>(0, 0);
    if (!is_bounded) return bounds;
    bounds.lower.assign(imported.vertices.size(), none);
    bounds.upper.assign(imported.vertices.size(), none);
    for (Index h = 0; h < n; h += 3) add_bounds(imported.mesh, h, at(h), bounds);
  }
  return bounds;
}

/// The deviations that `face_deviation_map` gives; empty if there is no such map, or nothing but 0 in it.
/// \throws Invalid_parameter_error
template <class FaceGraph, class NamedParameters>
std::vector<double> face_deviations(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported,
                                    const NamedParameters& np)
{
  std::vector<double> deviations;
  if constexpr (has_parameter<NamedParameters, internal_np::face_deviation_map_t>) {
    const auto map = CGAL::parameters::get_parameter(np, internal_np::face_deviation_map);
    for (std::size_t h = 0; h < imported.halfedges.size(); h += 3)
      deviations.push_back(CGAL::to_double(get(map, face(imported.halfedges[h], graph))));
    for (const double d : deviations)
      if (!(d >= 0 && std::isfinite(d))) throw Invalid_parameter_error("deviations of faces must be positive or 0");
    if (std::count(deviations.begin(), deviations.end(), 0.0) == std::ptrdiff_t(deviations.size())) deviations.clear();
  }
  return deviations;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_SIZE_BOUNDS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polygons of a soup, divided into triangles.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGULATE_POLYGONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGULATE_POLYGONS_H

#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>

#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/iterator.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Triangulates single polygons with different corners, given by the indices of points. A polygon that crosses itself,
/// or has no area, is divided from its first corner.
template <class Point>
class Polygon_triangulator
{
public:
  explicit Polygon_triangulator(const std::vector<Point>& points) : points_(points) {}

  Triangle_soup operator()(const std::vector<std::uint32_t>& polygon)
  {
    try {
      triangulate(polygon);
    } catch (const std::exception&) { // of what CGAL asserts
      triangles_.clear();
    }
    if (triangles_.size() != polygon.size() - 2) divide(polygon);
    return triangles_;
  }

private:
  using Mesh = CGAL::Surface_mesh<Point>;

  /// \pre `face_` is empty
  void triangulate(const std::vector<std::uint32_t>& polygon)
  {
    triangles_.clear();
    face_.clear_without_removing_property_maps();
    std::vector<typename Mesh::Vertex_index> corners;
    for (const std::uint32_t v : polygon) corners.push_back(face_.add_vertex(points_[v]));
    if (!CGAL::Polygon_mesh_processing::triangulate_face(face_.add_face(corners), face_)) return;
    for (const auto f : face_.faces()) {
      triangles_.emplace_back();
      std::size_t i = 0;
      for (const auto v : CGAL::vertices_around_face(face_.halfedge(f), face_)) {
        if (i == 3) return triangles_.clear();
        triangles_.back()[i++] = polygon[std::size_t(v)];
      }
    }
  }

  void divide(const std::vector<std::uint32_t>& polygon)
  {
    triangles_.clear();
    for (std::size_t i = 2; i < polygon.size(); ++i) triangles_.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }

  const std::vector<Point>& points_;
  Mesh face_; // kept, as its making takes long
  Triangle_soup triangles_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGULATE_POLYGONS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polygons of a soup, divided into triangles.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGULATE_POLYGONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGULATE_POLYGONS_H

#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <iterator>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Triangulates single polygons with different corners, given by the indices of points. A polygon that CGAL finds no
/// triangles for, as it crosses itself or has no area, is divided from its first corner.
template <class Point>
class Polygon_triangulator
{
public:
  explicit Polygon_triangulator(const std::vector<Point>& points) : points_(points) {}

  Triangle_soup operator()(const std::vector<std::uint32_t>& polygon) const
  {
    Triangle_soup triangles = filling(polygon);
    if (triangles.size() != polygon.size() - 2) triangles = fan(polygon);
    return triangles;
  }

private:
  /// The polygon as a hole to be filled. (As a face to be triangulated it may not touch or cross itself.)
  Triangle_soup filling(const std::vector<std::uint32_t>& polygon) const
  {
    std::vector<Point> corners;
    for (const std::uint32_t v : polygon) corners.push_back(points_[v]);
    std::vector<CGAL::Triple<int, int, int>> filling;
    try {
      CGAL::Polygon_mesh_processing::triangulate_hole_polyline(corners, std::back_inserter(filling));
    } catch (const std::exception&) { // of what CGAL asserts
      return {};
    }
    Triangle_soup triangles;
    const auto corner = [&](int i) { return polygon[std::size_t(i)]; };
    for (const auto& t : filling) triangles.push_back({corner(t.first), corner(t.second), corner(t.third)});
    return triangles;
  }

  static Triangle_soup fan(const std::vector<std::uint32_t>& polygon)
  {
    Triangle_soup triangles;
    for (std::size_t i = 2; i < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
    return triangles;
  }

  const std::vector<Point>& points_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGULATE_POLYGONS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// From points and triangles, as files have them, to a face graph.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGLE_SOUP_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGLE_SOUP_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

using Triangle_soup = std::vector<std::array<std::uint32_t, 3>>;

namespace internal {

template <class Point>
void check_points(const std::vector<Point>& points)
{
  const auto is_finite = [](const auto& x) { return std::isfinite(CGAL::to_double(x)); };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i].x()) || !is_finite(points[i].y()) || !is_finite(points[i].z()))
      throw Non_finite_coordinate_error(i);
}

inline void check_triangles(const Triangle_soup& triangles, std::size_t number_of_points)
{
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    for (const std::uint32_t v : t)
      if (v >= number_of_points) throw Invalid_input_error("a face has a vertex that does not exist", "face", i);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      throw Invalid_input_error("a face has the same vertex twice", "face", i);
  }
}

/// Drops the points that no triangle uses, numbers the corners of the triangles accordingly, and returns the former
/// index of each point that is left.
template <class Point>
std::vector<std::uint32_t> remove_unused_points(std::vector<Point>& points, Triangle_soup& triangles)
{
  constexpr std::uint32_t unused = std::uint32_t(-1);
  std::vector<std::uint32_t> new_index(points.size(), unused);
  for (const auto& t : triangles)
    for (const std::uint32_t v : t) new_index[v] = 0;

  std::vector<std::uint32_t> former_index;
  for (std::uint32_t i = 0; i < new_index.size(); ++i)
    if (new_index[i] != unused) {
      new_index[i] = std::uint32_t(former_index.size());
      points[former_index.size()] = points[i];
      former_index.push_back(i);
    }
  points.erase(points.begin() + std::ptrdiff_t(former_index.size()), points.end());

  for (auto& t : triangles)
    for (std::uint32_t& v : t) v = new_index[v];
  return former_index;
}

/// Raises an error at the first place where the triangles are not an orientable manifold. CGAL would cut there.
class Reject_non_manifold : public CGAL::Polygon_mesh_processing::Default_orientation_visitor
{
public:
  explicit Reject_non_manifold(const std::vector<std::uint32_t>& former_index) : former_index_(former_index) {}

  void non_manifold_edge(std::size_t v, std::size_t w, std::size_t number_of_faces)
  {
    throw Invalid_input_error("the edge to the vertex " + std::to_string(former_index_[w]) + " has " +
                                std::to_string(number_of_faces) + " faces",
                              "vertex", former_index_[v]);
  }

  void non_manifold_vertex(std::size_t v, std::size_t)
  {
    throw Invalid_input_error("the faces around a vertex do not form a single fan, or cannot be oriented consistently",
                              "vertex", former_index_[v]);
  }

private:
  const std::vector<std::uint32_t>& former_index_;
};

} // namespace internal

/// Builds the empty face graph `mesh` from triangles given by the indices of their corners in `points`. The faces are
/// oriented consistently: in each component like its first one. The points that no triangle uses are left out.
///
/// Returns the vertex of each point, or `null_vertex()` for a point that is left out.
/// \throws Invalid_input_error if a coordinate is not finite, if a triangle has a corner that does not exist or twice
///         the same, or if the triangles do not form an orientable 2-manifold
template <class Point, class TriangleMesh>
auto triangle_soup_to_triangle_mesh(std::vector<Point> points, Triangle_soup triangles, TriangleMesh& mesh)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Graph_traits = boost::graph_traits<TriangleMesh>;

  internal::check_points(points);
  internal::check_triangles(triangles, points.size());
  std::vector<typename Graph_traits::vertex_descriptor> vertex_of_point(points.size(), Graph_traits::null_vertex());
  const std::vector<std::uint32_t> former_index = internal::remove_unused_points(points, triangles);
  PMP::orient_polygon_soup(points, triangles, CGAL::parameters::visitor(internal::Reject_non_manifold(former_index)));
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);

  std::size_t i = 0;
  for (const auto v : vertices(mesh)) vertex_of_point[former_index[i++]] = v; // added in the order of the points
  return vertex_of_point;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_TRIANGLE_SOUP_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes as face graphs, and back: apart from the shapes, since many tests need none, and CGAL's headers for them
// take long to compile.

#ifndef TEST_SURFACE_MESH_ADAPTATION_SHAPE_MESHES_H
#define TEST_SURFACE_MESH_ADAPTATION_SHAPE_MESHES_H

#include "shapes.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/property_map.h>

#include <array>
#include <vector>

namespace shapes {

/// Adds a soup to a face graph, of which `point` holds the points: vertices and faces in the order of the soup.
template <class TriangleMesh, class PointMap>
void add_to(TriangleMesh& m, const PointMap& point, const Soup& soup)
{
  using Point = typename boost::property_traits<PointMap>::value_type;
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> v;
  for (const Vector_3& p : soup.points) {
    v.push_back(add_vertex(m));
    put(point, v.back(), Point(p[0], p[1], p[2]));
  }
  for (const Triangle& t : soup.triangles) CGAL::Euler::add_face(std::array{v[t[0]], v[t[1]], v[t[2]]}, m);
}

/// The same as a face graph with points of its own.
template <class TriangleMesh>
TriangleMesh mesh(const Soup& soup)
{
  TriangleMesh m;
  add_to(m, get(CGAL::vertex_point, m), soup);
  return m;
}

/// Points and triangles of a face graph, in its order and from the first halfedge of each face on.
template <class TriangleMesh, class PointMap>
Soup soup(const TriangleMesh& m, const PointMap& point)
{
  Soup s;
  const auto index = get(CGAL::dynamic_vertex_property_t<Index>(), m);
  for (const auto v : vertices(m)) {
    put(index, v, Index(s.points.size()));
    const auto& p = get(point, v);
    s.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  for (const auto f : faces(m)) {
    const auto h = halfedge(f, m);
    s.triangles.push_back({get(index, source(h, m)), get(index, target(h, m)), get(index, target(next(h, m), m))});
  }
  return s;
}

template <class TriangleMesh>
Soup soup(const TriangleMesh& m)
{
  return soup(m, get(CGAL::vertex_point, m));
}

} // namespace shapes

#endif // TEST_SURFACE_MESH_ADAPTATION_SHAPE_MESHES_H

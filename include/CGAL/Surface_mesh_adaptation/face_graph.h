// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one place that touches the user's mesh: reads any face graph into a mesh view, checking it, and writes the
// adapted view back in one batch. Nothing of the user's mesh changes before the new one is complete.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FACE_GRAPH_H
#define CGAL_SURFACE_MESH_ADAPTATION_FACE_GRAPH_H

#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A face graph read into a mesh view: the element with id `i` is the `i`-th that the graph lists.
template <class FaceGraph>
struct Imported_mesh
{
  using vertex_descriptor = typename boost::graph_traits<FaceGraph>::vertex_descriptor;
  using halfedge_descriptor = typename boost::graph_traits<FaceGraph>::halfedge_descriptor;

  Mesh_view mesh;
  std::vector<Vector_3> points;
  std::vector<vertex_descriptor> vertices;
  std::vector<halfedge_descriptor> halfedges;
};

/// \throws Non_triangular_face_error, Non_manifold_vertex_error, Mesh_too_large_error
template <class FaceGraph>
void read_connectivity(const FaceGraph& graph, Imported_mesh<FaceGraph>& result)
{
  const auto vertex_id = get(CGAL::dynamic_vertex_property_t<Index>(), graph);
  const auto face_id = get(CGAL::dynamic_face_property_t<Index>(), graph);
  for (const auto v : vertices(graph)) {
    put(vertex_id, v, Index(result.vertices.size()));
    result.vertices.push_back(v);
  }
  Index number_of_faces = 0;
  for (const auto f : faces(graph)) {
    if (number_of_faces >= Index(std::numeric_limits<std::int32_t>::max() / 3)) throw Mesh_too_large_error();
    const auto h = halfedge(f, graph);
    if (next(next(next(h, graph), graph), graph) != h) throw Non_triangular_face_error(number_of_faces);
    put(face_id, f, number_of_faces++);
    for (const auto g : {h, next(h, graph), next(next(h, graph), graph)}) result.halfedges.push_back(g);
  }
  Mesh_view& mesh = result.mesh;
  const std::size_t n = result.halfedges.size();
  mesh.corner.resize(n);
  mesh.twin.resize(n);
  mesh.curve.assign(n, no_curve);
  mesh.outgoing.assign(result.vertices.size(), no_index);
  for (std::size_t i = 0; i < n; ++i) {
    const auto h = result.halfedges[i], o = opposite(h, graph);
    const Index v = get(vertex_id, source(h, graph));
    mesh.corner[i] = v;
    mesh.twin[i] = no_index;
    if (!is_border(o, graph)) {
      const std::size_t first = 3 * std::size_t(get(face_id, face(o, graph)));
      std::size_t k = 0;
      while (result.halfedges[first + k] != o) ++k;
      mesh.twin[i] = Index(first + k);
    }
    if (mesh.outgoing[v] == no_index || mesh.twin[i] == no_index) mesh.outgoing[v] = Index(i);
  }
}

/// \throws Non_manifold_vertex_error, Non_simplicial_edge_error
template <class Execution>
void check_fans(const Execution& execution, const Mesh_view& mesh)
{
  std::vector<Index> faces_at_vertex(mesh.number_of_vertices(), 0);
  for (const Index v : mesh.corner) ++faces_at_vertex[v];
  const std::size_t n = mesh.number_of_vertices();
  enum : std::size_t { manifold = 0, simplicial = 1 };
  const auto first_bad = [&](std::size_t what) {
    return reduce(execution, n, n, [&](std::size_t v) {
      if (mesh.outgoing[v] == no_index) return what == manifold ? v : n;
      Ring<Index> ring;
      Index faces = 0;
      mesh.for_each_outgoing(Index(v), [&](Index) { ++faces; });
      if (what == manifold) return faces == faces_at_vertex[v] ? n : v;
      mesh.for_each_neighbor(Index(v), [&](Index w) { ring.push_back(w); });
      std::sort(ring.begin(), ring.end());
      return std::adjacent_find(ring.begin(), ring.end()) == ring.end() ? n : v;
    }, [](std::size_t a, std::size_t b) { return (std::min)(a, b); });
  };
  const std::size_t non_manifold = first_bad(manifold);
  if (non_manifold < n) throw Non_manifold_vertex_error(non_manifold);
  const std::size_t non_simplicial = first_bad(simplicial);
  if (non_simplicial < n) throw Non_simplicial_edge_error(non_simplicial);
}

/// Reads and checks `graph`. \throws any `Invalid_input_error`, Empty_mesh_error, Mesh_too_large_error
template <class Execution, class FaceGraph, class VertexPointMap>
Imported_mesh<FaceGraph> read_face_graph(const Execution& execution, const FaceGraph& graph,
                                         const VertexPointMap& point_map)
{
  Imported_mesh<FaceGraph> result;
  read_connectivity(graph, result);
  if (result.halfedges.empty()) throw Empty_mesh_error();
  check_fans(execution, result.mesh);
  result.points.reserve(result.vertices.size());
  for (std::size_t i = 0; i < result.vertices.size(); ++i) {
    const auto& p = get(point_map, result.vertices[i]);
    result.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    if (!result.points.back().allFinite()) throw Non_finite_coordinate_error(i);
  }
  return result;
}

/// The halfedge of the written mesh: edges are numbered with the halfedge that owns them, which comes first.
struct Halfedge_numbering
{
  const Mesh_view& mesh;
  std::vector<Index> offset;  ///< of the first edge owned by each face
  Index number_of_edges = 0;

  template <class Execution>
  Halfedge_numbering(const Execution& execution, const Mesh_view& m) : mesh(m)
  {
    number_of_edges = exclusive_scan(execution, mesh.number_of_faces(), offset, [&](std::size_t f) {
      Index n = 0;
      for (Index h = 3 * Index(f); h < 3 * Index(f) + 3; ++h) n += mesh.is_edge_owner(h);
      return n;
    });
  }

  Index operator()(Index h) const
  {
    const Index o = mesh.edge_owner(h);
    Index e = offset[o / 3];
    for (Index g = o - o % 3; g < o; ++g) e += mesh.is_edge_owner(g);
    return 2 * e + (h == o ? 0 : 1);
  }

  /// The halfedge opposite to `h`, which exists for boundary halfedges too.
  Index opposite(Index h) const { return (*this)(h) ^ 1u; }
};

/// The boundary halfedge that arrives at the source of the boundary halfedge `h`.
inline Index last_of_fan(const Mesh_view& view, Index h)
{
  while (!view.is_border(Mesh_view::previous(h))) h = view.rotated_ccw(h);
  return Mesh_view::previous(h);
}

/// Replaces the content of a `Surface_mesh` by `view`. Vertices and faces keep their numbers; property maps stay, with
/// default values. Connectivity is written in parallel, by setters on distinct elements.
template <class Execution, class Point>
void write_connectivity(const Execution& execution, const Mesh_view& view, CGAL::Surface_mesh<Point>& mesh)
{
  using Mesh = CGAL::Surface_mesh<Point>;
  using V = typename Mesh::Vertex_index;
  using H = typename Mesh::Halfedge_index;
  using F = typename Mesh::Face_index;
  using Size = typename Mesh::size_type;
  const Halfedge_numbering number(execution, view);
  const Size nv = Size(view.number_of_vertices()), nf = Size(view.number_of_faces());
  mesh.reserve(nv, number.number_of_edges, nf); // may throw: so far nothing has changed
  mesh.clear_without_removing_property_maps();
  mesh.resize(nv, number.number_of_edges, nf);
  for_each_index(execution, view.number_of_faces(), [&](std::size_t f) {
    std::array<H, 3> hs;
    for (Index i = 0; i < 3; ++i) hs[i] = H(number(3 * Index(f) + i));
    for (Index i = 0; i < 3; ++i) {
      const Index h = 3 * Index(f) + i;
      mesh.set_target(hs[i], V(view.target(h)));
      mesh.set_face(hs[i], F(Size(f)));
      mesh.set_next(hs[i], hs[(i + 1) % 3]);
      if (!view.is_border(h)) continue;
      const H border(number.opposite(h));
      mesh.set_target(border, V(view.source(h)));
      mesh.set_face(border, Mesh::null_face());
      // the boundary goes on past the source of h: along the halfedge that ends the fan of the source
      const Index before = last_of_fan(view, h);
      mesh.set_next(border, H(number.opposite(before)));
    }
    mesh.set_halfedge(F(Size(f)), hs[0]);
  });
  for_each_index(execution, view.number_of_vertices(), [&](std::size_t v) {
    const Index h = view.outgoing[v];
    mesh.set_halfedge(V(Size(v)), H(view.is_border(h) ? number.opposite(h) : number(Mesh_view::previous(h))));
  });
}

/// Replaces the content of any `MutableFaceGraph`, element by element.
template <class Execution, class FaceGraph>
void write_connectivity(const Execution&, const Mesh_view& view, FaceGraph& graph)
{
  CGAL::clear(graph);
  std::vector<typename boost::graph_traits<FaceGraph>::vertex_descriptor> vertex;
  vertex.reserve(view.number_of_vertices());
  for (std::size_t v = 0; v < view.number_of_vertices(); ++v) vertex.push_back(add_vertex(graph));
  for (std::size_t h = 0; h < view.number_of_halfedges(); h += 3) {
    const auto f = CGAL::Euler::add_face(
      std::array{vertex[view.corner[h]], vertex[view.corner[h + 1]], vertex[view.corner[h + 2]]}, graph);
    set_halfedge(f, next(halfedge(f, graph), graph), graph); // the one that leaves the first corner, as in the view
  }
}

/// Writes points into a property map of the written mesh, of which vertex `i` is the `i`-th.
template <class FaceGraph, class VertexPointMap>
void write_points(const std::vector<Vector_3>& points, FaceGraph& graph, const VertexPointMap& point_map)
{
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  std::size_t i = 0;
  for (const auto v : vertices(graph)) {
    put(point_map, v, Point(points[i][0], points[i][1], points[i][2]));
    ++i;
  }
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FACE_GRAPH_H

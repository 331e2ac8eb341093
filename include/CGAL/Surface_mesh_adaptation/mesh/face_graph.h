// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one place that touches the user's mesh: reads any face graph into a mesh view, checking it, and writes the
// adapted view back in one batch. Nothing of the user's mesh changes before the new one is complete.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_FACE_GRAPH_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_FACE_GRAPH_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
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

/// Numbers the elements of any face graph in the order in which it lists them. Not to be read concurrently: the dynamic
/// properties of some graphs are hash tables that reading may change.
template <class FaceGraph>
class Numbering
{
public:
  using vertex_descriptor = typename boost::graph_traits<FaceGraph>::vertex_descriptor;
  using face_descriptor = typename boost::graph_traits<FaceGraph>::face_descriptor;

  explicit Numbering(const FaceGraph& graph)
    : vertex_id_(get(CGAL::dynamic_vertex_property_t<Index>(), graph))
    , face_id_(get(CGAL::dynamic_face_property_t<Index>(), graph))
  {
    for (const auto v : vertices(graph)) {
      put(vertex_id_, v, Index(vertices_.size()));
      vertices_.push_back(v);
    }
    for (const auto f : faces(graph)) {
      put(face_id_, f, Index(faces_.size()));
      faces_.push_back(f);
    }
  }

  std::size_t number_of_vertices() const { return vertices_.size(); }
  std::size_t number_of_faces() const { return faces_.size(); }
  vertex_descriptor vertex(std::size_t i) const { return vertices_[i]; }
  face_descriptor face(std::size_t i) const { return faces_[i]; }
  Index id(vertex_descriptor v) const { return get(vertex_id_, v); }
  Index face_id(face_descriptor f) const { return get(face_id_, f); }

private:
  typename boost::property_map<FaceGraph, CGAL::dynamic_vertex_property_t<Index>>::const_type vertex_id_;
  typename boost::property_map<FaceGraph, CGAL::dynamic_face_property_t<Index>>::const_type face_id_;
  std::vector<vertex_descriptor> vertices_;
  std::vector<face_descriptor> faces_;
};

/// A `Surface_mesh` without removed elements is numbered by its own indices.
template <class Point>
class Compact_numbering
{
public:
  using Mesh = CGAL::Surface_mesh<Point>;
  using vertex_descriptor = typename Mesh::Vertex_index;
  using face_descriptor = typename Mesh::Face_index;

  explicit Compact_numbering(const Mesh& mesh) : mesh_(mesh) {}

  std::size_t number_of_vertices() const { return mesh_.number_of_vertices(); }
  std::size_t number_of_faces() const { return mesh_.number_of_faces(); }
  vertex_descriptor vertex(std::size_t i) const { return vertex_descriptor(typename Mesh::size_type(i)); }
  face_descriptor face(std::size_t i) const { return face_descriptor(typename Mesh::size_type(i)); }
  Index id(vertex_descriptor v) const { return Index(v); }
  Index face_id(face_descriptor f) const { return Index(f); }

private:
  const Mesh& mesh_;
};

template <class Execution, class FaceGraph, class Read>
void with_numbering(const Execution&, const FaceGraph& graph, const Read& read)
{
  read(Sequential_execution(), Numbering<FaceGraph>(graph));
}

template <class Execution, class Point, class Read>
void with_numbering(const Execution& execution, const CGAL::Surface_mesh<Point>& mesh, const Read& read)
{
  if (mesh.has_garbage()) read(Sequential_execution(), Numbering<CGAL::Surface_mesh<Point>>(mesh));
  else read(execution, Compact_numbering<Point>(mesh));
}

/// \throws Non_triangular_face_error, Mesh_too_large_error
template <class Execution, class FaceGraph, class Number>
void read_connectivity(const Execution& execution, const FaceGraph& graph, const Number& number,
                       Imported_mesh<FaceGraph>& result)
{
  const std::size_t nv = number.number_of_vertices(), nf = number.number_of_faces();
  if (nf > max_number_of_faces) throw Mesh_too_large_error(nf, max_number_of_faces);
  const std::size_t first_bad = reduce(execution, nf, nf, [&](std::size_t f) {
    const auto h = halfedge(number.face(f), graph);
    return next(next(next(h, graph), graph), graph) == h && next(h, graph) != h ? nf : f;
  }, [](std::size_t a, std::size_t b) { return (std::min)(a, b); });
  if (first_bad < nf) throw Non_triangular_face_error(first_bad);

  Mesh_view& mesh = result.mesh;
  mesh.corner.resize(3 * nf);
  mesh.twin.resize(3 * nf);
  mesh.curve.assign(3 * nf, no_curve);
  mesh.outgoing.resize(nv);
  result.halfedges.resize(3 * nf);
  result.vertices.resize(nv);
  // the number of a halfedge that has a face
  const auto id = [&](auto h) {
    const auto f = face(h, graph);
    Index i = 3 * number.face_id(f);
    for (auto g = halfedge(f, graph); g != h; g = next(g, graph)) ++i;
    return i;
  };
  for_each_index(execution, nf, [&](std::size_t f) {
    auto h = halfedge(number.face(f), graph);
    for (std::size_t i = 3 * f; i < 3 * f + 3; ++i, h = next(h, graph)) {
      const auto o = opposite(h, graph);
      result.halfedges[i] = h;
      mesh.corner[i] = number.id(source(h, graph));
      mesh.twin[i] = is_border(o, graph) ? no_index : id(o);
    }
  });
  for_each_index(execution, nv, [&](std::size_t v) {
    result.vertices[v] = number.vertex(v);
    const auto h = halfedge(number.vertex(v), graph); // arrives at v
    mesh.outgoing[v] = no_index;
    if (h == boost::graph_traits<FaceGraph>::null_halfedge()) return;
    const auto o = opposite(h, graph);
    if (is_border(h, graph) && is_border(o, graph)) return;
    mesh.outgoing[v] = mesh.first_of_fan(is_border(o, graph) ? id(next(h, graph)) : id(o));
  });
}

/// Of all vertices, each walked around once from its halfedge on.
struct Fans
{
  std::size_t corners = 0;
  std::size_t first_isolated = std::size_t(-1), first_non_simplicial = std::size_t(-1);

  friend Fans operator+(const Fans& a, const Fans& b)
  {
    return {a.corners + b.corners, (std::min)(a.first_isolated, b.first_isolated),
            (std::min)(a.first_non_simplicial, b.first_non_simplicial)};
  }
};

inline Fans fan_of(const Mesh_view& mesh, Index v, std::size_t number)
{
  Fans fan;
  if (mesh.outgoing[v] == no_index) {
    fan.first_isolated = number;
    return fan;
  }
  Ring<Index> ring;
  mesh.for_each_neighbor(v, [&](Index w) { ring.push_back(w); });
  fan.corners = ring.size() - (mesh.is_border_vertex(v) ? 1 : 0);
  std::sort(ring.begin(), ring.end());
  if (std::adjacent_find(ring.begin(), ring.end()) != ring.end()) fan.first_non_simplicial = number;
  return fan;
}

/// The first number of a vertex with corners that its fan does not have. \pre there is one
template <class Number>
std::size_t first_with_other_fans(const Mesh_view& mesh, const Number& number)
{
  std::vector<Index> missing(mesh.number_of_vertices(), 0);
  for (const Index v : mesh.corner) ++missing[v];
  std::size_t first = missing.size();
  for (Index v = 0; v < missing.size(); ++v) {
    if (mesh.outgoing[v] != no_index) mesh.for_each_outgoing(v, [&](Index) { --missing[v]; });
    if (missing[v] > 0) first = (std::min)(first, std::size_t(number(v)));
  }
  return first;
}

/// \param number the number of a vertex by which errors name it
/// \throws Non_manifold_vertex_error, Non_simplicial_edge_error
template <class Execution, class Number>
void check_fans(const Execution& execution, const Mesh_view& mesh, const Number& number)
{
  const std::size_t n = mesh.number_of_vertices();
  const Fans fans = reduce(execution, n, Fans(), [&](std::size_t v) {
    return fan_of(mesh, Index(v), number(Index(v)));
  }, std::plus<Fans>());
  std::size_t non_manifold = fans.first_isolated;
  if (fans.corners != mesh.number_of_halfedges()) // some corner belongs to a second fan of its vertex
    non_manifold = (std::min)(non_manifold, first_with_other_fans(mesh, number));
  if (non_manifold < n) throw Non_manifold_vertex_error(non_manifold);
  if (fans.first_non_simplicial < n) throw Non_simplicial_edge_error(fans.first_non_simplicial);
}

/// Least and largest coordinates of points.
struct Bounding_box
{
  Vector_3 lower = Vector_3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;

  friend Bounding_box operator+(const Bounding_box& a, const Bounding_box& b)
  {
    return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
  }
};

/// \throws Invalid_extent_error
inline void check_extent(const Bounding_box& box)
{
  constexpr double least = 1e-100, most = 1e100; // of whose squares areas and volumes can be made
  const double extent = (box.upper - box.lower).maxCoeff();
  const double largest = (std::max)(extent, box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).maxCoeff());
  if (largest > most) throw Invalid_extent_error(largest);
  if (extent < least) throw Invalid_extent_error(extent);
}

/// Reads `graph` as `read_face_graph()` does, but leaves it to `check_fans()` to walk around the vertices, which takes
/// long where their order is poor.
/// \throws Non_triangular_face_error, Non_finite_coordinate_error, Invalid_extent_error, Empty_mesh_error,
///         Mesh_too_large_error
template <class Execution, class FaceGraph, class VertexPointMap>
Imported_mesh<FaceGraph> import_face_graph(const Execution& execution, const FaceGraph& graph,
                                           const VertexPointMap& point_map)
{
  Imported_mesh<FaceGraph> result;
  with_numbering(execution, graph, [&](const auto& policy, const auto& number) {
    if (number.number_of_faces() == 0) throw Empty_mesh_error();
    read_connectivity(policy, graph, number, result);
    const std::size_t n = result.vertices.size();
    result.points.resize(n);
    const std::size_t bad = reduce(policy, n, n, [&](std::size_t v) {
      const auto& p = get(point_map, result.vertices[v]);
      result.points[v] = Vector_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
      return result.points[v].allFinite() ? n : v;
    }, [](std::size_t a, std::size_t b) { return (std::min)(a, b); });
    if (bad < n) throw Non_finite_coordinate_error(bad);
    check_extent(reduce(policy, n, Bounding_box(), [&](std::size_t v) {
      return Bounding_box{result.points[v], result.points[v]};
    }, std::plus<Bounding_box>()));
  });
  return result;
}

/// Reads `graph`, a triangulated surface with the points `get(point_map, v)`, into arrays, and checks it: an orientable
/// 2-manifold, closed or with boundary, without isolated vertices. `detect_features()` comes
/// next: without it `mesh.curve` is not set.
/// \throws any `Invalid_input_error`, Invalid_extent_error, Empty_mesh_error, Mesh_too_large_error
/// \par Complexity
/// O(n)
template <class Execution, class FaceGraph, class VertexPointMap>
Imported_mesh<FaceGraph> read_face_graph(const Execution& execution, const FaceGraph& graph,
                                         const VertexPointMap& point_map)
{
  Imported_mesh<FaceGraph> result = import_face_graph(execution, graph, point_map);
  check_fans(execution, result.mesh, [](Index v) { return v; });
  return result;
}

/// The halfedge of the written mesh: edges are numbered with the halfedge that owns them, which comes first.
struct Halfedge_numbering
{
  const Mesh_view& mesh;
  Buffer<Index> offset;  ///< of the first edge owned by each face
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

/// Writes points into the point map of a `Surface_mesh`, in which vertex `i` is the `i`-th.
template <class Execution, class Points, class Point>
void write_points(const Execution& execution, const Points& points, CGAL::Surface_mesh<Point>&,
                  typename CGAL::Surface_mesh<Point>::template Property_map<
                    typename CGAL::Surface_mesh<Point>::Vertex_index, Point> point_map)
{
  using V = typename CGAL::Surface_mesh<Point>::Vertex_index;
  for_each_index(execution, points.size(), [&](std::size_t i) {
    point_map[V(typename CGAL::Surface_mesh<Point>::size_type(i))] = Point(points[i][0], points[i][1], points[i][2]);
  });
}

/// Writes points into any property map of the written mesh, of which vertex `i` is the `i`-th.
template <class Execution, class Points, class FaceGraph, class VertexPointMap>
void write_points(const Execution&, const Points& points, FaceGraph& graph, const VertexPointMap& point_map)
{
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  std::size_t i = 0;
  for (const auto v : vertices(graph)) {
    put(point_map, v, Point(points[i][0], points[i][1], points[i][2]));
    ++i;
  }
}

} // namespace internal

using internal::Imported_mesh;
using internal::read_face_graph; // the way in for what works on a `Mesh_view` and can be used alone

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_FACE_GRAPH_H

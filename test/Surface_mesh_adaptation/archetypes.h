// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models that provide what the concepts ask for, and nothing else.

#ifndef TEST_SURFACE_MESH_ADAPTATION_ARCHETYPES_H
#define TEST_SURFACE_MESH_ADAPTATION_ARCHETYPES_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>

#include <CGAL/Iterator_range.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_HalfedgeDS.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace archetypes {

namespace SMA = CGAL::Surface_mesh_adaptation;

/// The name of an element of a graph: no number, and nothing to calculate with. What is hidden is for the graph alone.
template <class Hidden>
struct Descriptor
{
  Hidden hidden;

  Descriptor() = default;
  explicit Descriptor(Hidden h) : hidden(h) {}

  friend bool operator==(Descriptor a, Descriptor b) { return a.hidden == b.hidden; }
  friend bool operator!=(Descriptor a, Descriptor b) { return a.hidden != b.hidden; }
  friend bool operator<(Descriptor a, Descriptor b) { return a.hidden < b.hidden; }
};

/// `MutableFaceGraph` and `FaceListGraph`: without points, and without indices.
class Graph
{
  using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

public:
  using Vertex = Descriptor<Mesh::Vertex_index>;
  using Halfedge = Descriptor<Mesh::Halfedge_index>;
  using Edge = Descriptor<Mesh::Edge_index>;
  using Face = Descriptor<Mesh::Face_index>;

  template <class D>
  struct Wrap
  {
    template <class Hidden>
    D operator()(Hidden h) const { return D(h); }
  };
  using Vertex_iterator = boost::transform_iterator<Wrap<Vertex>, Mesh::Vertex_iterator, Vertex, Vertex>;
  using Halfedge_iterator = boost::transform_iterator<Wrap<Halfedge>, Mesh::Halfedge_iterator, Halfedge, Halfedge>;
  using Edge_iterator = boost::transform_iterator<Wrap<Edge>, Mesh::Edge_iterator, Edge, Edge>;
  using Face_iterator = boost::transform_iterator<Wrap<Face>, Mesh::Face_iterator, Face, Face>;

  void clear() { mesh_.clear(); } // else the mesh would take removed elements again, in another order

  friend auto vertices(const Graph& g) { return range<Vertex_iterator>(g.mesh_.vertices()); }
  friend auto halfedges(const Graph& g) { return range<Halfedge_iterator>(g.mesh_.halfedges()); }
  friend auto edges(const Graph& g) { return range<Edge_iterator>(g.mesh_.edges()); }
  friend auto faces(const Graph& g) { return range<Face_iterator>(g.mesh_.faces()); }
  friend std::size_t num_vertices(const Graph& g) { return g.mesh_.number_of_vertices(); }
  friend std::size_t num_halfedges(const Graph& g) { return g.mesh_.number_of_halfedges(); }
  friend std::size_t num_edges(const Graph& g) { return g.mesh_.number_of_edges(); }
  friend std::size_t num_faces(const Graph& g) { return g.mesh_.number_of_faces(); }

  friend Vertex source(Halfedge h, const Graph& g) { return Vertex(g.mesh_.source(h.hidden)); }
  friend Vertex target(Halfedge h, const Graph& g) { return Vertex(g.mesh_.target(h.hidden)); }
  friend Vertex source(Edge e, const Graph& g) { return source(halfedge(e, g), g); }
  friend Vertex target(Edge e, const Graph& g) { return target(halfedge(e, g), g); }
  friend Halfedge next(Halfedge h, const Graph& g) { return Halfedge(g.mesh_.next(h.hidden)); }
  friend Halfedge prev(Halfedge h, const Graph& g) { return Halfedge(g.mesh_.prev(h.hidden)); }
  friend Halfedge opposite(Halfedge h, const Graph& g) { return Halfedge(g.mesh_.opposite(h.hidden)); }
  friend Halfedge halfedge(Vertex v, const Graph& g) { return Halfedge(g.mesh_.halfedge(v.hidden)); }
  friend Halfedge halfedge(Edge e, const Graph& g) { return Halfedge(g.mesh_.halfedge(e.hidden)); }
  friend Halfedge halfedge(Face f, const Graph& g) { return Halfedge(g.mesh_.halfedge(f.hidden)); }
  friend std::pair<Halfedge, bool> halfedge(Vertex u, Vertex v, const Graph& g)
  {
    const Mesh::Halfedge_index h = g.mesh_.halfedge(u.hidden, v.hidden);
    return {Halfedge(h), h != Mesh::null_halfedge()};
  }
  friend Edge edge(Halfedge h, const Graph& g) { return Edge(g.mesh_.edge(h.hidden)); }
  friend Face face(Halfedge h, const Graph& g) { return Face(g.mesh_.face(h.hidden)); }

  friend Vertex add_vertex(Graph& g) { return Vertex(g.mesh_.add_vertex()); }
  friend Edge add_edge(Graph& g) { return Edge(g.mesh_.edge(g.mesh_.add_edge())); }
  friend Face add_face(Graph& g) { return Face(g.mesh_.add_face()); }
  friend void remove_vertex(Vertex v, Graph& g) { g.mesh_.remove_vertex(v.hidden); }
  friend void remove_edge(Edge e, Graph& g) { g.mesh_.remove_edge(e.hidden); }
  friend void remove_face(Face f, Graph& g) { g.mesh_.remove_face(f.hidden); }
  friend void set_target(Halfedge h, Vertex v, Graph& g) { g.mesh_.set_target(h.hidden, v.hidden); }
  friend void set_next(Halfedge h, Halfedge n, Graph& g) { g.mesh_.set_next(h.hidden, n.hidden); }
  friend void set_face(Halfedge h, Face f, Graph& g) { g.mesh_.set_face(h.hidden, f.hidden); }
  friend void set_halfedge(Vertex v, Halfedge h, Graph& g) { g.mesh_.set_halfedge(v.hidden, h.hidden); }
  friend void set_halfedge(Face f, Halfedge h, Graph& g) { g.mesh_.set_halfedge(f.hidden, h.hidden); }

  static Vertex null_vertex() { return Vertex(Mesh::null_vertex()); }
  static Halfedge null_halfedge() { return Halfedge(Mesh::null_halfedge()); }
  static Face null_face() { return Face(Mesh::null_face()); }

private:
  template <class Iterator, class Range>
  static CGAL::Iterator_range<Iterator> range(const Range& r)
  {
    return {Iterator(r.begin()), Iterator(r.end())};
  }

  Mesh mesh_;
};

/// What a `Map` stores in place of a key.
template <class Key>
Key stored_key(const Key& k) { return k; }

/// The first of the two halfedges: keys stay in the map when their edges are removed, and edges of CGAL's halfedge data
/// structures are compared through their halfedges, whose memory may be that of others by then.
template <class Halfedge>
Halfedge stored_key(const CGAL::internal::HDS_edge<Halfedge>& e)
{
  return (std::min)(e.halfedge(), e.halfedge()->opposite());
}

/// Values that can be read and written by `get` and `put` alone; copies share them.
template <class Key, class Value, class Category = boost::read_write_property_map_tag>
class Map
{
public:
  using key_type = Key;
  using value_type = Value;
  using reference = Value;
  using category = Category;

  friend Value get(const Map& map, const Key& k) { return (*map.values_)[stored_key(k)]; }
  friend void put(const Map& map, const Key& k, const Value& v) { (*map.values_)[stored_key(k)] = v; }

private:
  using Values = std::map<decltype(stored_key(std::declval<const Key&>())), Value>;
  std::shared_ptr<Values> values_ = std::make_shared<Values>();
};

/// A `ReadablePropertyMap` with the same value everywhere.
template <class Key, class Value>
class Constant
{
public:
  using key_type = Key;
  using value_type = Value;
  using reference = Value;
  using category = boost::readable_property_map_tag;

  explicit Constant(Value value) : value_(value) {}
  friend Value get(const Constant& map, const Key&) { return map.value_; }

private:
  Value value_;
};

/// A `WritablePropertyMap` that counts.
template <class Key, class Value>
class Counter
{
public:
  using key_type = Key;
  using value_type = Value;
  using reference = void;
  using category = boost::writable_property_map_tag;

  explicit Counter(std::size_t& count) : count_(&count) {}
  friend void put(const Counter& map, const Key&, const Value&) { ++*map.count_; }

private:
  std::size_t* count_;
};

/// `SurfaceReconstruction`: flat.
struct Reconstruction
{
  static SMA::Surface_point evaluate(const SMA::Patch& p, double u, double v)
  {
    return {(1 - u - v) * p.points[0] + u * p.points[1] + v * p.points[2], p.normals[0]};
  }
  static SMA::Vector_3 evaluate_curve(const SMA::Vector_3& a, const SMA::Vector_3& b, const SMA::Vector_3&,
                                      const SMA::Vector_3&, double t)
  {
    return (1 - t) * a + t * b;
  }
};

/// `AdaptationExecution`: backwards.
class Execution
{
public:
  static constexpr const char* name = "backwards";

  Execution(const Execution&) = default;
  Execution& operator=(const Execution&) = delete;
  static Execution make() { return Execution(); }

  int concurrency() const { return 1; }

  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const
  {
    for (std::size_t i = number_of_tasks; i-- > 0;) task(i);
  }

private:
  Execution() = default;
};

/// `AdaptationVisitor`: neither to be copied nor to be derived from.
class Visitor final
{
public:
  Visitor() = default;
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;

  void round_begins(std::size_t, std::size_t) {}
  void kernel_done(const SMA::Kernel_report&) {}
  void round_done(std::size_t, const SMA::Mesh_statistics&) { ++rounds; }
  bool go_on() { return true; }

  std::size_t rounds = 0;
};

} // namespace archetypes

template <class Hidden>
struct std::hash<archetypes::Descriptor<Hidden>>
{
  std::size_t operator()(archetypes::Descriptor<Hidden> d) const { return std::size_t(d.hidden); }
};

template <>
struct boost::graph_traits<archetypes::Graph>
{
  using Graph = archetypes::Graph;
  using vertex_descriptor = Graph::Vertex;
  using halfedge_descriptor = Graph::Halfedge;
  using edge_descriptor = Graph::Edge;
  using face_descriptor = Graph::Face;
  using vertex_iterator = Graph::Vertex_iterator;
  using halfedge_iterator = Graph::Halfedge_iterator;
  using edge_iterator = Graph::Edge_iterator;
  using face_iterator = Graph::Face_iterator;
  using vertices_size_type = std::size_t;
  using halfedges_size_type = std::size_t;
  using edges_size_type = std::size_t;
  using faces_size_type = std::size_t;
  using degree_size_type = std::size_t;
  using directed_category = undirected_tag;
  using edge_parallel_category = disallow_parallel_edge_tag;
  struct traversal_category
    : virtual bidirectional_graph_tag, virtual vertex_list_graph_tag, virtual edge_list_graph_tag
  {};

  static vertex_descriptor null_vertex() { return Graph::null_vertex(); }
  static halfedge_descriptor null_halfedge() { return Graph::null_halfedge(); }
  static face_descriptor null_face() { return Graph::null_face(); }
};

#endif // TEST_SURFACE_MESH_ADAPTATION_ARCHETYPES_H

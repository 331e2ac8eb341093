// SPDX-License-Identifier: GPL-3.0-or-later
//
// Says in a sentence, where an entry point is compiled, which of its arguments is no model of what it has to be: the
// compiler would say so from deep inside. Only signatures are looked at, which takes no time to compile.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CHECK_MODELS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CHECK_MODELS_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric_fields.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>

#include <CGAL/Real_embeddable_traits.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <functional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

template <class T> const T& arg();
template <class T> T& mutable_arg();

// Face graphs

template <class Graph> using Vertex_of = typename boost::graph_traits<Graph>::vertex_descriptor;
template <class Graph> using Halfedge_of = typename boost::graph_traits<Graph>::halfedge_descriptor;
template <class Graph> using Edge_of = typename boost::graph_traits<Graph>::edge_descriptor;
template <class Graph> using Face_of = typename boost::graph_traits<Graph>::face_descriptor;

/// Of `FaceListGraph`, what `read_face_graph()` needs.
template <class Graph, class = void> constexpr bool is_face_list_graph = false;
template <class Graph>
constexpr bool is_face_list_graph<Graph, std::void_t<
  decltype(vertices(arg<Graph>())), decltype(faces(arg<Graph>())), decltype(edges(arg<Graph>())),
  decltype(halfedge(arg<Vertex_of<Graph>>(), arg<Graph>())), decltype(halfedge(arg<Face_of<Graph>>(), arg<Graph>())),
  decltype(face(arg<Halfedge_of<Graph>>(), arg<Graph>())), decltype(next(arg<Halfedge_of<Graph>>(), arg<Graph>())),
  decltype(opposite(arg<Halfedge_of<Graph>>(), arg<Graph>())),
  decltype(source(arg<Halfedge_of<Graph>>(), arg<Graph>())),
  decltype(edge(arg<Halfedge_of<Graph>>(), arg<Graph>()))>> = true;

template <class Graph, class = void> constexpr bool is_mutable_face_graph = false;
template <class Graph>
constexpr bool is_mutable_face_graph<Graph, std::void_t<
  decltype(add_vertex(mutable_arg<Graph>())), decltype(add_edge(mutable_arg<Graph>())),
  decltype(add_face(mutable_arg<Graph>())),
  decltype(set_halfedge(arg<Face_of<Graph>>(), arg<Halfedge_of<Graph>>(), mutable_arg<Graph>())),
  decltype(set_next(arg<Halfedge_of<Graph>>(), arg<Halfedge_of<Graph>>(), mutable_arg<Graph>()))>> =
  is_face_list_graph<Graph>;

// Property maps

template <class Map, class Key, class = void> constexpr bool is_readable = false;
template <class Map, class Key>
constexpr bool is_readable<Map, Key, std::void_t<decltype(get(arg<Map>(), arg<Key>()))>> = true;

/// Whether the values of `Map` convert to `Value`.
template <class Map, class Key, class Value, class = void> constexpr bool is_readable_as = false;
template <class Map, class Key, class Value>
constexpr bool is_readable_as<Map, Key, Value, std::void_t<decltype(get(arg<Map>(), arg<Key>()))>> =
  std::is_convertible_v<decltype(get(arg<Map>(), arg<Key>())), Value>;

template <class Map, class Key, class Value, class = void> constexpr bool is_writable_with = false;
template <class Map, class Key, class Value>
constexpr bool is_writable_with<Map, Key, Value,
                                std::void_t<decltype(put(arg<Map>(), arg<Key>(), arg<Value>()))>> = true;

template <class Map, class Key, class = void> constexpr bool is_read_write = false;
template <class Map, class Key>
constexpr bool is_read_write<Map, Key, std::void_t<typename boost::property_traits<Map>::value_type>> =
  is_readable<Map, Key> && is_writable_with<Map, Key, typename boost::property_traits<Map>::value_type>;

template <class T>
constexpr bool is_number = CGAL::Real_embeddable_traits<std::decay_t<T>>::Is_real_embeddable::value;

/// Whether `Map` has points, or vectors, by their coordinates.
template <class Map, class Key, class = void> constexpr bool has_coordinates = false;
template <class Map, class Key>
constexpr bool has_coordinates<Map, Key, std::void_t<decltype(get(arg<Map>(), arg<Key>()).x())>> =
  is_number<decltype(get(arg<Map>(), arg<Key>()).x())>;

// Metric fields

template <class Value>
constexpr bool is_metric_value = is_number<Value> || std::is_same_v<std::decay_t<Value>, Metric_tensor_3>;

template <class Map, class Graph, class = void> constexpr bool is_metric_map = false;
template <class Map, class Graph>
constexpr bool is_metric_map<Map, Graph, std::void_t<typename boost::property_traits<Map>::value_type,
                                                     decltype(get(arg<Map>(), arg<Vertex_of<Graph>>()))>> =
  is_metric_value<decltype(get(arg<Map>(), arg<Vertex_of<Graph>>()))>;

template <class Function, class = void> constexpr bool is_metric_formula = false;
template <class Function>
constexpr bool is_metric_formula<Function, std::void_t<decltype(arg<Function>()(arg<Vector_3>()))>> =
  is_metric_value<decltype(arg<Function>()(arg<Vector_3>()))>;

template <class Field, class Graph> constexpr bool is_metric_field = is_metric_map<Field, Graph>;
template <class Graph> constexpr bool is_metric_field<Uniform_metric_field, Graph> = true;
template <class Graph> constexpr bool is_metric_field<Curvature_metric_field, Graph> = true;
template <class Map, class Graph>
constexpr bool is_metric_field<Solution_metric_field<Map>, Graph> = is_metric_map<Map, Graph>;
template <class Function, class Graph>
constexpr bool is_metric_field<Analytic_metric_field<Function>, Graph> = is_metric_formula<Function>;
template <class... Fields, class Graph>
constexpr bool is_metric_field<Intersection_metric_field<Fields...>, Graph> = (is_metric_field<Fields, Graph> && ...);

template <class... Fields, class Graph>
constexpr bool is_metric_field<std::variant<Fields...>, Graph> = (is_metric_field<Fields, Graph> && ...);

// The other concepts

template <class T, class = void> constexpr bool is_surface_reconstruction = false;
template <class T>
constexpr bool is_surface_reconstruction<T, std::void_t<
  decltype(T::evaluate(arg<Patch>(), 0.0, 0.0)),
  decltype(T::evaluate_curve(arg<Vector_3>(), arg<Vector_3>(), arg<Vector_3>(), arg<Vector_3>(), 0.0))>> =
  std::is_convertible_v<decltype(T::evaluate(arg<Patch>(), 0.0, 0.0)), Surface_point>;

template <class T, class = void> constexpr bool is_adaptation_visitor = false;
template <class T>
constexpr bool is_adaptation_visitor<T, std::void_t<
  decltype(mutable_arg<T>().round_begins(std::size_t(), std::size_t())),
  decltype(mutable_arg<T>().kernel_done(arg<Kernel_report>())),
  decltype(mutable_arg<T>().round_done(std::size_t(), arg<Mesh_statistics>())),
  decltype(bool(mutable_arg<T>().go_on()))>> = true;
template <class T> constexpr bool is_adaptation_visitor<std::reference_wrapper<T>> = is_adaptation_visitor<T>;

template <class T, class Key> constexpr bool are_read_write_maps = false;
template <class... Maps, class Key>
constexpr bool are_read_write_maps<std::tuple<Maps...>, Key> = (is_read_write<Maps, Key> && ...);
template <class Map, class Allocator, class Key>
constexpr bool are_read_write_maps<std::vector<Map, Allocator>, Key> = is_read_write<Map, Key>;

// Named parameters

template <class NamedParameters, class Tag>
using Parameter = std::decay_t<decltype(CGAL::parameters::get_parameter(arg<NamedParameters>(), Tag()))>;

/// Whether the parameter `Tag` is not given, or what `Check` says of its type.
template <class NamedParameters, class Tag, template <class> class Check>
constexpr bool is_absent_or = !has_parameter<NamedParameters, Tag> || Check<Parameter<NamedParameters, Tag>>::value;

/// What the maps at the elements of `Graph` have to be.
template <class Graph>
struct Maps_of
{
  using Vertex = Vertex_of<Graph>;
  template <class M> struct Points : std::bool_constant<has_coordinates<M, Vertex>> {};
  template <class M> struct Vertex_marks : std::bool_constant<is_readable_as<M, Vertex, bool>> {};
  template <class M> struct Edge_marks : std::bool_constant<is_readable_as<M, Edge_of<Graph>, bool>> {};
  template <class M> struct Metrics : std::bool_constant<is_writable_with<M, Vertex, Metric_tensor_3>> {};
  template <class M> struct Shape_operators : std::bool_constant<is_readable_as<M, Vertex, Metric_tensor_3>> {};
  template <class M> struct Attributes : std::bool_constant<are_read_write_maps<M, Vertex>> {};
  template <class M> struct Face_attributes : std::bool_constant<are_read_write_maps<M, Face_of<Graph>>> {};
  template <class M> struct Corner_attributes : std::bool_constant<are_read_write_maps<M, Halfedge_of<Graph>>> {};
  template <class M> struct Size_bounds
    : std::bool_constant<is_readable_as<M, Face_of<Graph>, std::pair<double, double>>> {};
  template <class M> struct Deviations : std::bool_constant<is_readable_as<M, Face_of<Graph>, double>> {};
};
template <class T> struct Is_reconstruction : std::bool_constant<is_surface_reconstruction<T>> {};
template <class T> struct Is_visitor : std::bool_constant<is_adaptation_visitor<T>> {};

/// Of the parameters that every entry point reads.
template <class Graph, class NP>
constexpr bool check_maps()
{
  using Maps = Maps_of<Graph>;
  static_assert(is_absent_or<NP, CGAL::internal_np::vertex_point_t, Maps::template Points>,
                "vertex_point_map must be a ReadWritePropertyMap, from vertices to points");
  static_assert(is_absent_or<NP, CGAL::internal_np::vertex_is_constrained_t, Maps::template Vertex_marks>,
                "vertex_is_constrained_map must be a ReadablePropertyMap, from vertices to bool");
  static_assert(is_absent_or<NP, CGAL::internal_np::edge_is_constrained_t, Maps::template Edge_marks>,
                "edge_is_constrained_map must be a ReadablePropertyMap, from edges to bool");
  return true;
}

template <class Graph, class NP>
constexpr bool check_parameters()
{
  using Maps = Maps_of<Graph>;
  static_assert(is_absent_or<NP, CGAL::internal_np::vertex_normal_map_t, Maps::template Points>,
                "vertex_normal_map must be a ReadablePropertyMap, from vertices to vectors");
  static_assert(is_absent_or<NP, internal_np::vertex_shape_operator_map_t, Maps::template Shape_operators>,
                "vertex_shape_operator_map must be a ReadablePropertyMap, from vertices to Metric_tensor_3");
  static_assert(is_absent_or<NP, internal_np::output_metric_map_t, Maps::template Metrics>,
                "output_metric_map must be a WritablePropertyMap, from vertices to Metric_tensor_3");
  static_assert(is_absent_or<NP, internal_np::vertex_attribute_maps_t, Maps::template Attributes>,
                "vertex_attribute_maps must be a std::tuple of ReadWritePropertyMaps of the vertices, or a std::vector");
  static_assert(is_absent_or<NP, internal_np::face_attribute_maps_t, Maps::template Face_attributes>,
                "face_attribute_maps must be a std::tuple of ReadWritePropertyMaps of the faces, or a std::vector");
  static_assert(is_absent_or<NP, internal_np::halfedge_attribute_maps_t, Maps::template Corner_attributes>,
                "halfedge_attribute_maps must be a std::tuple of ReadWritePropertyMaps of the halfedges, or a std::vector");
  static_assert(is_absent_or<NP, internal_np::face_size_bounds_map_t, Maps::template Size_bounds>,
                "face_size_bounds_map must be a ReadablePropertyMap, from faces to std::pair<double, double>");
  static_assert(is_absent_or<NP, internal_np::face_deviation_map_t, Maps::template Deviations>,
                "face_deviation_map must be a ReadablePropertyMap, from faces to double");
  static_assert(is_absent_or<NP, internal_np::edge_is_protected_map_t, Maps::template Edge_marks>,
                "edge_is_protected_map must be a ReadablePropertyMap, from edges to bool");
  static_assert(is_absent_or<NP, internal_np::surface_reconstruction_t, Is_reconstruction>,
                "surface_reconstruction must be a model of SurfaceReconstruction");
  static_assert(is_absent_or<NP, CGAL::internal_np::visitor_t, Is_visitor>,
                "visitor must be a model of AdaptationVisitor, or a std::reference_wrapper of one");
  return check_maps<Graph, NP>();
}

/// For what reads a mesh.
template <class Graph, class NamedParameters>
constexpr bool check_reading()
{
  static_assert(is_face_list_graph<Graph>,
                "the mesh must be a model of FaceListGraph; is its header in CGAL/boost/graph/ included?");
  if constexpr (is_face_list_graph<Graph>) return check_maps<Graph, NamedParameters>();
  return false;
}

/// For what adapts a mesh.
template <class Graph, class MetricField, class NamedParameters>
constexpr bool check_models()
{
  static_assert(is_mutable_face_graph<Graph>, "the mesh must be a model of MutableFaceGraph and FaceListGraph, and not "
                                              "const; is its header in CGAL/boost/graph/ included?");
  if constexpr (is_mutable_face_graph<Graph>) {
    static_assert(is_metric_field<MetricField, Graph>,
                  "the field must be a model of MetricField: one of metric_fields.h, or a ReadablePropertyMap from "
                  "vertices to sizes or to Metric_tensor_3");
    return check_parameters<Graph, NamedParameters>();
  }
  return false;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CHECK_MODELS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of the user at vertices, at faces and at the corners of faces, and where elements come from, on the adapted mesh.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ELEMENT_ATTRIBUTES_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ELEMENT_ATTRIBUTES_H

#include <CGAL/Surface_mesh_adaptation/driver/Attribute_interpolator.h>
#include <CGAL/Surface_mesh_adaptation/driver/constraints.h>
#include <CGAL/Surface_mesh_adaptation/driver/saved_values.h>
#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/surface/sector_location.h>
#include <CGAL/Surface_mesh_adaptation/surface/swap_caps.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The faces of the graph that was read.
template <class FaceGraph>
std::vector<typename boost::graph_traits<FaceGraph>::face_descriptor> faces_of(const FaceGraph& graph,
                                                                              const Imported_mesh<FaceGraph>& imported)
{
  std::vector<typename boost::graph_traits<FaceGraph>::face_descriptor> result;
  for (std::size_t h = 0; h < imported.halfedges.size(); h += 3) result.push_back(face(imported.halfedges[h], graph));
  return result;
}

/// The faces of the reference below those of the adapted mesh, if `is_wanted`.
template <class Execution, class Surface>
Buffer<Index> faces_below(const Execution& execution, const Surface& surface, bool is_wanted)
{
  Buffer<Index> below(is_wanted ? surface.mesh.number_of_faces() : 0);
  for_each_index(execution, below.size(), [&](std::size_t f) { below[f] = face_below(surface, Index(f)); },
                 heavy_chunk_length);
  return below;
}

/// Values at vertices: interpolated on the surface of the input, where the vertices have ended up; nothing is smeared on
/// the way.
template <class Maps>
class Vertex_attributes
{
public:
  template <class Imported_mesh>
  Vertex_attributes(const Imported_mesh& imported, const Maps& maps) : values_(maps)
  {
    if (!values_.empty()) save(values_, imported.vertices);
  }

  template <class Domain, class Surface>
  void write(const Domain& domain, const Surface& surface)
  {
    if (values_.empty()) return;
    domain.for_each_vertex([&](Index i, const auto& v) {
      const auto at = surface.reference().interpolation(surface.locations[i]);
      values_.for_each([&](const auto& map, const auto& values) {
        using Value = typename boost::property_traits<std::decay_t<decltype(map)>>::value_type;
        put(map, v, Attribute_interpolator<Value>()(at.weights, values[at.vertices[0]].value,
                                                    values[at.vertices[1]].value, values[at.vertices[2]].value));
      });
    });
  }

private:
  Saved_values<Maps> values_;
};

/// Values at faces: of the face of the input below the centre.
template <class Maps>
class Face_attributes
{
public:
  template <class FaceGraph>
  Face_attributes(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported, const Maps& maps)
    : values_(maps)
  {
    if (!values_.empty()) save(values_, faces_of(graph, imported));
  }

  bool empty() const { return values_.empty(); }

  /// `below[f]` is the face of the input of face `f`.
  template <class Domain>
  void write(const Domain& domain, const Buffer<Index>& below)
  {
    values_.for_each([&](const auto& map, const auto& values) {
      domain.for_each_face([&](Index f, const auto& face) { put(map, face, values[below[f]].value); });
    });
  }

private:
  Saved_values<Maps> values_;
};

/// Values at the corners of faces, each at the halfedge that arrives there: interpolated in the face of the input on whose
/// side of a feature the corner lies.
template <class Maps>
class Corner_attributes
{
public:
  template <class Imported_mesh>
  Corner_attributes(const Imported_mesh& imported, const Maps& maps) : values_(maps)
  {
    if (!values_.empty()) save(values_, imported.halfedges);
  }

  /// Constrains the edges on whose sides values differ.
  void constrain_seams(const Mesh_view& mesh, Feature_parameters& features)
  {
    values_.for_each([&](const auto&, const auto& values) {
      const auto differ = [&](Index h, Index g) { return !(values[h].value == values[g].value); };
      features.constrain(mesh, Edge_constraint::border, [&](Index h) {
        if (mesh.is_border(h)) return false;
        const Index t = mesh.twin[h];
        return differ(h, Mesh_view::previous(t)) || differ(t, Mesh_view::previous(h));
      });
    });
  }

  template <class Domain, class Surface>
  void write(const Domain& domain, const Surface& surface, const Swapped_caps& swapped)
  {
    if (values_.empty()) return;
    domain.for_each_face([&](Index f, const auto& face) {
      Index h = 3 * f;
      for (const auto g : CGAL::halfedges_around_face(halfedge(face, domain.graph()), domain.graph()))
        write_corner(g, location_in_sector(surface, Mesh_view::next(h++)), swapped);
    });
  }

private:
  /// Writes the values at `l` to the halfedge `g`.
  template <class Halfedge>
  void write_corner(const Halfedge& g, const Location& l, const Swapped_caps& swapped)
  {
    const Attribute_weights w{1 - l.u - l.v, l.u, l.v};
    const auto arriving = [&](Index i) { return Mesh_view::previous(swapped.corner_before(3 * l.cell + i)); };
    values_.for_each([&](const auto& map, const auto& values) {
      using Value = typename boost::property_traits<std::decay_t<decltype(map)>>::value_type;
      put(map, g, Attribute_interpolator<Value>()(w, values[arriving(0)].value, values[arriving(1)].value,
                                                  values[arriving(2)].value));
    });
  }

  Saved_values<Maps> values_;
};

/// What an origin map gets: a descriptor of the input, or a number, counted in the order in which the mesh listed it.
template <class Map, class Descriptor>
auto origin_value(const Descriptor& descriptor, std::size_t number)
{
  using Value = typename boost::property_traits<Map>::value_type;
  if constexpr (std::is_integral_v<Value>) return Value(number);
  else return Value(descriptor);
}

/// Where vertices and faces come from.
template <class FaceGraph, class NamedParameters>
class Origins
{
public:
  using Traits = boost::graph_traits<FaceGraph>;
  static constexpr bool of_vertices = has_parameter<NamedParameters, internal_np::vertex_origin_map_t>;
  static constexpr bool of_faces = has_parameter<NamedParameters, internal_np::face_origin_map_t>;

  Origins(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported, const NamedParameters& np) : np_(np)
  {
    if constexpr (of_vertices) {
      vertices_ = imported.vertices;
      vertex_number_ = numbers(vertices(graph), vertices_, get(CGAL::dynamic_vertex_property_t<std::size_t>(), graph));
    }
    if constexpr (of_faces) {
      faces_ = faces_of(graph, imported);
      face_number_ = numbers(faces(graph), faces_, get(CGAL::dynamic_face_property_t<std::size_t>(), graph));
    }
  }

  template <class Domain, class Surface>
  void write(const Domain& domain, const Surface& surface, const Buffer<Index>& below) const
  {
    if constexpr (of_vertices) {
      const auto map = CGAL::parameters::get_parameter(np_, internal_np::vertex_origin_map);
      using Map = std::decay_t<decltype(map)>;
      domain.for_each_vertex([&](Index i, const auto& v) {
        const Index o = surface.origin[i];
        put(map, v, o == no_index ? origin_value<Map>(Traits::null_vertex(), std::size_t(-1))
                                  : origin_value<Map>(vertices_[o], vertex_number_[o]));
      });
    }
    if constexpr (of_faces) {
      const auto map = CGAL::parameters::get_parameter(np_, internal_np::face_origin_map);
      using Map = std::decay_t<decltype(map)>;
      domain.for_each_face([&](Index f, const auto& face) {
        put(map, face, origin_value<Map>(faces_[below[f]], face_number_[below[f]]));
      });
    }
  }

private:
  /// The places of `some` elements among `all`.
  template <class All, class Some, class Map>
  static std::vector<std::size_t> numbers(const All& all, const Some& some, const Map& place)
  {
    std::size_t i = 0;
    for (const auto& e : all) put(place, e, i++);
    std::vector<std::size_t> result;
    for (const auto& e : some) result.push_back(get(place, e));
    return result;
  }

  const NamedParameters& np_;
  std::vector<std::size_t> vertex_number_, face_number_;
  std::vector<typename Traits::vertex_descriptor> vertices_;
  std::vector<typename Traits::face_descriptor> faces_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ELEMENT_ATTRIBUTES_H

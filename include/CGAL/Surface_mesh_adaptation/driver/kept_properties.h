// SPDX-License-Identifier: GPL-3.0-or-later
//
// The property maps of the vertices of a `Surface_mesh` that nobody passed: they keep their values where a vertex of the
// input is still there. A mesh says the names of its maps, but not how to copy them: those of the usual types are kept,
// others get their default value.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_KEPT_PROPERTIES_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_KEPT_PROPERTIES_H

#include <CGAL/Surface_mesh_adaptation/driver/domain.h>
#include <CGAL/Surface_mesh_adaptation/driver/saved_values.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <CGAL/IO/Color.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Nothing: other graphs have no maps of their own, and in a part of a mesh vertices stay what they are.
template <class Domain>
class Kept_properties
{
public:
  template <class Imported_mesh>
  Kept_properties(const Domain&, const Imported_mesh&)
  {}

  template <class Surface>
  void write(const Domain&, const Surface&)
  {}
};

template <class Map> const Map* found_map(const std::pair<Map, bool>& map) { return map.second ? &map.first : nullptr; }
template <class Map> const Map* found_map(const std::optional<Map>& map) { return map ? &*map : nullptr; }

template <class Point>
class Kept_properties<Whole_mesh<CGAL::Surface_mesh<Point>>>
{
public:
  using Mesh = CGAL::Surface_mesh<Point>;
  using Domain = Whole_mesh<Mesh>;
  using Vertex = typename Mesh::Vertex_index;
  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;

  Kept_properties(const Domain& domain, const Imported_mesh<Mesh>& imported)
  {
    for (const std::string& name : domain.graph().template properties<Vertex>())
      if (name != "v:connectivity" && name != "v:point" && name != "v:removed")
        std::apply([&](auto&... maps) { (save(domain.graph(), name, imported, maps), ...); }, maps_);
  }

  template <class Surface>
  void write(const Domain& domain, const Surface& surface)
  {
    std::apply([&](auto&... maps) { (write_maps(domain, surface, maps), ...); }, maps_);
  }

private:
  template <class Value>
  struct Saved_map
  {
    typename Mesh::template Property_map<Vertex, Value> map;
    std::vector<Saved_value<Value>> values;
  };

  template <class... Values>
  using Maps = std::tuple<std::vector<Saved_map<Values>>...>;

  template <class Value>
  static void save(const Mesh& mesh, const std::string& name, const Imported_mesh<Mesh>& imported,
                   std::vector<Saved_map<Value>>& maps)
  {
    const auto found = mesh.template property_map<Vertex, Value>(name);
    const auto* map = found_map(found);
    if (map == nullptr) return;
    maps.push_back({*map, {}});
    for (const Vertex v : imported.vertices) maps.back().values.push_back({(*map)[v]});
  }

  template <class Surface, class Value>
  static void write_maps(const Domain& domain, const Surface& surface, std::vector<Saved_map<Value>>& maps)
  {
    for (Saved_map<Value>& saved : maps)
      domain.for_each_vertex([&](Index i, Vertex v) {
        if (surface.origin[i] != no_index) saved.map[v] = saved.values[surface.origin[i]].value;
      });
  }

  Maps<bool, char, unsigned char, short, int, unsigned int, long, unsigned long, float, double, std::string,
       CGAL::IO::Color, typename Kernel::Point_2, typename Kernel::Point_3, typename Kernel::Vector_2,
       typename Kernel::Vector_3> maps_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_KEPT_PROPERTIES_H

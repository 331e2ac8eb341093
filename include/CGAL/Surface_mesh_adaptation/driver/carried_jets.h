// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals and shape operators in the property maps of the user: read from the input, and left at the vertices of the
// result, so that the next run goes on with them instead of estimating them anew.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CARRIED_JETS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CARRIED_JETS_H

#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/surface/Lazy_jets.h>

#include <CGAL/number_utils.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The normals and shape operators that the parameters give.
/// \throws Invalid_normal_error
template <class FaceGraph, class NamedParameters>
Given_jets given_jets(const Imported_mesh<FaceGraph>& imported, const NamedParameters& np)
{
  Given_jets given;
  if constexpr (has_parameter<NamedParameters, CGAL::internal_np::vertex_normal_map_t>) {
    const auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_normal_map);
    for (const auto v : imported.vertices) {
      const auto& n = get(map, v);
      const Vector_3 normal(CGAL::to_double(n.x()), CGAL::to_double(n.y()), CGAL::to_double(n.z()));
      if (!(normal.norm() > 0 && normal.allFinite())) throw Invalid_normal_error(given.normals.size());
      given.normals.push_back(normal.normalized());
    }
  }
  if constexpr (has_parameter<NamedParameters, internal_np::vertex_shape_operator_map_t>) {
    const auto map = CGAL::parameters::get_parameter(np, internal_np::vertex_shape_operator_map);
    for (const auto v : imported.vertices) {
      given.shape_operators.push_back(get(map, v));
      if (!given.shape_operators.back().matrix().allFinite())
        throw Invalid_normal_error(given.shape_operators.size() - 1);
    }
  }
  return given;
}

/// The normals and shape operators at the vertices of a surface, for those maps of the parameters that can be written.
template <class NamedParameters>
class Carried_jets
{
public:
  static constexpr bool has_normals = has_writable_map<NamedParameters, CGAL::internal_np::vertex_normal_map_t>();
  static constexpr bool has_shape_operators =
    has_writable_map<NamedParameters, internal_np::vertex_shape_operator_map_t>();

  /// `location(v)` is that of vertex `v` on `reference`, of `n` vertices.
  template <class Execution, class Reference, class LocationOf>
  Carried_jets(const Execution& execution, const Reference& reference, std::size_t n, const LocationOf& location,
               const NamedParameters& np)
    : np_(np)
  {
    if constexpr (has_normals || has_shape_operators) {
      jets_.resize(n);
      for_each_index(execution, n, [&](std::size_t v) { jets_[v] = reference.jet(location(v)); }, heavy_chunk_length);
    }
  }

  template <class Domain>
  void write(const Domain& domain) const
  {
    if constexpr (has_normals) {
      const auto map = CGAL::parameters::get_parameter(np_, CGAL::internal_np::vertex_normal_map);
      using Normal = typename boost::property_traits<std::decay_t<decltype(map)>>::value_type;
      domain.for_each_vertex([&](Index i, const auto& v) {
        const Vector_3& n = jets_[i].normal;
        put(map, v, Normal(n[0], n[1], n[2]));
      });
    }
    if constexpr (has_shape_operators) {
      const auto map = CGAL::parameters::get_parameter(np_, internal_np::vertex_shape_operator_map);
      domain.for_each_vertex([&](Index i, const auto& v) { put(map, v, jets_[i].shape_operator); });
    }
  }

private:
  const NamedParameters& np_;
  Buffer<Jet> jets_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CARRIED_JETS_H

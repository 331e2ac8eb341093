// SPDX-License-Identifier: GPL-3.0-or-later
//
// What entry points read from a pack of named parameters.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_UNPACK_PARAMETERS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_UNPACK_PARAMETERS_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/parameters.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_type_config.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

template <class T> T& unwrap(T& t) { return t; }
template <class T> T& unwrap(std::reference_wrapper<T>& r) { return r.get(); }

/// The value of a named parameter, or a default.
template <class NamedParameters, class Tag, class Default>
auto choose(const NamedParameters& np, Tag tag, const Default& by_default)
{
  return CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, tag), by_default);
}

template <class NamedParameters, class Tag>
constexpr bool has_parameter =
  !std::is_same_v<std::decay_t<decltype(CGAL::parameters::get_parameter(std::declval<NamedParameters>(), Tag()))>,
                  CGAL::internal_np::Param_not_found>;

/// The cosine of the parameter `maximum_normal_deviation`, or `by_default`.
/// \throws Invalid_parameter_error
template <class NamedParameters>
double cosine_of_normal_deviation(const NamedParameters& np, double by_default)
{
  if constexpr (has_parameter<NamedParameters, internal_np::maximum_normal_deviation_t>) {
    const double degrees = CGAL::parameters::get_parameter(np, internal_np::maximum_normal_deviation);
    if (!(degrees > 0 && degrees <= 180))
      throw Invalid_parameter_error("the normal deviation must lie between 0 and 180 degrees");
    return std::cos(degrees * CGAL_PI / 180);
  }
  return by_default;
}

template <class FaceGraph, class NamedParameters>
auto point_map(FaceGraph& graph, const NamedParameters& np)
{
  if constexpr (has_parameter<NamedParameters, CGAL::internal_np::vertex_point_t>)
    return CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point);
  else return CGAL::get_property_map(CGAL::vertex_point, graph);
}

template <class FaceGraph, class NamedParameters>
auto point_map(const FaceGraph& graph, const NamedParameters& np)
{
  if constexpr (has_parameter<NamedParameters, CGAL::internal_np::vertex_point_t>)
    return CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point);
  else return CGAL::get_const_property_map(CGAL::vertex_point, graph);
}

/// Whether `put` may be called with `Map`: lvalue maps of constants say no more than that they can be read.
template <class Map>
constexpr bool is_writable =
  std::is_convertible_v<typename boost::property_traits<Map>::category, boost::writable_property_map_tag> &&
  !std::is_const_v<std::remove_reference_t<typename boost::property_traits<Map>::reference>>;

/// Whether the parameter `Tag` is given, and is a property map that can be written.
template <class NamedParameters, class Tag>
constexpr bool has_writable_map()
{
  if constexpr (has_parameter<NamedParameters, Tag>)
    return is_writable<std::decay_t<decltype(CGAL::parameters::get_parameter(std::declval<NamedParameters>(), Tag()))>>;
  else
    return false;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_UNPACK_PARAMETERS_H

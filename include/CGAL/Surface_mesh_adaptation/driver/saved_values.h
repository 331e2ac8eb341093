// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of the user's property maps, from before the mesh is replaced.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_SAVED_VALUES_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_SAVED_VALUES_H

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A value in a vector, for those of `bool` are packed.
template <class Value>
struct Saved_value
{
  Value value;
};

/// The values of several property maps at elements of the input, from before it is replaced.
template <class... Maps>
class Saved_values
{
public:
  explicit Saved_values(const std::tuple<Maps...>& maps) : maps_(maps) {}

  template <class Elements>
  void save(const Elements& elements)
  {
    for_each([&](const auto& map, auto& values) {
      values.reserve(elements.size());
      for (const auto& e : elements) values.push_back({get(map, e)});
    });
  }

  /// Calls `f(map, values)`, of which `values[i].value` is that of element `i`, for each map.
  template <class F>
  void for_each(const F& f)
  {
    for_each(f, std::index_sequence_for<Maps...>());
  }

private:
  template <class F, std::size_t... i>
  void for_each(const F& f, std::index_sequence<i...>)
  {
    (f(std::get<i>(maps_), std::get<i>(values_)), ...);
  }

  std::tuple<Maps...> maps_;
  std::tuple<std::vector<Saved_value<typename boost::property_traits<Maps>::value_type>>...> values_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_SAVED_VALUES_H

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

/// The values of several property maps at elements of the input, from before it is replaced. The maps are a tuple, or a
/// vector of those of one type.
template <class Maps>
class Saved_values;

template <class... Maps>
class Saved_values<std::tuple<Maps...>>
{
public:
  explicit Saved_values(const std::tuple<Maps...>& maps) : maps_(maps) {}

  bool empty() const { return sizeof...(Maps) == 0; }

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

template <class Map, class Allocator>
class Saved_values<std::vector<Map, Allocator>>
{
public:
  explicit Saved_values(const std::vector<Map, Allocator>& maps) : maps_(maps), values_(maps.size()) {}

  bool empty() const { return maps_.empty(); }

  template <class F>
  void for_each(const F& f)
  {
    for (std::size_t i = 0; i < maps_.size(); ++i) f(maps_[i], values_[i]);
  }

private:
  std::vector<Map, Allocator> maps_;
  std::vector<std::vector<Saved_value<typename boost::property_traits<Map>::value_type>>> values_;
};

/// Saves the values at `elements`.
template <class Maps, class Elements>
void save(Saved_values<Maps>& saved, const Elements& elements)
{
  saved.for_each([&](const auto& map, auto& values) {
    values.reserve(elements.size());
    for (const auto& e : elements) values.push_back({get(map, e)});
  });
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_SAVED_VALUES_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Attributes of the user at the vertices (scalars, vectors, colours, texture coordinates) on the adapted mesh. They are
// interpolated once, on the surface of the input, where the vertices have ended up: nothing is smeared on the way.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ATTRIBUTE_TRANSFER_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ATTRIBUTE_TRANSFER_H

#include <CGAL/IO/Color.h>
#include <CGAL/Point_2.h>
#include <CGAL/Point_3.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

/// Barycentric weights of three values; they are not negative and sum up to 1.
using Attribute_weights = std::array<double, 3>;

/// How the values at three vertices combine to the value between them: linearly; integers, `bool` and enumerations are
/// those of the nearest vertex. There are specialisations for points, colours and `std::array`s. Specialise it for
/// types that know no sum, and no product with a `double`.
template <class Value, class = void>
struct Attribute_interpolator
{
  /// The value between `a`, `b` and `c`.
  Value operator()(const Attribute_weights& w, const Value& a, const Value& b, const Value& c) const
  {
    return Value(w[0] * a + w[1] * b + w[2] * c);
  }
};

/// \cond SKIP_IN_MANUAL
/// Numbers of something, and truth: that of the nearest vertex.
template <class Value>
struct Attribute_interpolator<Value, std::enable_if_t<std::is_integral_v<Value> || std::is_enum_v<Value>>>
{
  Value operator()(const Attribute_weights& w, Value a, Value b, Value c) const
  {
    return w[0] >= w[1] && w[0] >= w[2] ? a : w[1] >= w[2] ? b : c;
  }
};

template <class Value, std::size_t n>
struct Attribute_interpolator<std::array<Value, n>>
{
  using Array = std::array<Value, n>;
  Array operator()(const Attribute_weights& w, const Array& a, const Array& b, const Array& c) const
  {
    Array r;
    for (std::size_t i = 0; i < n; ++i) r[i] = Attribute_interpolator<Value>()(w, a[i], b[i], c[i]);
    return r;
  }
};

template <class Kernel>
struct Attribute_interpolator<CGAL::Point_3<Kernel>>
{
  using Point = CGAL::Point_3<Kernel>;
  Point operator()(const Attribute_weights& w, const Point& a, const Point& b, const Point& c) const
  {
    return Point(w[0] * a.x() + w[1] * b.x() + w[2] * c.x(), w[0] * a.y() + w[1] * b.y() + w[2] * c.y(),
                 w[0] * a.z() + w[1] * b.z() + w[2] * c.z());
  }
};

template <class Kernel>
struct Attribute_interpolator<CGAL::Point_2<Kernel>>
{
  using Point = CGAL::Point_2<Kernel>;
  Point operator()(const Attribute_weights& w, const Point& a, const Point& b, const Point& c) const
  {
    return Point(w[0] * a.x() + w[1] * b.x() + w[2] * c.x(), w[0] * a.y() + w[1] * b.y() + w[2] * c.y());
  }
};

template <>
struct Attribute_interpolator<CGAL::IO::Color>
{
  using Color = CGAL::IO::Color;
  Color operator()(const Attribute_weights& w, const Color& a, const Color& b, const Color& c) const
  {
    std::array<unsigned char, 4> r{};
    for (std::size_t i = 0; i < 4; ++i)
      r[i] = static_cast<unsigned char>(std::lround(w[0] * a[i] + w[1] * b[i] + w[2] * c[i]));
    return Color(r[0], r[1], r[2], r[3]);
  }
};
/// \endcond

namespace internal {

/// The values of `maps` at the vertices of the input, from before it is replaced.
template <class FaceGraph, class... Maps>
class Attribute_transfer
{
public:
  template <class Imported_mesh>
  Attribute_transfer(const Imported_mesh& imported, const std::tuple<Maps...>& maps) : maps_(maps)
  {
    for_each([&](const auto& map, auto& values) {
      values.reserve(imported.vertices.size());
      for (const auto v : imported.vertices) values.push_back(get(map, v));
    });
  }

  /// Writes them to `graph`, of which vertex `i` is that of `surface`.
  template <class Surface>
  void write(const FaceGraph& graph, const Surface& surface)
  {
    std::size_t i = 0;
    for (const auto v : vertices(graph)) {
      const auto at = surface.reference().interpolation(surface.locations[i++]);
      for_each([&](const auto& map, const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        put(map, v, Attribute_interpolator<Value>()(at.weights, values[at.vertices[0]], values[at.vertices[1]],
                                                    values[at.vertices[2]]));
      });
    }
  }

private:
  template <class F>
  void for_each(const F& f)
  {
    for_each(f, std::index_sequence_for<Maps...>());
  }

  template <class F, std::size_t... i>
  void for_each(const F& f, std::index_sequence<i...>)
  {
    (f(std::get<i>(maps_), std::get<i>(values_)), ...);
  }

  std::tuple<Maps...> maps_;
  std::tuple<std::vector<typename boost::property_traits<Maps>::value_type>...> values_;
};

} // namespace internal
/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ATTRIBUTE_TRANSFER_H

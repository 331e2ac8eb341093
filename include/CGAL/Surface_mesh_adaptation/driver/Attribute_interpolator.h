// SPDX-License-Identifier: GPL-3.0-or-later
//
// How attributes of the user (scalars, vectors, colours, texture coordinates) are interpolated between three vertices.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ATTRIBUTE_INTERPOLATOR_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ATTRIBUTE_INTERPOLATOR_H

#include <CGAL/IO/Color.h>
#include <CGAL/Point_2.h>
#include <CGAL/Point_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

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
/// The same, exact where the values are.
template <class Value>
struct Attribute_interpolator<Value, std::enable_if_t<std::is_floating_point_v<Value>>>
{
  Value operator()(const Attribute_weights& w, Value a, Value b, Value c) const
  {
    return Value(a + w[1] * (b - a) + w[2] * (c - a));
  }
};

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

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ATTRIBUTE_INTERPOLATOR_H

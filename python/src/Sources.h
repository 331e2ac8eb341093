// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where on the input a vertex of the result lies, carried over as an attribute: whatever there is at the points of the
// input can be interpolated with it afterwards.

#ifndef SMA_PYTHON_SOURCES_H
#define SMA_PYTHON_SOURCES_H

#include <CGAL/Surface_mesh_adaptation/driver/Attribute_interpolator.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace sma_python {

/// Points of the input and barycentric weights of these.
struct Source
{
  std::array<std::int32_t, 3> points{};
  std::array<double, 3> weights{1, 0, 0};

  Source() = default;
  explicit Source(std::size_t point) { points.fill(std::int32_t(point)); }
};

} // namespace sma_python

template <>
struct CGAL::Surface_mesh_adaptation::Attribute_interpolator<sma_python::Source>
{
  using Source = sma_python::Source;

  Source operator()(const Attribute_weights& w, const Source& a, const Source& b, const Source& c) const
  {
    Source s;
    s.points = {a.points[0], b.points[0], c.points[0]};
    s.weights = w;
    return s;
  }
};

#endif // SMA_PYTHON_SOURCES_H

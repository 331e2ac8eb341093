// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many vertices the metric asks for on a mesh under adaptation, and how many there may be.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_EXPECTED_SIZE_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_EXPECTED_SIZE_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/physical_memory.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// Vertices per unit of area in the metric: two faces for each, of area sqrt(3) / 4.
constexpr double vertices_per_area = 1.1547005383792515;

template <class Execution, class Surface, class Map>
auto sum_over_faces(const Execution& execution, const Surface& surface, const Map& map)
{
  using Sum = decltype(map(Index()));
  return reduce(execution, surface.mesh.number_of_faces(), Sum(), [&](std::size_t f) {
    return surface.mesh.is_removed_face(Index(f)) ? Sum() : map(Index(f));
  }, std::plus<Sum>());
}

/// Area of a face in the mean metric of its corners.
template <class Surface>
double area_in_metric(const Surface& surface, Index f)
{
  const Index a = surface.mesh.corner[3 * f], b = surface.mesh.corner[3 * f + 1], c = surface.mesh.corner[3 * f + 2];
  const Vector_3 ab = surface.points[b] - surface.points[a], ac = surface.points[c] - surface.points[a];
  return face_mass(surface.metrics[a], surface.metrics[b], surface.metrics[c], ab, ac, ab.cross(ac).norm()) / 6;
}

inline double smallest_size(const Isotropic_metric& m) { return 1 / m.inverse_size; }
inline double smallest_size(const Anisotropic_metric& m) { return 1 / std::sqrt(eigen_decomposition(m.m).values[2]); }

} // namespace internal

/// The vertices of a mesh of unit triangles with the area that the faces have in the metric, which is measured at their
/// corners.
template <class Execution, class Surface>
double vertices_of_area(const Execution& execution, const Surface& surface)
{
  return internal::vertices_per_area * internal::sum_over_faces(execution, surface, [&](Index f) {
    return internal::area_in_metric(surface, f);
  });
}

namespace internal {

/// The vertices of unit edges along the feature curves, which may have hardly an area between them: those of the edges
/// that face `f` owns.
template <class Surface>
double vertices_of_curves(const Surface& surface, Index f)
{
  double length = 0;
  for (Index h = 3 * f; h < 3 * f + 3; ++h)
    if (surface.mesh.is_feature(h) && surface.mesh.is_edge_owner(h)) length += surface.length(h);
  return length;
}

/// The vertices of unit edges along the face `f` with the area `area` in the metric, if it is less high than half an edge:
/// those of a wire have hardly an area.
template <class Surface>
double vertices_of_thin_face(const Surface& surface, Index f, double area)
{
  const Mesh_view& mesh = surface.mesh;
  double longest = 0;
  for (Index h = 3 * f; h < 3 * f + 3; ++h)
    if (!surface.is_shorter(mesh.source(h), mesh.target(h), (std::max)(longest, 4 * area))) longest = surface.length(h);
  return longest / 2;
}

} // namespace internal

/// The same as `vertices_of_area`, of the reference as it is at the start, with the metric measured at many points of
/// each face: at the corners of large faces it says little of what is between them.
template <class Execution, class Surface>
double sampled_vertices_of_area(const Execution& execution, const Surface& surface)
{
  constexpr int parts = 8; // of each edge
  const auto& reference = surface.reference();
  return internal::vertices_per_area * reduce(execution, reference.mesh.number_of_faces(), 0.0, [&](std::size_t f) {
    const std::size_t h = 3 * f;
    const Vector_3& p = reference.points[reference.mesh.corner[h]];
    const Vector_3 e1 = reference.points[reference.mesh.corner[h + 1]] - p;
    const Vector_3 e2 = reference.points[reference.mesh.corner[h + 2]] - p, n = e1.cross(e2);
    if (!(n.norm() > 0)) return 0.0;
    double sum = 0;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < 2 * (parts - i) - 1; ++j) { // the triangles of a strip, upright and upside down in turns
        const double shift = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3, u = (i + shift) / parts, v = (j / 2 + shift) / parts;
        const auto m = surface.background().at(reference, {Vertex_class::smooth, Index(f), u, v},
                                               {p + u * e1 + v * e2, n.normalized()});
        sum += face_mass(m, m, m, e1, e2, n.norm());
      }
    return sum / (6 * parts * parts);
  }, std::plus<double>());
}

/// The most vertices that indices and the memory of this machine can hold, or that `asked` allows.
inline std::size_t largest_number_of_vertices(std::size_t asked)
{
  constexpr double bytes_per_vertex = 450; // of a whole run: 420 to 460 measured, 580 in anisotropic metrics
  const double in_memory = double(internal::physical_memory()) / bytes_per_vertex;
  const std::size_t by_indices = max_number_of_faces / 2;
  return (std::min)(asked, in_memory < double(by_indices) ? std::size_t(in_memory) : by_indices);
}

/// Refuses a metric that asks for more than `largest` vertices.
/// \throws Mesh_too_large_error
template <class Execution, class Surface>
void check_expected_size(const Execution& execution, const Surface& surface, std::size_t largest)
{
  if (vertices_of_area(execution, surface) <= double(largest)) return;
  const double expected = sampled_vertices_of_area(execution, surface);
  if (expected <= double(largest)) return;
  double size = std::numeric_limits<double>::infinity();
  for (const auto& m : surface.metrics) size = (std::min)(size, internal::smallest_size(m));
  const auto [low, high] = internal::bounding_box(surface.points);
  throw Mesh_too_large_error({expected, largest, size, (high - low).norm()});
}

/// How far refinement may go: metrics know how many vertices they ask for, and where faces are degenerate, or what one
/// kernel does another takes back, splitting could go on without end.
class Limit_of_refinement
{
public:
  /// What is thin at the start may need more vertices than its area tells.
  template <class Execution, class Surface>
  Limit_of_refinement(const Execution& execution, const Surface& surface)
    : largest_(surface.max_number_of_vertices), start_(surface.mesh.number_of_vertices())
  {
    const Shares s = shares(execution, surface);
    area_ = internal::vertices_per_area * s.area;
    thin_ = s.thin;
    allow(area_ + s.curves);
  }

  /// The vertices that the metric asks for, by the area at the start.
  double vertices_of_area() const { return area_; }

  /// Whether a mesh of `n` vertices goes beyond what the metric asks for by far, or beyond what is possible.
  template <class Execution, class Surface>
  bool is_exceeded(const Execution& execution, const Surface& surface, std::size_t n)
  {
    if (n > largest_) return true;
    if (double(n) <= allowed_) return false;
    const Shares s = shares(execution, surface);
    allow(internal::vertices_per_area * s.area + s.curves);
    return double(n) > allowed_;
  }

private:
  static constexpr double excess = 4;   // of the vertices that are asked for
  static constexpr double least = 1000; // vertices, whatever is asked for

  /// Of the faces.
  struct Shares
  {
    double area = 0, curves = 0, thin = 0;

    Shares operator+(const Shares& s) const { return {area + s.area, curves + s.curves, thin + s.thin}; }
  };

  template <class Execution, class Surface>
  static Shares shares(const Execution& execution, const Surface& surface)
  {
    return internal::sum_over_faces(execution, surface, [&](Index f) {
      const double area = internal::area_in_metric(surface, f);
      return Shares{area, internal::vertices_of_curves(surface, f), internal::vertices_of_thin_face(surface, f, area)};
    });
  }

  void allow(double asked) { allowed_ = (std::max)(allowed_, double(start_) + least + excess * (thin_ + asked)); }

  std::size_t largest_, start_;
  double area_ = 0, thin_ = 0, allowed_ = 0;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_EXPECTED_SIZE_H

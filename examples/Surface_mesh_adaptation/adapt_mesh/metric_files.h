// SPDX-License-Identifier: GPL-3.0-or-later
//
// Metrics at the vertices, from and to the fields of MEDIT's solutions.

#ifndef ADAPT_MESH_METRIC_FILES_H
#define ADAPT_MESH_METRIC_FILES_H

#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace adapt_mesh {

/// Bounds on the sizes that a metric asks for; 0 is no bound.
class Size_bounds
{
public:
  Size_bounds(double hmin, double hmax) : hmin_(hmin), hmax_(hmax > 0 ? hmax : std::numeric_limits<double>::infinity())
  {}

  double clamped(double size) const { return std::clamp(size, hmin_, hmax_); }

  SMA::Metric_tensor_3 clamped(const SMA::Metric_tensor_3& m) const
  {
    if (hmin_ == 0 && hmax_ == std::numeric_limits<double>::infinity()) return m; // bit for bit
    SMA::Eigen_decomposition_3 e = SMA::eigen_decomposition(m);
    for (double& l : e.values) {
      const double size = clamped(1 / std::sqrt(l));
      l = 1 / (size * size);
    }
    return SMA::metric_tensor(e.values, e.vectors);
  }

private:
  double hmin_;
  double hmax_;
};

inline bool is_valid_metric(double size) { return size > 0; }
inline bool is_valid_metric(const SMA::Metric_tensor_3& m) { return SMA::is_positive_definite(m); }

inline Mesh::Property_map<Vertex, double> scalar_map(const SMA::Medit_field& field, Constrained_mesh& mesh)
{
  auto map = mesh.mesh.add_property_map<Vertex, double>("v:field").first;
  for (std::size_t i = 0; i < mesh.vertex_of_point.size(); ++i)
    if (mesh.vertex_of_point[i] != Mesh::null_vertex()) put(map, mesh.vertex_of_point[i], field.values[i]);
  for (const auto& [copy, original] : mesh.copies) put(map, copy, get(map, original));
  return map;
}

/// Stores the value that `value_of(i)` has for the i-th point of the file at its vertex, within bounds.
/// \throws Invalid_metric_error
template <class Value, class ValueOfPoint>
Mesh::Property_map<Vertex, Value> metric_map(Constrained_mesh& mesh, const Size_bounds& bounds,
                                             const ValueOfPoint& value_of)
{
  auto map = mesh.mesh.add_property_map<Vertex, Value>("v:target_metric").first;
  for (std::size_t i = 0; i < mesh.vertex_of_point.size(); ++i) {
    const Value value = value_of(i);
    if (!is_valid_metric(value)) throw SMA::Invalid_metric_error(i);
    if (mesh.vertex_of_point[i] != Mesh::null_vertex()) put(map, mesh.vertex_of_point[i], bounds.clamped(value));
  }
  for (const auto& [copy, original] : mesh.copies) put(map, copy, get(map, original));
  return map;
}

inline auto size_map(const SMA::Medit_field& metric, Constrained_mesh& mesh, const Size_bounds& bounds)
{
  return metric_map<double>(mesh, bounds, [&](std::size_t i) { return metric.values[i]; });
}

inline auto tensor_map(const SMA::Medit_field& metric, Constrained_mesh& mesh, const Size_bounds& bounds)
{
  return metric_map<SMA::Metric_tensor_3>(mesh, bounds, [&](std::size_t i) {
    const double* const c = metric.values.data() + 6 * i;
    return SMA::Metric_tensor_3(c[0], c[1], c[2], c[3], c[4], c[5]);
  });
}

/// Where the library writes the metric at the vertices of the output; does nothing unless it was asked for.
struct Output_metric
{
  using key_type = Vertex;
  using value_type = SMA::Metric_tensor_3;
  using reference = void;
  using category = boost::writable_property_map_tag;

  Mesh::Property_map<Vertex, SMA::Metric_tensor_3> map;
  bool wanted = false;

  friend void put(const Output_metric& output, Vertex v, const SMA::Metric_tensor_3& m)
  {
    if (output.wanted) put(output.map, v, m);
  }
};

/// Writes the tensors of the vertices in the order of the mesh. \throws Io_error
inline void write_metric(const std::string& file, const Mesh& mesh, const Output_metric& metric)
{
  SMA::Medit_field tensors;
  tensors.components = 6;
  for (const Vertex v : mesh.vertices()) {
    const SMA::Metric_tensor_3& m = get(metric.map, v);
    for (int i = 0; i < 6; ++i) tensors.values.push_back(m[i]);
  }
  SMA::write_medit_solution(file, {tensors});
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_METRIC_FILES_H

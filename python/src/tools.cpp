// SPDX-License-Identifier: GPL-3.0-or-later

#include "tools.h"

#include "Array_surface.h"
#include "execution.h"

#include <CGAL/Surface_mesh_adaptation/driver/in_place.h>
#include <CGAL/Surface_mesh_adaptation/estimate_vertex_jets.h>
#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/fields/hessian.h>
#include <CGAL/Surface_mesh_adaptation/fields/metric_normalization.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/exponential_map.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_jets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sma_python {

namespace {

using SMA::Index;
using SMA::Metric_tensor_3;
using SMA::Vector_3;
using SMA::internal::Any_execution;

auto feature_parameters(const Array_surface& surface, const Options& options)
{
  return SMA::parameters::detect_features(options.detect_features)
    .feature_angle(options.feature_angle > 0 ? options.feature_angle : SMA::Feature_parameters().ridge_angle)
    .smooth_borders(options.smooth_borders)
    .edge_is_constrained_map(surface.edge_is_constrained)
    .vertex_is_constrained_map(surface.vertex_is_constrained);
}

Any_execution execution_of(const Options& options)
{
  return with_execution(options.execution, [](const auto& execution) { return Any_execution(execution); });
}

/// Arrays as a smooth surface, whose vertices are numbered as those of the mesh.
struct Smooth_surface
{
  Any_execution execution;
  Array_surface arrays;
  SMA::Reference_surface<SMA::Gregory_reconstruction> reference;

  Smooth_surface(const Surface_arrays& input, const Options& options)
    : Smooth_surface(execution_of(options), input, options)
  {}

  std::size_t number_of_vertices() const { return reference.points.size(); }
  std::size_t point(std::size_t v) const { return arrays.point_of_vertex[v]; }

private:
  Smooth_surface(const Any_execution& policy, const Surface_arrays& input, const Options& options)
    : execution(policy), arrays(input), reference(make_reference(policy, arrays, options))
  {}

  static SMA::Reference_surface<SMA::Gregory_reconstruction>
  make_reference(const Any_execution& policy, const Array_surface& surface, const Options& options)
  {
    const auto imported = SMA::read_face_graph(policy, surface.mesh, surface.mesh.points());
    return {policy, imported.mesh, imported.points,
            SMA::internal::feature_parameters(surface.mesh, imported, feature_parameters(surface, options))};
  }
};

std::vector<double> sizes_at_vertices(const Smooth_surface& surface, const Options& options)
{
  std::vector<double> sizes(surface.number_of_vertices());
  for (std::size_t v = 0; v < sizes.size(); ++v) sizes[v] = *options.sizes.row(surface.point(v));
  return sizes;
}

std::vector<Metric_tensor_3> tensors_at_vertices(const Smooth_surface& surface, const Options& options)
{
  std::vector<Metric_tensor_3> tensors(surface.number_of_vertices());
  for (std::size_t v = 0; v < tensors.size(); ++v) tensors[v] = tensor_of(options.tensors.row(surface.point(v)));
  return tensors;
}

/// What points have that no triangle uses stays as it is.
std::vector<double> at_points(const Smooth_surface& surface, const Options& options, const std::vector<double>& sizes)
{
  std::vector<double> result(options.sizes.data, options.sizes.data + options.sizes.rows);
  for (std::size_t v = 0; v < sizes.size(); ++v) result[surface.point(v)] = sizes[v];
  return result;
}

void put(std::vector<double>& rows, std::size_t i, const Metric_tensor_3& m)
{
  const std::array<double, 9> row{m[0], m[1], m[3], m[1], m[2], m[4], m[3], m[4], m[5]};
  std::copy(row.begin(), row.end(), rows.begin() + std::ptrdiff_t(9 * i));
}

void put(std::vector<double>& rows, std::size_t i, const Vector_3& v)
{
  std::copy(v.data(), v.data() + 3, rows.begin() + std::ptrdiff_t(3 * i));
}

std::vector<double> at_points(const Smooth_surface& surface, const Options& options,
                              const std::vector<Metric_tensor_3>& tensors)
{
  std::vector<double> result(options.tensors.data, options.tensors.data + 9 * options.tensors.rows);
  for (std::size_t v = 0; v < tensors.size(); ++v) put(result, surface.point(v), tensors[v]);
  return result;
}

/// Calls `use(values)` with the sizes or the tensors of the options.
template <class Use>
auto with_metric(const Smooth_surface& surface, const Options& options, const Use& use)
{
  return options.tensors.empty() ? use(sizes_at_vertices(surface, options))
                                 : use(tensors_at_vertices(surface, options));
}

void grade(const Smooth_surface& s, double ratio, std::vector<double>& sizes)
{
  SMA::apply_gradation(s.execution, s.reference.mesh, s.reference.points, ratio, sizes);
}

void grade(const Smooth_surface& s, double ratio, std::vector<Metric_tensor_3>& tensors)
{
  SMA::apply_gradation(s.execution, s.reference.mesh, s.reference.points, s.reference.normals, ratio, tensors);
}

Metric_tensor_3 as_tensor(double size) { return Metric_tensor_3::isotropic(size); }
Metric_tensor_3 as_tensor(const Metric_tensor_3& m) { return m; }

double diagonal(const std::vector<Vector_3>& points) { return SMA::internal::diagonal_of_bounding_box(points); }

void resize(Places& places, std::size_t n)
{
  places.points.resize(3 * n);
  places.normals.resize(3 * n);
  places.faces.resize(n);
  places.is_on_border.resize(n);
}

/// \throws Invalid_input_error
Index checked(const Index_view& indices, std::size_t i, std::size_t n, const char* what)
{
  const std::int64_t index = indices.at(i, 0);
  if (index < 0 || std::size_t(index) >= n)
    throw SMA::Invalid_input_error(std::string("there is no such ") + what, what, i);
  return Index(index);
}

} // namespace

Jets estimate_jets(const Surface_arrays& input, const Options& options)
{
  Array_surface surface(input);
  Mesh& mesh = surface.mesh;
  using Vector = CGAL::Kernel_traits<Point>::Kernel::Vector_3;
  const auto normals = mesh.add_property_map<Vertex, Vector>("v:normal").first;
  const auto shape_operators = mesh.add_property_map<Vertex, Metric_tensor_3>("v:shape_operator").first;
  SMA::estimate_vertex_jets(
    execution_of(options), mesh,
    feature_parameters(surface, options).vertex_normal_map(normals).vertex_shape_operator_map(shape_operators));
  Jets jets;
  jets.normals.resize(3 * input.points.rows);
  jets.shape_operators.resize(9 * input.points.rows);
  for (const Vertex v : mesh.vertices()) {
    const Vector& n = normals[v];
    put(jets.normals, surface.point_of_vertex[v], Vector_3(n.x(), n.y(), n.z()));
    put(jets.shape_operators, surface.point_of_vertex[v], shape_operators[v]);
  }
  return jets;
}

Hessians estimate_hessians(const Surface_arrays& input, const Options& options, const Array_view<double>& values)
{
  const Smooth_surface surface(input, options);
  const auto& reference = surface.reference;
  std::vector<double> at_vertices(surface.number_of_vertices());
  for (std::size_t v = 0; v < at_vertices.size(); ++v) at_vertices[v] = *values.row(surface.point(v));
  const SMA::Corner_jets jets = SMA::estimate_jets(surface.execution, reference.mesh, reference.points);
  const auto of_sector = [&] {
    try {
      return SMA::estimate_hessians(surface.execution, reference.mesh, reference.points, jets, at_vertices);
    } catch (const SMA::Invalid_field_error& e) {
      throw SMA::Invalid_field_error(surface.point(e.index()));
    }
  }();
  Hessians result;
  result.tensors.resize(9 * input.points.rows);
  result.unexplained.resize(input.points.rows);
  std::vector<double> largest(input.points.rows, -1); // norm at a vertex so far
  for (std::size_t h = 0; h < reference.mesh.number_of_halfedges(); ++h) {
    const auto& hessian = of_sector[jets.of_corner[h]];
    const std::size_t i = surface.point(reference.mesh.source(Index(h)));
    const double norm = hessian.tensor.matrix().norm();
    if (!(norm > largest[i])) continue;
    largest[i] = norm;
    put(result.tensors, i, hessian.tensor);
    result.unexplained[i] = hessian.unexplained;
  }
  return result;
}

std::vector<double> graded(const Surface_arrays& input, const Options& options)
{
  const Smooth_surface surface(input, options);
  return with_metric(surface, options, [&](auto values) {
    grade(surface, options.gradation, values);
    return at_points(surface, options, values);
  });
}

std::vector<double> scaled(const Surface_arrays& input, const Options& options)
{
  const Smooth_surface surface(input, options);
  const auto& reference = surface.reference;
  return with_metric(surface, options, [&](auto values) {
    using Value = typename decltype(values)::value_type;
    const double length = diagonal(reference.points);
    SMA::Scalable_metric metric{std::vector<Metric_tensor_3>(values.size()),
                                SMA::internal::bounds_of_scaled_metric(options.hmin, options.hmax, length),
                                options.gradation > 0 ? options.gradation : 1};
    for (std::size_t v = 0; v < values.size(); ++v) metric.tensors[v] = as_tensor(values[v]);
    return at_points(surface, options,
                     SMA::normalize_to_vertex_count<Value>(surface.execution, reference.mesh, reference.points,
                                                           reference.normals, metric, double(options.vertices)));
  });
}

Metric_size measured(const Surface_arrays& input, const Options& options)
{
  const Smooth_surface surface(input, options);
  const auto& reference = surface.reference;
  return with_metric(surface, options, [&](const auto& values) {
    const SMA::Metric_complexity c =
      SMA::complexity(surface.execution, reference.mesh, reference.points, reference.normals, values);
    return Metric_size{c.area, c.boundary_length,
                       SMA::expected_number_of_vertices(surface.execution, reference.mesh, c)};
  });
}

void check_tensors(const Array_view<double>& tensors)
{
  for (std::size_t i = 0; i < tensors.rows; ++i)
    if (!SMA::is_positive_definite(tensor_of(tensors.row(i)))) throw SMA::Invalid_metric_error(i);
}

std::vector<double> intersected(const Array_view<double>& a, const Array_view<double>& b)
{
  check_tensors(a);
  check_tensors(b);
  std::vector<double> result(9 * a.rows);
  for (std::size_t i = 0; i < a.rows; ++i) put(result, i, SMA::intersection(tensor_of(a.row(i)), tensor_of(b.row(i))));
  return result;
}

std::vector<double> bounded(const Array_view<double>& tensors, double hmin, double hmax)
{
  check_tensors(tensors);
  std::vector<double> result(9 * tensors.rows);
  for (std::size_t i = 0; i < tensors.rows; ++i) {
    SMA::Eigen_decomposition_3 e = SMA::eigen_decomposition(tensor_of(tensors.row(i)));
    for (double& l : e.values) {
      const double size = std::clamp(1 / std::sqrt(l), hmin, hmax);
      l = 1 / (size * size);
    }
    put(result, i, SMA::metric_tensor(e.values, e.vectors));
  }
  return result;
}

Places exponential_map(const Surface_arrays& input, const Options& options, const Index_view& vertices,
                       const Array_view<double>& vectors)
{
  const Smooth_surface surface(input, options);
  const auto& reference = surface.reference;
  std::vector<Index> vertex_of_point(input.points.rows, SMA::no_index);
  for (std::size_t v = 0; v < surface.number_of_vertices(); ++v) vertex_of_point[surface.point(v)] = Index(v);
  Places places;
  resize(places, vectors.rows);
  for (std::size_t i = 0; i < vectors.rows; ++i) {
    const Index v = vertex_of_point[checked(vertices, i, input.points.rows, "vertex")];
    if (v == SMA::no_index) throw SMA::Invalid_input_error("no triangle uses the vertex", "vertex", i);
    const SMA::One_ring ring =
      SMA::one_ring(reference.mesh, reference.mesh.outgoing[v], [&](Index f) { return reference.patch(f); });
    const Vector_3 vector = Eigen::Map<const Vector_3>(vectors.row(i));
    const SMA::Exponential_map_result end =
      SMA::exponential_map(ring, vector - vector.dot(ring.normal()) * ring.normal());
    put(places.points, i, end.point.position);
    put(places.normals, i, end.point.normal);
    places.faces[i] = end.face;
    places.is_on_border[i] = end.is_on_border ? 1 : 0;
  }
  return places;
}

Places surface_points(const Surface_arrays& input, const Options& options, const Index_view& faces,
                      const Array_view<double>& weights)
{
  const Smooth_surface surface(input, options);
  const auto& reference = surface.reference;
  Places places;
  resize(places, weights.rows);
  for (std::size_t i = 0; i < weights.rows; ++i) {
    const Index f = checked(faces, i, reference.mesh.number_of_faces(), "face");
    std::array<double, 3> b{}; // of the corners as the mesh lists them
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        if (surface.point(reference.mesh.corner[3 * std::size_t(f) + k]) == std::size_t(input.triangles.at(f, j)))
          b[k] = weights.row(i)[j];
    const SMA::Surface_point p = reference.evaluate({SMA::Vertex_class::smooth, f, b[1], b[2]});
    put(places.points, i, p.position);
    put(places.normals, i, p.normal);
    places.faces[i] = f;
  }
  return places;
}

} // namespace sma_python

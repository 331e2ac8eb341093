// SPDX-License-Identifier: GPL-3.0-or-later
//
// The functions of the library as the options ask for them, with a `Reconstruction` between the vertices of the input.

#ifndef SMA_PYTHON_RUN_ON_H
#define SMA_PYTHON_RUN_ON_H

#include "Array_surface.h"
#include "Chosen_field.h"
#include "Sources.h"
#include "adaptation.h"
#include "execution.h"

#include <CGAL/surface_mesh_adaptation.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace sma_python {

using Vector = CGAL::Kernel_traits<Point>::Kernel::Vector_3;

/// Hands on what a run tells, to where nothing is compiled for each kind of run.
struct Teller
{
  Events& events;

  void round_begins(std::size_t round, std::size_t rounds) { events.round_begins(round, rounds); }
  void kernel_done(const SMA::Kernel_report& kernel) { events.kernel_done(kernel); }
  void round_done(std::size_t round, const SMA::Mesh_statistics& mesh) { events.round_done(round, mesh); }
  bool go_on() { return events.go_on(); }
};

inline double diagonal(const Mesh& mesh)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::sqrt(CGAL::square(box.x_span()) + CGAL::square(box.y_span()) + CGAL::square(box.z_span()));
}

/// One run, from arrays to arrays.
template <class Reconstruction>
class Run
{
public:
  Run(const Surface_arrays& arrays, const Options& options, Events& events)
    : input_(arrays),
      options_(options),
      teller_{events},
      surface_(arrays),
      sources_(surface_.mesh.add_property_map<Vertex, Source>("v:source").first),
      metric_(surface_.mesh.add_property_map<Vertex, SMA::Metric_tensor_3>("v:metric", unknown_metric()).first),
      origin_(surface_.mesh.add_property_map<Vertex, Vertex>("v:origin").first)
  {
    for (const Vertex v : surface_.mesh.vertices()) {
      sources_[v] = Source(surface_.point_of_vertex[v]);
      origin_[v] = v; // of those that are not looked at
    }
    for (const Face f : surface_.mesh.faces())
      if (!arrays.selected_faces.empty() && is_selected(f)) selected_.push_back(f);
    if (options.wants_face_origin) number_triangles();
  }

  Outcome operator()(const std::string& kernel)
  {
    constexpr double none = std::numeric_limits<double>::infinity();
    const Chosen_field field = chosen_field(options_, surface_, options_.tolerance > 0 ? options_.tolerance : none);
    const double tolerance = options_.tolerance > 0 ? options_.tolerance * diagonal(surface_.mesh) : none;
    const auto parameters = SMA::parameters::detect_features(options_.detect_features)
                              .feature_angle(given(options_.feature_angle, SMA::Feature_parameters().ridge_angle))
                              .smooth_borders(options_.smooth_borders)
                              .edge_is_constrained_map(surface_.edge_is_constrained)
                              .vertex_is_constrained_map(surface_.vertex_is_constrained)
                              .edge_is_protected_map(surface_.edge_is_protected)
                              .protected_gradation(protected_gradation())
                              .face_patch_map(surface_.label)
                              .face_size_bounds_map(surface_.size_bounds)
                              .vertex_attribute_maps(std::make_tuple(sources_))
                              .face_attribute_maps(face_maps_)
                              .halfedge_attribute_maps(surface_.at_corners)
                              .vertex_origin_map(origin_)
                              .maximum_number_of_vertices(options_.max_vertices)
                              .output_metric_map(metric_)
                              .tolerance(tolerance)
                              .surface_reconstruction(Reconstruction())
                              .fit_to_surface(options_.fit)
                              .avoid_self_intersections(options_.avoid_self_intersections)
                              .count_self_intersections(options_.count_self_intersections)
                              .shape_weight_of_fit(given(options_.shape_weight, SMA::default_shape_weight))
                              .visitor(std::ref(teller_));
    const auto start = std::chrono::steady_clock::now();
    with_jets(parameters, [&](const auto& np) { with_input_numbers([&] { run(kernel, field, np); }); });
    outcome_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write();
    return std::move(outcome_);
  }

private:
  static SMA::Metric_tensor_3 unknown_metric() { return {0, 0, 0, 0, 0, 0}; }
  static double given(double value, double by_default) { return value > 0 ? value : by_default; }

  double protected_gradation() const
  {
    return options_.protected_gradation >= 0 ? options_.protected_gradation : SMA::default_gradation;
  }

  bool is_selected(Face f) const
  {
    const std::size_t t = surface_.triangle_of_face[f];
    return t != SMA::Repair_report::none && input_.selected_faces.data[t] != 0;
  }

  /// Numbers are carried as other values are: exactly, as they are those of one face each.
  void number_triangles()
  {
    face_maps_.push_back(surface_.mesh.template add_property_map<Face, double>("f:origin", -1).first);
    for (const Face f : surface_.mesh.faces()) {
      const std::size_t t = surface_.triangle_of_face[f];
      if (t != SMA::Repair_report::none) face_maps_[0][f] = double(t);
    }
  }

  /// `call(mesh)`, or `call(faces, mesh)` where only these are to be adapted.
  template <class Call>
  auto on_mesh(const Call& call)
  {
    return input_.selected_faces.empty() ? call(surface_.mesh) : call(selected_, surface_.mesh);
  }

  // normals and shape operators

  /// Calls `use` with the normals and shape operators among the parameters, if any are given; those that are not are
  /// estimated.
  template <class NamedParameters, class Use>
  void with_jets(const NamedParameters& parameters, const Use& use)
  {
    if (options_.normals.empty() && options_.shape_operators.empty()) return use(parameters);
    normals_ = surface_.mesh.template add_property_map<Vertex, Vector>("v:normal").first;
    shape_operators_ = surface_.mesh.template add_property_map<Vertex, SMA::Metric_tensor_3>("v:shape_operator").first;
    const auto np = parameters.vertex_normal_map(normals_).vertex_shape_operator_map(shape_operators_);
    if (options_.normals.empty() || options_.shape_operators.empty()) estimate(np);
    read_jets();
    use(np);
  }

  template <class NamedParameters>
  void estimate(const NamedParameters& np)
  {
    with_execution(options_.execution,
                   [&](const auto& execution) { SMA::estimate_vertex_jets(execution, surface_.mesh, np); });
  }

  void read_jets()
  {
    for (const Vertex v : surface_.mesh.vertices()) {
      const std::size_t i = surface_.point_of_vertex[v];
      if (!options_.normals.empty()) {
        const double* const n = options_.normals.row(i);
        normals_[v] = Vector(n[0], n[1], n[2]);
      }
      if (!options_.shape_operators.empty()) shape_operators_[v] = tensor_of(options_.shape_operators.row(i));
    }
  }

  // the library

  /// Errors that name a vertex name its point.
  template <class Use>
  void with_input_numbers(const Use& use) const
  {
    const auto point = [&](const SMA::Invalid_input_error& e) { return surface_.point_of_vertex[e.index()]; };
    try {
      use();
    } catch (const SMA::Invalid_metric_error& e) {
      throw SMA::Invalid_metric_error(point(e));
    } catch (const SMA::Invalid_field_error& e) {
      throw SMA::Invalid_field_error(point(e));
    } catch (const SMA::Invalid_normal_error& e) {
      throw SMA::Invalid_normal_error(point(e));
    } catch (const SMA::Non_simplicial_edge_error& e) {
      throw SMA::Non_simplicial_edge_error(point(e));
    } catch (const SMA::Non_manifold_vertex_error& e) {
      throw SMA::Non_manifold_vertex_error(point(e));
    }
  }

  template <class NamedParameters>
  void run(const std::string& kernel, const Chosen_field& field, const NamedParameters& np)
  {
    if (kernel == "adapt") adapt(field, np.number_of_iterations(iterations(SMA::default_number_of_rounds)));
    else
      with_execution(options_.execution, [&](const auto& execution) {
        outcome_.operations = run_alone(SMA::internal::Any_execution(execution), kernel, field, np);
      });
  }

  unsigned iterations(unsigned by_default) const { return options_.iterations.value_or(by_default); }

  template <class NamedParameters>
  void adapt(const Chosen_field& field, const NamedParameters& np)
  {
    const SMA::Adaptation_report report = with_execution(options_.execution, [&](const auto& execution) {
      return on_mesh([&](auto&... what) { return SMA::adapt_surface_mesh(execution, what..., field, np); });
    });
    std::ostringstream json;
    json.precision(std::numeric_limits<double>::max_digits10);
    report.write_json(json);
    outcome_.report = json.str();
  }

  template <class Execution, class NamedParameters>
  std::size_t run_alone(const Execution& execution, const std::string& kernel, const Chosen_field& field,
                        const NamedParameters& parameters)
  {
    constexpr unsigned sweeps = 24, moves = 10;
    const auto np = parameters.number_of_iterations(iterations(kernel == "relocate" ? moves : sweeps));
    if (kernel == "refine") return on_mesh([&](auto&... what) { return SMA::refine(execution, what..., field, np); });
    if (kernel == "swap") return on_mesh([&](auto&... what) { return SMA::swap(execution, what..., field, np); });
    if (kernel == "regularize")
      return on_mesh([&](auto&... what) { return SMA::regularize(execution, what..., field, np); });
    const double deviation = given(options_.max_normal_deviation, 180);
    if (kernel == "relocate") {
      const auto limited = np.maximum_normal_deviation(deviation);
      return on_mesh([&](auto&... what) { return SMA::relocate(execution, what..., field, limited); });
    }
    if (!(options_.max_normal_deviation > 0 || options_.max_distance > 0))
      return on_mesh([&](auto&... what) { return SMA::simplify(execution, what..., field, np); });
    const auto limits = parameters.maximum_normal_deviation(deviation)
                          .maximum_distance(given(options_.max_distance, std::numeric_limits<double>::infinity()))
                          .number_of_iterations(iterations((std::numeric_limits<unsigned>::max)()));
    return on_mesh([&](auto&... what) { return SMA::simplify(execution, what..., field, limits); });
  }

  // the result

  void write()
  {
    surface_.mesh.collect_garbage(); // of a selection
    outcome_.repairs = std::move(surface_.repairs);
    outcome_.warnings = std::move(surface_.warnings);
    write_faces();
    write_vertices();
    if (normals_) write_jets();
    for (const Edge e : surface_.mesh.edges()) {
      if (surface_.edge_is_constrained[e]) append_edge(e, outcome_.feature_edges);
      if (surface_.edge_is_protected[e]) append_edge(e, outcome_.protected_edges);
    }
  }

  void append_edge(Edge e, std::vector<std::int64_t>& edges) const
  {
    for (int i = 0; i < 2; ++i) edges.push_back(std::int64_t(surface_.mesh.vertex(e, unsigned(i))));
  }

  void write_faces()
  {
    input_.poll();
    const Mesh& mesh = surface_.mesh;
    outcome_.triangles.reserve(3 * std::size_t(mesh.number_of_faces()));
    for (const auto f : mesh.faces())
      for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) outcome_.triangles.push_back(std::int64_t(v));
    if (!input_.labels.empty())
      for (const Face f : mesh.faces()) outcome_.labels.push_back(surface_.label[f]);
    if (!face_maps_.empty())
      for (const Face f : mesh.faces()) outcome_.face_origin.push_back(std::int64_t(face_maps_[0][f]));
    if (surface_.at_corners.empty()) return;
    for (const Face f : mesh.faces()) // in the order of the triangles' corners
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
        for (const auto& map : surface_.at_corners) outcome_.corner_values.push_back(map[h]);
  }

  void write_vertices()
  {
    input_.poll();
    const std::size_t n = surface_.mesh.number_of_vertices();
    outcome_.points.reserve(3 * n);
    outcome_.metric.reserve(9 * n);
    outcome_.source_points.reserve(3 * n);
    outcome_.source_weights.reserve(3 * n);
    for (const Vertex v : surface_.mesh.vertices()) {
      const Point& p = surface_.mesh.point(v);
      outcome_.points.insert(outcome_.points.end(), {p.x(), p.y(), p.z()});
      append(outcome_.metric, metric_[v]);
      const Source& s = sources_[v];
      outcome_.source_points.insert(outcome_.source_points.end(), s.points.begin(), s.points.end());
      outcome_.source_weights.insert(outcome_.source_weights.end(), s.weights.begin(), s.weights.end());
      const bool is_old = origin_[v] != Mesh::null_vertex();
      outcome_.vertex_origin.push_back(is_old ? std::int64_t(surface_.point_of_vertex[origin_[v]]) : -1);
      if (surface_.vertex_is_constrained[v]) outcome_.constrained_vertices.push_back(std::int64_t(v));
    }
  }

  void write_jets()
  {
    for (const Vertex v : surface_.mesh.vertices()) {
      const Vector& n = normals_[v];
      outcome_.normals.insert(outcome_.normals.end(), {n.x(), n.y(), n.z()});
      append(outcome_.shape_operators, shape_operators_[v]);
    }
  }

  const Surface_arrays& input_;
  const Options& options_;
  Teller teller_;
  Array_surface surface_;
  Mesh::Property_map<Vertex, Source> sources_;
  Mesh::Property_map<Vertex, SMA::Metric_tensor_3> metric_;
  Mesh::Property_map<Vertex, Vertex> origin_;
  std::vector<Mesh::Property_map<Face, double>> face_maps_; // the numbers of triangles, if they are wanted
  std::vector<Face> selected_;
  Mesh::Property_map<Vertex, Vector> normals_;
  Mesh::Property_map<Vertex, SMA::Metric_tensor_3> shape_operators_;
  Outcome outcome_;
};

} // namespace sma_python

#endif // SMA_PYTHON_RUN_ON_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extension module: arrays of NumPy in, arrays of NumPy out. What users see, and checks of what they give, are in
// Python.

#include "Python_events.h"
#include "adaptation.h"
#include "errors.h"
#include "tools.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace sma_python {

namespace {

template <class T>
using Input_array = nb::ndarray<const T, nb::c_contig, nb::device::cpu>;

template <class T>
Array_view<T> view(nb::handle array)
{
  const auto a = nb::cast<Input_array<T>>(array, false);
  const std::size_t rows = a.shape(0);
  return {a.data(), rows, rows > 0 ? a.size() / rows : 1};
}

Index_view index_view(nb::handle array)
{
  Index_view result;
  if (nb::isinstance<Input_array<std::int32_t>>(array)) result.narrow = view<std::int32_t>(array);
  else result.wide = view<std::int64_t>(array);
  return result;
}

/// Reads what a dictionary has; the rest keeps its defaults. The arrays stay those of the dictionary.
class Reader
{
public:
  explicit Reader(const nb::dict& from) : from_(from) {}

  template <class T>
  Reader& operator()(const char* key, T& value)
  {
    if (from_.contains(key)) value = nb::cast<T>(from_[key]);
    return *this;
  }

  template <class T>
  Reader& operator()(const char* key, Array_view<T>& value)
  {
    if (from_.contains(key)) value = view<T>(from_[key]);
    return *this;
  }

  Reader& operator()(const char* key, Index_view& value)
  {
    if (from_.contains(key)) value = index_view(from_[key]);
    return *this;
  }

private:
  const nb::dict& from_;
};

Surface_arrays surface_of(const nb::dict& from)
{
  Surface_arrays s;
  Reader read(from);
  read("points", s.points)("triangles", s.triangles)("weld", s.weld)("repair", s.repair);
  read("constrained_vertices", s.constrained_vertices)("constrained_edges", s.constrained_edges);
  read("protected_edges", s.protected_edges)("protected_faces", s.protected_faces);
  read("selected_faces", s.selected_faces)("labels", s.labels)("size_bounds", s.size_bounds);
  read("corner_values", s.corner_values);
  return s;
}

Options options_of(const nb::dict& from)
{
  Options o;
  Reader read(from);
  read("execution", o.execution.name)("threads", o.execution.threads);
  read("size", o.size)("curvature", o.curvature)("sizes", o.sizes)("tensors", o.tensors)("field", o.field);
  read("vertices", o.vertices)("anisotropic", o.anisotropic)("max_anisotropy", o.max_anisotropy)("noisy", o.noisy);
  read("norm", o.norm)("gradation", o.gradation)("hmin", o.hmin)("hmax", o.hmax);
  read("detect_features", o.detect_features)("feature_angle", o.feature_angle)("smooth_borders", o.smooth_borders);
  read("flat", o.flat)("fit", o.fit)("avoid_self_intersections", o.avoid_self_intersections)(
    "count_self_intersections", o.count_self_intersections)("shape_weight", o.shape_weight)("tolerance", o.tolerance);
  read("protected_gradation", o.protected_gradation)("wants_face_origin", o.wants_face_origin);
  read("normals", o.normals)("shape_operators", o.shape_operators);
  read("max_vertices", o.max_vertices)("max_normal_deviation", o.max_normal_deviation)("max_distance", o.max_distance);
  if (from.contains("iterations")) o.iterations = nb::cast<unsigned>(from["iterations"]);
  return o;
}

/// The values as an array of NumPy that owns them; `shape` without the number of rows.
template <class T>
nb::object array(std::vector<T>&& values, std::initializer_list<std::size_t> shape = {})
{
  auto* const owned = new std::vector<T>(std::move(values));
  const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  std::size_t length = 1;
  for (const std::size_t s : shape) length *= s;
  std::vector<std::size_t> sizes{owned->size() / length};
  sizes.insert(sizes.end(), shape);
  return nb::cast(nb::ndarray<nb::numpy, T>(owned->data(), sizes.size(), sizes.data(), owner));
}

nb::dict dictionary(Outcome&& o)
{
  nb::dict result;
  result["points"] = array(std::move(o.points), {3});
  result["triangles"] = array(std::move(o.triangles), {3});
  result["metric"] = array(std::move(o.metric), {3, 3});
  result["source_points"] = array(std::move(o.source_points), {3});
  result["source_weights"] = array(std::move(o.source_weights), {3});
  result["feature_edges"] = array(std::move(o.feature_edges), {2});
  result["protected_edges"] = array(std::move(o.protected_edges), {2});
  result["vertex_origin"] = array(std::move(o.vertex_origin));
  result["face_origin"] = array(std::move(o.face_origin));
  result["labels"] = array(std::move(o.labels));
  result["corner_values"] = array(std::move(o.corner_values));
  result["constrained_vertices"] = array(std::move(o.constrained_vertices));
  if (!o.normals.empty()) result["normals"] = array(std::move(o.normals), {3});
  if (!o.shape_operators.empty()) result["shape_operators"] = array(std::move(o.shape_operators), {3, 3});
  result["repairs"] = nb::cast(o.repairs);
  result["warnings"] = nb::cast(o.warnings);
  result["report"] = o.report;
  result["operations"] = o.operations;
  result["seconds"] = o.seconds;
  return result;
}

nb::dict run(const std::string& kernel, const nb::dict& request, nb::object callback)
{
  Surface_arrays surface = surface_of(request);
  const Options options = options_of(request);
  Python_events events(std::move(callback));
  surface.poll = [&] { events.poll(); };
  Outcome outcome;
  try {
    const nb::gil_scoped_release no_gil;
    outcome = (options.flat ? run_on_triangles : run_on_patches)(kernel, surface, options, events);
  } catch (const Cancelled&) {
    events.raise();
  }
  return dictionary(std::move(outcome));
}

/// `tool(surface, options, arrays...)`, without the GIL.
template <class Tool, class... Arrays>
auto without_gil(const Tool& tool, const nb::dict& request, const Arrays&... arrays)
{
  const Surface_arrays surface = surface_of(request);
  const Options options = options_of(request);
  const nb::gil_scoped_release no_gil;
  return tool(surface, options, arrays...);
}

/// As many numbers for each point as the metric of the request has.
nb::object metric_array(const nb::dict& request, std::vector<double>&& values)
{
  return request.contains("tensors") ? array(std::move(values), {3, 3}) : array(std::move(values));
}

nb::tuple tuple(Places&& places)
{
  return nb::make_tuple(array(std::move(places.points), {3}), array(std::move(places.normals), {3}),
                        array(std::move(places.faces)), array(std::move(places.is_on_border)));
}

void define_tools(nb::module_& m)
{
  m.def("estimate_jets", [](const nb::dict& request) {
    Jets jets = without_gil(estimate_jets, request);
    return nb::make_tuple(array(std::move(jets.normals), {3}), array(std::move(jets.shape_operators), {3, 3}));
  });
  m.def("estimate_hessians", [](const nb::dict& request, nb::handle values) {
    Hessians hessians = without_gil(estimate_hessians, request, view<double>(values));
    return nb::make_tuple(array(std::move(hessians.tensors), {3, 3}), array(std::move(hessians.unexplained)));
  });
  m.def("graded", [](const nb::dict& request) { return metric_array(request, without_gil(graded, request)); });
  m.def("scaled", [](const nb::dict& request) { return metric_array(request, without_gil(scaled, request)); });
  m.def("measured", [](const nb::dict& request) {
    const Metric_size size = without_gil(measured, request);
    return nb::make_tuple(size.area, size.boundary_length, size.vertices);
  });
  m.def("intersected", [](nb::handle a, nb::handle b) {
    return array(intersected(view<double>(a), view<double>(b)), {3, 3});
  });
  m.def("bounded", [](nb::handle tensors, double hmin, double hmax) {
    return array(bounded(view<double>(tensors), hmin, hmax), {3, 3});
  });
  m.def("check_tensors", [](nb::handle tensors) { check_tensors(view<double>(tensors)); });
  m.def("exponential_map", [](const nb::dict& request, nb::handle vertices, nb::handle vectors) {
    return tuple(without_gil(exponential_map, request, index_view(vertices), view<double>(vectors)));
  });
  m.def("surface_points", [](const nb::dict& request, nb::handle faces, nb::handle weights) {
    return tuple(without_gil(surface_points, request, index_view(faces), view<double>(weights)));
  });
}

} // namespace

} // namespace sma_python

NB_MODULE(_core, m)
{
  using namespace sma_python;
  translate_errors();
  m.def("run", &run, nb::arg("kernel"), nb::arg("request"), nb::arg("callback").none());
  define_tools(m);
#ifdef CGAL_LINKED_WITH_TBB
  m.attr("has_tbb") = true;
#else
  m.attr("has_tbb") = false;
#endif
#ifdef _OPENMP
  m.attr("has_openmp") = true;
#else
  m.attr("has_openmp") = false;
#endif
}

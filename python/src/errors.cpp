// SPDX-License-Identifier: GPL-3.0-or-later

#include "errors.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <nanobind/nanobind.h>

#include <exception>

namespace sma_python {

namespace {

namespace nb = nanobind;
namespace SMA = CGAL::Surface_mesh_adaptation;

/// An exception of the class `name`, to be given attributes.
nb::object exception(const char* name, const std::exception& e)
{
  return nb::module_::import_("surface_mesh_adaptation.errors").attr(name)(e.what());
}

void raise(const nb::object& exception) { PyErr_SetObject(exception.type().ptr(), exception.ptr()); }

void raise_with_index(const char* name, const SMA::Invalid_input_error& e)
{
  nb::object error = exception(name, e);
  error.attr("index") = e.index();
  raise(error);
}

void translate(const std::exception_ptr& thrown, void*)
{
  try {
    std::rethrow_exception(thrown);
  }
#define SMA_PYTHON_INVALID_INPUT(NAME)                                                                                 \
  catch (const SMA::NAME& e) { raise_with_index(#NAME, e); }
  SMA_PYTHON_INVALID_INPUT(Non_triangular_face_error)
  SMA_PYTHON_INVALID_INPUT(Non_manifold_vertex_error)
  SMA_PYTHON_INVALID_INPUT(Non_simplicial_edge_error)
  SMA_PYTHON_INVALID_INPUT(Non_finite_coordinate_error)
  SMA_PYTHON_INVALID_INPUT(Invalid_metric_error)
  SMA_PYTHON_INVALID_INPUT(Invalid_field_error)
  SMA_PYTHON_INVALID_INPUT(Invalid_normal_error)
  SMA_PYTHON_INVALID_INPUT(Invalid_input_error)
#undef SMA_PYTHON_INVALID_INPUT
  catch (const SMA::Tolerance_error& e)
  {
    nb::object error = exception("Tolerance_error", e);
    error.attr("distance") = e.distance();
    error.attr("tolerance") = e.tolerance();
    raise(error);
  }
  catch (const SMA::Self_intersection_error& e)
  {
    nb::object error = exception("Self_intersection_error", e);
    error.attr("pairs") = e.pairs();
    raise(error);
  }
  catch (const SMA::Mesh_too_large_error& e)
  {
    nb::object error = exception("Mesh_too_large_error", e);
    error.attr("vertices") = e.estimate().vertices;
    error.attr("largest") = e.estimate().largest;
    raise(error);
  }
  catch (const SMA::Invalid_extent_error& e)
  {
    nb::object error = exception("Invalid_extent_error", e);
    error.attr("extent") = e.extent();
    raise(error);
  }
  catch (const SMA::Empty_mesh_error& e) { raise(exception("Empty_mesh_error", e)); }
  catch (const SMA::Invalid_parameter_error& e) { raise(exception("Invalid_parameter_error", e)); }
  catch (const SMA::Adaptation_error& e) { raise(exception("Adaptation_error", e)); }
}

} // namespace

void translate_errors() { nb::register_exception_translator(translate); }

} // namespace sma_python

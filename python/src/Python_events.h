// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SMA_PYTHON_PYTHON_EVENTS_H
#define SMA_PYTHON_PYTHON_EVENTS_H

#include "adaptation.h"

#include <nanobind/nanobind.h>

#include <cstddef>
#include <optional>
#include <utility>

namespace sma_python {

namespace nb = nanobind;

/// Tells a callable of Python how far a run is, and stops the run when that returns False, when it raises an exception,
/// or at a signal. Takes the GIL for as long as that needs.
class Python_events : public Events
{
public:
  /// \param callback a callable, called with keyword arguments, or None
  explicit Python_events(nb::object callback) : callback_(std::move(callback)) {}

  void round_begins(std::size_t round, std::size_t rounds) override
  {
    rounds_ = rounds;
    round_ = round;
    const nb::gil_scoped_acquire gil;
    tell("round begins", nb::dict());
  }

  void kernel_done(const CGAL::Surface_mesh_adaptation::Kernel_report& kernel) override
  {
    const nb::gil_scoped_acquire gil;
    nb::dict what;
    what["kernel"] = kernel.kernel.c_str();
    what["applied"] = kernel.applied;
    tell("kernel", what);
  }

  void round_done(std::size_t round, const CGAL::Surface_mesh_adaptation::Mesh_statistics& mesh) override
  {
    round_ = round;
    const nb::gil_scoped_acquire gil;
    nb::dict what;
    what["vertices"] = mesh.vertices;
    what["in_range"] = mesh.in_range;
    what["quality"] = mesh.mean_quality;
    tell("round", what);
  }

  bool go_on() override
  {
    if (is_stopped_) return false;
    const nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) fail(nb::python_error());
    else tell("working", nb::dict());
    return !is_stopped_;
  }

  /// Raises what the callable or a signal raised, if anything. To be called with the GIL.
  void raise()
  {
    if (error_) throw nb::python_error(std::move(*error_));
  }

private:
  void fail(nb::python_error&& error)
  {
    error_.emplace(std::move(error));
    is_stopped_ = true;
  }

  void tell(const char* event, const nb::dict& what)
  {
    if (callback_.is_none() || is_stopped_) return;
    what["event"] = event;
    what["round"] = round_;
    what["rounds"] = rounds_;
    try {
      is_stopped_ = callback_(**what).is(nb::handle(Py_False));
    } catch (nb::python_error& error) {
      fail(std::move(error));
    }
  }

  nb::object callback_;
  std::optional<nb::python_error> error_;
  std::size_t round_ = 0, rounds_ = 0;
  bool is_stopped_ = false;
};

} // namespace sma_python

#endif // SMA_PYTHON_PYTHON_EVENTS_H

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

/// Tells a callable of Python how far a run is, and stops the run when that returns False; gives it up when that raises
/// an exception, or a signal does. Takes the GIL for as long as that needs.
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
    check_signals();
    tell("working", nb::dict());
    return !is_stopped_;
  }

  /// \throws Cancelled
  void poll()
  {
    const nb::gil_scoped_acquire gil;
    check_signals();
  }

  /// Raises what the callable or a signal raised. To be called with the GIL. \pre `Cancelled` was thrown
  [[noreturn]] void raise() { throw nb::python_error(std::move(*error_)); }

private:
  void check_signals()
  {
    if (PyErr_CheckSignals() != 0) give_up(nb::python_error());
  }

  [[noreturn]] void give_up(nb::python_error&& error)
  {
    error_.emplace(std::move(error));
    throw Cancelled();
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
      give_up(std::move(error));
    }
  }

  nb::object callback_;
  std::optional<nb::python_error> error_;
  std::size_t round_ = 0, rounds_ = 0;
  bool is_stopped_ = false;
};

} // namespace sma_python

#endif // SMA_PYTHON_PYTHON_EVENTS_H

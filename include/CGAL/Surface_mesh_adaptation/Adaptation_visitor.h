// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_ADAPTATION_VISITOR_H
#define CGAL_SURFACE_MESH_ADAPTATION_ADAPTATION_VISITOR_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationReports
/// @{

/// Follows a run, and can stop it; derive from it and redefine what is wanted, nothing is virtual. All calls come from
/// the thread that called `adapt_surface_mesh`, between sweeps.
/// \cgalModels{AdaptationVisitor}
struct Adaptation_visitor
{
  /// Round `round` (from 0) of at most `rounds` begins.
  void round_begins(std::size_t /*round*/, std::size_t /*rounds*/) {}
  /// A kernel has done its sweeps of this round.
  void kernel_done(const Kernel_report&) {}
  /// The round is over.
  void round_done(std::size_t /*round*/, const Mesh_statistics&) {}
  /// Asked after every kernel, where a kernel runs alone after every sweep, and in whatever takes longer about every
  /// twentieth of a second. `false` ends the run, at once, with the valid mesh reached so far: the input, where no
  /// kernel has begun.
  bool go_on() { return true; }
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_ADAPTATION_VISITOR_H

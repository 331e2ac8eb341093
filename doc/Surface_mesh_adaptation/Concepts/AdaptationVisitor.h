// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgSurfaceMeshAdaptationConcepts
\cgalConcept

Follows a run. All functions are called from the thread that called the adaptation, between sweeps. An exception thrown
by a visitor leaves the adaptation, and the mesh as it was.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Surface_mesh_adaptation::Adaptation_visitor}
\cgalHasModelsEnd
*/
class AdaptationVisitor
{
public:
  /// Round `round` (from 0) of at most `rounds` begins.
  void round_begins(std::size_t round, std::size_t rounds);

  /// A kernel has done its sweeps; `report` sums up all of its sweeps in this round so far.
  void kernel_done(const Kernel_report& report);

  /// The round is over, and the mesh is now as `statistics` says.
  void round_done(std::size_t round, const Mesh_statistics& statistics);

  /// Asked after every kernel: `false` ends the run with the valid mesh reached so far. Of a visitor of `refine()`,
  /// `simplify()`, `swap()` and `relocate()` nothing else is called, after every sweep.
  bool go_on();
};

// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgSurfaceMeshAdaptationConcepts
\cgalConcept

Runs independent tasks. Every algorithm of the package is written over `run`, with a number of tasks that does not
depend on `concurrency()`; hence all models give the same results.

\cgalRefines{CopyConstructible}

\cgalHasModelsBegin
\cgalHasModels{CGAL::Surface_mesh_adaptation::Sequential_execution}
\cgalHasModels{CGAL::Surface_mesh_adaptation::TBB_execution}
\cgalHasModels{CGAL::Surface_mesh_adaptation::OpenMP_execution}
\cgalHasModelsEnd
*/
class AdaptationExecution
{
public:
  /// Name for reports.
  static constexpr const char* name;

  /// The largest number of tasks that may run at the same time.
  int concurrency() const;

  /// Calls `task(i)` once for every `i` in `[0, number_of_tasks)`, in any order and from any thread, and returns when
  /// all calls have returned. An exception thrown by a task leaves `run`.
  template <class Task>
  void run(std::size_t number_of_tasks, const Task& task) const;
};

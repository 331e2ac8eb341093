// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_EXECUTION_H
#define ADAPT_MESH_EXECUTION_H

#include "options.h"

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>

#include <string>

namespace adapt_mesh {

/// Returns `use(execution)` for the policy that the options ask for. \throws Usage_error if it was not built in
template <class Use>
auto with_execution(const Options& options, const Use& use)
{
  namespace SMA = CGAL::Surface_mesh_adaptation;
  const std::string& which = options.execution;
  const bool any_parallel = which.empty() && options.threads != 1;
  if (which == "sequential") return use(SMA::Sequential_execution());
#ifdef CGAL_LINKED_WITH_TBB
  if (which == "tbb" || any_parallel) return use(SMA::TBB_execution(options.threads));
#endif
#ifdef _OPENMP
  if (which == "openmp" || any_parallel) return use(SMA::OpenMP_execution(options.threads));
#endif
  if (which.empty() && options.threads <= 1) return use(SMA::Sequential_execution());
  if (which.empty()) throw Usage_error("--threads needs a parallel execution, and none was built in");
  if (which == "tbb" || which == "openmp") throw Usage_error("--execution " + which + " was not built in");
  throw Usage_error("--execution must be sequential, tbb or openmp");
}

/// \throws Usage_error if the policy that the options ask for was not built in
inline void check_execution(const Options& options)
{
  with_execution(options, [](const auto&) {});
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_EXECUTION_H

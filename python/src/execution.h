// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SMA_PYTHON_EXECUTION_H
#define SMA_PYTHON_EXECUTION_H

#include "adaptation.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>

#include <string>

namespace sma_python {

/// Returns `use(execution)` for the policy that is chosen.
/// \throws Invalid_parameter_error if it was not built in
template <class Use>
auto with_execution(const Execution_choice& choice, const Use& use)
{
  namespace SMA = CGAL::Surface_mesh_adaptation;
  const bool any_parallel = choice.name.empty() && choice.threads != 1;
  if (choice.name == "sequential") return use(SMA::Sequential_execution());
#ifdef CGAL_LINKED_WITH_TBB
  if (choice.name == "tbb" || any_parallel) return use(SMA::TBB_execution(choice.threads));
#endif
#ifdef _OPENMP
  if (choice.name == "openmp" || any_parallel) return use(SMA::OpenMP_execution(choice.threads));
#endif
  if (choice.name.empty()) return use(SMA::Sequential_execution());
  throw SMA::Invalid_parameter_error("the execution '" + choice.name + "' was not built in");
}

} // namespace sma_python

#endif // SMA_PYTHON_EXECUTION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every execution policy that was built in, with few and many threads.

#ifndef TEST_SURFACE_MESH_ADAPTATION_POLICIES_H
#define TEST_SURFACE_MESH_ADAPTATION_POLICIES_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>

#include <string>

/// Calls `f(execution, name)` for each policy; the first is sequential.
template <class F>
void for_each_policy(const F& f)
{
  namespace SMA = CGAL::Surface_mesh_adaptation;
  f(SMA::Sequential_execution(), std::string("sequential"));
  for (const int threads : {1, 2, 3, 8}) {
    const std::string with = " with " + std::to_string(threads) + " threads";
    static_cast<void>(with); // unused if nothing parallel was built in
#ifdef CGAL_LINKED_WITH_TBB
    f(SMA::TBB_execution(threads), "TBB" + with);
#endif
#ifdef _OPENMP
    f(SMA::OpenMP_execution(threads), "OpenMP" + with);
#endif
  }
}

#endif // TEST_SURFACE_MESH_ADAPTATION_POLICIES_H

# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the library needs; used by the project itself and by its installed package.

# CGAL warns about the build type of whoever includes it, which is not its business here.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL REQUIRED)
find_package(Eigen3 3.3 REQUIRED)
include(CGAL_Eigen3_support)

# Sets `variable` to the targets of the parallel back ends that are wanted and found.
function(sma_parallel_libraries variable)
  set(libraries)
  if(SMA_WITH_TBB)
    find_package(TBB CONFIG QUIET)
    include(CGAL_TBB_support)
    if(TARGET CGAL::TBB_support)
      list(APPEND libraries CGAL::TBB_support)
    endif()
  endif()
  if(SMA_WITH_OPENMP)
    find_package(OpenMP QUIET COMPONENTS CXX)
    if(TARGET OpenMP::OpenMP_CXX)
      list(APPEND libraries OpenMP::OpenMP_CXX)
    endif()
  endif()
  set(${variable} "${libraries}" PARENT_SCOPE)
endfunction()

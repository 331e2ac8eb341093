// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels share: which vertices have something left to examine, and where that ends.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_COMMON_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_COMMON_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <boost/atomic/atomic_ref.hpp>

#include <algorithm>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// A bit for each kernel in `Adapted_surface::active`: whether it has to look at the vertex again.
enum class Activity : std::uint8_t { simplify = 1, swap = 2, relocate = 4, regularize = 8, refine = 16 };

/// Passes of claims at the borders of blocks; what is left then is examined by the next sweep.
constexpr std::uint32_t max_border_rounds = 8;

/// Swaps leave alone an edge between two faces of at least this quality: its other diagonal makes two bad ones.
constexpr double max_improvable_quality = 0.9;

/// Length of edges in an anisotropic metric up to which collapses and swaps may make them too long, if they gain enough
/// by that: moves or splits mend it.
constexpr double max_length_in_between = 2;

template <class Surface>
bool is_active(const Surface& surface, Index v, Activity kernel)
{
  return (surface.active[v] & std::uint8_t(kernel)) != 0;
}

constexpr std::uint8_t all_kernels = 0xff;

/// Something changed at `v`: the kernels have to look again. Tasks of one sweep may share `v`: the bits add up.
template <class Surface>
void activate(Surface& surface, Index v, std::uint8_t kernels = all_kernels)
{
  boost::atomic_ref<std::uint8_t> bits(surface.active[v]);
  if ((bits.load(boost::memory_order_relaxed) & kernels) != kernels)
    bits.fetch_or(kernels, boost::memory_order_relaxed);
}

/// `kernel` looked at `v` and left it. \pre no task that runs concurrently activates `v`
template <class Surface>
void deactivate(Surface& surface, Index v, Activity kernel)
{
  surface.active[v] = std::uint8_t(surface.active[v] & ~std::uint8_t(kernel));
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_COMMON_H

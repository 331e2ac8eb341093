// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much of a surface is too degenerate for Gregory patches.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_FALLBACKS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_FALLBACKS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/surface/Gregory_patch_3.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Patch_fallbacks
{
  std::size_t straight_sides = 0;  ///< sides of faces that are chords; an inner edge has two
  std::size_t cubic_interiors = 0; ///< faces that do not share the tangent planes of their neighbours
};

/// Counts the fallbacks of the Gregory patches of the faces `[0, n)`, of which `patch(f)` returns the data.
template <class Execution, class PatchOfFace>
Patch_fallbacks count_patch_fallbacks(const Execution& execution, std::size_t n, const PatchOfFace& patch)
{
  const auto add = [&](Patch_fallbacks& sum, std::size_t f) {
    const Gregory_patch_3 g(patch(f));
    for (std::size_t i = 0; i < 3; ++i) sum.straight_sides += g.curve(i) == Gregory_patch_3::Curve::straight;
    sum.cubic_interiors += g.interior() == Gregory_patch_3::Interior::cubic;
  };
  return accumulate(execution, n, Patch_fallbacks(), add, [](const Patch_fallbacks& a, const Patch_fallbacks& b) {
    return Patch_fallbacks{a.straight_sides + b.straight_sides, a.cubic_interiors + b.cubic_interiors};
  });
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_FALLBACKS_H

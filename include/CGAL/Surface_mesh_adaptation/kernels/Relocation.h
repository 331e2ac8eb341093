// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relocation: moves vertices on the surface to improve the faces around them (paper, section 3).
//
// Smooth vertices by diffusion (diffusion.h), curve vertices along their curve (curve_slide.h); corners stay. Where
// that does nothing for a vertex with a bad face around it, its worst distortion is minimised (distortion_descent.h),
// until no face is bad.
//
// Conflict neighbourhood: distance-1, because normals and metrics follow from the vertex's own location. Where a face
// is not flat, the test for folds also looks at the vertices behind the ring: if these may be moving, the vertex is put
// off until they stand still.
// Invariants: connectivity is not touched; no move turns a face farther from the surface than the limits or than it
// was; the worst face around a vertex never falls below both what it was and `good_quality`, or
// `good_quality_on_curves` if the vertex lies on one.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_H

#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Relocation_attempt.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/curve_slide.h>
#include <CGAL/Surface_mesh_adaptation/kernels/diffusion.h>
#include <CGAL/Surface_mesh_adaptation/kernels/distortion_descent.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

template <class Surface, class Execution>
class Relocation
{
public:
  Relocation(const Execution& execution, Surface& surface, const Relocation_thresholds& thresholds)
    : execution_(execution), surface_(surface), mesh_(surface.mesh), thresholds_(thresholds)
    , min_move_(thresholds.min_move)
  {}

  /// Whether the mesh is adapted already: it is left as it is then, but for noticeable moves.
  void expect_adapted(bool is_adapted)
  {
    min_move_ = is_adapted ? thresholds_.noticeable_move : thresholds_.min_move;
  }

  /// Examines every active vertex once. Returns the number of vertices moved.
  std::size_t sweep(Sweep_counts& counts)
  {
    relaxation_ = relaxation_ == over_relaxation ? plain_relaxation : over_relaxation;
    return visit_vertices(
      [&](Index v) {
        return surface_.vertex_class(v) != Vertex_class::corner && is_active(surface_, v, Activity::relocate);
      },
      [&](auto& attempt) { return examine(attempt); }, counts);
  }

  /// Moves the vertices that are still on facets to the patches above. Returns the number of vertices moved.
  std::size_t leave_facets(Sweep_counts& counts)
  {
    surface_.is_on_facets = false;
    return visit_vertices(
      [&](Index v) {
        return surface_.vertex_class(v) == Vertex_class::smooth &&
               surface_.is_small_face(surface_.locations[v].cell, surface_.metrics[v]);
      },
      [&](auto& attempt) {
        const auto moved = surface_.place(surface_.locations[attempt.vertex]);
        return attempt.is_harmless(moved) && attempt.apply(moved);
      },
      counts);
  }

private:
  /// Calls `examine(attempt)`, which says whether it moved the vertex, for all that `is_candidate`.
  template <class IsCandidate, class Examine>
  std::size_t visit_vertices(const IsCandidate& is_candidate, const Examine& examine, Sweep_counts& counts)
  {
    Sweep_counts local;
    const auto visit = [&](Index v, const auto& stands_still, Sweep_counts& c, std::vector<Index>& late) {
      Relocation_attempt attempt(surface_, v, thresholds_, min_move_, stands_still);
      ++c.candidates;
      c.applied += examine(attempt);
      if (attempt.is_put_off) late.push_back(v);
    };
    const std::size_t length = length_of_short_blocks(mesh_.number_of_vertices());
    const std::vector<Index> deferred = sweep_blocks(
      execution_, mesh_.number_of_vertices(), local,
      [&](Index v, const Block& block, Sweep_counts& c, std::vector<Index>& list) {
        if (mesh_.is_removed_vertex(v) || !is_candidate(v)) return;
        if (!contains_ring(block, mesh_, v)) return list.push_back(v);
        visit(v, [&](Index w) { return block.contains(w); }, c, list); // or has had its turn
      },
      length);
    // what would have to look at vertices that another task moves is left for the end: a few near features and folds
    const std::vector<Index> late = sweep_block_borders(execution_, mesh_, deferred, local, visit, length);
    std::vector<Index> never;
    for (const Index v : late) visit(v, [](Index) { return true; }, local, never);
    ++local.sweeps;
    counts += local;
    return local.applied;
  }

  template <class Attempt>
  bool examine(Attempt& attempt)
  {
    const bool is_on_curve = surface_.vertex_class(attempt.vertex) == Vertex_class::curve;
    const bool moved = (is_on_curve ? slide(attempt) : diffuse(attempt, relaxation_)) ||
                       (!attempt.is_put_off && descend(attempt));
    if (!moved && !attempt.is_put_off) deactivate(surface_, attempt.vertex, Activity::relocate);
    return moved;
  }

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Relocation_thresholds thresholds_;
  double min_move_;
  double relaxation_ = plain_relaxation;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_RELOCATION_H

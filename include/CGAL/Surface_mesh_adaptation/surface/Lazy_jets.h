// SPDX-License-Identifier: GPL-3.0-or-later
//
// Jets of the sectors of a mesh (vertex_jets.h), each estimated when it is first asked for: where a mesh stays as it
// is, none are.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_LAZY_JETS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_LAZY_JETS_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facet_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Sector_facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/feature_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_jets.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

struct Jet
{
  Vector_3 normal;
  Metric_tensor_3 shape_operator;
  bool has_shape_operator;
};

/// With the normal `normal` the mean shape operator of those of `jets` that have one, each turned with its normal.
inline Jet mean_jet(const std::array<Jet, 3>& jets, const std::array<double, 3>& weights, const Vector_3& normal)
{
  Jet mean{normal, Metric_tensor_3(0, 0, 0, 0, 0, 0), false};
  double known = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!jets[i].has_shape_operator) continue;
    mean.shape_operator += weights[i] * rotated(jets[i].shape_operator, minimal_rotation(jets[i].normal, normal));
    known += weights[i];
  }
  mean.has_shape_operator = known > 0;
  if (known > 0) mean.shape_operator = 1 / known * mean.shape_operator;
  return mean;
}

/// What the user knows of the surface at the vertices of the input: empty, or one for each vertex.
struct Given_jets
{
  std::vector<Vector_3> normals;                 ///< unit
  std::vector<Metric_tensor_3> shape_operators;  ///< zero where it is not known

  /// `jet` with what is given at `v`.
  Jet at(Index v, Jet jet) const
  {
    if (!normals.empty()) jet.normal = normals[v];
    if (!shape_operators.empty()) {
      jet.shape_operator = shape_operators[v];
      jet.has_shape_operator = !(jet.shape_operator == Metric_tensor_3(0, 0, 0, 0, 0, 0));
    }
    return jet;
  }

  bool is_complete() const { return !normals.empty() && !shape_operators.empty(); }
};

class Lazy_jets
{
public:
  template <class Execution>
  Lazy_jets(const Execution& execution, std::size_t number_of_sectors)
    : jets_(number_of_sectors), state_(new std::atomic<std::uint8_t>[number_of_sectors])
  {
    for_each_index(execution, number_of_sectors, [&](std::size_t i) {
      state_[i].store(empty, std::memory_order_relaxed);
    }, fill_chunk_length);
  }

  /// The jet of `sector`, which `estimate()` returns. Threads that ask at the same time may all estimate it, to the
  /// same bits.
  template <class Estimate>
  Jet at(Index sector, const Estimate& estimate) const
  {
    std::atomic<std::uint8_t>& state = state_[sector];
    if (state.load(std::memory_order_acquire) == ready) return jets_[sector];
    const Jet jet = estimate();
    std::uint8_t expected = empty;
    if (state.compare_exchange_strong(expected, busy, std::memory_order_relaxed)) {
      jets_[sector] = jet;
      state.store(ready, std::memory_order_release);
    }
    return jet;
  }

private:
  static constexpr std::uint8_t empty = 0, busy = 1, ready = 2;

  mutable Buffer<Jet> jets_;
  std::unique_ptr<std::atomic<std::uint8_t>[]> state_;
};

/// The normal of the `n` facets of a sector from that of `first` on that is off them least, in the mean over their
/// area, so that patches leave them least; `otherwise` if they have none.
inline Vector_3 mean_normal(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index first, std::size_t n,
                            const Vector_3& otherwise)
{
  Facet_normals facets;
  for (Index h = first; n > 0; --n, h = mesh.rotated_ccw(h)) facets.add(face_normal(mesh, points, h));
  return facets.empty() ? otherwise : facets.mean();
}

/// The jet of the sector of the `n` faces from that of `first` on, where it has the normal `start` of Max: in a plane
/// of the shape that of the plane, where facets of many sizes meet that of these; else of a fit; if none is good
/// enough, or it is not across rulings that end there, with the mean normal of the triangles. Sets `ruling` where facets
/// say one.
inline Jet jet_of_sector(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Facets& facets, Index first,
                         std::size_t n, const Vector_3& start, Vector_3& ruling)
{
  const Metric_tensor_3 none(0, 0, 0, 0, 0, 0);
  std::optional<Sector_facets> sector;
  if (!facets.empty()) {
    sector.emplace(facets, mesh, points, first, n);
    if (const Facet* plane = sector->plane()) return {plane->normal, none, false};
    if (facets.are_chords()) ruling = sector->ruling();
    const bool is_of_chords = ruling.squaredNorm() > 0 ||
                              (facets.are_chords() && sector->has_polygon() && !sector->are_of_one_net());
    const Vector_3 normal = is_of_chords ? sector->normal() : Vector_3::Zero();
    if (normal.squaredNorm() > 0) return {normal, none, false};
  }
  Jet_of_sector fit{start, none};
  if (fit_jet(mesh, points, &facets, first, n, start, Jet_fit::exact, Fit_purpose::patches, fit) != Fit_degree::none &&
      (!facets.are_chords() || sector->is_across_rulings(fit.normal)))
    return {fit.normal, fit.shape_operator, true};
  return {mean_normal(mesh, points, first, n, start), none, false};
}

/// The jet of the sector that the corner `h` belongs to, with the mean normal of its facets and without a shape
/// operator where no fit is good enough. What is given counts at smooth vertices: others may have several normals.
inline Jet estimate_jet(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Features& features,
                        const Corner_normals& normals, const Given_jets& given, Index h)
{
  const Index v = mesh.source(h), sector = normals.of_corner[h];
  Jet jet{normals.normals[sector], Metric_tensor_3(0, 0, 0, 0, 0, 0), false};
  const bool is_smooth = features.vertex_class[v] == Vertex_class::smooth;
  if (is_smooth && given.is_complete()) return given.at(v, jet);
  for_each_sector(mesh, v, [&](Index first, std::size_t n) {
    if (normals.of_corner[first] != sector) return;
    Vector_3 ruling = Vector_3::Zero();
    jet = jet_of_sector(mesh, points, features.facets, first, n, jet.normal, ruling);
    jet.normal = normal_on_features(mesh, features, first, n, jet.normal, ruling);
  });
  return is_smooth ? given.at(v, jet) : jet;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_LAZY_JETS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The patches that a thread used last: neighbouring vertices lie on few faces, and a patch takes longer to prepare than
// to evaluate.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_CACHE_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_CACHE_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Gregory_patch_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A patch with what its points have in common computed once; of models of `SurfaceReconstruction` without such a type,
/// the patch itself.
template <class Reconstruction, class = void>
struct Prepared_patch
{
  Patch patch;

  explicit Prepared_patch(const Patch& p) : patch(p) {}
  Surface_point evaluate(double u, double v) const { return Reconstruction::evaluate(patch, u, v); }
};

template <class Reconstruction>
struct Prepared_patch<Reconstruction, std::void_t<typename Reconstruction::Prepared_patch>>
  : Reconstruction::Prepared_patch
{
  using Reconstruction::Prepared_patch::Prepared_patch;
};

/// Whether a prepared patch is of lower order than its model promises, because its corners say too little.
template <class Prepared>
auto has_fallback(const Prepared& p, int) -> decltype(p.interior(), bool())
{
  using Gregory = Gregory_patch_3;
  bool found = p.interior() != Gregory::Interior::gregory;
  for (std::size_t i = 0; i < 3; ++i) found = found || p.curve(i) == Gregory::Curve::straight;
  return found;
}

template <class Prepared>
bool has_fallback(const Prepared&, long) { return false; }

/// Tells surfaces apart, also those that follow each other at one address.
inline std::uint64_t unique_surface_id()
{
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

template <class Reconstruction>
class Patch_cache
{
public:
  using Prepared = Prepared_patch<Reconstruction>;

  /// The patch of `face` of the surface `id`, made from `patch()` unless this thread has it; then `note(prepared)` is
  /// called.
  template <class MakePatch, class Note>
  static const Prepared& at(std::uint64_t id, Index face, const MakePatch& patch, const Note& note)
  {
    thread_local const std::unique_ptr<std::array<Entry, length>> entries(new std::array<Entry, length>());
    Entry& e = (*entries)[face % length];
    if (e.surface != id || e.face != face) {
      e.prepared.emplace(patch());
      note(*e.prepared);
      e.surface = id;
      e.face = face;
    }
    return *e.prepared;
  }

private:
  static constexpr std::size_t length = 128;

  struct Entry
  {
    std::uint64_t surface = 0;
    Index face = 0;
    std::optional<Prepared> prepared;
  };
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PATCH_CACHE_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches of the user, such as materials, as numbers of faces that the kernels hand on.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_FACE_LABELS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_FACE_LABELS_H

#include <CGAL/Surface_mesh_adaptation/driver/constraints.h>
#include <CGAL/Surface_mesh_adaptation/driver/saved_values.h>
#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Numbers the components of faces that `are_one(f, g)` for faces `f` and `g` beside each other: in `mesh.label`. Calls
/// `found(f)` for the first face of each.
template <class AreOne, class Found>
void label_components(Mesh_view& mesh, const AreOne& are_one, const Found& found)
{
  const std::size_t n = mesh.number_of_faces();
  mesh.label.assign(n, no_index);
  std::vector<Index> open;
  Index label = 0;
  for (Index first = 0; first < n; ++first) {
    if (mesh.label[first] != no_index) continue;
    found(first);
    mesh.label[first] = label;
    for (open.push_back(first); !open.empty();) {
      const Index f = open.back();
      open.pop_back();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index g = mesh.is_border(h) ? f : Mesh_view::face(mesh.twin[h]);
        if (mesh.label[g] != no_index || !are_one(f, g)) continue;
        mesh.label[g] = label;
        open.push_back(g);
      }
    }
    ++label;
  }
}

/// The labels of the faces: each connected part of a patch of `face_patch_map`, within the domain and beside it, is one.
template <class Domain, class NamedParameters>
class Face_labels
{
public:
  static constexpr bool has_patches = has_parameter<NamedParameters, CGAL::internal_np::face_patch_t>;
  static constexpr bool exist = has_patches || Domain::is_part;

  /// Labels the faces of `imported`, and constrains the edges between patches and those at faces that stay. Work: O(n),
  /// if there is anything to label.
  template <class Imported_mesh>
  Face_labels(const Domain& domain, Imported_mesh& imported, Feature_parameters& features, const NamedParameters& np)
  {
    if constexpr (exist) {
      const auto is_inside = [&](Index f) { return domain.is_inside(imported, f); };
      const auto with_patch = [&](Index f, const auto& use) {
        if constexpr (has_patches) {
          const auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::face_patch);
          return use(get(map, face(imported.halfedges[3 * std::size_t(f)], domain.graph())));
        } else return use(0);
      };
      Mesh_view& mesh = imported.mesh;
      const auto add = [&](Index f) { with_patch(f, [&](const auto& patch) { patches_.push_back({patch}); }); };
      if (!Domain::is_part && is_one_patch(mesh.number_of_faces(), with_patch)) {
        add(0);
        return;
      }
      label_components(mesh, [&](Index f, Index g) {
        return is_inside(f) == is_inside(g) && with_patch(f, [&](const auto& a) {
          return with_patch(g, [&](const auto& b) { return a == b; });
        });
      }, [&](Index f) {
        is_inside_.push_back(is_inside(f));
        add(f);
      });
      constrain(mesh, features);
    }
  }

  bool is_inside(const Mesh_view& mesh, Index f) const { return !Domain::is_part || is_inside_[mesh.label[f]] != 0; }

  /// Writes the patch of each face.
  void write(const Domain& domain, const Mesh_view& mesh, const NamedParameters& np) const
  {
    if constexpr (has_writable_map<NamedParameters, CGAL::internal_np::face_patch_t>()) {
      const auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::face_patch);
      domain.for_each_face([&](Index f, const auto& face) {
        put(map, face, patches_[mesh.has_labels() ? mesh.label[f] : 0].value);
      });
    }
  }

private:
  /// Whether all `n` faces are of one patch, so that nothing needs a label.
  template <class WithPatch>
  static bool is_one_patch(std::size_t n, const WithPatch& with_patch)
  {
    return with_patch(0, [&](const auto& first) {
      for (Index f = 1; f < n; ++f)
        if (!with_patch(f, [&](const auto& patch) { return patch == first; })) return false;
      return true;
    });
  }

  void constrain(const Mesh_view& mesh, Feature_parameters& features) const
  {
    const auto label = [&](Index h) { return mesh.label[Mesh_view::face(h)]; };
    features.constrain(mesh, Edge_constraint::border, [&](Index h) {
      return !mesh.is_border(h) && label(h) != label(mesh.twin[h]);
    });
    if constexpr (Domain::is_part)
      features.constrain(mesh, Edge_constraint::protect, [&](Index h) {
        return is_inside_[label(h)] == 0 || (!mesh.is_border(h) && is_inside_[label(mesh.twin[h])] == 0);
      });
  }

  static auto patch_type()
  {
    if constexpr (has_patches) {
      using Map = std::decay_t<decltype(CGAL::parameters::get_parameter(std::declval<NamedParameters>(),
                                                                        CGAL::internal_np::face_patch))>;
      return Saved_value<typename boost::property_traits<Map>::value_type>();
    } else return Saved_value<int>();
  }

  std::vector<decltype(patch_type())> patches_; // of each label
  std::vector<std::uint8_t> is_inside_;         // the same
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_FACE_LABELS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// All that belongs to the elements of the user's mesh, from the input to the result: constraints, labels, attributes,
// origins.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CARRIED_VALUES_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CARRIED_VALUES_H

#include <CGAL/Surface_mesh_adaptation/driver/constraints.h>
#include <CGAL/Surface_mesh_adaptation/driver/element_attributes.h>
#include <CGAL/Surface_mesh_adaptation/driver/face_labels.h>
#include <CGAL/Surface_mesh_adaptation/driver/kept_properties.h>
#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/surface/swap_caps.h>

#include <tuple>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A class template over the maps of a parameter, a tuple or a vector of maps.
template <template <class> class Attributes, class NamedParameters, class Tag>
using Attributes_of =
  Attributes<std::decay_t<decltype(choose(std::declval<const NamedParameters&>(), Tag(), std::tuple<>()))>>;

template <class Domain, class NamedParameters>
class Carried_values
{
public:
  using Graph = std::remove_const_t<typename Domain::Graph>;

  /// Reads all maps, and labels the faces of `imported`. \pre `domain` and `np` live as long as this
  Carried_values(const Domain& domain, Imported_mesh<Graph>& imported, const NamedParameters& np)
    : domain_(domain), np_(np), features_(feature_parameters(domain.graph(), imported, np))
    , labels_(domain, imported, features_, np)
    , at_vertices_(imported, choose(np, internal_np::vertex_attribute_maps, std::tuple<>()))
    , at_faces_(domain.graph(), imported, choose(np, internal_np::face_attribute_maps, std::tuple<>()))
    , at_corners_(imported, choose(np, internal_np::halfedge_attribute_maps, std::tuple<>()))
    , origins_(domain.graph(), imported, np), properties_(domain, imported)
  {
    at_corners_.constrain_seams(imported.mesh, features_);
  }

  const Feature_parameters& features() const { return features_; }

  /// Swaps the caps of `imported`, see `surface/swap_caps.h`.
  template <class Execution>
  void swap_caps(const Execution& execution, Imported_mesh<Graph>& imported, double most)
  {
    swapped_ =
      Surface_mesh_adaptation::swap_caps(execution, imported.mesh, imported.points, features_.halfedge_constraint, most);
  }

  /// Whether face `f` of the result takes the place of faces of the domain.
  bool is_inside(const Mesh_view& mesh, Index f) const { return labels_.is_inside(mesh, f); }

  /// To be called before the mesh of the user is replaced: may throw.
  template <class Execution, class Surface>
  void prepare(const Execution& execution, const Surface& surface)
  {
    below_ = faces_below(execution, surface, !at_faces_.empty() || decltype(origins_)::of_faces);
    for (Index& f : below_) f = swapped_.face_before(f);
  }

  /// Writes them to the result.
  template <class Surface>
  void write(const Surface& surface)
  {
    properties_.write(domain_, surface);
    write_constraints(domain_, surface, features_, np_);
    labels_.write(domain_, surface.mesh, np_);
    at_vertices_.write(domain_, surface);
    at_faces_.write(domain_, below_);
    at_corners_.write(domain_, surface, swapped_);
    origins_.write(domain_, surface, below_);
  }

private:
  const Domain& domain_;
  const NamedParameters& np_;
  Feature_parameters features_;
  Face_labels<Domain, NamedParameters> labels_;
  Attributes_of<Vertex_attributes, NamedParameters, internal_np::vertex_attribute_maps_t> at_vertices_;
  Attributes_of<Face_attributes, NamedParameters, internal_np::face_attribute_maps_t> at_faces_;
  Attributes_of<Corner_attributes, NamedParameters, internal_np::halfedge_attribute_maps_t> at_corners_;
  Origins<Graph, NamedParameters> origins_;
  Kept_properties<Domain> properties_;
  Swapped_caps swapped_;
  Buffer<Index> below_; // of each face of the result the face of the input
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CARRIED_VALUES_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Named parameters of the package, beside those of CGAL that it also understands. A pack made here converts to
// CGAL's, and a plain CGAL pack is accepted wherever one of ours is. Their meaning: adapt_surface_mesh.h, simplify.h.
//
//     namespace params = CGAL::Surface_mesh_adaptation::parameters;
//     adapt_surface_mesh(mesh, field, params::feature_angle(60).number_of_iterations(4));

#ifndef CGAL_SURFACE_MESH_ADAPTATION_PARAMETERS_H
#define CGAL_SURFACE_MESH_ADAPTATION_PARAMETERS_H

#include <CGAL/Named_function_parameters.h>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{
namespace internal_np {

enum feature_angle_t { feature_angle };
enum detect_features_t { detect_features };
enum smooth_borders_t { smooth_borders };
enum output_metric_map_t { output_metric_map };
enum surface_reconstruction_t { surface_reconstruction };
enum fit_to_surface_t { fit_to_surface };
enum shape_weight_of_fit_t { shape_weight_of_fit };
enum vertex_shape_operator_map_t { vertex_shape_operator_map };
enum face_attribute_maps_t { face_attribute_maps };
enum halfedge_attribute_maps_t { halfedge_attribute_maps };
enum vertex_origin_map_t { vertex_origin_map };
enum face_origin_map_t { face_origin_map };
enum face_size_bounds_map_t { face_size_bounds_map };
enum face_deviation_map_t { face_deviation_map };
enum edge_is_protected_map_t { edge_is_protected_map };
enum protected_gradation_t { protected_gradation };
enum vertex_attribute_maps_t { vertex_attribute_maps };
enum maximum_normal_deviation_t { maximum_normal_deviation };
enum maximum_distance_t { maximum_distance };
enum tolerance_t { tolerance };
enum avoid_self_intersections_t { avoid_self_intersections };
enum count_self_intersections_t { count_self_intersections };
enum maximum_number_of_vertices_t { maximum_number_of_vertices };

} // namespace internal_np

/// A CGAL named-parameter pack that can be continued with the package's own parameters.
template <class T, class Tag, class Base = CGAL::internal_np::No_property>
struct Adaptation_parameters : CGAL::Named_function_parameters<T, Tag, Base>
{
  /// \cond SKIP_IN_MANUAL
  using self = CGAL::Named_function_parameters<T, Tag, Base>;

  Adaptation_parameters() = default;
  explicit Adaptation_parameters(const T& value) : self(value) {}
  Adaptation_parameters(const T& value, const Base& base_pack) : self(value, base_pack) {}

#define CGAL_SMA_NAMED_PARAMETER(TAG, NAME)                                                     \
  template <class K>                                                                            \
  Adaptation_parameters<K, TAG, self> NAME(const K& value) const                                \
  {                                                                                             \
    return Adaptation_parameters<K, TAG, self>(value, *this);                                   \
  }
#include <CGAL/Surface_mesh_adaptation/driver/parameters_interface.h>
#undef CGAL_SMA_NAMED_PARAMETER
  /// \endcond
};

/// \cond SKIP_IN_MANUAL
namespace parameters {

inline CGAL::parameters::Default_named_parameters default_values() { return CGAL::parameters::default_values(); }

#define CGAL_SMA_NAMED_PARAMETER(TAG, NAME)                                                     \
  template <class K>                                                                            \
  Adaptation_parameters<K, TAG> NAME(const K& value)                                            \
  {                                                                                             \
    return Adaptation_parameters<K, TAG>(value);                                                \
  }
#include <CGAL/Surface_mesh_adaptation/driver/parameters_interface.h>
#undef CGAL_SMA_NAMED_PARAMETER

} // namespace parameters
/// \endcond
/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_PARAMETERS_H

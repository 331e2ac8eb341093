// SPDX-License-Identifier: GPL-3.0-or-later
//
// One line for each named parameter; included twice by parameters.h, hence without include guard.

// of CGAL
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::vertex_point_t, vertex_point_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::vertex_normal_map_t, vertex_normal_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::edge_is_constrained_t, edge_is_constrained_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::vertex_is_constrained_t, vertex_is_constrained_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::face_patch_t, face_patch_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::protect_constraints_t, protect_constraints)
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::number_of_iterations_t, number_of_iterations)
CGAL_SMA_NAMED_PARAMETER(CGAL::internal_np::visitor_t, visitor)

// of this package
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::feature_angle_t, feature_angle)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::detect_features_t, detect_features)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::smooth_borders_t, smooth_borders)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::output_metric_map_t, output_metric_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::surface_reconstruction_t, surface_reconstruction)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::fit_to_surface_t, fit_to_surface)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::shape_weight_of_fit_t, shape_weight_of_fit)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::tolerance_t, tolerance)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::avoid_self_intersections_t, avoid_self_intersections)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::count_self_intersections_t, count_self_intersections)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::vertex_attribute_maps_t, vertex_attribute_maps)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::face_attribute_maps_t, face_attribute_maps)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::halfedge_attribute_maps_t, halfedge_attribute_maps)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::vertex_origin_map_t, vertex_origin_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::face_origin_map_t, face_origin_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::edge_is_protected_map_t, edge_is_protected_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::protected_gradation_t, protected_gradation)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::face_size_bounds_map_t, face_size_bounds_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::face_deviation_map_t, face_deviation_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::vertex_shape_operator_map_t, vertex_shape_operator_map)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::maximum_normal_deviation_t, maximum_normal_deviation)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::maximum_distance_t, maximum_distance)
CGAL_SMA_NAMED_PARAMETER(CGAL::Surface_mesh_adaptation::internal_np::maximum_number_of_vertices_t, maximum_number_of_vertices)

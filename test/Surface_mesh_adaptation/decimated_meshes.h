// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coarse parts: what CGAL's simplification leaves of the meshes of its manual. Midpoints, for optimal places depend on the
// compiler's options.

#ifndef TEST_SURFACE_MESH_ADAPTATION_DECIMATED_MESHES_H
#define TEST_SURFACE_MESH_ADAPTATION_DECIMATED_MESHES_H

#include "real_meshes.h"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <string>

/// A mesh of CGAL's data with a share of its edges: short ones vanish first.
template <class Mesh>
Mesh decimated_mesh(const std::string& name, double share)
{
  namespace Simplification = CGAL::Surface_mesh_simplification;
  Mesh mesh = real_mesh<Mesh>(name);
  Simplification::edge_collapse(mesh, Simplification::Count_ratio_stop_predicate<Mesh>(share),
                                CGAL::parameters::get_cost(Simplification::Edge_length_cost<Mesh>())
                                  .get_placement(Simplification::Midpoint_placement<Mesh>()));
  mesh.collect_garbage();
  return mesh;
}

#endif // TEST_SURFACE_MESH_ADAPTATION_DECIMATED_MESHES_H

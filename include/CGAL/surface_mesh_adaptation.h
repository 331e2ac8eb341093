// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole package in one include.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>
#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/driver/Attribute_interpolator.h>
#include <CGAL/Surface_mesh_adaptation/estimate_vertex_jets.h>
#include <CGAL/Surface_mesh_adaptation/numerics/minimize_worst.h>
#include <CGAL/Surface_mesh_adaptation/refine.h>
#include <CGAL/Surface_mesh_adaptation/regularize.h>
#include <CGAL/Surface_mesh_adaptation/relocate.h>
#include <CGAL/Surface_mesh_adaptation/simplify.h>
#include <CGAL/Surface_mesh_adaptation/surface/exponential_map.h>
#include <CGAL/Surface_mesh_adaptation/surface/feature_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface/patch_fallbacks.h>
#include <CGAL/Surface_mesh_adaptation/swap.h>
#include <CGAL/Surface_mesh_adaptation/tasks/graph_coloring.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>
#include <CGAL/Surface_mesh_adaptation/tasks/matching.h>

#endif // CGAL_SURFACE_MESH_ADAPTATION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's models of the face graph that tests go through.

#ifndef TEST_SURFACE_MESH_ADAPTATION_MODELS_H
#define TEST_SURFACE_MESH_ADAPTATION_MODELS_H

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_for_bgl_combinatorial_map_helper.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

namespace models {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
template <class K>
using Surface_mesh_of = CGAL::Surface_mesh<typename K::Point_3>;
using Surface_mesh = Surface_mesh_of<Kernel>;
using Exact_mesh = Surface_mesh_of<CGAL::Exact_predicates_exact_constructions_kernel>;
using Single_precision_mesh = Surface_mesh_of<CGAL::Simple_cartesian<float>>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Cell_complex =
  CGAL::Linear_cell_complex_for_bgl_combinatorial_map_helper<2, 3, CGAL::Linear_cell_complex_traits<3, Kernel>>::type;

/// With coordinates that are doubles.
using Reference = Surface_mesh_of<CGAL::Simple_cartesian<double>>;

} // namespace models

#endif // TEST_SURFACE_MESH_ADAPTATION_MODELS_H

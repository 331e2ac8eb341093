// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of tessellations share: polygons, and soups as they are after an adaptation.

#ifndef TEST_SURFACE_MESH_ADAPTATION_TESSELLATIONS_H
#define TEST_SURFACE_MESH_ADAPTATION_TESSELLATIONS_H

#include "shape_meshes.h"
#include "shapes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <vector>

namespace tessellations_of_tests {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::pi;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using Surface_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Polygon = std::vector<Index>;

inline const SMA::Sequential_execution sequential;

template <class Execution = SMA::Sequential_execution>
Soup adapted(const Soup& soup, double size, const Execution& execution = sequential)
{
  auto mesh = shapes::mesh<Surface_mesh>(soup);
  SMA::adapt_surface_mesh(execution, mesh, SMA::Uniform_metric_field(size));
  return shapes::soup(mesh);
}

} // namespace tessellations_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_TESSELLATIONS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reference surfaces of soups.

#ifndef TEST_SURFACE_MESH_ADAPTATION_SURFACE_REFERENCES_H
#define TEST_SURFACE_MESH_ADAPTATION_SURFACE_REFERENCES_H

#include "checks.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace references_of_tests {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::pi;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Feature_parameters;
using SMA::Mesh_view;
using SMA::PN_triangle_reconstruction;
using SMA::Vertex_class;
using Surface = SMA::Reference_surface<PN_triangle_reconstruction>;

inline const SMA::Sequential_execution sequential;

inline Surface reference(const Soup& soup, const Feature_parameters& parameters = {})
{
  return Surface(sequential, shapes::view(soup), soup.points, parameters);
}

} // namespace references_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_SURFACE_REFERENCES_H

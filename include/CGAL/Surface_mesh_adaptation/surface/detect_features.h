// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detection of features: edges are marked, then chained to curves.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_DETECT_FEATURES_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_DETECT_FEATURES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Feature_chaining.h>
#include <CGAL/Surface_mesh_adaptation/surface/Feature_marks.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// Detects the features of a mesh and writes the curve of every halfedge into `mesh.curve`. A vertex on one feature
/// curve that does not turn sharply there is a curve vertex; one at which curves end, meet, branch or turn, which is
/// constrained, or which is the point of a cone is a corner.
template <class Execution>
Features detect_features(const Execution& execution, Mesh_view& mesh, const std::vector<Vector_3>& points,
                         const Feature_parameters& parameters)
{
  internal::Feature_marks marks(execution, mesh, points, parameters);
  Facets facets = marks.take_facets();
  return internal::Feature_chaining(mesh, points, parameters, marks, std::move(facets)).run(execution);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_DETECT_FEATURES_H

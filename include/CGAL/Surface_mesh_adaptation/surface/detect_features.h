// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detection of features: edges are marked, then chained to curves.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_DETECT_FEATURES_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_DETECT_FEATURES_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/cubic_curve.h>
#include <CGAL/Surface_mesh_adaptation/surface/Feature_chaining.h>
#include <CGAL/Surface_mesh_adaptation/surface/Feature_marks.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/polyhedra.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// How far the curves of the features are off the middles of their edges.
template <class Execution>
double largest_bulge_of_curves(const Execution& execution, const Features& features, const std::vector<Vector_3>& points)
{
  return reduce(execution, features.curves.size(), 0.0, [&](std::size_t i) {
    const Feature_curve& c = features.curves[i];
    double largest = 0;
    for (std::size_t j = 0; j < c.ends.size(); ++j) {
      const Vector_3 e = points[c.vertices[j + 1]] - points[c.vertices[j]];
      largest = (std::max)(largest, bulge(feature_handles(e, c.ends[j][0], c.ends[j][1])).norm());
    }
    return largest;
  }, [](double a, double b) { return (std::max)(a, b); });
}

/// Chords of curves tell of sags as well, where rows of facets are not even: facets may bulge by half as much again.
template <class Execution>
void raise_sag(const Execution& execution, const std::vector<Vector_3>& points, Features& features)
{
  constexpr double more = 1.5;
  const double bulge = largest_bulge_of_curves(execution, features, points);
  features.facets.sag = (std::max)(features.facets.sag, more * bulge / largest_bulge_of_facets);
}

template <class Execution>
Features features_between(const Execution& execution, Mesh_view& mesh, const std::vector<Vector_3>& points,
                          const Feature_parameters& parameters, Facets facets)
{
  Feature_marks marks(execution, mesh, points, parameters, std::move(facets));
  facets = marks.take_facets();
  Features features = Feature_chaining(mesh, points, parameters, marks, std::move(facets)).run(execution);
  if (features.facets.are_chords()) raise_sag(execution, points, features);
  return features;
}

} // namespace internal

/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// Detects the features of a mesh and writes the curve of every halfedge into `mesh.curve`. A vertex on one feature
/// curve that does not turn sharply there is a curve vertex; one at which curves end, meet, branch or turn, which is
/// constrained, or which is the point of a cone is a corner.
template <class Execution>
Features detect_features(const Execution& execution, Mesh_view& mesh, const std::vector<Vector_3>& points,
                         const Feature_parameters& parameters)
{
  using internal::features_between;
  Features features = features_between(execution, mesh, points, parameters, find_facets(execution, mesh, points));
  if (features.facets.empty() && internal::is_polyhedron(execution, mesh, points))
    features = features_between(execution, mesh, points, parameters, find_facets_of_polyhedron(execution, mesh, points));
  return features;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_DETECT_FEATURES_H

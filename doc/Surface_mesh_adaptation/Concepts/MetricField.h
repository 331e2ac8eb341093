// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgSurfaceMeshAdaptationConcepts
\cgalConcept

What a mesh is adapted to: a size (a length in the unit of the coordinates) or a metric tensor `M` at every point of the
surface, in which an edge `e` is to have the length `sqrt(e^T M e) = 1`. Besides the models below, every
`ReadablePropertyMap` with the vertex descriptor of the mesh as key and a size (of a type that models `RealEmbeddable`,
such as `double`) or a `CGAL::Surface_mesh_adaptation::Metric_tensor_3` as value is a model. It is read at the vertices
of the input, once, from the calling thread.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Surface_mesh_adaptation::Uniform_metric_field}
\cgalHasModels{CGAL::Surface_mesh_adaptation::Curvature_metric_field}
\cgalHasModels{CGAL::Surface_mesh_adaptation::Solution_metric_field<VertexScalarMap>}
\cgalHasModels{CGAL::Surface_mesh_adaptation::Analytic_metric_field<Function>}
\cgalHasModels{CGAL::Surface_mesh_adaptation::Intersection_metric_field<MetricFields...>}
\cgalHasModelsEnd
*/
class MetricField
{
};

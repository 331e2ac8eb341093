// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_ADAPT_SURFACE_MESH_H
#define CGAL_SURFACE_MESH_ADAPTATION_ADAPT_SURFACE_MESH_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_visitor.h>
#include <CGAL/Surface_mesh_adaptation/driver/Adaptation_driver.h>
#include <CGAL/Surface_mesh_adaptation/driver/check_models.h>
#include <CGAL/Surface_mesh_adaptation/driver/in_place.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/metric_fields.h>
#include <CGAL/Surface_mesh_adaptation/parameters.h>
#include <CGAL/Surface_mesh_adaptation/surface/surface_bulge.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>
#include <variant>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFunctions
/// @{

namespace internal {

/// \throws Invalid_parameter_error
template <class NamedParameters>
double shape_weight_of_fit(const NamedParameters& np)
{
  const double weight = choose(np, internal_np::shape_weight_of_fit, default_shape_weight);
  if (!(weight > 0 && weight <= 1))
    throw Invalid_parameter_error("the shape weight of the fit must be above 0 and up to 1");
  return weight;
}

/// Says whether the number of vertices that `field` asks for was missed by more than a tenth.
template <class MetricField>
void warn_of_missed_number(const MetricField& field, Adaptation_report& report)
{
  constexpr double largest_miss = 0.1;
  const double asked = double(number_of_vertices(field, 0)), reached = double(report.final.vertices);
  if (report.stopped || asked == 0 || std::abs(reached - asked) <= largest_miss * asked) return;
  report.warnings.push_back("the mesh has " + number(reached) + " vertices where " + number(asked) + " were asked for");
}

template <class MetricField, class Reference>
void warn_of_bulges(const Any_execution&, const MetricField&, const Reference&, Adaptation_report&)
{}

/// Says where the smooth surface leaves the input by several times the tolerance of the sizes: then its faces are not what
/// the mesh is adapted to.
template <class Reference>
void warn_of_bulges(const Any_execution& execution, const Curvature_metric_field& field, const Reference& reference,
                    Adaptation_report& report)
{
  constexpr double several = 4;
  if (report.stopped || field.vertices > 0 || !field.corrected) return;
  const double tolerance = field.relative_tolerance * diagonal_of_bounding_box(reference.points);
  const double bulge = surface_bulge(execution, reference, several * tolerance);
  if (bulge == 0) return;
  report.warnings.push_back("the smooth surface leaves the faces of the input by up to " + number(bulge) + ", " +
                            number(std::round(bulge / tolerance)) +
                            " times the tolerance of the sizes: the input is coarse for that. A flat "
                            "reconstruction (`--flat`) keeps to its faces");
}

template <class... Fields, class Reference>
void warn_of_bulges(const Any_execution& execution, const std::variant<Fields...>& chosen, const Reference& reference,
                    Adaptation_report& report)
{
  std::visit([&](const auto& field) { warn_of_bulges(execution, field, reference, report); }, chosen);
}

/// `adapt_surface_mesh` with a policy that is known at run time only: compiled once for all policies.
template <class Domain, class MetricField, class NamedParameters>
Adaptation_report adapt(const Any_execution& execution, const Domain& domain, const MetricField& field,
                        const NamedParameters& np)
{
  static_assert(check_models<typename Domain::Graph, MetricField, NamedParameters>());
  const std::size_t rounds = choose(np, CGAL::internal_np::number_of_iterations, default_number_of_rounds);
  const double shape_weight = shape_weight_of_fit(np);
  Adaptation_visitor nothing;
  auto visitor_parameter = choose(np, CGAL::internal_np::visitor, std::ref(nothing));
  auto& visitor = unwrap(visitor_parameter);
  const auto interruptible = execution.interruptible([&] { return visitor.go_on(); });
  Adaptation_report report = adapt_in_place(interruptible, domain, field, np, [&](const auto& policy, auto& surface) {
    Adaptation_report result =
      Adaptation_driver(policy, surface, visitor)
        .run(rounds, choose(np, internal_np::fit_to_surface, std::false_type()), shape_weight);
    warn_of_bulges(policy, field, surface.reference(), result);
    return result;
  });
  warn_of_missed_number(field, report);
  return report;
}

template <class Execution, class Domain, class MetricField, class NamedParameters>
Adaptation_report adapt_domain(const Execution& execution, const Domain& domain, const MetricField& field,
                               const NamedParameters& np)
{
  Adaptation_report report = adapt(Any_execution(execution), domain, field, np);
  report.execution = Execution::name;
  return report;
}

} // namespace internal

/*!
Adapts a triangulated surface to a metric field, in place: rounds of refinement, simplification, swapping and
relocation, until the edges have length 1 in the metric and the faces are well shaped in it.

The result is the same to the last bit for every execution policy and number of threads. The mesh is replaced in one
step at the end: if anything throws, it is as it was.

\param execution how to run; see `execution.h`. The overload without it takes a `ConcurrencyTag` or a policy type.
\param mesh a model of `MutableFaceGraph` and `FaceListGraph` that lists its elements in the order in which they were
       added once it is cleared, with triangles as faces: an orientable 2-manifold, closed or with boundary, of any
       number of components. Its elements are renumbered; of its property maps the vertex points and those passed below
       are meaningful afterwards, and of the usual types those of the vertices of a `Surface_mesh`, at the vertices that
       are still there. Coordinates are converted to `double`.
\param field what to adapt to, a model of `MetricField`: `Uniform_metric_field`, `Curvature_metric_field`,
       `Solution_metric_field`, `Analytic_metric_field`, an `Intersection_metric_field` of several, a property map from
       vertices to sizes or to `Metric_tensor_3`, or a `std::variant` of these, to choose while the program runs.
\param np named parameters, from `parameters` of this namespace or of CGAL

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of the vertices}
    \cgalParamType{a `ReadWritePropertyMap` with the vertex descriptor as key and `Point_3` as value}
    \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
  \cgalParamNEnd
  \cgalParamNBegin{number_of_iterations}
    \cgalParamDescription{the largest number of rounds}
    \cgalParamType{`unsigned int`}
    \cgalParamDefault{`8`; fewer are done if nothing is left to gain, more if the field asks for a number of vertices
                      or a distance from the surface that is missed}
  \cgalParamNEnd
  \cgalParamNBegin{feature_angle}
    \cgalParamDescription{an edge is a ridge if the normals of its faces differ by more than this; in CAD tessellations by as
                          much, to one degree, but between facets as large as each other; with a `Curvature_metric_field` by
                          a third of it where faces across the edge stay farther away than the tolerance}
    \cgalParamType{`double`, in degrees, above 0 and up to 180}
    \cgalParamDefault{`45`}
  \cgalParamNEnd
  \cgalParamNBegin{detect_features}
    \cgalParamDescription{whether ridges are detected; boundaries and constrained edges are features in any case}
    \cgalParamType{`bool`}
    \cgalParamDefault{`true`}
  \cgalParamNEnd
  \cgalParamNBegin{smooth_borders}
    \cgalParamDescription{whether edges stay on the lines where planes of a CAD tessellation, cylinders and cones end
                          smoothly, as in fillets: curves like ridges, along which the surface has one normal}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{edge_is_constrained_map}
    \cgalParamDescription{edges that are features as ridges are: they stay chains of edges, which are split and
                          collapsed}
    \cgalParamType{a `ReadablePropertyMap` with the edge descriptor as key and `bool` as value; if writable, the feature
                   edges of the result are marked in it, ridges and boundaries included, but not those that follow from
                   labels or charts; with `protect_constraints` those that are protected}
    \cgalParamDefault{no edge is constrained}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_is_constrained_map}
    \cgalParamDescription{vertices that stay where they are}
    \cgalParamType{a `ReadablePropertyMap` with the vertex descriptor as key and `bool` as value; if writable, the
                   vertices are marked again on the result}
    \cgalParamDefault{no vertex is constrained}
  \cgalParamNEnd
  \cgalParamNBegin{protect_constraints}
    \cgalParamDescription{whether constrained edges stay in one piece, neither split nor collapsed nor swapped, and their
                          vertices where they are. They are ridges only where they are sharp.}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{edge_is_protected_map}
    \cgalParamDescription{edges that stay in one piece, where others are constrained only}
    \cgalParamType{as `edge_is_constrained_map`; if writable, they are marked again on the result}
    \cgalParamDefault{none, or those of `edge_is_constrained_map` with `protect_constraints`}
  \cgalParamNEnd
  \cgalParamNBegin{protected_gradation}
    \cgalParamDescription{the largest ratio of the sizes at two points one size apart near protected edges: sizes follow
                          the lengths of these, so that the faces beside them are good. At most 1: they do not}
    \cgalParamType{`double`}
    \cgalParamDefault{`1.5`}
  \cgalParamNEnd
  \cgalParamNBegin{face_patch_map}
    \cgalParamDescription{labels of faces, such as materials. The edges between different ones are features, and each
                          face of the result has the label of where it lies.}
    \cgalParamType{a `ReadablePropertyMap` with the face descriptor as key and any type with `==` as value; if writable,
                   the labels of the result are written to it}
    \cgalParamDefault{all faces have the same}
  \cgalParamNEnd
  \cgalParamNBegin{face_size_bounds_map}
    \cgalParamDescription{the smallest and the largest size in each face of the input; 0: no bound. Sizes grow from there
                          as the gradation wants it. Read, not written}
    \cgalParamType{a `ReadablePropertyMap` with the face descriptor as key and `std::pair<double, double>` as value}
    \cgalParamDefault{no bounds}
  \cgalParamNEnd
  \cgalParamNBegin{face_deviation_map}
    \cgalParamDescription{how far the mesh may be from the surface in each face of the input, where sizes come from a
                          `Curvature_metric_field` without a number of vertices: a length that counts there in place of
                          the tolerance of the field; 0: that. Read, not written. The `tolerance` is another thing, and
                          everywhere the same}
    \cgalParamType{a `ReadablePropertyMap` with the face descriptor as key and `double` as value}
    \cgalParamDefault{everywhere the tolerance of the field}
  \cgalParamNEnd
  \cgalParamNBegin{surface_reconstruction}
    \cgalParamDescription{the surface between the vertices of the input}
    \cgalParamType{a model of `SurfaceReconstruction`}
    \cgalParamDefault{`Gregory_reconstruction`}
  \cgalParamNEnd
  \cgalParamNBegin{fit_to_surface}
    \cgalParamDescription{whether the vertices leave the surface in the end so that the faces run through it, instead of
                          touching it from one side: .2 to .6 of the rms distance, and edges and faces fit the metric a
                          bit less. Corners and constrained vertices stay.}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`: the vertices are on the surface}
  \cgalParamNEnd
  \cgalParamNBegin{shape_weight_of_fit}
    \cgalParamDescription{what the shape of the faces counts in that: the smaller, the nearer and the worse shaped.
                          Small weights take up to four times as long.}
    \cgalParamType{`double`, above 0 and up to 1}
    \cgalParamDefault{`0.02`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_normal_map}
    \cgalParamDescription{the outer normals of the surface at all vertices, of any length but 0; not used at sharp
                          features and boundaries}
    \cgalParamType{a `ReadablePropertyMap` with the vertex descriptor as key and `Vector_3` as value; if writable, the
                   normals at the vertices of the result are left in it, for the next run}
    \cgalParamDefault{estimated from the points, see `estimate_vertex_jets()`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_shape_operator_map}
    \cgalParamDescription{the derivatives of the normal along the surface at all vertices: on a sphere of radius r,
                          `(I - n n^T) / r`; zero where it is not known; not used at sharp features and boundaries}
    \cgalParamType{a `ReadablePropertyMap` with the vertex descriptor as key and `Metric_tensor_3` as value; if
                   writable, that of the result is left in it}
    \cgalParamDefault{estimated from the points, see `estimate_vertex_jets()`}
  \cgalParamNEnd
  \cgalParamNBegin{output_metric_map}
    \cgalParamDescription{where the metric at the vertices of the result is written}
    \cgalParamType{a `WritablePropertyMap` with the vertex descriptor as key and `Metric_tensor_3` as value}
    \cgalParamDefault{not written}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_attribute_maps}
    \cgalParamDescription{values at the vertices that the result is to have, too: interpolated on the input, see
                          `Attribute_interpolator`}
    \cgalParamType{a `std::tuple` of `ReadWritePropertyMap`s with the vertex descriptor as key, or a
                   `std::vector` of those of one type}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{face_attribute_maps}
    \cgalParamDescription{values at the faces that the result is to have, too: those of the face of the input below the
                          centre}
    \cgalParamType{a `std::tuple` of `ReadWritePropertyMap`s with the face descriptor as key, or a
                   `std::vector` of those of one type}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{halfedge_attribute_maps}
    \cgalParamDescription{values at the corners of faces, such as texture coordinates, each at the halfedge that arrives at
                          the corner: interpolated on the input. Edges on whose sides they differ are features, so that no
                          face lies across a seam, and both sides of it keep their own values.}
    \cgalParamType{a `std::tuple` of `ReadWritePropertyMap`s with the halfedge descriptor as key, or a
                   `std::vector` of those of one type; values have `==`}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_origin_map}
    \cgalParamDescription{where the vertex of the input that a vertex was is written}
    \cgalParamType{a `WritablePropertyMap` with the vertex descriptor as key and as value the same, of which new vertices
                   get the null value, or a number: the place of the vertex in the input, and for new ones that of
                   `std::size_t(-1)`}
    \cgalParamDefault{not written}
  \cgalParamNEnd
  \cgalParamNBegin{face_origin_map}
    \cgalParamDescription{where the face of the input below the centre of a face is written}
    \cgalParamType{the same for faces}
    \cgalParamDefault{not written}
  \cgalParamNEnd
  \cgalParamNBegin{tolerance}
    \cgalParamDescription{the largest Hausdorff distance between the triangles of the mesh as it is and as it will be:
                          operations that leave it are refused, and the distance is bounded in the end, see
                          `surface_distance.h`. If it is too large all is done again, up to three times, and the visitor
                          sees the rounds again. Takes several times the time.}
    \cgalParamType{`double`, a length, positive}
    \cgalParamDefault{infinity, that is none}
  \cgalParamNEnd
  \cgalParamNBegin{avoid_self_intersections}
    \cgalParamDescription{whether no faces of the result meet, but for those over faces of the input that do or that are
                          beside such. Where sheets are nearer to each other than the sizes allow, these get finer, also
                          than a smallest size, and where the gap is too narrow for that, triangles of the input stay.
                          All may be done again, up to twelve times, and the visitor sees the rounds again. See
                          `self_intersections.h`}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{count_self_intersections}
    \cgalParamDescription{whether the report has the numbers of pairs of faces that meet, before and after}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_number_of_vertices}
    \cgalParamDescription{a metric that asks for more vertices is refused before anything is split, and refinement stops
                          before there are more}
    \cgalParamType{`std::size_t`}
    \cgalParamDefault{what the indices and the memory of the machine can hold}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{follows the run and may stop it; where all is done again it sees the rounds again}
    \cgalParamType{a model of `AdaptationVisitor`, or a `std::reference_wrapper` of one}
    \cgalParamDefault{`Adaptation_visitor`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\returns sizes, conformity and quality before and after, and what each kernel did

\throws Invalid_input_error one of those derived from it, if the mesh, the metric or a map is not as above;
        `Empty_mesh_error`; `Invalid_parameter_error`; `Mesh_too_large_error`; `Tolerance_error` if the tolerance could not
        be kept; `Self_intersection_error` if faces that meet could not be avoided. All derive from `Adaptation_error`.
        What maps, formulas and visitors throw passes through. The mesh is as it was in any case.
\par Complexity
O(n log n) time, O(n) memory, for n the larger of the numbers of input and output vertices
*/
template <class Execution, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
auto adapt_surface_mesh(const Execution& execution, TriangleMesh& mesh, const MetricField& field,
                        const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), Adaptation_report())
{
  return internal::adapt_domain(execution, internal::Whole_mesh<TriangleMesh>(mesh), field, np);
}

/*!
Adapts a range of the faces of a mesh. All others stay, with their vertices and edges, to the last bit, and so do the values
of property maps there, passed or not. The edges between the range and the rest are protected, as those of
`protect_constraints`. Vertices of the range that are still there keep their descriptors.

\param faces a range of face descriptors of `mesh`
\param execution, mesh, field, np as for a whole mesh; lengths relative to a bounding box are those of the faces of the range
       and of two rings of faces around them

\par Complexity
as for a mesh of these faces, and one pass over the faces of `mesh`
*/
template <class Execution, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
auto adapt_surface_mesh(const Execution& execution, const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                        const NamedParameters& np = CGAL::parameters::default_values())
  -> decltype(execution.concurrency(), Adaptation_report())
{
  return internal::adapt_domain(execution, internal::Part_of_mesh<TriangleMesh>(faces, mesh), field, np);
}

/// The same with the policy as a template parameter: `CGAL::Sequential_tag`, `CGAL::Parallel_tag`,
/// `CGAL::Parallel_if_available_tag`, or an execution policy of this package.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_mesh<TriangleMesh, MetricField>>
Adaptation_report adapt_surface_mesh(TriangleMesh& mesh, const MetricField& field,
                                     const NamedParameters& np = CGAL::parameters::default_values())
{
  return adapt_surface_mesh(typename internal::Execution_of<ConcurrencyTag>::type(), mesh, field, np);
}

/// The same for a range of faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceRange, class TriangleMesh, class MetricField,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class = internal::If_faces<FaceRange, TriangleMesh>>
Adaptation_report adapt_surface_mesh(const FaceRange& faces, TriangleMesh& mesh, const MetricField& field,
                                     const NamedParameters& np = CGAL::parameters::default_values())
{
  return adapt_surface_mesh(typename internal::Execution_of<ConcurrencyTag>::type(), faces, mesh, field, np);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_ADAPT_SURFACE_MESH_H

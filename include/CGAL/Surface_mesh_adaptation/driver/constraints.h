// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the user asks of edges and vertices, from his maps to the detection of features, and back.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CONSTRAINTS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CONSTRAINTS_H

#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/parameters.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>

#include <CGAL/boost/graph/iterator.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// How fast sizes come back to those of the metric with the distance from protected edges; at most 1: they do not follow
/// these.
/// \throws Invalid_parameter_error
template <class NamedParameters>
double protected_gradation(const NamedParameters& np)
{
  const double gradation = choose(np, internal_np::protected_gradation, default_gradation);
  if (!std::isfinite(gradation)) throw Invalid_parameter_error("the gradation at protected edges must be finite");
  return gradation;
}

/// Parameters of the detection of features, with the constraints read from the user's maps.
/// \throws Invalid_parameter_error
template <class FaceGraph, class NamedParameters>
Feature_parameters feature_parameters(const FaceGraph& graph, const Imported_mesh<FaceGraph>& imported,
                                      const NamedParameters& np)
{
  Feature_parameters p;
  p.ridge_angle = choose(np, internal_np::feature_angle, p.ridge_angle);
  p.detect_ridges = choose(np, internal_np::detect_features, p.detect_ridges);
  p.smooth_borders = choose(np, internal_np::smooth_borders, p.smooth_borders);
  if (!(p.ridge_angle > 0 && p.ridge_angle <= 180))
    throw Invalid_parameter_error("the feature angle must lie between 0 and 180 degrees");
  const auto is_in = [&](const auto& map) {
    return [&graph, &imported, map](Index h) -> bool { return get(map, edge(imported.halfedges[h], graph)); };
  };
  if constexpr (has_parameter<NamedParameters, CGAL::internal_np::edge_is_constrained_t>) {
    const bool are_protected = choose(np, CGAL::internal_np::protect_constraints, false);
    p.constrain(imported.mesh, are_protected ? Edge_constraint::protect : Edge_constraint::crease,
                is_in(CGAL::parameters::get_parameter(np, CGAL::internal_np::edge_is_constrained)));
  }
  if constexpr (has_parameter<NamedParameters, internal_np::edge_is_protected_map_t>)
    p.constrain(imported.mesh, Edge_constraint::protect,
                is_in(CGAL::parameters::get_parameter(np, internal_np::edge_is_protected_map)));
  if constexpr (has_parameter<NamedParameters, CGAL::internal_np::vertex_is_constrained_t>) {
    const auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_is_constrained);
    for (const auto v : imported.vertices) p.vertex_is_constrained.push_back(get(map, v) ? 1 : 0);
  }
  return p;
}

/// Marks in `map` the edges at faces of `domain`, but for those at others, for which `predicate(h)`, of the halfedge `h`
/// of the view, which is the same on both sides.
template <class Domain, class Map, class Predicate>
void mark_edges(const Domain& domain, Map map, const Predicate& predicate)
{
  domain.for_each_face([&](Index f, const auto& face) {
    Index h = 3 * f;
    for (const auto g : CGAL::halfedges_around_face(halfedge(face, domain.graph()), domain.graph())) {
      if (domain.owns_edge(h)) put(map, edge(g, domain.graph()), predicate(h));
      ++h;
    }
  });
}

/// Whether the halfedge `h` of the result is one of the input that was asked to be protected: others may have been, so that
/// faces do not meet.
template <class Surface>
bool is_asked_to_be_protected(const Surface& surface, const Feature_parameters& features, Index h)
{
  if (!surface.mesh.is_protected(h) || features.halfedge_constraint.empty()) return false;
  const Index v = surface.origin[surface.mesh.source(h)], w = surface.origin[surface.mesh.target(h)];
  const Index before = v != no_index && w != no_index ? surface.reference().mesh.any_halfedge(v, w) : no_index;
  return before != no_index && features.halfedge_constraint[before] >= Edge_constraint::protect;
}

/// Marks the constrained elements of the result in the user's maps, where these can be written.
template <class Domain, class Surface, class NamedParameters>
void write_constraints(const Domain& domain, const Surface& surface, const Feature_parameters& features,
                       const NamedParameters& np)
{
  if constexpr (has_writable_map<NamedParameters, CGAL::internal_np::vertex_is_constrained_t>()) {
    auto map = CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_is_constrained);
    domain.for_each_vertex([&](Index i, const auto& v) {
      const Index o = surface.origin[i];
      put(map, v, o != no_index && features.vertex_is_constrained[o] != 0);
    });
  }
  const auto is_protected = [&](Index h) { return is_asked_to_be_protected(surface, features, h); };
  if constexpr (has_writable_map<NamedParameters, CGAL::internal_np::edge_is_constrained_t>()) {
    const bool are_protected = choose(np, CGAL::internal_np::protect_constraints, false);
    mark_edges(domain, CGAL::parameters::get_parameter(np, CGAL::internal_np::edge_is_constrained),
               [&](Index h) { return are_protected ? is_protected(h) : surface.mesh.is_shaped(h); });
  }
  if constexpr (has_writable_map<NamedParameters, internal_np::edge_is_protected_map_t>())
    mark_edges(domain, CGAL::parameters::get_parameter(np, internal_np::edge_is_protected_map), is_protected);
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_CONSTRAINTS_H

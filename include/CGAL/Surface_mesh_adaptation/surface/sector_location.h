// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the corners of an adapted mesh are in the faces of the input: at features, where one vertex belongs to several
// smooth sectors, on the side of the face whose corner it is.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_LOCATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_LOCATION_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The halfedge on a curve that bounds the smooth sector of the halfedge `h` at its source, clockwise; `no_index` if there
/// is none.
inline Index first_of_sector(const Mesh_view& mesh, Index h)
{
  Index g = h;
  do {
    if (mesh.curve[g] < merged_curve) return g;
    g = mesh.rotated_cw(g);
  } while (g != h && g != no_index);
  return no_index;
}

/// Whether the halfedge `h`, on `curve`, leads along it.
template <class Surface>
bool leads_forward(const Surface& surface, Index curve, Index h)
{
  const auto& at = surface.locations;
  const auto arc = surface.reference().arc(curve, at[surface.mesh.source(h)], at[surface.mesh.target(h)]);
  return arc.second > arc.first;
}

/// The location of the source of `h` in a face of the reference on the side of the face of `h`, its first one clockwise: on an
/// edge or at a corner of that where the vertex is on a feature.
template <class Surface>
Location location_in_sector(const Surface& surface, Index h)
{
  const Mesh_view& mesh = surface.mesh;
  const auto& reference = surface.reference();
  const Index v = mesh.source(h);
  const Location& l = surface.locations[v];
  if (l.kind == Vertex_class::smooth) return l;
  const Index g = first_of_sector(mesh, h);
  const bool is_corner = l.kind == Vertex_class::corner;
  if (g == no_index && is_corner) return location_on_edge(reference.mesh.outgoing[l.cell], 0);
  const Index curve = is_corner ? mesh.curve[g] : l.cell;
  const Feature_curve& c = reference.features.curves[curve];
  const bool is_forward = g == no_index || leads_forward(surface, curve, g);
  const std::size_t i = !is_corner ? c.segment(l.u) : is_forward ? 0 : c.vertices.size() - 2;
  const double t = !is_corner ? c.parameter(i, l.u) : is_forward ? 0 : 1;
  const Index a = c.vertices[i], b = c.vertices[i + 1];
  const Index forward = reference.mesh.halfedge(a, b), backward = reference.mesh.halfedge(b, a);
  // at the boundary there is only one, which an edge along more than half of a closed curve takes for the other one
  const bool takes_forward = backward == no_index || (is_forward && forward != no_index);
  return takes_forward ? location_on_edge(forward, t) : location_on_edge(backward, 1 - t);
}

/// The normal of the reference there, between those of Max.
template <class Surface>
Vector_3 normal_in_sector(const Surface& surface, Index h)
{
  return surface.reference().flat_surface_point(location_in_sector(surface, h)).normal;
}

/// The location as a start of walks: a little inside of the face, where all ways are open.
template <class Surface>
auto start_in_sector(const Surface& surface, Index h)
{
  constexpr double inwards = 1e-3, kept = 1 - 3 * inwards;
  Location l = location_in_sector(surface, h);
  l.u = kept * l.u + inwards;
  l.v = kept * l.v + inwards;
  return typename Surface::Reference::Located_point{l, surface.reference().evaluate(l)};
}

/// The face of the reference below the centroid of the face `f`, found by walks from its corners within their sector.
template <class Surface>
Index face_below(const Surface& surface, Index f)
{
  constexpr double precision = 0.01; // of the distance of a corner from the centroid
  const Mesh_view& mesh = surface.mesh;
  const auto& reference = surface.reference();
  const auto point = [&](Index i) { return surface.points[mesh.corner[3 * std::size_t(f) + i]]; };
  const Vector_3 centroid = (point(0) + point(1) + point(2)) / 3;
  Index best = no_index;
  double least = 0;
  for (Index i = 0; i < 3; ++i) {
    const auto found =
      reference.locate(start_in_sector(surface, 3 * f + i), centroid, precision * (point(i) - centroid).norm());
    const double distance = (found.point.position - centroid).squaredNorm();
    if (best != no_index && distance >= least) continue;
    best = found.location.cell;
    least = distance;
  }
  return best;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_LOCATION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the features of a mesh are: curves along ridges, boundaries and constrained edges, and corners.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURES_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/numerics/small_matrices.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// How a vertex may move: on the surface, along its feature curve, or not at all.
enum class Vertex_class : std::uint8_t { smooth, curve, corner };

/// A chain of feature edges from corner to corner, or closed without a corner (first and last vertex equal).
struct Feature_curve
{
  std::vector<Index> vertices;  ///< from end to end
  std::vector<double> arc_length;  ///< of each vertex from the first, along the chords
  std::vector<Vector_3> tangents;  ///< unit, in the direction of the chain
  std::vector<std::array<Vector_3, 2>> ends; ///< tangents at the ends of each edge: as above, or the direction of the
                                             ///< edge where the curve stays on it
  bool closed = false;             ///< whether the chain is a cycle that no corner interrupts

  bool is_closed() const { return closed; }  ///< the same, as a question
  double length() const { return arc_length.back(); }  ///< of the chords

  /// The edge of the chain that contains arc length `s`.
  std::size_t segment(double s) const
  {
    const auto after = std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, s);
    return std::size_t(after - arc_length.begin()) - 1;
  }

  /// Position of arc length `s` in segment `i`, in [0, 1].
  double parameter(std::size_t i, double s) const
  {
    const double length_of_segment = arc_length[i + 1] - arc_length[i];
    return length_of_segment > 0 ? (std::min)(1.0, (std::max)(0.0, (s - arc_length[i]) / length_of_segment)) : 0;
  }
};

/// The place of a curve vertex on its curve.
struct Curve_node
{
  Index curve = no_curve;  ///< which one
  Index index = 0;  ///< of the vertex in it
};

/// What a user asks of an edge.
enum class Edge_constraint : std::uint8_t {
  none,
  border,      ///< a feature, but a ridge only if it is one: two labels or charts meet there
  crease,      ///< a feature as ridges are
  protect,     ///< as a border, and it stays in one piece between vertices that stay where they are
  protected_crease ///< both of the last two
};

/// What is asked of an edge of which both are asked.
inline Edge_constraint combined(Edge_constraint a, Edge_constraint b)
{
  const Edge_constraint weaker = (std::min)(a, b), stronger = (std::max)(a, b);
  const bool are_both = weaker == Edge_constraint::crease && stronger == Edge_constraint::protect;
  return are_both ? Edge_constraint::protected_crease : stronger;
}

/// What the user asks for and constrains; entries are per element of the mesh view, empty for "none".
struct Feature_parameters
{
  bool detect_ridges = true;  ///< else only boundaries and what is constrained are features
  double ridge_angle = 45;    ///< degrees: an edge is a ridge if the normals of its faces differ by more
  double corner_angle = 60;   ///< degrees: a curve that turns by more at a vertex has a corner there
  bool smooth_borders = false; ///< whether planes keep their outlines where something curved joins them smoothly
  std::vector<Edge_constraint> halfedge_constraint; ///< the same on both sides
  std::vector<std::uint8_t> vertex_is_constrained;  ///< vertices that are corners
  std::vector<double> largest_bulge; ///< of curves over the edges that end at a vertex, about

  /// Asks `constraint`, besides what is asked already, of the edges with a halfedge for which `predicate(h)`. A map of a user
  /// may know an edge from one side only: that of a cell complex, kept in a `std::set`.
  template <class Predicate>
  void constrain(const Mesh_view& mesh, Edge_constraint constraint, const Predicate& predicate)
  {
    halfedge_constraint.resize(mesh.number_of_halfedges(), Edge_constraint::none);
    for (Index h = 0; h < mesh.number_of_halfedges(); ++h) {
      const Edge_constraint both = combined(halfedge_constraint[h], constraint);
      if (both == halfedge_constraint[h] || !predicate(h)) continue;
      halfedge_constraint[h] = both;
      if (!mesh.is_border(h)) halfedge_constraint[mesh.twin[h]] = both;
    }
  }
};

/// `Feature_parameters::largest_bulge` over the edge between `v` and `w`; infinite if nothing is asked.
inline double largest_bulge_of_edge(const std::vector<double>& largest_bulge, Index v, Index w)
{
  if (largest_bulge.empty()) return std::numeric_limits<double>::infinity();
  return (std::min)(largest_bulge[v], largest_bulge[w]);
}

/// All features of a mesh.
struct Features
{
  std::vector<Vertex_class> vertex_class;  ///< of each vertex
  std::vector<Curve_node> node_of_vertex;  ///< of curve vertices; of a closed chain's first vertex, index 0
  std::vector<Feature_curve> curves;  ///< all of them
  Facets facets;  ///< of CAD tessellations

  /// Unit tangent, in the direction of the chain, of `curve` at the vertex `v` of its edge between `v` and `w`.
  const Vector_3& tangent(Index curve, Index v, Index w) const
  {
    const Feature_curve& c = curves[curve];
    const std::size_t i = vertex_class[v] == Vertex_class::curve ? node_of_vertex[v].index : 0;
    if (c.vertices[i] == v && c.vertices[i + 1] == w) return c.ends[i][0];
    return vertex_class[v] == Vertex_class::curve && i > 0 ? c.ends[i - 1][1] : c.ends.back()[1];
  }
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_FEATURES_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the vertices and edges of the input are from an adapted mesh, while that changes at some places.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_INPUT_DEVIATIONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_INPUT_DEVIATIONS_H

#include <CGAL/Surface_mesh_adaptation/distance/Face_keys.h>
#include <CGAL/Surface_mesh_adaptation/distance/Triangle_tree.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/surface_bulge.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The distances of the vertices of the input from a mesh and those of the surface at its edges: what faces cut off where
/// the surface bends most. Which faces are next to vertices and edges is known from the last time.
template <class Surface>
class Input_deviations
{
public:
  /// How far a place of the input is.
  struct Entry
  {
    Index face;      ///< next to it
    Index of_input;  ///< the vertex of the input, or a halfedge along its edge
    double distance; ///< as it counts
  };

  /// The surface must outlive this.
  explicit Input_deviations(const Surface& surface)
    : surface_(surface), input_(surface.reference().mesh), points_(surface.reference().points), keys_(points_.size(), 0)
  {}

  /// Measures what is next to a face that was not there the last time. Distances count as many times as `weight(f)` says for
  /// faces `f` of the input. Along edges those within `enough` may be left out, and others are up to a twentieth larger.
  /// \pre `keys` are those of the faces of the mesh, none of which is removed
  /// \par Complexity
  /// O(n) and O(log n) for each of these vertices and edges, times the faces that an edge crosses
  template <class Execution, class Weight>
  std::vector<Entry> update(const Execution& execution, const Face_keys& keys, double enough, const Weight& weight)
  {
    std::vector<std::uint8_t> is_lost(points_.size());
    for_each_index(execution, is_lost.size(), [&](std::size_t v) { is_lost[v] = keys.face(keys_[v]) == no_index; });
    const std::vector<Index> vertices = pack(execution, is_lost.size(), [&](std::size_t v) { return is_lost[v] != 0; });
    const std::vector<Index> edges = lost_edges(execution, is_lost, keys);
    if (vertices.empty() && edges.empty()) return {};
    const Triangle_tree tree(execution, surface_.mesh, surface_.points);
    std::vector<Entry> entries = measure_vertices(execution, tree, vertices, weight);
    for (const Entry& e : entries) keys_[e.of_input] = keys[e.face];
    const std::vector<Entry> along = measure_edges(execution, tree, keys, edges, enough, weight);
    for (const Entry& e : along) crossed_.push_back({e.of_input, keys[e.face]});
    entries.insert(entries.end(), along.begin(), along.end());
    return entries;
  }

private:
  /// A face that an edge passes between those next to its ends.
  struct Crossed_face
  {
    Index edge;
    std::uint64_t key;
  };

  /// A place on an edge.
  struct Place
  {
    double at;        ///< from 0 at the source to 1
    Vector_3 point;
    std::size_t near; ///< place in the tree of the triangle next to it
  };

  /// A part of an edge that leaves its chord by about `bulge`.
  struct Part
  {
    Place from, to;
    double bulge;
  };

  /// Edges with an end that is lost, or a face between them; of the others the faces between the ends stay known.
  template <class Execution>
  std::vector<Index> lost_edges(const Execution& execution, const std::vector<std::uint8_t>& is_vertex_lost,
                                const Face_keys& keys)
  {
    std::vector<std::uint8_t> is_lost(input_.number_of_halfedges());
    for_each_index(execution, is_lost.size(), [&](std::size_t h) {
      is_lost[h] = input_.is_edge_owner(Index(h)) &&
                   (is_vertex_lost[input_.source(Index(h))] != 0 || is_vertex_lost[input_.target(Index(h))] != 0);
    });
    for (const Crossed_face& c : crossed_)
      if (keys.face(c.key) == no_index) is_lost[c.edge] = 1;
    const auto is_of_lost = [&](const Crossed_face& c) { return is_lost[c.edge] != 0; };
    crossed_.erase(std::remove_if(crossed_.begin(), crossed_.end(), is_of_lost), crossed_.end());
    return pack(execution, is_lost.size(), [&](std::size_t h) { return is_lost[h] != 0; });
  }

  template <class Execution, class Weight>
  std::vector<Entry> measure_vertices(const Execution& execution, const Triangle_tree& tree,
                                      const std::vector<Index>& vertices, const Weight& weight) const
  {
    const auto largest_weight = [&](Index v) {
      double largest = 0;
      input_.for_each_outgoing(v, [&](Index h) { largest = (std::max)(largest, weight(Mesh_view::face(h))); });
      return largest;
    };
    std::vector<Entry> entries(vertices.size());
    for_each_chunk(execution, vertices.size(), default_chunk_length, [&](std::size_t, std::size_t begin, std::size_t end) {
      std::size_t guess = vertices[begin] * tree.size() / points_.size(); // both are in order along one curve, more or less
      for (std::size_t i = begin; i < end; ++i) {
        const Index v = vertices[i];
        const Vector_3& p = points_[v];
        const Triangle_tree::Nearest nearest = tree.nearest(p, tree.towards(p, guess));
        guess = nearest.triangle;
        entries[i] = {tree.face(guess), v, largest_weight(v) * std::sqrt(nearest.squared_distance)};
      }
    });
    return entries;
  }

  template <class Execution, class Weight>
  std::vector<Entry> measure_edges(const Execution& execution, const Triangle_tree& tree, const Face_keys& keys,
                                   const std::vector<Index>& edges, double enough, const Weight& weight) const
  {
    const auto larger_weight = [&](Index h) {
      const double here = weight(Mesh_view::face(h));
      return input_.is_border(h) ? here : (std::max)(here, weight(Mesh_view::face(input_.twin[h])));
    };
    return gather<Entry>(execution, edges.size(), heavy_chunk_length,
                         [&](std::size_t begin, std::size_t end, std::vector<Entry>& entries) {
      for (std::size_t i = begin; i < end; ++i) {
        const double w = larger_weight(edges[i]);
        const std::size_t first = entries.size();
        measure_edge(tree, keys, edges[i], enough / w, entries);
        for (std::size_t k = first; k < entries.size(); ++k) entries[k].distance *= w;
      }
    });
  }

  /// Halves the edge of `h` until each part is above a triangle next to one of its ends: the distance from a triangle is
  /// convex, so that along a chord it is largest at an end. Parts of a curve bulge by a quarter of what the whole does.
  void measure_edge(const Triangle_tree& tree, const Face_keys& keys, Index h, double enough,
                    std::vector<Entry>& entries) const
  {
    const auto end = [&](double at, Index v) { return Place{at, points_[v], tree.place(keys.face(keys_[v]))}; };
    const double length = (points_[input_.target(h)] - points_[input_.source(h)]).norm();
    Ring<Part> parts{{end(0, input_.source(h)), end(1, input_.target(h)), is_flat ? 0 : largest_bulge_of_patches * length}};
    double largest = (std::max)(distance(tree, parts[0].from), distance(tree, parts[0].to));
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      if (part.to.at - part.from.at <= smallest_part) continue;
      if (is_bounded(tree, part, (std::max)(enough, (1 + precision) * largest) - part.bulge)) continue;
      const double at = (part.from.at + part.to.at) / 2;
      Place middle{at, surface_.point(location_on_edge(h, at)), part.from.near};
      middle.near = tree.towards(middle.point, middle.near);
      double d = distance(tree, middle);
      if (d > enough) {
        middle.near = tree.nearer_than({d * d, middle.near}, middle.point).triangle;
        d = distance(tree, middle);
        largest = (std::max)(largest, d);
      }
      entries.push_back({tree.face(middle.near), h, d > enough ? d : 0});
      const double bulge = is_flat ? 0 : (middle.point - (part.from.point + part.to.point) / 2).norm() / 4;
      parts.push_back({part.from, middle, bulge});
      parts.push_back({middle, part.to, bulge});
    }
  }

  static double distance(const Triangle_tree& tree, const Place& p)
  {
    return std::sqrt(squared_distance_to_triangle(p.point, tree[p.near]));
  }

  static bool is_bounded(const Triangle_tree& tree, const Part& part, double bound)
  {
    const auto is_near = [&](const Place& p, std::size_t i) {
      return squared_distance_to_triangle(p.point, tree[i]) <= bound * bound;
    };
    if (!(bound > 0)) return false;
    return (is_near(part.from, part.from.near) && is_near(part.to, part.from.near)) ||
           (is_near(part.to, part.to.near) && is_near(part.from, part.to.near)) ||
           distance(tree, part.from) + distance(tree, part.to) + (part.to.point - part.from.point).norm() <= 2 * bound;
  }

  static constexpr double precision = 0.05;           // of distances along edges
  static constexpr double smallest_part = 1.0 / 1024; // of an edge, for what is enough may be lost in rounding
  static constexpr bool is_flat = Surface::Reference::is_flat;

  const Surface& surface_;
  const Mesh_view& input_;
  const std::vector<Vector_3>& points_;
  std::vector<std::uint64_t> keys_;   // of the face next to each vertex
  std::vector<Crossed_face> crossed_; // by edges, but those next to their ends
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DISTANCE_INPUT_DEVIATIONS_H

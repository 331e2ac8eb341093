// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices around a vertex, ring by ring, on its own side of the features: what a local fit is made from.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_NEIGHBORHOOD_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_NEIGHBORHOOD_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The neighbourhood of a smooth sector of a vertex: what can be reached from its faces over faces that share a vertex,
/// without crossing a crease or the boundary, or into a plane of the shape or a facet that is far
/// larger or smaller than the first one. The vertex itself does not belong to it.
class Sector_neighborhood
{
public:
  /// The first ring: the neighbours of the source of `first` in the `n` faces of its sector from that of `first` on.
  Sector_neighborhood(const Mesh_view& mesh, Index first, std::size_t n, const Facets* facets = nullptr)
    : mesh_(mesh), facets_(facets), center_(mesh.source(first))
  {
    if (facets && !facets->empty()) area_ = facets->at(Mesh_view::face(first)).area;
    append(Mesh_view::next(first));
    for (Index h = first; n > 0; --n, h = mesh.rotated_ccw(h))
      if (mesh.apex(h) != vertices_[0]) append(Mesh_view::previous(h));
  }

  std::size_t size() const { return vertices_.size(); }
  Index operator[](std::size_t i) const { return vertices_[i]; }

  /// Adds the next ring. A hub has neighbours enough: then nothing is added.
  void grow()
  {
    if (size() >= hub_degree) return;
    const std::size_t begin = last_ring_, end = size();
    last_ring_ = end;
    for (std::size_t i = begin; i < end; ++i) add_fan(corners_[i]);
  }

  /// Calls `f(h)` for a halfedge that leaves the neighbour `i` in each face around it, from the one it was found in
  /// both ways to the next feature.
  template <class F>
  void for_each_face_around(std::size_t i, const F& f) const
  {
    f(corners_[i]);
    walk_around(corners_[i], f, f);
  }

private:
  /// Calls `after(g)` or `before(g)` for the halfedges that leave the source of `h` in the other faces of its fan:
  /// those on the way counterclockwise, then those clockwise.
  template <class After, class Before>
  void walk_around(Index h, const After& after, const Before& before) const
  {
    Index g = h;
    for (int i = 0; i < longest_walk && can_cross(Mesh_view::previous(g)); ++i) {
      g = mesh_.rotated_ccw(g);
      if (g == h) return;
      after(g);
    }
    g = h;
    for (int i = 0; i < longest_walk && can_cross(g); ++i) {
      g = mesh_.rotated_cw(g);
      if (g == h) return;
      before(g);
    }
  }

  static constexpr std::size_t hub_degree = 32;
  static constexpr int longest_walk = 6; // faces each way: the whole fan of usual vertices, what is near of a hub's

  /// Adds the vertices of the faces around the source of `h`: each face has one that the last one had not.
  void add_fan(Index h)
  {
    add(Mesh_view::next(h));
    add(Mesh_view::previous(h));
    walk_around(h, [&](Index g) { add(Mesh_view::previous(g)); }, [&](Index g) { add(Mesh_view::next(g)); });
  }

  bool can_cross(Index h) const
  {
    return !mesh_.is_crease(h) && !mesh_.is_border(h) && is_akin(Mesh_view::face(mesh_.twin[h]));
  }

  /// Whether face `f` may be of the same smooth piece: the curvature jumps where planes and rulings begin.
  bool is_akin(Index f) const
  {
    if (!facets_ || facets_->empty()) return true;
    const Facet& facet = facets_->at(f);
    if (facet.is_plane) return false;
    return !facets_->are_chords() || are_alike(facet.area, area_, largest_ratio_in_nets);
  }

  void add(Index corner)
  {
    const Index v = mesh_.source(corner);
    if (v == center_ || v == vertices_.back()) return;
    if ((seen_ & bit_of(v)) == 0 || std::find(vertices_.begin(), vertices_.end(), v) == vertices_.end()) append(corner);
  }

  /// One of 64, the same for equal vertices: most of those that are not there yet need not be looked for.
  static std::uint64_t bit_of(Index v) { return std::uint64_t(1) << (v % 64); }

  void append(Index corner)
  {
    corners_.push_back(corner);
    vertices_.push_back(mesh_.source(corner));
    seen_ |= bit_of(vertices_.back());
  }

  const Mesh_view& mesh_;
  const Facets* facets_; ///< those that may have planes, or null
  double area_ = 0;      ///< of the first facet
  Index center_;
  std::size_t last_ring_ = 0;
  std::uint64_t seen_ = 0; ///< the bits of all vertices
  boost::container::small_vector<Index, 48> vertices_, corners_; // corner: one of the vertex, in the neighbourhood
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_SECTOR_NEIGHBORHOOD_H

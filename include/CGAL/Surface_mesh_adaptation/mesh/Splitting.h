// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits a few edges where they are: work in proportion to these, where a rewrite of the mesh (restructure.h) would touch
// everything. The first of the faces that a face becomes takes its number. The others come behind all faces, and the new
// vertices behind all vertices, in the order of the faces that they are numbered with.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_SPLITTING_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_SPLITTING_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/restructure.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

class Splitting
{
public:
  /// Plans to split the edges marked in `codes` (one code per face; both faces of an edge mark it). `faces` are all that
  /// have marks, and maybe others, in increasing order.
  template <class Execution>
  Splitting(const Execution& execution, const Mesh_view& mesh, const Buffer<std::uint8_t>& codes,
            const std::vector<Index>& faces)
    : mesh_(mesh), codes_(codes), faces_(faces), old_vertices_(Index(mesh.number_of_vertices())),
      old_faces_(Index(mesh.number_of_faces()))
  {
    resize_and_forget(place_, old_faces_);
    for_each_index(execution, faces.size(), [&](std::size_t i) { place_[faces[i]] = Index(i); });
    new_vertices_ = exclusive_scan(execution, faces.size(), vertex_offset_, [&](std::size_t i) {
      return midpoints_before(3 * faces[i], 3 * faces[i] + 3);
    });
    new_faces_ = exclusive_scan(execution, faces.size(), face_offset_, [&](std::size_t i) {
      return Index(internal::Split_pattern::of(codes[faces[i]]).number_of_children - 1);
    });
  }

  Index number_of_vertices() const { return old_vertices_ + new_vertices_; } ///< afterwards
  Index number_of_faces() const { return old_faces_ + new_faces_; }          ///< afterwards

  /// Number of the new vertex on the edge of `h`.
  Index midpoint(Index h) const
  {
    const Index o = mesh_.edge_owner(h), f = Mesh_view::face(o);
    return old_vertices_ + vertex_offset_[place_[f]] + midpoints_before(3 * f, o);
  }

  /// \pre `mesh` is that which was planned for, and `codes` have the same marks
  template <class Execution>
  void apply(const Execution& execution, Mesh_view& mesh) const
  {
    Buffer<internal::Cut_face> cuts(faces_.size()); // first all is read, then all is written
    for_each_cut_face(execution, [&](Index f) { cuts[place_[f]] = cut_of(f); });
    mesh.corner.resize(3 * std::size_t(number_of_faces()));
    mesh.twin.resize(mesh.corner.size());
    mesh.curve.resize(mesh.corner.size());
    if (mesh.has_labels()) mesh.label.resize(number_of_faces());
    mesh.outgoing.resize(number_of_vertices());
    for_each_cut_face(execution, [&](Index f) { write(mesh, f, cuts[place_[f]]); });
  }

private:
  template <class Execution, class F>
  void for_each_cut_face(const Execution& execution, const F& f) const
  {
    for_each_index(execution, faces_.size(), [&](std::size_t i) {
      if (is_cut(faces_[i])) f(faces_[i]);
    });
  }

  bool is_cut(Index f) const { return codes_[f] != 0; }

  /// Vertices numbered with the halfedges in `[begin, end)` of a face.
  Index midpoints_before(Index begin, Index end) const
  {
    Index n = 0;
    for (Index h = begin; h < end; ++h)
      n += (codes_[h / 3] >> h % 3 & 1) != 0 && mesh_.is_edge_owner(h) ? 1 : 0;
    return n;
  }

  /// That of halfedge `i` of the children of `f`.
  Index number(Index f, int i) const
  {
    return Index(i) + 3 * (i < 3 ? f : old_faces_ + face_offset_[place_[f]] - 1);
  }

  internal::Cut_face cut_of(Index f) const
  {
    return internal::cut_face(
      mesh_, f, codes_[f], [&](Index h) { return mesh_.corner[h]; }, [&](Index h) { return midpoint(h); },
      [&](Index h, std::size_t k) {
        const Index g = Mesh_view::face(h);
        return is_cut(g) ? number(g, internal::Split_pattern::of(codes_[g]).half[h % 3][k]) : h;
      });
  }

  void write(Mesh_view& mesh, Index f, const internal::Cut_face& cut) const
  {
    internal::write_children(mesh, f, cut, [&](int i) { return number(f, i); }, mesh);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index t = cut.twin[2 * i];
      if (t < 3 * old_faces_ && !is_cut(Mesh_view::face(t)))
        mesh.twin[t] = number(f, internal::Split_pattern::of(cut.code).half[i][0]);
    }
  }

  const Mesh_view& mesh_;
  const Buffer<std::uint8_t>& codes_;
  const std::vector<Index>& faces_;
  Index old_vertices_, old_faces_, new_vertices_ = 0, new_faces_ = 0;
  Buffer<Index> place_;                       // among `faces_`
  Buffer<Index> vertex_offset_, face_offset_; // of each of these
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_SPLITTING_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rewrites a mesh view with some edges split and without its holes, in parallel and without a conflict graph.
//
// Every face becomes 0 (removed) to 4 faces at the place of the old one, and every vertex is numbered with the face of
// its `outgoing` halfedge, a new one with the face of the halfedge that owns its edge. Hence neighbours in space stay
// neighbours in memory, and all ids follow from two prefix sums. Each new face is written by its parent alone.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_MESH_RESTRUCTURE_H
#define CGAL_SURFACE_MESH_ADAPTATION_MESH_RESTRUCTURE_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

namespace internal {

/// How a face with a given set of split edges is cut. Corners are labelled 0 to 2, midpoints of the edges 3 to 5.
/// Code: bits 0 to 2 mark the split edges; bit 3 chooses the other diagonal where two edges are split.
struct Split_pattern
{
  static constexpr int outer = 16; ///< flag of a `twin` entry: `outer + 2 * edge + half`

  int number_of_children = 0;
  std::array<std::array<std::uint8_t, 3>, 4> child{};   ///< labels of the corners
  std::array<std::uint8_t, 12> twin{};                  ///< of halfedge `3 * child + corner`: local, or `outer` + ...
  std::array<std::array<std::uint8_t, 2>, 3> half{};    ///< local halfedge that starts (0) or ends (1) edge `i`

  static const Split_pattern& of(std::uint8_t code)
  {
    static const std::array<Split_pattern, 16> table = make_table();
    return table[code];
  }

private:
  static std::array<Split_pattern, 16> make_table()
  {
    std::array<Split_pattern, 16> table;
    for (int code = 0; code < 16; ++code) table[std::size_t(code)] = make(code & 7, (code & 8) != 0);
    return table;
  }

  static Split_pattern make(int marks, bool other_diagonal)
  {
    Split_pattern p;
    const int count = (marks & 1) + (marks >> 1 & 1) + (marks >> 2 & 1);
    int r = 0; // first corner after rotation: its edge is the (first of the consecutive) split one(s)
    if (count == 1) while ((marks >> r & 1) == 0) ++r;
    if (count == 2) while ((marks >> r & 1) == 0 || (marks >> ((r + 1) % 3) & 1) == 0) ++r;
    const std::uint8_t v0 = std::uint8_t(r), v1 = std::uint8_t((r + 1) % 3), v2 = std::uint8_t((r + 2) % 3);
    const std::uint8_t m0 = std::uint8_t(3 + v0), m1 = std::uint8_t(3 + v1), m2 = std::uint8_t(3 + v2);
    const auto add = [&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
      p.child[std::size_t(p.number_of_children++)] = {a, b, c};
    };
    switch (count) {
    case 0: add(v0, v1, v2); break;
    case 1: add(v0, m0, v2); add(m0, v1, v2); break;
    case 2:
      add(m0, v1, m1);
      if (other_diagonal) { add(v0, m0, v2); add(m0, m1, v2); }
      else { add(v0, m0, m1); add(v0, m1, v2); }
      break;
    default: add(v0, m0, m2); add(m0, v1, m1); add(m2, m1, v2); add(m0, m1, m2); break;
    }
    p.link(marks);
    return p;
  }

  void link(int marks)
  {
    const int n = 3 * number_of_children;
    const auto from = [&](int i) { return child[std::size_t(i / 3)][std::size_t(i % 3)]; };
    const auto to = [&](int i) { return child[std::size_t(i / 3)][std::size_t((i + 1) % 3)]; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (from(i) == to(j) && to(i) == from(j)) twin[std::size_t(i)] = std::uint8_t(j);
    for (int e = 0; e < 3; ++e) {
      const int a = e, b = (e + 1) % 3, m = 3 + e;
      const bool split = (marks >> e & 1) != 0;
      for (int i = 0; i < n; ++i) {
        if (from(i) == a && to(i) == (split ? m : b)) set_half(e, 0, i);
        if (from(i) == (split ? m : a) && to(i) == b) set_half(e, 1, i);
      }
    }
  }

  void set_half(int e, int which, int i)
  {
    half[std::size_t(e)][std::size_t(which)] = std::uint8_t(i);
    twin[std::size_t(i)] = std::uint8_t(outer + 2 * e + which);
  }
};

/// A face that is cut, and what its children are joined to.
struct Cut_face
{
  std::uint8_t code = 0;
  std::uint8_t numbered = 0;     ///< a bit for each of the labels of vertices that are numbered with this face
  std::array<Index, 6> vertex{}; ///< of each label of `Split_pattern`
  std::array<Index, 6> twin{};   ///< of half `k % 2` of edge `k / 2`
};

/// Writes the children of the face `f` of `mesh` into `result`, which may be the same. `number(i)` is that of their
/// halfedge `i`.
template <class Number>
void write_children(const Mesh_view& mesh, Index f, const Cut_face& cut, const Number& number, Mesh_view& result)
{
  const Split_pattern& pattern = Split_pattern::of(cut.code);
  const std::array<Index, 3> curve{mesh.curve[3 * f], mesh.curve[3 * f + 1], mesh.curve[3 * f + 2]};
  const Index face_label = mesh.has_labels() ? mesh.label[f] : no_index;
  for (int i = 0; i < 3 * pattern.number_of_children; ++i) {
    const Index h = number(i);
    result.corner[h] = cut.vertex[pattern.child[std::size_t(i / 3)][std::size_t(i % 3)]];
    const int t = pattern.twin[std::size_t(i)], outer = t - Split_pattern::outer;
    result.twin[h] = outer < 0 ? number(t) : cut.twin[std::size_t(outer)];
    result.curve[h] = outer < 0 ? no_curve : curve[std::size_t(outer / 2)];
    if (mesh.has_labels() && i % 3 == 0) result.label[h / 3] = face_label;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if ((cut.numbered >> i & 1) != 0) result.outgoing[cut.vertex[i]] = number(pattern.half[i][0]);
    if ((cut.numbered >> (3 + i) & 1) != 0) result.outgoing[cut.vertex[3 + i]] = number(pattern.half[i][1]);
  }
}

/// `f` cut by `code`. `corner(h)` is the number of the vertex at `h`, `midpoint(h)` that on the edge of `h`, and `twin(h, k)`
/// that of half `k` of `h`, a halfedge of a face beside `f`.
template <class Corner, class Midpoint, class Twin>
Cut_face cut_face(const Mesh_view& mesh, Index f, std::uint8_t code, const Corner& corner, const Midpoint& midpoint,
                  const Twin& twin)
{
  Cut_face cut;
  cut.code = code;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index h = 3 * f + Index(i);
    const bool is_split = (code >> i & 1) != 0;
    cut.vertex[i] = corner(h);
    if (is_split) cut.vertex[3 + i] = midpoint(h);
    for (std::size_t k = 0; k < 2; ++k) cut.twin[2 * i + k] = mesh.is_border(h) ? no_index : twin(mesh.twin[h], 1 - k);
    const unsigned bits = (mesh.outgoing[mesh.corner[h]] == h ? 1u : 0u) | (is_split && mesh.is_edge_owner(h) ? 8u : 0u);
    cut.numbered = std::uint8_t(cut.numbered | bits << i);
  }
  return cut;
}

} // namespace internal

class Restructuring
{
public:
  /// Plans to split the edges marked in `codes` (one code per face; both faces of an edge mark it).
  template <class Execution>
  Restructuring(const Execution& execution, const Mesh_view& mesh, const Buffer<std::uint8_t>& codes)
    : mesh_(mesh), codes_(codes)
  {
    number_of_vertices_ = exclusive_scan(execution, mesh.number_of_faces(), vertex_offset_, [&](std::size_t f) {
      return mesh.is_removed_face(Index(f)) ? 0 : vertices_before(Index(f), 6);
    });
    number_of_faces_ = exclusive_scan(execution, mesh.number_of_faces(), face_offset_, [&](std::size_t f) {
      return number_of_children(Index(f));
    });
  }

  Index number_of_vertices() const { return number_of_vertices_; }
  Index number_of_faces() const { return number_of_faces_; }

  /// New id of a vertex that stays.
  Index vertex(Index v) const
  {
    const Index h = mesh_.outgoing[v];
    return vertex_offset_[h / 3] + vertices_before(h / 3, 2 * int(h % 3));
  }

  /// Id of the new vertex on the edge of `h`.
  Index midpoint(Index h) const
  {
    const Index o = mesh_.edge_owner(h);
    return vertex_offset_[o / 3] + vertices_before(o / 3, 2 * int(o % 3) + 1);
  }

  /// The new id of the first of the faces that `f` becomes; those of the next face follow. `f` may be one past the last.
  Index first_child(Index f) const { return f < face_offset_.size() ? face_offset_[f] : number_of_faces_; }

  bool is_split(Index h) const { return (codes_[h / 3] >> (h % 3) & 1) != 0; }

  /// Writes the new connectivity into `result`, of which the memory is reused; new memory is fetched for
  /// `expected_vertices`.
  template <class Execution>
  void build(const Execution& execution, Mesh_view& result, std::size_t expected_vertices = 0) const
  {
    const std::size_t n = 3 * std::size_t(number_of_faces_), expected = 6 * expected_vertices;
    result.curves = mesh_.curves;
    resize_and_forget(result.corner, n, expected);
    resize_and_forget(result.twin, n, expected);
    resize_and_forget(result.curve, n, expected);
    resize_and_forget(result.outgoing, number_of_vertices_, expected_vertices);
    resize_and_forget(result.label, mesh_.has_labels() ? n / 3 : 0, expected / 3);
    for_each_index(execution, mesh_.number_of_faces(), [&](std::size_t f) {
      if (!mesh_.is_removed_face(Index(f))) write_children(result, Index(f));
    });
  }

private:
  Index number_of_children(Index f) const
  {
    if (mesh_.is_removed_face(f)) return 0;
    return Index(internal::Split_pattern::of(codes_[f]).number_of_children);
  }

  bool owns_corner(Index h) const { return mesh_.outgoing[mesh_.corner[h]] == h; }
  bool owns_midpoint(Index h) const { return is_split(h) && mesh_.is_edge_owner(h); }

  /// Vertices numbered with face `f`, of the first `slots` of: corner 0, midpoint 0, corner 1, ...
  Index vertices_before(Index f, int slots) const
  {
    Index n = 0;
    for (int s = 0; s < slots; ++s) {
      const Index h = 3 * f + Index(s / 2);
      if (s % 2 == 0 ? owns_corner(h) : owns_midpoint(h)) ++n;
    }
    return n;
  }

  void write_children(Mesh_view& result, Index f) const
  {
    const internal::Cut_face cut = internal::cut_face(
      mesh_, f, codes_[f], [&](Index h) { return vertex(mesh_.corner[h]); }, [&](Index h) { return midpoint(h); },
      [&](Index h, std::size_t k) {
        return 3 * face_offset_[h / 3] + internal::Split_pattern::of(codes_[h / 3]).half[h % 3][k];
      });
    const Index first = 3 * face_offset_[f];
    internal::write_children(mesh_, f, cut, [&](int i) { return first + Index(i); }, result);
  }

  const Mesh_view& mesh_;
  const Buffer<std::uint8_t>& codes_;
  Buffer<Index> vertex_offset_, face_offset_;
  Index number_of_vertices_ = 0, number_of_faces_ = 0;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_MESH_RESTRUCTURE_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which facets of a tessellation are planes of the shape, and which are chords of something curved.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PLANE_SEARCH_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PLANE_SEARCH_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/inflection.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Part of the border between two facets.
struct Facet_border
{
  Index f, g; ///< facets
  double length, turn;
  bool is_concave;
};

/// Facets as strips between two others.
class Strip_rows
{
public:
  Strip_rows(const std::vector<Facet>& facets, const std::vector<Facet_border>& borders)
    : facets_(facets), strips_(facets.size())
  {
    for (const Facet_border& b : borders) {
      const double turn = b.is_concave ? -b.turn : b.turn;
      strips_[b.f].add(b.g, b.length, turn);
      strips_[b.g].add(b.f, b.length, turn);
    }
  }

  /// Whether the row of `f` changes the way it bends inside of that facet.
  bool is_inflection(Index f) const
  {
    Chords_beside before, behind;
    return strips_[f].is_between_two() && follow(f, 0, before) && follow(f, 1, behind) &&
           internal::is_inflection(width(f), before, behind);
  }

private:
  struct Strip
  {
    std::array<Index, 2> beside{no_index, no_index};
    std::array<double, 2> length{0, 0}, turn{0, 0}; // of the border to each, signed
    bool has_more = false;

    void add(Index facet, double l, double t)
    {
      const int i = beside[0] == no_index || beside[0] == facet ? 0 : 1;
      if (beside[i] != no_index && beside[i] != facet) {
        has_more = true;
        return;
      }
      beside[i] = facet;
      length[i] += l;
      turn[i] = t;
    }

    bool is_between_two() const { return beside[1] != no_index && !has_more; }
  };

  double width(Index f) const { return 2 * facets_[f].area / (strips_[f].length[0] + strips_[f].length[1]); }

  /// Over the border `side` of `f`: whether there are enough strips.
  bool follow(Index f, int side, Chords_beside& chords) const
  {
    for (std::size_t i = 0; i < chords.length.size(); ++i) {
      const Index g = strips_[f].beside[side];
      if (!strips_[g].is_between_two()) return false;
      chords.length[i] = width(g);
      chords.turn[i] = strips_[f].turn[side];
      side = strips_[g].beside[0] == f ? 1 : 0;
      f = g;
    }
    return true;
  }

  const std::vector<Facet>& facets_;
  std::vector<Strip> strips_;
};

/// Tells planes of the shape from facets of what is curved, by how much the surface bends at a facet: the sum of the
/// angles times the lengths of its smooth borders over its area, about twice the curvature. Facets of something curved
/// are like their neighbours in this, and form rows or nets of three and more. A plane is far flatter than what joins
/// it smoothly, or has planes only beside it that are still flatter, as a chamfer has; but a strip between two that turn
/// into opposite directions may be an inflection. Nobody but a mesher puts a vertex inside of a facet of something
/// curved: it would lie beside it.
class Plane_search
{
public:
  /// Takes the edges whose halfedge satisfies `is_smooth`.
  template <class Smooth>
  Plane_search(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Smooth& is_smooth, Facets& facets)
    : facets_(facets.facets), bend_(facets_.size(), 0), row_(facets_.size()), length_of_row_(facets_.size(), 0)
    , are_meshed_(facets.are_meshed)
  {
    std::iota(row_.begin(), row_.end(), Index(0));
    for (std::size_t i = 0; i < mesh.number_of_halfedges(); ++i) {
      const Index h = Index(i);
      if (mesh.is_border(h) || !mesh.is_edge_owner(h) || !is_smooth(h)) continue;
      const Index f = facets.of_face[Mesh_view::face(h)], g = facets.of_face[Mesh_view::face(mesh.twin[h])];
      if (f == g) continue;
      const Vector_3 d = points[mesh.target(h)] - points[mesh.source(h)];
      const bool is_concave = facets_[f].normal.cross(facets_[g].normal).dot(d) < 0;
      borders_.push_back({f, g, d.norm(), angle_between(facets_[f].normal, facets_[g].normal), is_concave});
    }
  }

  void run()
  {
    measure_bends();
    are_meshed_ = are_meshed_ && are_curved_ones_meshed();
    for (Facet& f : facets_) {
      f.is_plane = f.has_inner_vertices && !are_meshed_;
      f.turn = 0;
    }
    join_rows();
    mark_planes();
    if (are_meshed_) unmark_bent_planes();
  }

private:
  static constexpr double largest_ratio = 3; // of the bends of facets of one thing: it is 5 from fillets to planes of
                                             // three times their width, and 2 along splines
  static constexpr Index shortest_row = 3;   // two facets may as well be a roof

  void measure_bends()
  {
    for (const Facet_border& b : borders_)
      for (const Index f : {b.f, b.g}) bend_[f] += b.turn * b.length;
    for (std::size_t f = 0; f < bend_.size(); ++f)
      bend_[f] = facets_[f].area > 0 ? bend_[f] / facets_[f].area : std::numeric_limits<double>::infinity();
  }

  bool are_like(const Facet_border& b) const
  {
    if (facets_[b.f].is_plane || facets_[b.g].is_plane) return false;
    return are_alike(bend_[b.f], bend_[b.g], largest_ratio);
  }

  /// Whether most facets with vertices inside have one like them beside them.
  bool are_curved_ones_meshed() const
  {
    std::vector<std::uint8_t> has_like(facets_.size(), 0);
    for (const Facet_border& b : borders_)
      if (are_like(b)) has_like[b.f] = has_like[b.g] = 1;
    std::ptrdiff_t balance = 0;
    for (std::size_t f = 0; f < facets_.size(); ++f)
      if (facets_[f].has_inner_vertices) balance += has_like[f] ? 1 : -1;
    return balance > 0;
  }

  void join_rows()
  {
    std::vector<double> length(facets_.size(), 0);
    for (const Facet_border& b : borders_) {
      if (!are_like(b)) continue;
      row_[(std::max)(row(b.f), row(b.g))] = (std::min)(row(b.f), row(b.g));
      for (const Index f : {b.f, b.g}) {
        facets_[f].turn += b.turn * b.length;
        length[f] += b.length;
      }
    }
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      ++length_of_row_[row(Index(f))];
      if (length[f] > 0) facets_[f].turn /= length[f];
    }
  }

  /// The facet that stands for the row of `f`.
  Index row(Index f)
  {
    while (row_[f] != f) f = row_[f] = row_[row_[f]];
    return f;
  }

  /// From the flattest on: what a facet has to be compared with is known when its turn comes.
  void mark_planes()
  {
    const auto flatter = [&](const Facet_border& b) { return (std::min)(bend_[b.f], bend_[b.g]); };
    std::stable_sort(borders_.begin(), borders_.end(), [&](const Facet_border& a, const Facet_border& b) {
      return flatter(a) < flatter(b);
    });
    const Strip_rows rows(facets_, borders_);
    std::vector<std::uint8_t> is_open(facets_.size());
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      is_open[f] = !facets_[f].is_plane && facets_[f].faces > 1 && length_of_row_[row(Index(f))] < shortest_row &&
                   !rows.is_inflection(Index(f));
      if (is_open[f]) facets_[f].is_plane = true;
    }
    for (const Facet_border& b : borders_) {
      const bool is_f_open = is_open[b.f], is_g_open = is_open[b.g];
      if (is_f_open && !is_g_open && is_chance(facets_[b.f], facets_[b.g])) facets_[b.f].is_plane = false;
      if (is_g_open && !is_f_open && is_chance(facets_[b.g], facets_[b.f])) facets_[b.g].is_plane = false;
    }
    for (const Facet_border& b : borders_) {
      const Index steep = bend_[b.f] < bend_[b.g] ? b.g : b.f, flat = steep == b.f ? b.g : b.f;
      if (is_open[steep] && row(steep) != row(flat) && !facets_[flat].is_plane) facets_[steep].is_plane = false;
    }
  }

  /// Where no edges are marked, a plane that is bent into something else has no normal at its border that fits both.
  void unmark_bent_planes()
  {
    for (const Facet_border& b : borders_)
      if (b.turn > least_turn_between_planes) facets_[b.f].is_plane = facets_[b.g].is_plane = false;
  }

  /// Whether `f` may be triangles of a mesh that happen to lie in a plane: `g` beside it is a triangle or a plane that
  /// is meshed, and `f` is not far larger than its triangles.
  static bool is_chance(const Facet& f, const Facet& g)
  {
    const bool is_meshed = g.faces == 1 || (g.is_plane && g.faces >= fewest_meshed);
    return is_meshed && f.area < least_size * g.area / g.faces;
  }

  static constexpr Index fewest_meshed = 16;
  static constexpr double least_size = 4;

  std::vector<Facet>& facets_;
  std::vector<Facet_border> borders_;
  std::vector<double> bend_;
  std::vector<Index> row_, length_of_row_;
  bool& are_meshed_;
};

} // namespace internal

/// Decides which of the `facets` are planes of the shape; others join over the edges for which `is_smooth(h)`.
template <class Smooth>
void find_planes(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Smooth& is_smooth, Facets& facets)
{
  internal::Plane_search(mesh, points, is_smooth, facets).run();
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PLANE_SEARCH_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joins the points of a triangle soup that are at exactly the same place, but only along seams: where an edge with one
// face meets one other such edge. What merely touches, in a point or with more than two faces at an edge, stays apart.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_WELD_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_WELD_H

#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Sets of the numbers below `n`, each named by its least one.
class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::uint32_t(0)); }

  std::uint32_t find(std::uint32_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::uint32_t i, std::uint32_t j)
  {
    i = find(i);
    j = find(j);
    parent_[(std::max)(i, j)] = (std::min)(i, j);
  }

private:
  std::vector<std::uint32_t> parent_;
};

/// The place of each point: the least index of a point with the same coordinates.
/// \pre the coordinates are finite
template <class Point>
std::vector<std::uint32_t> places_of(const std::vector<Point>& points)
{
  std::vector<std::uint32_t> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), std::uint32_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return points[i] < points[j]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? place[order[i - 1]] : order[i];
  return place;
}

/// Finds the seams of an oriented soup: the edges to be joined, and the components to be turned over for that.
/// \pre the triangles form an oriented manifold
class Seam_finder
{
public:
  /// \param place the least index of a point at the same place, for each point
  Seam_finder(std::vector<std::uint32_t> place, const Triangle_soup& triangles)
    : place_(std::move(place)), is_kept_apart_(place_.size(), false), components_(0), sides_(0)
  {
    find_shared_places();
    if (is_shared_.empty()) return;
    find_components(triangles);
    find_edges(triangles);
    find_groups();
    find_seams();
  }

  bool found_any() const { return !seams_.empty(); }

  /// The sets of points to be joined.
  Disjoint_sets joined_points()
  {
    Disjoint_sets points(0);
    do {
      points = Disjoint_sets(place_.size());
      for (const Seam& s : seams_)
        if (is_joined(s))
          for (std::size_t i = 0; i < 2; ++i) points.unite(edges_[s.edge].corner[i], edges_[s.other].corner[i]);
    } while (keep_conflicts_apart(points));
    return points;
  }

  /// Whether the component of the point `i` is to be turned over.
  bool is_turned(std::uint32_t i) { return sides_.find(2 * components_.find(i)) % 2 == 1; }

  /// Calls `f(i, j)` for an edge with one face that has others at its place and is not joined, for each such place.
  template <class F>
  void for_each_open_seam(const F& f) const
  {
    for (const Group& g : groups_)
      for (std::size_t i = g.begin; i < g.end; ++i)
        if (is_border(g, i) && !is_joined(i)) {
          f(edges_[i].corner[0], edges_[i].corner[1]);
          break;
        }
  }

private:
  /// An edge of a triangle: its lower place comes first.
  struct Seam_edge
  {
    std::array<std::uint32_t, 2> place;
    std::uint32_t component;
    std::array<std::uint32_t, 2> corner;
    std::uint32_t apex; // the place of the third corner
    bool is_reversed;   // the triangle has it from its second corner to its first

    auto key() const { return std::tie(place, component, corner); }
    bool has_length() const { return place[0] != place[1]; }
  };

  struct Group // of all edges at one place
  {
    std::size_t begin, end;
  };

  struct Seam // of two edges
  {
    std::size_t edge, other;
  };

  void find_shared_places()
  {
    for (std::uint32_t i = 0; i < place_.size(); ++i) {
      if (place_[i] == i) continue;
      is_shared_.resize(place_.size(), false);
      is_shared_[place_[i]] = true;
    }
  }

  void find_components(const Triangle_soup& triangles)
  {
    components_ = Disjoint_sets(place_.size());
    sides_ = Disjoint_sets(2 * place_.size()); // either side of each component
    for (const auto& t : triangles) {
      components_.unite(t[0], t[1]);
      components_.unite(t[1], t[2]);
    }
  }

  void find_edges(const Triangle_soup& triangles)
  {
    for (const auto& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3], apex = place_[t[(i + 2) % 3]], c = components_.find(a);
        if (!is_shared_[place_[a]] && !is_shared_[place_[b]]) continue;
        if (place_[a] < place_[b]) edges_.push_back({{place_[a], place_[b]}, c, {a, b}, apex, false});
        else edges_.push_back({{place_[b], place_[a]}, c, {b, a}, apex, true});
      }
    std::sort(edges_.begin(), edges_.end(), [](const auto& e, const auto& f) { return e.key() < f.key(); });
  }

  void find_groups()
  {
    for (std::size_t i = 0, j; i < edges_.size(); i = j) {
      for (j = i + 1; j < edges_.size() && edges_[j].place == edges_[i].place;) ++j;
      if (edges_[i].corner != edges_[j - 1].corner || !edges_[i].has_length()) groups_.push_back({i, j});
    }
  }

  /// A seam is where two edges with one face each have a place for themselves, or are the only ones there of a
  /// component.
  void find_seams()
  {
    seam_of_edge_.assign(edges_.size(), no_seam);
    for (const Group& g : groups_) {
      if (g.end == g.begin + 2) add_seam(g, g.begin);
      for (std::size_t i = g.begin, j; i < g.end && g.end > g.begin + 2; i = j) {
        for (j = i + 1; j < g.end && edges_[j].component == edges_[i].component;) ++j;
        if (j == i + 2) add_seam(g, i);
      }
    }
  }

  /// Joins the edges `i` and `i + 1` if that makes a surface with two sides. Two faces with the same three places are
  /// copies of one another, no neighbours.
  void add_seam(const Group& g, std::size_t i)
  {
    const Seam_edge &e = edges_[i], &f = edges_[i + 1];
    const std::uint32_t other_side = e.is_reversed == f.is_reversed ? 1 : 0;
    if (!is_border(g, i) || !is_border(g, i + 1) || e.apex == f.apex ||
        sides_.find(2 * e.component) == sides_.find(2 * f.component + 1 - other_side))
      return;
    sides_.unite(2 * e.component, 2 * f.component + other_side);
    sides_.unite(2 * e.component + 1, 2 * f.component + 1 - other_side);
    seam_of_edge_[i] = seam_of_edge_[i + 1] = seams_.size();
    seams_.push_back({i, i + 1});
  }

  bool is_border(const Group& g, std::size_t i) const
  {
    return edges_[i].has_length() && (i == g.begin || edges_[i].corner != edges_[i - 1].corner) &&
           (i + 1 == g.end || edges_[i].corner != edges_[i + 1].corner);
  }

  bool is_joined(const Seam& s) const
  {
    const auto& place = edges_[s.edge].place;
    return !is_kept_apart_[place[0]] && !is_kept_apart_[place[1]];
  }

  bool is_joined(std::size_t i) const { return seam_of_edge_[i] != no_seam && is_joined(seams_[seam_of_edge_[i]]); }

  bool keep_conflicts_apart(Disjoint_sets& points)
  {
    bool any = false;
    for (const Group& g : groups_) {
      if (!has_conflict(g, points)) continue;
      const auto& place = edges_[g.begin].place;
      is_kept_apart_[is_kept_apart_[place[0]] ? place[1] : place[0]] = any = true;
    }
    return any;
  }

  /// Whether two edges that are no seam have become one, or an edge without length has lost an end.
  bool has_conflict(const Group& g, Disjoint_sets& points) const
  {
    if (g.end == g.begin + 2 && is_joined(g.begin)) return false;
    using Key = std::array<std::uint32_t, 2>;
    std::vector<std::pair<Key, std::size_t>> joined; // what each edge is now, and what it was joined to
    for (std::size_t i = g.begin; i < g.end; ++i) {
      const Key key = {points.find(edges_[i].corner[0]), points.find(edges_[i].corner[1])};
      if (key[0] == key[1]) return true;
      if (i == g.begin || edges_[i].corner != edges_[i - 1].corner)
        joined.emplace_back(key, is_joined(i) ? seam_of_edge_[i] : no_seam);
    }
    std::sort(joined.begin(), joined.end());
    return std::adjacent_find(joined.begin(), joined.end(), [](const auto& e, const auto& f) {
      return e.first == f.first && (e.second != f.second || e.second == no_seam);
    }) != joined.end();
  }

  static constexpr std::size_t no_seam = std::size_t(-1);

  std::vector<std::uint32_t> place_;
  std::vector<bool> is_shared_;           // by place: several points are there; empty if there is no such place
  std::vector<bool> is_kept_apart_;       // by place: joining there would make a surface that is no manifold
  Disjoint_sets components_;              // of points
  Disjoint_sets sides_;                   // 2 c: the component c as it is, 2 c + 1: turned over
  std::vector<Seam_edge> edges_;          // those with other points at the place of an end
  std::vector<Group> groups_;             // those with several edges, or one without length
  std::vector<Seam> seams_;
  std::vector<std::size_t> seam_of_edge_;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_WELD_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every result has to be: a simplicial, oriented 2-manifold. The checks work on bare triangles, and share no code
// with the library.

#ifndef TEST_SURFACE_MESH_ADAPTATION_CHECKS_H
#define TEST_SURFACE_MESH_ADAPTATION_CHECKS_H

#include "shapes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <ostream>
#include <unordered_map>

namespace checks {

using shapes::Index;
using shapes::no_index;
using shapes::Soup;
using shapes::Triangle;
using shapes::Vector_3;

/// What adaptation may not change.
struct Topology
{
  long euler_characteristic = 0;
  std::size_t components = 0;
  std::size_t boundary_cycles = 0;

  friend bool operator==(const Topology& a, const Topology& b)
  {
    return a.euler_characteristic == b.euler_characteristic && a.components == b.components &&
           a.boundary_cycles == b.boundary_cycles;
  }

  friend std::ostream& operator<<(std::ostream& out, const Topology& t)
  {
    return out << "Euler characteristic " << t.euler_characteristic << ", " << t.components << " components, "
               << t.boundary_cycles << " boundary cycles";
  }
};

/// The triangle to the left of each directed edge.
class Edge_map
{
public:
  explicit Edge_map(const std::vector<Triangle>& triangles) : triangles_(triangles)
  {
    map_.reserve(3 * triangles.size());
    for (std::size_t f = 0; f < triangles.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i)
        is_oriented_ = map_.emplace(key(triangles[f][i], triangles[f][(i + 1) % 3]), f).second && is_oriented_;
  }

  /// Whether no two triangles lie to the left of the same edge.
  bool is_oriented() const { return is_oriented_; }

  /// The third corner of the triangle to the left of the edge from `a` to `b`, or `no_index`.
  Index apex(Index a, Index b) const
  {
    const auto found = map_.find(key(a, b));
    if (found == map_.end()) return no_index;
    for (const Index v : triangles_[found->second])
      if (v != a && v != b) return v;
    return no_index;
  }

private:
  static std::uint64_t key(Index a, Index b) { return (std::uint64_t(a) << 32) | b; }

  const std::vector<Triangle>& triangles_;
  std::unordered_map<std::uint64_t, std::size_t> map_;
  bool is_oriented_ = true;
};

inline std::size_t find(std::vector<std::size_t>& parent, std::size_t v)
{
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

/// Number of classes of `n` items joined by `pairs`, of those with `is_counted`.
template <class Pairs, class IsCounted>
std::size_t number_of_classes(std::size_t n, const Pairs& pairs, const IsCounted& is_counted)
{
  std::vector<std::size_t> parent(n);
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  pairs([&](std::size_t a, std::size_t b) { parent[find(parent, a)] = find(parent, b); });
  std::size_t classes = 0;
  for (std::size_t v = 0; v < n; ++v)
    if (parent[v] == v && is_counted(v)) ++classes;
  return classes;
}

/// Whether the triangles around each vertex form one fan: a walk around it meets them all.
inline ::testing::AssertionResult have_single_fans(std::size_t n, const std::vector<Triangle>& triangles,
                                                   const Edge_map& edges)
{
  std::vector<std::size_t> faces(n, 0);
  std::vector<Index> start(n, no_index); // a neighbour with a triangle to the left, on the boundary the first one
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ++faces[t[i]];
      const Index next = t[(i + 1) % 3];
      if (start[t[i]] == no_index || edges.apex(next, t[i]) == no_index) start[t[i]] = next;
    }
  for (std::size_t v = 0; v < n; ++v) {
    if (faces[v] == 0) return ::testing::AssertionFailure() << "vertex " << v << " is isolated";
    std::size_t met = 0;
    Index w = start[v];
    do {
      w = edges.apex(Index(v), w);
      if (w != no_index) ++met;
    } while (w != no_index && w != start[v] && met <= faces[v]);
    if (met != faces[v]) return ::testing::AssertionFailure() << "the faces of vertex " << v << " form no single fan";
  }
  return ::testing::AssertionSuccess();
}

/// Whether the triangles form a simplicial, consistently oriented 2-manifold with boundary on all of `n` vertices.
inline ::testing::AssertionResult is_manifold(std::size_t n, const std::vector<Triangle>& triangles)
{
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || (std::max)({t[0], t[1], t[2]}) >= n)
      return ::testing::AssertionFailure() << "triangle " << f << " has no three corners";
  }
  const Edge_map edges(triangles);
  if (!edges.is_oriented()) return ::testing::AssertionFailure() << "an edge has two faces on the same side";
  return have_single_fans(n, triangles, edges);
}

inline ::testing::AssertionResult is_manifold(const Soup& soup)
{
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    if (!soup.points[v].allFinite()) return ::testing::AssertionFailure() << "vertex " << v << " is not finite";
  return is_manifold(soup.points.size(), soup.triangles);
}

/// \pre the triangles form a manifold
inline Topology topology(std::size_t n, const std::vector<Triangle>& triangles)
{
  const Edge_map edges(triangles);
  std::vector<bool> is_border(n, false);
  std::vector<std::pair<Index, Index>> border;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (edges.apex(t[(i + 1) % 3], t[i]) == no_index) {
        border.emplace_back(t[i], t[(i + 1) % 3]);
        is_border[t[i]] = true;
      }
  Topology result;
  const std::size_t number_of_edges = (3 * triangles.size() + border.size()) / 2;
  result.euler_characteristic = long(n) - long(number_of_edges) + long(triangles.size());
  result.components = number_of_classes(
    n,
    [&](const auto& join) {
    for (const Triangle& t : triangles) {
      join(t[0], t[1]);
      join(t[1], t[2]);
    }
    },
    [](std::size_t) { return true; });
  result.boundary_cycles = number_of_classes(
    n,
    [&](const auto& join) {
    for (const auto& e : border) join(e.first, e.second);
    },
    [&](std::size_t v) { return is_border[v]; });
  return result;
}

inline Topology topology(const Soup& soup) { return topology(soup.points.size(), soup.triangles); }

/// Area of the least triangle; with `normal(p)`, the outward normal of the surface next to `p`, a triangle that looks
/// inwards counts as negative.
template <class Normal>
double least_area(const Soup& soup, const Normal& normal)
{
  double least = 1e300;
  for (const Triangle& t : soup.triangles) {
    const Vector_3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    const Vector_3 n = (b - a).cross(c - a) / 2;
    const double sign = n.dot(normal((a + b + c) / 3)) < 0 ? -1 : 1;
    least = (std::min)(least, sign * n.norm());
  }
  return least;
}

inline double least_area(const Soup& soup)
{
  double least = 1e300;
  for (const Triangle& t : soup.triangles) {
    const Vector_3& a = soup.points[t[0]];
    least = (std::min)(least, (soup.points[t[1]] - a).cross(soup.points[t[2]] - a).norm() / 2);
  }
  return least;
}

inline double area(const Soup& soup)
{
  double sum = 0;
  for (const Triangle& t : soup.triangles) {
    const Vector_3& a = soup.points[t[0]];
    sum += (soup.points[t[1]] - a).cross(soup.points[t[2]] - a).norm() / 2;
  }
  return sum;
}

/// `4 sqrt 3 area / sum of squared lengths`
inline double quality(const Vector_3& a, const Vector_3& b, const Vector_3& c)
{
  const double lengths = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / lengths;
}

inline double least_quality(const Soup& soup)
{
  double least = 1;
  for (const Triangle& t : soup.triangles)
    least = (std::min)(least, quality(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]));
  return least;
}

inline double mean_quality(const Soup& soup)
{
  double sum = 0;
  for (const Triangle& t : soup.triangles) sum += quality(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
  return sum / double(soup.triangles.size());
}

/// Calls `f(a, b)` for the edges, each once, boundary edges included.
template <class F>
void for_each_edge(const std::vector<Triangle>& triangles, const F& f)
{
  const Edge_map edges(triangles);
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      if (a < b || edges.apex(b, a) == no_index) f(a, b);
    }
}

/// Whether two meshes are the same to the last bit: order, connectivity and coordinates, NaN included.
inline bool is_identical(const Soup& a, const Soup& b)
{
  return a.triangles == b.triangles && a.points.size() == b.points.size() &&
         (a.points.empty() || std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Vector_3)) == 0);
}

/// Distance from `p` to the segment from `a` to `b`.
inline double distance_to_segment(const Vector_3& p, const Vector_3& a, const Vector_3& b)
{
  const Vector_3 e = b - a;
  const double t = e.squaredNorm() > 0 ? (p - a).dot(e) / e.squaredNorm() : 0;
  return (p - a - (std::min)(1.0, (std::max)(0.0, t)) * e).norm();
}

/// The triangles of a view, without its holes and with its vertices renumbered to be dense.
inline std::vector<Triangle> live_triangles(const CGAL::Surface_mesh_adaptation::Mesh_view& m, std::size_t& n)
{
  std::vector<Index> id(m.number_of_vertices(), no_index);
  n = 0;
  for (Index v = 0; v < m.number_of_vertices(); ++v)
    if (!m.is_removed_vertex(v)) id[v] = Index(n++);
  std::vector<Triangle> triangles;
  for (std::size_t h = 0; h < m.number_of_halfedges(); h += 3)
    if (!m.is_removed_face(Index(h / 3)))
      triangles.push_back({id[m.corner[h]], id[m.corner[h + 1]], id[m.corner[h + 2]]});
  return triangles;
}

/// Whether a view is a manifold and keeps its own rules: twins mutual, curves equal on both sides, fans that start at
/// the boundary, no live element that refers to a hole.
inline ::testing::AssertionResult is_valid(const CGAL::Surface_mesh_adaptation::Mesh_view& m)
{
  const auto failure = [](const char* what, Index i) { return ::testing::AssertionFailure() << what << " " << i; };
  for (Index h = 0; h < m.number_of_halfedges(); ++h) {
    if (m.is_removed_face(h / 3)) continue;
    if (m.corner[h] == no_index || m.is_removed_vertex(m.corner[h])) return failure("removed corner of halfedge", h);
    const Index t = m.twin[h];
    if (t == no_index) {
      if (m.outgoing[m.source(h)] != h) return failure("the fan does not start at boundary halfedge", h);
      continue;
    }
    if (m.twin[t] != h) return failure("twins are not mutual at halfedge", h);
    if (m.source(t) != m.target(h) || m.target(t) != m.source(h)) return failure("ends differ at halfedge", h);
    if (m.curve[t] != m.curve[h]) return failure("curves differ at halfedge", h);
  }
  for (Index v = 0; v < m.number_of_vertices(); ++v)
    if (!m.is_removed_vertex(v) && m.corner[m.outgoing[v]] != v) return failure("outgoing does not leave vertex", v);
  std::size_t n = 0;
  const std::vector<Triangle> triangles = live_triangles(m, n);
  return is_manifold(n, triangles);
}

inline Topology topology(const CGAL::Surface_mesh_adaptation::Mesh_view& m)
{
  std::size_t n = 0;
  const std::vector<Triangle> triangles = live_triangles(m, n);
  return topology(n, triangles);
}

} // namespace checks

#endif // TEST_SURFACE_MESH_ADAPTATION_CHECKS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes that the tests share, as points and triangles. All are oriented outwards (or upwards), and the same on
// every machine.

#ifndef TEST_SURFACE_MESH_ADAPTATION_SHAPES_H
#define TEST_SURFACE_MESH_ADAPTATION_SHAPES_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace shapes {

namespace SMA = CGAL::Surface_mesh_adaptation;
using SMA::Index;
using SMA::no_index;
using SMA::Vector_3;

constexpr double pi = 3.14159265358979323846;

/// Numbers in [0, 1): unlike the distributions of the standard library, the same everywhere.
class Random
{
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next()
  {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
  }

  double real() { return double(next() >> 11) * 0x1p-53; }
  double real(double low, double high) { return low + (high - low) * real(); }
  std::size_t below(std::size_t n) { return std::size_t(next() % n); }
  Vector_3 vector()
  {
    const double x = real(-1, 1), y = real(-1, 1), z = real(-1, 1);
    return Vector_3(x, y, z);
  }

  template <class T>
  void shuffle(std::vector<T>& items)
  {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

private:
  std::uint64_t state_;
};

using Triangle = std::array<Index, 3>;

struct Soup
{
  std::vector<Vector_3> points;
  std::vector<Triangle> triangles;

  double mean_edge_length() const
  {
    double sum = 0;
    for (const Triangle& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) sum += (points[t[i]] - points[t[(i + 1) % 3]]).norm();
    return sum / double(3 * triangles.size());
  }
};

/// Adds `other` as one more component.
inline void append(Soup& soup, const Soup& other)
{
  const Index shift = Index(soup.points.size());
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  for (const Triangle& t : other.triangles) soup.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
}

inline Soup tetrahedron()
{
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}}};
}

inline Soup octahedron()
{
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

inline Soup icosahedron()
{
  const double g = (1 + std::sqrt(5.0)) / 2;
  Soup s{{{-1, g, 0},
          {1, g, 0},
          {-1, -g, 0},
          {1, -g, 0},
          {0, -1, g},
          {0, 1, g},
          {0, -1, -g},
          {0, 1, -g},
          {g, 0, -1},
          {g, 0, 1},
          {-g, 0, -1},
          {-g, 0, 1}},
         {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
          {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
          {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vector_3& p : s.points) p.normalize();
  return s;
}

/// Puts a vertex at `p` into the triangle `f`, which becomes three.
inline void split_triangle(Soup& soup, std::size_t f, const Vector_3& p)
{
  const Triangle t = soup.triangles[f];
  const auto v = Index(soup.points.size());
  soup.points.push_back(p);
  soup.triangles[f] = {t[0], t[1], v};
  soup.triangles.push_back({t[1], t[2], v});
  soup.triangles.push_back({t[2], t[0], v});
}

/// Each triangle cut into four at the middles of its edges.
inline Soup subdivided(const Soup& soup)
{
  Soup s{soup.points, {}};
  std::map<std::pair<Index, Index>, Index> middle;
  const auto middle_of = [&](Index a, Index b) {
    const auto found = middle.emplace(std::minmax(a, b), Index(s.points.size()));
    if (found.second) s.points.push_back((soup.points[a] + soup.points[b]) / 2);
    return found.first->second;
  };
  for (const Triangle& t : soup.triangles) {
    const Index m0 = middle_of(t[0], t[1]), m1 = middle_of(t[1], t[2]), m2 = middle_of(t[2], t[0]);
    for (const Triangle& child : {Triangle{t[0], m0, m2}, {m0, t[1], m1}, {m2, m1, t[2]}, {m0, m1, m2}})
      s.triangles.push_back(child);
  }
  return s;
}

/// The unit sphere from an icosahedron subdivided `level` times; vertices are moved at random on it by up to `jitter`
/// edge lengths.
inline Soup sphere(int level, double jitter = 0)
{
  Soup s = icosahedron();
  for (int i = 0; i < level; ++i) {
    s = subdivided(s);
    for (Vector_3& p : s.points) p.normalize();
  }
  const double h = s.mean_edge_length();
  Random random(1);
  for (Vector_3& p : s.points) p = (p + jitter * h * random.vector() / std::sqrt(3.0)).normalized();
  return s;
}

/// The grid of `nu` times `nv` quadrilaterals, closed in the directions asked for, each cut along a random diagonal.
/// `point(u, v)` for `u, v` in [0, 1].
template <class Point>
Soup grid(std::size_t nu, std::size_t nv, bool closed_u, bool closed_v, double jitter, const Point& point)
{
  Soup s;
  Random random(2);
  const std::size_t columns = closed_u ? nu : nu + 1, rows = closed_v ? nv : nv + 1;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const bool inner_u = closed_u || (i > 0 && i < nu), inner_v = closed_v || (j > 0 && j < nv);
      const double du = random.real(-jitter, jitter), dv = random.real(-jitter, jitter);
      s.points.push_back(
        point((double(i) + (inner_u ? du : 0)) / double(nu), (double(j) + (inner_v ? dv : 0)) / double(nv)));
    }
  const auto id = [&](std::size_t i, std::size_t j) { return Index(i % columns + columns * (j % rows)); };
  for (std::size_t j = 0; j < nv; ++j)
    for (std::size_t i = 0; i < nu; ++i) {
      const Index a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      // the corners of an open grid are cut so that no triangle has two edges on the boundary
      const bool first = i == 0 && j == 0, last = i + 1 == nu && j + 1 == nv;
      const bool other_corner = (i == 0 && j + 1 == nv) || (i + 1 == nu && j == 0);
      const bool coin = random.below(2) == 0;
      const bool along_ac = closed_u || closed_v ? coin : (first || last || (!other_corner && coin));
      if (along_ac) s.triangles.insert(s.triangles.end(), {{a, b, c}, {a, c, d}});
      else s.triangles.insert(s.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return s;
}

constexpr double torus_large_radius = 1, torus_small_radius = 0.35;

inline Soup torus(std::size_t nu, std::size_t nv, double jitter = 0)
{
  return grid(nu, nv, true, true, jitter, [](double u, double v) {
    const double r = torus_large_radius + torus_small_radius * std::cos(2 * pi * v);
    return Vector_3(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), torus_small_radius * std::sin(2 * pi * v));
  });
}

/// The outer unit normal of the torus next to `p`.
inline Vector_3 torus_normal(const Vector_3& p)
{
  const Vector_3 center = torus_large_radius * Vector_3(p[0], p[1], 0).normalized();
  return (p - center).normalized();
}

inline double torus_distance(const Vector_3& p)
{
  return std::abs(std::hypot(std::hypot(p[0], p[1]) - torus_large_radius, p[2]) - torus_small_radius);
}

/// The unit square in the plane z = 0, with its boundary.
inline Soup square(std::size_t n, double jitter = 0)
{
  return grid(n, n, false, false, jitter, [](double u, double v) { return Vector_3(u, v, 0); });
}

/// The side of the cylinder of radius 1 between z = 0 and z = `height`: two boundary cycles.
inline Soup open_cylinder(std::size_t around, std::size_t up, double height, double jitter = 0)
{
  return grid(around, up, true, false, jitter,
              [&](double u, double v) { return Vector_3(std::cos(2 * pi * u), std::sin(2 * pi * u), height * v); });
}

/// The same with two discs: two closed ridges without corners.
inline Soup capped_cylinder(std::size_t around, std::size_t up, double height)
{
  Soup s = open_cylinder(around, up, height);
  const auto add_cap = [&](Index first, double z, bool upwards) {
    std::vector<Index> ring;
    for (std::size_t i = 0; i < around; ++i) ring.push_back(first + Index(i));
    if (!upwards) std::reverse(ring.begin(), ring.end());
    const Index inner = Index(s.points.size());
    for (std::size_t i = 0; i < around; ++i) {
      const Vector_3 p = s.points[ring[i]];
      s.points.push_back(Vector_3(p[0] / 2, p[1] / 2, z));
    }
    const Index center = Index(s.points.size());
    s.points.push_back(Vector_3(0, 0, z));
    for (std::size_t i = 0; i < around; ++i) {
      const std::size_t j = (i + 1) % around;
      s.triangles.push_back({ring[i], ring[j], inner + Index(j)});
      s.triangles.push_back({ring[i], inner + Index(j), inner + Index(i)});
      s.triangles.push_back({inner + Index(i), inner + Index(j), center});
    }
  };
  add_cap(Index(around * up), height, true);
  add_cap(0, 0, false);
  return s;
}

/// What `n` copies of the line through the points (radius, height) of `profile` sweep around the z-axis, upwards.
inline Soup revolved(const std::vector<std::array<double, 2>>& profile, std::size_t n)
{
  Soup s;
  for (const auto& [radius, height] : profile)
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * pi * double(i) / double(n);
      s.points.push_back(Vector_3(radius * std::cos(angle), radius * std::sin(angle), height));
    }
  for (std::size_t row = 0; row + 1 < profile.size(); ++row)
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = Index(row * n + i), b = Index(row * n + (i + 1) % n), c = a + Index(n), d = b + Index(n);
      s.triangles.push_back({a, b, d});
      s.triangles.push_back({a, d, c});
    }
  return s;
}

/// The cube [-1, 1]^3 with `n` times `n` quadrilaterals on each side.
inline Soup cube(std::size_t n)
{
  Soup s;
  std::map<std::array<long, 3>, Index> known;
  const long m = long(n);
  const auto id = [&](std::array<long, 3> x) {
    const auto found = known.emplace(x, Index(s.points.size()));
    if (found.second)
      s.points.push_back(Vector_3(double(2 * x[0] - m), double(2 * x[1] - m), double(2 * x[2] - m)) / double(n));
    return found.first->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const long side : {0l, m})
      for (long i = 0; i < m; ++i)
        for (long j = 0; j < m; ++j) {
          const auto at = [&](long u, long v) {
            std::array<long, 3> x{};
            x[axis] = side;
            x[(axis + 1) % 3] = side == 0 ? v : u;
            x[(axis + 2) % 3] = side == 0 ? u : v;
            return id(x);
          };
          const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          s.triangles.insert(s.triangles.end(), {{a, b, c}, {a, c, d}});
        }
  return s;
}

/// The view of a manifold soup, built on its own and not by the code under test.
inline SMA::Mesh_view view(const Soup& soup)
{
  SMA::Mesh_view m;
  std::map<std::pair<Index, Index>, Index> halfedge;
  for (const Triangle& t : soup.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      halfedge[{t[i], t[(i + 1) % 3]}] = Index(m.corner.size());
      m.corner.push_back(t[i]);
    }
  m.outgoing.assign(soup.points.size(), no_index);
  m.curve.assign(m.corner.size(), SMA::no_curve);
  for (Index h = 0; h < m.corner.size(); ++h) {
    const auto t = halfedge.find({m.target(h), m.source(h)});
    m.twin.push_back(t == halfedge.end() ? no_index : t->second);
    Index& out = m.outgoing[m.source(h)];
    if (out == no_index || m.twin[h] == no_index) out = h;
  }
  return m;
}

} // namespace shapes

#endif // TEST_SURFACE_MESH_ADAPTATION_SHAPES_H

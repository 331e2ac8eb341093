// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small meshes as nobody would want them: sheets and closed shapes, noisy, squashed, with slivers, folds and holes, and
// copies that touch. A seed stands for one mesh; all are simplicial 2-manifolds.

#ifndef TEST_SURFACE_MESH_ADAPTATION_RANDOM_MESHES_H
#define TEST_SURFACE_MESH_ADAPTATION_RANDOM_MESHES_H

#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace random_meshes {

using shapes::Index;
using shapes::Soup;
using shapes::Triangle;
using shapes::Vector_3;

/// Numbers that are the same on every system, unlike those of the distributions of the standard library.
class Random
{
public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 0x2545f4914f6cdd1dull) {}

  std::uint64_t bits()
  {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
  }

  std::size_t below(std::size_t n) { return std::size_t(bits() % n); }
  bool chance(double p) { return uniform(0, 1) < p; }
  double uniform(double a, double b) { return a + (b - a) * double(bits() >> 11) * 0x1p-53; }
  /// Of all magnitudes from `a` to `b` alike.
  double magnitude(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  Vector_3 vector()
  {
    Vector_3 v; // one after the other: the order of arguments depends on the compiler
    for (int i = 0; i < 3; ++i) v[i] = uniform(-1, 1);
    return v;
  }

private:
  std::uint64_t state_;
};

inline Soup fan(std::size_t n, bool is_closed)
{
  Soup soup;
  soup.points.push_back(Vector_3::Zero());
  for (std::size_t i = 0; i < n + (is_closed ? 0 : 1); ++i) {
    const double angle = (is_closed ? 6.283185307179586 : 3) * double(i) / double(n);
    soup.points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (Index i = 0; i < n; ++i)
    soup.triangles.push_back({0, 1 + i, is_closed ? 1 + (i + 1) % Index(n) : 2 + i});
  return soup;
}

inline Soup start(Random& random)
{
  const std::size_t around = 3 + random.below(6), along = 1 + random.below(6);
  const double jitter = random.uniform(0, 0.3), height = random.magnitude(0.01, 10);
  switch (random.below(12)) {
  case 0: return shapes::tetrahedron();
  case 1: return shapes::octahedron();
  case 2: return shapes::cube(1 + random.below(3));
  case 3: return shapes::sphere(int(along) / 2, jitter);
  case 4: return shapes::torus(around, along + 2, jitter);
  case 5: return shapes::square(along, jitter);
  case 6: return shapes::open_cylinder(around, along, height);
  case 7: return shapes::capped_cylinder(around, along, height);
  case 8: return fan(around, true);
  case 9: return fan(along, false);
  case 10: return shapes::subdivided(shapes::tetrahedron());
  default: return shapes::square(1, 0);
  }
}

/// Moves every point a bit, or a few of them far: onto a neighbour, nearly onto an edge, or through the sheet.
inline void disturb(Random& random, Soup& soup)
{
  const auto other_corner = [&](Index v) {
    for (std::size_t i = random.below(soup.triangles.size()), n = 0; n < soup.triangles.size(); ++n) {
      const Triangle& t = soup.triangles[(i + n) % soup.triangles.size()];
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] == v) return std::pair(soup.points[t[(k + 1) % 3]], soup.points[t[(k + 2) % 3]]);
    }
    return std::pair(soup.points[v], soup.points[v]);
  };
  const double share = random.magnitude(0.02, 1), amount = random.magnitude(1e-9, 1);
  const std::size_t how = random.below(4);
  for (Index v = 0; v < soup.points.size(); ++v) {
    if (!random.chance(share)) continue;
    Vector_3& p = soup.points[v];
    const auto [a, b] = other_corner(v);
    switch (how) {
    case 0: p += amount * random.vector(); break;
    case 1: p += (1 - amount) * (a - p); break; // 1: coincides
    case 2: p = (a + b) / 2 + amount * (p - (a + b) / 2); break; // a sliver on the edge opposite
    default: p += random.uniform(1, 3) * ((a + b) / 2 - p); break; // folded over
    }
  }
}

/// Splits some edges in the middle, or very near one end, over and over: fans and needles.
inline void split_edges(Random& random, Soup& soup)
{
  const std::size_t splits = random.below(12);
  const double at = random.chance(0.5) ? 0.5 : random.magnitude(1e-7, 0.5);
  for (std::size_t n = 0; n < splits; ++n) {
    const Triangle t = soup.triangles[random.below(soup.triangles.size())];
    const std::size_t k = random.below(3);
    const Index a = t[k], b = t[(k + 1) % 3], m = Index(soup.points.size());
    soup.points.push_back(soup.points[a] + at * (soup.points[b] - soup.points[a]));
    for (std::size_t f = soup.triangles.size(); f-- > 0;) {
      Triangle& face = soup.triangles[f];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index p = face[i], q = face[(i + 1) % 3], r = face[(i + 2) % 3];
        if (!((p == a && q == b) || (p == b && q == a))) continue;
        face = {p, m, r};
        soup.triangles.push_back({m, q, r});
        break;
      }
    }
  }
}

/// Drops the points that no triangle uses.
inline Soup without_unused_points(const Soup& soup)
{
  Soup result;
  std::map<Index, Index> number;
  for (Triangle t : soup.triangles) {
    for (Index& v : t) {
      const auto [place, is_new] = number.emplace(v, Index(result.points.size()));
      if (is_new) result.points.push_back(soup.points[v]);
      v = place->second;
    }
    result.triangles.push_back(t);
  }
  return result;
}

/// Takes faces away and cuts the vertices apart at which several fans are left.
inline Soup with_holes(Random& random, const Soup& soup)
{
  Soup result = soup;
  const double share = random.uniform(0, 0.5);
  const auto is_dropped = [&](const Triangle&) { return random.chance(share); };
  auto& triangles = result.triangles;
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_dropped), triangles.end());
  if (triangles.empty()) return soup;
  for (Index v = Index(result.points.size()); v-- > 0;) {
    std::set<std::size_t> left; // faces at v not yet in a fan
    for (std::size_t f = 0; f < triangles.size(); ++f)
      if (std::count(triangles[f].begin(), triangles[f].end(), v)) left.insert(f);
    for (bool is_first = true; !left.empty(); is_first = false) {
      std::vector<std::size_t> component{*left.begin()};
      left.erase(left.begin());
      for (std::size_t i = 0; i < component.size(); ++i)
        for (auto it = left.begin(); it != left.end();) {
          std::size_t common = 0;
          for (const Index x : triangles[component[i]])
            common += std::size_t(std::count(triangles[*it].begin(), triangles[*it].end(), x));
          if (common < 2) { ++it; continue; }
          component.push_back(*it);
          it = left.erase(it);
        }
      if (is_first) continue;
      const Index copy = Index(result.points.size());
      result.points.push_back(Vector_3(result.points[v]));
      for (const std::size_t f : component) std::replace(triangles[f].begin(), triangles[f].end(), v, copy);
    }
  }
  return without_unused_points(result);
}

/// A copy beside it, in the same place or nearly so.
inline void add_copy(Random& random, Soup& soup)
{
  Soup copy = soup;
  const double distance = random.chance(0.3) ? 0 : random.magnitude(1e-9, 1);
  const Vector_3 shift = distance * random.vector();
  for (Vector_3& p : copy.points) p += shift;
  if (random.chance(0.5))
    for (Triangle& t : copy.triangles) std::swap(t[0], t[1]);
  shapes::append(soup, copy);
}

inline void place(Random& random, Soup& soup)
{
  Vector_3 squash(1, 1, 1);
  if (random.chance(0.2)) squash[0] = random.magnitude(1e-6, 1);
  if (random.chance(0.2)) squash[2] = random.magnitude(1e-9, 1);
  if (random.chance(0.05)) squash[2] = 0;
  const double scale = random.chance(0.3) ? random.magnitude(1e-6, 1e6) : 1;
  const double distance = random.chance(0.2) ? random.magnitude(1, 1e7) : 0;
  const Vector_3 origin = distance * scale * random.vector();
  for (Vector_3& p : soup.points) p = scale * p.cwiseProduct(squash) + origin;
}

/// The mesh of a seed.
inline Soup mesh(Random& random)
{
  Soup soup = start(random);
  if (random.chance(0.4)) split_edges(random, soup);
  if (random.chance(0.3)) soup = with_holes(random, soup);
  if (random.chance(0.7)) disturb(random, soup);
  if (random.chance(0.3)) disturb(random, soup);
  if (random.chance(0.15)) add_copy(random, soup);
  place(random, soup);
  return soup;
}

} // namespace random_meshes

#endif // TEST_SURFACE_MESH_ADAPTATION_RANDOM_MESHES_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random surfaces whose sheets come near each other in space: nested shells, shells and plates of varying thickness, folded
// sheets, spirals, combs of fingers, fins under a roof, tubes side by side. Most of them do not intersect themselves.

#ifndef TEST_SURFACE_MESH_ADAPTATION_NEAR_SHEETS_H
#define TEST_SURFACE_MESH_ADAPTATION_NEAR_SHEETS_H

#include "shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace near_sheets {

using shapes::Index;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;

/// A few waves in random directions: smooth noise of about unit height.
class Waves
{
public:
  explicit Waves(Random& random)
  {
    for (Vector_3& w : waves_) w = 4 * random.vector();
  }

  double operator()(const Vector_3& p) const
  {
    double sum = 0;
    for (const Vector_3& w : waves_) sum += std::sin(w.dot(p) + w[0]);
    return sum / double(waves_.size());
  }

private:
  std::array<Vector_3, 4> waves_;
};

/// A sphere with bumps, and noise from vertex to vertex.
inline Soup bumpy_sphere(Random& random)
{
  Soup soup = shapes::sphere(3, 0.3);
  const Waves waves(random);
  const double height = random.real(0, 0.3), noise = random.real(0, 0.02);
  for (Vector_3& p : soup.points) p *= 1 + height * waves(p) + noise * random.real(-1, 1);
  return soup;
}

/// Copies of a shape that is seen whole from its middle, each in the one before, a `gap` of it smaller and somewhat
/// beside its middle.
inline Soup nested_shells(Random& random, double gap)
{
  const Soup shell = bumpy_sphere(random);
  const Vector_3 center = 0.5 * random.real() * random.vector().normalized();
  Soup soup = shell;
  double scale = 1;
  for (std::size_t i = 1 + random.below(4); i > 0; --i) {
    scale *= 1 - (std::min)(gap, 0.3);
    Soup inner = shell;
    for (Vector_3& p : inner.points) p = center + scale * (p - center);
    if (random.below(2) == 0)
      for (shapes::Triangle& t : inner.triangles) std::swap(t[0], t[1]);
    shapes::append(soup, inner);
  }
  return soup;
}

/// The two sides of a wavy sheet, as far apart as `gap` and up to 20 times that, closed at the rim.
inline Soup plate(Random& random, double gap)
{
  constexpr Index n = 14;
  const Waves waves(random), thickness(random);
  const double height = random.real(0, 0.4);
  const Soup sheet = shapes::grid(n, n, false, false, 0.3, [](double u, double v) { return Vector_3(u, v, 0); });
  Soup soup;
  for (const double side : {0.5, -0.5})
    for (const Vector_3& p : sheet.points)
      soup.points.push_back(p + Vector_3(0, 0, height * waves(3 * p) + side * gap * (10.5 + 9.5 * thickness(3 * p))));
  const Index m = Index(sheet.points.size());
  for (const shapes::Triangle& t : sheet.triangles) {
    soup.triangles.push_back(t);
    soup.triangles.push_back({t[1] + m, t[0] + m, t[2] + m});
  }
  const auto close = [&](Index a, Index b) {
    soup.triangles.push_back({b, a, a + m});
    soup.triangles.push_back({b, a + m, b + m});
  };
  for (Index i = 0; i < n; ++i) {
    close(i, i + 1);
    close((n + 1) * (i + 1) - 1, (n + 1) * (i + 2) - 1);
    close((n + 1) * n + i + 1, (n + 1) * n + i);
    close((n + 1) * (i + 1), (n + 1) * i);
  }
  return soup;
}

using Curve = std::vector<std::array<double, 2>>;

/// The surface above a plane curve, from z = 0 to 1, bent by smooth noise that leaves planes parallel to z.
inline Soup extruded(Random& random, const Curve& curve, bool is_closed)
{
  const std::size_t n = is_closed ? curve.size() : curve.size() - 1;
  const double bend = random.real(0, 0.3), phase = random.real(0, 6);
  return shapes::grid(n, 6, is_closed, false, 0, [&](double u, double v) {
    const auto& p = curve[std::size_t(std::lround(u * double(n))) % curve.size()];
    return Vector_3(p[0] + bend * std::sin(3 * v + phase), p[1], v);
  });
}

/// A sheet folded to and fro, with the `gap` between its layers.
inline Soup folded_sheet(Random& random, double gap)
{
  Curve curve;
  const std::size_t layers = 2 + random.below(4);
  constexpr int steps = 12;
  for (std::size_t k = 0; k < layers; ++k)
    for (int i = 0; i <= steps; ++i) {
      const double x = double(k % 2 == 0 ? i : steps - i) / steps;
      curve.push_back({x, double(k) * gap + 0.2 * std::sin(3 * x)});
    }
  return extruded(random, curve, false);
}

/// A rolled sheet with the `gap` between its turns.
inline Soup spiral(Random& random, double gap)
{
  Curve curve;
  constexpr int steps = 24;
  const int turns = 2 + int(random.below(3));
  for (int i = 0; i <= steps * turns; ++i) {
    const double angle = 2 * shapes::pi * i / steps, radius = 0.4 + gap * i / steps;
    curve.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return extruded(random, curve, false);
}

/// A wall in the form of a hand: fingers of random lengths, with the `gap` between them.
inline Soup comb(Random& random, double gap)
{
  Curve curve;
  const std::size_t fingers = 2 + random.below(4);
  const double width = random.real(0.05, 0.3);
  constexpr int steps = 6;
  double x = 0;
  for (std::size_t k = 0; k < fingers; ++k) {
    const double height = random.real(0.4, 1);
    for (int i = 0; i <= steps; ++i) curve.push_back({x, height * i / steps});
    curve.push_back({x + 0.5 * width, height + 0.3 * width});
    for (int i = steps; i >= 0; --i) curve.push_back({x + width, height * i / steps});
    x += width + gap;
  }
  curve.push_back({x - gap, -0.3});
  curve.push_back({0, -0.3});
  std::reverse(curve.begin(), curve.end());
  return extruded(random, curve, true);
}

/// Thin fins, of the width `gap`, that end as far below a wavy roof.
inline Soup fins(Random& random, double gap)
{
  Curve ground, roof;
  const std::size_t number = 1 + random.below(3);
  constexpr int steps = 5;
  const double height = random.real(0.2, 0.8);
  for (std::size_t k = 0; k < number; ++k) {
    const double x = double(k);
    ground.push_back({x, 0});
    for (int i = 0; i <= steps; ++i) ground.push_back({x + 0.5 - gap / 2, height * i / steps});
    for (int i = steps; i >= 0; --i) ground.push_back({x + 0.5 + gap / 2, height * i / steps});
  }
  ground.push_back({double(number), 0});
  const int pieces = 8 * int(number);
  for (int i = 0; i <= pieces; ++i) {
    const double x = double(number) * i / pieces;
    roof.push_back({x, height + gap + 0.1 * std::pow(std::sin(shapes::pi * x + shapes::pi / 2), 2)});
  }
  Random same = random;
  Soup soup = extruded(random, ground, false);
  shapes::append(soup, extruded(same, roof, false));
  return soup;
}

/// Open tubes beside each other.
inline Soup tubes(Random& random, double gap)
{
  Soup soup;
  double x = 0;
  for (std::size_t k = 2 + random.below(3); k > 0; --k) {
    Curve circle;
    const double radius = random.real(0.1, 0.4);
    const int n = 8 + int(random.below(24));
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * shapes::pi * i / n;
      circle.push_back({x + radius - radius * std::cos(angle), -radius * std::sin(angle)});
    }
    Random same(1); // all are bent in the same way
    shapes::append(soup, extruded(same, circle, true));
    x += 2 * radius + gap;
  }
  return soup;
}

struct Named_soup
{
  std::string name;
  Soup soup;
};

constexpr std::size_t number_of_kinds = 7;

/// A shape of the kind `seed` modulo `number_of_kinds`, with gaps between 1e-4 and 1.
inline Named_soup shape(std::uint64_t seed)
{
  Random random(1000 + seed);
  const double gap = std::pow(10.0, random.real(-4, 0));
  switch (seed % number_of_kinds) {
  case 0: return {"nested shells", nested_shells(random, gap)};
  case 1: return {"plate", plate(random, gap / 10)};
  case 2: return {"folded sheet", folded_sheet(random, gap)};
  case 3: return {"spiral", spiral(random, gap)};
  case 4: return {"comb", comb(random, gap)};
  case 5: return {"fins", fins(random, (std::min)(gap, 0.5))};
  default: return {"tubes", tubes(random, gap)};
  }
}

} // namespace near_sheets

#endif // TEST_SURFACE_MESH_ADAPTATION_NEAR_SHEETS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tessellations as CAD systems make them, of shapes with known distances: facets as long as a face is, with any
// diagonals, and further vertices on their borders and in planes, rotated, far from the origin, in single precision.

#include "checks.h"
#include "policies.h"
#include "tessellations.h"

#include <CGAL/convex_hull_3.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace test_cad_tessellations {

using namespace tessellations_of_tests;

/// Convex planar polygons, whose corners are found again by their coordinates.
class Polygons
{
public:
  std::vector<Vector_3> points;
  std::vector<Polygon> polygons;

  void add(const std::vector<Vector_3>& corners)
  {
    Polygon polygon;
    for (const Vector_3& p : corners) {
      const Index v = vertex(p);
      if (std::find(polygon.begin(), polygon.end(), v) == polygon.end()) polygon.push_back(v);
    }
    if (polygon.size() > 2) polygons.push_back(polygon);
  }

  void add(const Polygons& others)
  {
    for (const Polygon& polygon : others.polygons) {
      std::vector<Vector_3> corners;
      for (const Index v : polygon) corners.push_back(others.points[v]);
      add(corners);
    }
  }

private:
  Index vertex(const Vector_3& p)
  {
    std::array<long, 3> key;
    for (std::size_t i = 0; i < 3; ++i) key[i] = std::lround(p[Eigen::Index(i)] * 1e9);
    const auto [found, is_new] = ids_.insert({key, Index(points.size())});
    if (is_new) points.push_back(p);
    return found->second;
  }

  std::map<std::array<long, 3>, Index> ids_;
};

/// Puts a vertex on some of the edges: on both of the polygons there.
void split_edges(Random& random, Polygons& p, double share)
{
  std::map<std::pair<Index, Index>, Index> middle; // no_index: the edge stays whole
  for (Polygon& polygon : p.polygons) {
    Polygon longer;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Index v = polygon[i], w = polygon[(i + 1) % polygon.size()];
      const auto [found, is_new] = middle.insert({std::minmax(v, w), shapes::no_index});
      if (is_new && random.real() < share) {
        const double t = random.real(0.1, 0.9);
        found->second = Index(p.points.size());
        p.points.push_back((1 - t) * p.points[v] + t * p.points[w]);
      }
      longer.push_back(v);
      if (found->second != shapes::no_index) longer.push_back(found->second);
    }
    polygon = longer;
  }
}

Vector_3 twice_area(const std::vector<Vector_3>& points, const Polygon& p)
{
  Vector_3 sum = Vector_3::Zero();
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    sum += (points[p[i]] - points[p[0]]).cross(points[p[i + 1]] - points[p[0]]);
  return sum;
}

/// Cuts a convex polygon into triangles along random diagonals, none of which is on its border.
void triangulate(Random& random, const std::vector<Vector_3>& points, Polygon p, Soup& soup)
{
  const double least = 1e-6 * twice_area(points, p).norm();
  while (p.size() > 3) {
    const std::size_t n = p.size(), i = random.below(n);
    const Polygon ear{p[(i + n - 1) % n], p[i], p[(i + 1) % n]};
    Polygon rest = p;
    rest.erase(rest.begin() + std::ptrdiff_t(i));
    if (!(twice_area(points, ear).norm() > least) || !(twice_area(points, rest).norm() > least)) continue;
    soup.triangles.push_back({ear[0], ear[1], ear[2]});
    p = rest;
  }
  soup.triangles.push_back({p[0], p[1], p[2]});
}

/// Puts a vertex near a side into the triangle `t`.
void split_triangle(Random& random, Soup& soup, std::size_t t)
{
  const shapes::Triangle abc = soup.triangles[t];
  const double u = random.real(0.05, 0.9), v = random.real(0.05, 0.95 - u), w = 1 - u - v;
  const Index m = Index(soup.points.size());
  soup.points.push_back(u * soup.points[abc[0]] + v * soup.points[abc[1]] + w * soup.points[abc[2]]);
  soup.triangles[t] = {abc[0], abc[1], m};
  soup.triangles.push_back({abc[1], abc[2], m});
  soup.triangles.push_back({abc[2], abc[0], m});
}

/// A shape with its tessellation, and what is known of it.
struct Part
{
  Polygons polygons;
  std::function<double(const Vector_3&)> distance; ///< to its surface
  std::function<bool(const Vector_3&)> is_flat;    ///< whether its surface is a plane next to a point
  double sag;                                      ///< largest distance of the tessellation
  double size;                                     ///< to adapt to
};

struct Variant
{
  std::string name;
  double split_edges = 0;  ///< share of the edges with a further vertex
  bool in_planes = false;  ///< whether planes have vertices inside
  bool is_rotated = false;
  Vector_3 shift{0, 0, 0};
  bool is_single = false;  ///< single precision
  double more_rms = 1;     ///< times what the rms distance may be
};

/// A part as a file has it, and the way back.
struct Placed
{
  Soup soup;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector_3 shift{0, 0, 0};
  double rounding;

  Vector_3 back(const Vector_3& p) const { return rotation.transpose() * (p - shift); }
};

Placed placed(const Part& part, const Variant& variant, std::uint64_t seed)
{
  Random random(seed);
  Polygons p = part.polygons;
  split_edges(random, p, variant.split_edges);
  Placed result;
  result.soup.points = p.points;
  for (const Polygon& polygon : p.polygons) {
    Vector_3 center = Vector_3::Zero();
    for (const Index v : polygon) center += p.points[v] / double(polygon.size());
    const std::size_t first = result.soup.triangles.size();
    triangulate(random, p.points, polygon, result.soup);
    if (!variant.in_planes || !part.is_flat(center)) continue;
    for (int i = 0; i < 4; ++i)
      split_triangle(random, result.soup, first + random.below(result.soup.triangles.size() - first));
  }
  if (variant.is_rotated) {
    const Vector_3 axis = random.vector().normalized();
    result.rotation = Eigen::AngleAxisd(random.real(0, pi), axis).toRotationMatrix();
  }
  result.shift = variant.shift;
  double largest = 0;
  for (Vector_3& x : result.soup.points) {
    x = result.rotation * x + result.shift;
    if (variant.is_single) x = x.cast<float>().cast<double>();
    largest = (std::max)(largest, x.lpNorm<Eigen::Infinity>());
  }
  result.rounding = largest * (variant.is_single ? 1.2e-7 : 2.3e-16);
  return result;
}

struct Errors
{
  double largest = 0, rms = 0, flat = 0; ///< distances of the vertices; of those in planes
};

Errors errors(const Part& part, const Placed& placed, const Soup& adapted)
{
  Errors e;
  for (const Vector_3& x : adapted.points) {
    const Vector_3 p = placed.back(x);
    const double d = std::abs(part.distance(p));
    e.largest = (std::max)(e.largest, d);
    e.rms += d * d / double(adapted.points.size());
    if (part.is_flat(p)) e.flat = (std::max)(e.flat, d);
  }
  e.rms = std::sqrt(e.rms);
  return e;
}

// Parts

/// A box with the half sides `half` and all edges and corners rounded by `r`, in `k` chords for each quarter.
Part rounded_box(const Vector_3& half, double r, int k)
{
  const Vector_3 inner = half - Vector_3(r, r, r);
  struct Angle
  {
    double angle;
    int center;
  };
  std::vector<Angle> around, up;
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i <= k; ++i) around.push_back({(q + double(i) / k) * pi / 2, q});
  for (int q = 0; q < 2; ++q)
    for (int i = 0; i <= k; ++i) up.push_back({(q - 1 + double(i) / k) * pi / 2, q});
  const auto point = [&](const Angle& a, const Angle& b) -> Vector_3 {
    const bool is_left = a.center == 1 || a.center == 2, is_front = a.center >= 2;
    const Vector_3 center(is_left ? -inner[0] : inner[0], is_front ? -inner[1] : inner[1],
                          b.center == 0 ? -inner[2] : inner[2]);
    const Vector_3 d(std::cos(b.angle) * std::cos(a.angle), std::cos(b.angle) * std::sin(a.angle), std::sin(b.angle));
    return center + r * d;
  };
  Part part;
  const std::size_t n = around.size();
  for (std::size_t j = 0; j + 1 < up.size(); ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const Angle &a = around[i], &b = around[(i + 1) % n];
      part.polygons.add({point(a, up[j]), point(b, up[j]), point(b, up[j + 1]), point(a, up[j + 1])});
    }
  for (const double z : {-1.0, 1.0}) { // counterclockwise from above, and from below
    const double x = inner[0], y = z * inner[1];
    part.polygons.add({{x, y, z * half[2]}, {-x, y, z * half[2]}, {-x, -y, z * half[2]}, {x, -y, z * half[2]}});
  }
  part.distance = [=](const Vector_3& p) {
    const Vector_3 d = p.cwiseAbs() - inner;
    return d.cwiseMax(0.0).norm() + (std::min)(0.0, d.maxCoeff()) - r;
  };
  part.is_flat = [=](const Vector_3& p) { return (p.cwiseAbs().array() < (inner.array() - 1e-9)).count() >= 2; };
  part.sag = 2 * r * (1 - std::cos(pi / (4 * k)));
  part.size = half.norm() / 20;
  return part;
}

/// What rotates about the z axis: straight pieces and arcs, the latter in chords; from the axis to the axis.
struct Profile
{
  std::vector<std::array<double, 2>> points;
  std::function<double(double, double)> distance;
};

Part revolved(const Profile& profile, std::size_t n, double sag, double size)
{
  Part part;
  const auto point = [&](std::size_t i, std::size_t j) -> Vector_3 {
    const double angle = 2 * pi * double(j % n) / double(n);
    return {profile.points[i][0] * std::cos(angle), profile.points[i][0] * std::sin(angle), profile.points[i][1]};
  };
  const auto cap = [&](std::size_t i, bool is_top) {
    std::vector<Vector_3> corners;
    for (std::size_t j = 0; j < n; ++j) corners.push_back(point(i, is_top ? j : n - j));
    part.polygons.add(corners);
  };
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i)
    for (std::size_t j = 0; j < n; ++j)
      part.polygons.add({point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)});
  cap(0, false);
  cap(profile.points.size() - 1, true);
  part.distance = [=](const Vector_3& p) { return profile.distance(std::hypot(p[0], p[1]), p[2]); };
  const double low = profile.points.front()[1], high = profile.points.back()[1];
  const double r_low = profile.points.front()[0], r_high = profile.points.back()[0];
  part.is_flat = [=](const Vector_3& p) { // the caps, but for their rims
    const double r = std::hypot(p[0], p[1]), inside = std::cos(pi / double(n)) - 1e-6;
    return (p[2] < low + 1e-2 && r < r_low * inside) || (p[2] > high - 1e-2 && r < r_high * inside);
  };
  part.sag = sag;
  part.size = size;
  return part;
}

double distance_to_segment(double x, double y, const std::array<double, 2>& a, const std::array<double, 2>& b)
{
  return checks::distance_to_segment(Vector_3(x, y, 0), Vector_3(a[0], a[1], 0), Vector_3(b[0], b[1], 0));
}

/// A frustum of a cone, radii 1 and .6 and two high, whose rims are rounded by arcs that touch cap and cone.
Part rounded_frustum(std::size_t n, int k)
{
  constexpr double r = 0.15;
  const std::array<double, 2> a{1, 0}, b{0.6, 2};
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]), nx = (b[1] - a[1]) / length, ny = (a[0] - b[0]) / length;
  // centers of the arcs: `r` inside of the cap and of the cone
  const auto center = [&](double y) -> std::array<double, 2> { return {a[0] + (-r - (y - a[1]) * ny) / nx, y}; };
  const auto low = center(r), high = center(2 - r);
  const double slope = std::atan2(ny, nx);
  Profile profile;
  for (int i = 0; i <= k; ++i) {
    const double t = -pi / 2 + (slope + pi / 2) * i / k;
    profile.points.push_back({low[0] + r * std::cos(t), low[1] + r * std::sin(t)});
  }
  for (int i = 0; i <= k; ++i) {
    const double t = slope + (pi / 2 - slope) * i / k;
    profile.points.push_back({high[0] + r * std::cos(t), high[1] + r * std::sin(t)});
  }
  const std::array<double, 2> from = profile.points[std::size_t(k)], to = profile.points[std::size_t(k) + 1];
  profile.distance = [=](double x, double y) {
    double d =
      (std::min)(distance_to_segment(x, y, {0, 0}, {low[0], 0}), distance_to_segment(x, y, {0, 2}, {high[0], 2}));
    d = (std::min)(d, distance_to_segment(x, y, from, to));
    for (const auto& c : {low, high}) {
      const double angle = std::atan2(y - c[1], x - c[0]);
      const bool is_low = c == low;
      if (is_low ? angle > -pi / 2 && angle < slope : angle > slope && angle < pi / 2)
        d = (std::min)(d, std::abs(std::hypot(x - c[0], y - c[1]) - r));
    }
    return d;
  };
  return revolved(profile, n, 1 - std::cos(pi / double(n)), 0.08);
}

/// An arc about `center` that replaces the straight piece from corner `from` on of a line, in `k` chords.
struct Arc
{
  std::size_t from = shapes::no_index;
  std::array<double, 2> center{0, 0};
  int k = 1;

  double radius(const std::array<double, 2>& p) const { return std::hypot(p[0] - center[0], p[1] - center[1]); }
  double angle(const std::array<double, 2>& p) const { return std::atan2(p[1] - center[1], p[0] - center[0]); }
};

using Corners = std::vector<std::array<double, 2>>;

double distance_to_line(const Corners& corners, const Arc& arc, const std::array<double, 2>& p)
{
  double d = (std::min)(distance_to_segment(p[0], p[1], {0, corners.front()[1]}, corners.front()),
                        distance_to_segment(p[0], p[1], {0, corners.back()[1]}, corners.back()));
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[i + 1];
    if (i != arc.from) d = (std::min)(d, distance_to_segment(p[0], p[1], a, b));
    else if (arc.angle(a) < arc.angle(p) && arc.angle(p) < arc.angle(b))
      d = (std::min)(d, std::abs(arc.radius(p) - arc.radius(a)));
  }
  return d;
}

/// What a line through `corners` sweeps, which an arc may be part of, between two caps; straight pieces in `rows` rows.
Part turned(const Corners& corners, const Arc& arc, std::size_t n, int rows)
{
  Profile profile;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[i + 1];
    const int pieces = i == arc.from ? arc.k : rows;
    for (int j = 0; j < pieces; ++j) {
      const double t = double(j) / pieces, angle = (1 - t) * arc.angle(a) + t * arc.angle(b), r = arc.radius(a);
      if (i != arc.from) profile.points.push_back({(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]});
      else profile.points.push_back({arc.center[0] + r * std::cos(angle), arc.center[1] + r * std::sin(angle)});
    }
  }
  profile.points.push_back(corners.back());
  profile.distance = [=](double x, double y) { return distance_to_line(corners, arc, {x, y}); };
  double largest = 0;
  for (const auto& p : corners) largest = (std::max)(largest, p[0]);
  return revolved(profile, n, largest * (1 - std::cos(pi / double(n))), 0.08);
}

/// Two cylinders with a cone between them, which meets them at an angle of `degrees`.
Part shaft(double degrees, std::size_t n, int rows)
{
  const double height = 0.4 / std::tan(degrees * pi / 180);
  return turned({{0.8, 0}, {0.8, 1}, {0.4, 1 + height}, {0.4, 2 + height}}, {}, n, rows);
}

/// A cylinder, a cone, a piece of a torus and a cone again, each at 30 degrees to the one before.
Part knob(std::size_t n, int rows)
{
  const double y = 1, r = 0.6, c = std::cos(pi / 6);
  const Arc arc{2, {0.4, y}, 6}; // starts upright and ends at 60 degrees to that
  const Corners corners{
    {0.8, 0}, {0.8, y - 0.4 * c}, {1, y}, {0.4 + r / 2, y + r * c}, {0.3 + r / 2, y + (r + 0.2) * c}};
  return turned(corners, arc, n, rows);
}

/// A plate with the half sides 1, 1 and .2 and a bore of radius .5, in `4 k` chords.
Part drilled_plate(int k)
{
  constexpr double r = 0.5, h = 0.2;
  Part part;
  const int n = 4 * k;
  const auto inner = [&](int i, double z) -> Vector_3 {
    const double t = 2 * pi * (i % n) / n;
    return {r * std::cos(t), r * std::sin(t), z};
  };
  const auto outer = [&](int i, double z) -> Vector_3 { // corners of the square at odd multiples of k / 2
    const Vector_3 d = inner(i, 0) / inner(i, 0).lpNorm<Eigen::Infinity>();
    return {d[0], d[1], z};
  };
  for (int i = 0; i < n; ++i) {
    part.polygons.add({inner(i, h), outer(i, h), outer(i + 1, h), inner(i + 1, h)});
    part.polygons.add({inner(i + 1, -h), outer(i + 1, -h), outer(i, -h), inner(i, -h)});
    part.polygons.add({outer(i, -h), outer(i + 1, -h), outer(i + 1, h), outer(i, h)});
    part.polygons.add({inner(i + 1, -h), inner(i, -h), inner(i, h), inner(i + 1, h)});
  }
  part.distance = [=](const Vector_3& p) {
    const Vector_3 d = p.cwiseAbs() - Vector_3(1, 1, h);
    const double in_box = d.cwiseMax(0.0).norm() + (std::min)(0.0, d.maxCoeff());
    return (std::max)(in_box, r - std::hypot(p[0], p[1]));
  };
  part.is_flat = [=](const Vector_3& p) { return std::hypot(p[0], p[1]) > 1.1 * r; };
  part.sag = r * (1 - std::cos(pi / n));
  part.size = 0.07;
  return part;
}

/// The prism below the polygon `top`, which is at one height, down to the height `z`.
Polygons prism(const std::vector<Vector_3>& top, double z)
{
  std::vector<Vector_3> bottom;
  for (const Vector_3& p : top) bottom.insert(bottom.begin(), Vector_3(p[0], p[1], z));
  Polygons result;
  result.add(top);
  result.add(bottom);
  const std::size_t n = top.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    result.add({bottom[n - 1 - i], bottom[n - 1 - j], top[j], top[i]});
  }
  return result;
}

/// A rectangle with the half sides `x` and `y` and arcs of radius `r` around it, in `k` chords each, at the height `z`.
std::vector<Vector_3> rounded_outline(double x, double y, double r, int k, double z)
{
  std::vector<Vector_3> points;
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i <= k; ++i) {
      const double t = (q + double(i) / k) * pi / 2;
      points.push_back({(q == 0 || q == 3 ? x : -x) + r * std::cos(t), (q < 2 ? y : -y) + r * std::sin(t), z});
    }
  return points;
}

/// How far `p` is outside of that outline, seen from above; negative inside.
double outside_of_outline(const Vector_3& p, double x, double y, double r)
{
  const double dx = std::abs(p[0]) - x, dy = std::abs(p[1]) - y;
  return std::hypot((std::max)(dx, 0.0), (std::max)(dy, 0.0)) + (std::min)(0.0, (std::max)(dx, dy)) - r;
}

/// A plate of which the four upright edges are rounded, in `k` chords each: long edges and short ones on its outlines.
Part rounded_plate(int k)
{
  constexpr double x = 1.6, y = 0.6, r = 0.4, h = 0.2;
  Part part;
  part.polygons = prism(rounded_outline(x, y, r, k, h), -h);
  part.distance = [=](const Vector_3& p) {
    const double d = outside_of_outline(p, x, y, r), dz = std::abs(p[2]) - h;
    return std::hypot((std::max)(d, 0.0), (std::max)(dz, 0.0)) + (std::min)(0.0, (std::max)(d, dz));
  };
  part.is_flat = [=](const Vector_3& p) { return std::abs(p[0]) < x - 1e-6 || std::abs(p[1]) < y - 1e-6; };
  part.sag = r * (1 - std::cos(pi / (4 * k)));
  part.size = 0.08;
  return part;
}

/// A rod of radius .3 that is bent by a right angle between two straight pieces of length 1, in `around` chords, an even
/// number, and `along` the bend. Its flanks are in planes: facets that go around the bend.
Part elbow(std::size_t around, std::size_t along)
{
  constexpr double r = 0.3, length = 1;
  std::vector<std::pair<Vector_3, Vector_3>> sections; // the center, and the direction that is across the bend
  sections.emplace_back(Vector_3(0, 0, 0), Vector_3(1, 0, 0));
  for (std::size_t i = 0; i <= along; ++i) {
    const double angle = pi / 2 * double(i) / double(along);
    const Vector_3 across(std::cos(angle), 0, -std::sin(angle));
    sections.emplace_back(Vector_3(1, 0, length) - across, across);
  }
  sections.emplace_back(Vector_3(1 + length, 0, length + 1), Vector_3(0, 0, -1));
  const auto point = [&](std::size_t j, std::size_t i) -> Vector_3 {
    const double angle = (double(i) + 0.5) * 2 * pi / double(around);
    return sections[j].first + r * (std::sin(angle) * sections[j].second + Vector_3(0, std::cos(angle), 0));
  };
  Part part;
  std::vector<Vector_3> bottom, top;
  for (std::size_t i = 0; i < around; ++i) {
    for (std::size_t j = 0; j + 1 < sections.size(); ++j)
      part.polygons.add({point(j + 1, i), point(j + 1, i + 1), point(j, i + 1), point(j, i)});
    bottom.push_back(point(0, i));
    top.push_back(point(sections.size() - 1, around - 1 - i));
  }
  part.polygons.add(bottom);
  part.polygons.add(top);
  part.distance = [=](const Vector_3& p) {
    const double low = std::hypot(p[0], p[1]), high = std::hypot(p[1], p[2] - length - 1);
    const double bend = std::hypot(std::hypot(p[0] - 1, p[2] - length) - 1, p[1]);
    const double side = std::abs((p[2] <= length ? low : p[0] >= 1 ? high : bend) - r);
    return (std::min)({side, std::abs(p[2]), std::abs(p[0] - 1 - length)});
  };
  part.is_flat = [=](const Vector_3& p) {
    return (std::abs(p[2]) < 1e-6 && std::hypot(p[0], p[1]) < r - 1e-2) ||
           (std::abs(p[0] - 1 - length) < 1e-6 && std::hypot(p[1], p[2] - length - 1) < r - 1e-2);
  };
  part.sag = r * (1 - std::cos(pi / double(around))) + (1 + r) * (1 - std::cos(pi / double(4 * along)));
  part.size = 0.1;
  return part;
}

/// Of a line over the x axis, from near it.
double distance_to_line(const Corners& line, double x, double y)
{
  constexpr double near = 0.1;
  double d = near;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (line[i][0] < x + near && line[i + 1][0] > x - near)
      d = (std::min)(d, distance_to_segment(x, y, line[i], line[i + 1]));
  return d;
}

/// A plate of height and width 1 between `line` and what is straight below that, with `chords` in its place. Straight
/// pieces of it are long edges.
Part plate_below(const Corners& line, const Corners& chords)
{
  constexpr double half = 0.5, height = 1;
  const std::array<double, 2> first = chords.front(), last = chords.back();
  const auto at = [=](const std::array<double, 2>& p, double y, double z) -> Vector_3 { return {p[0], p[1] + y, z}; };
  Part part;
  for (std::size_t i = 0; i + 1 < chords.size(); ++i) {
    const auto &a = chords[i], &b = chords[i + 1];
    part.polygons.add({at(a, 0, half), at(b, 0, half), at(b, 0, -half), at(a, 0, -half)});
    part.polygons.add({at(a, -height, -half), at(b, -height, -half), at(b, -height, half), at(a, -height, half)});
    part.polygons.add({at(a, -height, half), at(b, -height, half), at(b, 0, half), at(a, 0, half)});
    part.polygons.add({at(a, 0, -half), at(b, 0, -half), at(b, -height, -half), at(a, -height, -half)});
  }
  const auto end = [&](const auto& p, double z) {
    part.polygons.add({at(p, -height, -z), at(p, -height, z), at(p, 0, z), at(p, 0, -z)});
  };
  end(first, half);
  end(last, -half);
  part.distance = [=](const Vector_3& p) {
    const double to_ends = (std::min)(std::abs(p[0] - first[0]), std::abs(p[0] - last[0]));
    const double to_sides = std::abs(std::abs(p[2]) - half);
    const double to_lines =
      (std::min)(distance_to_line(line, p[0], p[1]), distance_to_line(line, p[0], p[1] + height));
    return (std::min)({to_ends, to_sides, to_lines});
  };
  part.is_flat = [=](const Vector_3& p) {
    const auto is_before = [](double x, const std::array<double, 2>& q) { return x < q[0]; };
    const auto behind = std::upper_bound(line.begin(), line.end(), p[0], is_before);
    if (behind == line.begin() || behind == line.end()) return true;
    const auto &a = *(behind - 1), &b = *behind;
    if (b[0] - a[0] > 0.1 && p[0] > a[0] + 1e-6 && p[0] < b[0] - 1e-6) return true;
    return p[1] < (std::min)(a[1], b[1]) - 0.1 && p[1] > (std::max)(a[1], b[1]) + 0.1 - height;
  };
  part.sag = 0;
  for (const auto& p : line) part.sag = (std::max)(part.sag, distance_to_line(chords, p[0], p[1]));
  part.size = 0.1;
  return part;
}

/// Below a sine with a new chord wherever the tangent has turned by `angle`: by far the longest ones are where the
/// curvature changes its sign.
Part wave(double height, double angle)
{
  const auto point = [=](double x) -> std::array<double, 2> { return {x, height * std::sin(x)}; };
  const auto direction = [=](double x) { return std::atan(height * std::cos(x)); };
  const double first = 0.4, last = 8.6; // two changes between
  Corners line, chords{point(first)};
  for (double x = first, from = first; x < last; x += 0.001) {
    line.push_back(point(x));
    if (std::abs(direction(x) - direction(from)) < angle) continue;
    chords.push_back(point(x));
    from = x;
  }
  line.push_back(point(last));
  chords.push_back(point(last));
  return plate_below(line, chords);
}

/// Below an arc, a straight piece and an arc that bends back, of `k` chords each.
Part double_bend(double angle, double length, int k)
{
  Corners line, chords;
  const auto arc = [&](const std::array<double, 2>& center, double from, double to) {
    const int steps = 400 * k;
    for (int i = 0; i <= steps; ++i) {
      const double t = from + (to - from) * i / steps;
      line.push_back({center[0] + std::cos(t), center[1] + std::sin(t)});
      if (i % 400 == 0) chords.push_back(line.back());
    }
  };
  arc({0, 1}, -pi / 2, angle - pi / 2);
  const double x = 2 * std::sin(angle) + length * std::cos(angle);
  const double y = 1 - 2 * std::cos(angle) + length * std::sin(angle);
  arc({x, y}, angle + pi / 2, pi / 2);
  return plate_below(line, chords);
}

/// A box with sharp edges.
Part box()
{
  Part part;
  const Vector_3 half(1, 0.6, 0.3);
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const auto point = [&](double x, double y) -> Vector_3 {
        Vector_3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = x;
        p[(axis + 2) % 3] = y * side;
        return p.cwiseProduct(half);
      };
      part.polygons.add({point(-1, -1), point(1, -1), point(1, 1), point(-1, 1)});
    }
  part.distance = [=](const Vector_3& p) {
    const Vector_3 d = p.cwiseAbs() - half;
    return d.cwiseMax(0.0).norm() + (std::min)(0.0, d.maxCoeff());
  };
  part.is_flat = [](const Vector_3&) { return true; };
  part.sag = 0;
  part.size = 0.1;
  return part;
}

/// A point of the ellipse with the half axes `a` and 1, or of the curve that is `inwards` of that.
Vector_3 on_ellipse(double a, double angle, double inwards, double z)
{
  const double c = std::cos(angle), s = std::sin(angle), length = std::hypot(c, a * s);
  return {a * c - inwards * c / length, s - inwards * a * s / length, z};
}

/// Angles around a circle, at random places of equal intervals.
std::vector<double> angles_around(Random& random, std::size_t n)
{
  std::vector<double> angles;
  for (std::size_t i = 0; i < n; ++i) angles.push_back(2 * pi * (double(i) + random.real(-0.2, 0.2)) / double(n));
  return angles;
}

/// An elliptic prism with a chamfer of half a right angle, whose quadrangles are in no plane.
Polygons chamfered_ellipse(Random& random, double a, double chamfer, std::size_t n)
{
  Polygons result;
  std::vector<Vector_3> bottom, wall, top;
  for (const double angle : angles_around(random, n)) {
    bottom.push_back(on_ellipse(a, angle, 0, 0));
    wall.push_back(on_ellipse(a, angle, 0, 0.5));
    top.push_back(on_ellipse(a, angle, chamfer, 0.5 + chamfer));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    result.add({bottom[i], bottom[j], wall[j], wall[i]});
    result.add({wall[i], wall[j], top[j], top[i]});
  }
  result.add(top);
  std::reverse(bottom.begin(), bottom.end());
  result.add(bottom);
  return result;
}

/// Triangles between two closed curves around the z axis that have vertices at angles of their own.
template <class Below, class Above>
void add_strip(Polygons& polygons, const std::vector<double>& below, const std::vector<double>& above,
               const Below& at_below, const Above& at_above)
{
  const std::size_t n = below.size(), m = above.size();
  const auto corner = [](const std::vector<double>& angles, std::size_t i, const auto& at) {
    return Vector_3(at(angles[i % angles.size()]));
  };
  const auto after = [](const std::vector<double>& angles, std::size_t i) {
    const std::size_t k = angles.size();
    return i < k ? angles[(i + 1) % k] + (i + 1 < k ? 0 : 2 * pi) : 4 * pi;
  };
  for (std::size_t i = 0, j = 0; i < n || j < m;) {
    const Vector_3 low = corner(below, i, at_below), high = corner(above, j, at_above);
    if (after(below, i) < after(above, j)) polygons.add({low, corner(below, ++i, at_below), high});
    else polygons.add({low, corner(above, ++j, at_above), high});
  }
}

/// A cylinder of radius 1 from z = 0 to the plane z = `length` + `slope` x, with `n` vertices at one end and `m` at the
/// other: no edge is a ruling.
Part cut_cylinder(Random& random, double length, double slope, std::size_t n, std::size_t m)
{
  const std::vector<double> below = angles_around(random, n), above = angles_around(random, m);
  const auto at_bottom = [](double angle) -> Vector_3 { return {std::cos(angle), std::sin(angle), 0}; };
  const auto at_top = [=](double angle) -> Vector_3 {
    return {std::cos(angle), std::sin(angle), length + slope * std::cos(angle)};
  };
  Part part;
  std::vector<Vector_3> bottom, top;
  for (const double angle : below) bottom.insert(bottom.begin(), at_bottom(angle));
  for (const double angle : above) top.push_back(at_top(angle));
  part.polygons.add(bottom);
  part.polygons.add(top);
  add_strip(part.polygons, below, above, at_bottom, at_top);
  const double down = 1 / std::hypot(1, slope);
  part.distance = [=](const Vector_3& p) {
    const double to_plane = std::abs(p[2] - length - slope * p[0]) * down;
    return (std::min)({std::abs(std::hypot(p[0], p[1]) - 1), std::abs(p[2]), to_plane});
  };
  part.is_flat = [](const Vector_3& p) { return std::abs(p[2]) < 1e-9; };
  part.sag = 1 - std::cos(1.4 * pi / double((std::min)(n, m)));
  part.size = 0.15;
  return part;
}

/// Triangles between two curves from one point to another one, with vertices at angles of their own.
template <class Right, class Left>
void add_lune(Polygons& polygons, const std::vector<double>& right, const std::vector<double>& left, const Right& at_right,
              const Left& at_left)
{
  polygons.add({at_right(right[0]), at_right(right[1]), at_left(left[1])});
  for (std::size_t i = 1, j = 1; i + 2 < right.size() || j + 2 < left.size();) {
    const Vector_3 a = at_right(right[i]), b = at_left(left[j]);
    const bool is_right = j + 2 == left.size() || (i + 2 < right.size() && right[i + 1] < left[j + 1]);
    if (is_right) polygons.add({a, at_right(right[++i]), b});
    else polygons.add({a, at_left(left[++j]), b});
  }
  polygons.add({at_right(right[right.size() - 2]), at_right(right.back()), at_left(left[left.size() - 2])});
}

/// Two pipes of radius 1 along the z and the x axis, with ends at a distance of `length`: where they touch, the edges
/// between them fade. These have `k` chords on either side of there, the ends `m` vertices.
Part crossing_pipes(Random& random, double length, std::size_t k, std::size_t m)
{
  std::vector<double> on_edge{-pi / 2, pi / 2};
  for (std::size_t i = 1; i < k; ++i) {
    const double angle = (double(i) + random.real(-0.2, 0.2)) / double(k) * pi - pi / 2;
    on_edge.push_back(angle);
    on_edge.push_back(pi - angle);
  }
  std::sort(on_edge.begin(), on_edge.end());
  const std::vector<double> at_end = angles_around(random, m);
  Part part;
  for (int arm = 0; arm < 4; ++arm) {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(arm * pi / 2, Vector_3::UnitY()).toRotationMatrix();
    const auto at = [&](double angle, double z) -> Vector_3 {
      return turned * Vector_3(std::cos(angle), std::sin(angle), z);
    };
    const auto start = [&](double angle) { return at(angle, std::abs(std::cos(angle))); };
    const auto end = [&](double angle) { return at(angle, length); };
    // both from -pi / 2 on
    std::vector<double> ends = at_end;
    for (double& angle : ends) angle -= pi / 2;
    add_strip(part.polygons, on_edge, ends, start, end);
    std::vector<Vector_3> cap;
    for (const double angle : ends) cap.push_back(end(angle));
    part.polygons.add(cap);
  }
  part.distance = [=](const Vector_3& p) {
    const double upright = (std::max)(std::hypot(p[0], p[1]) - 1, std::abs(p[2]) - length);
    const double lying = (std::max)(std::hypot(p[1], p[2]) - 1, std::abs(p[0]) - length);
    return (std::min)(upright, lying);
  };
  part.is_flat = [=](const Vector_3& p) { return (std::max)(std::abs(p[0]), std::abs(p[2])) > length - 1e-9; };
  part.sag = 1 - std::cos(1.4 * pi / double((std::min)(2 * k, m)));
  part.size = 0.15;
  return part;
}

/// What two pipes of radius 1 along the z and the x axis have in common: four pieces of cylinders between the poles on the
/// y axis, where the edges between them fade to nothing. These have about `k` chords each, at angles of their own, and no
/// two triangles are in one plane.
Part common_of_pipes(Random& random, std::size_t k)
{
  std::array<std::vector<double>, 4> edges; // angles from pole to pole
  for (std::vector<double>& edge : edges) {
    const std::size_t n = k + random.below(k / 4);
    for (std::size_t i = 0; i <= n; ++i)
      edge.push_back((double(i) + (i % n == 0 ? 0 : random.real(-0.2, 0.2))) / double(n) * pi - pi / 2);
  }
  Part part;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = [](std::size_t edge, double angle) -> Vector_3 {
      const double x = edge == 0 || edge == 3 ? 1 : -1, z = edge < 2 ? 1 : -1;
      if (std::abs(angle) > pi / 2 - 1e-9) return {0, angle > 0 ? 1.0 : -1.0, 0}; // one point for all
      return {x * std::cos(angle), std::sin(angle), z * std::cos(angle)};
    };
    add_lune(part.polygons, edges[i], edges[(i + 1) % 4], [&](double angle) { return at(i, angle); },
             [&](double angle) { return at((i + 1) % 4, angle); });
  }
  part.distance = [](const Vector_3& p) {
    return (std::max)(std::hypot(p[0], p[1]), std::hypot(p[1], p[2])) - 1;
  };
  part.is_flat = [](const Vector_3&) { return false; };
  part.sag = 1 - std::cos(0.7 * pi / double(k));
  part.size = 0.1;
  return part;
}

/// A cylinder of radius 1 from z = `length` down to z = 0, with `n` rulings, that ends in half a ball whose triangles
/// have no edges along the meridians.
Part rounded_post(Random& random, double length, std::size_t n)
{
  const std::size_t rows = n / 4;
  const auto on_ball = [](double angle, double down) -> Vector_3 {
    return {std::cos(down) * std::cos(angle), std::cos(down) * std::sin(angle), -std::sin(down)};
  };
  Part part;
  std::vector<double> above = angles_around(random, n);
  std::vector<Vector_3> top;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector_3 a = on_ball(above[i], 0), b = on_ball(above[(i + 1) % n], 0), up(0, 0, length);
    part.polygons.add({a, b, b + up, a + up});
    top.push_back(a + up);
  }
  part.polygons.add(top);
  for (std::size_t j = 1; j <= rows; ++j) {
    const double down = double(j) / double(rows) * pi / 2, down_before = double(j - 1) / double(rows) * pi / 2;
    const std::size_t around = (std::max)(std::size_t(double(n) * std::cos(down)), std::size_t(6));
    const double turned = pi / double(around);
    std::vector<double> below;
    for (const double angle : angles_around(random, around)) below.push_back(angle + turned);
    const auto at_below = [&](double angle) { return on_ball(angle, j == rows ? pi / 2 : down); };
    const auto at_above = [&](double angle) { return on_ball(angle, down_before); };
    add_strip(part.polygons, below, above, at_below, at_above);
    above = below;
  }
  part.distance = [=](const Vector_3& p) {
    if (p[2] < 0) return p.norm() - 1;
    return (std::max)(std::hypot(p[0], p[1]) - 1, p[2] - length);
  };
  part.is_flat = [=](const Vector_3& p) { return p[2] > length - 1e-9; };
  part.sag = 1 - std::cos(1.4 * pi / double(n));
  part.size = 0.15;
  return part;
}

/// A post of radius 1 and this length that a fillet of radius `r`, in `rows` chords, joins to a disc above. Its triangles
/// have `n` vertices around at one end and `m` at all other levels, at angles of their own: no edge is a ruling.
Part filleted_post(Random& random, double length, double r, std::size_t n, std::size_t m, std::size_t rows)
{
  const double rim = 1.5 + r, top = r + 0.3;
  Corners profile{{1, -length}};
  for (std::size_t j = 0; j <= rows; ++j) {
    const double angle = double(j) / double(rows) * pi / 2;
    profile.push_back({1 + r - r * std::cos(angle), r * std::sin(angle)});
  }
  profile.insert(profile.end(), {{rim, r}, {rim, top}});
  const auto at = [&](std::size_t i) {
    return [q = profile[i]](double angle) -> Vector_3 { return {q[0] * std::cos(angle), q[0] * std::sin(angle), q[1]}; };
  };
  Part part;
  std::vector<double> below = angles_around(random, n);
  std::vector<Vector_3> bottom, cap;
  for (const double angle : below) bottom.insert(bottom.begin(), at(0)(angle));
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const std::vector<double> above = angles_around(random, m);
    add_strip(part.polygons, below, above, at(i - 1), at(i));
    below = above;
  }
  for (const double angle : below) cap.push_back(at(profile.size() - 1)(angle));
  part.polygons.add(bottom);
  part.polygons.add(cap);
  const Corners sharp{{rim, top}, {rim, r}, {1 + r, r}, {1, 0}, {1, -length}};
  const Arc arc{2, {1 + r, 0}, int(rows)};
  part.distance = [=](const Vector_3& p) { return distance_to_line(sharp, arc, {std::hypot(p[0], p[1]), p[2]}); };
  part.is_flat = [=](const Vector_3& p) { return p[2] < 1e-9 - length || p[2] > top - 1e-9; };
  part.sag = (1 - std::cos(1.4 * pi / double((std::min)(n, m)))) * rim;
  part.size = 0.15;
  return part;
}

/// A plate with rounded upright edges, in `k` chords each, and a chamfer around its top that is by `down` down and by
/// `inwards` inwards.
Part chamfered_plate(double x, double y, double r, int k, double down, double inwards)
{
  const std::vector<Vector_3> wall = rounded_outline(x, y, r, k, 0), top = rounded_outline(x, y, r - inwards, k, down);
  Part part;
  part.polygons = prism(wall, -0.5);
  part.polygons.polygons.erase(part.polygons.polygons.begin()); // the top
  for (std::size_t i = 0; i < wall.size(); ++i) {
    const std::size_t j = (i + 1) % wall.size();
    part.polygons.add({wall[i], wall[j], top[j], top[i]});
  }
  part.polygons.add(top);
  const double steepness = down / std::hypot(down, inwards);
  part.distance = [=](const Vector_3& p) {
    const double out = outside_of_outline(p, x, y, r);
    return (std::max)({out, p[2] - down, -0.5 - p[2], steepness * (out + inwards / down * p[2])});
  };
  part.is_flat = [=](const Vector_3& p) { return std::abs(p[0]) < x - 1e-6 || std::abs(p[1]) < y - 1e-6; };
  part.sag = r * (1 - std::cos(pi / (4 * k)));
  part.size = 0.1;
  return part;
}

/// A box whose upper edges are rounded by `r` in `k` chords, with sharp vertical ones: they fade where they go on in the
/// mitres, up to the top.
Part box_with_mitres(double a, double b, double height, double r, int k)
{
  std::vector<std::array<Vector_3, 4>> rings;
  const auto add_ring = [&](double inwards, double z) {
    const double x = a - inwards, y = b - inwards;
    rings.push_back({Vector_3(x, y, z), Vector_3(-x, y, z), Vector_3(-x, -y, z), Vector_3(x, -y, z)});
  };
  add_ring(0, 0);
  for (int j = 0; j <= k; ++j) {
    const double angle = j * pi / (2 * k);
    add_ring(r * (1 - std::cos(angle)), height - r * (1 - std::sin(angle)));
  }
  Part part;
  for (std::size_t j = 0; j + 1 < rings.size(); ++j)
    for (std::size_t i = 0; i < 4; ++i)
      part.polygons.add({rings[j][i], rings[j][(i + 1) % 4], rings[j + 1][(i + 1) % 4], rings[j + 1][i]});
  part.polygons.add({rings.back().begin(), rings.back().end()});
  part.polygons.add({rings[0].rbegin(), rings[0].rend()});
  part.distance = [=](const Vector_3& p) {
    const double up = p[2] - height + r;
    const auto rounded = [=](double out) {
      return out > 0 && up > 0 ? std::hypot(out, up) - r : (std::max)(out, up) - r;
    };
    return (std::max)({rounded(std::abs(p[0]) - a + r), rounded(std::abs(p[1]) - b + r), -p[2]});
  };
  part.is_flat = [=](const Vector_3& p) { return p[2] < height - r - 1e-9; };
  part.sag = r * (1 - std::cos(pi / (4 * k)));
  part.size = (a + b) / 15;
  return part;
}

std::vector<Variant> variants()
{
  const Vector_3 none(0, 0, 0), far(500000, 5400000, 300);
  return {{"as it is", 0, false, false, none, false},    {"vertices on borders", 0.3, false, false, none, false},
          {"vertices in planes", 0, true, true, none, false}, {"far away", 0.2, true, true, far, false},
          {"many vertices", 0.5, true, false, none, false, 1.125},
          {"single precision", 0, true, true, {3, 2, 1}, true}};
}

/// What the vertices of adapted tessellations may be off, in sags of the input.
struct Limits
{
  double largest, rms;
};

/// Of those with vertices on chords, which are a sag off the surface themselves and take what is around along.
constexpr Limits with_split_chords{10, 0.6};

/// The last ones where slivers in planes, which a curve would turn over, may hold it on its chords.
void expect_errors(const Part& part, const Limits& whole, const Limits& split, const Limits& in_planes)
{
  for (const Variant& variant : variants())
    for (const std::uint64_t seed : {1, 2, 3}) {
      SCOPED_TRACE(variant.name + ", seed " + std::to_string(seed));
      const Placed input = placed(part, variant, seed);
      const Errors e = errors(part, input, adapted(input.soup, part.size));
      const Limits& limits = variant.split_edges > 0 ? split : variant.in_planes ? in_planes : whole;
      EXPECT_LE(e.flat, 20 * input.rounding);
      EXPECT_LE(e.largest, limits.largest * part.sag + 20 * input.rounding);
      EXPECT_LE(e.rms, variant.more_rms * limits.rms * part.sag + 20 * input.rounding);
    }
}

void expect_errors(const Part& part, const Limits& whole, const Limits& split = with_split_chords)
{
  expect_errors(part, whole, split, whole);
}

/// The vertices of `input`, adapted to the size of its part, may be off it by so many sags.
Errors expect_near(const Part& part, const Placed& input, const Limits& limits)
{
  const Errors e = errors(part, input, adapted(input.soup, part.size));
  EXPECT_LE(e.largest, limits.largest * part.sag);
  EXPECT_LE(e.rms, limits.rms * part.sag);
  return e;
}

/// One after the other as it is and rotated, in single precision and not.
Placed placed_in_turn(const Part& part, int i)
{
  return placed(part, {"", 0, false, i % 2 == 1, {0, 0, 0}, i % 4 < 2}, std::uint64_t(i));
}

TEST(Cad_tessellations, of_a_box_stay_flat) { expect_errors(box(), {0, 0}); }

TEST(Cad_tessellations, of_a_rounded_box_keep_planes_and_round_fillets)
{
  expect_errors(rounded_box({2, 1, 0.6}, 0.3, 4), {0.5, 0.25});
  expect_errors(rounded_box({2, 1, 0.6}, 0.1, 6), {0.5, 0.25});
}

TEST(Cad_tessellations, of_a_rounded_frustum_keep_caps_and_round_the_rest)
{
  expect_errors(rounded_frustum(36, 5), {0.5, 0.25});
  expect_errors(rounded_frustum(24, 3), {0.5, 0.25});
}

TEST(Cad_tessellations, of_a_drilled_plate_keep_planes_and_round_the_bore)
{
  // slivers at the bore, which its curve would turn over, hold it on its chords
  expect_errors(drilled_plate(6), {1, 0.25});
  expect_errors(drilled_plate(12), {1, 0.25});
}

TEST(Cad_tessellations, of_shafts_keep_the_circles_where_a_cylinder_meets_a_cone)
{
  for (const double degrees : {8, 30}) {
    SCOPED_TRACE(degrees);
    expect_errors(shaft(degrees, 24, 1), {0.25, 0.1});
    expect_errors(shaft(degrees, 80, 1), {0.25, 0.1});
  }
}

TEST(Cad_tessellations, of_a_knob_keep_the_circles_where_its_pieces_meet)
{
  expect_errors(knob(30, 1), {0.5, 0.25}, {10, 0.8});
  expect_errors(knob(90, 1), {0.5, 0.25}, {10, 0.8});
}

TEST(Cad_tessellations, of_bent_rods_round_the_flanks_too)
{
  Random random(7);
  for (int i = 0; i < 6; ++i) {
    const std::size_t around = 2 * (8 + random.below(16)), along = 5 + random.below(8);
    SCOPED_TRACE(std::to_string(around) + " around, " + std::to_string(along) + " along");
    expect_errors(elbow(around, along), {0.5, 0.25}, {10, 0.8});
  }
}

TEST(Cad_tessellations, of_waves_bend_where_the_curvature_changes_its_sign)
{
  Random random(11);
  for (int i = 0; i < 4; ++i) {
    const double height = random.real(0.4, 0.9), angle = random.real(0.06, 0.15);
    SCOPED_TRACE("height " + std::to_string(height) + ", angle " + std::to_string(angle));
    expect_errors(wave(height, angle), {0.5, 0.25}, with_split_chords, {1.25, 0.25});
  }
}

TEST(Cad_tessellations, of_double_bends_stay_flat_between_the_arcs)
{
  Random random(12);
  for (int i = 0; i < 4; ++i) {
    const double angle = random.real(0.5, 1.2), length = random.real(0.5, 2);
    const int k = int(4 + random.below(8));
    SCOPED_TRACE("angle " + std::to_string(angle) + ", length " + std::to_string(length) + ", " + std::to_string(k));
    expect_errors(double_bend(angle, length, k), {0.5, 0.25}, with_split_chords, {1.25, 0.25});
  }
}

TEST(Cad_tessellations, of_a_rounded_plate_round_the_arcs_between_long_edges)
{
  for (const int k : {5, 16})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Part part = rounded_plate(k);
      const Placed input = placed(part, {}, seed);
      const Errors e = errors(part, input, adapted(input.soup, part.size));
      EXPECT_LE(e.flat, 20 * input.rounding);
      EXPECT_LE(e.largest, 0.1 * part.sag);
      EXPECT_LE(e.rms, 0.05 * part.sag);
    }
}

TEST(Cad_tessellations, of_a_box_stay_flat_with_fans_of_slivers)
{
  Part part = box();
  Random random(1);
  for (int i = 0; i < 4; ++i) split_edges(random, part.polygons, 0.7);
  expect_errors(part, {0, 0});
}

SMA::Facets facets_of(const Soup& soup)
{
  SMA::Mesh_view mesh = shapes::view(soup);
  return SMA::detect_features(sequential, mesh, soup.points, SMA::Feature_parameters()).facets;
}

std::size_t number_of_ridges(const Soup& soup)
{
  SMA::Mesh_view mesh = shapes::view(soup);
  SMA::detect_features(sequential, mesh, soup.points, SMA::Feature_parameters());
  return (mesh.curve.size() - std::size_t(std::count(mesh.curve.begin(), mesh.curve.end(), SMA::no_curve))) / 2;
}

/// A sphere of quadrangles, and triangles at the poles.
Part ball(std::size_t n, std::size_t k)
{
  Profile profile;
  for (std::size_t i = 0; i <= k; ++i) {
    const double a = pi * (double(i) / double(k) - 0.5);
    profile.points.push_back({i == 0 || i == k ? 0 : std::cos(a), std::sin(a)});
  }
  profile.distance = [](double x, double y) { return std::hypot(x, y) - 1; };
  return revolved(profile, n, 0, 0.1);
}

TEST(Cad_tessellations, of_rounded_shapes_have_no_creases)
{
  for (const std::uint64_t seed : {1, 2, 3})
    for (const bool is_rotated : {false, true}) {
      const Variant variant{"", 0, false, is_rotated, {0, 0, 0}, false};
      for (const int k : {3, 4, 8}) {
        EXPECT_EQ(number_of_ridges(placed(rounded_box({2, 1, 0.6}, 0.3, k), variant, seed).soup), 0u) << k;
        EXPECT_EQ(number_of_ridges(placed(rounded_frustum(36, k), variant, seed).soup), 0u) << k;
      }
      for (const std::size_t k : {6, 9, 20}) {
        EXPECT_EQ(number_of_ridges(placed(ball(2 * k, k), variant, seed).soup), 0u) << k;
        EXPECT_EQ(number_of_ridges(placed(ball(4 * k, k), variant, seed).soup), 0u) << k;
      }
    }
}

TEST(Cad_tessellations, of_shafts_have_four_circles_of_creases)
{
  for (const std::size_t n : {12, 24, 80})
    for (const int rows : {1, 2}) {
      EXPECT_EQ(number_of_ridges(placed(shaft(30, n, rows), {}, 1).soup), 4 * n) << n << ", " << rows;
      EXPECT_EQ(number_of_ridges(placed(knob(n, rows), {}, 1).soup), 5 * n) << n << ", " << rows;
    }
}

/// Chords take a bit of the 45 degrees at the circles of a cone.
TEST(Cad_tessellations, of_pins_with_chamfered_ends_keep_all_circles)
{
  Random random(15);
  for (int i = 0; i < 8; ++i) {
    const double chamfer = random.real(0.1, 0.3), length = random.real(1, 3);
    const std::size_t n = 12 + random.below(50);
    SCOPED_TRACE(std::to_string(chamfer) + ", " + std::to_string(length) + ", " + std::to_string(n));
    const Part part = turned({{1 - chamfer, 0}, {1, chamfer}, {1, chamfer + length}, {1 - chamfer, 2 * chamfer + length}}, {},
                             n, 1);
    const Placed input = placed_in_turn(part, i);
    EXPECT_EQ(number_of_ridges(input.soup), 4 * n);
    expect_near(part, input, {0.5, 0.25});
  }
}

TEST(Cad_tessellations, of_boxes_with_chamfered_edges_keep_all_of_them)
{
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    const double x = random.real(0.5, 3), y = random.real(0.5, 3), c = (std::min)(x, y) * random.real(0.1, 0.45);
    const std::vector<Vector_3> top{{x, c - y, 1}, {x, y - c, 1},  {x - c, y, 1},  {c - x, y, 1},
                                    {-x, y - c, 1}, {-x, c - y, 1}, {c - x, -y, 1}, {x - c, -y, 1}};
    Part part;
    part.polygons = prism(top, 0);
    const Variant variant{"", 0, false, true, {3, 2, 1}, i % 2 == 0};
    EXPECT_EQ(number_of_ridges(placed(part, variant, std::uint64_t(i)).soup), 24u) << x << ", " << y << ", " << c;
  }
}

std::vector<Vector_3> regular_polygon(std::size_t n, double r, double x)
{
  std::vector<Vector_3> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * pi * double(i) / double(n);
    corners.push_back({x + r * std::cos(angle), r * std::sin(angle), 1});
  }
  return corners;
}

TEST(Cad_tessellations, of_octagons_keep_their_edges_beside_what_has_finer_chords)
{
  Random random(18);
  for (int i = 0; i < 8; ++i) {
    Part part;
    part.polygons = prism(regular_polygon(8, random.real(0.5, 2), 0), 0);
    EXPECT_EQ(number_of_ridges(placed_in_turn(part, i).soup), 16u); // round
    const std::size_t n = 16 + random.below(40);
    part.polygons.add(prism(regular_polygon(n, random.real(0.3, 2), 5), 0));
    EXPECT_EQ(number_of_ridges(placed_in_turn(part, i).soup), 24 + 2 * n);
  }
}

/// The ridges of a prism over this polygon and, but for `n` = 0, of one beside it over a regular polygon of `n` corners.
std::size_t ridges_of_prisms(const std::vector<Vector_3>& corners, std::size_t n, int i)
{
  Part part;
  part.polygons = prism(corners, 0);
  if (n > 0) part.polygons.add(prism(regular_polygon(n, 1, 5), 0));
  return number_of_ridges(placed_in_turn(part, i).soup);
}

/// The walls turn by 29 to 48 degrees, the chords of the circle by 6 to 9.
TEST(Cad_tessellations, of_prisms_keep_their_edges_beside_chords_that_are_narrower)
{
  Random random(20);
  for (int i = 0; i < 8; ++i) {
    const std::size_t m = 9 + random.below(3), n = 40 + random.below(20);
    EXPECT_EQ(ridges_of_prisms(regular_polygon(m, 2, 0), 0, i), 2 * m); // round
    EXPECT_EQ(ridges_of_prisms(regular_polygon(m, random.real(0.05, 0.1), 0), n, i), 2 * m + 2 * n); // a small hole
    EXPECT_EQ(ridges_of_prisms(regular_polygon(m, random.real(1.2, 3), 0), n, i), 3 * m + 2 * n);
    std::vector<Vector_3> uneven;
    for (const double angle : angles_around(random, 9)) uneven.push_back({2 * std::cos(angle), 2 * std::sin(angle), 1});
    EXPECT_EQ(ridges_of_prisms(uneven, n, i), 3 * 9 + 2 * n);
  }
}

/// How much a polygon turns from its edge `i` to the next one.
double turn_of_polygon(const std::vector<Vector_3>& corners, std::size_t i)
{
  const std::size_t n = corners.size();
  const Vector_3 &a = corners[i % n], &b = corners[(i + 1) % n], &c = corners[(i + 2) % n];
  return std::atan2((b - a).cross(c - b)[2], (b - a).dot(c - b));
}

/// A convex polygon with `n` corners at random, that turns by 10 degrees or more at each and by 30 at one of two.
std::vector<Vector_3> random_polygon(Random& random, std::size_t n)
{
  constexpr double least = 0.17, least_of_two = 0.53;
  std::vector<Vector_3> corners(n);
  bool is_done = false;
  while (!is_done) {
    for (std::size_t i = 0; i < n; ++i) {
      const double r = random.real(1, 1.7), angle = 2 * pi * (double(i) + random.real(-0.3, 0.3)) / double(n);
      corners[i] = {r * std::cos(angle), r * std::sin(angle), 1};
    }
    is_done = true;
    for (std::size_t i = 0; i < n; ++i) {
      const double turn = turn_of_polygon(corners, i), next = turn_of_polygon(corners, i + 1);
      is_done = is_done && turn > least && (std::max)(turn, next) > least_of_two;
    }
  }
  return corners;
}

/// With nothing in them that says what chords would be.
TEST(Cad_tessellations, of_uneven_prisms_keep_all_edges)
{
  Random random(22);
  for (int i = 0; i < 60; ++i) {
    const std::size_t n = 5 + random.below(3);
    EXPECT_EQ(ridges_of_prisms(random_polygon(random, n), 0, i), 3 * n) << i;
  }
}

/// Three or four chords for a right angle are round nevertheless.
TEST(Cad_tessellations, of_boxes_with_coarse_fillets_are_round)
{
  Random random(23);
  for (int i = 0; i < 20; ++i) {
    const int k = 3 + int(random.below(2));
    const double x = random.real(1, 3), y = random.real(1, 3), r = random.real(0.1, 0.45) * (std::min)(x, y);
    const std::vector<Vector_3> outline = rounded_outline(x, y, r, k, 1);
    EXPECT_EQ(ridges_of_prisms(outline, 0, i), 2 * outline.size()) << k;
  }
}

/// Facets with edges of both kinds. At the top and at the bottom they turn by a little more than 45 degrees.
TEST(Cad_tessellations, of_tori_of_eight_chords_are_round)
{
  Random random(19);
  for (int i = 0; i < 8; ++i) {
    const std::size_t n = 16 + random.below(30);
    const double r = random.real(0.05, 0.2); // facets as large as each other, nearly
    const auto at = [&](std::size_t j, std::size_t k) -> Vector_3 {
      const double around = 2 * pi * double(j % n) / double(n), angle = 2 * pi * double(k % 8) / 8;
      const double x = 1 + r * std::cos(angle);
      return {x * std::cos(around), x * std::sin(around), r * std::sin(angle)};
    };
    Part part;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < 8; ++k) part.polygons.add({at(j, k), at(j + 1, k), at(j + 1, k + 1), at(j, k + 1)});
    EXPECT_EQ(number_of_ridges(placed_in_turn(part, i).soup), 2 * n);
  }
}

TEST(Cad_tessellations, of_chamfers_around_ellipses_keep_both_edges)
{
  Random random(8);
  for (int i = 0; i < 20; ++i) {
    const double a = random.real(1.2, 2), chamfer = random.real(0.05, 0.2);
    const std::size_t n = 24 + random.below(60);
    Part part;
    part.polygons = chamfered_ellipse(random, a, chamfer, n);
    EXPECT_EQ(number_of_ridges(placed_in_turn(part, i).soup), 3 * n) << a << ", " << chamfer;
  }
}

TEST(Cad_tessellations, of_cylinders_without_rulings_are_straight)
{
  Random random(9);
  for (int i = 0; i < 6; ++i) {
    const double length = random.real(2, 6), slope = random.real(0, 1);
    const std::size_t n = 20 + random.below(40), m = 20 + random.below(40);
    SCOPED_TRACE(std::to_string(length) + ", " + std::to_string(slope) + ", " + std::to_string(n));
    const Part part = cut_cylinder(random, length, slope, n, m);
    const Placed input = placed(part, {}, std::uint64_t(i));
    expect_near(part, input, {1, 0.25});
  }
}

struct Chords
{
  std::size_t least, range; ///< numbers from the former on, and below the sum
};

void expect_edges_up_to_where_pipes_touch(std::uint64_t seed, const Chords& of_half_an_edge, const Chords& around)
{
  Random random(seed);
  for (int i = 0; i < 8; ++i) {
    const double length = random.real(2.5, 5);
    const std::size_t k = 2 * (of_half_an_edge.least + random.below(of_half_an_edge.range));
    const std::size_t m = around.least + random.below(around.range);
    SCOPED_TRACE(std::to_string(length) + ", " + std::to_string(k) + ", " + std::to_string(m));
    const Part part = crossing_pipes(random, length, k, m);
    const Placed input = placed_in_turn(part, i);
    EXPECT_EQ(number_of_ridges(input.soup), 4 * (k + m));
    expect_near(part, input, {1, 0.5});
  }
}

TEST(Cad_tessellations, of_pipes_that_touch_keep_the_edges_up_to_there)
{
  expect_edges_up_to_where_pipes_touch(11, {8, 12}, {30, 40});
}

TEST(Cad_tessellations, of_pipes_of_few_chords_keep_the_edges_up_to_where_they_touch)
{
  expect_edges_up_to_where_pipes_touch(17, {3, 4}, {16, 16});
}

TEST(Cad_tessellations, of_what_two_pipes_have_in_common_keep_the_edges_up_to_the_poles)
{
  Random random(14);
  for (int i = 0; i < 8; ++i) {
    const std::size_t k = 20 + random.below(40);
    SCOPED_TRACE(k);
    const Part part = common_of_pipes(random, k);
    const Placed input = placed_in_turn(part, i);
    expect_near(part, input, {1, 0.5});
  }
}

/// A bar with `k` sides, turned by `step` from each of `n` levels to the next, with vertices in the middle of its sides at all
/// levels and half way between these.
Part twisted_bar(std::size_t k, std::size_t n, double step, double height)
{
  const double apothem = std::cos(pi / double(k));
  const auto at = [&](double level, double side) {
    const double turn = step * level + 2 * pi * side / double(k);
    const double radius = side == std::floor(side) ? 1 : apothem;
    return Vector_3(radius * std::cos(turn), radius * std::sin(turn), height * level);
  };
  Part part;
  std::vector<Vector_3> bottom, top;
  for (std::size_t j = 0; j < 2 * k; ++j) {
    bottom.push_back(at(0, 0.5 * double(2 * k - 1 - j)));
    top.push_back(at(double(n), 0.5 * double(j)));
  }
  part.polygons.add(bottom);
  part.polygons.add(top);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      const double low = double(i), up = low + 1, right = double(j), left = double((j + 1) % k), middle = right + 0.5;
      const Vector_3 center = at(low + 0.5, middle);
      part.polygons.add({at(low, right), at(low, middle), at(low, left), center});
      part.polygons.add({at(up, left), at(up, middle), at(up, right), center});
      part.polygons.add({at(low, left), at(up, left), center});
      part.polygons.add({at(up, right), at(low, right), center});
    }
  const double end = height * double(n);
  part.is_flat = [=](const Vector_3& p) { return p[2] < 0 || p[2] > end; };
  part.distance = [=](const Vector_3& p) {
    double beyond = -1;
    for (std::size_t j = 0; j < k; ++j) {
      const double turn = step * p[2] / height + 2 * pi * (double(j) + 0.5) / double(k);
      beyond = (std::max)(beyond, std::cos(turn) * p[0] + std::sin(turn) * p[1] - apothem);
    }
    return (std::min)({std::abs(beyond), std::abs(p[2]), std::abs(end - p[2])});
  };
  part.sag = step * std::sin(pi / double(k)) / 8; // of a chord from the middle of a side to a corner half a level above
  part.size = 0.1;
  return part;
}

/// A cone and, on top of it, what a few chords of an arc sweep around the axis. Where they meet the surface turns by `kink`,
/// which is a little more than three chords do; half of the vertices behind are out of place, so that some faces are triangles.
Part kinked_knob(Random& random, std::size_t n, double kink)
{
  const double chord = kink / 3.2;
  std::vector<std::vector<Vector_3>> rings;
  double r = 1, z = 0, steep = 0.1; // from the axis
  for (std::size_t k = 0; k < 5; ++k) {
    std::vector<Vector_3> ring;
    for (std::size_t j = 0; j < n; ++j) {
      const double out_of_place = k == 2 && random.below(2) == 0 ? random.real(-0.15, 0.15) : 0;
      const double angle = 2 * pi * (double(j) + (k == 0 ? 0 : 0.3) + out_of_place) / double(n);
      ring.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    rings.push_back(std::move(ring));
    const double length = k == 0 ? 0.5 : 0.1;
    r -= length * std::sin(steep);
    z += length * std::cos(steep);
    steep += k == 0 ? kink : chord;
  }
  Part part;
  part.polygons.add({rings[0].rbegin(), rings[0].rend()});
  part.polygons.add(rings[4]);
  for (std::size_t j = 0, i = n - 1; j < n; i = j++) {
    part.polygons.add({rings[0][i], rings[0][j], rings[1][i]});
    part.polygons.add({rings[1][i], rings[0][j], rings[1][j]});
    for (std::size_t k = 1; k < 4; ++k) part.polygons.add({rings[k][i], rings[k][j], rings[k + 1][j], rings[k + 1][i]});
  }
  return part;
}

TEST(Cad_tessellations, of_kinked_knobs_have_whole_circles_of_creases)
{
  Random random(24);
  for (int i = 0; i < 20; ++i) {
    const std::size_t n = 30 + random.below(60);
    const double kink = random.real(0.25, 0.35);
    SCOPED_TRACE(std::to_string(n) + ", " + std::to_string(kink));
    EXPECT_EQ(number_of_ridges(placed_in_turn(kinked_knob(random, n, kink), i).soup), 3 * n);
  }
}

/// Chords of a saddle turn to and fro. In the last row before an end nothing tells some of them from an edge.
TEST(Cad_tessellations, of_twisted_bars_have_no_edges_across_their_sides)
{
  Random random(16);
  for (int i = 0; i < 10; ++i) {
    const std::size_t k = 4 + random.below(4), n = 6 + random.below(6);
    const double step = random.real(0.1, 0.2), height = random.real(0.25, 0.45);
    SCOPED_TRACE(std::to_string(k) + ", " + std::to_string(step) + ", " + std::to_string(height));
    const Part part = twisted_bar(k, n, step, height);
    const Placed input = placed_in_turn(part, i);
    const std::size_t expected = k * (n + 4), most_at_ends = 4 * k, found = number_of_ridges(input.soup);
    EXPECT_GE(found, expected);
    EXPECT_LE(found, expected + most_at_ends);
    expect_near(part, input, {1, 0.5});
  }
}

TEST(Cad_tessellations, of_boxes_with_rounded_edges_keep_the_mitres_up_to_the_top)
{
  Random random(13);
  for (int i = 0; i < 8; ++i) {
    const double a = random.real(0.5, 2), b = random.real(0.5, 2), height = random.real(0.5, 2), r = random.real(0.1, 0.3);
    const int k = 6 + int(random.below(12));
    SCOPED_TRACE(std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(r) + ", " + std::to_string(k));
    const Part part = box_with_mitres(a, b, height, r, k);
    const Placed input = placed_in_turn(part, i);
    EXPECT_EQ(number_of_ridges(input.soup), 8 + 4 * std::size_t(k));
    // the largest is at the last chord of a mitre, which says least of how it ends
    const Errors e = expect_near(part, input, {3, 0.25});
    EXPECT_LE(e.flat, 20 * input.rounding);
  }
}

/// Strips a few hundred times as long as wide: what the normals at their ends are off would bend them between.
TEST(Cad_tessellations, of_long_boxes_with_thin_fillets_leave_their_facets_by_no_more_than_chords_do)
{
  Random random(21);
  for (int i = 0; i < 8; ++i) {
    const double a = random.real(2, 5), b = random.real(0.5, 1.5), r = random.real(0.02, 0.05);
    const int k = 4 + int(random.below(8));
    SCOPED_TRACE(std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(r) + ", " + std::to_string(k));
    const Part part = box_with_mitres(a, b, 0.5, r, k);
    expect_near(part, placed_in_turn(part, i), {2.5, 1});
  }
}

TEST(Cad_tessellations, of_posts_with_round_ends_are_straight_up_to_there)
{
  Random random(12);
  for (int i = 0; i < 8; ++i) {
    const double length = random.real(2, 6);
    const std::size_t n = 20 + random.below(40);
    SCOPED_TRACE(std::to_string(length) + ", " + std::to_string(n));
    const Part part = rounded_post(random, length, n);
    const Placed input = placed_in_turn(part, i);
    expect_near(part, input, {1, 0.25});
  }
}

TEST(Cad_tessellations, of_posts_that_end_in_fillets_are_straight_up_to_there)
{
  Random random(15);
  for (int i = 0; i < 8; ++i) {
    const double length = random.real(2, 5), r = random.real(0.15, 0.4);
    const std::size_t n = 24 + random.below(40), m = 24 + random.below(40), rows = 4 + random.below(6);
    SCOPED_TRACE(std::to_string(length) + ", " + std::to_string(r) + ", " + std::to_string(n));
    const Part part = filleted_post(random, length, r, n, m, rows);
    expect_near(part, placed_in_turn(part, i), {1, 0.3});
  }
}

TEST(Cad_tessellations, of_plates_with_flat_chamfers_keep_these_flat)
{
  Random random(16);
  for (int i = 0; i < 8; ++i) {
    const double x = random.real(0.6, 1.5), y = random.real(0.4, 1), r = random.real(0.3, 0.6);
    const double inwards = random.real(0.05, 0.2), down = inwards * random.real(1.2, 3);
    const int k = 6 + int(random.below(16));
    SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(inwards) + ", " + std::to_string(down) + ", " + std::to_string(k));
    const Part part = chamfered_plate(x, y, r, k, down, inwards);
    const Placed input = placed_in_turn(part, i);
    EXPECT_EQ(number_of_ridges(input.soup), 12 * std::size_t(k + 1));
    const Errors e = expect_near(part, input, {1, 0.25});
    EXPECT_LE(e.flat, 20 * input.rounding);
  }
}

/// Many vertices on the curves, and none between them at first.
TEST(Cad_tessellations, of_cylinders_without_rulings_are_refined_around_not_across)
{
  Random random(10);
  for (int i = 0; i < 4; ++i) {
    const double length = random.real(4, 6), slope = random.real(0.4, 1);
    const std::size_t n = 40 + 60 * random.below(2), m = 40 + 70 * random.below(2);
    SCOPED_TRACE(std::to_string(length) + ", " + std::to_string(slope) + ", " + std::to_string(n));
    const Part part = cut_cylinder(random, length, slope, n, m);
    const Placed input = placed(part, {}, std::uint64_t(i));
    const Soup result = adapted(input.soup, 0.03);
    for (const shapes::Triangle& t : result.triangles) {
      const Vector_3 center = (result.points[t[0]] + result.points[t[1]] + result.points[t[2]]) / 3;
      ASSERT_LE(part.distance(center), part.sag);
    }
  }
}

// Smooth borders

/// What comes out with smooth borders, and which edges of it are features.
struct Bordered
{
  Soup soup;
  std::vector<std::pair<Vector_3, Vector_3>> edges;

  double length() const
  {
    double sum = 0;
    for (const auto& [a, b] : edges) sum += (a - b).norm();
    return sum;
  }
};

template <class Execution = SMA::Sequential_execution>
Bordered bordered(const Soup& soup, double size, const Execution& execution = sequential)
{
  auto mesh = shapes::mesh<Surface_mesh>(soup);
  auto is_feature = mesh.add_property_map<Surface_mesh::Edge_index, bool>("e:is_feature", false).first;
  SMA::adapt_surface_mesh(execution, mesh, SMA::Uniform_metric_field(size),
                          SMA::parameters::smooth_borders(true).edge_is_constrained_map(is_feature));
  Bordered result{shapes::soup(mesh), {}};
  const auto point = [&](Surface_mesh::Vertex_index v) -> Vector_3 {
    const auto& p = mesh.point(v);
    return {p.x(), p.y(), p.z()};
  };
  for (const auto e : edges(mesh))
    if (get(is_feature, e)) result.edges.emplace_back(point(mesh.vertex(e, 0)), point(mesh.vertex(e, 1)));
  return result;
}

TEST(Smooth_borders, of_a_rounded_box_are_lines_and_arcs_with_vertices_on_them)
{
  const Vector_3 half(2, 1, 0.6);
  const double r = 0.3;
  const Vector_3 inner = half - Vector_3(r, r, r);
  for (const int k : {4, 8})
    for (const Variant& variant : variants()) {
      if (variant.split_edges > 0) continue;
      SCOPED_TRACE(variant.name + ", " + std::to_string(k));
      const Part part = rounded_box(half, r, k);
      const Placed input = placed(part, variant, 1);
      const Bordered result = bordered(input.soup, part.size);
      for (const auto& [a, b] : result.edges)
        for (const Vector_3& x : {a, b}) // all borders lie in the planes through the centers of the fillets
          EXPECT_LE((input.back(x).cwiseAbs() - inner).cwiseAbs().minCoeff(), 20 * input.rounding);
      const double length = 16 * inner.sum() + 12 * pi * r; // the sides of all planes, and the arcs around all corners
      EXPECT_NEAR(result.length(), length, 0.003 * length);
      const Errors e = errors(part, input, result.soup);
      EXPECT_LE(e.flat, 20 * input.rounding);
      EXPECT_LE(e.largest, 0.25 * part.sag + 20 * input.rounding);
      EXPECT_LE(e.rms, 0.05 * part.sag + 20 * input.rounding);
    }
}

TEST(Smooth_borders, of_a_rounded_frustum_are_circles)
{
  for (const std::size_t n : {24, 48}) {
    const Part part = rounded_frustum(n, 5);
    const Placed input = placed(part, {}, 1);
    const Bordered result = bordered(input.soup, part.size);
    std::map<long, double> length, radius; // at heights in millionths
    for (const auto& [a, b] : result.edges) {
      const long height = std::lround(1e6 * a[2]);
      EXPECT_NEAR(a[2], b[2], 1e-9);
      length[height] += (a - b).norm();
      radius[height] = std::hypot(a[0], a[1]);
      for (const Vector_3& x : {a, b}) EXPECT_LE(std::abs(part.distance(x)), 0.1 * part.sag);
    }
    EXPECT_EQ(length.size(), 4u); // both ends of both arcs
    for (const auto& [height, r] : radius) EXPECT_NEAR(length[height], 2 * pi * r, 0.01 * r);
    EXPECT_LE(errors(part, input, result.soup).flat, 20 * input.rounding);
  }
}

TEST(Smooth_borders, do_not_split_normals)
{
  const Soup soup = placed(rounded_box({2, 1, 0.6}, 0.3, 4), {}, 1).soup;
  SMA::Mesh_view mesh = shapes::view(soup);
  SMA::Feature_parameters parameters;
  parameters.smooth_borders = true;
  EXPECT_FALSE(SMA::detect_features(sequential, mesh, soup.points, parameters).curves.empty());
  EXPECT_EQ(SMA::estimate_normals(sequential, mesh, soup.points).normals.size(), soup.points.size());
}

TEST(Smooth_borders, are_kept_alike_by_all_policies)
{
  const Part part = rounded_box({2, 1, 0.6}, 0.3, 4);
  const Placed input = placed(part, {}, 1);
  const Soup expected = bordered(input.soup, part.size).soup;
  for_each_policy([&](const auto& execution, const std::string& name) {
    EXPECT_TRUE(checks::is_identical(expected, bordered(input.soup, part.size, execution).soup)) << name;
  });
}

// Overshoot

double area(const Soup& soup)
{
  double sum = 0;
  for (const shapes::Triangle& t : soup.triangles)
    sum += (soup.points[t[1]] - soup.points[t[0]]).cross(soup.points[t[2]] - soup.points[t[0]]).norm() / 2;
  return sum;
}

TEST(Overshoot, triangles_alone_stay_in_their_outline)
{
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    Soup soup;
    const double thin = std::pow(10.0, random.real(-2, 0));
    soup.points = {{0, 0, 0}, {random.real(1, 10), 0, 0}, {random.real(-1, 5), thin * random.real(1, 5), 0}};
    soup.triangles = {{0, 1, 2}};
    const Soup result = adapted(soup, 0.3);
    EXPECT_LE(area(result), (1 + 1e-9) * area(soup));
    EXPECT_GE(area(result), 0.98 * area(soup)); // a blunt corner may be cut
    for (const Vector_3& p : result.points) EXPECT_EQ(p[2], 0);
  }
}

/// A convex prism over an irregular polygon: long edges follow short ones, turned by less than the corner angle.
Part bar(Random& random)
{
  Part part;
  std::vector<double> angles;
  for (double a = 0; a < 2 * pi - 0.3; a += random.real() < 0.5 ? random.real(0.02, 0.2) : random.real(0.3, 0.7))
    angles.push_back(a);
  std::vector<Vector_3> top;
  for (const double a : angles) top.push_back({10 * std::cos(a), 3 * std::sin(a), 1});
  part.polygons = prism(top, -1);
  part.is_flat = [](const Vector_3&) { return true; };
  return part;
}

TEST(Overshoot, outlines_of_edges_of_all_lengths_bulge_by_a_fraction_of_these)
{
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    Part part = bar(random);
    const Soup soup = placed(part, {}, std::uint64_t(i)).soup;
    const Soup result = adapted(soup, 0.5);
    EXPECT_LE(area(result), 1.1 * area(soup));
    EXPECT_GE(area(result), 0.9 * area(soup));
    for (const Vector_3& p : result.points) EXPECT_LE(std::abs(p[2]), 1 + 1e-9);
  }
}

double height(const Vector_3& a, const Vector_3& b, const Vector_3& c)
{
  return (b - a).cross(c - a).norm() / (std::max)({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

/// The least height of the triangles, and the length of the longest edge.
std::pair<double, double> extremes(const Soup& soup)
{
  double least = 1e300, longest = 0;
  for (const shapes::Triangle& t : soup.triangles) {
    const Vector_3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    least = (std::min)(least, height(a, b, c));
    longest = (std::max)({longest, (b - a).norm(), (c - b).norm(), (a - c).norm()});
  }
  return {least, longest};
}

TEST(Overshoot, long_faces_with_chamfered_ends_are_refined)
{
  Random random(1);
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    Part part;
    const double w = random.real(0.5, 2), length = random.real(50, 200), width = random.real(5, 20);
    const std::vector<Vector_3> top{{w, 0, 5},          {length - w, 0, 5},      {length, w, 5}, {length, width - w, 5},
                                    {length - w, width, 5}, {w, width, 5}, {0, width - w, 5}, {0, w, 5}};
    part.polygons = prism(top, 0);
    part.is_flat = [](const Vector_3&) { return true; };
    const auto [least, longest] = extremes(adapted(placed(part, {}, std::uint64_t(i)).soup, 2));
    EXPECT_GE(least, 0.1);
    EXPECT_LE(longest, 4);
  }
}

/// A thin plate of which the upright edges are rounded by far less than its sides are long, in files of text.
Soup plate(Random& random)
{
  const double x = random.real(100, 400), y = random.real(100, 400), r = random.real(1, 3);
  const int k = 4 + int(random.below(9)); // chords of each arc: rounding must not turn corners of more over
  std::vector<Vector_3> top;
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i <= k; ++i) {
      const double t = (q + double(i) / k) * pi / 2;
      top.push_back({(q == 0 || q == 3 ? x : -x) + r * std::cos(t), (q < 2 ? y : -y) + r * std::sin(t), 0});
    }
  Part part;
  part.polygons = prism(top, -3);
  Soup soup = placed(part, {}, random.next()).soup;
  for (Vector_3& p : soup.points)
    for (int i = 0; i < 2; ++i) p[i] = std::round(p[i] * 1000) / 1000;
  return soup;
}

TEST(Cad_tessellations, of_plates_with_tight_corners_are_coarse_inside)
{
  Random random(1);
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    auto mesh = shapes::mesh<Surface_mesh>(plate(random));
    const auto report = SMA::adapt_surface_mesh(sequential, mesh, SMA::Curvature_metric_field(0.001));
    EXPECT_LT(report.final.vertices, 12000);
    EXPECT_GT(report.final.in_range, 0.95);
    EXPECT_GT(report.final.min_quality, 0.1);
  }
}

/// A stretched ball, some of whose triangles have a further vertex inside.
Soup ellipsoid_with_flat_stars(Random& random)
{
  Soup soup = shapes::sphere(3, 0.3);
  for (Vector_3& p : soup.points) p[2] *= 6;
  for (std::size_t f = 0, n = soup.triangles.size(); f < n; ++f) {
    if (random.real(0, 1) > 0.13) continue;
    const auto t = soup.triangles[f];
    shapes::split_triangle(soup, f, (soup.points[t[0]] + soup.points[t[1]] + soup.points[t[2]]) / 3);
  }
  return soup;
}

/// Flat places alone make no tessellation: the triangles of one reach from edge to edge.
TEST(Cad_tessellations, are_not_scans_with_some_flat_places)
{
  Random random(4);
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(facets_of(ellipsoid_with_flat_stars(random)).empty()) << i;
  }
}

TEST(Cad_tessellations, whose_smooth_surface_leaves_them_by_several_tolerances_are_warned_of)
{
  const auto warnings = [](int k) {
    auto mesh = shapes::mesh<Surface_mesh>(placed(drilled_plate(k), {}, 1).soup);
    return SMA::adapt_surface_mesh(sequential, mesh, SMA::Curvature_metric_field(0.0005)).warnings;
  };
  const auto is_of_bulge = [](const std::string& s) { return s.find("leaves the faces") != std::string::npos; };
  const auto coarse = warnings(2), fine = warnings(12);
  EXPECT_TRUE(std::any_of(coarse.begin(), coarse.end(), is_of_bulge));
  EXPECT_FALSE(std::any_of(fine.begin(), fine.end(), is_of_bulge));
}

TEST(Cad_tessellations, are_adapted_alike_by_all_policies)
{
  const Part part = rounded_box({2, 1, 0.6}, 0.3, 4);
  const Placed input = placed(part, variants()[2], 1);
  const Soup expected = adapted(input.soup, part.size);
  for_each_policy([&](const auto& execution, const std::string& name) {
    EXPECT_TRUE(checks::is_identical(expected, adapted(input.soup, part.size, execution))) << name;
  });
}

Surface_mesh::Point in_single_precision(const Vector_3& p)
{
  return {double(float(p[0])), double(float(p[1])), double(float(p[2]))};
}

Soup convex_hull(const std::vector<Surface_mesh::Point>& points)
{
  Surface_mesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return shapes::soup(hull);
}

/// The convex hull of a few discs with rounded rims, as of links of robots. Coordinates are of single precision.
Soup random_hull(Random& random)
{
  std::vector<Surface_mesh::Point> points;
  const auto disc = [&](std::size_t n) {
    const Vector_3 center(random.real(0, 2), random.real(0, 1.2), random.real(0, 1.5)), axis = random.vector().normalized();
    const Vector_3 x = axis.unitOrthogonal(), y = axis.cross(x);
    const double r = random.real(0.2, 0.5), rim = random.real(0.02, 0.15);
    for (int row = 0; row < 3; ++row)
      for (std::size_t i = 0; i < n; ++i) {
        const double a = 2 * pi * (double(i) + random.real(-0.3, 0.3)) / double(n), b = row * pi / 4;
        const Vector_3 p = center + (r + rim * std::cos(b)) * (std::cos(a) * x + std::sin(a) * y) + rim * std::sin(b) * axis;
        points.push_back(in_single_precision(p));
      }
  };
  const std::size_t discs = 3 + random.below(4);
  for (std::size_t i = 0; i < discs; ++i) disc(10 + random.below(20));
  return convex_hull(points);
}

/// The convex hull of a few cylinders of coarse chords along the axes, of which many faces are coplanar.
Soup random_hull_of_cylinders(Random& random)
{
  std::vector<Surface_mesh::Point> points;
  const auto cylinder = [&](std::size_t n) {
    const Vector_3 center(random.real(0, 2), random.real(0, 1.2), random.real(0, 1.5));
    const int k = int(random.below(3));
    const Vector_3 axis = Vector_3::Unit(k), x = Vector_3::Unit((k + 1) % 3), y = Vector_3::Unit((k + 2) % 3);
    const double r = random.real(0.2, 0.6), height = random.real(0.2, 0.8);
    for (const double side : {-0.5, 0.5})
      for (std::size_t i = 0; i < n; ++i) {
        const double a = 2 * pi * double(i) / double(n);
        const Vector_3 p = center + r * (std::cos(a) * x + std::sin(a) * y) + side * height * axis;
        points.push_back(in_single_precision(p));
      }
  };
  const std::size_t cylinders = 3 + random.below(4);
  for (std::size_t i = 0; i < cylinders; ++i) cylinder(8 + random.below(12));
  return convex_hull(points);
}

/// The convex hull of a drum with flat ends and round rims, of which no faces are coplanar but for some noise.
Soup random_hull_of_drum(Random& random)
{
  const std::size_t n = 10 + random.below(17), rows = 2 + random.below(3);
  const double r = random.real(0.3, 1), rim = random.real(0.15, 0.5), height = random.real(0.1, 1.2), shift = random.real(0, 0.3);
  const double noise = std::pow(10, random.real(-5, -3.5)) * (r + rim);
  const Vector_3 axis = random.vector().normalized(), x = axis.unitOrthogonal(), y = axis.cross(x);
  std::vector<Surface_mesh::Point> points;
  for (const double side : {-1.0, 1.0})
    for (std::size_t row = 0; row <= rows; ++row)
      for (std::size_t i = 0; i < n; ++i) {
        const double a = 2 * pi * (double(i) + shift * random.real() + 0.5 * double(row % 2)) / double(n);
        const double b = pi / 2 * double(row) / double(rows);
        const Vector_3 p = (r + rim * std::cos(b)) * (std::cos(a) * x + std::sin(a) * y) +
                           side * (height / 2 + rim * std::sin(b)) * axis + noise * random.vector();
        points.push_back(in_single_precision(p));
      }
  return convex_hull(points);
}

/// How far the vertices of a mesh are from a convex polyhedron: from the planes of its faces, which is less than from
/// these where a vertex is outside of an edge.
double largest_distance(const Soup& polyhedron, const Soup& mesh)
{
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> outside(mesh.points.size(), -infinity);
  for (const shapes::Triangle& t : polyhedron.triangles) {
    const Vector_3 n = twice_area(polyhedron.points, {t[0], t[1], t[2]}).normalized();
    for (std::size_t v = 0; v < outside.size(); ++v)
      outside[v] = std::max(outside[v], n.dot(mesh.points[v] - polyhedron.points[t[0]]));
  }
  double largest = 0;
  for (const double x : outside) largest = std::max(largest, std::abs(x));
  return largest;
}

double diagonal(const Soup& soup)
{
  Eigen::AlignedBox3d box;
  for (const Vector_3& p : soup.points) box.extend(p);
  return box.diagonal().norm();
}

/// Adapts `n` convex hulls: how far these are left at most, and in the mean, in diagonals.
template <class Make_hull>
void expect_near_hulls(const Make_hull& random_hull, std::uint64_t seed, int n, double largest, double mean)
{
  Random random(seed);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE(std::to_string(i));
    const Soup hull = random_hull(random);
    const double distance = largest_distance(hull, adapted(hull, 0.05)) / diagonal(hull);
    EXPECT_LE(distance, largest);
    sum += distance;
  }
  EXPECT_LE(sum, mean * n);
}

/// Few of their faces are coplanar, and all are bad: fits to these vertices say nothing.
TEST(Cad_tessellations, of_convex_hulls_stay_near_them)
{
  const auto hull_with_chords = [](Random& random) {
    Soup hull = random_hull(random);
    EXPECT_TRUE(facets_of(hull).are_chords());
    return hull;
  };
  expect_near_hulls(hull_with_chords, 27, 10, 0.025, 0.01);
}

/// Rows of chords are left of the cylinders, and most of what bends bridges the gaps between these.
TEST(Cad_tessellations, of_convex_hulls_with_coplanar_faces_stay_near_them)
{
  expect_near_hulls(random_hull_of_cylinders, 31, 20, 0.02, 0.009);
}

/// Flat ends of many vertices would bulge as their rims do.
TEST(Cad_tessellations, of_convex_hulls_with_flats_stay_near_them)
{
  expect_near_hulls(random_hull_of_drum, 32, 20, 0.02, 0.007); // of chords of a tenth of a turn
}

TEST(Cad_tessellations, of_convex_hulls_are_adapted_alike_by_all_policies)
{
  Random random(28);
  const Soup hull = random_hull(random), expected = adapted(hull, 0.1);
  for_each_policy([&](const auto& execution, const std::string& name) {
    EXPECT_TRUE(checks::is_identical(expected, adapted(hull, 0.1, execution))) << name;
  });
}

/// Meshes of solvers are stretched evenly: fits to these know the surface better than their faces do.
TEST(Cad_tessellations, are_no_meshes_that_are_stretched_evenly)
{
  for (const auto& [nu, nv] : {std::pair(160, 12), std::pair(300, 30), std::pair(24, 120), std::pair(40, 300)}) {
    const Soup torus = shapes::torus(std::size_t(nu), std::size_t(nv), 0.15);
    EXPECT_TRUE(facets_of(torus).empty()) << nu << ", " << nv;
  }
}

/// Fits to scans with much noise say nothing either.
TEST(Cad_tessellations, are_no_scans_with_noise)
{
  Random random(29);
  for (const double noise : {0.1, 0.2, 0.3, 0.5}) {
    constexpr double edge = 0.1;
    Soup torus = shapes::torus(64, 24, 0.3);
    for (Vector_3& p : torus.points) p += noise * edge * random.vector();
    EXPECT_TRUE(facets_of(torus).empty()) << noise;
  }
}

} // namespace test_cad_tessellations

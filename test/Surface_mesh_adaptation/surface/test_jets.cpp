// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals and shape operators of local fits: their order on surfaces of which everything is known, and their manners
// where there is nothing to fit.

#include "analytic_fields.h"
#include "policies.h"

#include <CGAL/Surface_mesh_adaptation/surface/vertex_jets.h>

#include <gtest/gtest.h>

#include <cstring>

namespace test_jets {

namespace SMA = CGAL::Surface_mesh_adaptation;
using analytic::Featured_mesh;
using analytic::Surface;
using shapes::Index;
using shapes::Soup;
using SMA::Corner_jets;
using SMA::Jet_fit;
using SMA::Matrix_3;
using SMA::Vector_3;

const SMA::Sequential_execution sequential;

/// Jittered meshes have slivers that look like ridges.
SMA::Feature_parameters without_ridges()
{
  SMA::Feature_parameters p;
  p.detect_ridges = false;
  return p;
}

Corner_jets jets(const Soup& soup, Jet_fit fit = Jet_fit::exact)
{
  return estimate_jets(sequential, Featured_mesh(soup, without_ridges()).view, soup.points, fit);
}

/// Errors of the normals (radians) and of the shape operators (relative to the largest curvature, root of the mean
/// over both principal directions).
struct Errors
{
  double largest_normal = 0, largest_shape = 0, rms_shape = 0;
};

/// `exact` are the points of the surface that the points of `soup` stand for.
Errors errors(const Surface& surface, const Soup& exact, const Soup& soup, Jet_fit fit, bool on_boundary)
{
  const SMA::Mesh_view view = Featured_mesh(soup, without_ridges()).view;
  const Corner_jets j = estimate_jets(sequential, view, soup.points, fit);
  Errors e;
  double squares = 0, n = 0;
  for (Index v = 0; v < soup.points.size(); ++v) {
    if (view.is_border_vertex(v) != on_boundary) continue;
    const auto jet = j.at(view.outgoing[v]);
    const Vector_3 normal = surface.normal(exact.points[v]);
    const Matrix_3 difference = jet.shape_operator.matrix() - surface.shape_operator(exact.points[v]);
    const double shape = difference.norm() / std::sqrt(2) / surface.largest_curvature;
    e.largest_normal = (std::max)(e.largest_normal, std::atan2(normal.cross(jet.normal).norm(), normal.dot(jet.normal)));
    e.largest_shape = (std::max)(e.largest_shape, shape);
    squares += shape * shape;
    ++n;
  }
  e.rms_shape = std::sqrt(squares / n);
  return e;
}

Errors errors(const Surface& surface, int level, bool on_boundary = false)
{
  const Soup soup = surface.mesh(level);
  return errors(surface, soup, soup, Jet_fit::exact, on_boundary);
}

TEST(Jets, have_normals_of_third_and_shape_operators_of_second_order)
{
  for (const Surface& surface : {analytic::ellipsoid(), analytic::torus(), analytic::graph()}) {
    const Errors coarse = errors(surface, 1), fine = errors(surface, 3);
    // 2.58 on the ellipsoid, where the coarse mesh gains most from the terms of fourth order
    EXPECT_GT(std::log2(coarse.largest_normal / fine.largest_normal) / 2, 2.5) << surface.name;
    EXPECT_GT(std::log2(coarse.rms_shape / fine.rms_shape) / 2, 1.8) << surface.name;
    EXPECT_LT(fine.rms_shape, 0.01) << surface.name; // edges of a tenth to a fifth of the smallest radius
    EXPECT_LT(fine.largest_shape, 0.03) << surface.name;
    EXPECT_LT(fine.largest_normal, 2e-3) << surface.name;
  }
}

TEST(Jets, keep_their_order_at_the_boundary)
{
  const Errors coarse = errors(analytic::graph(), 1, true), fine = errors(analytic::graph(), 3, true);
  EXPECT_GT(std::log2(coarse.largest_normal / fine.largest_normal) / 2, 2.3);
  EXPECT_GT(std::log2(coarse.rms_shape / fine.rms_shape) / 2, 1.6);
  EXPECT_LT(fine.rms_shape, 0.01);
}

TEST(Jets, of_noisy_points_are_robust)
{
  for (const auto& [surface, level] : {std::pair(analytic::ellipsoid(), 3), std::pair(analytic::torus(), 2)}) {
    const Soup exact = surface.mesh(level), noisy = analytic::with_noise(exact, 0.02);
    const Errors robust = errors(surface, exact, noisy, Jet_fit::noisy, false);
    EXPECT_LT(robust.rms_shape, 0.05) << surface.name;
    EXPECT_LT(2 * robust.rms_shape, errors(surface, exact, noisy, Jet_fit::exact, false).rms_shape) << surface.name;
  }
}

TEST(Jets, of_a_sphere_have_the_sign_of_outer_normals)
{
  const double radius = 2.5;
  Soup soup = shapes::sphere(3, 0.3);
  for (Vector_3& p : soup.points) p *= radius;
  const SMA::Mesh_view view = shapes::view(soup);
  const Corner_jets j = jets(soup);
  EXPECT_EQ(j.cubic_fits, soup.points.size());
  for (Index h = 0; h < view.number_of_halfedges(); ++h) {
    const Vector_3 n = soup.points[view.source(h)].normalized();
    const Matrix_3 expected = (Matrix_3::Identity() - n * n.transpose()) / radius;
    EXPECT_LT((j.at(h).normal - n).norm(), 2e-3);
    EXPECT_LT((j.at(h).shape_operator.matrix() - expected).norm(), 0.04 / radius);
  }
}

TEST(Jets, of_stretched_faces_are_cubic_fits_in_any_direction)
{
  for (const double angle : {0.0, 0.5, 1.2}) {
    const Matrix_3 turn = Eigen::AngleAxisd(angle, Vector_3(1, 2, 0).normalized()).toRotationMatrix();
    const Soup soup = analytic::mapped(shapes::square(10, 0.3), [&](const Vector_3& p) {
      const double x = 0.6 * (p[0] - 0.5), y = 0.02 * (p[1] - 0.5);
      return Vector_3(turn * Vector_3(x, y, std::sqrt(1 - x * x - y * y))); // of the unit sphere
    });
    const SMA::Mesh_view view = shapes::view(soup);
    const Corner_jets j = jets(soup);
    EXPECT_EQ(j.cubic_fits, soup.points.size()) << angle;
    for (Index v = 0; v < soup.points.size(); ++v) {
      if (view.is_border_vertex(v)) continue;
      const Vector_3 n = soup.points[v];
      EXPECT_LT((j.at(view.outgoing[v]).normal - n).norm(), 5e-5) << angle;
      EXPECT_LT((j.at(view.outgoing[v]).shape_operator.matrix() - (Matrix_3::Identity() - n * n.transpose())).norm(), 0.05);
    }
  }
}

TEST(Jets, change_sign_with_the_orientation)
{
  const Soup soup = analytic::torus().mesh(1);
  Soup inverted = soup;
  for (shapes::Triangle& t : inverted.triangles) std::swap(t[1], t[2]);
  const SMA::Mesh_view view = shapes::view(soup), inverted_view = shapes::view(inverted);
  const Corner_jets a = jets(soup), b = jets(inverted);
  for (Index v = 0; v < soup.points.size(); ++v) {
    const auto ja = a.at(view.outgoing[v]), jb = b.at(inverted_view.outgoing[v]);
    EXPECT_LT((ja.normal + jb.normal).norm(), 1e-10);
    EXPECT_LT((ja.shape_operator.matrix() + jb.shape_operator.matrix()).norm(), 1e-8);
  }
}

/// Unit normals, and symmetric operators of the tangent planes.
void expect_jets_of_tangent_planes(const Corner_jets& j)
{
  for (std::size_t i = 0; i < j.normals.size(); ++i) {
    ASSERT_TRUE(j.shape_operators[i].matrix().allFinite());
    EXPECT_NEAR(j.normals[i].norm(), 1, 1e-12);
    EXPECT_LE((j.shape_operators[i] * j.normals[i]).norm(), 1e-11 * (1 + j.shape_operators[i].matrix().norm()));
  }
  EXPECT_EQ(j.cubic_fits + j.quadratic_fits + j.fallbacks, j.normals.size());
}

TEST(Jets, stay_in_the_tangent_planes_whatever_the_noise)
{
  for (const double noise : {0.0, 0.02, 0.3, 2.0})
    for (const Jet_fit fit : {Jet_fit::exact, Jet_fit::noisy}) {
      const Soup soup = analytic::with_noise(analytic::torus().mesh(1), noise);
      expect_jets_of_tangent_planes(jets(soup, fit));
      expect_jets_of_tangent_planes(estimate_jets(sequential, Featured_mesh(soup).view, soup.points, fit));
    }
}

// Features

TEST(Jets, of_a_cube_are_those_of_its_sides)
{
  const Soup soup = shapes::cube(6);
  const Featured_mesh m(soup);
  const Corner_jets j = estimate_jets(sequential, m.view, soup.points);
  EXPECT_EQ(j.normals.size(), 6 * 7 * 7);
  for (Index h = 0; h < m.view.number_of_halfedges(); ++h) {
    const Vector_3 n = SMA::internal::face_normal(m.view, soup.points, 3 * (h / 3)).normalized();
    EXPECT_LT((j.at(h).normal - n).norm(), 1e-12);
    EXPECT_LT(j.at(h).shape_operator.matrix().norm(), 1e-10);
  }
}

TEST(Jets, do_not_look_across_ridges)
{
  const Soup soup = shapes::capped_cylinder(48, 12, 1.5);
  const Featured_mesh m(soup);
  const Corner_jets j = estimate_jets(sequential, m.view, soup.points);
  EXPECT_EQ(j.normals.size(), soup.points.size() + 2 * 48);
  for (Index h = 0; h < m.view.number_of_halfedges(); ++h) {
    const Vector_3 n = SMA::internal::face_normal(m.view, soup.points, 3 * (h / 3)).normalized();
    const bool is_cap = std::abs(n[2]) > 0.5;
    const Vector_3& p = soup.points[m.view.source(h)];
    const Vector_3 radial = Vector_3(p[0], p[1], 0), around = Vector_3::UnitZ().cross(radial);
    const Matrix_3 expected = is_cap ? Matrix_3::Zero().eval() : Matrix_3(around * around.transpose());
    EXPECT_LT((j.at(h).normal - (is_cap ? n : radial)).norm(), 4e-3); // a look across would show as 1
    EXPECT_LT((j.at(h).shape_operator.matrix() - expected).norm(), 0.05);
  }
}

// Hardly anything to fit

TEST(Jets, of_tiny_meshes_are_finite)
{
  const Soup one_face{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const Soup& soup : {shapes::tetrahedron(), shapes::cube(1), shapes::octahedron(), shapes::icosahedron(), one_face})
    for (const Jet_fit fit : {Jet_fit::exact, Jet_fit::noisy}) {
      expect_jets_of_tangent_planes(jets(soup, fit)); // one sector at each vertex
      expect_jets_of_tangent_planes(estimate_jets(sequential, Featured_mesh(soup).view, soup.points, fit));
    }
  // without samples enough, the normals of the corners of the octahedron still tell that it is round
  const Corner_jets round = jets(shapes::octahedron());
  EXPECT_EQ(round.cubic_fits, 0u);
  for (const auto& s : round.shape_operators) EXPECT_GT(s.matrix().trace(), 1);
}

TEST(Jets, of_degenerate_faces_are_finite)
{
  Soup collapsed = analytic::torus().mesh(1), needles = collapsed, point = shapes::icosahedron();
  for (std::size_t i = 0; i < 40; ++i) collapsed.points[i] = collapsed.points[0];
  for (Vector_3& p : needles.points) p[2] *= 1e-12;
  for (Vector_3& p : point.points) p.setZero();
  for (const Soup& soup : {collapsed, needles, point})
    for (const Jet_fit fit : {Jet_fit::exact, Jet_fit::noisy}) expect_jets_of_tangent_planes(jets(soup, fit));
}

TEST(Jets, do_not_depend_on_the_scale)
{
  const Soup soup = analytic::ellipsoid().mesh(1);
  const Corner_jets one = jets(soup);
  for (const double scale : {1e-12, 1e12}) {
    Soup scaled = soup;
    for (Vector_3& p : scaled.points) p *= scale;
    const Corner_jets j = jets(scaled);
    for (std::size_t i = 0; i < one.normals.size(); ++i) {
      EXPECT_LT((j.normals[i] - one.normals[i]).norm(), 1e-12);
      EXPECT_LT((scale * j.shape_operators[i].matrix() - one.shape_operators[i].matrix()).norm(), 1e-10);
    }
  }
}

TEST(Jets, of_a_hub_come_from_its_own_ring)
{
  // a spherical cap of which a vertex has 2000 neighbours
  constexpr Index n = 2000;
  Soup soup{{{0, 0, 1}}, {}};
  for (const double latitude : {0.1, 0.2})
    for (Index i = 0; i < n; ++i) {
      const double u = 2 * shapes::pi * i / n;
      soup.points.emplace_back(std::sin(latitude) * std::cos(u), std::sin(latitude) * std::sin(u), std::cos(latitude));
    }
  for (Index i = 0; i < n; ++i) {
    const Index a = 1 + i, b = 1 + (i + 1) % n;
    soup.triangles.insert(soup.triangles.end(), {{0, a, b}, {a, a + n, b + n}, {a, b + n, b}});
  }
  const Corner_jets j = jets(soup);
  expect_jets_of_tangent_planes(j);
  const auto top = j.at(shapes::view(soup).outgoing[0]);
  EXPECT_LT((top.normal - Vector_3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((top.shape_operator.matrix() - Matrix_3(Vector_3(1, 1, 0).asDiagonal())).norm(), 0.01);
}

TEST(Jets, are_the_same_bits_with_every_policy)
{
  const Soup soup = analytic::with_noise(analytic::graph().mesh(3), 0.1);
  const Featured_mesh m(soup);
  for (const Jet_fit fit : {Jet_fit::exact, Jet_fit::noisy}) {
    const Corner_jets expected = estimate_jets(sequential, m.view, soup.points, fit);
    for_each_policy([&](const auto& execution, const std::string& name) {
      const Corner_jets j = estimate_jets(execution, m.view, soup.points, fit);
      const std::size_t n = expected.normals.size();
      ASSERT_EQ(j.normals.size(), n);
      EXPECT_EQ(std::memcmp(j.normals.data(), expected.normals.data(), n * sizeof(Vector_3)), 0) << name;
      EXPECT_TRUE(j.shape_operators == expected.shape_operators) << name;
      EXPECT_TRUE(j.of_corner == expected.of_corner) << name;
      EXPECT_EQ(j.fallbacks, expected.fallbacks) << name;
    });
  }
}

} // namespace test_jets

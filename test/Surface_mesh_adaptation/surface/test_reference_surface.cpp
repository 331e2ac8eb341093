// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reference surface: its normals, points and curvature, and walks over it.

#include "decimated_meshes.h"
#include "shape_meshes.h"
#include "surface/references.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/fields/curvature.h>
#include <CGAL/Surface_mesh_adaptation/numerics/bounding_box.h>
#include <CGAL/Surface_mesh_adaptation/surface/surface_bulge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

namespace test_reference_surface {

using namespace references_of_tests;
using SMA::Location;
using SMA::Surface_point;

// Normals

TEST(Normals, are_exact_on_spheres)
{
  const Soup s = shapes::sphere(3, 0.5);
  const Surface r = reference(s);
  for (Index h = 0; h < r.mesh.number_of_halfedges(); ++h)
    EXPECT_LT((r.normals.at(h) - s.points[r.mesh.corner[h]]).norm(), 1e-12);
}

TEST(Normals, are_of_first_order_on_other_surfaces)
{
  double previous = 0;
  for (const std::size_t n : {24u, 48u, 96u, 192u}) {
    const Soup s = shapes::torus(n, n / 2, 0.2);
    const Surface r = reference(s);
    double sum = 0;
    for (Index h = 0; h < r.mesh.number_of_halfedges(); ++h)
      sum += (r.normals.at(h) - shapes::torus_normal(s.points[r.mesh.corner[h]])).squaredNorm();
    const double rms = std::sqrt(sum / double(r.mesh.number_of_halfedges()));
    if (previous > 0) {
      EXPECT_GT(std::log2(previous / rms), 0.85);
    }
    previous = rms;
  }
  EXPECT_LT(previous, 0.02);
}

TEST(Normals, are_one_for_each_smooth_sector)
{
  const Surface cube = reference(shapes::cube(3));
  for (Index h = 0; h < cube.mesh.number_of_halfedges(); ++h) {
    const Vector_3 n = SMA::internal::face_normal(cube.mesh, cube.points, h).normalized();
    EXPECT_LT((cube.normals.at(h) - n).norm(), 1e-12);
  }
  for (Index v = 0; v < cube.mesh.number_of_vertices(); ++v) {
    std::set<Index> of_vertex;
    cube.mesh.for_each_outgoing(v, [&](Index h) { of_vertex.insert(cube.normals.of_corner[h]); });
    const std::size_t expected[] = {1, 2, 3}; // smooth, curve, corner
    EXPECT_EQ(of_vertex.size(), expected[std::size_t(cube.features.vertex_class[v])]);
  }
}

/// Largest distance of the reference surface to the torus that it was made from.
double reference_error(std::size_t n)
{
  const Surface r = reference(shapes::torus(n, n / 2, 0.2));
  double worst = 0;
  for (Index f = 0; f < r.mesh.number_of_faces(); ++f)
    for (const double u : {0.0, 0.2, 0.5})
      for (const double v : {0.1, 0.3, 0.5})
        worst = (std::max)(worst, shapes::torus_distance(r.evaluate({Vertex_class::smooth, f, u, v}).position));
  return worst;
}

TEST(Reference_surface, is_of_second_order_with_estimated_normals)
{
  EXPECT_GT(std::log(reference_error(64) / reference_error(256)) / std::log(4), 1.7);
}

TEST(Reference_surface, has_its_vertices_where_they_were)
{
  for (const Soup& soup :
       {shapes::sphere(2), shapes::square(5, 0.2), shapes::cube(3), shapes::capped_cylinder(20, 4, 1)}) {
    const Surface r = reference(soup);
    for (Index v = 0; v < soup.points.size(); ++v) {
      const Location l = r.location_of_vertex(v);
      EXPECT_EQ(l.kind, r.features.vertex_class[v]);
      EXPECT_LT((r.evaluate(l).position - soup.points[v]).norm(), 1e-14);
      const auto i = r.interpolation(l);
      Vector_3 sum = Vector_3::Zero();
      for (std::size_t k = 0; k < 3; ++k) sum += i.weights[k] * soup.points[i.vertices[k]];
      EXPECT_LT((sum - soup.points[v]).norm(), 1e-12);
    }
  }
}

// Walks

Location random_location(const Surface& r, Random& random)
{
  double u = random.real(), v = random.real();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return {Vertex_class::smooth, Index(random.below(r.mesh.number_of_faces())), u, v};
}

bool lies_in_its_face(const Location& l) { return l.u >= 0 && l.v >= 0 && l.u + l.v <= 1 + 1e-12; }

TEST(Trace, is_straight_on_a_plane)
{
  const Surface r = reference(shapes::square(12, 0.3));
  Random random(7);
  std::size_t crossed = 0;
  for (int i = 0; i < 2000; ++i) {
    const Location from = random_location(r, random);
    const Vector_3 p = r.evaluate(from).position, t(random.real(-0.3, 0.3), random.real(-0.3, 0.3), 0);
    const Vector_3 goal = p + t;
    if (goal.head<2>().minCoeff() < 0 || goal.head<2>().maxCoeff() > 1) continue;
    for (const bool keep_length : {true, false}) {
      const Location to = r.trace(from, t, keep_length);
      ASSERT_TRUE(lies_in_its_face(to));
      EXPECT_LT((r.evaluate(to).position - goal).norm(), 1e-12);
      crossed += to.cell != from.cell;
    }
  }
  EXPECT_GT(crossed, 1000u);
}

TEST(Trace, keeps_the_length_if_asked_to)
{
  const Surface r = reference(shapes::square(12, 0.3));
  const Location from = r.location_of_vertex(80);
  const Vector_3 p = r.evaluate(from).position, t(0.1, 0.05, 0.2); // not tangent
  EXPECT_NEAR((r.evaluate(r.trace(from, t, true)).position - p).norm(), t.norm(), 1e-12);
  EXPECT_NEAR((r.evaluate(r.trace(from, t, false)).position - p).norm(), t.head<2>().norm(), 1e-12);
}

TEST(Trace, follows_geodesics_of_the_sphere)
{
  double previous = 0;
  for (const int level : {3, 4, 5}) {
    const Surface r = reference(shapes::sphere(level));
    Random random(8);
    double sum = 0;
    const int walks = 300;
    const double length = 0.4;
    for (int i = 0; i < walks; ++i) {
      const Location from = random_location(r, random);
      const Surface_point x = r.evaluate(from);
      const Vector_3 p = x.position.normalized(), t = (random.vector().cross(p)).normalized();
      const Vector_3 end = r.evaluate(r.trace(from, length * t, true)).position;
      sum += (end - (std::cos(length) * p + std::sin(length) * t)).squaredNorm();
    }
    const double rms = std::sqrt(sum / walks);
    if (previous > 0) {
      EXPECT_LT(rms, 0.6 * previous);
    }
    previous = rms;
  }
  EXPECT_LT(previous, 2e-3);
}

TEST(Trace, never_crosses_features)
{
  const Surface cube = reference(shapes::cube(6));
  Random random(9);
  for (int i = 0; i < 3000; ++i) {
    const Location from = random_location(cube, random);
    const Vector_3 n = cube.evaluate(from).normal;
    const Location to = cube.trace(from, 3 * random.vector(), i % 2 == 0);
    ASSERT_TRUE(lies_in_its_face(to));
    EXPECT_LT((cube.evaluate(to).normal - n).norm(), 1e-12);
    EXPECT_LE(cube.evaluate(to).position.cwiseAbs().maxCoeff(), 1 + 1e-12);
  }
}

TEST(Trace, survives_degenerate_faces_and_steps)
{
  Soup s = shapes::sphere(2);
  const shapes::Triangle& t = s.triangles[50];
  s.points[t[0]] = s.points[t[1]];
  const Surface r = reference(s);
  Random random(10);
  for (int i = 0; i < 3000; ++i) {
    const Location from = random_location(r, random);
    const double length = i % 3 == 0 ? 0 : std::exp(random.real(-40, 5));
    const Location to = r.trace(from, length * random.vector(), i % 2 == 0);
    ASSERT_TRUE(lies_in_its_face(to));
    ASSERT_TRUE(r.evaluate(to).position.allFinite());
  }
}

TEST(Locate, finds_the_closest_point)
{
  const Surface r = reference(shapes::sphere(4, 0.3));
  Random random(11);
  for (int i = 0; i < 500; ++i) {
    const Location from = random_location(r, random);
    const Vector_3 p = r.evaluate(from).position.normalized();
    const Vector_3 goal = (p + 0.1 * random.vector()).normalized();
    const double height = random.real(0.95, 1.05);
    const Surface::Located_point to = r.locate({from, r.evaluate(from)}, height * goal, 1e-6);
    EXPECT_EQ(to.point.position, r.evaluate(to.location).position);
    EXPECT_LT((to.point.position.normalized() - goal).norm(), 2e-3);
  }
}

TEST(Locate, reaches_a_point_that_lies_on_the_surface)
{
  const Surface r = reference(shapes::torus(60, 30, 0.2));
  Random random(12);
  for (int i = 0; i < 500; ++i) {
    const Location goal = random_location(r, random);
    const Vector_3 p = r.evaluate(goal).position;
    const Location from = r.trace(goal, 0.05 * random.vector(), false);
    EXPECT_LT((r.locate({from, r.evaluate(from)}, p, 1e-9).point.position - p).norm(), 1e-3);
  }
}

/// Patches over the triangles of a crumpled mesh are much longer than these.
TEST(Locate, never_leads_away)
{
  Random random(13);
  shapes::Soup soup = shapes::sphere(2, 0.3);
  for (Vector_3& p : soup.points) p *= random.real(0.6, 1.4);
  const Surface r = reference(soup);
  for (int i = 0; i < 2000; ++i) {
    const Location from = random_location(r, random);
    const Vector_3 p = r.evaluate(from).position, target = p + 0.2 * random.vector();
    const Surface::Located_point to = r.locate({from, r.evaluate(from)}, target, 1e-6);
    EXPECT_LE((to.point.position - target).norm(), (p - target).norm());
  }
}

// Curves

TEST(Arc, takes_the_shorter_way_around_a_closed_curve)
{
  const Surface r = reference(shapes::capped_cylinder(32, 4, 1));
  const SMA::Feature_curve& c = r.features.curves[0];
  const double length = c.length(), step = length / 32;
  const auto at = [&](double s) { return r.on_curve(0, s); };
  EXPECT_NEAR(at(length + step).u, step, 1e-12);
  EXPECT_NEAR(at(-step).u, length - step, 1e-12);
  EXPECT_EQ(at(step).kind, Vertex_class::curve);
  for (const auto& ends : {std::make_pair(step, 3 * step), std::make_pair(3 * step, step),
                           std::make_pair(length - step, step), std::make_pair(step, length - step)}) {
    const auto arc = r.arc(0, at(ends.first), at(ends.second));
    EXPECT_NEAR(std::abs(arc.second - arc.first), 2 * step, 1e-12);
    const Vector_3 a = r.evaluate(at(ends.first)).position, b = r.evaluate(at(ends.second)).position;
    const Vector_3 middle = r.evaluate(at((arc.first + arc.second) / 2)).position;
    EXPECT_NEAR((middle - a).norm(), (middle - b).norm(), 1e-3 * step);
    EXPECT_LT((middle - a).norm(), 1.1 * step);
  }
}

TEST(Arc, starts_and_ends_at_the_corners_of_an_open_curve)
{
  const Surface r = reference(shapes::cube(5));
  for (Index id = 0; id < r.features.curves.size(); ++id) {
    const SMA::Feature_curve& c = r.features.curves[id];
    const Location first = r.location_of_vertex(c.vertices.front()), second = r.location_of_vertex(c.vertices[1]),
                   before_last = r.location_of_vertex(c.vertices[4]), last = r.location_of_vertex(c.vertices.back());
    EXPECT_NEAR(r.arc(id, first, second).first, 0, 1e-12);
    EXPECT_NEAR(r.arc(id, first, second).second, 0.4, 1e-12);
    EXPECT_NEAR(r.arc(id, before_last, last).second, 2, 1e-12);
    EXPECT_NEAR(r.arc(id, last, first).first, 2, 1e-12);
    const Vector_3 middle = r.evaluate(r.on_curve(id, 1)).position;
    EXPECT_LT((middle - (r.points[c.vertices.front()] + r.points[c.vertices.back()]) / 2).norm(), 1e-12);
  }
}

TEST(Curve, of_a_circle_is_rounder_than_its_polyline)
{
  double previous = 0;
  for (const std::size_t around : {12u, 24u, 48u}) {
    const Surface r = reference(shapes::capped_cylinder(around, 2, 1));
    double worst = 0;
    for (Index id = 0; id < 2; ++id)
      for (int i = 0; i < 1000; ++i) {
        const Vector_3 p = r.evaluate(r.on_curve(id, r.features.curves[id].length() * i / 1000)).position;
        worst = (std::max)(worst, std::abs(std::hypot(p[0], p[1]) - 1));
      }
    EXPECT_LT(worst, 0.5 * (1 - std::cos(pi / double(around))));
    if (previous > 0) {
      EXPECT_GT(std::log2(previous / worst), 1.9);
    }
    previous = worst;
  }
}

// Curvature

TEST(Curvature, of_a_sphere_is_the_identity_of_its_tangent_planes)
{
  const Soup s = shapes::sphere(4, 0.3);
  const Surface r = reference(s);
  const auto tensors = SMA::curvature_tensors(sequential, r);
  for (std::size_t v = 0; v < s.points.size(); ++v) {
    const SMA::Matrix_3 expected = SMA::Matrix_3::Identity() - s.points[v] * s.points[v].transpose();
    EXPECT_LT((tensors[v].matrix() - expected).norm(), 0.1);
  }
}

TEST(Curvature, of_a_torus_is_right_on_average)
{
  const Soup s = shapes::torus(128, 64, 0.1);
  const Surface r = reference(s);
  const auto tensors = SMA::curvature_tensors(sequential, r);
  double sum = 0;
  for (std::size_t v = 0; v < s.points.size(); ++v) {
    const double largest = SMA::eigen_decomposition(tensors[v]).values.cwiseAbs().maxCoeff();
    sum += std::abs(largest - 1 / shapes::torus_small_radius) * shapes::torus_small_radius;
  }
  EXPECT_LT(sum / double(s.points.size()), 0.05);
}

// Patches

TEST(Patches, stay_near_decimated_parts_where_fits_do_not_agree_with_them)
{
  using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  using Part = std::pair<std::string, double>;
  for (const auto& [name, share] : {Part("joint", 0.11), Part("joint", 0.12), Part("joint", 0.15), Part("couplingdown", 0.12),
                                    Part("couplingdown", 0.13), Part("couplingdown", 0.15)}) {
    SCOPED_TRACE(name + " " + std::to_string(share));
    const Soup part = shapes::soup(decimated_mesh<Mesh>(name, share));
    const SMA::Reference_surface<SMA::Gregory_reconstruction> r(sequential, shapes::view(part), part.points, {});
    EXPECT_FALSE(r.features.facets.empty());
    EXPECT_LT(SMA::surface_bulge(sequential, r, 0.0), 0.0055 * SMA::internal::diagonal_of_bounding_box(part.points));
  }
}

} // namespace test_reference_surface

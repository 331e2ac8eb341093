// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reference surface: features, normals, patches, and walks over it.

#include "checks.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/fields/curvature.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <gtest/gtest.h>

#include <set>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::no_index;
using shapes::pi;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Feature_parameters;
using SMA::Features;
using SMA::Flat_reconstruction;
using SMA::Location;
using SMA::Mesh_view;
using SMA::Patch;
using SMA::PN_triangle_reconstruction;
using SMA::Surface_point;
using SMA::Vertex_class;
using Surface = SMA::Reference_surface<PN_triangle_reconstruction>;
using Flat_surface = SMA::Reference_surface<Flat_reconstruction>;

const SMA::Sequential_execution sequential;

template <class Reference = Surface>
Reference reference(const Soup& soup, const Feature_parameters& parameters = {})
{
  return Reference(sequential, shapes::view(soup), soup.points, parameters);
}

std::size_t count(const Features& f, Vertex_class c)
{
  return std::size_t(std::count(f.vertex_class.begin(), f.vertex_class.end(), c));
}

// Features

TEST(Features, of_a_smooth_closed_surface_are_none)
{
  for (const Soup& soup : {shapes::sphere(3, 0.3), shapes::torus(48, 24, 0.2)}) {
    const Surface s = reference(soup);
    EXPECT_TRUE(s.features.curves.empty());
    EXPECT_EQ(count(s.features, Vertex_class::smooth), soup.points.size());
  }
}

TEST(Features, of_a_cube_are_twelve_curves_and_eight_corners)
{
  const Surface s = reference(shapes::cube(5));
  EXPECT_EQ(s.features.curves.size(), 12u);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 8u);
  EXPECT_EQ(count(s.features, Vertex_class::curve), 12u * 4u);
  for (const SMA::Feature_curve& c : s.features.curves) {
    EXPECT_FALSE(c.is_closed());
    EXPECT_NEAR(c.length(), 2, 1e-12);
    EXPECT_EQ(c.vertices.size(), 6u);
    for (const Vector_3& t : c.tangents) EXPECT_NEAR(t.cwiseAbs().maxCoeff(), 1, 1e-12);
  }
}

TEST(Features, of_a_capped_cylinder_are_two_closed_curves)
{
  const Surface s = reference(shapes::capped_cylinder(32, 6, 2));
  ASSERT_EQ(s.features.curves.size(), 2u);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 0u);
  for (const SMA::Feature_curve& c : s.features.curves) {
    EXPECT_TRUE(c.is_closed());
    EXPECT_NEAR(c.length(), 32 * 2 * std::sin(pi / 32), 1e-12);
    for (std::size_t i = 0; i < c.vertices.size(); ++i) {
      const Vector_3& p = s.points[c.vertices[i]];
      EXPECT_NEAR(c.tangents[i].dot(Vector_3(p[0], p[1], 0)), 0, 1e-12); // exact for even points on a circle
    }
  }
}

TEST(Features, are_the_same_on_both_sides_of_an_edge)
{
  for (const Soup& soup :
       {shapes::cube(4), shapes::capped_cylinder(24, 5, 1), shapes::square(6), shapes::open_cylinder(9, 4, 1)})
    EXPECT_TRUE(checks::is_valid(reference(soup).mesh));
}

TEST(Features, of_a_square_are_its_sides)
{
  const Surface s = reference(shapes::square(8));
  EXPECT_EQ(s.features.curves.size(), 4u);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 4u);
  Feature_parameters off;
  off.detect_ridges = false;
  EXPECT_EQ(reference(shapes::square(8), off).features.curves.size(), 4u) << "boundaries are features in any case";
  EXPECT_TRUE(reference(shapes::cube(4), off).features.curves.empty());
}

TEST(Features, depend_on_the_angle_asked_for)
{
  const Soup prism = shapes::capped_cylinder(9, 3, 1); // edges of the side turn by 40 degrees, those of the caps by 90
  Feature_parameters p;
  EXPECT_EQ(count(reference(prism, p).features, Vertex_class::corner), 0u);
  p.ridge_angle = 39;
  const Features sharp = reference(prism, p).features;
  EXPECT_EQ(count(sharp, Vertex_class::corner), 18u);
  EXPECT_EQ(sharp.curves.size(), 9u + 18u);
  p.ridge_angle = 91;
  EXPECT_TRUE(reference(prism, p).features.curves.empty());
}

/// Marks the edges of a chain of vertices as constrained.
Feature_parameters constrained_chain(const Soup& soup, const std::vector<Index>& chain)
{
  const Mesh_view m = shapes::view(soup);
  Feature_parameters p;
  p.halfedge_constraint.assign(m.number_of_halfedges(), SMA::Edge_constraint::none);
  for (std::size_t i = 1; i < chain.size(); ++i)
    for (const Index h : {m.halfedge(chain[i - 1], chain[i]), m.halfedge(chain[i], chain[i - 1])})
      p.halfedge_constraint[h] = SMA::Edge_constraint::crease;
  return p;
}

TEST(Features, of_constrained_edges_end_in_corners)
{
  const Soup soup = shapes::torus(30, 15);
  std::vector<Index> chain;
  for (Index i = 3; i < 10; ++i) chain.push_back(i); // along a parallel
  const Surface s = reference(soup, constrained_chain(soup, chain));
  ASSERT_EQ(s.features.curves.size(), 1u);
  EXPECT_EQ(s.features.curves[0].vertices.size(), chain.size());
  EXPECT_EQ(count(s.features, Vertex_class::corner), 2u);
  EXPECT_EQ(s.features.vertex_class[3], Vertex_class::corner);
  EXPECT_EQ(s.features.vertex_class[9], Vertex_class::corner);
  EXPECT_EQ(s.features.vertex_class[6], Vertex_class::curve);
  // a single edge is kept too
  EXPECT_EQ(reference(soup, constrained_chain(soup, {3, 4})).features.curves.size(), 1u);
}

TEST(Features, of_constrained_vertices_are_corners)
{
  const Soup soup = shapes::capped_cylinder(24, 5, 1);
  Feature_parameters p;
  p.vertex_is_constrained.assign(soup.points.size(), 0);
  p.vertex_is_constrained[5] = 1;  // on the lower ridge
  p.vertex_is_constrained[60] = 1; // on the side
  const Surface s = reference(soup, p);
  EXPECT_EQ(count(s.features, Vertex_class::corner), 2u);
  EXPECT_EQ(s.features.curves.size(), 2u);
  std::size_t loops = 0;
  for (const auto& c : s.features.curves) {
    EXPECT_EQ(c.vertices.front(), c.vertices.back());
    if (!c.is_closed()) ++loops; // from the corner back to it
  }
  EXPECT_EQ(loops, 1u);
}

/// A plane with a crease of `length` edges in its middle, which is lifted by `height`.
Soup creased(Index length, double height)
{
  const Index n = 20;
  Soup s = shapes::square(n);
  for (Index i = 0; i <= length; ++i) s.points[(n / 2) * (n + 1) + 4 + i][2] = height;
  return s;
}

TEST(Features, that_are_short_and_isolated_are_noise)
{
  // a spike: ridges around it branch, thus are no chain; what counts is that long creases stay
  const Surface s = reference(creased(9, 0.06)); // turns by more than 45 degrees at its foot, too
  EXPECT_GT(s.features.curves.size(), 4u);

  // an edge that is lifted out of a sphere until it is just sharp
  Soup sphere = shapes::sphere(3);
  const Mesh_view m = shapes::view(sphere);
  const Index h = 300, v = m.source(h), w = m.target(h);
  const Feature_parameters p;
  const auto is_sharp = [&](Index g) {
    const Vector_3 a = SMA::internal::face_normal(m, sphere.points, g),
                   b = SMA::internal::face_normal(m, sphere.points, m.twin[g]);
    return a.dot(b) < std::cos(p.ridge_angle * pi / 180) * a.norm() * b.norm();
  };
  for (int i = 0; i < 200 && !is_sharp(h); ++i)
    for (const Index x : {v, w}) sphere.points[x] *= 1.001;
  ASSERT_TRUE(is_sharp(h));
  std::size_t sharp = 0;
  for (Index g = 0; g < m.number_of_halfedges(); ++g) sharp += m.is_edge_owner(g) && is_sharp(g);
  ASSERT_EQ(sharp, 1u);
  EXPECT_TRUE(reference(sphere).features.curves.empty());
  // unless the user insists
  EXPECT_EQ(reference(sphere, constrained_chain(sphere, {v, w})).features.curves.size(), 1u);
}

TEST(Features, that_branch_off_others_and_end_at_once_are_noise)
{
  const auto number_of_curves = [](Index length, bool is_branch) {
    const Soup s = creased(length, 0.028);
    const Index row = 21, start = 10 * row + 4; // of the crease: a constrained curve runs through it
    const Feature_parameters p = is_branch ? constrained_chain(s, {start - row, start, start + row}) : Feature_parameters();
    return reference(s, p).features.curves.size();
  };
  const std::size_t boundary = 4;
  EXPECT_EQ(number_of_curves(2, true), boundary + 1);
  EXPECT_EQ(number_of_curves(4, true), boundary + 3);
  EXPECT_EQ(number_of_curves(4, false), boundary);
  EXPECT_EQ(number_of_curves(5, false), boundary + 1);
}

/// Puts a vertex into face `f` that lies beyond the edge from its corner `i` on, by a part of the height of the face:
/// the face over that edge is folded over. Returns the new vertex.
Index fold(Soup& s, std::size_t f, std::size_t i, double part = 0.02)
{
  const shapes::Triangle t = s.triangles[f];
  const Index a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3], x = Index(s.points.size());
  const Vector_3 middle = 0.5 * (s.points[a] + s.points[b]);
  s.points.push_back(middle + part * (middle - s.points[c]));
  s.triangles[f] = {a, b, x};
  s.triangles.push_back({b, c, x});
  s.triangles.push_back({c, a, x});
  return x;
}

TEST(Features, of_folds_are_those_of_the_faces_around)
{
  for (const double part : {0.02, 0.3}) {
    Soup sphere = shapes::sphere(3);
    for (const std::size_t f : {0u, 500u, 900u}) fold(sphere, f, f % 3, part);
    EXPECT_TRUE(reference(sphere).features.curves.empty()) << part;
  }

  // on a ridge: it takes the way around the sliver, through the new vertex
  Soup cube = shapes::cube(5);
  const auto is_on_edge = [&](Index v, Index w) {
    const Vector_3 m = 0.5 * (cube.points[v] + cube.points[w]);
    return (m.cwiseAbs().array() > 1 - 1e-9).count() == 2;
  };
  std::size_t f = 0, i = 0;
  while (!is_on_edge(cube.triangles[f][i], cube.triangles[f][(i + 1) % 3])) {
    i = (i + 1) % 3;
    f += i == 0;
  }
  const Index x = fold(cube, f, i);
  const Features features = reference(cube).features;
  EXPECT_EQ(features.curves.size(), 12u);
  EXPECT_EQ(count(features, Vertex_class::corner), 8u);
  EXPECT_EQ(count(features, Vertex_class::curve), 12u * 4u + 1u);
  EXPECT_EQ(features.vertex_class[x], Vertex_class::curve);
}

/// Two plates of width `width` that meet at a right angle in a row of edges of length 1. The `flipped` edge of these is
/// replaced by the other diagonal of its two faces, which leaves a dent.
Soup plates(Index edges, double width, Index flipped)
{
  Soup s;
  for (Index i = 0; i <= edges; ++i) s.points.push_back({double(i), 0, 0});
  for (Index i = 0; i < edges; ++i) s.points.push_back({i + 0.5, width, 0});
  for (Index i = 0; i < edges; ++i) s.points.push_back({i + 0.5, 0, -width});
  const Index first = edges + 1;
  for (Index i = 0; i < edges; ++i) {
    const Index above = first + i, below = first + edges + i;
    if (i == flipped) {
      s.triangles.push_back({i, below, above});
      s.triangles.push_back({i + 1, above, below});
    } else {
      s.triangles.push_back({i, i + 1, above});
      s.triangles.push_back({i + 1, i, below});
    }
    if (i + 1 == edges) break;
    s.triangles.push_back({i + 1, above + 1, above});
    s.triangles.push_back({i + 1, below, below + 1});
  }
  return s;
}

TEST(Features, are_on_no_wrong_diagonals)
{
  const Index edges = 10, flipped = 4;
  for (const double width : {0.5, 2.0}) {
    const Surface straight = reference(plates(edges, width, edges));
    for (Index i = 0; i < edges; ++i) EXPECT_TRUE(straight.mesh.is_feature(straight.mesh.halfedge(i, i + 1)));
    const Surface dented = reference(plates(edges, width, flipped));
    const Index above = edges + 1 + flipped, below = above + edges;
    // the ridge turns by 90 degrees; the other diagonal by 71 where the faces are wide along it, else by 141
    EXPECT_EQ(dented.mesh.is_feature(dented.mesh.halfedge(above, below)), width < 1);
  }
}

TEST(Features, have_corners_at_the_points_of_cones)
{
  const Index around = 24;
  for (const double height : {0.4, 0.8, 1.0, 1.3, 3.0}) {
    Soup s = shapes::revolved({{1, 0}}, around);
    s.points.push_back({0, 0, height});
    for (Index i = 0; i < around; ++i) s.triangles.push_back({i, (i + 1) % around, around});
    const double angles = 2 * pi / std::hypot(1, height); // of the faces around the point, that of a cone
    EXPECT_EQ(reference(s).features.vertex_class[around] == Vertex_class::corner, angles < 240 * pi / 180) << height;
  }
  EXPECT_EQ(count(reference(shapes::icosahedron(), Feature_parameters()).features, Vertex_class::corner), 0u);
  Feature_parameters none;
  none.detect_ridges = false;
  const Soup spike = [] {
    Soup s = shapes::sphere(2);
    s.points[0] *= 3;
    return s;
  }();
  EXPECT_EQ(reference(spike).features.vertex_class[0], Vertex_class::corner);
  EXPECT_EQ(reference(spike, none).features.vertex_class[0], Vertex_class::smooth);
}

TEST(Features, of_tiny_holes_are_corners)
{
  Soup s = shapes::sphere(3);
  s.triangles.erase(s.triangles.begin() + 100); // a hole of three edges
  const Surface r = reference(s);
  EXPECT_EQ(count(r.features, Vertex_class::corner), 3u);
  EXPECT_EQ(count(r.features, Vertex_class::curve), 0u);
}

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

// Patches

Patch random_patch(Random& random)
{
  Patch p;
  p.points = {Vector_3(0, 0, 0) + 0.2 * random.vector(), Vector_3(1, 0, 0) + 0.2 * random.vector(),
              Vector_3(0, 1, 0) + 0.2 * random.vector()};
  for (std::size_t i = 0; i < 3; ++i) {
    p.normals[i] = (Vector_3::UnitZ() + 0.4 * random.vector()).normalized();
    p.is_feature[i] = random.below(3) == 0;
    for (Vector_3& t : p.tangents[i]) t = (p.points[(i + 1) % 3] - p.points[i] + 0.3 * random.vector()).normalized();
  }
  return p;
}

template <class Reconstruction>
class Reconstructions : public ::testing::Test
{};

using All_reconstructions = ::testing::Types<Flat_reconstruction, PN_triangle_reconstruction, SMA::Gregory_reconstruction,
                                             SMA::Walton_meek_reconstruction>;
TYPED_TEST_SUITE(Reconstructions, All_reconstructions, );

TYPED_TEST(Reconstructions, interpolate_their_corners)
{
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Patch p = random_patch(random);
    EXPECT_LT((TypeParam::evaluate(p, 0, 0).position - p.points[0]).norm(), 1e-14);
    EXPECT_LT((TypeParam::evaluate(p, 1, 0).position - p.points[1]).norm(), 1e-14);
    EXPECT_LT((TypeParam::evaluate(p, 0, 1).position - p.points[2]).norm(), 1e-14);
  }
}

TYPED_TEST(Reconstructions, share_the_curve_of_an_edge_with_the_other_face)
{
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Patch p = random_patch(random);
    // the face on the other side of edge 0 sees it backwards, as its edge 1
    Patch q = random_patch(random);
    q.points[1] = p.points[1];
    q.points[2] = p.points[0];
    q.normals[1] = p.normals[1];
    q.normals[2] = p.normals[0];
    q.is_feature[1] = p.is_feature[0];
    q.tangents[1] = {p.tangents[0][1] * -1.0, p.tangents[0][0] * -1.0};
    for (const double t : {0.1, 0.37, 0.5, 0.9})
      EXPECT_LT((TypeParam::evaluate(p, t, 0).position - TypeParam::evaluate(q, t, 1 - t).position).norm(), 1e-14);
  }
}

TYPED_TEST(Reconstructions, have_feature_edges_that_are_the_curve_itself)
{
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    Patch p = random_patch(random);
    p.is_feature[0] = true;
    for (const double t : {0.2, 0.5, 0.7}) {
      const Vector_3 c = TypeParam::evaluate_curve(p.points[0], p.points[1], p.tangents[0][0], p.tangents[0][1], t);
      EXPECT_LT((TypeParam::evaluate(p, t, 0).position - c).norm(), 1e-14);
    }
  }
}

TEST(PN_triangle, has_the_normal_of_its_surface)
{
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Patch p = random_patch(random);
    const double u = random.real(0.1, 0.4), v = random.real(0.1, 0.4), d = 1e-5;
    const auto at = [&](double x, double y) { return PN_triangle_reconstruction::evaluate(p, x, y).position; };
    const Vector_3 n = (at(u + d, v) - at(u - d, v)).cross(at(u, v + d) - at(u, v - d)).normalized();
    EXPECT_LT((PN_triangle_reconstruction::evaluate(p, u, v).normal - n).norm(), 1e-8);
  }
}

TEST(PN_triangle, is_flat_where_its_normals_say_so)
{
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    Patch p = random_patch(random);
    const Vector_3 n = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    p.normals = {n, n, n};
    p.is_feature = {};
    const double u = random.real(0, 0.5), v = random.real(0, 0.5);
    const Surface_point x = PN_triangle_reconstruction::evaluate(p, u, v);
    EXPECT_LT((x.position - Flat_reconstruction::evaluate(p, u, v).position).norm(), 1e-13);
    EXPECT_LT((x.normal - n).norm(), 1e-12);
  }
}

TEST(PN_triangle, stays_finite_for_degenerate_faces)
{
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    Patch p = random_patch(random);
    if (i % 3 == 0) p.points[2] = p.points[1];
    if (i % 3 == 1) p.points[2] = (p.points[0] + p.points[1]) / 2;
    if (i % 3 == 2) p.points = {p.points[0], p.points[0], p.points[0]};
    const Surface_point x = PN_triangle_reconstruction::evaluate(p, random.real(0, 0.5), random.real(0, 0.5));
    EXPECT_TRUE(x.position.allFinite() && x.normal.allFinite());
  }
}

double torus_distance(const Vector_3& p)
{
  return std::abs(std::hypot(std::hypot(p[0], p[1]) - shapes::torus_large_radius, p[2]) - shapes::torus_small_radius);
}

struct Errors
{
  double distance = 0, normal = 0; ///< largest
};

/// Errors of the patches over the faces of a torus with exact normals.
template <class Reconstruction>
Errors torus_errors(std::size_t n)
{
  const Soup s = shapes::torus(n, n / 2, 0.2);
  Errors e;
  for (const shapes::Triangle& t : s.triangles) {
    Patch p;
    for (std::size_t i = 0; i < 3; ++i) {
      p.points[i] = s.points[t[i]];
      p.normals[i] = shapes::torus_normal(p.points[i]);
    }
    for (const double u : {0.0, 0.2, 0.4, 0.6})
      for (const double v : {0.0, 0.1, 0.3}) {
        const Surface_point x = Reconstruction::evaluate(p, u, v);
        e.distance = (std::max)(e.distance, torus_distance(x.position));
        e.normal = (std::max)(e.normal, (x.normal - shapes::torus_normal(x.position)).norm());
      }
  }
  return e;
}

TEST(PN_triangle, is_of_third_order_with_exact_normals)
{
  const Errors coarse = torus_errors<PN_triangle_reconstruction>(64),
               fine = torus_errors<PN_triangle_reconstruction>(256);
  EXPECT_GT(std::log(coarse.distance / fine.distance) / std::log(4), 2.7);
  EXPECT_GT(std::log(coarse.normal / fine.normal) / std::log(4), 1.7);
}

TEST(Flat_facet, is_of_second_order)
{
  const Errors coarse = torus_errors<Flat_reconstruction>(64), fine = torus_errors<Flat_reconstruction>(256);
  const double order = std::log(coarse.distance / fine.distance) / std::log(4);
  EXPECT_GT(order, 1.8);
  EXPECT_LT(order, 2.2);
}

/// Largest distance of the reference surface to the torus that it was made from.
double reference_error(std::size_t n)
{
  const Surface r = reference(shapes::torus(n, n / 2, 0.2));
  double worst = 0;
  for (Index f = 0; f < r.mesh.number_of_faces(); ++f)
    for (const double u : {0.0, 0.2, 0.5})
      for (const double v : {0.1, 0.3, 0.5})
        worst = (std::max)(worst, torus_distance(r.evaluate({Vertex_class::smooth, f, u, v}).position));
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

} // namespace

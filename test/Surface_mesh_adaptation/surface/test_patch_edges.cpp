// SPDX-License-Identifier: GPL-3.0-or-later
//
// How Gregory patches meet their neighbours: along smooth edges with the same tangent planes, along features in the
// curve.

#include "policies.h"
#include "surface/patches.h"

#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/feature_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace test_patch_edges {

using namespace patches_of_tests;
using SMA::Gregory_reconstruction;
using SMA::PN_triangle_reconstruction;
using SMA::Walton_meek_reconstruction;

/// Another face on the other side of edge 0 of `p`, of which that is the edge `edge`.
Patch across(const Patch& p, std::size_t edge, Random& random)
{
  Patch q = random_patch(random);
  const std::size_t end = (edge + 1) % 3;
  for (const auto& [mine, other] : {std::make_pair(edge, 1u), std::make_pair(end, 0u)}) {
    q.points[mine] = p.points[other];
    q.normals[mine] = p.normals[other];
    q.shape_operators[mine] = p.shape_operators[other];
    q.has_shape_operator[mine] = p.has_shape_operator[other];
  }
  q.points[3 - edge - end] = p.points[0] + p.points[1] - p.points[2] + 0.1 * random.vector();
  q.largest_bulge_of_edge[edge] = p.largest_bulge_of_edge[0];
  q.is_feature[edge] = p.is_feature[0];
  q.tangents[edge] = {-p.tangents[0][1], -p.tangents[0][0]};
  if (p.is_feature[0]) // a normal for each side
    for (const std::size_t i : {edge, end}) q.normals[i] = (Vector_3::UnitZ() + 0.2 * random.vector()).normalized();
  return q;
}

TEST(Gregory_patch, has_the_curve_of_its_neighbour_to_the_bit)
{
  Random random(7);
  std::size_t curves[4] = {};
  for (int i = 0; i < 1000; ++i) {
    Patch p = random_patch(random);
    if (i % 5 == 0) p.normals[i % 2] = random.vector().normalized();
    if (i % 5 == 1) p.largest_bulge_of_edge[0] = 0.01;
    const std::size_t edge = random.below(3);
    const Gregory_patch_3 g(p), h(across(p, edge, random));
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(g.control_point(0, k), h.control_point(edge, 4 - k));
    EXPECT_EQ(g.curve(0), h.curve(edge));
    ++curves[std::size_t(g.curve(0))];
    for (int k = 0; k <= 64; ++k) { // binary fractions: both faces see the same coordinates
      const auto a = on_edge(0, k / 64.0), b = on_edge(edge, 1 - k / 64.0);
      EXPECT_EQ(g.point(a[0], a[1]), h.point(b[0], b[1]));
    }
  }
  for (const std::size_t n : curves) EXPECT_GT(n, 30u);
}

TEST(Gregory_patch, has_feature_edges_that_are_the_curve_itself)
{
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    Patch p = random_patch(random);
    p.is_feature[0] = true;
    const auto curve = [&](double t) {
      return Gregory_reconstruction::evaluate_curve(p.points[0], p.points[1], p.tangents[0][0], p.tangents[0][1], t);
    };
    const auto reversed = [&](double t) {
      return Gregory_reconstruction::evaluate_curve(p.points[1], p.points[0], -p.tangents[0][1], -p.tangents[0][0], t);
    };
    for (int k = 0; k <= 16; ++k) {
      const double t = k / 16.0;
      EXPECT_LT((Gregory_reconstruction::evaluate(p, t, 0).position - curve(t)).norm(), 1e-15);
      EXPECT_EQ(curve(t), reversed(1 - t));
    }
    EXPECT_LT((curve(1e-6) - p.points[0]).normalized().cross(p.tangents[0][0]).norm(), 1e-5);
  }
}

/// Angles between the normals of two patches along the edges that are no features.
struct Defect
{
  double largest = 0;
  std::size_t edges = 0, skipped = 0; ///< without those next to a face that fell back
};

template <class Reconstruction>
Defect defect(const Patches& patches)
{
  Defect d;
  const Mesh_view& m = patches.mesh;
  for (Index h = 0; h < m.number_of_halfedges(); ++h) {
    if (!m.is_edge_owner(h) || m.is_border(h) || m.is_feature(h)) continue;
    const Index t = m.twin[h];
    const Patch &p = patches.of_face[h / 3], &q = patches.of_face[t / 3];
    if (!is_gregory(p) || !is_gregory(q)) {
      ++d.skipped;
      continue;
    }
    ++d.edges;
    for (int k = 0; k <= 12; ++k) {
      const auto a = on_edge(h % 3, k / 12.0), b = on_edge(t % 3, 1 - k / 12.0);
      const Surface_point x = Reconstruction::evaluate(p, a[0], a[1]), y = Reconstruction::evaluate(q, b[0], b[1]);
      d.largest = (std::max)(d.largest, (x.normal - y.normal).norm());
    }
  }
  return d;
}

TEST(Gregory_patch, has_the_tangent_planes_of_its_neighbour_for_any_normals)
{
  for (const double degrees : {0.0, 10.0, 25.0}) {
    const Patches patches = tilted_torus(degrees * shapes::pi / 180);
    const Defect gregory = defect<Gregory_reconstruction>(patches),
                 classical = defect<Walton_meek_reconstruction>(patches);
    EXPECT_GT(gregory.edges, 500u);
    EXPECT_LT(double(gregory.skipped), 0.3 * double(gregory.edges));
    EXPECT_LT(gregory.largest, 1e-11);
    EXPECT_LT(classical.largest, 1e-11);
    EXPECT_GT(defect<PN_triangle_reconstruction>(patches).largest, 1e-3) << "this is no property of any patch";
  }
}

/// The patches of a mesh with its features, with estimated normals.
template <class Reference>
Patches patches(Reference& surface, bool orthogonalize)
{
  if (orthogonalize) SMA::orthogonalize_normals(sequential, surface.mesh, surface.features, surface.normals);
  Patches result{surface.mesh, {}};
  for (Index f = 0; f < surface.mesh.number_of_faces(); ++f) result.of_face.push_back(surface.patch(f));
  return result;
}

using Surface = SMA::Reference_surface<Gregory_reconstruction>;

SMA::Feature_parameters dangling_ridge(const Mesh_view& mesh)
{
  SMA::Feature_parameters p;
  p.halfedge_constraint.assign(mesh.number_of_halfedges(), SMA::Edge_constraint::none);
  Index v = 30;
  for (int i = 0; i < 7; ++i) { // a walk straight through the fans
    Index h = mesh.outgoing[v];
    for (int k = 0; k < 3 * i % 4; ++k) h = mesh.rotated_ccw(h);
    p.halfedge_constraint[h] = p.halfedge_constraint[mesh.twin[h]] = SMA::Edge_constraint::crease;
    v = mesh.target(h);
  }
  return p;
}

TEST(Gregory_patch, has_common_tangent_planes_up_to_ridges_corners_and_boundaries)
{
  const Soup torus = analytic::mesh(analytic::Torus(), 2);
  Soup cylinder = shapes::capped_cylinder(24, 6, 2);
  for (Vector_3& p : cylinder.points) p = Vector_3(1.4 * p[0], p[1], p[2] + 0.3 * p[0] + 0.1 * p[1] * p[1]);
  for (const Soup& soup : {cylinder, analytic::mesh(analytic::Graph(), 2), torus}) {
    Mesh_view mesh = shapes::view(soup);
    SMA::Feature_parameters parameters;
    if (soup.points.size() == torus.points.size()) parameters = dangling_ridge(mesh);
    Surface surface(sequential, mesh, soup.points, parameters);
    ASSERT_FALSE(surface.features.curves.empty());
    const Defect after = defect<Gregory_reconstruction>(patches(surface, true));
    EXPECT_LT(after.largest, 1e-11);
    EXPECT_LT(double(after.skipped), 0.2 * double(after.edges));
  }
}

TEST(Orthogonalized_normal, is_the_next_one_that_is_orthogonal_to_both_tangents)
{
  Random random(10);
  for (int i = 0; i < 300; ++i) {
    const Vector_3 n = random.vector().normalized(), s = n.cross(random.vector()).normalized(),
                   t = Eigen::AngleAxisd(random.real(0.3, 2.8), n) * s;
    const Vector_3 near = (n + 0.2 * random.vector()).normalized();
    EXPECT_LT((SMA::orthogonalized_normal(near, s, t) - n).norm(), 1e-12);
    const Vector_3 one = SMA::orthogonalized_normal(near, s, -s);
    EXPECT_LT((one - (near - near.dot(s) * s).normalized()).norm(), 1e-14);
    EXPECT_TRUE(SMA::orthogonalized_normal(s, s, t).allFinite());
  }
}

TEST(Orthogonalized_normals, are_the_same_for_every_policy)
{
  const Soup soup = analytic::mesh(analytic::Graph(), 3);
  const Surface surface(sequential, shapes::view(soup), soup.points, {});
  const SMA::Corner_normals before = SMA::estimate_normals(sequential, surface.mesh, soup.points);
  SMA::Corner_normals expected = before;
  SMA::orthogonalize_normals(sequential, surface.mesh, surface.features, expected);
  for_each_policy([&](const auto& execution, const std::string& name) {
    SMA::Corner_normals normals = before;
    SMA::orthogonalize_normals(execution, surface.mesh, surface.features, normals);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < normals.normals.size(); ++i) {
      ASSERT_EQ(normals.normals[i], expected.normals[i]) << name;
      changed += normals.normals[i] != before.normals[i];
    }
    EXPECT_GT(changed, 100u);
  });
}

TEST(Feature_curve, is_the_edge_of_both_patches_next_to_it)
{
  const Soup soup = shapes::capped_cylinder(20, 3, 1);
  Mesh_view mesh = shapes::view(soup);
  SMA::Feature_parameters parameters;
  parameters.vertex_is_constrained.assign(soup.points.size(), 0);
  parameters.vertex_is_constrained[3] = 1; // a curve from a corner back to it
  const Surface surface(sequential, mesh, soup.points, parameters);
  std::size_t edges = 0;
  for (const SMA::Feature_curve& c : surface.features.curves)
    for (std::size_t i = 0; i + 1 < c.vertices.size(); ++i) {
      const Index h = surface.mesh.halfedge(c.vertices[i], c.vertices[i + 1]), t = surface.mesh.twin[h];
      const Vector_3 middle = Gregory_reconstruction::evaluate_curve(
        surface.points[c.vertices[i]], surface.points[c.vertices[i + 1]], c.tangents[i], c.tangents[i + 1], 0.5);
      const Gregory_patch_3 left(surface.patch(h / 3)), right(surface.patch(t / 3));
      EXPECT_EQ(left.curve(h % 3), Curve::feature);
      for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(left.control_point(h % 3, k), right.control_point(t % 3, 4 - k));
      const auto a = on_edge(h % 3, 0.5);
      EXPECT_LT((left.point(a[0], a[1]) - middle).norm(), 1e-15);
      ++edges;
    }
  EXPECT_EQ(edges, 40u);
}

} // namespace test_patch_edges

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The quartic Gregory patch: what it interpolates, how it meets its neighbours, how fast it converges, and what it
// does where there is nothing to interpolate.

#include "analytic_surfaces.h"
#include "policies.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/surface/Gregory_patch_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>
#include <CGAL/Surface_mesh_adaptation/surface/feature_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface/patch_fallbacks.h>
#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::no_index;
using shapes::Random;
using shapes::Soup;
using shapes::Triangle;
using shapes::Vector_3;
using SMA::Flat_reconstruction;
using SMA::Gregory_patch_3;
using SMA::Gregory_reconstruction;
using SMA::Mesh_view;
using SMA::Metric_tensor_3;
using SMA::Patch;
using SMA::PN_triangle_reconstruction;
using SMA::Surface_point;
using SMA::Walton_meek_reconstruction;
using Construction = Gregory_patch_3::Construction;
using Curve = Gregory_patch_3::Curve;
using Interior = Gregory_patch_3::Interior;

const SMA::Sequential_execution sequential;

/// A symmetric tensor with `n` in its kernel and otherwise at random.
Metric_tensor_3 random_shape_operator(const Vector_3& n, Random& random)
{
  const SMA::Matrix_3 tangential = SMA::Matrix_3::Identity() - n * n.transpose();
  SMA::Matrix_3 s;
  for (int i = 0; i < 3; ++i) s.col(i) = random.vector();
  return Metric_tensor_3(SMA::Matrix_3(tangential * (s + s.transpose()) * tangential));
}

/// A face near the plane z = 0 with normals up to 20 degrees off the vertical.
Patch random_patch(Random& random)
{
  Patch p;
  p.points = {Vector_3(0, 0, 0) + 0.1 * random.vector(), Vector_3(1, 0, 0) + 0.1 * random.vector(),
              Vector_3(0.3, 0.8, 0) + 0.1 * random.vector()};
  for (std::size_t i = 0; i < 3; ++i) {
    p.normals[i] = (Vector_3::UnitZ() + 0.2 * random.vector()).normalized();
    p.shape_operators[i] = 0.5 * random_shape_operator(p.normals[i], random);
    p.has_shape_operator[i] = random.below(4) > 0;
    p.is_feature[i] = random.below(3) == 0;
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (Vector_3& t : p.tangents[i]) t = (p.points[(i + 1) % 3] - p.points[i] + 0.1 * random.vector()).normalized();
  return p;
}

TEST(Gregory_patch, interpolates_corners_and_their_normals)
{
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    for (const Construction c : {Construction::mid_edge, Construction::walton_meek}) {
      const Gregory_patch_3 g(p, c);
      ASSERT_EQ(g.interior(), Interior::gregory);
      const double corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
      for (std::size_t k = 0; k < 3; ++k) {
        const Surface_point x = g.evaluate(corner[k][0], corner[k][1]);
        EXPECT_EQ(x.position, p.points[k]);
        EXPECT_LT((x.normal - p.normals[k]).norm(), 1e-13);
      }
    }
  }
}

TEST(Gregory_patch, interpolates_normals_between_one_two_and_three_feature_edges)
{
  Random random(16);
  for (int i = 0; i < 600; ++i) {
    Patch p = random_patch(random);
    for (std::size_t k = 0; k < 3; ++k) p.is_feature[k] = int(k) <= i % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t before = (k + 2) % 3;
      const Vector_3 &out = p.tangents[k][0], &in = p.tangents[before][1];
      if (!p.is_feature[k] && !p.is_feature[before]) continue;
      p.normals[k] = Vector_3::UnitZ();
      p.normals[k] =
        SMA::orthogonalized_normal(p.normals[k], p.is_feature[k] ? out : in, p.is_feature[before] ? in : out);
    }
    const Gregory_patch_3 g(p);
    ASSERT_EQ(g.interior(), Interior::gregory);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(g.curve(k), p.is_feature[k] ? Curve::feature : Curve::smooth);
      EXPECT_LT((g.normal(k == 1, k == 2) - p.normals[k]).norm(), 1e-13);
    }
  }
}

TEST(Gregory_patch, has_the_derivatives_of_its_points)
{
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Gregory_patch_3 g(random_patch(random));
    const double u = random.real(0.05, 0.45), v = random.real(0.05, 0.45), d = 1e-4;
    const auto x = g.derivatives(u, v);
    // differences of fourth order
    const auto difference = [&](double du, double dv) -> Vector_3 {
      return (8 * (g.point(u + du, v + dv) - g.point(u - du, v - dv)) -
              (g.point(u + 2 * du, v + 2 * dv) - g.point(u - 2 * du, v - 2 * dv))) /
             (12 * d);
    };
    EXPECT_LT((x.du - difference(d, 0)).norm(), 1e-9);
    EXPECT_LT((x.dv - difference(0, d)).norm(), 1e-9);
    EXPECT_EQ(x.point, g.point(u, v));
    EXPECT_LT((x.du.cross(x.dv).normalized() - g.normal(u, v)).norm(), 1e-13);
  }
}

TEST(Gregory_patch, does_not_depend_on_the_numbering_of_its_corners)
{
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Patch p = random_patch(random);
    const double u = random.real(0, 0.5), v = random.real(0, 0.5), b[3] = {1 - u - v, u, v};
    const Surface_point x = Gregory_reconstruction::evaluate(p, u, v);
    for (const std::size_t shift : {1u, 2u}) {
      const Surface_point y =
        Gregory_reconstruction::evaluate(SMA::renumbered(p, shift), b[(1 + shift) % 3], b[(2 + shift) % 3]);
      EXPECT_LT((x.position - y.position).norm(), 1e-15);
      EXPECT_LT((x.normal - y.normal).norm(), 1e-13);
    }
  }
}

TEST(Gregory_patch, turns_and_grows_with_its_corners)
{
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Patch p = random_patch(random);
    const Eigen::Quaterniond q(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    const SMA::Matrix_3 r = q.normalized().toRotationMatrix();
    const double scale = std::exp(random.real(-9, 9));
    Patch moved = p;
    for (std::size_t k = 0; k < 3; ++k) {
      moved.points[k] = scale * (r * p.points[k]);
      moved.normals[k] = r * p.normals[k];
      for (std::size_t e = 0; e < 2; ++e) moved.tangents[k][e] = r * p.tangents[k][e];
      moved.shape_operators[k] = 1 / scale * SMA::rotated(p.shape_operators[k], r);
    }
    const double u = random.real(0, 0.5), v = random.real(0, 0.5);
    const Surface_point x = Gregory_reconstruction::evaluate(p, u, v),
                        y = Gregory_reconstruction::evaluate(moved, u, v);
    EXPECT_LT((y.position - scale * (r * x.position)).norm(), 1e-14 * scale);
    EXPECT_LT((y.normal - r * x.normal).norm(), 1e-12);
  }
}

TEST(Gregory_patch, is_flat_where_its_normals_say_so)
{
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Patch p = random_patch(random);
    const Vector_3 n = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    p.normals = {n, n, n};
    p.shape_operators = Patch().shape_operators;
    p.is_feature = {};
    const double u = random.real(0, 0.5), v = random.real(0, 0.5);
    const Surface_point x = Gregory_reconstruction::evaluate(p, u, v);
    EXPECT_LT((x.position - Flat_reconstruction::evaluate(p, u, v).position).norm(), 1e-15);
    EXPECT_LT((x.normal - n).norm(), 1e-14);
  }
}

TEST(Gregory_patch, without_shape_operators_has_the_mean_conormal_at_the_middle_of_an_edge)
{
  Random random(6);
  std::size_t smooth = 0;
  for (int i = 0; i < 200; ++i) {
    Patch p = random_patch(random);
    p.has_shape_operator = {};
    p.is_feature = {};
    const Gregory_patch_3 g(p);
    const bool is_smooth = g.curve(0) == Curve::smooth && g.curve(1) == Curve::smooth && g.curve(2) == Curve::smooth;
    if (!is_smooth || g.interior() != Interior::gregory) continue;
    ++smooth;
    const auto conormal = [&](std::size_t corner, std::size_t i0, std::size_t i1) -> Vector_3 {
      return p.normals[corner].cross(g.control_point(0, i1) - g.control_point(0, i0)).normalized();
    };
    EXPECT_NEAR(g.normal(0.5, 0).dot(conormal(0, 0, 1) + conormal(1, 3, 4)), 0, 1e-12);
  }
  EXPECT_GT(smooth, 50u);
}

/// How far the middle of a smooth edge over an arc of `angle` of the unit circle lies inside it.
template <class Reconstruction>
double depth_of_middle(double angle)
{
  Patch p;
  for (std::size_t i = 0; i < 2; ++i) {
    const double a = (double(i) - 0.5) * angle;
    p.points[i] = p.normals[i] = Vector_3(std::sin(a), 0, std::cos(a));
  }
  p.points[2] = p.points[0] + Vector_3(0, angle, 0);
  p.normals[2] = p.normals[0];
  return 1 - Reconstruction::evaluate(p, 0.5, 0).position.norm();
}

TEST(Gregory_patch, has_circles_over_its_edges)
{
  for (const double angle : {0.2, 0.4, 0.8}) {
    EXPECT_NEAR(depth_of_middle<Walton_meek_reconstruction>(angle), std::pow(angle, 4) / 384, 0.001 * std::pow(angle, 4));
    EXPECT_LT(std::abs(depth_of_middle<Gregory_reconstruction>(angle)), 1.2e-3 * std::pow(angle, 6));
  }
}

// Edges

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
  q.is_feature[edge] = p.is_feature[0];
  q.tangents[edge] = {-p.tangents[0][1], -p.tangents[0][0]};
  if (p.is_feature[0]) // a normal for each side
    for (const std::size_t i : {edge, end}) q.normals[i] = (Vector_3::UnitZ() + 0.2 * random.vector()).normalized();
  return q;
}

/// Barycentric coordinates, for corners 1 and 2, of the point that lies by `t` between the ends of an edge.
std::array<double, 2> on_edge(std::size_t edge, double t)
{
  if (edge == 0) return {t, 0};
  if (edge == 1) return {1 - t, t};
  return {0, 1 - t};
}

TEST(Gregory_patch, has_the_curve_of_its_neighbour_to_the_bit)
{
  Random random(7);
  std::size_t curves[3] = {};
  for (int i = 0; i < 1000; ++i) {
    Patch p = random_patch(random);
    if (i % 5 == 0) p.normals[i % 2] = random.vector().normalized();
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

/// A closed mesh with a patch on each face.
struct Patches
{
  Mesh_view mesh;
  std::vector<Patch> of_face;
};

/// The torus with normals tilted at random by up to `tilt` radians, each vertex with a shape operator out of the blue
/// or none.
Patches tilted_torus(double tilt)
{
  const analytic::Torus torus;
  const Soup soup = analytic::mesh(torus, 2);
  Random random(9);
  std::vector<Vector_3> normals;
  std::vector<Metric_tensor_3> operators;
  for (const Vector_3& p : soup.points) {
    const Vector_3 n = torus.normal(p), axis = n.cross(random.vector()).normalized();
    normals.push_back(Eigen::AngleAxisd(random.real(0, tilt), axis) * n);
    operators.push_back(random_shape_operator(normals.back(), random));
  }
  Patches result{shapes::view(soup), {}};
  for (const Triangle& t : soup.triangles) {
    Patch p;
    for (std::size_t i = 0; i < 3; ++i) {
      p.points[i] = soup.points[t[i]];
      p.normals[i] = normals[t[i]];
      p.shape_operators[i] = operators[t[i]];
      p.has_shape_operator[i] = t[i] % 5 > 0;
      p.tangents[i].fill(Vector_3::Zero());
    }
    result.of_face.push_back(p);
  }
  return result;
}

bool is_gregory(const Patch& p) { return Gregory_patch_3(p).interior() == Interior::gregory; }

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

// Convergence

template <class Surface>
class Convergence : public ::testing::Test
{};

using Surfaces = ::testing::Types<analytic::Ellipsoid, analytic::Torus, analytic::Graph, analytic::Sphere>;
TYPED_TEST_SUITE(Convergence, Surfaces, );

/// Slopes between two levels that are two apart, and the errors at the finer one.
struct Orders
{
  double distance, rms_distance, normal, rms_normal;
  analytic::Patch_errors fine;
};

template <class Reconstruction, class Surface>
Orders orders(const Surface& surface)
{
  const auto a = analytic::patch_errors<Reconstruction>(surface, 2),
             b = analytic::patch_errors<Reconstruction>(surface, 4);
  const double steps = std::log(a.h / b.h);
  return {std::log(a.distance / b.distance) / steps, std::log(a.rms_distance / b.rms_distance) / steps,
          std::log(a.normal / b.normal) / steps, std::log(a.rms_normal / b.rms_normal) / steps, b};
}

TYPED_TEST(Convergence, of_gregory_patches_is_of_fourth_order)
{
  const TypeParam surface;
  const Orders o = orders<Gregory_reconstruction>(surface);
  EXPECT_GT(o.distance, 3.4);
  EXPECT_GT(o.rms_distance, 3.8);
  EXPECT_GT(o.normal, 2.5);
  EXPECT_GT(o.rms_normal, 2.9);
  EXPECT_LT(o.fine.distance, 0.03 * std::pow(surface.scale() * o.fine.h, 3) * o.fine.h);
}

TEST(Gregory_patch, is_of_sixth_order_on_spheres)
{
  const Orders o = orders<Gregory_reconstruction>(analytic::Sphere());
  EXPECT_GT(o.distance, 5.4);
  EXPECT_GT(o.rms_distance, 5.9);
  EXPECT_GT(o.normal, 4.5);
  EXPECT_GT(o.rms_normal, 4.9);
}

/// Largest distance of patches of the size `h` to a cylinder of radius 1, with corners at random.
double cylinder_error(double h)
{
  Random random(16);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    Patch p;
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = 2 * shapes::pi * double(k) / 3 + random.real(-0.4, 0.4), a = h * std::cos(u), z = h * std::sin(u);
      p.normals[k] = Vector_3(std::cos(a), std::sin(a), 0);
      p.points[k] = p.normals[k] + z * Vector_3::UnitZ();
      const Vector_3 around = Vector_3::UnitZ().cross(p.normals[k]);
      p.shape_operators[k] = Metric_tensor_3(SMA::Matrix_3(around * around.transpose()));
      p.has_shape_operator[k] = true;
    }
    const Gregory_patch_3 g(p);
    for (int u = 0; u <= 6; ++u)
      for (int v = 0; u + v <= 6; ++v) {
        const Vector_3 x = g.point(u / 6.0, v / 6.0);
        worst = (std::max)(worst, std::abs(std::hypot(x[0], x[1]) - 1));
      }
  }
  return worst;
}

TEST(Gregory_patch, is_of_sixth_order_on_cylinders)
{
  EXPECT_GT(std::log2(cylinder_error(0.2) / cylinder_error(0.05)) / 2, 5.8);
}

TYPED_TEST(Convergence, of_walton_and_meek_is_of_third_order)
{
  const TypeParam surface;
  const Orders o = orders<Walton_meek_reconstruction>(surface);
  EXPECT_GT(o.distance, 2.7);
  EXPECT_GT(o.rms_distance, 2.9);
  EXPECT_GT(o.normal, 1.7);
  EXPECT_GT(o.rms_normal, 1.9);
  EXPECT_LT(o.fine.distance, 0.015 * std::pow(surface.scale() * o.fine.h, 2) * o.fine.h);
  // shape operators are worth an order: spheres are the exception
  if (!std::is_same_v<TypeParam, analytic::Sphere>) {
    EXPECT_LT(o.rms_normal, 2.3);
  }
}

TYPED_TEST(Convergence, of_flat_facets_is_of_second_order)
{
  const Orders o = orders<Flat_reconstruction>(TypeParam());
  EXPECT_GT(o.distance, 1.8);
  EXPECT_GT(o.rms_distance, 1.9);
  EXPECT_LT(o.rms_distance, 2.1);
}

TYPED_TEST(Convergence, of_point_normal_triangles_is_of_third_order)
{
  const Orders o = orders<PN_triangle_reconstruction>(TypeParam());
  EXPECT_GT(o.distance, 2.7);
  EXPECT_GT(o.normal, 1.5);
}

/// Largest distance to a space curve of the edges over `n` uneven pieces of it, with tangents turned by `tangent_error`
/// times the squared length of a piece.
double curve_error(std::size_t n, double tangent_error)
{
  const auto point = [](double t) { return Vector_3(std::cos(t), std::sin(2 * t), 0.5 * t * t); };
  const auto derivative = [](double t) { return Vector_3(-std::sin(t), 2 * std::cos(2 * t), t); };
  Random random(11);
  std::vector<double> at{0};
  for (std::size_t i = 1; i < n; ++i) at.push_back(2 * (double(i) + random.real(-0.25, 0.25)) / double(n));
  at.push_back(2);
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double h = at[i + 1] - at[i];
    const auto tangent = [&](double t) -> Vector_3 {
      return (derivative(t).normalized() + tangent_error * h * h * Vector_3(0.5, -0.3, 0.8)).normalized();
    };
    for (const double s : {0.2, 0.4, 0.5, 0.7, 0.9}) {
      const Vector_3 x =
        Gregory_reconstruction::evaluate_curve(point(at[i]), point(at[i + 1]), tangent(at[i]), tangent(at[i + 1]), s);
      double t = at[i] + s * h; // the closest point, by Newton's method
      for (int k = 0; k < 6; ++k) {
        const Vector_3 d = derivative(t), second(-std::cos(t), -4 * std::sin(2 * t), 1), r = point(t) - x;
        t -= r.dot(d) / (d.squaredNorm() + r.dot(second));
      }
      worst = (std::max)(worst, (point(t) - x).norm());
    }
  }
  return worst;
}

TEST(Feature_curve, is_of_fourth_order_with_exact_tangents_and_of_third_with_three_point_ones)
{
  EXPECT_GT(std::log2(curve_error(40, 0) / curve_error(160, 0)) / 2, 3.6);
  EXPECT_GT(std::log2(curve_error(40, 1) / curve_error(160, 1)) / 2, 2.7);
}

/// Largest distance, along z, of the curves of the reference surface to the boundary of the graph that it is made from.
double boundary_error(int level)
{
  const analytic::Graph graph;
  const Soup soup = analytic::mesh(graph, level);
  const Surface surface(sequential, shapes::view(soup), soup.points, {});
  EXPECT_EQ(surface.features.curves.size(), 4u);
  double worst = 0;
  for (Index id = 0; id < surface.features.curves.size(); ++id)
    for (int i = 1; i < 2000; ++i) {
      const double s = surface.features.curves[id].length() * i / 2000;
      const Vector_3 p = surface.evaluate(surface.on_curve(id, s)).position;
      worst = (std::max)(worst, std::abs(p[2] - graph.jet(p[0], p[1]).f));
    }
  return worst;
}

TEST(Feature_curve, is_of_third_order_up_to_the_corners)
{
  EXPECT_GT(std::log2(boundary_error(2) / boundary_error(4)) / 2, 2.7);
}

/// Largest errors of the faces at the boundary of the graph, of which the edges follow the exact tangents of its sides.
analytic::Patch_errors errors_at_the_boundary(int level)
{
  const analytic::Graph graph;
  const Soup soup = analytic::mesh(graph, level);
  const auto side_tangent = [&](const Vector_3& p, int axis) {
    const auto j = graph.jet(p[0], p[1]);
    return (axis == 0 ? Vector_3(0, 1, j.y) : Vector_3(1, 0, j.x)).normalized();
  };
  return analytic::patch_errors<Gregory_reconstruction>(graph, soup, [&](Patch& p) {
    for (std::size_t i = 0; i < 3; ++i)
      for (const int axis : {0, 1}) {
        const Vector_3 &a = p.points[i], &b = p.points[(i + 1) % 3];
        if (a[axis] != b[axis] || std::abs(a[axis]) != 1) continue;
        p.is_feature[i] = true;
        p.tangents[i] = {side_tangent(a, axis), side_tangent(b, axis)};
      }
    return p.is_feature[0] || p.is_feature[1] || p.is_feature[2];
  });
}

TEST(Gregory_patch, keeps_its_order_next_to_features)
{
  const auto coarse = errors_at_the_boundary(2), fine = errors_at_the_boundary(4);
  EXPECT_GT(std::log(coarse.distance / fine.distance) / std::log(coarse.h / fine.h), 3.4);
  EXPECT_GT(std::log(coarse.normal / fine.normal) / std::log(coarse.h / fine.h), 2.5);
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

// Fallbacks

bool is_finite(const Patch& p)
{
  for (const Construction c : {Construction::mid_edge, Construction::walton_meek})
    for (const double u : {0.0, 0.3, 0.5, 1.0})
      for (const double v : {0.0, 0.2, 0.5, 1.0}) {
        if (u + v > 1) continue;
        const Surface_point x = Gregory_patch_3(p, c).evaluate(u, v);
        const double size = 1 + p.points[0].norm() + p.points[1].norm() + p.points[2].norm();
        if (!x.position.allFinite() || !x.normal.allFinite() || !(x.position.norm() < 10 * size)) return false;
      }
  return true;
}

TEST(Gregory_patch, keeps_an_edge_straight_where_the_normals_say_nothing)
{
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    const Vector_3 e = p.points[1] - p.points[0];
    switch (i % 4) {
    case 0:
      p.normals[0] = e.normalized();
      break; // along the edge
    case 1:
      p.normals[1] = -p.normals[0];
      break; // opposite
    case 2:
      p.points[1] = p.points[0];
      break; // no edge
    default:
      p.normals[1] = (Vector_3::UnitZ() + 1.5 * e).normalized();
      break; // 50 degrees off
    }
    const Gregory_patch_3 g(p);
    EXPECT_EQ(g.curve(0), Curve::straight);
    EXPECT_EQ(g.interior(), Interior::cubic);
    const Vector_3 quarter = p.points[0] + 0.25 * (p.points[1] - p.points[0]);
    EXPECT_LT((g.point(0.25, 0) - quarter).norm(), 1e-15);
    EXPECT_TRUE(is_finite(p));
  }
}

TEST(Patch_fallbacks, are_counted)
{
  Patches patches = tilted_torus(0.1);
  const auto count = [&] {
    return SMA::count_patch_fallbacks(sequential, patches.of_face.size(),
                                      [&](std::size_t f) -> const Patch& { return patches.of_face[f]; });
  };
  const SMA::Patch_fallbacks before = count();
  EXPECT_EQ(before.straight_sides, 0u);
  for (const Index h : {0u, 300u, 900u}) { // a normal along an edge
    ASSERT_TRUE(is_gregory(patches.of_face[h / 3]));
    Patch& p = patches.of_face[h / 3];
    p.normals[0] = (p.points[1] - p.points[0]).cross(p.normals[0]).cross(p.normals[0]).normalized();
  }
  const SMA::Patch_fallbacks after = count();
  EXPECT_EQ(after.cubic_interiors, before.cubic_interiors + 3);
  EXPECT_GE(after.straight_sides, 3u);
  EXPECT_LE(after.straight_sides, 6u);
}

TEST(Gregory_patch, is_cubic_inside_where_a_normal_is_far_off_the_facet)
{
  Random random(13);
  for (int i = 0; i < 300; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    const Vector_3 facet = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    const Vector_3 axis = facet.cross(random.vector()).normalized();
    const double angle = random.real(0, 0.6); // the edges stay smooth up to 35 degrees
    p.normals = {facet, facet, Eigen::AngleAxisd(angle, axis) * facet};
    const Gregory_patch_3 g(p);
    EXPECT_EQ(g.interior() == Interior::cubic, angle > shapes::pi / 6);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(g.curve(k), Curve::smooth);
    EXPECT_GT(g.normal(1.0 / 3, 1.0 / 3).dot(facet), 0.7);
  }
}

TEST(Gregory_patch, stays_finite_for_slivers_and_wrong_data)
{
  Random random(14);
  const double tiny = std::numeric_limits<double>::min();
  for (int i = 0; i < 2000; ++i) {
    Patch p = random_patch(random);
    switch (i % 8) {
    case 0:
      p.points[2] = p.points[1];
      break;
    case 1:
      p.points[2] = (p.points[0] + p.points[1]) / 2;
      break;
    case 2:
      p.points = {p.points[0], p.points[0], p.points[0]};
      break;
    case 3:
      p.points[2] = p.points[0] + 0.4 * (p.points[1] - p.points[0]) + std::exp(random.real(-40, 0)) * random.vector();
      break;
    case 4:
      for (Vector_3& n : p.normals) n = random.vector().normalized();
      break;
    case 5:
      for (Vector_3& n : p.normals) n.setZero();
      break;
    case 6:
      for (auto& t : p.tangents) t = {random.vector().normalized(), Vector_3::Zero()};
      break;
    default:
      for (Metric_tensor_3& s : p.shape_operators) s = std::exp(random.real(0, 100)) * s;
      break;
    }
    EXPECT_TRUE(is_finite(p)) << "case " << i % 8;
    const Gregory_patch_3 g(p);
    for (const double u : {tiny, 1e-310, 1 - 1e-16}) EXPECT_TRUE(g.evaluate(u, 0).normal.allFinite());
  }
}

TEST(Gregory_patch, does_not_fold_over_for_normals_up_to_25_degrees_off)
{
  Random random(15);
  std::size_t folds = 0;
  for (int i = 0; i < 2000; ++i) {
    Patch p = random_patch(random);
    p.is_feature = {};
    p.has_shape_operator = {};
    if (checks::quality(p.points[0], p.points[1], p.points[2]) < 0.3) continue;
    const Vector_3 facet = (p.points[1] - p.points[0]).cross(p.points[2] - p.points[0]).normalized();
    for (Vector_3& n : p.normals)
      n = Eigen::AngleAxisd(random.real(0, 25 * shapes::pi / 180), facet.cross(random.vector()).normalized()) * facet;
    for (int u = 0; u <= 8; ++u)
      for (int v = 0; u + v <= 8; ++v) folds += Gregory_patch_3(p).normal(u / 8.0, v / 8.0).dot(facet) <= 0;
  }
  EXPECT_EQ(folds, 0u);
}

} // namespace

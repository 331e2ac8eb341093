// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exponential map and its inverse, and parallel transport, against geodesics in closed form and by fine
// integration.

#include "analytic_surfaces.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/surface/exponential_map.h>

#include <gtest/gtest.h>

namespace test_exponential_map {

namespace SMA = CGAL::Surface_mesh_adaptation;
using analytic::Geodesic_point;
using shapes::Index;
using shapes::no_index;
using shapes::pi;
using shapes::Random;
using shapes::Soup;
using shapes::Vector_3;
using SMA::Exponential_map_method;
using SMA::Exponential_map_result;
using SMA::Matrix_3;
using SMA::Mesh_view;
using SMA::Metric_tensor_3;
using SMA::One_ring;
using SMA::Patch;

/// A triangulation of an analytic surface with the rings of its vertices.
template <class Surface>
struct Rings
{
  Surface surface;
  Soup soup;
  Mesh_view mesh;
  double h;

  explicit Rings(int level) : soup(analytic::mesh(surface, level)), mesh(shapes::view(soup)), h(soup.mean_edge_length())
  {}

  One_ring ring(Index v) const
  {
    return SMA::one_ring(mesh, mesh.outgoing[v],
                         [&](Index f) { return analytic::patch(surface, soup, soup.triangles[f]); });
  }

  Index random_inner_vertex(Random& random) const
  {
    for (;;) {
      const Index v = Index(random.below(mesh.number_of_vertices()));
      if (!mesh.is_border_vertex(v)) return v;
    }
  }
};

/// A tangent vector that points to `a`, `b` in a cell of the ring.
Vector_3 tangent_vector(const One_ring& ring, std::size_t cell, double a, double b)
{
  return SMA::internal::tangent_vector(ring, {cell, a, b, false});
}

/// A random tangent vector that reaches over the fraction `r` of the ring.
Vector_3 random_tangent_vector(const One_ring& ring, double r, Random& random)
{
  const double a = random.real();
  return tangent_vector(ring, random.below(ring.cells.size()), r * a, r * (1 - a));
}

/// The point of the patch at the face and the barycentric coordinates of `x`.
template <class Surface>
Vector_3 point_at(const Rings<Surface>& rings, const Exponential_map_result& x)
{
  return SMA::Gregory_reconstruction::evaluate(analytic::patch(rings.surface, rings.soup, rings.soup.triangles[x.face]),
                                               x.u, x.v)
    .position;
}

// One-rings

TEST(One_ring, holds_the_faces_around_a_vertex_in_order)
{
  const Rings<analytic::Torus> rings(1);
  for (Index v = 0; v < rings.mesh.number_of_vertices(); ++v) {
    const One_ring ring = rings.ring(v);
    ASSERT_EQ(ring.cells.size(), rings.mesh.degree(v));
    EXPECT_TRUE(ring.is_closed);
    for (std::size_t i = 0; i < ring.cells.size(); ++i) {
      const One_ring::Cell &cell = ring.cells[i], &next = ring.cells[(i + 1) % ring.cells.size()];
      EXPECT_EQ(rings.mesh.corner[3 * cell.face + cell.corner], v);
      EXPECT_EQ(cell.patch.points[0], rings.soup.points[v]);
      EXPECT_EQ(cell.patch.points[2], next.patch.points[1]);
      EXPECT_EQ(cell.patch.normals[2], next.patch.normals[1]);
      EXPECT_EQ(cell.patch.shape_operators[2], next.patch.shape_operators[1]);
    }
  }
}

TEST(One_ring, ends_at_features_and_boundaries)
{
  Rings<analytic::Graph> rings(1);
  for (Index v = 0; v < rings.mesh.number_of_vertices(); ++v) {
    const One_ring ring = rings.ring(v);
    EXPECT_EQ(ring.is_closed, !rings.mesh.is_border_vertex(v));
    EXPECT_EQ(ring.cells.size(), rings.mesh.degree(v) - (ring.is_closed ? 0 : 1));
  }
  Random random(1);
  const Index v = rings.random_inner_vertex(random);
  const Index a = rings.mesh.outgoing[v], b = rings.mesh.rotated_ccw(rings.mesh.rotated_ccw(a));
  rings.mesh.set_curve(a, 0);
  EXPECT_EQ(rings.ring(v).cells.size(), rings.mesh.degree(v)) << "one curve that ends here leaves one sector";
  EXPECT_FALSE(rings.ring(v).is_closed);
  rings.mesh.set_curve(b, 0);
  EXPECT_EQ(rings.ring(v).cells.size(), 2u);
  EXPECT_EQ(rings.ring(v).cells[0].face, a / 3);
}

// The exponential map

template <class Surface>
class Exponential_map : public ::testing::Test
{};

using Surfaces = ::testing::Types<analytic::Sphere, analytic::Ellipsoid, analytic::Torus, analytic::Graph>;
TYPED_TEST_SUITE(Exponential_map, Surfaces, );

/// Distances from the end of the geodesic, largest and root mean square.
struct Map_errors
{
  double h = 0, largest = 0, rms = 0;
};

/// Errors of `map(ring, t)` over tangent vectors that reach over the fraction `r` of the ring.
template <class Surface, class Map>
Map_errors map_errors(int level, double r, const Map& map)
{
  const Rings<Surface> rings(level);
  Random random(2);
  Map_errors e{rings.h};
  constexpr int samples = 1500;
  for (int i = 0; i < samples; ++i) {
    const One_ring ring = rings.ring(rings.random_inner_vertex(random));
    const Vector_3 t = random_tangent_vector(ring, r, random);
    const Vector_3 end = analytic::geodesic(rings.surface, ring.center(), t, 12).position;
    const double error = (map(ring, t) - end).norm();
    e.largest = (std::max)(e.largest, error);
    e.rms += error * error;
  }
  e.rms = std::sqrt(e.rms / samples);
  return e;
}

double order(const Map_errors& coarse, const Map_errors& fine)
{
  return std::log(coarse.rms / fine.rms) / std::log(coarse.h / fine.h);
}

Vector_3 length_kept(const One_ring& ring, const Vector_3& t)
{
  return SMA::exponential_map(ring, t, Exponential_map_method::length_kept).point.position;
}

Vector_3 shooting(const One_ring& ring, const Vector_3& t)
{
  return SMA::exponential_map(ring, t, Exponential_map_method::shooting).point.position;
}

TYPED_TEST(Exponential_map, by_lifting_with_kept_length_is_of_third_order)
{
  const double k = TypeParam().scale();
  const Map_errors coarse = map_errors<TypeParam>(2, 0.9, length_kept),
                   fine = map_errors<TypeParam>(4, 0.9, length_kept);
  EXPECT_GT(order(coarse, fine), 2.7);
  for (const Map_errors& e : {coarse, fine}) EXPECT_LT(e.largest, 0.3 * std::pow(k * e.h, 2) * e.h);
}

TYPED_TEST(Exponential_map, by_shooting_is_of_fourth_order)
{
  const double k = TypeParam().scale();
  const Map_errors coarse = map_errors<TypeParam>(2, 0.9, shooting), fine = map_errors<TypeParam>(4, 0.9, shooting);
  EXPECT_GT(order(coarse, fine), 3.7);
  for (const Map_errors& e : {coarse, fine}) EXPECT_LT(e.largest, 0.15 * std::pow(k * e.h, 3) * e.h);
}

TYPED_TEST(Exponential_map, is_better_than_the_closest_point)
{
  const TypeParam surface;
  const Map_errors closest = map_errors<TypeParam>(
    3, 0.9, [&](const One_ring& ring, const Vector_3& t) { return surface.closest_point(ring.center() + t); });
  EXPECT_LT(map_errors<TypeParam>(3, 0.9, length_kept).rms, closest.rms);
  EXPECT_LT(map_errors<TypeParam>(3, 0.9, shooting).rms, 0.1 * closest.rms);
}

TYPED_TEST(Exponential_map, keeps_the_length)
{
  const Rings<TypeParam> rings(2);
  Random random(3);
  double lifted = 0, kept = 0, shot = 0;
  for (int i = 0; i < 500; ++i) {
    const One_ring ring = rings.ring(rings.random_inner_vertex(random));
    const Vector_3 t = random_tangent_vector(ring, 0.8, random);
    const auto off = [&](const SMA::Surface_point& x) {
      return std::abs(SMA::logarithm_map(ring.center(), ring.normal(), x.position, x.normal).norm() - t.norm());
    };
    const SMA::internal::Ring_location l = SMA::internal::lift(ring, t);
    lifted += off(SMA::Gregory_reconstruction::evaluate(ring.cells[l.cell].patch, l.a, l.b));
    kept += off(SMA::exponential_map(ring, t, Exponential_map_method::length_kept).point);
    shot += off(SMA::exponential_map(ring, t).point);
  }
  EXPECT_LT(kept, 0.1 * lifted);
  EXPECT_LT(shot, 0.1 * lifted);
}

TYPED_TEST(Exponential_map, is_continuous_across_the_edges_of_the_ring)
{
  const Rings<TypeParam> rings(2);
  Random random(4);
  std::size_t crossed = 0;
  for (int i = 0; i < 500; ++i) {
    const One_ring ring = rings.ring(rings.random_inner_vertex(random));
    const Vector_3 t = tangent_vector(ring, random.below(ring.cells.size()), random.real(0.1, 0.9), 0);
    const Vector_3 across = 1e-15 * ring.normal().cross(t);
    for (const Exponential_map_method method :
         {Exponential_map_method::length_kept, Exponential_map_method::shooting}) {
      const Exponential_map_result x = SMA::exponential_map(ring, t + across, method),
                                   y = SMA::exponential_map(ring, t - across, method);
      EXPECT_LT((x.point.position - y.point.position).norm(), 1e-12 * rings.h);
      crossed += x.face != y.face;
    }
  }
  EXPECT_GT(crossed, 300u);
}

TYPED_TEST(Exponential_map, says_where_its_point_is)
{
  const Rings<TypeParam> rings(2); // fine enough for curved edges all over
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const One_ring ring = rings.ring(rings.random_inner_vertex(random));
    const Vector_3 t = random_tangent_vector(ring, random.real(0, 2), random);
    const Exponential_map_result x = SMA::exponential_map(ring, t);
    EXPECT_LT((point_at(rings, x) - x.point.position).norm(), 1e-14);
    EXPECT_GE((std::min)({x.u, x.v, 1 - x.u - x.v}), -1e-15);
    EXPECT_LT((x.point.normal - rings.surface.normal(x.point.position)).norm(), 0.2);
  }
}

TYPED_TEST(Exponential_map, stops_at_the_border_of_the_ring)
{
  const Rings<TypeParam> rings(2);
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const One_ring ring = rings.ring(rings.random_inner_vertex(random));
    for (const Exponential_map_method method :
         {Exponential_map_method::length_kept, Exponential_map_method::shooting}) {
      const Vector_3 t = random_tangent_vector(ring, 1, random);
      EXPECT_FALSE(SMA::exponential_map(ring, 0.8 * t, method).is_on_border);
      const Exponential_map_result x = SMA::exponential_map(ring, random.real(1.5, 5) * t, method);
      EXPECT_TRUE(x.is_on_border);
      const double b[3] = {1 - x.u - x.v, x.u, x.v};
      for (const One_ring::Cell& cell : ring.cells)
        if (cell.face == x.face) {
          EXPECT_NEAR(b[cell.corner], 0, 1e-15);
        }
    }
    EXPECT_EQ(SMA::exponential_map(ring, Vector_3::Zero()).point.position, ring.center());
  }
}

TEST(Exponential_map_at_a_boundary, stays_at_the_center_if_the_vector_points_away)
{
  const Rings<analytic::Graph> rings(2);
  std::size_t inside = 0, outside = 0;
  for (Index v = 0; v < rings.mesh.number_of_vertices(); ++v) {
    if (!rings.mesh.is_border_vertex(v)) continue;
    const One_ring ring = rings.ring(v);
    const Vector_3 t = tangent_vector(ring, 0, 0.2, 0.3);
    EXPECT_FALSE(SMA::exponential_map(ring, t).is_on_border);
    inside += SMA::exponential_map(ring, t).point.position != ring.center();
    const Exponential_map_result x = SMA::exponential_map(ring, -t);
    if (ring.cells.size() > 3) continue; // a corner of more than a half turn has nothing to lose
    EXPECT_TRUE(x.is_on_border);
    EXPECT_EQ(x.point.position, ring.center());
    ++outside;
  }
  EXPECT_GT(inside, 40u);
  EXPECT_GT(outside, 10u);
}

// The logarithm

template <class Surface>
class Logarithm : public ::testing::Test
{};

TYPED_TEST_SUITE(Logarithm, Surfaces, );

/// Largest error at a distance of `h`, of the logarithm and of the chord projected onto the tangent plane.
template <class Surface>
std::array<double, 2> logarithm_errors(double h)
{
  const Rings<Surface> rings(2);
  Random random(7);
  std::array<double, 2> worst{};
  for (int i = 0; i < 400; ++i) {
    const Vector_3 p = rings.soup.points[rings.random_inner_vertex(random)], n = rings.surface.normal(p),
                   t = h * n.cross(random.vector()).normalized();
    const Vector_3 q = analytic::geodesic(rings.surface, p, t, 24).position;
    const Vector_3 chord = (q - p) - (q - p).dot(n) * n;
    worst[0] = (std::max)(worst[0], (SMA::logarithm_map(p, n, q, rings.surface.normal(q)) - t).norm());
    worst[1] = (std::max)(worst[1], (chord - t).norm());
  }
  return worst;
}

TYPED_TEST(Logarithm, is_of_fourth_order)
{
  const double k = TypeParam().scale(), h = 0.1 / k;
  const auto coarse = logarithm_errors<TypeParam>(4 * h), fine = logarithm_errors<TypeParam>(h);
  EXPECT_GT(std::log(coarse[0] / fine[0]) / std::log(4), 3.7);
  EXPECT_LT(std::log(coarse[1] / fine[1]) / std::log(4), 3.3) << "the projected chord is of third order";
}

TEST(Logarithm_map, is_exact_on_planes_and_safe_anywhere)
{
  Random random(8);
  for (int i = 0; i < 300; ++i) {
    const Vector_3 n = random.vector().normalized(), t = n.cross(random.vector()), p = random.vector();
    EXPECT_LT((SMA::logarithm_map(p, n, p + t, n) - t).norm(), 1e-14);
    EXPECT_EQ(SMA::logarithm_map(p, n, p, n), Vector_3::Zero());
    EXPECT_TRUE(SMA::logarithm_map(p, n, p + random.vector(), random.vector().normalized()).allFinite());
    EXPECT_TRUE(SMA::logarithm_map(p, n, p + n, -n).allFinite());
  }
}

// Parallel transport

/// The transport of the direction `v` from one point to another: all models as one kind of function.
struct Transport
{
  const char* name;
  Matrix_3 (*rotation)(const Vector_3& v, const Vector_3& p, const Vector_3& np, const Vector_3& q, const Vector_3& nq);
};

const Transport minimal{"minimal", [](const Vector_3&, const Vector_3&, const Vector_3& np, const Vector_3&,
                                      const Vector_3& nq) { return SMA::minimal_rotation(np, nq); }};
const Transport chord{"chord", [](const Vector_3&, const Vector_3& p, const Vector_3& np, const Vector_3& q,
                                  const Vector_3& nq) { return SMA::chord_rotation(p, np, q, nq); }};
const Transport schild{"schild", SMA::schild_rotation};

/// Largest angle by which vectors that are carried over geodesics of the given length in `steps` steps go wrong.
template <class Surface>
double transport_error(const Transport& transport, double length, int steps)
{
  const Surface surface;
  const Soup soup = analytic::mesh(surface, 1);
  Random random(9);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Vector_3 p = soup.points[random.below(soup.points.size())], n = surface.normal(p),
                   t = n.cross(random.vector()).normalized();
    const double angle = random.real(0, 2 * pi);
    const auto turned = [&](const Vector_3& tangent, const Vector_3& normal) -> Vector_3 {
      return std::cos(angle) * tangent + std::sin(angle) * normal.cross(tangent);
    };
    Geodesic_point x{p, length * t};
    Vector_3 v = turned(t, n);
    for (int k = 0; k < steps; ++k) {
      const Geodesic_point y = analytic::geodesic(surface, x.position, x.velocity / steps, 96 / steps);
      v = transport.rotation(v, x.position, surface.normal(x.position), y.position, surface.normal(y.position)) * v;
      x = {y.position, y.velocity * steps};
    }
    // the angle to the tangent of a geodesic stays the same
    worst = (std::max)(worst, (v - turned(x.velocity.normalized(), surface.normal(x.position))).norm());
  }
  return worst;
}

TEST(Transport, is_exact_on_spheres_for_any_step)
{
  for (const Transport& transport : {minimal, chord}) {
    Random random(10);
    for (int i = 0; i < 500; ++i) {
      const Vector_3 p = random.vector().normalized(), t = p.cross(random.vector()).normalized();
      const double length = random.real(0.01, 3);
      const Vector_3 q = std::cos(length) * p + std::sin(length) * t, end = std::cos(length) * t - std::sin(length) * p;
      const Matrix_3 r = transport.rotation(t, p, p, q, q);
      EXPECT_LT((r * t - end).norm(), 1e-12) << transport.name;
      EXPECT_LT((r * p.cross(t) - p.cross(t)).norm(), 1e-12) << transport.name;
    }
  }
  EXPECT_GT(transport_error<analytic::Sphere>(schild, 0.4, 1), 1e-3) << "this is no property of any transport";
}

template <class Surface>
class Transport_order : public ::testing::Test
{};

using Curved_surfaces = ::testing::Types<analytic::Ellipsoid, analytic::Torus, analytic::Graph>;
TYPED_TEST_SUITE(Transport_order, Curved_surfaces, );

TYPED_TEST(Transport_order, of_rotations_is_two_over_many_steps)
{
  const double k = TypeParam().scale(), length = 1 / k;
  for (const Transport& transport : {minimal, chord}) {
    const double coarse = transport_error<TypeParam>(transport, length, 4),
                 fine = transport_error<TypeParam>(transport, length, 16);
    EXPECT_GT(std::log(coarse / fine) / std::log(4), 1.9) << transport.name;
  }
}

TYPED_TEST(Transport_order, of_one_step_is_three)
{
  const double k = TypeParam().scale();
  for (const Transport& transport : {minimal, chord})
    for (const double kh : {0.05, 0.1, 0.2, 0.4})
      EXPECT_LT(transport_error<TypeParam>(transport, kh / k, 1), 0.15 * std::pow(kh, 3)) << transport.name;
}

TYPED_TEST(Transport_order, of_schilds_ladder_on_straight_segments_is_one)
{
  const double k = TypeParam().scale(), length = 1 / k;
  const double coarse = transport_error<TypeParam>(schild, length, 4),
               fine = transport_error<TypeParam>(schild, length, 32);
  const double order = std::log(coarse / fine) / std::log(8);
  EXPECT_GT(order, 0.85);
  EXPECT_LT(order, 1.25);
  EXPECT_GT(fine, 3 * transport_error<TypeParam>(minimal, length, 32));
}

TEST(Transport, around_a_spherical_triangle_turns_by_its_area)
{
  Random random(11);
  for (const double size : {0.05, 0.5, 1.5}) {
    for (int i = 0; i < 100; ++i) {
      const Vector_3 a = random.vector().normalized();
      const Vector_3 b = (a + size * random.vector()).normalized(), c = (a + size * random.vector()).normalized();
      // Van Oosterom and Strackee 1983
      const double area = 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
      const Vector_3 v = a.cross(b).normalized();
      for (const Transport& transport : {minimal, chord}) {
        Vector_3 w = v;
        for (const auto& [p, q] : {std::make_pair(a, b), std::make_pair(b, c), std::make_pair(c, a)})
          w = transport.rotation(w, p, p, q, q) * w;
        const double turn = std::atan2(a.dot(v.cross(w)), v.dot(w));
        EXPECT_NEAR(std::remainder(turn - area, 2 * pi), 0, 1e-12) << transport.name;
      }
    }
  }
}

TEST(Transport, keeps_eigenvalues_and_takes_normals_to_normals)
{
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    const Vector_3 p = random.vector(), q = p + 0.3 * random.vector(), np = random.vector().normalized(),
                   nq = (np + 0.5 * random.vector()).normalized(), v = np.cross(random.vector()).normalized();
    const Vector_3 values(random.real(1, 2), random.real(10, 20), random.real(1000, 10000));
    Matrix_3 frame;
    frame << v, np, v.cross(np);
    const Metric_tensor_3 m = SMA::metric_tensor(values, frame);
    for (const Transport& transport : {minimal, chord, schild}) {
      const Matrix_3 r = transport.rotation(v, p, np, q, nq);
      EXPECT_LT((r * np - nq).norm(), 1e-14) << transport.name;
      EXPECT_LT((r * r.transpose() - Matrix_3::Identity()).norm(), 1e-14) << transport.name;
      EXPECT_NEAR(r.determinant(), 1, 1e-14) << transport.name;
      const Vector_3 after = SMA::eigen_decomposition(SMA::rotated(m, r)).values;
      EXPECT_LT(((after - values).cwiseQuotient(values)).cwiseAbs().maxCoeff(), 1e-11) << transport.name;
    }
  }
}

TEST(Transport, survives_degenerate_steps)
{
  const Vector_3 p(1, 2, 3), n(0, 0, 1), x(1, 0, 0);
  EXPECT_EQ(SMA::chord_rotation(p, n, p, n), Matrix_3::Identity());
  EXPECT_TRUE(SMA::chord_rotation(p, n, p + n, x).allFinite());
  EXPECT_TRUE(SMA::chord_rotation(p, n, p + x, -n).allFinite());
  EXPECT_TRUE(SMA::schild_rotation(x, p, n, p, x).allFinite());
  EXPECT_EQ(SMA::minimal_rotation(n, -n), Matrix_3::Identity());
}

TEST(Transported_mean, keeps_the_anisotropy_of_a_field_that_follows_the_surface)
{
  // around a cylinder, fine across and coarse along; metrics at both ends of an arc of 80 degrees
  const auto metric = [](const Vector_3& n) {
    Matrix_3 frame;
    frame << n, Vector_3::UnitZ(), n.cross(Vector_3::UnitZ());
    return SMA::metric_tensor(Vector_3(1, 1, 1e4), frame);
  };
  const auto normal = [](double angle) { return Vector_3(std::cos(angle), std::sin(angle), 0); };
  const Vector_3 a = normal(-0.7), b = normal(0.7), middle = normal(0);
  SMA::Transported_mean mean;
  mean.add(2, metric(a), SMA::minimal_rotation(a, middle));
  mean.add(1, metric(b), SMA::minimal_rotation(b, middle));
  const Matrix_3 expected = metric(middle).matrix();
  EXPECT_LT((mean.value().matrix() - expected).norm(), 1e-10 * expected.norm());
  const Metric_tensor_3 in_place = SMA::log_euclidean_interpolation(metric(a), metric(b), 1.0 / 3);
  EXPECT_GT((in_place.matrix() - expected).norm(), 0.5 * expected.norm()) << "without transport it is lost";
}

} // namespace test_exponential_map

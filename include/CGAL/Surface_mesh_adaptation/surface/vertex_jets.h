// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals and shape operators at the vertices, one per smooth sector, by local polynomial fits. They decide the order
// of whatever is built on them: a patch of fourth order needs normals of third order.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_VERTEX_JETS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_VERTEX_JETS_H

#include <CGAL/Surface_mesh_adaptation/execution/Buffer.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Cholesky.h>
#include <CGAL/Surface_mesh_adaptation/numerics/Cubic_fit.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facets.h>
#include <CGAL/Surface_mesh_adaptation/surface/Plausible_jets.h>
#include <CGAL/Surface_mesh_adaptation/surface/Sector_neighborhood.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// What the points are taken for.
enum class Jet_fit
{
  exact, ///< points of the surface: cubic fits
  noisy  ///< points next to the surface: normals of quadratic fits, shape operators from these normals
};

/// A unit normal and a shape operator at every corner of every face, shared by the corners of a smooth sector.
///
/// The shape operator is `S = dn`, the derivative of the normal along the surface, as a symmetric tensor of space with
/// `S n = 0`: on a sphere of radius r with outer normals it is `(I - n n^T) / r`. Unit: 1 / length.
struct Corner_jets
{
  Buffer<Vector_3> normals;  ///< unit, of each sector
  Buffer<Metric_tensor_3> shape_operators;  ///< of each sector
  Buffer<char> agrees;      ///< whether they agree with the facets around, see `internal::Plausible_jets`
  Buffer<Index> of_corner;  ///< index into all three for each corner

  /// How many sectors were settled by this fit; the rest has the normal of Max and what the normals around say.
  std::size_t cubic_fits = 0;
  std::size_t quadratic_fits = 0;  ///< the same
  std::size_t fallbacks = 0;  ///< the rest

  /// The normal and the shape operator of a sector.
  struct Jet
  {
    const Vector_3& normal;  ///< unit
    const Metric_tensor_3& shape_operator;  ///< `dn`
  };

  /// Those of the sector of a corner of a face.
  Jet at(Index corner) const { return {normals[of_corner[corner]], shape_operators[of_corner[corner]]}; }
};

namespace internal {

/// A point of a surface with a first guess of its normal, and orthonormal axes of the plane across it.
struct Tangent_frame
{
  Vector_3 origin, x, y, n;

  Tangent_frame(const Vector_3& origin_, const Vector_3& normal)
    : origin(origin_), x(normal.unitOrthogonal()), y(normal.cross(x)), n(normal)
  {}
};

/// Rings enough for a cubic fit, where the mesh is large enough: two, and up to two more at boundaries and features.
inline void grow_for_cubic_fit(Sector_neighborhood& neighbors)
{
  neighbors.grow();
  for (int ring = 2; ring < 4 && neighbors.size() < 14; ++ring) neighbors.grow();
}

/// Mean distance of `neighbors` from `origin`: the unit of length of a fit.
inline double mean_distance(const Sector_neighborhood& neighbors, const std::vector<Vector_3>& points,
                            const Vector_3& origin)
{
  double sum = 0;
  for (std::size_t i = 0; i < neighbors.size(); ++i) sum += (points[neighbors[i]] - origin).norm();
  return sum / double(neighbors.size());
}

/// Weight of a sample at the squared distance `d2` from the origin, in units of the mean distance. Measured: for exact
/// samples near ones should count more (the largest error of the normals is 1.4 times smaller than with equal weights),
/// for noisy ones all the same.
inline double fit_weight(double d2, Jet_fit kind) { return kind == Jet_fit::exact ? 1 / (0.1 + d2) : 1; }

/// A neighbour as a fit sees it: over the plane across the first guess of the normal.
struct Sample_over_plane
{
  Index vertex;
  Eigen::Vector2d x; ///< along the axes of the plane, in units of the radius
  double height;     ///< across it
  double weight;
};

using Samples_over_plane = boost::container::small_vector<Sample_over_plane, 48>;

/// The `neighbors` over the plane of `frame`, with `radius` as unit of length.
inline Samples_over_plane samples_over_plane(const Sector_neighborhood& neighbors, const std::vector<Vector_3>& points,
                                             const Tangent_frame& frame, double radius, Jet_fit kind)
{
  Samples_over_plane samples;
  const double scale = 1 / radius;
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    const Vector_3 d = scale * (points[neighbors[i]] - frame.origin);
    samples.push_back({neighbors[i], Eigen::Vector2d(d.dot(frame.x), d.dot(frame.y)), d.dot(frame.n),
                       fit_weight(d.squaredNorm(), kind)});
  }
  return samples;
}

/// The map of the plane after which the second moments of `samples` are those of a disc around the origin; the identity
/// if they lie on a line.
inline Eigen::Matrix2d map_to_disc(const Samples_over_plane& samples)
{
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const Sample_over_plane& s : samples) moments += outer_product(s.x, s.x);
  const Cholesky<2> factors(moments);
  if (!factors.is_positive_definite()) return Eigen::Matrix2d::Identity();
  return std::sqrt(0.5 * double(samples.size())) * factors.solve_lower<2>(Eigen::Matrix2d::Identity());
}

/// The fit of `value(sample)`, a function that is zero at the origin.
template <class Value>
Cubic_fit fit_of(const Samples_over_plane& samples, const Value& value)
{
  Cubic_fit fit(map_to_disc(samples));
  for (const Sample_over_plane& s : samples) fit.add(s.x, value(s), s.weight);
  return fit;
}

/// Relative error of the samples of a fit times what the fit makes of it.
constexpr double fit_rounding = 1e-14;

struct Jet_of_sector
{
  Vector_3 normal;
  Metric_tensor_3 shape_operator;
  bool agrees = false; ///< with the facets around
};

/// The normal and shape operator at the origin of the graph over `frame` with the derivatives `f`, of which the unit of
/// length is `radius`: with `J` the tangent vectors along the axes, `G = J^T J` and `H` the hessian,
/// `S = -J G^-1 H G^-1 J^T / sqrt(1 + |grad|^2)`.
inline Jet_of_sector jet_of_graph(const Tangent_frame& frame, const Derivatives_2& f, double radius)
{
  const Eigen::Vector2d& g = f.gradient;
  const double slope2 = g.squaredNorm(), w = std::sqrt(1 + slope2);
  const Vector_3 x = frame.x + g[0] * frame.n, y = frame.y + g[1] * frame.n;
  // G = I + g g^T, hence G^-1 = I - g g^T / (1 + g^2)
  const Eigen::Matrix2d inverse = shifted(-outer_product(g, g) / (1 + slope2), 1);
  const Vector_3 dual_x = inverse(0, 0) * x + inverse(1, 0) * y, dual_y = inverse(0, 1) * x + inverse(1, 1) * y;
  return {(frame.n - g[0] * frame.x - g[1] * frame.y) / w,
          Metric_tensor_3(in_space(f.hessian, dual_x, dual_y) * (-1 / (w * radius)))};
}

/// Largest second derivative, over the mean distance of the samples, with which they say something about the fourth.
constexpr double largest_bend = 1;

/// Takes from the samples of a cubic fit with the second derivatives `h` what a surface with that curvature all around
/// has of fourth order: `(x^T h x)(x^T h^2 x) / 8`, exact on spheres and cylinders. Measured: what is left of the
/// errors of patches is .2 of them on the sphere and .4 on the torus.
inline void subtract_fourth_order(Cubic_fit& fit, const Samples_over_plane& samples, const Eigen::Matrix2d& h)
{
  for (const Sample_over_plane& s : samples) {
    const Eigen::Vector2d hx = h * s.x;
    fit.subtract(s.x, s.x.dot(hx) * hx.squaredNorm() / 8, s.weight);
  }
}

enum class Fit_degree : std::uint8_t { none, quadratic, cubic };

/// What fits are for. Those for patches must agree with the facets, which patches must not leave. Sizes had better be
/// too small than too large: where the surface bends sharply between coarse facets, fits say so, if not how.
enum class Fit_purpose : std::uint8_t { patches, sizes };

/// The fit over the neighbourhood of a sector with the normal `normal` of Max: of the highest degree that has samples
/// enough, a normal within 30 degrees of `normal`, and serves its purpose; if there is none, `jet` stays.
inline Fit_degree fit_jet(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Facets* facets, Index first,
                          std::size_t n, const Vector_3& normal, Jet_fit kind, Fit_purpose purpose, Jet_of_sector& jet)
{
  Sector_neighborhood neighbors(mesh, first, n, facets);
  const Plausible_jets plausible(mesh, points, first, n, neighbors);
  grow_for_cubic_fit(neighbors);
  const Tangent_frame frame(points[mesh.source(first)], normal);
  const double radius = mean_distance(neighbors, points, frame.origin);
  if (!(radius > 0) || !std::isfinite(1 / radius)) return Fit_degree::none;
  const Samples_over_plane samples = samples_over_plane(neighbors, points, frame, radius, kind);
  const auto height = [](const Sample_over_plane& s) { return s.height; };
  constexpr double largest_squared_slope = 1.0 / 3; // tan(30 degrees)^2
  Derivatives_2 f;
  // second derivatives that the rounding of the coordinates explains are none
  const double rounding = fit_rounding * frame.origin.lpNorm<Eigen::Infinity>() / radius;
  const auto accept = [&](bool solved) {
    if (!solved || !(f.gradient.squaredNorm() <= largest_squared_slope) || !f.hessian.allFinite()) return false;
    if (f.bend <= rounding) f.hessian.setZero();
    Jet_of_sector fitted = jet_of_graph(frame, f, radius);
    fitted.agrees = plausible.contains(fitted.normal, fitted.shape_operator);
    if (purpose == Fit_purpose::patches && !fitted.agrees) return false;
    jet = fitted;
    return true;
  };
  if (kind == Jet_fit::exact) {
    Cubic_fit fit = fit_of(samples, height);
    const Cubic_fit::Solver<9> cubic(fit);
    if (cubic.solve(f)) {
      const Derivatives_2 without_fourth_order = f;
      if (f.hessian.lpNorm<Eigen::Infinity>() <= largest_bend) {
        subtract_fourth_order(fit, samples, f.hessian);
        if (accept(cubic.solve(f))) return Fit_degree::cubic;
        f = without_fourth_order;
      }
      if (accept(true)) return Fit_degree::cubic;
    }
  }
  return accept(fit_of(samples, height).solve_quadratic(f)) ? Fit_degree::quadratic : Fit_degree::none;
}

/// The shape operator of a face as a tensor of space: the symmetric map that takes, in the sense of least squares,
/// each edge to the difference of the normals at its ends (Rusinkiewicz 2004). Zero for degenerate faces.
inline Metric_tensor_3 shape_operator_of_face(const std::array<Vector_3, 3>& p, const std::array<Vector_3, 3>& n)
{
  const Metric_tensor_3 zero(0, 0, 0, 0, 0, 0);
  const Vector_3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  if (!(normal.squaredNorm() > 0)) return zero;
  const Vector_3 u = (p[1] - p[0]).normalized(), v = normal.normalized().cross(u);
  Matrix_3 a = Matrix_3::Zero();
  Vector_3 b = Vector_3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector_3 e = p[(i + 1) % 3] - p[i], dn = n[(i + 1) % 3] - n[i];
    const double x = e.dot(u), y = e.dot(v);
    const Vector_3 row_u(x, y, 0), row_v(0, x, y);
    a += outer_product(row_u, row_u) + outer_product(row_v, row_v);
    b += dn.dot(u) * row_u + dn.dot(v) * row_v;
  }
  const Cholesky<3> factors(a);
  if (!factors.is_positive_definite()) return zero;
  const Vector_3 s = factors.solve(b);
  if (!s.allFinite()) return zero;
  return Metric_tensor_3(outer_product(s[0] * u, u) + s[1] * (outer_product(u, v) + outer_product(v, u)) +
                         outer_product(s[2] * v, v));
}

/// The mean of the shape operators of the faces of a sector, weighted by area, each carried to the tangent plane; zero
/// if it is what the rounding of coordinates and normals explains.
inline Metric_tensor_3 mean_shape_operator(const Mesh_view& mesh, const std::vector<Vector_3>& points,
                                           const Corner_jets& jets, Index first, std::size_t n_faces)
{
  const Vector_3& normal = jets.normals[jets.of_corner[first]];
  Metric_tensor_3 sum(0, 0, 0, 0, 0, 0);
  double weight = 0;
  Index h = first;
  for (std::size_t i = 0; i < n_faces; ++i, h = mesh.rotated_ccw(h)) {
    const std::array<Index, 3> corners{h, Mesh_view::next(h), Mesh_view::previous(h)};
    std::array<Vector_3, 3> p, normals;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = points[mesh.corner[corners[k]]];
      normals[k] = jets.normals[jets.of_corner[corners[k]]];
    }
    const Vector_3 across = (p[1] - p[0]).cross(p[2] - p[0]);
    const double area = across.norm();
    if (!(area > 0)) continue;
    sum += area * rotated(shape_operator_of_face(p, normals), minimal_rotation(across / area, normal));
    weight += area;
  }
  const double faces = double(n_faces), area = weight / faces;
  const double rounding = fit_rounding * (points[mesh.source(first)].lpNorm<Eigen::Infinity>() + std::sqrt(area));
  if (!(sum.matrix().lpNorm<Eigen::Infinity>() > faces * rounding)) return Metric_tensor_3(0, 0, 0, 0, 0, 0);
  return (1 / weight) * sum;
}

} // namespace internal

/// Estimates the normals and shape operators of all sectors from the points alone, each by a height function over the
/// plane across the normal of Max (Cazals, Pouget 2005) through the vertex, fitted to the two rings around it that can
/// be reached without crossing a feature: cubic, with normals of third and shape operators of second order in the
/// length of the edges. A fit with too few or ill spread neighbours, or with a normal more than 30 degrees off, falls
/// back to the quadratic one of the same samples, then to the normal of Max with the shape operators of the faces
/// around (Rusinkiewicz 2004), which are also those of `Jet_fit::noisy`. Always finite.
///
/// \pre `mesh.curve` is set (Features.h), all points are finite
/// \par Complexity
/// O(n), about 2 microseconds a vertex
template <class Execution>
Corner_jets estimate_jets(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                          Jet_fit samples = Jet_fit::exact)
{
  using internal::Fit_degree;
  Corner_normals start = estimate_normals(execution, mesh, points);
  Corner_jets jets;
  jets.normals = std::move(start.normals);
  jets.of_corner = std::move(start.of_corner);
  jets.shape_operators.resize(jets.normals.size());
  jets.agrees.resize(jets.normals.size());
  Buffer<Fit_degree> degree(jets.normals.size());
  const auto for_each_sector = [&](const auto& f) {
    for_each_index(execution, mesh.number_of_vertices(), [&](std::size_t v) {
      internal::for_each_sector(mesh, Index(v), [&](Index first, std::size_t n) { f(jets.of_corner[first], first, n); });
    }, heavy_chunk_length);
  };
  for_each_sector([&](Index id, Index first, std::size_t n) {
    internal::Jet_of_sector jet{jets.normals[id], Metric_tensor_3(0, 0, 0, 0, 0, 0)};
    degree[id] = internal::fit_jet(mesh, points, nullptr, first, n, jets.normals[id], samples,
                                   internal::Fit_purpose::sizes, jet);
    jets.normals[id] = jet.normal;
    jets.shape_operators[id] = jet.shape_operator;
    jets.agrees[id] = jet.agrees;
  });
  for_each_sector([&](Index id, Index first, std::size_t n) {
    if (degree[id] == Fit_degree::none || samples == Jet_fit::noisy)
      jets.shape_operators[id] = internal::mean_shape_operator(mesh, points, jets, first, n);
  });
  const auto count = [&](Fit_degree d) {
    return count_if(execution, degree.size(), [&](std::size_t i) { return degree[i] == d; });
  };
  jets.cubic_fits = count(Fit_degree::cubic);
  jets.quadratic_fits = count(Fit_degree::quadratic);
  jets.fallbacks = count(Fit_degree::none);
  return jets;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_VERTEX_JETS_H

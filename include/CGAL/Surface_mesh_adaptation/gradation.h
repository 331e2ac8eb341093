// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradation: bounds how fast sizes grow over the surface.
//
// Both forms are made of Jacobi sweeps, each of which reads the old values and writes the new ones, until nothing
// changes: the result does not depend on the execution, and each sweep carries the bound on by one layer of vertices.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_GRADATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_GRADATION_H

#include <CGAL/Surface_mesh_adaptation/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/execution.h>
#include <CGAL/Surface_mesh_adaptation/internal/flatten.h>
#include <CGAL/Surface_mesh_adaptation/metric_intersection.h>
#include <CGAL/Surface_mesh_adaptation/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/vertex_normals.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Ratio of the sizes at two points one size apart, unless said otherwise (the value of the paper).
constexpr double default_gradation = 1.5;

/// Lowers `sizes` (one per vertex) until the h-shock of every edge is at most `ratio`, that is
/// `|h_q - h_p| <= |pq| ln ratio` (Borouchaki, Hecht, Frey 1998). The result is the largest such field below the given
/// one, hence unique. `ratio <= 1` switches the gradation off.
template <class Execution>
void apply_gradation(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                     double ratio, std::vector<double>& sizes)
{
  if (!(ratio > 1)) return;
  const double slope = std::log(ratio);
  std::vector<double> lowered(sizes.size());
  for (bool changed = true; changed;) {
    for_each_index(execution, sizes.size(), [&](std::size_t v) {
      double h = sizes[v];
      mesh.for_each_neighbor(Index(v), [&](Index w) {
        h = (std::min)(h, sizes[w] + slope * (points[w] - points[v]).norm());
      });
      lowered[v] = h;
    });
    changed = count_if(execution, sizes.size(), [&](std::size_t v) { return lowered[v] < sizes[v]; }) > 0;
    sizes.swap(lowered);
  }
}

namespace internal {

/// Whether `m - a` is positive semidefinite but for rounding: then intersecting `m` with `a` would not change it.
inline bool dominates(const Metric_tensor_3& m, const Metric_tensor_3& a)
{
  constexpr double relative_slack = 1e-11, absolute_slack = 1e-14; // the latter in units of the largest eigenvalue
  const double slack = absolute_slack * (m[0] + m[2] + m[5]);
  const auto d = [&](int i) { return m[i] + relative_slack * m[i] - a[i]; };
  // Cholesky factors of d + slack I, column by column
  const double xx = d(0) + slack;
  if (!(xx > 0)) return false;
  const double lyx = d(1) / xx, lzx = d(3) / xx;
  const double yy = d(2) + slack - lyx * d(1);
  if (!(yy > 0)) return false;
  const double zy = d(4) - lzx * d(1);
  return d(5) + slack - lzx * d(3) - zy * zy / yy > 0;
}

/// The edge vector `e`, carried from half-way between the normals of its ends to that of its first end. The transport
/// along the edge takes it to what the same function gives for the other end, so both ends measure one vector.
inline Vector_3 edge_in_tangent_plane(const Vector_3& e, const Vector_3& normal, const Vector_3& normal_of_other_end)
{
  const double c = normal.dot(normal_of_other_end);
  if (c < -1 + 1e-12) return e;
  const double cosine = std::sqrt((1 + c) / 2); // of half the angle
  const Vector_3 x = normal_of_other_end.cross(normal) / (2 * cosine);
  return cosine * e + x.cross(e) + x.dot(e) / (1 + cosine) * x;
}

/// One run of the gradation of tensors.
class Tensor_gradation
{
public:
  Tensor_gradation(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Corner_normals& normals,
                   double ratio, std::vector<Metric_tensor_3>& tensors)
    : mesh_(mesh), points_(points), normals_(normals), slope_(std::log(ratio)), tensors_(tensors)
    , changed_(tensors.size(), 1)
  {}

  template <class Execution>
  void run(const Execution& execution)
  {
    const std::size_t n = tensors_.size();
    std::vector<Metric_tensor_3> raised(n);
    std::vector<std::uint8_t> is_raised(n);
    std::size_t changes = 0;
    do {
      changes = count_if(execution, n, [&](std::size_t v) {
        raised[v] = raised_tensor(Index(v));
        is_raised[v] = raised[v] == tensors_[v] ? 0 : 1;
        return is_raised[v] != 0;
      });
      tensors_.swap(raised);
      changed_.swap(is_raised);
    } while (changes > 0);
  }

private:
  /// The tensor at `v`, intersected with what its changed neighbours let grow there.
  CGAL_SMA_FLATTEN Metric_tensor_3 raised_tensor(Index v) const
  {
    Metric_tensor_3 result = tensors_[v];
    Ring<Ranked_metric> candidates;
    const auto look_along = [&](Index from_v, Index from_w) {
      if (!changed_[mesh_.source(from_w)]) return;
      const Metric_tensor_3 grown = grown_tensor(from_w, from_v);
      if (!dominates(result, grown)) candidates.emplace_back(grown);
    };
    mesh_.for_each_outgoing(v, [&](Index h) {
      // a ridge has normals on both sides: both ends use those of the same face
      if (mesh_.is_edge_owner(h)) look_along(h, Mesh_view::next(h));
      else look_along(Mesh_view::next(mesh_.twin[h]), mesh_.twin[h]);
      const Index last = Mesh_view::previous(h);
      if (mesh_.is_border(last)) look_along(h, last);
    });
    std::sort(candidates.begin(), candidates.end());
    for (const Ranked_metric& c : candidates)
      if (!dominates(result, c.metric)) result = intersection(result, c.metric);
    return result;
  }

  /// The tensor at the corner `from`, carried to the corner `to` at the other end of an edge, its sizes grown by the
  /// length of the edge in it.
  Metric_tensor_3 grown_tensor(Index from, Index to) const
  {
    const Index w = mesh_.source(from), v = mesh_.source(to);
    const Vector_3 &normal = normals_.at(from), &normal_of_end = normals_.at(to);
    const Vector_3 edge = edge_in_tangent_plane(points_[v] - points_[w], normal, normal_of_end);
    const double growth = 1 + slope_ * tensors_[w].length(edge);
    return 1 / (growth * growth) * rotated(tensors_[w], minimal_rotation(normal, normal_of_end));
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Corner_normals& normals_;
  double slope_;
  std::vector<Metric_tensor_3>& tensors_;
  std::vector<std::uint8_t> changed_;
};

} // namespace internal

/// Raises `tensors` (one per vertex) until the sizes `h_p`, `h_q` that the tensors at the ends of any edge `pq` ask for
/// along it satisfy `|h_p - h_q| <= |pq| ln ratio`, the edge being carried to the tangent planes of its ends and from
/// one to the other by the minimal rotation of the normals: each tensor is
/// intersected with those of its neighbours, carried to it and divided by `(1 + l ln ratio)^2`, with `l` the length of
/// the edge in the neighbour's tensor (growth that is homogeneous in the metric). What would change a vertex is
/// folded by decreasing determinant, so the numbering of the mesh does not matter. `ratio <= 1` switches it off.
/// \pre all tensors are positive definite
/// \complexity a few microseconds for each vertex with a changed neighbour, sweep by sweep; the number of sweeps is that
///   of the layers of vertices over which the smallest sizes have an effect
template <class Execution>
void apply_gradation(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                     const Corner_normals& normals, double ratio, std::vector<Metric_tensor_3>& tensors)
{
  if (!(ratio > 1)) return;
  internal::Tensor_gradation(mesh, points, normals, ratio, tensors).run(execution);
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_GRADATION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradation: bounds how fast sizes grow over the surface.
//
// Both forms are made of Jacobi sweeps, each of which reads the old values and writes the new ones, until nothing
// changes: the result does not depend on the execution, and each sweep carries the bound on by one layer of vertices.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADATION_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric_intersection.h>
#include <CGAL/Surface_mesh_adaptation/metric/parallel_transport.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationMetricFields
/// @{

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
    largest_ = reduce(execution, n, 0.0, [&](std::size_t v) { return largest_eigenvalue(tensors_[v]); },
                      [](double a, double b) { return (std::max)(a, b); });
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
  /// The tensor at `v`, intersected with what those changed neighbours let grow there that bound the size along the
  /// edge to them.
  Metric_tensor_3 raised_tensor(Index v) const
  {
    Ring<Ranked_metric> candidates;
    const auto look_along = [&](Index at_v, Index at_w) {
      if (changed_[mesh_.source(at_w)]) add_candidate(at_v, at_w, candidates);
    };
    mesh_.for_each_outgoing(v, [&](Index h) {
      // a ridge has normals on both sides: both ends use those of the same face
      if (mesh_.is_edge_owner(h)) look_along(h, Mesh_view::next(h));
      else look_along(Mesh_view::next(mesh_.twin[h]), mesh_.twin[h]);
      const Index last = Mesh_view::previous(h);
      if (mesh_.is_border(last)) look_along(h, last);
    });
    std::sort(candidates.begin(), candidates.end());
    Metric_tensor_3 result = tensors_[v];
    for (const Ranked_metric& c : candidates) result = intersection(result, c.metric);
    return candidates.empty() ? result : bounded(result);
  }

  static double largest_eigenvalue(const Metric_tensor_3& m) { return eigen_decomposition(m).values[2]; }

  /// `m`, or the smallest size that was asked for in all directions, where `m` asks for less than half of it. Where
  /// tensors meet in other directions each time, as on needles whose normals say little, their intersections would
  /// become smaller without end.
  Metric_tensor_3 bounded(const Metric_tensor_3& m) const
  {
    constexpr double excess = 4; // of an inverse squared size
    if (m.matrix().trace() <= excess * largest_ || largest_eigenvalue(m) <= excess * largest_) return m;
    return Metric_tensor_3(largest_, 0, largest_, 0, 0, largest_);
  }

  /// Adds the tensor of the other end of an edge, carried to this one and with its sizes grown by its length of the
  /// edge, if the size along the edge exceeds that. The edge is given by the corners at both ends.
  void add_candidate(Index corner, Index other_corner, Ring<Ranked_metric>& candidates) const
  {
    const Index v = mesh_.source(corner), w = mesh_.source(other_corner);
    const Vector_3 &normal = normals_.at(corner), &other_normal = normals_.at(other_corner);
    const Vector_3 edge = points_[w] - points_[v];
    const double other_length = tensors_[w].length(edge_in_tangent_plane(edge, other_normal, normal));
    const double growth = 1 + slope_ * other_length;
    // the sizes along the edge are its length over these
    const Metric_tensor_3& m = tensors_[v];
    const double rounding = 1e-14 * (m[0] + m[2] + m[5]) * edge.squaredNorm();
    const double squared_length = m.squared_length(edge_in_tangent_plane(edge, normal, other_normal)) + rounding;
    if (squared_length * growth * growth >= other_length * other_length) return;
    candidates.emplace_back(1 / (growth * growth) * rotated(tensors_[w], minimal_rotation(other_normal, normal)));
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Corner_normals& normals_;
  double slope_;
  double largest_ = 0; // of the eigenvalues at the start
  std::vector<Metric_tensor_3>& tensors_;
  std::vector<std::uint8_t> changed_;
};

} // namespace internal

/// Raises `tensors` (one per vertex) until the h-shock of every edge `pq` is at most `ratio`: the sizes `h_p`, `h_q`
/// that the tensors at its ends ask for along it satisfy `|h_p - h_q| <= |pq| ln ratio`. The edge is carried to the
/// tangent planes of its ends, and from one to the other, by the minimal rotation of the normals. A tensor of which the
/// size along an edge is too large is intersected with that of the other end, carried to it and divided by
/// `(1 + l ln ratio)^2`, with `l` the length of the edge in the tensor of the other end (growth that is homogeneous in
/// the metric). What several neighbours bound is folded by decreasing determinant, so the numbering of the mesh does
/// not matter. `ratio <= 1` switches it off.
/// \pre all tensors are positive definite
/// \par Complexity
/// in each sweep a few hundred nanoseconds for each vertex with a changed neighbour; the number of sweeps
///   is that of the layers of vertices over which the smallest sizes have an effect
template <class Execution>
void apply_gradation(const Execution& execution, const Mesh_view& mesh, const std::vector<Vector_3>& points,
                     const Corner_normals& normals, double ratio, std::vector<Metric_tensor_3>& tensors)
{
  if (!(ratio > 1)) return;
  internal::Tensor_gradation(mesh, points, normals, ratio, tensors).run(execution);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADATION_H

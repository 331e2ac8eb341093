// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the facets around a vertex say of the surface there, against which fits are held.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PLAUSIBLE_JETS_H
#define CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PLAUSIBLE_JETS_H

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>
#include <CGAL/Surface_mesh_adaptation/surface/Facet_normals.h>
#include <CGAL/Surface_mesh_adaptation/surface/Sector_neighborhood.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The normals and shape operators at a vertex that agree with the facets around it. Fits need not: where the samples
/// lie on a few lines, as on a cylinder of long faces, a polynomial may turn between the lines at will.
class Plausible_jets
{
public:
  /// In the sector of the `n` faces from that of `first` on. Where features or the boundary bound it, the vertex is at
  /// the margin of its facets, so that those around its `neighbors` count, too.
  Plausible_jets(const Mesh_view& mesh, const std::vector<Vector_3>& points, Index first, std::size_t n,
                 const Sector_neighborhood& neighbors)
    : mesh_(mesh), points_(points), vertex_(points[mesh.source(first)])
  {
    const bool is_open = mesh.is_crease(first) || mesh.is_border(first);
    for (Index h = first; n > 0; --n, h = mesh.rotated_ccw(h)) {
      sector_.add(face_normal(mesh, points, h));
      facets_.push_back(h);
    }
    nearby_ = sector_;
    for (std::size_t i = 0; is_open && i < neighbors.size(); ++i)
      neighbors.for_each_face_around(i, [&](Index h) {
        nearby_.add(face_normal(mesh, points, h));
        facets_.push_back(h);
      });
  }

  /// Whether `normal` is about as far off the facets as they are off each other in its direction, and whether with their
  /// corners on the paraboloid of `normal` and `shape_operator` they would have nearly the mean normal that they have.
  /// On smooth surfaces the former is of the order of the facets, the latter of their square.
  bool contains(const Vector_3& normal, const Metric_tensor_3& shape_operator) const
  {
    if (sector_.empty() || sector_.variance() > largest_variance) return false;
    const Vector_3 mean = nearby_.mean();
    return is_small(normal - mean, 3) && is_small(mean_on(normal, shape_operator) - mean, 1);
  }

private:
  static constexpr double largest_variance = 0.18; // 25 degrees: beyond, fits are farther off than the mean
  static constexpr double rounding = 1e-16;

  /// Whether `tilt` is less than so many standard deviations along it, or than the variance: where facets do not turn in
  /// that direction at all they may for what is of second order.
  bool is_small(const Vector_3& tilt, double deviations) const
  {
    const double tilt2 = tilt.squaredNorm(), variance = nearby_.variance();
    if (tilt2 <= rounding) return true;
    return tilt2 <= deviations * deviations * nearby_.variance(tilt / std::sqrt(tilt2)) + variance * variance;
  }

  /// The mean normal of the facets with their corners on the paraboloid.
  Vector_3 mean_on(const Vector_3& normal, const Metric_tensor_3& shape_operator) const
  {
    const auto on_jet = [&](Index v) -> Vector_3 {
      const Vector_3 d = points_[v] - vertex_;
      return d - (d.dot(normal) + d.dot(shape_operator * d) / 2) * normal;
    };
    Vector_3 sum = Vector_3::Zero();
    for (const Index h : facets_) {
      const Vector_3 p = on_jet(mesh_.source(h));
      sum += (on_jet(mesh_.target(h)) - p).cross(on_jet(mesh_.apex(h)) - p);
    }
    return sum.normalized();
  }

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  Vector_3 vertex_;
  Facet_normals sector_, nearby_; ///< the latter: also beyond, at the margin
  Ring<Index> facets_;            ///< a halfedge of each nearby one
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_SURFACE_PLAUSIBLE_JETS_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_PREPARED_TRIANGLE_H
#define CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_PREPARED_TRIANGLE_H

#include <CGAL/Surface_mesh_adaptation/surface_distance.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// A triangle of which the distance is asked for by many points.
class Prepared_triangle
{
public:
  explicit Prepared_triangle(const Triangle_points& corners) : corners_(corners), normal_(Vector_3::Zero())
  {
    const Vector_3 n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double double_area = n.norm();
    if (double_area > 0) normal_ = n / double_area;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector_3 out = (corners[(i + 1) % 3] - corners[i]).cross(normal_);
      const double length = out.norm();
      outwards_[i] = length > 0 ? Vector_3(out / length) : out;
      offsets_[i] = outwards_[i].dot(corners[i] - corners[0]);
    }
  }

  /// The unit normal; zero if the triangle is degenerate.
  const Vector_3& normal() const { return normal_; }

  struct Distance
  {
    double squared;
    bool is_above;
  };

  /// The squared distance of `p` from the triangle, or some number that is not smaller than `enough` if it is not.
  Distance squared_distance(const Vector_3& p, double enough) const
  {
    const Vector_3 d = p - corners_[0];
    const double height = normal_.dot(d);
    const double aside = (std::max)({outwards_[0].dot(d), outwards_[1].dot(d) - offsets_[1],
                                     outwards_[2].dot(d) - offsets_[2]});
    if (aside <= 0) return {height * height, normal_ != Vector_3::Zero()};
    const double at_least = height * height + aside * aside; // that of the plane and of the line of an edge
    if (at_least >= enough) return {at_least, false};
    return {(std::min)({squared_distance_to_segment(p, corners_[0], corners_[1]),
                        squared_distance_to_segment(p, corners_[1], corners_[2]),
                        squared_distance_to_segment(p, corners_[2], corners_[0])}), false};
  }

private:
  Triangle_points corners_;
  Vector_3 normal_;
  std::array<Vector_3, 3> outwards_; // unit vectors in the plane, orthogonal to the edges
  std::array<double, 3> offsets_;    // of the edges along them
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_PREPARED_TRIANGLE_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// No face of an adapted mesh is to meet another one where the input had no faces that do. Those that do are found by exact
// predicates. The surface is then made to bulge by less than the gaps there, and sizes get finer, until the faces come
// nearer to the input than these. Where gaps are too narrow for that, all is done again with the triangles of the input kept
// there, ever more of them: these do not meet.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SELF_INTERSECTION_GUARD_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SELF_INTERSECTION_GUARD_H

#include <CGAL/Surface_mesh_adaptation/distance/gap_bounds.h>
#include <CGAL/Surface_mesh_adaptation/distance/input_faces_near.h>
#include <CGAL/Surface_mesh_adaptation/distance/self_intersections.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/surface/Features.h>
#include <CGAL/Surface_mesh_adaptation/surface/Patch.h>
#include <CGAL/Surface_mesh_adaptation/surface/vertex_normals.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The largest size that a metric asks for.
inline double largest_size(const Isotropic_metric& m) { return 1 / m.inverse_size; }
inline double largest_size(const Anisotropic_metric& m) { return 1 / std::sqrt(eigen_decomposition(m.m).values[0]); }

class Self_intersection_guard
{
public:
  /// `mesh` and `points` are the input; all live as long as this.
  Self_intersection_guard(const Mesh_view& mesh, const std::vector<Vector_3>& points, const Surroundings& surroundings)
    : mesh_(mesh), points_(points), surroundings_(surroundings), is_kept_(mesh.number_of_faces(), 0)
  {}

  /// The pairs of faces of `m` that meet; found once if it is the mesh of the last call. No run that is stopped leaves a part
  /// of them out: the test is finished, or given up with an exception.
  template <class Execution, class Mesh>
  const std::vector<Face_pair>& all_pairs(const Execution& execution, const Mesh& m)
  {
    const auto& corners = m.mesh.corner;
    const bool is_same = std::equal(corners.begin(), corners.end(), tested_.corners.begin(), tested_.corners.end()) &&
                         std::equal(m.points.begin(), m.points.end(), tested_.points.begin(), tested_.points.end());
    if (!is_same)
      tested_ = {{corners.begin(), corners.end()}, {m.points.begin(), m.points.end()},
                 self_intersections(execution, m.mesh, m.points, surroundings_)};
    return tested_.pairs;
  }

  /// The pairs of faces of `surface` that meet, but for those where the input has such.
  template <class Execution, class Surface>
  std::vector<Face_pair> new_pairs(const Execution& execution, const Surface& surface)
  {
    std::vector<Face_pair> pairs = all_pairs(execution, surface);
    if (pairs.empty()) return pairs;
    if (is_old_.empty()) find_old(execution);
    if (!has_old_) return pairs;
    const auto is_old = [&](const Face_pair& p) { return is_above_old(surface, p[0]) && is_above_old(surface, p[1]); };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_old), pairs.end());
    return pairs;
  }

  /// Looks for gaps that matter for the sizes of `surface`, once.
  template <class Execution, class Surface>
  void find_gaps(const Execution& execution, const Surface& surface)
  {
    if (gaps_) return;
    constexpr double reach = 1.5;           // sizes: beyond a gap of 1.4, a bound would be half a size
    constexpr double reach_of_facets = 0.5; // of their edges, that much a surface may bulge
    const auto& reference = surface.reference();
    std::vector<double> reaches(mesh_.number_of_vertices());
    for_each_index(execution, reaches.size(), [&](std::size_t v) {
      double longest = 0;
      mesh_.for_each_neighbor(Index(v), [&](Index w) { longest = (std::max)(longest, (points_[w] - points_[v]).norm()); });
      const Surface_point p{points_[v], reference.normals.at(mesh_.outgoing[v])};
      const auto metric = surface.background().at(reference, reference.location_of_vertex(Index(v)), p);
      reaches[v] = (std::max)(reach * largest_size(metric), reach_of_facets * longest);
    });
    Triangle_tree tree(execution, mesh_, points_);
    std::vector<double> bounds = gap_bounds(execution, mesh_, points_, tree, reaches);
    gaps_ = Gaps{std::move(tree), std::move(bounds)};
  }

  /// How far the input may be left at each of its vertices; empty as long as faces did not meet.
  template <class Execution>
  std::vector<double> bounds_at_vertices(const Execution& execution) const
  {
    std::vector<double> bounds(gaps_ ? mesh_.number_of_vertices() : 0, infinity);
    for_each_index(execution, bounds.size(), [&](std::size_t v) {
      mesh_.for_each_outgoing(Index(v), [&](Index h) {
        bounds[v] = (std::min)(bounds[v], gaps_->bounds[gaps_->tree.place(Mesh_view::face(h))]);
      });
    });
    return bounds;
  }

  /// What the sizes at the vertices of `surface` are to be multiplied with so that the faces of `pairs` come nearer to the
  /// input than half the gaps there: distances go with the squares of sizes. 1 where no size can do that, and nothing at all
  /// where that is so for half of the pairs. \pre gaps were found
  template <class Execution, class Surface>
  std::vector<double> size_factors(const Execution& execution, const Surface& surface,
                                   const std::vector<Face_pair>& pairs) const
  {
    constexpr double strongest_step = 0.35, weakest_step = 0.8;
    const std::vector<double> wanted = factors_of_faces(execution, surface, pairs);
    const auto n = std::count_if(pairs.begin(), pairs.end(), [&](const Face_pair& pair) {
      return wanted[pair[0]] > 0 && wanted[pair[1]] > 0;
    });
    if (2 * std::size_t(n) <= pairs.size()) return {};
    std::vector<double> factors(surface.mesh.number_of_vertices(), 1);
    for (const Face_pair& pair : pairs)
      for (std::size_t i = 0; i < 2; ++i) {
        const double of_face = wanted[pair[i]];
        if (of_face == 0 || (of_face > 1 && wanted[pair[1 - i]] < 1)) continue; // the other one is too far away
        for (Index h = 3 * pair[i]; h < 3 * pair[i] + 3; ++h) {
          double& factor = factors[surface.mesh.source(h)];
          factor = (std::min)(factor, std::clamp(of_face, strongest_step, weakest_step));
        }
      }
    return factors;
  }

  /// Has the faces of the input below `pairs`, and ever more around these, kept in the next attempt.
  /// \throws Self_intersection_error if that was tried often enough
  template <class Surface>
  void keep_faces(const Surface& surface, const std::vector<Face_pair>& pairs)
  {
    if (++attempts_ > max_attempts) throw Self_intersection_error(pairs.size());
    std::size_t number_of_new = 0;
    for (const Index f : faces_of(pairs))
      for (const Index face : input_faces_near(surface, f)) {
        number_of_new += is_kept_[face] == 0 ? 1 : 0;
        is_kept_[face] = 1;
      }
    const int rings = number_of_new == 0 ? 1 : (std::max)(0, attempts_ - max_attempts / 2);
    for (int i = 0; i < rings; ++i) is_kept_ = with_faces_around(is_kept_);
  }

  /// How many there are by now.
  std::size_t number_of_kept_faces() const { return std::size_t(std::count(is_kept_.begin(), is_kept_.end(), 1)); }

  /// `features`, with the edges of all faces that have to be kept.
  Feature_parameters constrained(Feature_parameters features) const
  {
    if (attempts_ == 0) return features;
    features.constrain(mesh_, Edge_constraint::protect, [&](Index h) { return is_kept_[Mesh_view::face(h)] != 0; });
    return features;
  }

private:
  static constexpr int max_attempts = 12;

  template <class Execution>
  void find_old(const Execution& execution)
  {
    is_old_.assign(mesh_.number_of_faces(), 0);
    for (const Face_pair& pair : self_intersections(execution, mesh_, points_, surroundings_))
      for (const Index f : pair) is_old_[f] = 1;
    has_old_ = std::find(is_old_.begin(), is_old_.end(), 1) != is_old_.end();
    is_old_ = with_faces_around(is_old_);
  }

  /// The mesh that was tested last, and what was found.
  struct Tested
  {
    std::vector<Index> corners;
    std::vector<Vector_3> points;
    std::vector<Face_pair> pairs;
  };

  /// The input, and how far it may be left at each of its triangles.
  struct Gaps
  {
    Triangle_tree tree;
    std::vector<double> bounds;
  };

  /// The marks, and all faces with a vertex of a marked one.
  std::vector<std::uint8_t> with_faces_around(const std::vector<std::uint8_t>& marks) const
  {
    std::vector<std::uint8_t> is_near(mesh_.number_of_vertices(), 0), result(marks.size(), 0);
    for (std::size_t h = 0; h < mesh_.number_of_halfedges(); ++h)
      if (marks[h / 3] != 0) is_near[mesh_.corner[h]] = 1;
    for (std::size_t h = 0; h < mesh_.number_of_halfedges(); ++h)
      if (is_near[mesh_.corner[h]] != 0) result[h / 3] = 1;
    return result;
  }

  template <class Surface>
  bool is_above_old(const Surface& surface, Index f) const
  {
    const std::vector<Index> below = input_faces_near(surface, f);
    return std::any_of(below.begin(), below.end(), [&](Index face) { return is_old_[face] != 0; });
  }

  /// About how far the face `f` of `surface` is away from the input, at most. `near` is a face of that.
  template <class Surface>
  double distance_from_input(const Surface& surface, Index f, Index near) const
  {
    const Triangle_points t = corners_from(surface.mesh, surface.points, 3 * f);
    double largest = 0;
    for (const Vector_3& p : {Vector_3((t[0] + t[1] + t[2]) / 3), Vector_3((t[0] + t[1]) / 2),
                              Vector_3((t[1] + t[2]) / 2), Vector_3((t[2] + t[0]) / 2), t[0], t[1], t[2]})
      largest = (std::max)(largest, gaps_->tree.nearest(p, gaps_->tree.place(near)).squared_distance);
    return std::sqrt(largest);
  }

  /// The factor of each face of `pairs`; 1 for others.
  template <class Execution, class Surface>
  std::vector<double> factors_of_faces(const Execution& execution, const Surface& surface,
                                       const std::vector<Face_pair>& pairs) const
  {
    std::vector<double> factors(surface.mesh.number_of_faces(), 1);
    const std::vector<Index> faces = faces_of(pairs);
    for_each_index(execution, faces.size(), [&](std::size_t i) { factors[faces[i]] = size_factor(surface, faces[i]); },
                   heavy_chunk_length);
    return factors;
  }

  /// Each once.
  static std::vector<Index> faces_of(const std::vector<Face_pair>& pairs)
  {
    std::vector<Index> faces;
    for (const Face_pair& pair : pairs) faces.insert(faces.end(), pair.begin(), pair.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  /// What the edges of the face `f` of `surface` are to be multiplied with so that it comes as near to the input as it
  /// should; 0 if the facets of the input below are mostly too coarse for that themselves.
  template <class Surface>
  double size_factor(const Surface& surface, Index f) const
  {
    double least = infinity;
    std::size_t number_of_coarse = 0;
    const std::vector<Index> below = input_faces_near(surface, f);
    for (const Index face : below) {
      const double bound = gaps_->bounds[gaps_->tree.place(face)];
      least = (std::min)(least, bound);
      if (bulge(surface.reference().mesh, face) > largest_bulge * bound) ++number_of_coarse;
    }
    return 2 * number_of_coarse > below.size() ? 0 : std::sqrt(least / distance_from_input(surface, f, below[0]));
  }

  /// About how far a smooth surface through the corners of the face `f` of the input may bulge, by the angles with the faces
  /// beside it. `mesh` has the features of the input.
  double bulge(const Mesh_view& mesh, Index f) const
  {
    double largest = 0;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (mesh.is_border(h) || mesh.is_feature(h)) continue;
      const Vector_3 n = face_normal(mesh, points_, h).normalized();
      const Vector_3 behind = points_[mesh.apex(mesh.twin[h])] - points_[mesh.source(h)];
      largest = (std::max)(largest, std::abs(n.dot(behind)) / 8);
    }
    return largest;
  }

  static constexpr double largest_bulge = 2; // of the input where sizes can part faces, in bounds of the distance

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  const Mesh_view& mesh_;
  const std::vector<Vector_3>& points_;
  const Surroundings& surroundings_;
  std::vector<std::uint8_t> is_old_;  // each face of the input that meets another one, and those around; empty: not known
  bool has_old_ = false;              // whether there is any
  std::vector<std::uint8_t> is_kept_; // each face of the input that has to stay
  Tested tested_;
  std::optional<Gaps> gaps_; // once they are needed
  int attempts_ = 0;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_SELF_INTERSECTION_GUARD_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounds at points of space that grow with the distance from these: sizes that are asked for at a few places, with the
// gradation around them.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADED_BOUNDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADED_BOUNDS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The largest function that is at most `value` at each of some points, and grows by no more than `slope` times the
/// distance from it. Distances are those of space: where the surface comes near to itself, bounds reach across.
class Graded_bounds
{
public:
  struct Source
  {
    Vector_3 point;
    double value;
    double slope;

    double at(double distance) const { return value + slope * distance; }
  };

  Graded_bounds() = default; ///< no bound

  /// \par Complexity
  /// O(n log n)
  template <class Execution>
  Graded_bounds(const Execution& execution, std::vector<Source> sources) : sources_(std::move(sources))
  {
    if (sources_.empty()) return;
    std::vector<Vector_3> points(sources_.size());
    for_each_index(execution, points.size(), [&](std::size_t i) { points[i] = sources_[i].point; });
    internal::reorder(execution, internal::hilbert_order(execution, points), 1, sources_);
    build(execution);
    drop_idle(execution); // few of those from several corrections at one place are left
    build(execution);
  }

  bool empty() const { return sources_.empty(); }

  /// Those that matter: none lies above the bound that others set.
  const std::vector<Source>& sources() const { return sources_; }

  /// The bound at `p`, if it is below `limit`, or that. Near O(log n) where few sources matter.
  double least(const Vector_3& p, double limit) const
  {
    return least(p, limit, std::numeric_limits<double>::infinity());
  }

private:
  struct Place
  {
    std::size_t level, index;
  };

  /// The same by sources with no more than this slope.
  double least(const Vector_3& p, double limit, double max_slope) const
  {
    if (sources_.empty()) return limit;
    boost::container::static_vector<Place, 64> stack{{levels_.size() - 1, 0}};
    while (!stack.empty()) {
      const Place at = stack.back();
      stack.pop_back();
      if (levels_[at.level][at.index].least(p) >= limit) continue;
      if (at.level == 0) limit = least_of_leaf(at.index, p, limit, max_slope);
      else push_children(at, p, stack);
    }
    return limit;
  }

  /// Some sources: the box around them, their least value and least slope.
  struct Group
  {
    Vector_3 low, high;
    double value, slope;

    Group() = default;
    explicit Group(const Source& s) : low(s.point), high(s.point), value(s.value), slope(s.slope) {}

    void add(const Group& other)
    {
      low = low.cwiseMin(other.low);
      high = high.cwiseMax(other.high);
      value = (std::min)(value, other.value);
      slope = (std::min)(slope, other.slope);
    }

    double least(const Vector_3& p) const
    {
      return value + slope * (low - p).cwiseMax(p - high).cwiseMax(0.0).norm();
    }
  };

  /// The lower one last, from where the search goes on.
  template <class Stack>
  void push_children(const Place& at, const Vector_3& p, Stack& stack) const
  {
    const std::vector<Group>& below = levels_[at.level - 1];
    const std::size_t i = 2 * at.index, j = (std::min)(i + 1, below.size() - 1);
    const bool is_first_lower = below[i].least(p) < below[j].least(p);
    if (i != j) stack.push_back({at.level - 1, is_first_lower ? j : i});
    stack.push_back({at.level - 1, is_first_lower ? i : j});
  }

  static constexpr std::size_t leaf_size = 4;

  template <class Execution>
  void build(const Execution& execution)
  {
    levels_.clear();
    add_level(execution, sources_, leaf_size);
    while (levels_.back().size() > 1) add_level(execution, levels_.back(), 2);
  }

  /// Drops sources that lie above the bound of others, with all that they bound.
  template <class Execution>
  void drop_idle(const Execution& execution)
  {
    std::vector<Source> kept;
    for (const Index i : pack(execution, sources_.size(), [&](std::size_t j) {
           return !(least(sources_[j].point, sources_[j].value, sources_[j].slope) < sources_[j].value);
         }))
      kept.push_back(sources_[i]);
    sources_.swap(kept);
  }

  /// Groups `n` consecutive ones of what is below each.
  template <class Execution, class Below>
  void add_level(const Execution& execution, const std::vector<Below>& below, std::size_t n)
  {
    std::vector<Group> level((below.size() + n - 1) / n);
    for_each_index(execution, level.size(), [&](std::size_t i) {
      level[i] = Group(below[n * i]);
      for (std::size_t j = n * i + 1; j < (std::min)(n * (i + 1), below.size()); ++j) level[i].add(Group(below[j]));
    });
    levels_.push_back(std::move(level));
  }

  double least_of_leaf(std::size_t leaf, const Vector_3& p, double limit, double max_slope) const
  {
    for (std::size_t i = leaf_size * leaf; i < (std::min)(leaf_size * (leaf + 1), sources_.size()); ++i)
      if (sources_[i].slope <= max_slope) limit = (std::min)(limit, sources_[i].at((sources_[i].point - p).norm()));
    return limit;
  }

  std::vector<Source> sources_;
  std::vector<std::vector<Group>> levels_; // the last one has a single group
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADED_BOUNDS_H

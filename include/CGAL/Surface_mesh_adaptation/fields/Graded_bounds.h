// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounds at points of space that grow with the distance from these: sizes that are asked for at a few places, with the
// gradation around them.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADED_BOUNDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADED_BOUNDS_H

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>

#include <Eigen/Core>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
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
    return least(p, limit, infinity);
  }

private:
  static constexpr std::size_t width = 8;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  using Row = Eigen::Array<double, int(width), 1>;

  /// Some boxes side by side, with the least value and slope of the sources inside; those of no source are nowhere.
  struct Block
  {
    std::array<Row, 3> low, high;
    Row value = Row::Constant(infinity), slope = Row::Constant(infinity);

    Block()
    {
      low.fill(Row::Constant(infinity));
      high.fill(Row::Constant(-infinity));
    }

    void set(std::size_t i, const Source& s)
    {
      for (int k = 0; k < 3; ++k) low[k][i] = high[k][i] = s.point[k];
      value[i] = s.value;
      slope[i] = s.slope;
    }

    /// The box around those of `block`.
    void set(std::size_t i, const Block& block)
    {
      for (int k = 0; k < 3; ++k) {
        low[k][i] = block.low[k].minCoeff();
        high[k][i] = block.high[k].maxCoeff();
      }
      value[i] = block.value.minCoeff();
      slope[i] = block.slope.minCoeff();
    }

    /// What no bound at `p` is below, for each of the boxes. All at once, for the outcome of a single one is hard to predict.
    Row least(const Vector_3& p) const
    {
      Row squared = Row::Zero();
      for (int k = 0; k < 3; ++k) squared += (low[k] - p[k]).max(p[k] - high[k]).max(0.0).square();
      return value + slope * squared.sqrt();
    }
  };

  struct Place
  {
    std::size_t level, block;
    double least; ///< of the box around it
  };

  using Stack = boost::container::static_vector<Place, 16 * width>; // far more levels than can be

  /// The same by sources with no more than this slope.
  double least(const Vector_3& p, double limit, double max_slope) const
  {
    if (sources_.empty()) return limit;
    Stack stack{{levels_.size() - 1, 0, -infinity}};
    while (!stack.empty()) {
      const Place at = stack.back();
      stack.pop_back();
      if (at.least >= limit) continue;
      const Block& block = levels_[at.level][at.block];
      const Row bounds = block.least(p);
      if (at.level > 0) push_below(at, bounds, limit, stack);
      else limit = (std::min)(limit, (block.slope <= max_slope).select(bounds, infinity).minCoeff());
    }
    return limit;
  }

  /// Those below `limit`, the lowest one last, from where the search goes on.
  static void push_below(const Place& at, const Row& bounds, double limit, Stack& stack)
  {
    std::size_t lowest = 0;
    bounds.minCoeff(&lowest);
    const auto push = [&](std::size_t i) {
      if (bounds[i] < limit) stack.push_back({at.level - 1, width * at.block + i, bounds[i]});
    };
    for (std::size_t i = 0; i < width; ++i)
      if (i != lowest) push(i);
    push(lowest);
  }

  template <class Execution>
  void build(const Execution& execution)
  {
    levels_.clear();
    add_level(execution, sources_);
    while (levels_.back().size() > 1) add_level(execution, levels_.back());
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

  /// Consecutive ones of what is `below` become a block.
  template <class Execution, class Below>
  void add_level(const Execution& execution, const std::vector<Below>& below)
  {
    std::vector<Block> level((below.size() + width - 1) / width);
    for_each_index(execution, level.size(), [&](std::size_t i) {
      for (std::size_t j = width * i; j < (std::min)(width * (i + 1), below.size()); ++j) level[i].set(j - width * i, below[j]);
    });
    levels_.push_back(std::move(level));
  }

  std::vector<Source> sources_;
  std::vector<std::vector<Block>> levels_; // the last one has a single block
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_FIELDS_GRADED_BOUNDS_H

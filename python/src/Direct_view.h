// SPDX-License-Identifier: GPL-3.0-or-later
//
// The short way from arrays to a mesh, for triangles that are an oriented surface as they are: a fifth of the time that
// the functions for soups take.

#ifndef SMA_PYTHON_DIRECT_VIEW_H
#define SMA_PYTHON_DIRECT_VIEW_H

#include "adaptation.h"

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sma_python {

/// Joins the triangles of arrays along their edges.
class Direct_view
{
public:
  using Index = CGAL::Surface_mesh_adaptation::Index;

  explicit Direct_view(const Surface_arrays& input) : input_(input) {}

  /// The view, with vertices numbered as the points; none if an index or a coordinate makes no sense, if a point has no
  /// triangle, or if an edge has more than two faces or two that look to different sides. Whether the faces around a
  /// vertex form one fan is not checked.
  std::optional<CGAL::Surface_mesh_adaptation::Mesh_view> make()
  {
    if (input_.triangles.rows() > CGAL::Surface_mesh_adaptation::max_number_of_faces || !has_finite_points() ||
        !read_corners())
      return std::nullopt;
    sort_by_source();
    if (!find_twins() || !find_outgoing()) return std::nullopt;
    return std::move(view_);
  }

private:
  bool has_finite_points() const
  {
    const Array_view<double>& p = input_.points;
    for (std::size_t i = 0; i < 3 * p.rows; ++i)
      if (!std::isfinite(p.data[i])) return false;
    return true;
  }

  /// The first corner is the last one of the array, where CGAL's functions for soups have it.
  bool read_corners()
  {
    const std::size_t nf = input_.triangles.rows();
    view_.corner.resize(3 * nf);
    for (std::size_t f = 0; f < nf; ++f) {
      poll(f);
      for (std::size_t j = 0; j < 3; ++j) {
        const std::int64_t v = input_.triangles.at(f, j);
        if (v < 0 || std::size_t(v) >= input_.points.rows) return false;
        view_.corner[3 * f + (j + 1) % 3] = Index(v);
      }
    }
    return true;
  }

  /// The halfedges that leave a vertex side by side.
  void sort_by_source()
  {
    first_.assign(input_.points.rows + 1, 0);
    for (const Index v : view_.corner) ++first_[v + 1];
    for (std::size_t v = 0; v < input_.points.rows; ++v) first_[v + 1] += first_[v];
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    leaving_.resize(view_.corner.size());
    for (std::size_t h = 0; h < view_.corner.size(); ++h) leaving_[next[view_.corner[h]]++] = Index(h);
  }

  /// To be called for every `i`.
  void poll(std::size_t i) const
  {
    constexpr std::size_t period = 1 << 16;
    if (i % period == 0) input_.poll();
  }

  /// How many halfedges lead from `v` to `w`, and the last of them.
  Index find(Index v, Index w, std::size_t& count) const
  {
    Index found = CGAL::Surface_mesh_adaptation::no_index;
    count = 0;
    for (std::size_t i = first_[v]; i < first_[v + 1]; ++i)
      if (view_.target(leaving_[i]) == w) {
        found = leaving_[i];
        ++count;
      }
    return found;
  }

  bool find_twins()
  {
    view_.twin.resize(view_.corner.size());
    for (Index h = 0; h < view_.corner.size(); ++h) {
      poll(h);
      const Index v = view_.source(h), w = view_.target(h);
      std::size_t here = 0, back = 0;
      find(v, w, here);
      view_.twin[h] = find(w, v, back);
      if (v == w || here > 1 || back > 1) return false;
    }
    return true;
  }

  /// Inside, that of the last face around, which CGAL's functions for soups choose, too.
  bool find_outgoing()
  {
    view_.outgoing.resize(input_.points.rows);
    for (std::size_t v = 0; v < input_.points.rows; ++v) {
      if (first_[v] == first_[v + 1]) return false;
      view_.outgoing[v] = leaving_[first_[v + 1] - 1];
      for (std::size_t i = first_[v]; i < first_[v + 1]; ++i)
        if (view_.is_border(leaving_[i])) view_.outgoing[v] = leaving_[i];
    }
    return true;
  }

  const Surface_arrays& input_;
  CGAL::Surface_mesh_adaptation::Mesh_view view_;
  std::vector<Index> first_;   // of the halfedges that leave each vertex, in `leaving_`
  std::vector<Index> leaving_;
};

} // namespace sma_python

#endif // SMA_PYTHON_DIRECT_VIEW_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The short way from arrays to a mesh, for triangles that are an oriented surface as they are: a fifth of the time that
// the functions for soups take.

#ifndef SMA_PYTHON_DIRECT_VIEW_H
#define SMA_PYTHON_DIRECT_VIEW_H

#include "adaptation.h"

#include <CGAL/Surface_mesh_adaptation/mesh/Mesh_view.h>
#include <CGAL/Surface_mesh_adaptation/mesh/join_triangles.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

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
    if (!CGAL::Surface_mesh_adaptation::internal::join_triangles(view_, input_.points.rows, [&] { input_.poll(); }))
      return std::nullopt;
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

  /// To be called for every `i`.
  void poll(std::size_t i) const
  {
    constexpr std::size_t period = 1 << 16;
    if (i % period == 0) input_.poll();
  }

  const Surface_arrays& input_;
  CGAL::Surface_mesh_adaptation::Mesh_view view_;
};

} // namespace sma_python

#endif // SMA_PYTHON_DIRECT_VIEW_H

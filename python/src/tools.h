// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels are made of, for whole arrays.

#ifndef SMA_PYTHON_TOOLS_H
#define SMA_PYTHON_TOOLS_H

#include "Array_view.h"
#include "adaptation.h"

#include <cstdint>
#include <vector>

namespace sma_python {

/// At the points of the input; zero at those that no triangle uses.
struct Jets
{
  std::vector<double> normals;         ///< n x 3
  std::vector<double> shape_operators; ///< n x 9
};

struct Hessians
{
  std::vector<double> tensors;     ///< n x 9
  std::vector<double> unexplained; ///< n
};

struct Places
{
  std::vector<double> points;     ///< k x 3
  std::vector<double> normals;    ///< k x 3
  std::vector<std::int64_t> faces; ///< k
  std::vector<std::uint8_t> is_on_border; ///< k
};

/// A metric over a surface: sizes or tensors of `Options`.
struct Metric_size
{
  double area = 0, boundary_length = 0, vertices = 0;
};

// The options that count are the execution, those of the features, and the metric.

Jets estimate_jets(const Surface_arrays&, const Options&);
Hessians estimate_hessians(const Surface_arrays&, const Options&, const Array_view<double>& values);

/// The sizes or tensors with the gradation of the options, row by row.
std::vector<double> graded(const Surface_arrays&, const Options&);
/// The sizes or tensors scaled to the number of vertices of the options, within their bounds.
std::vector<double> scaled(const Surface_arrays&, const Options&);
Metric_size measured(const Surface_arrays&, const Options&);

/// Of tensors, row by row. \throws Invalid_metric_error
/// @{
std::vector<double> intersected(const Array_view<double>& a, const Array_view<double>& b);
std::vector<double> bounded(const Array_view<double>& tensors, double hmin, double hmax);
void check_tensors(const Array_view<double>& tensors);
/// @}

/// The ends of the geodesics that leave `vertices` (k) with the `vectors` (k x 3), which are laid into the tangent
/// planes; they stop at the faces around.
Places exponential_map(const Surface_arrays&, const Options&, const Index_view& vertices,
                       const Array_view<double>& vectors);
/// The smooth surface over `faces` (k) at the barycentric coordinates `weights` (k x 3).
Places surface_points(const Surface_arrays&, const Options&, const Index_view& faces,
                      const Array_view<double>& weights);

} // namespace sma_python

#endif // SMA_PYTHON_TOOLS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the module asks of the library, in arrays and numbers: nothing here knows Python, nothing here is a template.

#ifndef SMA_PYTHON_ADAPTATION_H
#define SMA_PYTHON_ADAPTATION_H

#include "Array_view.h"

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sma_python {

/// Thrown by `Events` to give a run up; nothing is returned then.
struct Cancelled
{};

/// Points and triangles as the user has them, and what is done to them where they are no valid surface.
struct Surface_arrays
{
  Array_view<double> points;       ///< n x 3
  Index_view triangles;            ///< m x 3
  bool weld = false;               ///< join coincident points along seams
  bool repair = false;             ///< mend what is no valid surface
  Array_view<std::uint8_t> constrained_vertices; ///< n, or empty
  Index_view constrained_edges;    ///< k x 2
  Index_view protected_edges;      ///< k x 2
  Array_view<std::uint8_t> protected_faces; ///< m, or empty: whether the edges of each triangle are protected
  Array_view<std::uint8_t> selected_faces;  ///< m, or empty: the triangles that are adapted
  Array_view<std::int32_t> labels; ///< m, or empty
  Array_view<double> size_bounds;  ///< m x 2, or empty; 0: no bound
  Array_view<double> corner_values; ///< m x 3k, or empty: k numbers at each corner
  std::function<void()> poll = [] {}; ///< called now and then while they are read; may throw
};

/// How to run: `execution` is a name, or empty for the best policy; 0 threads are as many as possible.
struct Execution_choice
{
  std::string name;
  int threads = 0;
};

/// All that the functions of the library can be asked for. Numbers are 0 where they are not given.
struct Options
{
  Execution_choice execution;
  // what to adapt to
  double size = 0;
  double curvature = 0;            ///< relative tolerance
  Array_view<double> sizes;        ///< n, or empty
  Array_view<double> tensors;      ///< n x 9, or empty
  Array_view<double> field;        ///< n, or empty
  std::size_t vertices = 0;
  bool anisotropic = false;
  double max_anisotropy = 0;
  bool noisy = false;
  double norm = 0;
  double gradation = 0;
  double hmin = 0;
  double hmax = 0;
  // features
  bool detect_features = true;
  double feature_angle = 0;
  bool smooth_borders = false;
  // the surface
  bool flat = false;
  bool fit = false;
  bool avoid_self_intersections = false;
  bool count_self_intersections = false;
  double shape_weight = 0;
  double protected_gradation = -1; ///< negative if not given
  bool wants_face_origin = false;
  double tolerance = 0;            ///< as a fraction of the diagonal of the bounding box
  Array_view<double> normals;         ///< n x 3, or empty
  Array_view<double> shape_operators; ///< n x 9, or empty
  // the run
  std::optional<unsigned> iterations;
  std::size_t max_vertices = std::size_t(-1);
  double max_normal_deviation = 0;
  double max_distance = 0;
};

/// Follows a run, on the thread that began it. What it throws passes through.
class Events
{
public:
  virtual ~Events() = default;
  virtual void round_begins(std::size_t round, std::size_t rounds) = 0;
  virtual void kernel_done(const CGAL::Surface_mesh_adaptation::Kernel_report&) = 0;
  virtual void round_done(std::size_t round, const CGAL::Surface_mesh_adaptation::Mesh_statistics&) = 0;
  virtual bool go_on() = 0;
};

/// The adapted surface, row by row.
struct Outcome
{
  std::vector<double> points;             ///< n x 3
  std::vector<std::int64_t> triangles;    ///< m x 3
  std::vector<double> metric;             ///< n x 9
  std::vector<std::int32_t> source_points; ///< n x 3: points of the input that each vertex lies between
  std::vector<double> source_weights;     ///< n x 3
  std::vector<std::int64_t> feature_edges; ///< k x 2
  std::vector<std::int64_t> protected_edges; ///< k x 2
  std::vector<std::int64_t> vertex_origin; ///< n: the point of the input that a vertex was, or -1
  std::vector<std::int64_t> face_origin;   ///< m, if wanted: the triangle of the input below the centre
  std::vector<std::int32_t> labels;        ///< m, if there are any
  std::vector<double> corner_values;       ///< m x 3k, if there are any
  std::vector<std::int64_t> constrained_vertices;
  std::vector<double> normals;            ///< n x 3, if normals or shape operators were given
  std::vector<double> shape_operators;    ///< n x 9, the same
  std::vector<std::string> repairs, warnings; ///< of the input
  std::string report;                     ///< as JSON, of a whole adaptation
  std::size_t operations = 0;             ///< of a kernel alone
  double seconds = 0;                     ///< that the library took
};

/// Runs `kernel`: adapt, refine, simplify, swap, regularize or relocate.
/// \throws Adaptation_error
/// @{
Outcome run_on_patches(const std::string& kernel, const Surface_arrays&, const Options&, Events&);
Outcome run_on_triangles(const std::string& kernel, const Surface_arrays&, const Options&, Events&);
/// @}

} // namespace sma_python

#endif // SMA_PYTHON_ADAPTATION_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run did and what it reached: the source of every table of the documentation.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_ADAPTATION_REPORT_H
#define CGAL_SURFACE_MESH_ADAPTATION_ADAPTATION_REPORT_H

#include <array>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationReports
/// @{

/// Size, conformity and quality of a mesh with respect to a metric field.
struct Mesh_statistics
{
  std::size_t vertices = 0;  ///< number of vertices
  std::size_t edges = 0;  ///< number of edges
  std::size_t faces = 0;  ///< number of faces
  double in_range = 0;             ///< share of the edges with a metric length in `[1/sqrt 2, sqrt 2]`
  double mean_length = 0;          ///< mean metric length of the edges
  double mean_quality = 0;         ///< mean of `4 sqrt 3 area / sum of squared lengths`, in the metric: 1 is best
  double min_quality = 0;  ///< of the worst face
  double min_angle = 0;            ///< smallest angle of a face in space, in degrees
  std::array<std::size_t, 10> quality_histogram{}; ///< faces with a quality in `[i/10, (i + 1)/10)`
  std::array<std::size_t, 10> length_histogram{};  ///< edges with a metric length in `[i/5, (i + 1)/5)`, last: above
};

/// One call of a kernel.
struct Kernel_report
{
  std::string kernel;              ///< "refine", "simplify", "swap", "regularize", "relocate", "fit" or "mend"
  std::size_t round = 0;  ///< from 0
  std::size_t sweeps = 0;  ///< how often it went through the mesh
  std::size_t candidates = 0;      ///< elements that were examined
  std::size_t applied = 0;         ///< edges split, vertices removed, edges swapped, vertices moved
  std::size_t deferred = 0;        ///< candidates that straddled two blocks and went through claims or colours
  double seconds = 0;  ///< time that it took
};

/// Pairs of faces that intersect, as `self_intersections` of Polygon Mesh Processing counts them.
struct Self_intersection_counts
{
  bool are_counted = false;  ///< only on request: else the numbers are 0
  std::size_t before = 0;    ///< of the input
  std::size_t after = 0;     ///< of the output
  double seconds = 0;        ///< time that counting took
};

/// What `adapt_surface_mesh` returns.
struct Adaptation_report
{
  std::string execution;           ///< name of the execution policy
  int threads = 1;  ///< the largest number of tasks at the same time
  Mesh_statistics initial;         ///< the input in the metric asked for
  Mesh_statistics final;           ///< the output in the same metric, tightened where its faces left the surface
  std::size_t rounds = 0;          ///< rounds done
  bool stopped = false;            ///< by the visitor
  std::vector<std::string> repairs; ///< what was mended in the input before, one sentence each
  std::vector<std::string> warnings; ///< what was asked for and not reached, one sentence each
  std::size_t fallback_patches = 0; ///< faces of the input over which the surface is less smooth than elsewhere
  std::vector<Kernel_report> kernels;  ///< what each kernel did in each round, in order
  std::vector<Mesh_statistics> after_round; ///< in its metric: scaled, where a number of vertices was missed
  double tolerance = 0;            ///< largest distance allowed between input and output; 0: none was asked for
  double certified_distance = 0;   ///< if one was: an upper bound of their Hausdorff distance, by 2 % of it too large
                                   ///< at most
  double deviation = 0;            ///< with the tolerance of a `Curvature_metric_field`: largest distance from the surface
                                   ///< at some places of each face, with `Flat_reconstruction` at all, and of the
                                   ///< surface from the faces at vertices and edges of the input. Over faces with one
                                   ///< of their own (`face_deviation_map`) it is in proportion to that; what is within
                                   ///< nine tenths of the tolerance may be larger
  Self_intersection_counts self_intersections; ///< of the input and the output
  double seconds = 0;  ///< time of the kernels, with all that was done again

  /// Writes the report as one JSON object.
  void write_json(std::ostream& out) const;
};

namespace internal {

template <class Container, class Write>
void write_json_list(std::ostream& out, const Container& items, const Write& write)
{
  out << '[';
  const char* separator = "";
  for (const auto& item : items) {
    out << separator;
    write(item);
    separator = ", ";
  }
  out << ']';
}

/// A string of JSON: quoted, and escaped where it has to be.
inline void write_json(std::ostream& out, const std::string& text)
{
  out << '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') out << '\\' << c;
    else if (static_cast<unsigned char>(c) < 0x20) out << ' ';
    else out << c;
  }
  out << '"';
}

inline void write_json(std::ostream& out, const Mesh_statistics& s)
{
  const auto number = [&](std::size_t n) { out << n; };
  out << "{\"vertices\": " << s.vertices << ", \"edges\": " << s.edges << ", \"faces\": " << s.faces
      << ", \"in_range\": " << s.in_range << ", \"mean_length\": " << s.mean_length
      << ", \"mean_quality\": " << s.mean_quality << ", \"min_quality\": " << s.min_quality
      << ", \"min_angle\": " << s.min_angle << ", \"quality_histogram\": ";
  write_json_list(out, s.quality_histogram, number);
  out << ", \"length_histogram\": ";
  write_json_list(out, s.length_histogram, number);
  out << '}';
}

inline void write_json(std::ostream& out, const Kernel_report& k)
{
  out << "\n    {\"kernel\": \"" << k.kernel << "\", \"round\": " << k.round << ", \"sweeps\": " << k.sweeps
      << ", \"candidates\": " << k.candidates << ", \"applied\": " << k.applied << ", \"deferred\": " << k.deferred
      << ", \"seconds\": " << k.seconds << '}';
}

} // namespace internal

inline void Adaptation_report::write_json(std::ostream& out) const
{
  out << "{\n  \"execution\": \"" << execution << "\", \"threads\": " << threads << ", \"rounds\": " << rounds
      << ", \"stopped\": " << (stopped ? "true" : "false")
      << ", \"fallback_patches\": " << fallback_patches << ", \"seconds\": " << seconds << ",\n  \"initial\": ";
  internal::write_json(out, initial);
  out << ",\n  \"final\": ";
  internal::write_json(out, final);
  if (tolerance > 0)
    out << ",\n  \"tolerance\": " << tolerance << ", \"certified_distance\": " << certified_distance;
  if (deviation > 0) out << ",\n  \"deviation\": " << deviation;
  if (self_intersections.are_counted)
    out << ",\n  \"self_intersections\": {\"before\": " << self_intersections.before
        << ", \"after\": " << self_intersections.after << ", \"seconds\": " << self_intersections.seconds << '}';
  const auto sentence = [&](const std::string& s) { internal::write_json(out, s); };
  out << ",\n  \"repairs\": ";
  internal::write_json_list(out, repairs, sentence);
  out << ",\n  \"warnings\": ";
  internal::write_json_list(out, warnings, sentence);
  out << ",\n  \"after_round\": ";
  internal::write_json_list(out, after_round, [&](const Mesh_statistics& s) {
    out << "\n    ";
    internal::write_json(out, s);
  });
  out << ",\n  \"kernels\": ";
  internal::write_json_list(out, kernels, [&](const Kernel_report& k) { internal::write_json(out, k); });
  out << "\n}\n";
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_ADAPTATION_REPORT_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_SUMMARY_H
#define ADAPT_MESH_SUMMARY_H

#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>

#include <cstdio>
#include <string>

namespace adapt_mesh {

/// Prints what was reached, on stdout; `distance` is that between samples of input and output.
inline void print_summary(const SMA::Adaptation_report& report, double distance, double diagonal)
{
  const SMA::Mesh_statistics& before = report.initial;
  const SMA::Mesh_statistics& after = report.final;
  std::printf("vertices  %zu -> %zu\n", before.vertices, after.vertices);
  std::printf("in range  %.2f %% -> %.2f %% of the edges\n", 100 * before.in_range, 100 * after.in_range);
  std::printf("quality   %.3f -> %.3f mean, %.3f -> %.3f worst; smallest angle %.1f degrees\n", before.mean_quality,
              after.mean_quality, before.min_quality, after.min_quality, after.min_angle);
  std::printf("distance  %.3g, %.3g of the diagonal (sampled)\n", distance, distance / diagonal);
  if (report.deviation > 0)
    std::printf("deviation %.3g, %.3g of the diagonal: of the faces from the surface, at a few places\n", report.deviation,
                report.deviation / diagonal);
  if (report.tolerance > 0)
    std::printf("certified %.3g, %.3g of the tolerance\n", report.certified_distance,
                report.certified_distance / report.tolerance);
  const SMA::Self_intersection_counts& intersections = report.self_intersections;
  if (intersections.are_counted)
    std::printf("intersect %zu -> %zu pairs of faces (counted in %.2g s)\n", intersections.before, intersections.after,
                intersections.seconds);
  std::printf("time      %.3g s, %s, %d thread%s\n", report.seconds, report.execution.c_str(), report.threads,
              report.threads == 1 ? "" : "s");
  for (const std::string& sentence : report.repairs) std::printf("repaired  %s\n", sentence.c_str());
}

/// Prints what a user may not expect, on stderr.
inline void print_warnings(const SMA::Adaptation_report& report)
{
  for (const std::string& sentence : report.warnings)
    std::fprintf(stderr, "adapt_mesh: warning: %s\n", sentence.c_str());
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_SUMMARY_H

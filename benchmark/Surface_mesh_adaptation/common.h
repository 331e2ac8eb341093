// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the benchmark programs share: meshes of CGAL's data, clocks and memory.

#ifndef BENCHMARK_SURFACE_MESH_ADAPTATION_COMMON_H
#define BENCHMARK_SURFACE_MESH_ADAPTATION_COMMON_H

#include <CGAL/surface_mesh_adaptation.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>

namespace bench {

namespace SMA = CGAL::Surface_mesh_adaptation;
using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// \throws std::runtime_error if CGAL's data has no such mesh
inline Mesh read_mesh(const std::string& name)
{
  Mesh mesh;
  const std::string file = CGAL::data_file_path("meshes/" + name + ".off");
  if (!CGAL::IO::read_polygon_mesh(file, mesh)) throw std::runtime_error(file + " cannot be read");
  return mesh;
}

inline double mean_edge_length(const Mesh& mesh)
{
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / double(mesh.number_of_edges());
}

/// Four times as long in a direction that turns along the axis as across it.
inline SMA::Metric_tensor_3 turning_tensor(const SMA::Vector_3& p, double size, double period)
{
  const double angle = p[1] / period;
  const SMA::Vector_3 along(std::cos(angle), 0, std::sin(angle));
  const double across_value = 1 / (size * size), along_value = across_value / 16;
  SMA::Matrix_3 axes;
  axes.col(0) = along;
  axes.col(1) = SMA::Vector_3(0, 1, 0);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return SMA::metric_tensor(SMA::Vector_3(along_value, across_value, across_value), axes);
}

inline auto turning_field(double size, double period)
{
  return SMA::Analytic_metric_field([=](const SMA::Vector_3& p) { return turning_tensor(p, size, period); });
}

/// Seconds of all threads of this program together: what other programs take meanwhile does not count.
inline double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

inline double wall_seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A line of /proc/self/status in bytes, "VmRSS" or its peak "VmHWM"; 0 where there is none.
inline std::size_t memory(const std::string& line)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == line + ":") {
      std::size_t kibibytes = 0;
      status >> kibibytes;
      return 1024 * kibibytes;
    }
  return 0;
}

/// Lets "VmHWM" start anew from "VmRSS".
inline void forget_peak_of_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

} // namespace bench

#endif // BENCHMARK_SURFACE_MESH_ADAPTATION_COMMON_H

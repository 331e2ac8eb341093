// SPDX-License-Identifier: GPL-3.0-or-later
//
// A metric of one's own: a function object that returns a tensor for a point. Here faces are long along a circle on the
// sphere and thin across it, as a front that moves would need them.

#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace SMA = CGAL::Surface_mesh_adaptation;
using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

//! [metric]
/// Size 0.1 everywhere, but 0.01 across the circle z = 0.3, and ever more so towards it.
SMA::Metric_tensor_3 front_metric(const SMA::Vector_3& p)
{
  const double along = 0.1, across = std::min(along, 0.01 + 0.3 * std::abs(p.z() - 0.3));
  const SMA::Vector_3 normal = p.normalized();
  const SMA::Vector_3 gradient = SMA::Vector_3::UnitZ() - normal.z() * normal; // of z on the sphere
  const double steepness = gradient.norm();
  if (steepness < 1e-6) return SMA::Metric_tensor_3::isotropic(along); // at the poles
  const SMA::Vector_3 d = gradient / steepness;
  const double l = 1 / (along * along), k = 1 / (across * across);
  return SMA::Metric_tensor_3(SMA::Matrix_3(l * SMA::Matrix_3::Identity() + (k - l) * d * d.transpose()));
}
//! [metric]

int main()
{
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Point>(mesh);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(4));
  for (const auto v : vertices(mesh)) { // onto the unit sphere
    const auto r = mesh.point(v) - CGAL::ORIGIN;
    mesh.point(v) = CGAL::ORIGIN + r / std::sqrt(r.squared_length());
  }

  //! [field]
  const SMA::Analytic_metric_field field(front_metric);
  const SMA::Adaptation_report report = SMA::adapt_surface_mesh(mesh, field);
  //! [field]
  std::cout << report.final.vertices << " vertices; in the metric, " << 100 * report.final.in_range
            << " % of the edges have the length asked for and the mean quality is " << report.final.mean_quality
            << "; in space, the smallest angle is " << report.final.min_angle << " degrees\n";
  return CGAL::IO::write_polygon_mesh("user_metric.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}

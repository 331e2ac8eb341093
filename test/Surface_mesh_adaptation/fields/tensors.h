// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of metrics share: references of soups, and tensors of all kinds.

#ifndef TEST_SURFACE_MESH_ADAPTATION_FIELDS_TENSORS_H
#define TEST_SURFACE_MESH_ADAPTATION_FIELDS_TENSORS_H

#include "random_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/hessian.h>
#include <CGAL/Surface_mesh_adaptation/metric/metric.h>
#include <CGAL/Surface_mesh_adaptation/surface/Reference_surface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tensors_of_tests {

namespace SMA = CGAL::Surface_mesh_adaptation;
using shapes::Index;
using shapes::pi;
using shapes::Random;
using shapes::Soup;
using SMA::Matrix_3;
using SMA::Metric_tensor_3;
using SMA::Vector_3;
using Reference = SMA::Reference_surface<SMA::Gregory_reconstruction>;
using Tensors = std::vector<Metric_tensor_3>;

inline const SMA::Sequential_execution sequential;
inline const Metric_tensor_3 zero(0, 0, 0, 0, 0, 0);
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline Reference reference(const Soup& soup, bool detect_ridges = true)
{
  SMA::Feature_parameters p;
  p.detect_ridges = detect_ridges;
  return Reference(sequential, shapes::view(soup), soup.points, p);
}

inline Matrix_3 random_rotation(Random& random)
{
  const double angle = random.real(0, pi);
  return Eigen::AngleAxisd(angle, random.vector().normalized()).toRotationMatrix();
}

inline Metric_tensor_3 random_metric(Random& random, double ratio)
{
  const double l = std::log(ratio), a = random.real(-l, l), b = random.real(-l, l), c = random.real(-l, l);
  return SMA::metric_tensor(Vector_3(std::exp(a), std::exp(b), std::exp(c)), random_rotation(random));
}

inline double distance(const Metric_tensor_3& a, const Metric_tensor_3& b) { return (a.matrix() - b.matrix()).norm(); }
inline double norm(const Metric_tensor_3& m) { return m.matrix().norm(); }

template <class Execution = SMA::Sequential_execution>
Tensors hessians(const Reference& r, const SMA::Corner_jets& jets, const std::vector<double>& values,
                 const Execution& execution = {})
{
  Tensors tensors;
  for (const SMA::Hessian_estimate& h : SMA::estimate_hessians(execution, r.mesh, r.points, jets, values))
    tensors.push_back(h.tensor);
  return tensors;
}

inline double largest_size(const std::vector<double>& sizes) { return *std::max_element(sizes.begin(), sizes.end()); }
inline double smallest_size(const std::vector<double>& sizes) { return *std::min_element(sizes.begin(), sizes.end()); }

inline double largest_size(const Tensors& tensors)
{
  double l = infinity;
  for (const Metric_tensor_3& m : tensors) l = (std::min)(l, SMA::eigen_decomposition(m).values[0]);
  return 1 / std::sqrt(l);
}

inline double smallest_size(const Tensors& tensors)
{
  double l = 0;
  for (const Metric_tensor_3& m : tensors) l = (std::max)(l, SMA::eigen_decomposition(m).values[2]);
  return 1 / std::sqrt(l);
}

} // namespace tensors_of_tests

#endif // TEST_SURFACE_MESH_ADAPTATION_FIELDS_TENSORS_H

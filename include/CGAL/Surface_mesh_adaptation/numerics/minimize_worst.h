// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimises the largest of a few smooth functions of two variables, such as the distortions of the faces around a
// vertex (paper, section 3, "optimization", equations 2 and 3).
//
// A step along the gradient of the worst function alone, as in equation 2, is stopped by the next worst one: the
// largest function has kinks, and its minimum lies in one of them. So each round replaces the functions by their linear
// expansions and solves for the minimum of their maximum within a trust region, a linear programme in three variables.
// Accepted is what lowers the largest function by a share of what the expansion promised (Armijo's condition on the
// maximum, which the linear programme makes a descent direction for).

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_MINIMIZE_WORST_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_MINIMIZE_WORST_H

#include <CGAL/Surface_mesh_adaptation/numerics/Ring.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationGeometry
/// @{

/// A vector of the plane.
using Vector_2 = Eigen::Vector2d;

/// `d -> value + gradient . d`
struct Linear_function_2
{
  double value;  ///< at the origin
  Vector_2 gradient;  ///< everywhere

  double operator()(const Vector_2& d) const { return value + gradient.dot(d); }  ///< the value at `d`
};

/// The largest of the functions at `d`. \pre there is one
inline double maximum(const Ring<Linear_function_2>& functions, const Vector_2& d)
{
  double largest = functions[0](d);
  for (const Linear_function_2& f : functions) largest = (std::max)(largest, f(d));
  return largest;
}

namespace internal {

/// The points `x` with `normal . x <= bound`.
struct Half_plane
{
  Vector_2 normal;
  double bound;
};

/// The minimum of `c . x` on the border of `half_planes[k]` within those before it.
inline Vector_2 minimum_on_line(const Vector_2& c, const Ring<Half_plane>& half_planes, std::size_t k)
{
  const Half_plane& line = half_planes[k];
  const Vector_2 start = line.bound / line.normal.squaredNorm() * line.normal;
  const Vector_2 direction(-line.normal.y(), line.normal.x());
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < k; ++i) {
    const double slope = half_planes[i].normal.dot(direction);
    const double room = half_planes[i].bound - half_planes[i].normal.dot(start);
    if (slope > 0) high = (std::min)(high, room / slope);
    if (slope < 0) low = (std::max)(low, room / slope);
  }
  if (low > high) low = high = 0.5 * (low + high); // by rounding
  return start + (c.dot(direction) > 0 ? low : high) * direction;
}

/// The minimum of `c . x` in the intersection of the half-planes, of which the first four are the square of half side
/// `radius` and the others do not make it empty.
inline Vector_2 minimum_in(const Vector_2& c, double radius, const Ring<Half_plane>& half_planes)
{
  Vector_2 x(-std::copysign(radius, c.x()), -std::copysign(radius, c.y()));
  for (std::size_t k = 4; k < half_planes.size(); ++k)
    if (half_planes[k].normal.dot(x) > half_planes[k].bound && half_planes[k].normal.squaredNorm() > 0)
      x = minimum_on_line(c, half_planes, k);
  return x;
}

} // namespace internal

/// Where the largest of the functions is least in the square `|d|_inf <= radius`. Functions are added one after the
/// other (R. Seidel, *Small-dimensional linear programming and convex hulls made easy*, 1991): one that exceeds the
/// others at the minimum so far is the largest at the new one, so that this lies where it exceeds the others and is
/// found in the plane. O(n^3) at worst, for n functions, and near O(n) on the average; allocates only for more than 12.
/// \pre there is one
inline Vector_2 minimize_maximum(const Ring<Linear_function_2>& functions, double radius)
{
  Ring<internal::Half_plane> half_planes;
  for (const double side : {-1.0, 1.0}) {
    half_planes.push_back({{side, 0}, radius});
    half_planes.push_back({{0, side}, radius});
  }
  Vector_2 d = internal::minimum_in(functions[0].gradient, radius, half_planes);
  double largest = functions[0](d);
  for (std::size_t i = 1; i < functions.size(); ++i) {
    const Linear_function_2& f = functions[i];
    if (!(f(d) > largest)) continue;
    half_planes.erase(half_planes.begin() + 4, half_planes.end()); // all but the sides
    for (std::size_t j = 0; j < i; ++j)
      half_planes.push_back({functions[j].gradient - f.gradient, f.value - functions[j].value});
    d = internal::minimum_in(f.gradient, radius, half_planes);
    largest = f(d);
  }
  return d;
}

/// Lowers the largest of some functions at `x` by at most `rounds` steps, or until it is no more than `enough`.
/// \param x where to start and, afterwards, the best point found: `worst(x)` never increases
/// \param radius half side of the square in which the first step ends; it adapts to what the steps bring
/// \param rounds, enough when to end
/// \param linearized `linearized(x)` returns the expansions of the functions at `x`, a `Ring<Linear_function_2>`
/// \param moved `moved(x, d)` returns the point that the vector `d` leads to from `x`
/// \param worst `worst(x)` returns the largest of the functions, infinite where `x` is not allowed
template <class Point, class Linearized, class Moved, class Worst>
void minimize_worst(Point& x, double radius, int rounds, double enough, const Linearized& linearized,
                    const Moved& moved, const Worst& worst)
{
  constexpr double least_share = 1e-4;      // of the decrease promised that a step must bring
  constexpr double least_decrease = 1e-6;   // relative: less is rounding
  constexpr double poor_share = 0.25, good_share = 0.75; // at which the region shrinks and grows
  double current = worst(x);
  for (int i = 0; i < rounds && current > enough; ++i) {
    const Ring<Linear_function_2> functions = linearized(x);
    if (functions.empty()) return;
    const Vector_2 d = minimize_maximum(functions, radius);
    const double promised = current - maximum(functions, d);
    if (!(promised > least_decrease * std::abs(current))) return;
    const Point y = moved(x, d);
    const double value = worst(y), share = (current - value) / promised;
    if (share < poor_share) radius = 0.25 * d.cwiseAbs().maxCoeff();
    if (share > good_share) radius *= 2;
    if (!(share >= least_share)) continue;
    x = y;
    current = value;
  }
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_MINIMIZE_WORST_H

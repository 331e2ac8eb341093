// SPDX-License-Identifier: GPL-3.0-or-later
//
// The optimisation that relocation does, alone.

#include "numerics/plane_star.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace test_minimize_worst {

using namespace stars_of_tests;

/// The least maximum in the square, from all points where two of the functions, or one and a side, or two sides meet.
double least_maximum(const SMA::Ring<Linear_function_2>& functions, double radius)
{
  std::vector<Eigen::Vector3d> lines; // a x + b y = c
  for (const double s : {-radius, radius}) {
    lines.emplace_back(1, 0, s);
    lines.emplace_back(0, 1, s);
  }
  for (std::size_t i = 0; i < functions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vector_2 g = functions[i].gradient - functions[j].gradient;
      lines.emplace_back(g.x(), g.y(), functions[j].value - functions[i].value);
    }
  double least = maximum(functions, Vector_2(0, 0));
  for (const Eigen::Vector3d& k : lines)
    for (const Eigen::Vector3d& l : lines) {
      const double det = k[0] * l[1] - k[1] * l[0];
      const Vector_2 x((k[2] * l[1] - k[1] * l[2]) / det, (k[0] * l[2] - k[2] * l[0]) / det);
      if (x.cwiseAbs().maxCoeff() <= radius * (1 + 1e-12)) least = (std::min)(least, maximum(functions, x));
    }
  return least;
}

TEST(Minimize_maximum, finds_the_optimum_of_brute_force)
{
  shapes::Random random(11);
  for (int trial = 0; trial < 2000; ++trial) {
    SMA::Ring<Linear_function_2> functions;
    for (std::size_t n = 1 + random.below(10); n > 0; --n)
      functions.push_back({random.real(1, 3), random.vector().head<2>() * (trial % 3 == 0 ? 0.2 : 5)});
    if (trial % 5 == 0) functions.push_back(functions[0]); // equal ones, parallel ones, a constant
    if (trial % 7 == 0) functions.push_back({functions[0].value + 0.1, functions[0].gradient});
    if (trial % 11 == 0) functions.push_back({random.real(0, 3), Vector_2(0, 0)});
    const double radius = random.real(0.01, 2);
    const Vector_2 d = minimize_maximum(functions, radius);
    EXPECT_LE(d.cwiseAbs().maxCoeff(), radius * (1 + 1e-12));
    EXPECT_NEAR(maximum(functions, d), least_maximum(functions, radius), 1e-9);
  }
}

/// What is left of the possible decrease of the worst distortion after so many rounds from the centroid, sorted.
std::vector<double> remaining_gaps(double stretch, int rounds)
{
  shapes::Random random(12);
  std::vector<double> gaps;
  while (gaps.size() < 100) {
    const Plane_star star(random, stretch);
    Vector_2 p = star.centroid();
    const double start = star.worst(p), optimum = star.optimum();
    if (!std::isfinite(start) || start < optimum * 1.001) continue;
    SMA::minimize_worst(p, 0.5, rounds, 0, [&](const Vector_2& x) { return star.distortions(x); },
                   [](const Vector_2& x, const Vector_2& d) { return Vector_2(x + d); },
                   [&](const Vector_2& x) { return star.worst(x); });
    gaps.push_back((star.worst(p) - optimum) / (start - optimum));
  }
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

TEST(Minimize_worst, never_raises_the_maximum_and_closes_the_gap_in_five_rounds)
{
  for (const double stretch : {1.0, 10.0})
    for (const int rounds : {1, 3, 5, 50}) {
      SCOPED_TRACE(std::to_string(stretch) + " after rounds: " + std::to_string(rounds));
      const std::vector<double> gaps = remaining_gaps(stretch, rounds);
      EXPECT_LE(gaps.back(), 1);
      EXPECT_GE(gaps.front(), -1e-6); // no better than the optimum
      if (rounds >= 5) { EXPECT_LT(gaps[gaps.size() / 2], 1e-3); }
      if (rounds == 50) { EXPECT_LT(gaps.back(), 1e-3); }
    }
}

TEST(Minimize_worst, stops_where_it_is_good_enough)
{
  shapes::Random random(13);
  const Plane_star star(random, 1);
  Vector_2 p = star.centroid();
  int evaluations = 0;
  SMA::minimize_worst(p, 0.5, 5, star.worst(p), [&](const Vector_2& x) { return star.distortions(x); },
                 [](const Vector_2& x, const Vector_2& d) { return Vector_2(x + d); },
                 [&](const Vector_2& x) { return ++evaluations, star.worst(x); });
  EXPECT_EQ(evaluations, 1);
  EXPECT_EQ(p, star.centroid());
}

} // namespace test_minimize_worst

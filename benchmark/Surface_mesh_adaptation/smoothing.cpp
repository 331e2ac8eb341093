// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relocation against the smoothing of Taubin and the HC Laplacian: what they do to the surface and to its triangles
// (the paper's figures 7 and 8). Prints a table of errors, then one of the distribution of the aspect ratios.
//
//     smoothing [MESH...]     names of meshes in CGAL's data, by default three smooth ones

#include "common.h"
#include "../../test/Surface_mesh_adaptation/shape_meshes.h"
#include "../../test/Surface_mesh_adaptation/shapes.h"

#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;
using bench::Mesh;
using shapes::Soup;
using SMA::Index;
using SMA::Vector_3;

constexpr int iterations = 10; // of each method

using Points = std::vector<Vector_3>;
using Neighbors = std::vector<std::vector<Index>>;

/// The neighbours of each vertex; none for those on the boundary, which stay.
Neighbors neighbors_of(const Soup& soup)
{
  const SMA::Mesh_view mesh = shapes::view(soup);
  Neighbors neighbors(soup.points.size());
  for (Index v = 0; v < neighbors.size(); ++v)
    if (!mesh.is_border_vertex(v)) mesh.for_each_neighbor(v, [&](Index w) { neighbors[v].push_back(w); });
  return neighbors;
}

/// The mean of the values at the neighbours of `v`, or that of `v` if there are none.
Vector_3 mean_around(const Neighbors& neighbors, const Points& values, std::size_t v)
{
  if (neighbors[v].empty()) return values[v];
  Vector_3 sum = Vector_3::Zero();
  for (const Index w : neighbors[v]) sum += values[w];
  return sum / double(neighbors[v].size());
}

/// `p + factor * (mean of the neighbours - p)` for all vertices at once.
Points laplacian_step(const Neighbors& neighbors, const Points& p, double factor)
{
  Points result(p.size());
  for (std::size_t v = 0; v < p.size(); ++v) result[v] = p[v] + factor * (mean_around(neighbors, p, v) - p[v]);
  return result;
}

/// G. Taubin, *A signal processing approach to fair surface design*, 1995: a step that shrinks and one that grows.
Soup taubin(Soup soup)
{
  constexpr double lambda = 0.5, mu = -0.53;
  const Neighbors neighbors = neighbors_of(soup);
  for (int i = 0; i < iterations; ++i)
    soup.points = laplacian_step(neighbors, laplacian_step(neighbors, soup.points, lambda), mu);
  return soup;
}

/// J. Vollmer, R. Mencl, H. Mueller, *Improved Laplacian smoothing of noisy surface meshes*, 1999: a Laplacian step,
/// of which the mean of what it moved a vertex and its neighbours is taken back. `sign` is 1; -1 is what is found in
/// MeshLab.
Soup hc_laplacian(Soup soup, double sign)
{
  constexpr double alpha = 0, beta = 0.5;
  const Neighbors neighbors = neighbors_of(soup);
  const Points original = soup.points;
  Points difference(original.size());
  for (int i = 0; i < iterations; ++i) {
    const Points before = soup.points;
    soup.points = laplacian_step(neighbors, before, 1);
    for (std::size_t v = 0; v < before.size(); ++v)
      difference[v] = soup.points[v] - (alpha * original[v] + (1 - alpha) * before[v]);
    for (std::size_t v = 0; v < before.size(); ++v)
      if (!neighbors[v].empty())
        soup.points[v] -= beta * difference[v] + sign * (1 - beta) * mean_around(neighbors, difference, v);
  }
  return soup;
}

double diagonal(const Soup& soup)
{
  Vector_3 low = soup.points[0], high = soup.points[0];
  for (const Vector_3& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

/// Relocation to the sizes that the mesh has, at most a tenth of the diagonal; no move leaves a face more than `theta`
/// degrees off the tangent plane at the vertex, or farther than it was. Sharp edges are kept, unless the surface is
/// known to have none: the other methods keep none, and folded faces look like some.
Soup relocated(const Soup& soup, bool keeps_features, double theta = 180)
{
  const Neighbors neighbors = neighbors_of(soup);
  const double hmax = 0.1 * diagonal(soup);
  std::vector<double> sizes(soup.points.size(), soup.mean_edge_length());
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    double sum = 0;
    for (const Index w : neighbors[v]) sum += (soup.points[w] - soup.points[v]).norm();
    if (sum > 0) sizes[v] = (std::min)(hmax, sum / double(neighbors[v].size()));
  }
  Mesh mesh = shapes::mesh<Mesh>(soup);
  const auto map = mesh.add_property_map<Mesh::Vertex_index, double>("v:size").first;
  for (const auto v : mesh.vertices()) map[v] = sizes[v];
  SMA::relocate<CGAL::Sequential_tag>(mesh, map,
                                      SMA::parameters::number_of_iterations(unsigned(iterations))
                                        .detect_features(keeps_features)
                                        .maximum_normal_deviation(theta));
  return shapes::soup(mesh);
}

SMA::Triangle_tree tree(const Soup& soup)
{
  return SMA::Triangle_tree(SMA::Sequential_execution(), shapes::view(soup), soup.points);
}

/// Squared distances from points spread over the faces to the surface, weighted by area.
double mean_squared_distance(const Soup& from, const SMA::Triangle_tree& to)
{
  double sum = 0, area = 0;
  for (const shapes::Triangle& t : from.triangles) {
    const Vector_3 &a = from.points[t[0]], &b = from.points[t[1]], &c = from.points[t[2]];
    const double w = (b - a).cross(c - a).norm();
    for (const std::array<double, 3>& x :
         {std::array<double, 3>{4, 1, 1}, std::array<double, 3>{1, 4, 1}, std::array<double, 3>{1, 1, 4}})
      sum += w / 3 * to.nearest((x[0] * a + x[1] * b + x[2] * c) / 6).squared_distance;
    area += w;
  }
  return sum / area;
}

struct Distances
{
  double hausdorff, rms;
};

Distances distances(const Soup& a, const Soup& b)
{
  const SMA::Triangle_tree of_a = tree(a), of_b = tree(b);
  const double diag = diagonal(a);
  return {hausdorff_distance_bound(SMA::Sequential_execution(), of_a, of_b, 1e-6 * diag) / diag,
          std::sqrt((std::max)(mean_squared_distance(a, of_b), mean_squared_distance(b, of_a))) / diag};
}

/// `4 sqrt 3 area / sum of squared lengths` of each triangle.
std::vector<double> qualities(const Soup& soup)
{
  std::vector<double> result;
  for (const shapes::Triangle& t : soup.triangles) {
    const Vector_3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    const double lengths = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    result.push_back(2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / lengths);
  }
  std::sort(result.begin(), result.end());
  return result;
}

double volume(const Soup& soup)
{
  double sum = 0;
  for (const shapes::Triangle& t : soup.triangles)
    sum += soup.points[t[0]].dot(soup.points[t[1]].cross(soup.points[t[2]])) / 6;
  return sum;
}

struct Method
{
  const char* name;
  std::function<Soup(const Soup&)> run;
};

std::vector<Method> methods()
{
  return {{"none", [](const Soup& s) { return s; }},
          {"Taubin", taubin},
          {"HC Laplacian", [](const Soup& s) { return hc_laplacian(s, 1); }},
          {"HC, MeshLab's sign", [](const Soup& s) { return hc_laplacian(s, -1); }},
          {"relocation", [](const Soup& s) { return relocated(s, true); }},
          {"relocation, no features", [](const Soup& s) { return relocated(s, false); }},
          {"the same within 7 degrees", [](const Soup& s) { return relocated(s, false, 7); }}};
}

void print_row(const std::string& shape, const char* method, const Soup& before, const Soup& after)
{
  const Distances d = distances(before, after);
  const std::vector<double> q = qualities(after);
  double sum = 0;
  for (const double x : q) sum += x;
  std::printf("| %s | %s | %.2e | %.2e | %.3f | %.3f | %.3f | %.3f |\n", shape.c_str(), method, d.hausdorff, d.rms,
              volume(after) / volume(before), sum / double(q.size()), q[q.size() / 100], q.front());
  std::fflush(stdout);
}

void print_histogram(const std::string& shape, const char* method, const Soup& soup)
{
  std::array<std::size_t, 10> bins{};
  const std::vector<double> q = qualities(soup);
  for (const double x : q) ++bins[std::size_t((std::min)(9.0, 10 * x))];
  std::printf("| %s | %s |", shape.c_str(), method);
  for (const std::size_t n : bins) std::printf(" %.2f |", 100 * double(n) / double(q.size()));
  std::printf("\n");
}

void run(const std::vector<std::pair<std::string, Soup>>& inputs)
{
  std::printf("| mesh | method | Hausdorff / diagonal | rms / diagonal | volume ratio | mean quality | 1 %% quantile | "
              "worst |\n|---|---|---|---|---|---|---|---|\n");
  std::map<std::pair<std::string, std::string>, Soup> results;
  for (const auto& [name, soup] : inputs)
    for (const Method& m : methods()) {
      const Soup& after = results[{name, m.name}] = m.run(soup);
      print_row(name, m.name, soup, after);
    }
  std::printf("\nPercentage of the triangles with a quality in [i/10, (i + 1)/10):\n\n| mesh | method |");
  for (int i = 0; i < 10; ++i) std::printf(" .%d |", i);
  std::printf("\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [name, soup] : inputs)
    for (const Method& m : methods()) print_histogram(name, m.name, results[{name, m.name}]);
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    std::vector<std::pair<std::string, Soup>> inputs;
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty()) {
      names = {"elephant", "knot2", "bunny00"};
      inputs = {{"jittered torus", shapes::torus(96, 48, 0.35)}};
    }
    for (const std::string& name : names) inputs.emplace_back(name, shapes::soup(bench::read_mesh(name)));
    run(inputs);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "smoothing: %s\n", e.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

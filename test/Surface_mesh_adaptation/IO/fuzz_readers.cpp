// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feeds the readers of `adapt_mesh` with files that are cut, changed and spliced at random: each has to give a valid
// mesh or field, or one of the exceptions meant for bad files. To be built with sanitizers, see scripts/sanitize.
//
// `fuzz_readers [--seconds S] [--seed N]`; a failure is printed with its seed, and its file is written to the current
// folder.

#include "Bad_input.h"
#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace adapt_mesh;
using Random = std::mt19937_64;

struct File
{
  std::string format, text;
};

template <class Write>
std::string text_of(bool is_binary, const Write& write)
{
  std::ostringstream out;
  if (is_binary) CGAL::IO::set_binary_mode(out);
  write(out);
  return out.str();
}

/// With sections of all kinds.
SMA::Medit_mesh medit_mesh(Constrained_mesh& mesh)
{
  mesh.vertex_is_constrained[*mesh.mesh.vertices().begin()] = true;
  mesh.edge_is_constrained[*mesh.mesh.edges().begin()] = true;
  SMA::Medit_mesh medit =
    SMA::triangle_mesh_to_medit(mesh.mesh, mesh.edge_is_constrained, mesh.vertex_is_constrained);
  medit.points.insert(medit.points.end(), {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}});
  medit.point_references.resize(medit.points.size());
  medit.quadrilaterals = {{12, 13, 14, 15}};
  medit.quadrilateral_references = {3};
  medit.required_edges = {0};
  medit.required_vertices = {2};
  return medit;
}

SMA::Medit_solution medit_solution()
{
  SMA::Medit_solution solution(3);
  for (std::size_t i = 0; i < 3; ++i) {
    solution[i].components = std::array<int, 3>{1, 3, 6}[i];
    solution[i].values.assign(12 * std::size_t(solution[i].components), 0.5);
  }
  return solution;
}

/// A small mesh or field in each format.
std::vector<File> valid_files()
{
  Constrained_mesh constrained;
  Mesh& mesh = constrained.mesh;
  CGAL::make_icosahedron<Mesh, Point>(mesh);
  const SMA::Medit_mesh medit = medit_mesh(constrained);
  const SMA::Medit_solution solution = medit_solution();
  const auto off = [&](auto& out) { CGAL::IO::write_OFF(out, mesh); };
  const auto obj = [&](auto& out) { CGAL::IO::write_OBJ(out, mesh); };
  const auto ply = [&](auto& out) { CGAL::IO::write_PLY(out, mesh); };
  const auto stl = [&](auto& out) { CGAL::IO::write_STL(out, mesh); };
  return {{"off", text_of(false, off)},
          {"off", "COFF\n# quads\n4 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 1 0 1 0 0 1\n0 1 0 1 0 0 1\n"
                  "4 0 1 2 3 255 0 0\n"},
          {"obj", text_of(false, obj)},
          {"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\ng a\nf 1/1/1 2//1 -1\n"},
          {"ply", text_of(false, ply)},
          {"ply", text_of(true, ply)},
          {"stl", text_of(false, stl)},
          {"stl", text_of(true, stl)},
          {"mesh", SMA::print_medit_mesh(medit)},
          {"meshb", SMA::print_medit_mesh(medit, {1})},
          {"meshb", SMA::print_medit_mesh(medit, {2})},
          {"meshb", SMA::print_medit_mesh(medit, {4})},
          {"sol", SMA::print_medit_solution(solution)},
          {"solb", SMA::print_medit_solution(solution, {2})},
          {"solb", SMA::print_medit_solution(solution, {4})}};
}

std::size_t below(std::size_t n, Random& random) { return n == 0 ? 0 : std::size_t(random() % n); }

/// Changes `text` in one place, or cuts it, or joins it with a part of `other`.
void mutate(std::string& text, const std::string& other, Random& random)
{
  static const std::array<const char*, 14> words = {
    "-1", "0", "4294967295", "99999999999999999999", "nan", "1e300", "-inf", "1e-320", "2147483648", "\n", " ", "#",
    "1e999", "3 0 1 2\n"};
  const std::size_t at = below(text.size(), random), length = below(1 + text.size() / 4, random);
  switch (below(7, random)) {
  case 0: text.resize(at); break;
  case 1:
    if (!text.empty()) text[at] = char(random());
    break;
  case 2: text.erase(at, below(8, random)); break;
  case 3: text.insert(at, text.substr(below(text.size(), random), length)); break;
  case 4: text.insert(at, other.substr(below(other.size(), random), length)); break;
  case 5: text.insert(at, words[below(words.size(), random)]); break;
  default: // a word by another one
    const std::size_t first = text.find_first_of(" \n", at), last = text.find_first_of(" \n", first + 1);
    if (last < text.size()) text.replace(first + 1, last - first - 1, words[below(words.size(), random)]);
  }
}

void read(const File& file, const Reading_options& options)
{
  const std::string name = "file." + file.format;
  if (file.format.substr(0, 3) == "sol") {
    SMA::parse_medit_solution(file.text, name);
    return;
  }
  Constrained_mesh mesh;
  parse_mesh(file.text, name, mesh, options);
}

/// \returns what is wrong with what reading `file` gave, or nothing
std::string complaint(const File& file, const Reading_options& options)
{
  try {
    reading(file.format, [&] { read(file, options); });
    return "";
  } catch (const Bad_input&) {
    return "";
  } catch (const std::exception& e) {
    return e.what();
  }
}

bool survives(const std::vector<File>& files, std::uint64_t seed)
{
  Random random(seed);
  File file = files[below(files.size(), random)];
  for (std::size_t n = 1 + below(4, random); n > 0; --n)
    mutate(file.text, files[below(files.size(), random)].text, random);
  const Reading_options options{random() % 2 == 0, random() % 2 == 0};
  const std::string what = complaint(file, options);
  if (what.empty()) return true;
  std::cerr << "seed " << seed << ", format " << file.format << ": " << what << '\n';
  std::ofstream("fuzz_readers-" + std::to_string(seed) + "." + file.format, std::ios::binary) << file.text;
  return false;
}

} // namespace

int main(int argc, char* argv[])
{
  double seconds = 10;
  std::uint64_t seed = 0;
  for (int i = 1; i + 1 < argc; i += 2)
    if (std::string(argv[i]) == "--seconds") seconds = std::atof(argv[i + 1]);
    else if (std::string(argv[i]) == "--seed") seed = std::strtoull(argv[i + 1], nullptr, 10);
  const auto files = valid_files();
  const auto start = std::chrono::steady_clock::now();
  std::size_t trials = 0, failures = 0;
  for (; std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds; ++trials)
    if (!survives(files, seed + trials)) ++failures;
  std::cout << trials << " files, " << failures << " failures\n";
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

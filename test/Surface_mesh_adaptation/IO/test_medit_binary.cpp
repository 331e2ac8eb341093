// SPDX-License-Identifier: GPL-3.0-or-later
//
// The binary form of MEDIT files: it holds what the text form does in every version and order of bytes, is laid out as
// other programs expect, and whatever is wrong with a file is refused.

#include "medit_files.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace test_medit_binary {

namespace SMA = CGAL::Surface_mesh_adaptation;
using medit_files::expect_equal;
using medit_files::random_mesh;
using medit_files::random_solution;
using SMA::Medit_binary_layout;
using SMA::Medit_mesh;
using SMA::Medit_solution;

const std::vector<Medit_binary_layout> layouts = {{1, false}, {1, true}, {2, false}, {2, true},
                                                  {3, false}, {3, true}, {4, false}, {4, true}};

Medit_mesh parsed(const std::string& bytes) { return SMA::parse_medit_mesh(bytes, "some.meshb"); }
Medit_solution parsed_solution(const std::string& bytes) { return SMA::parse_medit_solution(bytes, "some.solb"); }

/// As the first version stores it.
double in_single_precision(double x)
{
  constexpr double largest = 1e38;
  return double(float(std::clamp(x, -largest, largest)));
}

Medit_mesh in_single_precision(Medit_mesh mesh)
{
  for (auto& p : mesh.points)
    for (double& x : p) x = in_single_precision(x);
  return mesh;
}

Medit_solution in_single_precision(Medit_solution solution)
{
  for (auto& field : solution)
    for (double& x : field.values) x = in_single_precision(x);
  return solution;
}

/// The bytes of numbers one after the other, to make files by hand.
template <class... Numbers>
std::string bytes(Numbers... numbers)
{
  std::string all;
  const auto append = [&](const auto& x) { all.append(reinterpret_cast<const char*>(&x), sizeof(x)); };
  (append(numbers), ...);
  return all;
}

std::string error(const std::string& content)
{
  try {
    parsed(content);
  } catch (const SMA::Io_error& e) {
    EXPECT_EQ(e.line(), 0u);
    return e.what();
  }
  return "no error";
}

void expect_error(const std::string& content, const std::string& what)
{
  EXPECT_NE(error(content).find(what), std::string::npos) << error(content) << ", not " << what;
}

const std::string header = bytes(1, 2, 3, 20, 3); // up to the byte 20
/// Up to the byte 144, where the next section starts.
const std::string vertices = bytes(4, 144, 4, 0., 0., 0., 1, 1., 0., 0., 2, 0., 1., 0., 3, 0., 0., 1., 4);

TEST(Medit_binary, holds_what_the_text_holds)
{
  shapes::Random random(1);
  const Medit_mesh mesh = random_mesh(random, 1000);
  const Medit_mesh single = in_single_precision(mesh);
  for (const Medit_binary_layout& layout : layouts) {
    SCOPED_TRACE(layout.version);
    const Medit_mesh& m = layout.version == 1 ? single : mesh;
    const std::string binary = SMA::print_medit_mesh(m, layout);
    expect_equal(parsed(binary), m);
    EXPECT_EQ(SMA::print_medit_mesh(parsed(binary), layout), binary);
    EXPECT_EQ(SMA::print_medit_mesh(parsed(binary)), SMA::print_medit_mesh(m));
  }
}

TEST(Medit_binary, holds_solutions_of_several_fields)
{
  shapes::Random random(2);
  for (const std::vector<int>& fields : medit_files::several_fields) {
    const Medit_solution solution = random_solution(random, fields);
    const Medit_solution single = in_single_precision(solution);
    for (const Medit_binary_layout& layout : layouts) {
      SCOPED_TRACE(layout.version);
      const Medit_solution& s = layout.version == 1 ? single : solution;
      const std::string binary = SMA::print_medit_solution(s, layout);
      expect_equal(parsed_solution(binary), s);
      EXPECT_EQ(SMA::print_medit_solution(parsed_solution(binary)), SMA::print_medit_solution(s));
    }
  }
}

TEST(Medit_binary, is_laid_out_as_others_expect)
{
  Medit_mesh mesh = parsed(header + vertices + bytes(54, 0));
  EXPECT_EQ(mesh.points, (std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.point_references, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(SMA::print_medit_mesh(mesh, {2}), header + vertices + bytes(54, 0));

  const std::int64_t none = 0, one = 1, two = 2, three = 3;
  const std::string dimension = bytes(1, 4, 3, std::int64_t(24), 3);
  const std::string long_form = dimension + bytes(4, std::int64_t(108), two, 0., 0., 0., one, 1., 0., 0., -two) +
                                bytes(6, std::int64_t(160), one, one, two, one, three) + bytes(54, none);
  mesh = parsed(long_form);
  EXPECT_EQ(mesh.point_references, (std::vector<int>{1, -2}));
  EXPECT_EQ(mesh.triangles, (Medit_mesh::Tuples<3>{{0, 1, 0}}));
  EXPECT_EQ(SMA::print_medit_mesh(mesh, {4}), long_form);

  const std::string solution = header + bytes(62, 76, 1, 2, 2, 1, 1., 2., 3., 4.) + bytes(54, 0);
  EXPECT_EQ(parsed_solution(solution)[0].values, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(parsed_solution(solution)[1].values, (std::vector<double>{4}));
  EXPECT_EQ(SMA::print_medit_solution(parsed_solution(solution), {2}), solution);
}

TEST(Medit_binary, skips_other_sections)
{
  const std::string tetrahedra = bytes(8, 176, 1, 1, 2, 3, 4, 0), strange = bytes(1234567, 184);
  const Medit_mesh mesh = parsed(header + vertices + tetrahedra + strange + bytes(6, 0, 1, 1, 2, 3, 7));
  EXPECT_EQ(mesh.ignored_sections, (std::vector<std::string>{"Tetrahedra", "1234567"}));
  EXPECT_EQ(mesh.triangles, (Medit_mesh::Tuples<3>{{0, 1, 2}})) << "the last section may say 0, and End be missing";
}

TEST(Medit_binary, that_is_malformed_is_refused)
{
  expect_error("", "expected");
  expect_error("MeshVersionFormatted 2\nDimension 3\n", "not a binary MEDIT file");
  expect_error(bytes(1, 5), "unknown version 5");
  expect_error(bytes(1, 2, 3, 20, 2), "the dimension is 2");
  expect_error(bytes(1, 2, 4, 0, 0), "the section Dimension must come first");
  expect_error(header + bytes(54, 0), "there is no section Vertices");
  expect_error(header + bytes(4, 20, 0), "the next section is said to be at 20");
  expect_error(header + bytes(4, -1, 0), "the next section is said to be at -1");
  expect_error(header + bytes(4, 33, 0), "the next section is said to be at 33");
  expect_error(header + bytes(4, 0, -1), "out of range");
  expect_error(header + bytes(4, 0, 2, 0., 0., 0., 0), "too short for 2 items");
  expect_error(header + bytes(4, 0, 2000000000), "too short for 2000000000 items");
  expect_error(header + bytes(4, 0, 1, 0., std::numeric_limits<double>::infinity(), 0., 0), "not finite");
  expect_error(header + vertices + bytes(6, 0, 1, 1, 2, 5, 0), "at byte 164: there is no vertex 5");
  expect_error(header + vertices + bytes(6, 0, 1, 0, 2, 3, 0), "at byte 156: the index 0");
  expect_error(header + vertices + bytes(7, 0, 1, 1, 2, 3, 5, 0), "at byte 168: there is no vertex 5");
  expect_error(header + vertices + bytes(14, 0, 1, 1), "there is no edge 1");
  const std::string again = header + vertices + bytes(4, 0, 0);
  expect_error(again, "at byte 144: there is a second section Vertices");
  // more than memory has, and more than 64 bits can multiply
  const std::int64_t huge = std::int64_t(1) << 60;
  const std::string dimension = bytes(1, 4, 3, std::int64_t(24), 3);
  expect_error(dimension + bytes(4, std::int64_t(0), huge), "out of range");
  expect_error(dimension + bytes(4, huge, huge), "the next section is said to be at");
  EXPECT_THROW(parsed_solution(header + bytes(62, 0, 2000000000, 1, 3)), SMA::Io_error);
  EXPECT_THROW(parsed_solution(header + bytes(62, 0, 1, 2000000000, 3)), SMA::Io_error);
}

/// Whether the damaged file was refused; if it was read, all is within bounds.
bool is_refused(const std::string& content)
{
  try {
    const Medit_mesh m = parsed(content);
    for (const auto& t : m.triangles)
      for (const auto v : t) EXPECT_LT(v, m.points.size());
    for (const auto e : m.ridges) EXPECT_LT(e, m.edges.size());
    for (const auto v : m.corners) EXPECT_LT(v, m.points.size());
    return false;
  } catch (const SMA::Io_error&) {
    return true;
  }
}

bool is_refused_solution(const std::string& content)
{
  try {
    for (const auto& field : parsed_solution(content))
      EXPECT_EQ(field.values.size(), field.number_of_vertices() * std::size_t(field.components));
    return false;
  } catch (const SMA::Io_error&) {
    return true;
  }
}

TEST(Medit_binary, that_is_cut_anywhere_is_read_or_refused)
{
  shapes::Random random(3);
  const Medit_mesh mesh = random_mesh(random, 8);
  const Medit_solution solution = random_solution(random, {1, 3});
  for (const Medit_binary_layout& layout : layouts) {
    const std::string binary = SMA::print_medit_mesh(mesh, layout);
    for (std::size_t n = 0; n < binary.size(); ++n) is_refused(binary.substr(0, n));
    const std::string values = SMA::print_medit_solution(solution, layout);
    for (std::size_t n = 0; n < values.size(); ++n) is_refused_solution(values.substr(0, n));
  }
}

TEST(Medit_binary, with_random_damage_is_read_or_refused)
{
  shapes::Random random(4);
  const Medit_mesh mesh = in_single_precision(random_mesh(random, 8));
  const Medit_solution solution = in_single_precision(random_solution(random, {1, 3}));
  const auto damaged = [&](std::string content) {
    for (std::size_t n = 1 + random.below(4); n > 0; --n)
      content[random.below(content.size())] = char(random.below(256));
    return content;
  };
  std::size_t refused = 0;
  for (const Medit_binary_layout& layout : layouts) {
    const std::string binary = SMA::print_medit_mesh(mesh, layout),
                      values = SMA::print_medit_solution(solution, layout);
    for (int trial = 0; trial < 5000; ++trial)
      refused += std::size_t(is_refused(damaged(binary))) + std::size_t(is_refused_solution(damaged(values)));
  }
  EXPECT_GT(refused, 10000u);
}

TEST(Medit_binary, is_chosen_by_the_extension)
{
  shapes::Random random(5);
  const Medit_mesh mesh = random_mesh(random, 10);
  const Medit_solution solution = random_solution(random, {6, 1});
  const std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("test_medit_binary-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  for (const bool binary : {false, true}) {
    const std::string mesh_file = (folder / (binary ? "m.meshb" : "m.mesh")).string();
    const std::string solution_file = (folder / (binary ? "s.SOLB" : "s.sol")).string();
    SMA::write_medit_mesh(mesh_file, mesh);
    SMA::write_medit_solution(solution_file, solution);
    expect_equal(SMA::read_medit_mesh(mesh_file), mesh);
    expect_equal(SMA::read_medit_solution(solution_file), solution);
    EXPECT_EQ(std::ifstream(mesh_file).peek() == 1, binary);
    EXPECT_EQ(std::ifstream(solution_file).peek() == 1, binary);
  }
  std::filesystem::remove_all(folder);
}

} // namespace test_medit_binary

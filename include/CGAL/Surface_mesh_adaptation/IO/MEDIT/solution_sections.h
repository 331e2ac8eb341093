// SPDX-License-Identifier: GPL-3.0-or-later
//
// The section of a solution, read from and written to either form.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_SOLUTION_SECTIONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_SOLUTION_SECTIONS_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_solution.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// The numbers of components of the types of fields, which count from 1.
constexpr std::array<int, 4> components_of_type = {1, 3, 6, 9};

/// Makes a solution of the section that a `Reader` finds. \throws Io_error
template <class Reader>
class Medit_solution_parser
{
public:
  explicit Medit_solution_parser(Reader& reader) : in(reader) {}

  Medit_solution parse()
  {
    in.read_sections([&](const std::string& keyword, const char* position) {
      if (keyword != "SolAtVertices") return in.skip_section();
      if (!solution_.empty()) in.fail(position, "there is a second section SolAtVertices");
      read_fields();
    });
    if (solution_.empty()) in.fail(in.position(), "there is no section SolAtVertices");
    return std::move(solution_);
  }

private:
  void read_fields()
  {
    const std::size_t n = in.count();
    const int fields = in.word_sized("the number of fields");
    if (fields < 1) in.fail(in.last(), "there are " + std::to_string(fields) + " fields");
    std::size_t components = 0;
    for (int i = 0; i < fields; ++i) {
      solution_.emplace_back().components = components_of_field();
      components += std::size_t(solution_.back().components);
    }
    in.check_room(n, 0, components);
    read_values(n);
  }

  int components_of_field()
  {
    const int type = in.word_sized("the type of a field");
    if (type < 1 || type > int(components_of_type.size()))
      in.fail(in.last(), "the type of a field is neither 1 (scalar), 2 (vector), 3 (symmetric tensor) nor 4 (matrix)");
    return components_of_type[std::size_t(type) - 1];
  }

  void read_values(std::size_t n)
  {
    for (Medit_field& field : solution_) field.values.reserve(n * std::size_t(field.components));
    for (std::size_t v = 0; v < n; ++v)
      for (Medit_field& field : solution_)
        for (int i = 0; i < field.components; ++i) field.values.push_back(in.real("a value"));
  }

  Reader& in;
  Medit_solution solution_;
};

/// MEDIT's number for fields with so many components.
inline int type_of_field(int components)
{
  const auto found = std::find(components_of_type.begin(), components_of_type.end(), components);
  return int(found - components_of_type.begin()) + 1;
}

/// \pre all fields have as many vertices, and a number of components that MEDIT knows
template <class Writer>
void write_sections(Writer& out, const Medit_solution& solution)
{
  out.section("SolAtVertices", solution.front().number_of_vertices()).word_sized(int(solution.size()));
  for (const Medit_field& field : solution) out.word_sized(type_of_field(field.components));
  out.end_line();
  for (std::size_t v = 0; v < solution.front().number_of_vertices(); ++v) {
    for (const Medit_field& field : solution) {
      const double* const values = field.values.data() + v * std::size_t(field.components);
      std::for_each(values, values + field.components, [&](double x) { out.real(x); });
    }
    out.end_line();
  }
}

inline std::size_t largest_count(const Medit_solution& solution) { return solution.front().number_of_vertices(); }

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_SOLUTION_SECTIONS_H

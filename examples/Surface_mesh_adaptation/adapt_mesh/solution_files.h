// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which field of a MEDIT solution is meant.

#ifndef ADAPT_MESH_SOLUTION_FILES_H
#define ADAPT_MESH_SOLUTION_FILES_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace adapt_mesh {

namespace SMA = CGAL::Surface_mesh_adaptation;

/// What an option asks of a file.
struct Wanted_field
{
  std::string file;
  std::size_t number = 0;      ///< from 1 on; 0: the first that can be used
  std::vector<int> components; ///< the numbers of components that can be used
  std::string kind;            ///< their name
};

namespace internal {

inline std::string kind_of(const SMA::Medit_field& field)
{
  return field.components == 1   ? "scalar"
         : field.components == 3 ? "vector"
         : field.components == 6 ? "tensor"
                                 : "matrix";
}

/// For messages: "1 scalar, 2 vector".
inline std::string list_of(const SMA::Medit_solution& solution)
{
  std::string list;
  for (std::size_t i = 0; i < solution.size(); ++i)
    list += (i == 0 ? "" : ", ") + std::to_string(i + 1) + " " + kind_of(solution[i]);
  return list;
}

inline bool can_be(const Wanted_field& wanted, const SMA::Medit_field& field)
{
  return std::find(wanted.components.begin(), wanted.components.end(), field.components) != wanted.components.end();
}

/// The number of the field that is meant, from 1 on. \throws Io_error
inline std::size_t number_of_field(const Wanted_field& wanted, const SMA::Medit_solution& solution)
{
  const auto first = std::find_if(solution.begin(), solution.end(), [&](const auto& f) { return can_be(wanted, f); });
  const std::size_t number = wanted.number > 0 ? wanted.number : std::size_t(first - solution.begin()) + 1;
  if (number > solution.size() || !can_be(wanted, solution[number - 1])) {
    const std::string which = wanted.number > 0 ? "field " + std::to_string(number) + " is not " : "no field is ";
    throw SMA::Io_error(wanted.file, 0, which + wanted.kind + "; there are: " + list_of(solution));
  }
  return number;
}

} // namespace internal

/// Reads the field that is meant, with values for `n` vertices. Calls `warn(text)` if others could be meant as well.
/// \throws Io_error
template <class Warn>
SMA::Medit_field read_field(const Wanted_field& wanted, std::size_t n, const Warn& warn)
{
  const SMA::Medit_solution solution = SMA::read_medit_solution(wanted.file);
  const std::size_t number = internal::number_of_field(wanted, solution);
  const SMA::Medit_field& field = solution[number - 1];
  if (field.number_of_vertices() != n)
    throw SMA::Io_error(wanted.file, 0,
                        "there are values for " + std::to_string(field.number_of_vertices()) +
                          " vertices, but the mesh has " + std::to_string(n));
  const auto others = std::count_if(solution.begin() + std::ptrdiff_t(number), solution.end(),
                                    [&](const auto& f) { return internal::can_be(wanted, f); });
  if (wanted.number == 0 && others > 0)
    warn(wanted.file + ": field " + std::to_string(number) + " is used; there are: " + internal::list_of(solution));
  return field;
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_SOLUTION_FILES_H

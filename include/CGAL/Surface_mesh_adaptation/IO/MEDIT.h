// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of MEDIT: surface meshes in `.mesh`, sizes, tensors and other fields at their vertices in `.sol`; `.meshb` and
// `.solb` are the binary forms of both.
// (P. Frey, "MEDIT: an interactive mesh visualization software", INRIA technical report 253, 2001.)
//
// Files count from 1, everything here counts from 0. A file is never trusted: what it announces is allocated only as
// far as its length can back it, and every index and coordinate is checked. Whatever is wrong raises an `Io_error`
// with the line, or with the byte in its message.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_binary_layout.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_binary_reader.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_binary_writer.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_mesh.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_solution.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_text_reader.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_text_writer.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/file_content.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/mesh_sections.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/solution_sections.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFiles
/// @{

/// Whether a file of this name holds the binary form: its extension is that of `.meshb` or `.solb`, which no other
/// form's ends like.
inline bool is_binary_medit_file(const std::string& file)
{
  const std::string extension = std::filesystem::path(file).extension().string();
  return !extension.empty() && (extension.back() == 'b' || extension.back() == 'B');
}

namespace internal {

template <template <class> class Parser>
auto parse_medit(const std::string& content, const std::string& file)
{
  if (is_binary_medit_file(file)) {
    Medit_binary_reader reader(content, file);
    return Parser<Medit_binary_reader>(reader).parse();
  }
  Medit_text_reader reader(content, file);
  return Parser<Medit_text_reader>(reader).parse();
}

template <class Content>
std::string print_medit(const Content& content)
{
  Medit_text_writer out;
  write_sections(out, content);
  return out.finish();
}

template <class Content>
std::string print_medit(const Content& content, const Medit_binary_layout& layout)
{
  Medit_binary_writer out(layout);
  write_sections(out, content);
  return out.finish();
}

/// In the version that most programs read, if that is large enough.
template <class Content>
std::string print_medit_binary(const Content& content)
{
  constexpr std::size_t most = (std::numeric_limits<std::int32_t>::max)();
  if (largest_count(content) > most) return print_medit(content, {4});
  std::string bytes = print_medit(content, {2});
  return bytes.size() > most ? print_medit(content, {3}) : bytes;
}

template <class Content>
void write_medit(const std::string& file, const Content& content)
{
  write_content(file, is_binary_medit_file(file) ? print_medit_binary(content) : print_medit(content));
}

} // namespace internal

/// Reads a mesh from `content`, that of the file `file`, whose name tells the form. \throws Io_error
inline Medit_mesh parse_medit_mesh(const std::string& content, const std::string& file)
{
  return internal::parse_medit<internal::Medit_mesh_parser>(content, file);
}

/// Reads a solution from `content`, that of the file `file`, whose name tells the form. \throws Io_error
inline Medit_solution parse_medit_solution(const std::string& content, const std::string& file)
{
  return internal::parse_medit<internal::Medit_solution_parser>(content, file);
}

/// Reads a `.mesh` or `.meshb` file. Triangles and quadrilaterals with references, edges and marks are kept, other
/// sections are skipped and listed in `ignored_sections`. \throws Io_error
inline Medit_mesh read_medit_mesh(const std::string& file)
{
  return parse_medit_mesh(internal::read_content(file), file);
}

/// Reads all fields of a `.sol` or `.solb` file that are at vertices. \throws Io_error
inline Medit_solution read_medit_solution(const std::string& file)
{
  return parse_medit_solution(internal::read_content(file), file);
}

/// The content of the `.mesh` file of `mesh`.
inline std::string print_medit_mesh(const Medit_mesh& mesh) { return internal::print_medit(mesh); }

/// The content of the `.meshb` file of `mesh`.
inline std::string print_medit_mesh(const Medit_mesh& mesh, const Medit_binary_layout& layout)
{
  return internal::print_medit(mesh, layout);
}

/// The content of the `.sol` file of `solution`. \pre it has a field, and all fields have as many vertices
inline std::string print_medit_solution(const Medit_solution& solution) { return internal::print_medit(solution); }

/// The content of the `.solb` file of `solution`. \pre it has a field, and all fields have as many vertices
inline std::string print_medit_solution(const Medit_solution& solution, const Medit_binary_layout& layout)
{
  return internal::print_medit(solution, layout);
}

/// Writes a `.mesh` or `.meshb` file. \throws Io_error
inline void write_medit_mesh(const std::string& file, const Medit_mesh& mesh) { internal::write_medit(file, mesh); }

/// Writes a `.sol` or `.solb` file. \pre it has a field, and all fields have as many vertices \throws Io_error
inline void write_medit_solution(const std::string& file, const Medit_solution& solution)
{
  internal::write_medit(file, solution);
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_H

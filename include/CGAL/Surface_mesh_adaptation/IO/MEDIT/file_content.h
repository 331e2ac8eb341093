// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole files at once.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_FILE_CONTENT_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_FILE_CONTENT_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <cstddef>
#include <fstream>
#include <ios>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

inline std::string read_content(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Io_error(file, 0, "cannot be opened");
  std::string content;
  std::vector<char> block(std::size_t(1) << 20);
  do {
    in.read(block.data(), std::streamsize(block.size()));
    content.append(block.data(), std::size_t(in.gcount()));
  } while (in);
  if (in.bad() || !in.eof()) throw Io_error(file, 0, "cannot be read");
  return content;
}

inline void write_content(const std::string& file, const std::string& content)
{
  std::ofstream out(file, std::ios::binary);
  if (!out) throw Io_error(file, 0, "cannot be opened for writing");
  out.write(content.data(), std::streamsize(content.size())).flush();
  if (!out) throw Io_error(file, 0, "cannot be written");
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_FILE_CONTENT_H

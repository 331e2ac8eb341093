// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading polygons from off, obj, ply and stl files.

#ifndef ADAPT_MESH_SOUP_FILES_H
#define ADAPT_MESH_SOUP_FILES_H

#include "Off_parser.h"
#include "Ply_parser.h"
#include "Polygon_soup.h"
#include "further_content.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/STL.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>

namespace adapt_mesh {

namespace internal {

/// The line that a reader was at when it gave up, or 0 if the file is no text.
inline std::size_t line_reached(std::istream& in, const std::string& text)
{
  in.clear();
  const auto position = in.tellg();
  std::string read = text.substr(0, position > 0 ? std::size_t(position) : 0);
  if (read.find('\0') != std::string::npos) return 0;
  if (!read.empty() && read.back() == '\n') read.pop_back(); // the line was read to its end
  return std::size_t(std::count(read.begin(), read.end(), '\n')) + 1;
}

/// The text of an obj file with its polylines, which CGAL's reader does not know, made comments.
inline std::string without_polylines(std::string text)
{
  for_each_line(text, [&](std::string_view line) {
    const std::string_view word = first_word(line);
    if (word == "l") text[std::size_t(word.data() - text.data())] = '#';
    return true;
  });
  return text;
}

inline Polygon_soup parse_with_cgal(const std::string& text, const std::string& format, const std::string& file)
{
  Polygon_soup soup;
  std::istringstream in(format == "obj" ? without_polylines(text) : text);
  bool success = false;
  try {
    success = format == "obj" ? CGAL::IO::read_OBJ(in, soup.points, soup.polygons)
                              : CGAL::IO::read_STL(in, soup.points, soup.polygons);
  } catch (const std::exception&) { // whatever a malformed file brings about
  }
  if (!success)
    throw CGAL::Surface_mesh_adaptation::Io_error(file, line_reached(in, text), "not a valid " + format + " file");
  read_further_content(format, text, soup);
  return soup;
}

} // namespace internal

/// Reads polygons from `text`, the content of the file `file` (which is named in errors only).
/// \param format off, obj, ply or stl \throws Io_error
inline Polygon_soup parse_polygon_soup(const std::string& text, const std::string& format, const std::string& file)
{
  return format == "off"   ? Off_parser(text, file).parse()
         : format == "ply" ? Ply_parser(text, file).parse()
                           : internal::parse_with_cgal(text, format, file);
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_SOUP_FILES_H

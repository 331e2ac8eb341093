// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading polygons from off, obj, ply and stl files.

#ifndef ADAPT_MESH_SOUP_FILES_H
#define ADAPT_MESH_SOUP_FILES_H

#include "Obj_parser.h"
#include "Off_parser.h"
#include "Ply_parser.h"
#include "Polygon_soup.h"
#include "Stl_parser.h"

#include <string>

namespace adapt_mesh {

/// Reads polygons from `text`, the content of the file `file` (which is named in errors only).
/// \param format off, obj, ply or stl \throws Io_error
inline Polygon_soup parse_polygon_soup(const std::string& text, const std::string& format, const std::string& file)
{
  return format == "off"   ? Off_parser(text, file).parse()
         : format == "obj" ? Obj_parser(text, file).parse()
         : format == "ply" ? Ply_parser(text, file).parse()
                           : Stl_parser(text, file).parse();
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_SOUP_FILES_H

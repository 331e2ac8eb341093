// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounds on the sizes by the labels of faces, from a file of parameters of mmg.

#ifndef ADAPT_MESH_SIZE_PARAMETERS_H
#define ADAPT_MESH_SIZE_PARAMETERS_H

#include "Bad_input.h"
#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <cctype>
#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <utility>

namespace adapt_mesh {

/// Reads the bounds `hmin hmax` of each reference of triangles: a line "Parameters", their number, and a line
/// `reference Triangle hmin hmax hausd` for each. Other entities have no sizes of their own here.
/// \throws Io_error
inline std::map<int, std::pair<double, double>> read_size_parameters(const std::string& file)
{
  std::ifstream in(file);
  const auto fail = [&](const std::string& what) { throw SMA::Io_error(file, 0, what); };
  const auto lower = [](std::string word) {
    for (char& c : word) c = char(std::tolower(static_cast<unsigned char>(c)));
    return word;
  };
  std::string keyword;
  std::size_t n = 0;
  if (!(in >> keyword) || lower(keyword) != "parameters" || !(in >> n)) fail("\"Parameters\" and their number expected");
  std::map<int, std::pair<double, double>> bounds;
  for (std::size_t i = 0; i < n; ++i) {
    int reference = 0;
    double hmin = 0, hmax = 0, hausd = 0;
    if (!(in >> reference >> keyword >> hmin >> hmax >> hausd)) fail("a reference, an entity and three numbers expected");
    if (lower(keyword).rfind("triangle", 0) == 0) bounds[reference] = {hmin, hmax};
  }
  return bounds;
}

/// Puts the bounds of a file on the faces of `mesh`.
inline void put_size_parameters(const std::string& file, Constrained_mesh& mesh)
{
  if (file.empty()) return;
  const auto bounds = reading(file, [&] { return read_size_parameters(file); });
  for (const Face f : mesh.mesh.faces()) {
    const auto found = bounds.find(mesh.label[f]);
    if (found != bounds.end()) mesh.size_bounds[f] = found->second;
  }
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_SIZE_PARAMETERS_H

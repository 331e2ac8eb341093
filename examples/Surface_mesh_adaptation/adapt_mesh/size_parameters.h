// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes by the labels of faces, from a file of parameters of mmg.

#ifndef ADAPT_MESH_SIZE_PARAMETERS_H
#define ADAPT_MESH_SIZE_PARAMETERS_H

#include "Bad_input.h"
#include "mesh_files.h"
#include "options.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <cctype>
#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <utility>

namespace adapt_mesh {

/// What faces of a reference have of their own; 0: nothing.
struct Size_parameters
{
  double hmin = 0, hmax = 0; ///< bounds of the sizes
  double distance = 0;       ///< from the surface, of faces with sizes from the curvature
};

/// Reads the parameters of each reference of triangles: a line "Parameters", their number, and a line
/// `reference Triangle hmin hmax hausd` for each. Other entities have no sizes of their own here.
/// \throws Io_error
inline std::map<int, Size_parameters> read_size_parameters(const std::string& file)
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
  std::map<int, Size_parameters> parameters;
  for (std::size_t i = 0; i < n; ++i) {
    int reference = 0;
    Size_parameters p;
    if (!(in >> reference >> keyword >> p.hmin >> p.hmax >> p.distance))
      fail("a reference, an entity and three numbers expected");
    if (lower(keyword).rfind("triangle", 0) == 0) parameters[reference] = p;
  }
  return parameters;
}

/// What does not follow the distances of a file, or nothing.
inline std::string limit_of_distances(const Options& options)
{
  const bool has_distance = options.curvature > 0 || (options.tolerance > 0 && options.vertices == 0);
  if (options.size > 0 || !options.metric.empty() || !has_distance)
    return "distances there are not used: they are for sizes from the curvature";
  return options.tolerance > 0 ? "distances there are for the sizes: --tolerance is the same everywhere" : "";
}

/// Puts the parameters of a file on the faces of `mesh`.
inline void put_size_parameters(const Options& options, Constrained_mesh& mesh)
{
  const std::string& file = options.parameters;
  if (file.empty()) return;
  const auto parameters = reading(file, [&] { return read_size_parameters(file); });
  bool has_distance = false;
  for (const Face f : mesh.mesh.faces()) {
    const auto found = parameters.find(mesh.label[f]);
    if (found == parameters.end()) continue;
    const Size_parameters& p = found->second;
    mesh.size_bounds[f] = {p.hmin, p.hmax};
    mesh.deviation[f] = p.distance;
    has_distance = has_distance || p.distance > 0;
  }
  const std::string limit = has_distance ? limit_of_distances(options) : "";
  if (!limit.empty()) mesh.warnings.push_back(file + ": " + limit);
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_SIZE_PARAMETERS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading and writing the surface meshes of adapt_mesh.

#ifndef ADAPT_MESH_MESH_FILES_H
#define ADAPT_MESH_MESH_FILES_H

#include "Medit_content.h"
#include "Polygon_soup.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace adapt_mesh {

namespace SMA = CGAL::Surface_mesh_adaptation;

using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Edge = Mesh::Edge_index;
using Halfedge = Mesh::Halfedge_index;
using Face = Mesh::Face_index;

/// Numbers at elements of a mesh, as a column of a file.
template <class Element>
struct Attribute
{
  std::string name;
  Number_type type;
  Mesh::Property_map<Element, double> map;
};

/// The maps of attributes, as the library takes them.
template <class Element>
std::vector<Mesh::Property_map<Element, double>> maps(const std::vector<Attribute<Element>>& attributes)
{
  std::vector<Mesh::Property_map<Element, double>> result;
  for (const Attribute<Element>& a : attributes) result.push_back(a.map);
  return result;
}

/// A mesh with its constraints and all that its elements carry.
struct Constrained_mesh
{
  Mesh mesh;
  Mesh::Property_map<Edge, bool> edge_is_constrained;
  Mesh::Property_map<Edge, bool> edge_is_protected;
  Mesh::Property_map<Vertex, bool> vertex_is_constrained;
  Mesh::Property_map<Face, int> label;  ///< all 0 if there are none
  Mesh::Property_map<Face, std::pair<double, double>> size_bounds; ///< of the input; 0: no bound
  Mesh::Property_map<Face, double> deviation; ///< that sizes from the curvature aim at in the input; 0: as elsewhere
  bool has_labels = false;
  std::vector<Label> names;             ///< of the labels 0, 1, ...; empty if they are numbers only
  std::string material_library;
  std::vector<Attribute<Vertex>> at_vertices;
  std::vector<Attribute<Face>> at_faces;
  std::vector<Attribute<Halfedge>> at_corners; ///< texture coordinates u, v, each at the halfedge that arrives; or none
  bool has_normals = false;             ///< the input has, at its vertices
  std::unique_ptr<Medit_content> medit; ///< what only MEDIT files have
  std::vector<Vertex> vertex_of_point; ///< the vertex of each point of the file, `null_vertex()` if not used
  std::vector<std::pair<Vertex, Vertex>> copies; ///< vertices that a repair has made, and of which others
  std::vector<std::string> repairs;    ///< what was mended, one sentence each
  std::vector<std::string> warnings;   ///< what a user may not expect

  Constrained_mesh()
    : edge_is_constrained(mesh.add_property_map<Edge, bool>("e:constrained", false).first),
      edge_is_protected(mesh.add_property_map<Edge, bool>("e:protected", false).first),
      vertex_is_constrained(mesh.add_property_map<Vertex, bool>("v:constrained", false).first),
      label(mesh.add_property_map<Face, int>("f:label", 0).first),
      size_bounds(mesh.add_property_map<Face, std::pair<double, double>>("f:size_bounds", {0, 0}).first),
      deviation(mesh.add_property_map<Face, double>("f:deviation", 0).first)
  {}
  Constrained_mesh(const Constrained_mesh&) = delete; // the maps belong to the mesh
  Constrained_mesh& operator=(const Constrained_mesh&) = delete;
};

/// The maps of the attributes at faces, and what else is known of each face.
inline std::vector<Mesh::Property_map<Face, double>> maps_of_faces(const Constrained_mesh& mesh)
{
  auto result = maps(mesh.at_faces);
  if (mesh.medit != nullptr && mesh.medit->has_required_triangles) result.push_back(mesh.medit->is_required);
  return result;
}

/// Of the bounding box.
inline double diagonal(const Mesh& mesh)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::sqrt(CGAL::square(box.x_span()) + CGAL::square(box.y_span()) + CGAL::square(box.z_span()));
}

/// The extension of a file name in lower case, without its dot.
inline std::string extension(const std::string& file)
{
  std::string e = std::filesystem::path(file).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return e.empty() ? e : e.substr(1);
}

inline bool is_mesh_format(const std::string& file)
{
  const std::array<const char*, 6> known = {"off", "obj", "ply", "stl", "mesh", "meshb"};
  return std::find(known.begin(), known.end(), extension(file)) != known.end();
}

inline bool is_medit_format(const std::string& file) { return extension(file) == "mesh" || extension(file) == "meshb"; }

/// What is done to what a file holds.
struct Reading_options
{
  bool weld = true;       ///< join coincident points where edges match then
  bool repair = false;    ///< mend what is no valid surface
  bool references = true; ///< keep labels of faces, and what MEDIT files call references and required
};

/// Reads the mesh in `file`, or in the file of that name among CGAL's data, into the empty `result`.
/// \pre `is_mesh_format(file)`
/// \throws Io_error, Invalid_input_error, Invalid_extent_error, Empty_mesh_error; Bad_input with all that is wrong
void read_mesh(const std::string& file, Constrained_mesh& result, const Reading_options& options = Reading_options());

/// The same with `text`, the content of `file`, which tells the format and is named in errors.
void parse_mesh(const std::string& text, const std::string& file, Constrained_mesh& result,
                const Reading_options& options = Reading_options());

/// Writes the mesh to `file`. Returns warnings. \pre `is_mesh_format(file)` \throws Io_error
std::vector<std::string> write_mesh(const std::string& file, const Constrained_mesh& mesh);

} // namespace adapt_mesh

#endif // ADAPT_MESH_MESH_FILES_H

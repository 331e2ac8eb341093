// SPDX-License-Identifier: GPL-3.0-or-later
//
// What MEDIT files say of the elements of a surface beyond what other formats know: references, and what is required.

#ifndef ADAPT_MESH_MEDIT_CONTENT_H
#define ADAPT_MESH_MEDIT_CONTENT_H

#include "Polygon_soup.h"

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace adapt_mesh {

/// By maps that keep their values where a vertex of the input is still there, and places.
struct Medit_content
{
  using Mesh = CGAL::Surface_mesh<Point>;
  using Vertex = Mesh::Vertex_index;
  using Face = Mesh::Face_index;

  Mesh::Property_map<Vertex, int> reference;      ///< of each vertex
  Mesh::Property_map<Vertex, bool> is_corner;     ///< else a constrained vertex is required
  Mesh::Property_map<Vertex, unsigned> number;    ///< of the vertex in the input, from 1 on; 0: none
  Mesh::Property_map<Face, double> is_required;   ///< whether the triangle is
  bool has_required_triangles = false;
  std::map<std::array<unsigned, 2>, int> required_edges; ///< their references, by the numbers of their ends
  std::vector<std::array<Point, 2>> referenced_edges;    ///< of the input, with references other than 0
  std::vector<int> edge_references;                      ///< of these

  explicit Medit_content(Mesh& mesh)
    : reference(mesh.add_property_map<Vertex, int>("v:reference", 0).first),
      is_corner(mesh.add_property_map<Vertex, bool>("v:corner", false).first),
      number(mesh.add_property_map<Vertex, unsigned>("v:number", 0).first),
      is_required(mesh.add_property_map<Face, double>("f:required", 0).first)
  {}
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_MEDIT_CONTENT_H

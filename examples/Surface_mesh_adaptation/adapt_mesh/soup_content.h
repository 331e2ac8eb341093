// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the points and polygons of a file carry, on the mesh that was made of them.

#ifndef ADAPT_MESH_SOUP_CONTENT_H
#define ADAPT_MESH_SOUP_CONTENT_H

#include "Polygon_soup.h"
#include "mesh_files.h"

#include <CGAL/Surface_mesh_adaptation/IO/Repair_report.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace adapt_mesh {

class Soup_content
{
public:
  /// \param points those of the soup, which the making of the mesh takes out of it
  Soup_content(const Polygon_soup& soup, const std::vector<Point>& points, const SMA::Repair_report& report)
    : soup_(soup), points_(points), report_(report)
  {}

  void put_on(Constrained_mesh& result, bool with_labels) const
  {
    put_columns<Vertex>(soup_.of_points, report_.point_of_vertex, result.mesh.vertices(), result, result.at_vertices);
    put_columns<Face>(soup_.of_polygons, report_.polygon_of_face, result.mesh.faces(), result, result.at_faces);
    if (with_labels) put_labels(result);
    if (!soup_.of_corners.empty()) put_corners(result);
    result.has_normals = soup_.has_normals;
    result.material_library = soup_.material_library;
  }

private:
  template <class Element, class Elements>
  static void put_columns(const std::vector<Column>& columns, const std::vector<std::size_t>& source,
                          const Elements& elements, Constrained_mesh& result, std::vector<Attribute<Element>>& attributes)
  {
    for (const Column& c : columns) {
      const std::string name = "attribute:" + std::to_string(attributes.size()) + ":" + c.name;
      Attribute<Element> a{c.name, c.type, result.mesh.add_property_map<Element, double>(name, 0).first};
      std::size_t i = 0;
      for (const Element e : elements) {
        const std::size_t s = source[i++];
        a.map[e] = s == SMA::Repair_report::none ? 0 : c.values[s];
      }
      attributes.push_back(std::move(a));
    }
  }

  void put_labels(Constrained_mesh& result) const
  {
    if (soup_.labels.empty()) return;
    result.has_labels = true;
    result.names = soup_.names;
    std::size_t i = 0;
    for (const Face f : result.mesh.faces()) {
      const std::size_t p = report_.polygon_of_face[i++];
      result.label[f] = p == SMA::Repair_report::none ? soup_.labels.front() : soup_.labels[p];
    }
  }

  /// Corners are found by their points: welding may have taken others of the same place.
  void put_corners(Constrained_mesh& result) const
  {
    Mesh& mesh = result.mesh;
    std::vector<std::size_t> first{0}; // corner of each polygon
    for (const Polygon& p : soup_.polygons) first.push_back(first.back() + p.size());
    std::array<Mesh::Property_map<Halfedge, double>, 2> maps;
    for (std::size_t k = 0; k < 2; ++k) {
      maps[k] = mesh.add_property_map<Halfedge, double>(k == 0 ? "h:u" : "h:v", 0).first;
      result.at_corners.push_back({k == 0 ? "u" : "v", {'f', 8}, maps[k]});
    }
    std::size_t i = 0;
    for (const Face f : mesh.faces()) {
      const std::size_t p = report_.polygon_of_face[i++];
      if (p == SMA::Repair_report::none) continue;
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
        for (std::size_t c = 0; c < soup_.polygons[p].size(); ++c)
          if (points_[soup_.polygons[p][c]] == mesh.point(mesh.target(h)))
            for (std::size_t k = 0; k < 2; ++k) maps[k][h] = soup_.of_corners[first[p] + c][k];
    }
  }

  const Polygon_soup& soup_;
  const std::vector<Point>& points_;
  const SMA::Repair_report& report_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_SOUP_CONTENT_H

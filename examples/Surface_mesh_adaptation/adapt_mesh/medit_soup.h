// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface in a MEDIT file as polygons.

#ifndef ADAPT_MESH_MEDIT_SOUP_H
#define ADAPT_MESH_MEDIT_SOUP_H

#include "Polygon_soup.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_mesh.h>

#include <algorithm>
#include <string>
#include <vector>

namespace adapt_mesh {

/// The triangles come first, then the quadrilaterals.
inline Polygon_soup polygon_soup(const CGAL::Surface_mesh_adaptation::Medit_mesh& medit)
{
  Polygon_soup soup;
  soup.points.reserve(medit.points.size());
  soup.polygons.reserve(medit.triangles.size() + medit.quadrilaterals.size());
  for (const auto& p : medit.points) soup.points.emplace_back(p[0], p[1], p[2]);
  for (const auto& t : medit.triangles) soup.polygons.emplace_back(t.begin(), t.end());
  for (const auto& q : medit.quadrilaterals) soup.polygons.emplace_back(q.begin(), q.end());

  soup.labels = medit.triangle_references;
  soup.labels.insert(soup.labels.end(), medit.quadrilateral_references.begin(), medit.quadrilateral_references.end());
  for (const std::string& section : medit.ignored_sections) soup.lost.push_back("the section " + section);
  return soup;
}

/// Whether the surface bounds or divides a volume, which has vertices of its own.
inline bool has_volume(const CGAL::Surface_mesh_adaptation::Medit_mesh& medit)
{
  const auto& sections = medit.ignored_sections;
  return std::any_of(sections.begin(), sections.end(), [](const std::string& s) {
    return s == "Tetrahedra" || s == "Hexahedra" || s == "Prisms" || s == "Pyramids";
  });
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_MEDIT_SOUP_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_POLYGON_SOUP_H
#define ADAPT_MESH_POLYGON_SOUP_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace adapt_mesh {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// The indices of the corners of a face. A file that announces a huge one costs nothing.
class Polygon : public boost::container::small_vector<std::size_t, 4>
{
public:
  using boost::container::small_vector<std::size_t, 4>::small_vector;

  void resize(std::size_t n)
  {
    constexpr std::size_t most = 1 << 20;
    if (n > most) throw std::length_error("a face with too many corners");
    boost::container::small_vector<std::size_t, 4>::resize(n);
  }
};

/// How a file writes numbers.
struct Number_type
{
  char kind;        ///< i, u or f: signed, unsigned or real
  std::size_t size; ///< in bytes
};

/// A number for each element.
struct Column
{
  std::string name;
  Number_type type;
  std::vector<double> values;
};

/// The name of a group of faces: in obj files of an object, a group and a material, in stl files of a solid.
struct Label
{
  std::string object, group, material;

  friend bool operator==(const Label& a, const Label& b)
  {
    return a.object == b.object && a.group == b.group && a.material == b.material;
  }
};

/// What a file holds, unchecked.
struct Polygon_soup
{
  std::vector<Point> points;
  std::vector<Polygon> polygons;
  std::vector<Column> of_points, of_polygons;
  std::vector<int> labels;                      ///< of the polygons; empty if there are none
  std::vector<Label> names;                     ///< of the labels 0, 1, ...; empty if they are numbers only
  std::string material_library;                 ///< a file
  std::vector<std::array<double, 2>> of_corners; ///< texture coordinates of the corners of all polygons; empty if there are none
  bool has_normals = false;                     ///< at the points
  std::vector<std::string> lost;                ///< names of what else there is
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_POLYGON_SOUP_H

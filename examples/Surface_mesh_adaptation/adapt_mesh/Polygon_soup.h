// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_POLYGON_SOUP_H
#define ADAPT_MESH_POLYGON_SOUP_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <boost/container/small_vector.hpp>

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

/// What a file holds, unchecked.
struct Polygon_soup
{
  std::vector<Point> points;
  std::vector<Polygon> polygons;
  std::vector<std::string> lost; ///< names of what else there is, colours for instance
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_POLYGON_SOUP_H

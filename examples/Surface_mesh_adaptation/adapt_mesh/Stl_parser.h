// SPDX-License-Identifier: GPL-3.0-or-later
//
// STL files, text and binary. Corners of triangles at the same place are one point; triangles that two corners at one
// place leave without an area, as CAD systems write them at the tips of cones, are none.

#ifndef ADAPT_MESH_STL_PARSER_H
#define ADAPT_MESH_STL_PARSER_H

#include "Label_list.h"
#include "Polygon_soup.h"
#include "Text_cursor.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace adapt_mesh {

/// Numbers points in the order in which they come, those with the same coordinates once: a hash table of their numbers.
class Point_numbering
{
public:
  explicit Point_numbering(std::vector<Point>& points) : points_(points), slots_(1 << 10, empty) {}

  std::size_t operator()(double x, double y, double z)
  {
    const Key key = {bits(x), bits(y), bits(z)};
    std::size_t& slot = slots_[place(key)];
    if (slot != empty) return slot;
    const std::size_t number = slot = points_.size();
    points_.emplace_back(x, y, z);
    if (2 * points_.size() > slots_.size()) grow();
    return number;
  }

private:
  using Key = std::array<std::uint64_t, 3>;

  static std::uint64_t bits(double x)
  {
    const double positive_zero = x + 0.0;
    std::uint64_t result;
    std::memcpy(&result, &positive_zero, sizeof result);
    return result;
  }

  static Key key(const Point& p) { return {bits(p.x()), bits(p.y()), bits(p.z())}; }

  /// Of the point with this key, or where it would be.
  std::size_t place(const Key& k) const
  {
    std::uint64_t hash = 0;
    for (const std::uint64_t x : k) hash = CGAL::Surface_mesh_adaptation::hash_of_id(hash ^ x);
    std::size_t i = std::size_t(hash) & (slots_.size() - 1);
    while (slots_[i] != empty && key(points_[slots_[i]]) != k) i = (i + 1) & (slots_.size() - 1);
    return i;
  }

  void grow()
  {
    slots_.assign(4 * slots_.size(), empty);
    for (std::size_t i = 0; i < points_.size(); ++i) slots_[place(key(points_[i]))] = i;
  }

  static constexpr std::size_t empty = std::size_t(-1);

  std::vector<Point>& points_;
  std::vector<std::size_t> slots_; // a power of two, at most half of them in use
};

class Stl_parser
{
public:
  /// \param text the content of the file `file`, which is named in errors only
  Stl_parser(const std::string& text, const std::string& file)
    : text_(text), file_(file), in_(text, file), number_(soup_.points)
  {}

  /// \throws Io_error
  Polygon_soup parse()
  {
    if (is_binary()) read_binary();
    else read_text();
    leave_out_collapsed();
    return std::move(soup_);
  }

private:
  static constexpr std::size_t size_of_header = 84, size_of_triangle = 50, size_of_normal = 12;

  /// What is as long as it says is binary, whatever its header says.
  bool is_binary() const
  {
    if (text_.size() < size_of_header) return false;
    const std::size_t size = size_of_header + number_of_triangles() * size_of_triangle;
    return size == text_.size() || (size < text_.size() && text_.find('\0') != std::string::npos);
  }

  template <class Number>
  Number at(std::size_t position) const
  {
    Number x;
    std::memcpy(&x, text_.data() + position, sizeof x);
    return x;
  }

  std::size_t number_of_triangles() const { return at<std::uint32_t>(size_of_header - 4); }

  void read_binary()
  {
    soup_.polygons.resize(number_of_triangles());
    std::size_t position = size_of_header;
    for (Polygon& polygon : soup_.polygons) {
      std::array<float, 9> x;
      std::memcpy(x.data(), text_.data() + position + size_of_normal, sizeof x);
      for (std::size_t i = 0; i < 9; i += 3) polygon.push_back(number_(x[i], x[i + 1], x[i + 2]));
      position += size_of_triangle;
    }
  }

  void read_text()
  {
    Label_list labels(soup_);
    Label label;
    std::size_t solids = 0;
    bool is_open = false;
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      if (word == "solid") {
        if (is_open) in_.fail("not a valid stl file: a solid within another one");
        label.group = in_.rest_of_line();
        is_open = true;
        ++solids;
      } else if (word == "facet") {
        labels.add(label);
        read_facet();
      } else if (word == "endsolid") {
        in_.skip_line();
        is_open = false;
      }
    }
    if (is_open || solids == 0) in_.fail("not a valid stl file: a solid does not end, or there is none");
    labels.end(solids > 1);
  }

  void read_facet()
  {
    soup_.polygons.emplace_back();
    for (std::string_view word = in_.word(); word != "endfacet"; word = in_.word()) {
      if (word.empty()) in_.fail("not a valid stl file: a facet does not end");
      if (word != "vertex") continue;
      const double x = coordinate(), y = coordinate(), z = coordinate();
      soup_.polygons.back().push_back(number_(x, y, z));
    }
    if (soup_.polygons.back().size() != 3) in_.fail("not a valid stl file: a facet is no triangle");
  }

  void leave_out_collapsed()
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < soup_.polygons.size(); ++i) {
      const Polygon& p = soup_.polygons[i];
      if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
      soup_.polygons[kept] = p;
      if (!soup_.labels.empty()) soup_.labels[kept] = soup_.labels[i];
      ++kept;
    }
    const std::size_t n = soup_.polygons.size() - kept;
    if (n == 0) return;
    soup_.polygons.resize(kept);
    if (!soup_.labels.empty()) soup_.labels.resize(kept);
    soup_.lost.push_back(std::to_string(n) + (n == 1 ? " triangle" : " triangles") + " with two corners at one place");
  }

  double coordinate() { return in_.number<double>("a coordinate"); }

  const std::string& text_;
  std::string file_;
  Text_cursor in_;
  Polygon_soup soup_;
  Point_numbering number_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_STL_PARSER_H

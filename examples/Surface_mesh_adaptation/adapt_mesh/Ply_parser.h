// SPDX-License-Identifier: GPL-3.0-or-later
//
// PLY files, text and binary. Unlike CGAL's reader, this one allocates only what the length of the file can back: the
// number of corners of a face stands within the file, where it cannot be checked beforehand.

#ifndef ADAPT_MESH_PLY_PARSER_H
#define ADAPT_MESH_PLY_PARSER_H

#include "Polygon_soup.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace adapt_mesh {

class Ply_parser
{
public:
  /// \param text the content of the file `file`, which is named in errors only
  Ply_parser(const std::string& text, const std::string& file)
    : file_(file), begin_(text.data()), end_(begin_ + text.size()), next_(begin_)
  {}

  /// \throws Io_error
  Polygon_soup parse()
  {
    read_header();
    for (const Element& e : elements_) {
      check_count(e);
      if (e.name == "vertex" || e.name == "vertices") read_points(e);
      else if (e.name == "face" || e.name == "faces") read_polygons(e);
      else skip(e);
    }
    return std::move(soup_);
  }

private:
  enum class Format { text, little_endian, big_endian };

  using Type = Number_type;

  struct Property
  {
    std::string name;
    Type type;
    Type count; // of a list; size 0: no list
  };

  struct Element
  {
    std::string name;
    std::size_t count;
    std::vector<Property> properties;

    std::size_t index_of(const std::string& property) const
    {
      const auto has_name = [&](const Property& p) { return p.name == property; };
      return std::size_t(std::find_if(properties.begin(), properties.end(), has_name) - properties.begin());
    }
  };

  [[noreturn]] void fail(const std::string& what) const
  {
    const bool in_text = format_ == Format::text || next_ < body_ || body_ == nullptr;
    const std::size_t line = in_text ? std::size_t(std::count(begin_, next_, '\n')) + 1 : 0;
    throw CGAL::Surface_mesh_adaptation::Io_error(file_, line, what);
  }

  // the header

  std::istringstream header_line()
  {
    if (next_ == end_) fail("the header does not end");
    const char* const last = std::find(next_, end_, '\n');
    std::string line(next_, last);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    next_ = last == end_ ? end_ : last + 1;
    return std::istringstream(line);
  }

  void read_header()
  {
    std::string keyword;
    if (!(header_line() >> keyword) || keyword != "ply") fail("not a valid ply file");
    for (;;) {
      std::istringstream line = header_line();
      if (!(line >> keyword)) continue;
      if (keyword == "end_header") break;
      if (keyword == "format") read_format(line);
      else if (keyword == "element") read_element(line);
      else if (keyword == "property") read_property(line);
      else if (keyword != "comment" && keyword != "obj_info") fail("unknown keyword in the header");
    }
    body_ = next_;
  }

  void read_format(std::istream& line)
  {
    std::string name;
    line >> name;
    if (name == "ascii") format_ = Format::text;
    else if (name == "binary_little_endian") format_ = Format::little_endian;
    else if (name == "binary_big_endian") format_ = Format::big_endian;
    else fail("unknown format");
  }

  void read_element(std::istream& line)
  {
    Element e;
    if (!(line >> e.name >> e.count)) fail("a name and a number expected");
    elements_.push_back(std::move(e));
  }

  void read_property(std::istream& line)
  {
    std::string type, count;
    Property p{"", {0, 0}, {0, 0}};
    line >> type;
    if (type == "list") {
      line >> count >> type;
      p.count = type_of(count);
    }
    if (!(line >> p.name) || elements_.empty()) fail("a property of an element expected");
    p.type = type_of(type);
    elements_.back().properties.push_back(p);
  }

  Type type_of(const std::string& name) const
  {
    constexpr std::array<std::pair<const char*, Type>, 16> types = {
      {{"char", {'i', 1}}, {"int8", {'i', 1}}, {"uchar", {'u', 1}}, {"uint8", {'u', 1}},
       {"short", {'i', 2}}, {"int16", {'i', 2}}, {"ushort", {'u', 2}}, {"uint16", {'u', 2}},
       {"int", {'i', 4}}, {"int32", {'i', 4}}, {"uint", {'u', 4}}, {"uint32", {'u', 4}},
       {"float", {'f', 4}}, {"float32", {'f', 4}}, {"double", {'f', 8}}, {"float64", {'f', 8}}}};
    for (const auto& [known, type] : types)
      if (name == known) return type;
    fail("unknown type");
  }

  // values

  std::size_t rest() const { return std::size_t(end_ - next_); }

  /// The least number of characters of a value.
  std::size_t length(const Type& type) const { return format_ == Format::text ? 2 : type.size; }

  void check_count(const Element& e) const
  {
    std::size_t length_of_item = 0;
    for (const Property& p : e.properties) length_of_item += length(p.count.size > 0 ? p.count : p.type);
    if (e.count > 0 && (length_of_item == 0 || e.count > (rest() + 1) / length_of_item))
      fail("the file is too short for the numbers in its header");
  }

  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  /// All types of values are `double` without loss.
  double value(const Type& type) { return format_ == Format::text ? word() : binary(type); }

  double word()
  {
    next_ = std::find_if_not(next_, end_, is_blank);
    const char* const first = next_ != end_ && *next_ == '+' ? next_ + 1 : next_; // from_chars() knows no '+'
    double x = 0;
    const std::from_chars_result result = std::from_chars(first, end_, x);
    if (result.ec == std::errc::invalid_argument || (result.ptr != end_ && !is_blank(*result.ptr)))
      fail("a number expected");
    if (result.ec == std::errc::result_out_of_range) x = std::strtod(first, nullptr); // 0 or infinite
    next_ = result.ptr;
    return x;
  }

  double binary(const Type& type)
  {
    if (rest() < type.size) fail("the file ends early");
    std::array<char, 8> bytes{};
    std::copy(next_, next_ + type.size, bytes.begin());
    next_ += type.size;
    const bool is_swapped = (format_ == Format::big_endian) == is_little_endian();
    if (is_swapped) std::reverse(bytes.begin(), bytes.begin() + std::ptrdiff_t(type.size));
    const char* const b = bytes.data();
    if (type.kind == 'f') return type.size == 4 ? double(read<float>(b)) : read<double>(b);
    if (type.kind == 'u') return integer<std::uint8_t, std::uint16_t, std::uint32_t>(b, type.size);
    return integer<std::int8_t, std::int16_t, std::int32_t>(b, type.size);
  }

  template <class One, class Two, class Four>
  static double integer(const char* bytes, std::size_t size)
  {
    return size == 1 ? read<One>(bytes) : size == 2 ? read<Two>(bytes) : double(read<Four>(bytes));
  }

  static bool is_little_endian()
  {
    const std::uint16_t one = 1;
    return *reinterpret_cast<const char*>(&one) == 1;
  }

  template <class T>
  static T read(const char* bytes)
  {
    T x;
    std::memcpy(&x, bytes, sizeof(T));
    return x;
  }

  std::size_t length_of_list(const Property& p)
  {
    const double n = value(p.count);
    if (!(n >= 0) || n * double(length(p.type)) > double(rest() + 1)) fail("the file is too short for a list");
    return std::size_t(n);
  }

  void skip(const Property& p)
  {
    for (std::size_t n = p.count.size > 0 ? length_of_list(p) : 1; n > 0; --n) value(p.type);
  }

  // elements

  void skip(const Element& e)
  {
    soup_.lost.push_back("element " + e.name);
    for (std::size_t i = 0; i < e.count; ++i)
      for (const Property& p : e.properties) skip(p);
  }

  void read_points(const Element& e)
  {
    std::vector<std::size_t> coordinate(e.properties.size(), 3); // that each property is, 3: none
    for (const char* name : {"x", "y", "z"}) {
      const std::size_t i = e.index_of(name);
      if (i == e.properties.size() || e.properties[i].count.size > 0) fail("vertices without coordinates");
      coordinate[i] = std::size_t(name[0] - 'x');
    }
    const std::vector<std::size_t> column = columns(e, "vertex", soup_.of_points, [&](std::size_t i) {
      return coordinate[i] == 3 && !is_normal(e.properties[i]);
    });
    soup_.points.reserve(e.count);
    std::array<double, 3> p{};
    for (std::size_t n = 0; n < e.count; ++n) {
      for (std::size_t i = 0; i < e.properties.size(); ++i)
        if (coordinate[i] < 3) p[coordinate[i]] = value(e.properties[i].type);
        else read_or_skip(e.properties[i], column[i], soup_.of_points);
      soup_.points.emplace_back(p[0], p[1], p[2]);
    }
  }

  /// Normals are computed anew.
  bool is_normal(const Property& p)
  {
    const bool is = p.count.size == 0 && (p.name == "nx" || p.name == "ny" || p.name == "nz");
    soup_.has_normals = soup_.has_normals || is;
    return is;
  }

  static constexpr std::size_t no_column = std::size_t(-1);

  /// The place of each property of `e` among `all`, to which those are added that are single numbers and `is_wanted(i)`.
  template <class IsWanted>
  std::vector<std::size_t> columns(const Element& e, const char* kind, std::vector<Column>& all, const IsWanted& is_wanted)
  {
    std::vector<std::size_t> place(e.properties.size(), no_column);
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (!is_wanted(i)) continue;
      const Property& p = e.properties[i];
      if (p.count.size > 0) {
        soup_.lost.push_back(p.name + " of each " + kind);
        continue;
      }
      place[i] = all.size();
      all.push_back({p.name, p.type, {}});
    }
    return place;
  }

  void read_or_skip(const Property& p, std::size_t column, std::vector<Column>& all)
  {
    if (column == no_column) skip(p);
    else all[column].values.push_back(value(p.type));
  }

  void read_polygons(const Element& e)
  {
    const std::size_t corners = (std::min)(e.index_of("vertex_indices"), e.index_of("vertex_index"));
    if (corners == e.properties.size() || e.properties[corners].count.size == 0) fail("faces without vertex_indices");
    const std::size_t uv = e.index_of("texcoord");
    const bool has_uv = uv < e.properties.size() && e.properties[uv].count.size > 0;
    const std::vector<std::size_t> column = columns(e, "face", soup_.of_polygons, [&](std::size_t i) {
      return i != corners && !(has_uv && i == uv);
    });
    soup_.polygons.resize(e.count);
    for (Polygon& polygon : soup_.polygons) {
      std::vector<double> coordinates;
      for (std::size_t i = 0; i < e.properties.size(); ++i)
        if (i == corners) read_polygon(e.properties[i], polygon);
        else if (has_uv && i == uv) coordinates = read_list(e.properties[i]);
        else read_or_skip(e.properties[i], column[i], soup_.of_polygons);
      if (has_uv) add_corners(polygon.size(), coordinates);
    }
  }

  std::vector<double> read_list(const Property& p)
  {
    std::vector<double> list(length_of_list(p));
    for (double& x : list) x = value(p.type);
    return list;
  }

  /// \param uv two numbers for each corner of a face; if there are others, the face has none
  void add_corners(std::size_t n, std::vector<double> uv)
  {
    if (uv.size() != 2 * n) uv.assign(2 * n, 0);
    for (std::size_t i = 0; i < n; ++i) soup_.of_corners.push_back({uv[2 * i], uv[2 * i + 1]});
  }

  void read_polygon(const Property& p, Polygon& polygon)
  {
    polygon.resize(length_of_list(p));
    for (std::size_t& v : polygon) {
      const double index = value(p.type);
      v = index >= 0 && index < 4294967296. ? std::size_t(index) : std::size_t(-1);
    }
  }

  std::string file_;
  const char* begin_;
  const char* end_;
  const char* next_;
  const char* body_ = nullptr; // what follows the header
  Format format_ = Format::text;
  std::vector<Element> elements_;
  Polygon_soup soup_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_PLY_PARSER_H

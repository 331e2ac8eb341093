// SPDX-License-Identifier: GPL-3.0-or-later
//
// OFF files in text form, read word by word: lines may be broken anywhere, comments may stand anywhere. Only what comes
// after a vertex or a face, as colours do, ends with the line. What a file announces is allocated only as far as its
// length can back it.

#ifndef ADAPT_MESH_OFF_PARSER_H
#define ADAPT_MESH_OFF_PARSER_H

#include "Polygon_soup.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace adapt_mesh {

class Off_parser
{
public:
  /// \param text the content of the file `file`, which is named in errors only
  Off_parser(const std::string& text, const std::string& file)
    : file_(file), begin_(text.data()), end_(begin_ + text.size()), next_(begin_)
  {}

  /// \throws Io_error
  Polygon_soup parse()
  {
    read_header();
    const std::size_t vertices = count("the number of vertices", 6);
    const bool is_broken = at_end_of_line();
    const std::size_t faces = count("the number of faces", 2);
    if (is_broken || !at_end_of_line() || words_in_line() == 1) // it may be missing
      number<long long>("the number of edges");
    read_points(vertices);
    read_polygons(faces);
    return std::move(soup_);
  }

private:
  [[noreturn]] void fail(const char* position, const std::string& what) const
  {
    const auto line = std::count(begin_, position, '\n') + 1;
    throw CGAL::Surface_mesh_adaptation::Io_error(file_, std::size_t(line), what);
  }

  // words

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
  static bool is_separator(char c) { return is_blank(c) || c == '\n' || c == '#'; }

  /// To the next word in this line, or to its end.
  void skip_blanks()
  {
    while (next_ != end_ && is_blank(*next_)) ++next_;
    if (next_ != end_ && *next_ == '#') next_ = std::find(next_, end_, '\n');
  }

  bool at_end_of_line()
  {
    skip_blanks();
    return next_ == end_ || *next_ == '\n';
  }

  void skip_to_word()
  {
    while (at_end_of_line() && next_ != end_) ++next_;
  }

  /// Returns whether there was anything.
  bool skip_line()
  {
    const bool any = !at_end_of_line();
    next_ = std::find(next_, end_, '\n');
    return any;
  }

  std::string_view word()
  {
    skip_to_word();
    const char* const first = next_;
    next_ = std::find_if(first, end_, is_separator);
    return {first, std::size_t(next_ - first)};
  }

  std::size_t words_in_line()
  {
    const char* const first = next_;
    skip_to_word();
    std::size_t n = 0;
    for (; !at_end_of_line(); ++n) word();
    next_ = first;
    return n;
  }

  template <class Number>
  Number number(const char* what)
  {
    skip_to_word();
    const char* const word = next_;
    const char* const first = word != end_ && *word == '+' ? word + 1 : word; // from_chars() knows no '+'
    Number value = 0;
    const std::from_chars_result result = std::from_chars(first, end_, value);
    if (result.ec == std::errc::invalid_argument || (result.ptr != end_ && !is_separator(*result.ptr)))
      fail(word, std::string(what) + " expected, but there is " + quoted(word));
    next_ = result.ptr;
    if (result.ec == std::errc::result_out_of_range) value = out_of_range(first, Number());
    return value;
  }

  /// Zero or infinity.
  static double out_of_range(const char* first, double) { return std::strtod(first, nullptr); }
  static long long out_of_range(const char*, long long) { return -1; }

  /// The word at `position`, fit for a message.
  std::string quoted(const char* position) const
  {
    constexpr std::ptrdiff_t longest = 32;
    if (position == end_) return "the end of the file";
    std::string text(position, std::find_if(position, position + (std::min)(longest, end_ - position), is_separator));
    std::replace_if(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + text + "'";
  }

  // parts of the file

  void read_header()
  {
    if (std::string_view(begin_, std::size_t(end_ - begin_)).substr(0, 3) == "\xEF\xBB\xBF") next_ += 3;
    skip_to_word();
    const char* const position = next_;
    std::string_view kind = word();
    if (kind.size() < 3 || kind.substr(kind.size() - 3) != "OFF") fail(position, "not the header of an off file");
    kind.remove_suffix(3);
    read_kind(kind, position);
    if (!at_end_of_line() && *next_ == 'B') fail(next_, "binary off files are not supported");
  }

  void read_kind(std::string_view kind, const char* position)
  {
    const auto takes = [&](std::string_view prefix) {
      const bool found = kind.substr(0, prefix.size()) == prefix;
      if (found) kind.remove_prefix(prefix.size());
      return found;
    };
    while (!kind.empty()) {
      has_more_columns_ = true;
      if (takes("ST")) soup_.lost.push_back("texture coordinates");
      else if (takes("C")) has_colours_ = true;
      else if (takes("N")) soup_.has_normals = true;
      else if (takes("4") || takes("n")) fail(position, "the points are not in three dimensions");
      else fail(position, "not the header of an off file");
    }
  }

  /// \param length the least number of characters of an item
  std::size_t count(const char* what, std::size_t length)
  {
    const auto n = number<long long>(what);
    if (n < 0 || std::size_t(n) > std::size_t(end_ - begin_) / length)
      fail(next_, "the file is too short for " + std::string(what) + " in its header");
    return std::size_t(n);
  }

  /// What follows the coordinates is in the order of the header: normals, which are computed anew, colours, texture
  /// coordinates, which are left out. Numbers that the header does not announce are taken for colours if there are three
  /// or four.
  void read_points(std::size_t n)
  {
    const std::size_t words = n > 0 ? words_in_line() : 0;
    if (!has_more_columns_ && words > 3) {
      has_more_columns_ = true;
      has_colours_ = words == 6 || words == 7;
      if (!has_colours_) soup_.lost.push_back("columns after the coordinates");
    }
    const std::size_t before_colours = soup_.has_normals ? 3 : 0;
    soup_.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double x = coordinate(), y = coordinate(), z = coordinate();
      soup_.points.emplace_back(x, y, z);
      if (has_colours_) {
        for (std::size_t k = 0; k < before_colours; ++k) coordinate();
        read_colour(soup_.of_points, i);
      }
      if (has_more_columns_) skip_line();
    }
  }

  /// Reads the colour of element `i`: numbers up to 1 or up to 255, in the first line as in the others.
  void read_colour(std::vector<Column>& columns, std::size_t i)
  {
    constexpr std::array<const char*, 4> names = {"red", "green", "blue", "alpha"};
    const std::size_t n = (std::min)(words_in_line_or_less(), names.size());
    if (n < 3) return fill_colours(columns, i);
    const char* const first = next_;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = number<double>("a colour");
      if (columns.size() <= k && i == 0) columns.push_back({names[k], {'u', 1}, {}});
      if (k >= columns.size()) continue;
      const bool is_share = std::find(first, next_, '.') != next_;
      if (is_share) columns[k].type = {'f', 4};
      columns[k].values.push_back(x);
    }
    fill_colours(columns, i);
  }

  /// Elements without a colour, or with less than the others have.
  static void fill_colours(std::vector<Column>& columns, std::size_t i)
  {
    for (Column& c : columns) c.values.resize(i + 1, 0);
  }

  std::size_t words_in_line_or_less() { return at_end_of_line() ? 0 : words_in_line(); }

  double coordinate() { return number<double>("a coordinate"); }

  void read_polygons(std::size_t n)
  {
    std::size_t i = 0;
    soup_.polygons.resize(n);
    for (Polygon& polygon : soup_.polygons) {
      const auto corners = number<long long>("the number of corners of a face");
      if (corners < 0 || corners > (end_ - next_) / 2) fail(next_, "the file is too short for a face");
      polygon.resize(std::size_t(corners));
      for (std::size_t& v : polygon) v = std::size_t(number<long long>("the index of a corner"));
      read_colour(soup_.of_polygons, i++);
      skip_line();
    }
  }

  std::string file_;
  const char* begin_;
  const char* end_;
  const char* next_;
  bool has_colours_ = false;
  bool has_more_columns_ = false; // after the coordinates of each vertex, up to the end of the line
  Polygon_soup soup_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_OFF_PARSER_H

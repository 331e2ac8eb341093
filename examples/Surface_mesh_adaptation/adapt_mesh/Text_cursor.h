// SPDX-License-Identifier: GPL-3.0-or-later
//
// Words and numbers of a text, one after another.

#ifndef ADAPT_MESH_TEXT_CURSOR_H
#define ADAPT_MESH_TEXT_CURSOR_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace adapt_mesh {

class Text_cursor
{
public:
  /// \param text the content of the file `file`, which is named in errors only
  Text_cursor(const std::string& text, const std::string& file)
    : file_(file), begin_(text.data()), end_(begin_ + text.size()), next_(begin_)
  {}

  bool at_end() const { return next_ == end_; }

  /// Whether there is no further word in this line, nor in those that a backslash makes a part of it.
  bool at_end_of_line()
  {
    for (; next_ != end_ && (is_blank(*next_) || is_continued()); ++next_)
      if (*next_ == '\\') next_ = std::find(next_, end_, '\n');
    return next_ == end_ || *next_ == '\n';
  }

  void skip_line()
  {
    next_ = std::find(next_, end_, '\n');
    if (next_ != end_) ++next_;
  }

  /// The next word of this line, empty at its end.
  std::string_view word_of_line()
  {
    if (at_end_of_line()) return {};
    const char* const first = next_;
    next_ = std::find_if(first, end_, is_separator);
    return {first, std::size_t(next_ - first)};
  }

  void skip_rest_of_word()
  {
    while (next_ != end_ && !is_separator(*next_) && !is_continued()) ++next_;
  }

  /// The next word, empty at the end of the text.
  std::string_view word()
  {
    while (at_end_of_line() && next_ != end_) ++next_;
    return word_of_line();
  }

  /// The words of this line from the next one on.
  std::string rest_of_line()
  {
    if (at_end_of_line()) return "";
    const char* const first = next_;
    const char* last = std::find(first, end_, '\n');
    next_ = last;
    while (is_blank(last[-1])) --last;
    return std::string(first, last);
  }

  /// The next character, 0 at the end.
  char peek() const { return next_ != end_ ? *next_ : '\0'; }

  /// Whether the next character is `c`, which is taken then.
  bool takes(char c)
  {
    const bool found = next_ != end_ && *next_ == c;
    if (found) ++next_;
    return found;
  }

  /// Reads a number, which may stand in another line.
  template <class Number>
  Number number(const char* what)
  {
    while (next_ != end_ && (is_blank(*next_) || *next_ == '\n')) ++next_;
    takes('+'); // which from_chars() does not know
    Number value = 0;
    const std::from_chars_result result = std::from_chars(next_, end_, value);
    if (result.ec == std::errc::invalid_argument) fail(std::string(what) + " expected");
    if (result.ec == std::errc::result_out_of_range) value = out_of_range(next_, Number());
    next_ = result.ptr;
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw CGAL::Surface_mesh_adaptation::Io_error(file_, std::size_t(std::count(begin_, next_, '\n')) + 1, what);
  }

private:
  /// Whether the next character is a backslash that ends its line, which goes on in the next one.
  bool is_continued() const
  {
    if (*next_ != '\\') return false;
    const std::string_view rest(next_ + 1, std::size_t(end_ - next_ - 1));
    return rest.substr(0, 1) == "\n" || rest.substr(0, 2) == "\r\n";
  }

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
  static bool is_separator(char c) { return is_blank(c) || c == '\n'; }

  static double out_of_range(const char* first, double) { return std::strtod(first, nullptr); } // zero or infinity
  static long long out_of_range(const char*, long long) { return 0; }                           // no index

  std::string file_;
  const char* begin_;
  const char* end_;
  const char* next_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_TEXT_CURSOR_H

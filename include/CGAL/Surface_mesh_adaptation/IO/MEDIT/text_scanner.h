// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words and numbers of the text form.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_TEXT_SCANNER_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_TEXT_SCANNER_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Cuts a text into words; '#' starts a comment that ends with the line. The line number is counted only on demand,
/// when an error is reported.
class Medit_text_scanner
{
public:
  Medit_text_scanner(const std::string& text, const std::string& file)
    : file_(file), begin_(text.data()), end_(begin_ + text.size()), next_(begin_)
  {}

  /// Where the next word starts.
  const char* position()
  {
    while (next_ != end_ && (is_blank(*next_) || *next_ == '#'))
      next_ = *next_ == '#' ? std::find(next_, end_, '\n') : next_ + 1;
    return next_;
  }

  void move_to(const char* position) { next_ = position; }
  bool at_end() { return position() == end_; }
  bool at_number() { return !at_end() && !std::isalpha(static_cast<unsigned char>(*next_)); }

  std::string_view word()
  {
    const char* const first = position();
    next_ = std::find_if(first, end_, is_separator);
    return {first, std::size_t(next_ - first)};
  }

  double real(const char* what)
  {
    const double value = number<double>(what);
    if (!std::isfinite(value)) fail(last_, std::string(what) + " is not finite");
    return value;
  }

  template <class Integer>
  Integer integer(const char* what)
  {
    return number<Integer>(what);
  }

  /// Where the number that was read last starts.
  const char* last() const { return last_; }

  /// The most words that may still come: each takes two characters with its separator.
  std::size_t most_words() const { return std::size_t(end_ - next_ + 1) / 2; }

  [[noreturn]] void fail(const char* position, const std::string& what) const
  {
    throw Io_error(file_, std::size_t(std::count(begin_, position, '\n')) + 1, what);
  }

  /// The word at `position`, fit for a message.
  std::string quoted(const char* position) const
  {
    constexpr std::ptrdiff_t longest = 32;
    const char* const last = std::find_if(position, position + (std::min)(longest, end_ - position), is_separator);
    std::string text(position, last);
    const auto is_strange = [](char c) { return c < ' ' || c > '~'; };
    std::replace_if(text.begin(), text.end(), is_strange, '?');
    return position == end_ ? "the end of the file" : "'" + text + "'";
  }

private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static bool is_separator(char c) { return is_blank(c) || c == '#'; }

  template <class Number>
  Number number(const char* what)
  {
    last_ = position();
    const char* const first = last_ != end_ && *last_ == '+' ? last_ + 1 : last_; // from_chars() knows no '+'
    Number value = 0;
    const std::from_chars_result result = std::from_chars(first, end_, value);
    if (result.ec == std::errc::result_out_of_range) fail(last_, std::string(what) + " is out of range");
    if (result.ec != std::errc() || (result.ptr != end_ && !is_separator(*result.ptr)))
      fail(last_, std::string(what) + " expected, but there is " + quoted(last_));
    next_ = result.ptr;
    return value;
  }

  std::string file_;
  const char* begin_;
  const char* end_;
  const char* next_;
  const char* last_ = nullptr;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_TEXT_SCANNER_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_READER_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_READER_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_binary_layout.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/binary_keywords.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Reads the binary form: a header, then sections that start with the number of a keyword and the position of the next
/// section. As `Medit_text_reader`.
class Medit_binary_reader
{
public:
  Medit_binary_reader(const std::string& content, const std::string& file)
    : file_(file), begin_(content.data()), end_(begin_ + content.size()), next_(begin_), section_end_(end_)
  {}

  template <class ReadSection>
  void read_sections(const ReadSection& read_section)
  {
    check_header();
    while (next_ != end_) {
      section_end_ = end_;
      const char* const start = next_;
      const std::string keyword = medit_keyword(word_sized("a keyword"));
      if (keyword == "End") return;
      section_end_ = end_of_section();
      if (keyword == "Dimension") check_dimension();
      else if (has_dimension_) read_section(keyword, start);
      else fail(start, "the section Dimension must come first");
      next_ = section_end_; // forward: sections cannot form a loop
    }
  }

  void skip_section() { next_ = section_end_; }

  std::size_t count()
  {
    const auto n = integer<std::uint32_t>("the number of items");
    count_ = last_;
    return n;
  }

  void check_room(std::size_t n, std::size_t integers, std::size_t reals)
  {
    const std::size_t size = integers * layout_.size_of_integer() + reals * layout_.size_of_real();
    if (n > std::size_t(section_end_ - next_) / size)
      fail(count_, "the section is too short for " + std::to_string(n) + " items");
  }

  std::int32_t word_sized(const char* what) { return number<std::int32_t>(what); }

  template <class Integer>
  Integer integer(const char* what)
  {
    const std::int64_t i = integer(what, layout_.has_long_integers());
    using Limits = std::numeric_limits<Integer>;
    if (i < std::int64_t((Limits::min)()) || i > std::int64_t((Limits::max)()))
      fail(last_, std::string(what) + " is out of range");
    return Integer(i);
  }

  double real(const char* what)
  {
    const double x = layout_.version == 1 ? double(number<float>(what)) : number<double>(what);
    if (!std::isfinite(x)) fail(last_, std::string(what) + " is not finite");
    return x;
  }

  const char* position() const { return next_; }
  const char* last() const { return last_; }

  [[noreturn]] void fail(const char* position, const std::string& what) const
  {
    throw Io_error(file_, 0, "at byte " + std::to_string(position - begin_) + ": " + what);
  }

  const char* integer_at(const char* first, std::size_t i) const { return first + i * layout_.size_of_integer(); }

private:
  void check_header()
  {
    constexpr std::int32_t mark = 1, swapped_mark = 0x01000000;
    const std::int32_t found = word_sized("the mark of binary files");
    layout_.swapped = found == swapped_mark;
    if (found != mark && found != swapped_mark) fail(last_, "not a binary MEDIT file");
    layout_.version = word_sized("the version");
    if (layout_.version < 1 || layout_.version > 4) fail(last_, "unknown version " + std::to_string(layout_.version));
  }

  /// Reads where the next section starts; the last one says 0.
  const char* end_of_section()
  {
    const std::int64_t position = integer("the position of the next section", layout_.has_long_positions());
    if (position == 0) return end_;
    if (position < next_ - begin_ || position > end_ - begin_)
      fail(last_, "the next section is said to be at " + std::to_string(position));
    return begin_ + position;
  }

  void check_dimension()
  {
    const std::int32_t dimension = word_sized("the dimension");
    if (dimension != 3) fail(last_, "the dimension is " + std::to_string(dimension) + " instead of 3");
    has_dimension_ = true;
  }

  std::int64_t integer(const char* what, bool is_long)
  {
    return is_long ? number<std::int64_t>(what) : number<std::int32_t>(what);
  }

  template <class Number>
  Number number(const char* what)
  {
    last_ = next_;
    if (std::size_t(section_end_ - next_) < sizeof(Number)) fail(last_, std::string(what) + " expected");
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), next_, bytes.size());
    if (layout_.swapped) std::reverse(bytes.begin(), bytes.end());
    Number value;
    std::memcpy(&value, bytes.data(), bytes.size());
    next_ += bytes.size();
    return value;
  }

  std::string file_;
  const char* begin_;
  const char* end_;
  const char* next_;
  const char* section_end_;
  const char* last_ = nullptr;
  const char* count_ = nullptr;
  Medit_binary_layout layout_;
  bool has_dimension_ = false;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_READER_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_WRITER_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_WRITER_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_binary_layout.h>
#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/binary_keywords.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Writes the binary form, as `Medit_text_writer` writes text.
class Medit_binary_writer
{
public:
  explicit Medit_binary_writer(const Medit_binary_layout& layout) : layout_(layout)
  {
    word_sized(1).word_sized(layout_.version); // the 1 shows the order of bytes
    begin_section("Dimension");
    word_sized(3);
  }

  Medit_binary_writer& section(const char* keyword, std::size_t n)
  {
    begin_section(keyword);
    return integer(n);
  }

  template <class Integer>
  Medit_binary_writer& integer(Integer i)
  {
    return layout_.has_long_integers() ? append(std::int64_t(i)) : append(std::int32_t(i));
  }

  Medit_binary_writer& word_sized(int i) { return append(std::int32_t(i)); }
  Medit_binary_writer& real(double x) { return layout_.version == 1 ? append(float(x)) : append(x); }
  Medit_binary_writer& end_line() { return *this; }

  std::string finish()
  {
    begin_section("End");
    return std::move(bytes_);
  }

private:
  /// Starts a section, to which the one before points; none comes after it as yet.
  void begin_section(const char* keyword)
  {
    if (link_ != 0) set_position(link_, bytes_.size());
    word_sized(medit_code(keyword));
    link_ = bytes_.size();
    bytes_.resize(link_ + (layout_.has_long_positions() ? 8 : 4), '\0');
  }

  void set_position(std::size_t place, std::size_t position)
  {
    if (layout_.has_long_positions()) copy_bytes(std::int64_t(position), bytes_.data() + place);
    else copy_bytes(std::int32_t(position), bytes_.data() + place);
  }

  template <class Number>
  void copy_bytes(Number x, char* place) const
  {
    std::memcpy(place, &x, sizeof(Number));
    if (layout_.swapped) std::reverse(place, place + sizeof(Number));
  }

  template <class Number>
  Medit_binary_writer& append(Number x)
  {
    std::array<char, sizeof(Number)> bytes;
    copy_bytes(x, bytes.data());
    bytes_.append(bytes.data(), bytes.size());
    return *this;
  }

  Medit_binary_layout layout_;
  std::string bytes_;
  std::size_t link_ = 0; // where the section that was begun last holds the position of the next one; 0 if none was
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_BINARY_WRITER_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_TEXT_WRITER_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_TEXT_WRITER_H

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Writes the text form: formats numbers at the end of a text, without the cost of a stream. What writes the sections
/// knows neither this class nor `Medit_binary_writer`.
class Medit_text_writer
{
public:
  Medit_text_writer& section(const char* keyword, std::size_t n)
  {
    text_ += '\n';
    text_ += keyword;
    text_ += '\n';
    return integer(n).end_line();
  }

  template <class Integer>
  Medit_text_writer& integer(Integer i)
  {
    return append([&](char* b, char* e) { return std::to_chars(b, e, i); });
  }

  /// A number that fits into 32 bits in every version.
  Medit_text_writer& word_sized(int i) { return integer(i); }

  /// With as many digits as it takes for the value that is read back to be the same.
  Medit_text_writer& real(double x)
  {
    return append([&](char* b, char* e) { return std::to_chars(b, e, x); });
  }

  Medit_text_writer& end_line()
  {
    text_.back() = '\n';
    return *this;
  }

  std::string finish() { return std::move(text_ += "\nEnd\n"); }

private:
  template <class Print>
  Medit_text_writer& append(const Print& print)
  {
    std::array<char, 32> word; // the longest number has 24 characters
    text_.append(word.data(), print(word.data(), word.data() + word.size()).ptr);
    text_ += ' ';
    return *this;
  }

  std::string text_ = "MeshVersionFormatted 2\nDimension 3\n";
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_TEXT_WRITER_H

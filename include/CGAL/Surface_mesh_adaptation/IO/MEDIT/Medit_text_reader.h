// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_TEXT_READER_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_TEXT_READER_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/text_scanner.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Reads the text form: a header, then sections that start with a keyword, then "End". What reads the sections knows
/// neither this class nor `Medit_binary_reader`; the functions that both offer are those that are documented here.
class Medit_text_reader : Medit_text_scanner
{
public:
  using Medit_text_scanner::Medit_text_scanner;

  /// Calls `read_section(keyword, position)` for each section of the file but the header.
  template <class ReadSection>
  void read_sections(const ReadSection& read_section)
  {
    check_version();
    while (!at_end()) {
      const char* const start = position();
      if (at_number()) fail(start, "a keyword expected, but there is " + quoted(start));
      const std::string keyword(word());
      if (keyword == "End") return;
      if (keyword == "Dimension") check_dimension();
      else if (has_dimension_) read_section(keyword, start);
      else fail(start, "the section Dimension must come first");
    }
  }

  /// Skips the section whose keyword was just read, whatever it may hold.
  void skip_section()
  {
    while (at_number()) word();
  }

  /// The number of items of a section.
  std::size_t count()
  {
    const auto n = integer<std::uint32_t>("the number of items");
    count_ = last();
    return n;
  }

  /// Refuses a section whose `n` items, with so many numbers each, the rest of the file cannot hold.
  void check_room(std::size_t n, std::size_t integers, std::size_t reals)
  {
    if (n > most_words() / (integers + reals))
      fail(count_, "the file is too short for " + std::to_string(n) + " items");
  }

  /// A number that fits into 32 bits in every version.
  int word_sized(const char* what) { return integer<int>(what); }
  /// An index or a reference; `what` names it in errors.
  using Medit_text_scanner::integer;
  /// A finite number.
  using Medit_text_scanner::real;

  /// Where the next item is.
  using Medit_text_scanner::position;
  /// Where the number that was read last is.
  using Medit_text_scanner::last;
  /// Throws an `Io_error` that says where.
  using Medit_text_scanner::fail;

  /// Where the i-th of the integers that start at `first` is.
  const char* integer_at(const char* first, std::size_t i)
  {
    move_to(first);
    for (; i > 0; --i) word();
    return position();
  }

private:
  void check_version()
  {
    const char* const start = position();
    if (word() != "MeshVersionFormatted") fail(start, "MeshVersionFormatted expected, but there is " + quoted(start));
    // the versions differ in the width of the numbers of the binary form only
    const auto version = integer<int>("the version");
    if (version < 1 || version > 4) fail(last(), "unknown version " + std::to_string(version));
  }

  void check_dimension()
  {
    const auto dimension = integer<int>("the dimension");
    if (dimension != 3) fail(last(), "the dimension is " + std::to_string(dimension) + " instead of 3");
    has_dimension_ = true;
  }

  bool has_dimension_ = false;
  const char* count_ = nullptr;
};

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MEDIT_TEXT_READER_H

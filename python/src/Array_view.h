// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SMA_PYTHON_ARRAY_VIEW_H
#define SMA_PYTHON_ARRAY_VIEW_H

#include <cstddef>
#include <cstdint>

namespace sma_python {

/// A contiguous array of `rows` rows that belongs to somebody else.
template <class T>
struct Array_view
{
  const T* data = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 1;

  bool empty() const { return rows == 0; }
  const T* row(std::size_t i) const { return data + i * columns; }
};

/// The same for indices, of either width.
struct Index_view
{
  Array_view<std::int32_t> narrow;
  Array_view<std::int64_t> wide;

  std::size_t rows() const { return narrow.rows + wide.rows; }
  std::int64_t at(std::size_t i, std::size_t j) const
  {
    return narrow.data != nullptr ? std::int64_t(narrow.row(i)[j]) : wide.row(i)[j];
  }
};

} // namespace sma_python

#endif // SMA_PYTHON_ARRAY_VIEW_H

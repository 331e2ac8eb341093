// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the library rejects as an error of a file, which is named.

#ifndef ADAPT_MESH_BAD_INPUT_H
#define ADAPT_MESH_BAD_INPUT_H

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <stdexcept>
#include <string>

namespace adapt_mesh {

namespace SMA = CGAL::Surface_mesh_adaptation;

/// A file that was given cannot be used.
struct Bad_input : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Calls `use()`; if it rejects what the file `file` holds, says so and names the file.
template <class Use>
auto blaming(const std::string& file, const Use& use)
{
  try {
    return use();
  } catch (const SMA::Invalid_input_error& e) {
    throw Bad_input(file + ": " + e.what());
  } catch (const SMA::Empty_mesh_error& e) {
    throw Bad_input(file + ": " + e.what());
  } catch (const SMA::Invalid_extent_error& e) {
    throw Bad_input(file + ": " + e.what());
  }
}

/// As above, where nothing is written nor adapted: an error of a file, or a size, is then about the input.
template <class Read>
auto reading(const std::string& file, const Read& read)
{
  try {
    return blaming(file, read);
  } catch (const SMA::Io_error& e) {
    throw Bad_input(e.what());
  } catch (const SMA::Mesh_too_large_error& e) {
    throw Bad_input(file + ": " + e.what());
  }
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_BAD_INPUT_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_OUTPUT_FILE_H
#define ADAPT_MESH_OUTPUT_FILE_H

#include "Interrupts.h"

#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

namespace adapt_mesh {

/// A file that appears at once and complete, or not at all: it is written under a temporary name beside its place
/// and renamed by `commit()`. What was there before stays until then.
class Output_file
{
public:
  /// \throws Io_error if no file can be made there
  explicit Output_file(const std::string& name) : name_(name)
  {
    if (std::filesystem::is_directory(name_)) throw error("is a folder");
    temporary_ = name_;
    temporary_.replace_filename(name_.stem().string() + ".partial-" + std::to_string(::getpid()) +
                                name_.extension().string()); // the extension tells the format
    Interrupts::add_file(temporary_.string());
    if (!std::ofstream(temporary_)) throw error("cannot be written: no such folder, or no permission");
    std::filesystem::remove(temporary_); // it was a trial
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file()
  {
    std::error_code ignored; // nothing is left after commit()
    std::filesystem::remove(temporary_, ignored);
  }

  /// Calls `write_to(file)` with the temporary name. \throws Io_error
  template <class WriteTo>
  void write(const WriteTo& write_to) const
  {
    try {
      write_to(temporary_.string());
    } catch (const CGAL::Surface_mesh_adaptation::Io_error&) {
      throw error("cannot be written"); // under the name that the user knows
    }
  }

  /// \throws Io_error
  void commit()
  {
    std::error_code failure;
    std::filesystem::rename(temporary_, name_, failure);
    if (failure) throw error("cannot be written: " + failure.message());
  }

private:
  CGAL::Surface_mesh_adaptation::Io_error error(const std::string& what) const { return {name_.string(), 0, what}; }

  std::filesystem::path name_;
  std::filesystem::path temporary_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_OUTPUT_FILE_H

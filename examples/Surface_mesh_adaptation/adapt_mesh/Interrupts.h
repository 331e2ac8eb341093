// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_INTERRUPTS_H
#define ADAPT_MESH_INTERRUPTS_H

#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>

#include <unistd.h>

namespace adapt_mesh {

/// While it lives, SIGINT (Ctrl-C), SIGTERM and SIGHUP end the program at once, whatever it is at, and no file under a
/// temporary name stays behind. There is no need to ask the library to stop: nothing is written until the end.
class Interrupts
{
public:
  Interrupts()
  {
    is_terminal = ::isatty(STDERR_FILENO) != 0;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      former_[i] = std::signal(signals[i], remove_files_and_exit);
      if (former_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN); // as for jobs in the background
    }
  }
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  ~Interrupts() { end(); }

  /// Until `end()`: the files are getting their names, all or none.
  void ignore()
  {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], SIG_IGN);
  }

  /// Signals have the effect again that they had before.
  void end()
  {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], former_[i]);
  }

  /// Has `file` removed by an interrupt. \pre no more than `most_files` in all
  static void add_file(const std::string& file)
  {
    const std::size_t n = number_of_files;
    std::copy_n(file.c_str(), (std::min)(file.size() + 1, files[n].size() - 1), files[n].begin());
    number_of_files = n + 1; // a signal may come before, but not in between
  }

private:
  using Handler = void (*)(int);

  /// Calls nothing that a handler may not.
  static void remove_files_and_exit(int)
  {
    for (std::size_t i = 0; i < number_of_files; ++i) ::unlink(files[i].data());
    if (is_terminal) say("\r\033[K"); // in place of the bar
    say("adapt_mesh: interrupted, nothing was written\n");
    ::_exit(EXIT_FAILURE);
  }

  static void say(std::string_view text)
  {
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return; // there is nobody to tell
  }

  static constexpr std::size_t most_files = 3; // the mesh, the metric and the report
  static constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGHUP};
  static inline std::array<std::array<char, PATH_MAX>, most_files> files = {};
  static inline std::atomic<std::size_t> number_of_files{0};
  static inline bool is_terminal = false;

  std::array<Handler, signals.size()> former_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_INTERRUPTS_H

// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef ADAPT_MESH_PROGRESS_H
#define ADAPT_MESH_PROGRESS_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/Adaptation_visitor.h>

#include <cstddef>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace adapt_mesh {

/// Tells on stderr how far the run is: by a bar on a terminal, else by a line for each round.
class Progress : public CGAL::Surface_mesh_adaptation::Adaptation_visitor
{
public:
  Progress(bool quiet, bool verbose)
    : quiet_(quiet), verbose_(verbose), bar_(!quiet && !verbose && ::isatty(STDERR_FILENO) != 0)
  {}

  void round_begins(std::size_t round, std::size_t rounds)
  {
    rounds_ = rounds;
    if (bar_) draw_bar(round, rounds);
  }

  void kernel_done(const CGAL::Surface_mesh_adaptation::Kernel_report& kernel)
  {
    if (verbose_)
      std::fprintf(stderr, "  %-10s %10zu of %10zu  %8.3f s\n", kernel.kernel.c_str(), kernel.applied,
                   kernel.candidates, kernel.seconds);
  }

  void round_done(std::size_t round, const CGAL::Surface_mesh_adaptation::Mesh_statistics& mesh)
  {
    if (bar_) draw_bar(round + 1, rounds_);
    else if (!quiet_)
      std::fprintf(stderr, "round %zu/%zu: %zu vertices, %.2f %% of the edges in range\n", round + 1, rounds_,
                   mesh.vertices, 100 * mesh.in_range);
  }

  /// Removes the bar.
  void finish() const
  {
    if (bar_) std::fputs("\r\033[K", stderr);
  }

private:
  static void draw_bar(std::size_t done, std::size_t all)
  {
    constexpr std::size_t width = 40;
    const std::size_t filled = all == 0 ? width : width * done / all;
    std::fprintf(stderr, "\r[%s%s] %zu of %zu rounds", std::string(filled, '#').c_str(),
                 std::string(width - filled, ' ').c_str(), done, all);
  }

  bool quiet_;
  bool verbose_;
  bool bar_;
  std::size_t rounds_ = 0;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_PROGRESS_H

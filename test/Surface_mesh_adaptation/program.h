// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of the program `adapt_mesh`, each test in a folder of its own.

#ifndef TEST_SURFACE_MESH_ADAPTATION_PROGRAM_H
#define TEST_SURFACE_MESH_ADAPTATION_PROGRAM_H

#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace program {

namespace SMA = CGAL::Surface_mesh_adaptation;
namespace fs = std::filesystem;
using shapes::Soup;
using shapes::Vector_3;

inline std::string content(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

inline void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

inline std::string off(const Soup& soup)
{
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n" << soup.points.size() << ' ' << soup.triangles.size() << " 0\n";
  for (const Vector_3& p : soup.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const shapes::Triangle& t : soup.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

inline Soup read(const fs::path& file)
{
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  Soup s;
  if (file.extension() == ".mesh") {
    const SMA::Medit_mesh m = SMA::read_medit_mesh(file.string());
    for (const auto& p : m.points) s.points.emplace_back(p[0], p[1], p[2]);
    for (const auto& t : m.triangles) s.triangles.push_back({t[0], t[1], t[2]});
    return s;
  }
  EXPECT_TRUE(CGAL::IO::read_polygon_soup(file.string(), points, polygons));
  for (const auto& p : points) s.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& t : polygons) s.triangles.push_back({shapes::Index(t[0]), shapes::Index(t[1]), shapes::Index(t[2])});
  return s;
}

struct Outcome
{
  int status;
  std::string out, err;
};

class Adapt_mesh : public ::testing::Test
{
protected:
  Adapt_mesh()
  {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("adapt_mesh-" + std::to_string(::getpid()) + "-" + test);
    fs::create_directories(folder_);
    write(path("in.off"), off(sphere_));
  }
  ~Adapt_mesh() override
  {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  fs::path path(const std::string& name) const { return folder_ / name; }

  /// Runs the program in the folder of the test.
  Outcome run(const std::string& arguments) const
  {
    const std::string command = "cd '" + folder_.string() + "' && '" ADAPT_MESH "' " + arguments + " >.out 2>.err";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(path(".out")), content(path(".err"))};
  }

  /// Starts the program in the folder of the test. Returns its process.
  pid_t start(std::vector<std::string> arguments) const
  {
    write(path(".err"), "");
    const pid_t child = ::fork();
    if (child != 0) return child;
    std::vector<char*> argv = {const_cast<char*>("adapt_mesh")};
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    std::signal(SIGINT, SIG_DFL); // which what a shell runs in the background ignores
    if (::chdir(folder_.c_str()) == 0 && std::freopen(".out", "w", stdout) && std::freopen(".err", "w", stderr))
      ::execv(ADAPT_MESH, argv.data());
    ::_exit(127);
  }

  /// The exit status of a process, which is killed if it does not end; -1 if a signal ended it.
  static int status_within_a_minute(pid_t process)
  {
    int status = 0;
    for (int i = 0; i < 6000; ++i, ::usleep(10000))
      if (::waitpid(process, &status, WNOHANG) == process) return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ::kill(process, SIGKILL);
    ::waitpid(process, &status, 0);
    return -1;
  }

  std::set<std::string> files() const
  {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.path().filename() != ".out" && entry.path().filename() != ".err") names.insert(entry.path().string());
    return names;
  }

  /// Expects the program to fail with `status` and one line on stderr that contains `message`, and nothing to be
  /// written, nor the output that is there to be touched.
  void expect_failure(int status, const std::string& arguments, const std::string& message = "") const
  {
    SCOPED_TRACE(arguments);
    write(path("out.off"), "precious");
    const auto before = files();
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, status);
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(r.err.find("adapt_mesh: "), 0u) << r.err;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_EQ(r.err.back(), '\n');
    EXPECT_NE(r.err.find(message), std::string::npos) << r.err;
    EXPECT_EQ(content(path("out.off")), "precious");
    EXPECT_EQ(files(), before);
  }

  /// The same for many `cases`, the file at fault and the arguments.
  void expect_failures_that_name(int status, const std::vector<std::pair<std::string, std::string>>& cases) const
  {
    for (const auto& [file, arguments] : cases) expect_failure(status, arguments, file);
  }

  void expect_success(const std::string& arguments) const
  {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << arguments << '\n' << r.err;
  }

  Soup sphere_ = shapes::sphere(2);
  fs::path folder_;
};

} // namespace program

#endif // TEST_SURFACE_MESH_ADAPTATION_PROGRAM_H

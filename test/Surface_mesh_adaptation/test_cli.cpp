// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program `adapt_mesh`: formats, options, and for everything that can go wrong the exit status, one line on stderr,
// and no file touched.

#include "checks.h"
#include "program.h"
#include "real_meshes.h"
#include "shapes.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>
#include <CGAL/Surface_mesh_adaptation/distance/surface_distance.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace test_cli {

using namespace program;

// What it is for

TEST_F(Adapt_mesh, reads_and_writes_all_formats)
{
  const std::vector<std::string> formats = {"off", "obj", "ply", "stl", "mesh"};
  for (const std::string& f : formats) expect_success("in.off first." + f + " --size 0.3 --quiet");
  Soup first = read(path("first.off"));
  ASSERT_TRUE(checks::is_manifold(first));
  for (const std::string& from : formats)
    for (const std::string& to : {std::string("off"), std::string("mesh")}) {
      SCOPED_TRACE(from + " to " + to);
      expect_success("first." + from + " second." + to + " --size 0.1 --quiet");
      const Soup second = read(path("second." + to));
      ASSERT_TRUE(checks::is_manifold(second));
      EXPECT_EQ(checks::topology(second).euler_characteristic, 2);
      EXPECT_GT(checks::least_area(second, [](const Vector_3& p) { return p; }), 0);
    }
  // formats with all digits give the same points
  for (const std::string f : {"obj", "mesh", "ply"}) EXPECT_EQ(read(path("first." + f)).points, first.points) << f;
}

TEST_F(Adapt_mesh, adapts_to_a_size)
{
  expect_success("in.off out.off --size 0.1");
  const Soup after = read(path("out.off"));
  EXPECT_GT(checks::mean_quality(after), 0.95);
  EXPECT_NEAR(after.mean_edge_length(), 0.1, 0.02);
}

TEST_F(Adapt_mesh, gives_the_same_file_with_every_execution)
{
  expect_success("in.off first.off --size 0.03 --execution sequential");
#ifdef CGAL_LINKED_WITH_TBB
  expect_success("in.off second.off --size 0.03 --execution tbb --threads 3");
  EXPECT_EQ(content(path("second.off")), content(path("first.off")));
#endif
#ifdef _OPENMP
  expect_success("in.off third.off --size 0.03 --execution openmp --threads 2");
  EXPECT_EQ(content(path("third.off")), content(path("first.off")));
#endif
}

TEST_F(Adapt_mesh, adapts_to_the_curvature_and_keeps_the_ridges)
{
  write(path("in.off"), off(shapes::capped_cylinder(40, 6, 2)));
  expect_success("in.off out.mesh --curvature 0.002 --hmin 0.01 --hmax 0.3");
  expect_success("in.off aniso.off --curvature 0.002 --anisotropic");
  const SMA::Medit_mesh m = SMA::read_medit_mesh(path("out.mesh").string());
  EXPECT_GT(m.ridges.size(), 30u);
  for (const auto r : m.ridges)
    for (const auto v : m.edges[r]) {
      EXPECT_NEAR(std::hypot(m.points[v][0], m.points[v][1]), 1, 0.01);
      EXPECT_LT((std::min)(std::abs(m.points[v][2]), std::abs(m.points[v][2] - 2)), 1e-9);
    }
}

TEST_F(Adapt_mesh, adapts_to_a_metric_from_a_file_and_writes_it)
{
  SMA::Medit_field sizes, tensors;
  tensors.components = 6;
  for (const Vector_3& p : sphere_.points) {
    const double h = p[2] > 0 ? 0.05 : 0.2;
    sizes.values.push_back(h);
    for (const double c : {1 / (h * h), 0.0, 1 / (h * h), 0.0, 0.0, 1 / (h * h)}) tensors.values.push_back(c);
  }
  SMA::write_medit_solution(path("sizes.sol").string(), {sizes});
  SMA::write_medit_solution(path("tensors.sol").string(), {tensors});
  for (const std::string kind : {"sizes", "tensors"}) {
    expect_success("in.off out.off --metric " + kind + ".sol --output-metric out.sol --report out.json");
    const Soup after = read(path("out.off"));
    std::size_t upper = 0;
    for (const Vector_3& p : after.points) upper += p[2] > 0;
    EXPECT_GT(upper, 3 * (after.points.size() - upper));
    const SMA::Medit_field metric = SMA::read_medit_solution(path("out.sol").string()).at(0);
    ASSERT_EQ(metric.components, 6);
    ASSERT_EQ(metric.number_of_vertices(), after.points.size());
    for (std::size_t v = 0; v < after.points.size(); ++v)
      if (std::abs(after.points[v][2]) > 0.5) {
        EXPECT_NEAR(1 / std::sqrt(metric.values[6 * v]), after.points[v][2] > 0 ? 0.05 : 0.2, 1e-6);
      }
    EXPECT_NE(content(path("out.json")).find("\"final\": {\"vertices\": " + std::to_string(after.points.size())),
              std::string::npos);
  }
}

TEST_F(Adapt_mesh, overwrites_its_input_if_asked_to)
{
  expect_success("in.off in.off --size 0.1");
  EXPECT_GT(read(path("in.off")).points.size(), 2 * sphere_.points.size());
}

TEST_F(Adapt_mesh, prints_a_summary_only_if_not_quiet)
{
  const Outcome talkative = run("in.off out.off --size 0.2"), quiet = run("in.off out.off --size 0.2 --quiet"),
                verbose = run("in.off out.off --size 0.2 --verbose");
  for (const char* word : {"vertices", "quality", "distance", "time"})
    EXPECT_NE(talkative.out.find(word), std::string::npos);
  EXPECT_NE(talkative.err.find("round 1/"), std::string::npos);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_NE(verbose.err.find("refine"), std::string::npos);
}

double distance_between(const Soup& a, const Soup& b, double precision)
{
  const auto tree = [](const Soup& soup) {
    std::vector<SMA::Triangle_points> triangles;
    for (const shapes::Triangle& t : soup.triangles)
      triangles.push_back({soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]});
    return SMA::Triangle_tree(SMA::Sequential_execution(), triangles);
  };
  return SMA::hausdorff_distance_bound(SMA::Sequential_execution(), tree(a), tree(b), precision);
}

TEST_F(Adapt_mesh, says_how_far_the_result_is_the_same_each_time)
{
  for (const std::string options : {"--size 0.8", "--size 0.3", "--size 0.06", "--size 0.06 --flat"}) {
    SCOPED_TRACE(options);
    std::set<double> said;
    for (const std::string execution : {"sequential", "tbb", "openmp"}) {
      const Outcome r = run("in.off out.off " + options + " --execution " + execution);
      ASSERT_EQ(r.status, 0) << r.err;
      said.insert(std::stod(r.out.substr(r.out.find("distance") + 8)));
    }
    const double distance = distance_between(sphere_, read(path("out.off")), 1e-4);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_LT(*said.begin(), 1.005 * distance);
    EXPECT_GT(*said.begin(), 0.95 * distance - 1e-4);
  }
}

TEST_F(Adapt_mesh, explains_itself)
{
  const Outcome help = run("--help"), version = run("--version");
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(version.status, 0);
  for (const char* option : {"--size", "--curvature", "--metric", "--threads", "--report", "Exit status"})
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  EXPECT_EQ(version.out.find("adapt_mesh "), 0u);
}

// What goes wrong

TEST_F(Adapt_mesh, refuses_a_command_line_that_makes_no_sense)
{
  expect_failure(2, "");
  expect_failure(2, "in.off");
  expect_failure(2, "in.off out.off");
  expect_failure(2, "in.off out.off third.off --size 0.1");
  expect_failure(2, "in.off out.off --size 0.1 --curvature 0.01", "go together");
  expect_failure(2, "in.off out.off --nonsense", "nonsense");
  expect_failure(2, "in.off out.off --siz 0.1", "siz");
  expect_failure(2, "in.off out.off --size", "size");
  expect_failure(2, "in.off out.off --size 0.1 --anisotropic", "--anisotropic");
  expect_failure(2, "in.off out.off --size 0.1 --hmin 0.1", "--hmin");
  expect_failure(2, "in.off out.off --curvature 0.1 --hmin 0.2 --hmax 0.1", "--hmin");
  expect_failure(2, "in.off out.off --size 0.1 --no-features --feature-angle 30", "--feature-angle");
  expect_failure(2, "in.off out.off --size 0.1 --shape-weight 0.1", "--fit");
  expect_failure(2, "in.off out.off --size 0.1 --execution threads", "--execution");
  expect_failure(2, "in.off out.off --size 0.1 --execution sequential --threads 2", "--threads");
  expect_failure(2, "in.off out.off --size 0.1 --quiet --verbose", "--quiet");
}

TEST_F(Adapt_mesh, refuses_numbers_out_of_range)
{
  for (const std::string option : {"--size", "--curvature", "--curvature 0.01 --hmin", "--curvature 0.01 --hmax",
                                   "--size 0.1 --rounds", "--size 0.1 --threads", "--size 0.1 --feature-angle",
                                   "--size 0.1 --fit --shape-weight"})
    for (const std::string value : {"0", "-1", "nan", "inf", "abc", "1e999", "''"})
      expect_failure(2, "in.off out.off " + option + "=" + value);
  expect_failure(2, "in.off out.off --size 0.1 --feature-angle 181", "--feature-angle");
  expect_failure(2, "in.off out.off --size 0.1 --fit --shape-weight 1.1", "--shape-weight");
  expect_failure(2, "in.off out.off --size 0.1 --rounds 2.5", "rounds");
}

TEST_F(Adapt_mesh, lets_faces_run_through_the_surface)
{
  const auto mean_height = [&](const std::string& options) {
    expect_success("in.off out.off --size 0.2 " + options);
    double sum = 0;
    const Soup soup = read(path("out.off"));
    for (const auto& t : soup.triangles)
      sum += ((soup.points[t[0]] + soup.points[t[1]] + soup.points[t[2]]) / 3).norm() - 1;
    return sum / double(soup.triangles.size());
  };
  const double fitted = mean_height("--fit"), in_better_shape = mean_height("--fit --shape-weight 1");
  EXPECT_LT(std::abs(fitted), 0.3 * std::abs(mean_height("")));
  EXPECT_LT(std::abs(in_better_shape), 0.3 * std::abs(mean_height("")));
  EXPECT_NE(fitted, in_better_shape);
}

TEST_F(Adapt_mesh, keeps_to_the_triangles_or_bulges)
{
  double depth_of_faces = 0; // of their planes below the sphere on which their corners are
  for (const auto& t : sphere_.triangles) {
    const Vector_3& p = sphere_.points[t[0]];
    const Vector_3 n = (sphere_.points[t[1]] - p).cross(sphere_.points[t[2]] - p).normalized();
    depth_of_faces = (std::max)(depth_of_faces, 1 - n.dot(p));
  }
  const auto depth_of_vertices = [&](const std::string& options) {
    expect_success("in.off out.off --size 0.05 " + options);
    double depth = 0;
    for (const Vector_3& p : read(path("out.off")).points) {
      EXPECT_LT(p.norm(), 1.001);
      depth = (std::max)(depth, 1 - p.norm());
    }
    return depth;
  };
  EXPECT_LT(depth_of_vertices(""), 0.1 * depth_of_faces);
  const double flat = depth_of_vertices("--flat");
  EXPECT_GT(flat, 0.8 * depth_of_faces);
  EXPECT_LT(flat, 1.001 * depth_of_faces);
}

TEST_F(Adapt_mesh, keeps_a_tolerance_and_says_so)
{
  for (const std::string options : {"--tolerance 0.002", "--tolerance 0.002 --size 0.5", "--tolerance 0.01 --anisotropic"}) {
    SCOPED_TRACE(options);
    const Outcome r = run("in.off out.off --report report.json " + options);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.out.find("certified"), std::string::npos);
    EXPECT_NE(content(path("report.json")).find("certified_distance"), std::string::npos);
  }
  // no rounding error allowed
  expect_failure(1, "in.off out.off --size 0.1 --tolerance 1e-100 --quiet", "above the tolerance");
  expect_failure(2, "in.off out.off --tolerance 0", "--tolerance");
  expect_failure(2, "in.off out.off --tolerance -1", "--tolerance");
}

TEST_F(Adapt_mesh, aims_at_a_number_of_vertices)
{
  write(path("in.off"), off(shapes::sphere(4, 0.3)));
  for (const std::string options : {"--vertices 1000", "--vertices 800 --anisotropic", "--vertices 3000",
                                    "--vertices 10000 --gradation 1.2"}) {
    SCOPED_TRACE(options);
    ASSERT_EQ(run("in.off out.off " + options).status, 0);
    const double asked = std::stod(options.substr(11));
    EXPECT_NEAR(double(read(path("out.off")).points.size()), asked, 0.05 * asked);
  }
}

TEST_F(Adapt_mesh, adapts_to_a_field)
{
  const Soup sphere = shapes::sphere(4, 0.3); // fine enough to see the front
  write(path("in.off"), off(sphere));
  std::ostringstream values;
  values << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" << sphere.points.size() << "\n1 1\n";
  for (const Vector_3& p : sphere.points) values << std::tanh(10 * p[2]) << '\n';
  write(path("f.sol"), values.str() + "End\n");
  for (const std::string options : {"", "--norm 1", "--norm inf --anisotropic", "--anisotropic --curvature 0.01",
                                    "--gradation 1"}) {
    SCOPED_TRACE(options);
    ASSERT_EQ(run("in.off out.off --field f.sol --vertices 3000 " + options).status, 0);
    const Soup result = read(path("out.off"));
    EXPECT_NEAR(double(result.points.size()), 3000, 0.05 * 3000);
    const auto in_the_front = [](const Vector_3& p) { return std::abs(p[2]) < 0.15; };
    const auto n = std::count_if(result.points.begin(), result.points.end(), in_the_front);
    EXPECT_GT(double(n), 0.3 * double(result.points.size())) << "the front takes 15 % of the sphere";
  }
}

TEST_F(Adapt_mesh, refuses_fields_that_it_cannot_use)
{
  expect_failure(2, "in.off out.off --field f.sol", "--vertices");
  expect_failure(2, "in.off out.off --vertices 100 --curvature 0.1", "--vertices");
  expect_failure(2, "in.off out.off --vertices 100 --size 0.1", "--size");
  expect_failure(2, "in.off out.off --vertices 100 --norm 2", "--norm");
  expect_failure(2, "in.off out.off --vertices 100 --gradation 0.5", "--gradation");
  expect_failure(3, "in.off out.off --vertices 100 --field none.sol", "none.sol");
  write(path("f.sol"), "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n2\n1 1\n1 1\nEnd\n");
  expect_failure(3, "in.off out.off --vertices 100 --field f.sol", "f.sol");
}

TEST_F(Adapt_mesh, uses_the_field_that_is_meant)
{
  SMA::Medit_field vector, u, sizes;
  vector.components = 3;
  for (const Vector_3& p : sphere_.points) {
    for (int i = 0; i < 3; ++i) vector.values.push_back(p[i]);
    u.values.push_back(p[0] * p[0] - 2); // no size
    sizes.values.push_back(0.2);
  }
  SMA::write_medit_solution(path("all.solb").string(), {vector, u, sizes});
  SMA::write_medit_solution(path("one.sol").string(), {vector, sizes});
  SMA::write_medit_solution(path("vector.sol").string(), {vector});

  const std::string all = "; there are: 1 vector, 2 scalar, 3 scalar";
  const std::string several = run("in.off out.off --field all.solb --vertices 500").err;
  EXPECT_NE(several.find("\nadapt_mesh: warning: all.solb: field 2 is used" + all + "\n"), std::string::npos) << several;
  for (const std::string arguments : {"--metric all.solb --metric-number 3", "--metric one.sol",
                                      "--field all.solb --vertices 500 --field-number 2"}) {
    const Outcome outcome = run("in.off out.off " + arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
  }

  expect_failure(3, "in.off out.off --quiet --metric all.solb", "(vertex 0)");
  expect_failure(3, "in.off out.off --metric all.solb --metric-number 1", "field 1 is not a scalar or a tensor" + all);
  expect_failure(3, "in.off out.off --metric all.solb --metric-number 4", "field 4 is not a scalar or a tensor" + all);
  expect_failure(3, "in.off out.off --vertices 500 --field vector.sol", "no field is a scalar; there are: 1 vector");
  expect_failure(2, "in.off out.off --metric all.solb --metric-number 0", "--metric-number");
  expect_failure(2, "in.off out.off --metric all.solb --field-number 1", "--field-number");
}

TEST_F(Adapt_mesh, reads_and_writes_binary_medit_files)
{
  expect_success("in.off out.mesh --size 0.2 --output-metric out.sol");
  expect_success("in.off out.meshb --size 0.2 --output-metric out.solb");
  EXPECT_EQ(SMA::print_medit_mesh(SMA::read_medit_mesh(path("out.meshb").string())), content(path("out.mesh")));
  EXPECT_EQ(SMA::print_medit_solution(SMA::read_medit_solution(path("out.solb").string())), content(path("out.sol")));
  expect_success("out.meshb again.off --metric out.solb");
  EXPECT_TRUE(checks::is_manifold(read(path("again.off"))));
  write(path("bad.meshb"), content(path("out.meshb")).substr(0, 1000));
  expect_failure(3, "bad.meshb again.off --size 0.1", "bad.meshb: at byte ");
  write(path("bad.solb"), content(path("out.solb")).substr(0, 1000));
  expect_failure(3, "out.meshb again.off --metric bad.solb", "bad.solb: at byte ");
}

TEST_F(Adapt_mesh, refuses_unknown_formats)
{
  write(path("in.xyz"), "0 0 0\n");
  expect_failure(2, "in.xyz out.off --size 0.1", "in.xyz");
  expect_failure(2, "in.off out.txt --size 0.1", "out.txt");
  expect_failure(2, "in.off out --size 0.1", "out");
  expect_failure(2, "in.off out.off --metric in.off", "in.off");
  expect_failure(2, "in.off out.off --size 0.1 --output-metric out.txt", "out.txt");
}

TEST_F(Adapt_mesh, refuses_files_that_are_not_there)
{
  fs::create_directory(path("folder.off"));
  expect_failures_that_name(3, {{"absent.off", "absent.off out.off --size 0.1"},
                                {"absent.mesh", "absent.mesh out.off --size 0.1"},
                                {"absent.sol", "in.off out.off --metric absent.sol"},
                                {"folder.off", "folder.off out.off --size 0.1"}});
}

TEST_F(Adapt_mesh, refuses_malformed_files_and_names_the_line)
{
  const std::string good = off(shapes::tetrahedron());
  write(path("bad.off"), "");
  expect_failure(3, "bad.off out.off --size 0.1", "bad.off");
  write(path("bad.off"), "no mesh at all\n");
  expect_failure(3, "bad.off out.off --size 0.1", "bad.off");
  write(path("bad.off"), good.substr(0, good.size() - 12));
  expect_failure(3, "bad.off out.off --size 0.1", "bad.off");
  write(path("bad.off"), "OFF\n4000000000 4000000000 0\n0 0 0\n");
  expect_failure(3, "bad.off out.off --size 0.1", "bad.off");
  write(path("bad.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  expect_failure(3, "bad.off out.off --size 0.1", "bad.off");
  write(path("bad.mesh"), "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 zero 0\n");
  expect_failure(3, "bad.mesh out.off --size 0.1", "bad.mesh:5: ");
  write(path("bad.sol"), "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n1\n1 9\n");
  expect_failure(3, "in.off out.off --metric bad.sol", "bad.sol:5: ");
  for (const std::string format : {"obj", "ply", "stl"}) {
    write(path("bad." + format), "solid nothing\nply v 0 0\nf 1 2 3\n");
    expect_failure(3, "bad." + format + " out.off --size 0.1", "bad." + format);
  }
}

TEST_F(Adapt_mesh, refuses_surfaces_that_are_no_triangulated_manifold)
{
  const auto expect_refusal = [&](const std::string& text, const std::string& message) {
    write(path("bad.off"), text);
    expect_failure(3, "bad.off out.off --size 0.1", "bad.off");
    expect_failure(3, "bad.off out.off --size 0.1", message);
  };
  expect_refusal("OFF\n3 1 0\n0 0 0\n1 0 0\nnan 1 0\n3 0 1 2\n", "");
  expect_refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n", "face 0");
  expect_refusal("OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n",
                 "between the vertices 0 and 1");
  expect_refusal("OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n3 0 1 2\n3 0 3 4\n", "vertex 0");
  expect_refusal("OFF\n0 0 0\n", "");
}

TEST_F(Adapt_mesh, refuses_what_is_too_large_or_too_small)
{
  for (const std::string h : {"1e300", "1e-315", "0"}) {
    SCOPED_TRACE(h);
    write(path("bad.off"), "OFF\n3 1 0\n0 0 0\n" + h + " 0 0\n0 " + h + " 0\n3 0 1 2\n");
    expect_failure(3, "bad.off out.off --curvature 0.1", "extent");
  }
}

TEST_F(Adapt_mesh, names_all_that_is_wrong_at_once)
{
  Soup soup = sphere_;
  const auto first = std::to_string(soup.triangles.size()), second = std::to_string(soup.triangles.size() + 1);
  soup.triangles.push_back({0, 0, 1});
  soup.triangles.push_back(soup.triangles[5]);
  soup.triangles.push_back({0, 1, 99999});
  write(path("bad.off"), off(soup));
  for (const std::string& message :
       {"1 face has the same vertex twice (first: face " + first + "); ",
        "1 face has the same corners as another (first: face " + second, std::string("a vertex that does not exist"), std::string("--repair")})
    expect_failure(3, "bad.off out.off --size 0.2", message);
  write(path("bad.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999999999999\n");
  expect_failure(3, "bad.off out.off --size 0.2", "a vertex that does not exist");
}

TEST_F(Adapt_mesh, refuses_sizes_that_ask_for_too_many_vertices)
{
  write(path("cube.off"), off(shapes::cube(1)));
  expect_failure(2, "cube.off out.off --size 1e-9", "the metric asks for about ");
  expect_failure(2, "cube.off out.off --size 1e-9", "; check --size or raise --max-vertices");
  expect_failure(2, "in.off out.off --size 0.1 --max-vertices 100", "and 100 are possible");
  expect_failure(2, "in.off out.off --curvature 1e-5 --max-vertices 100", "check --curvature");
  for (const std::string n : {"0", "-1", "1.5", "many"})
    expect_failure(2, "in.off out.off --size 0.1 --max-vertices=" + n, "max-vertices");
  expect_success("in.off out.off --size 0.1 --max-vertices 10000");
}

// What is mended

TEST_F(Adapt_mesh, repairs_if_asked_to_and_says_what)
{
  Soup soup = sphere_;
  soup.triangles.push_back({0, 0, 1});
  soup.triangles.push_back(soup.triangles[5]);
  write(path("in.off"), off(soup));
  const Outcome r = run("in.off out.off --size 0.2 --repair --report out.json");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("repaired  in.off: 1 face has the same vertex twice"), std::string::npos) << r.out;
  EXPECT_NE(content(path("out.json")).find("\"repairs\": [\"in.off: 1 face has the same vertex twice"),
            std::string::npos);
  EXPECT_EQ(checks::topology(read(path("out.off"))).euler_characteristic, 2);
  write(path("in.off"), "OFF\n2 1 0\n0 0 0\n1 0 0\n3 0 1 1\n");
  expect_failure(3, "in.off out.off --size 0.2 --repair", "no face");
}

TEST_F(Adapt_mesh, takes_metrics_for_vertices_that_are_cut_apart)
{
  Soup soup = sphere_; // and its mirror image, which touches it
  const auto n = shapes::Index(sphere_.points.size());
  const auto top = shapes::Index(std::max_element(sphere_.points.begin(), sphere_.points.end(), [](auto& p, auto& q) {
    return p[2] < q[2];
  }) - sphere_.points.begin());
  for (Vector_3 p : sphere_.points) soup.points.emplace_back(p[0], p[1], 2 * sphere_.points[top][2] - p[2]);
  for (auto t : sphere_.triangles) {
    for (auto& v : t) v = v == top ? top : v + n;
    soup.triangles.push_back({t[0], t[2], t[1]});
  }
  write(path("in.off"), off(soup));
  SMA::Medit_field sizes;
  sizes.values.assign(soup.points.size(), 0.2);
  SMA::write_medit_solution(path("sizes.sol").string(), {sizes});
  expect_failure(3, "in.off out.off --metric sizes.sol", "1 vertex has faces that form no single fan");
  expect_success("in.off out.off --metric sizes.sol --repair");
  EXPECT_EQ(checks::topology(read(path("out.off"))).components, 2u);
}

TEST_F(Adapt_mesh, triangulates_polygons_with_a_warning)
{
  write(path("in.off"), "OFF\n8 6 12\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
                        "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n");
  const Outcome r = run("in.off out.off --size 0.2");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.err.find("6 faces have more than three corners"), std::string::npos) << r.err;
  EXPECT_NEAR(checks::area(read(path("out.off"))), 6, 1e-9);
}

TEST_F(Adapt_mesh, reads_medit_files_by_the_same_rules)
{
  SMA::Medit_mesh m; // a cube
  m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  m.quadrilaterals = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const auto write_file = [&](const std::string& more = "") {
    m.point_references.assign(m.points.size(), 0);
    m.triangle_references.assign(m.triangles.size(), 0);
    m.quadrilateral_references.assign(m.quadrilaterals.size(), 0);
    m.edge_references.assign(m.edges.size(), 0);
    std::string text = SMA::print_medit_mesh(m);
    write(path("in.mesh"), text.insert(text.rfind("End"), more));
  };
  const auto expect_warning = [&](const std::string& options, const std::string& warning) {
    write_file();
    const Outcome r = run("in.mesh out.mesh --size 0.2" + options);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.err.find("warning: in.mesh: " + warning), std::string::npos) << r.err;
  };
  expect_warning("", "6 faces have more than three corners (first: face 0): triangulated");
  EXPECT_NEAR(checks::area(read(path("out.mesh"))), 6, 1e-9);
  EXPECT_EQ(checks::topology(read(path("out.mesh"))).euler_characteristic, 2);
  std::swap(m.quadrilaterals[2][1], m.quadrilaterals[2][3]);
  expect_warning("", "1 face looked the wrong way (first: face 2)");

  m.points.push_back({9, 9, 9}); // inside a volume, or not
  expect_warning("", "1 vertex has no face (first: vertex 8)");
  m.required_vertices = {8};
  write_file();
  expect_failure(3, "in.mesh out.off --size 0.2", "1 marked vertex has no face (first: vertex 8); --repair mends this");
  write_file("Tetrahedra\n1\n1 2 3 9 0\n");
  const Outcome volume = run("in.mesh out.mesh --size 0.2");
  EXPECT_EQ(volume.status, 0) << volume.err;
  EXPECT_EQ(volume.err.find("vertex 8"), std::string::npos) << volume.err;
  EXPECT_NE(volume.err.find("not kept: the section Tetrahedra"), std::string::npos) << volume.err;

  m.edges = {{0, 1}, {0, 8}, {1, 5}};
  m.ridges = {0, 1};
  m.required_edges = {2};
  m.triangles = {{0, 1, 1}};
  write_file();
  for (const std::string offence : {"1 face has the same vertex twice (first: face 0); ",
                                    "1 marked edge is not an edge of a face (first: edge 1); "})
    expect_failure(3, "in.mesh out.off --size 0.2", offence);
  const Outcome mended = run("in.mesh out.mesh --size 0.2 --no-features --flat --repair");
  EXPECT_NE(mended.out.find("repaired  in.mesh: 1 marked edge"), std::string::npos) << mended.out << mended.err;
  const SMA::Medit_mesh out = SMA::read_medit_mesh(path("out.mesh").string());
  double length = 0;
  ASSERT_EQ(out.required_edges.size(), 1u);
  for (const auto& e : out.edges) { // ridges and required ones
    const auto &p = out.points[e[0]], &q = out.points[e[1]];
    length += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  EXPECT_NEAR(length, 2, 1e-9);
}

TEST_F(Adapt_mesh, welds_medit_files_only_if_they_are_repaired_and_keeps_their_marks)
{
  SMA::Medit_mesh m; // two triangles of a square, with ridges at the seam, on either side, and a corner at one
  m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  m.point_references.assign(6, 0);
  m.triangles = {{0, 1, 2}, {3, 4, 5}};
  m.triangle_references = {0, 0};
  m.edges = {{4, 3}};
  m.edge_references = {0};
  m.ridges = {0};
  m.corners = {4};
  SMA::write_medit_mesh(path("in.mesh").string(), m);
  const auto expect_result = [&](const std::string& options, std::size_t cycles, std::size_t ridges) {
    SCOPED_TRACE(options);
    const Outcome r = run("in.mesh out.mesh --size 2 --no-features " + options);
    ASSERT_EQ(r.status, 0) << r.err;
    const SMA::Medit_mesh out = SMA::read_medit_mesh(path("out.mesh").string());
    EXPECT_EQ(checks::topology(read(path("out.mesh"))).boundary_cycles, cycles);
    EXPECT_EQ(out.ridges.size(), ridges);
    ASSERT_EQ(out.corners.size(), 1u);
    EXPECT_EQ(out.points[out.corners[0]], (std::array<double, 3>{1, 0, 0}));
  };
  expect_result("", 2, 6); // with the boundary
  expect_result("--repair", 1, 5);
  expect_result("--repair --no-weld", 2, 6);
}

TEST_F(Adapt_mesh, welds_seams_unless_told_not_to)
{
  Soup soup = sphere_;
  const auto n = shapes::Index(soup.points.size());
  soup.points.insert(soup.points.end(), sphere_.points.begin(), sphere_.points.end());
  for (auto& t : soup.triangles)
    if (sphere_.points[t[0]][2] + sphere_.points[t[1]][2] + sphere_.points[t[2]][2] > 0)
      for (auto& v : t) v += n;
  for (const std::string format : {"off", "obj", "ply"}) {
    SCOPED_TRACE(format);
    write(path("in.off"), off(soup));
    if (format != "off") {
      expect_success("in.off in." + format + " --size 9 --no-weld --quiet"); // only to convert
    }
    const Outcome r = run("in." + format + " out.off --size 0.2");
    EXPECT_NE(r.err.find("welded"), std::string::npos) << r.err;
    EXPECT_EQ(checks::topology(read(path("out.off"))).boundary_cycles, 0u);
    expect_success("in." + format + " out.off --size 0.2 --no-weld");
    EXPECT_EQ(checks::topology(read(path("out.off"))).boundary_cycles, 2u);
  }
}

TEST_F(Adapt_mesh, turns_what_looks_the_wrong_way)
{
  Soup soup = sphere_;
  for (std::size_t f : {0, 7, 50}) std::swap(soup.triangles[f][0], soup.triangles[f][1]);
  write(path("in.off"), off(soup));
  const Outcome r = run("in.off out.off --size 0.2");
  EXPECT_NE(r.err.find("3 faces looked the wrong way (first: face 0)"), std::string::npos) << r.err;
  EXPECT_GT(checks::least_area(read(path("out.off")), [](const Vector_3& p) { return p; }), 0);
}

TEST_F(Adapt_mesh, names_what_it_does_not_keep)
{
  const auto expect_lost = [&](const std::string& file, const std::string& text, const std::string& what) {
    write(path(file), text);
    const Outcome r = run(file + " out.off --size 1");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.err.find(what), std::string::npos) << r.err;
  };
  expect_lost("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n",
              "not held by the format off, and left out: the labels of the faces; texture coordinates");
  expect_lost("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n l 1 2\nf 1 2 3\n", "not kept: lines");
  expect_lost("in.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"
                        "property float x\nproperty float y\nproperty float z\n"
                        "property uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n", "left out: red of the vertices");
}

TEST_F(Adapt_mesh, writes_stl_as_text_where_single_precision_would_spoil_it)
{
  Soup soup = sphere_;
  for (Vector_3& p : soup.points) p += Vector_3(500000, 5400000, 0);
  write(path("in.off"), off(soup));
  const Outcome r = run("in.off out.stl --size 0.2");
  EXPECT_NE(r.err.find("single precision"), std::string::npos) << r.err;
  EXPECT_EQ(content(path("out.stl")).substr(0, 5), "solid");
  expect_success("in.off out.ply --size 0.2 --quiet");
  const Soup text = read(path("out.stl")), exact = read(path("out.ply"));
  EXPECT_GT(checks::least_quality(text), 0.5);
  EXPECT_NEAR(checks::area(text), checks::area(exact), 1e-6);
  expect_success("out.stl again.off --size 0.2 --quiet");
}

// Files as people have them

TEST_F(Adapt_mesh, reads_off_files_however_their_lines_are_broken)
{
  expect_success("in.off expected.off --size 0.3 --quiet");
  std::string text = off(sphere_);
  for (std::size_t i = 4; i < text.size(); i += 7)
    if (text[i] == ' ') text[i] = '\n';
  const std::string counts = std::to_string(sphere_.points.size()) + " " + std::to_string(sphere_.triangles.size());
  const std::string lines = off(sphere_).substr(4);
  for (const std::string& variant : {text, "# a comment\n\nOFF " + lines, "\xEF\xBB\xBFOFF # c\n# d\n" + lines,
                                     "OFF\n" + counts + "\n# without edges\n" + lines.substr(lines.find('\n'))}) {
    write(path("in.off"), variant);
    expect_success("in.off out.off --size 0.3 --quiet");
    EXPECT_TRUE(content(path("out.off")) == content(path("expected.off")));
  }
  for (const std::string header : {"4OFF", "nOFF\n4", "OFF BINARY"}) {
    write(path("bad.off"), header + "\n" + lines);
    expect_failure(3, "bad.off out.off --size 0.3", "bad.off:1: ");
  }
  write(path("bad.off"), "OFF\n3 1 0\n0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n");
  expect_failure(3, "bad.off out.off --size 0.3", "bad.off:4: a coordinate expected, but there is 'zero'");
}

TEST_F(Adapt_mesh, reads_obj_files_however_their_corners_are_written)
{
  std::string points;
  for (const Vector_3& p : sphere_.points) {
    std::ostringstream line;
    line.precision(17);
    line << "v " << p[0] << (p[1] < 0 ? " " : " +") << p[1] << "\t" << p[2] << " 1.0 # with a weight\r\n";
    points += line.str();
  }
  const auto with_faces = [&](const auto& corner) {
    std::string text = "# points\n\n" + points + "vt 0.5\nvn 0 0 1\n";
    for (const auto& t : sphere_.triangles)
      text += " f " + corner(t[0]) + "  " + corner(t[1]) + "\t" + corner(t[2]) + " # a face\r\n";
    return text;
  };
  const auto n = long(sphere_.points.size());
  const auto plain = [](long v) { return std::to_string(v + 1); };
  write(path("in.obj"), with_faces(plain));
  expect_success("in.obj expected.off --size 0.3 --quiet");
  const auto expect_the_same = [&](const auto& corner) {
    write(path("in.obj"), with_faces(corner));
    expect_success("in.obj out.off --size 0.3 --quiet");
    EXPECT_TRUE(content(path("out.off")) == content(path("expected.off")));
  };
  expect_the_same([&](long v) { return std::to_string(v - n); });
  for (const std::string end : {"/", "//", "/1", "//1", "/1/1", "/-1/-1", "/9999999999999999999/7"})
    expect_the_same([&](long v) { return plain(v) + end; });
  write(path("bad.obj"), "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n");
  expect_failure(3, "bad.obj out.off --size 0.3", "bad.obj:2: a coordinate expected");
  write(path("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n");
  expect_failure(3, "bad.obj out.off --size 0.3", "bad.obj:4: an index expected");
  for (const std::string none : {"0", "4", "-4", "99999999999999999999"}) {
    write(path("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + none + "\n");
    expect_failure(3, "bad.obj out.off --size 0.3", "bad.obj: ");
  }
}

/// A binary stl file of triangles.
std::string stl(const Soup& soup, const std::string& header)
{
  std::string bytes = header;
  bytes.resize(80, ' ');
  const auto append = [&](auto x) { bytes.append(reinterpret_cast<const char*>(&x), sizeof x); };
  append(std::uint32_t(soup.triangles.size()));
  for (const auto& t : soup.triangles) {
    for (int i = 0; i < 3; ++i) append(0.f);
    for (const auto v : t)
      for (int i = 0; i < 3; ++i) append(float(soup.points[v][i]));
    append(std::uint16_t(7));
  }
  return bytes;
}

TEST_F(Adapt_mesh, tells_binary_stl_files_from_text)
{
  Soup soup = sphere_;
  for (Vector_3& p : soup.points) // both zeros are the same place
    for (double& x : p)
      if (x == 0) x = 0;
  write(path("in.stl"), stl(soup, "exported"));
  expect_success("in.stl expected.off --size 0.3 --quiet");
  EXPECT_EQ(checks::topology(read(path("expected.off"))).boundary_cycles, 0u);
  for (double& x : soup.points[soup.triangles[5][0]])
    if (x == 0) x = -0.0;
  for (const std::string& bytes : {stl(soup, "solid of a program that says so"), stl(soup, "x") + "and more"}) {
    write(path("in.stl"), bytes);
    expect_success("in.stl out.off --size 0.3 --quiet");
    EXPECT_TRUE(content(path("out.off")) == content(path("expected.off")));
  }
  write(path("bad.stl"), stl(soup, "x").substr(0, 1000));
  expect_failure(3, "bad.stl out.off --size 0.3", "bad.stl");
  write(path("bad.stl"), "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n");
  expect_failure(3, "bad.stl out.off --size 0.3", "bad.stl:7: not a valid stl file: a facet is no triangle");
}

TEST_F(Adapt_mesh, leaves_out_triangles_of_stl_files_that_are_edges_or_points)
{
  write(path("in.stl"), stl(sphere_, "as it should be"));
  expect_success("in.stl expected.off --size 0.3 --quiet");
  std::mt19937 random(17);
  Soup soup = sphere_;
  for (int i = 0; i < 7; ++i) {
    const auto t = soup.triangles[random() % soup.triangles.size()];
    const auto at = soup.triangles.begin() + std::ptrdiff_t(random() % soup.triangles.size());
    soup.triangles.insert(at, i == 0 ? shapes::Triangle{t[0], t[0], t[0]} : shapes::Triangle{t[i % 2], t[1], t[1 - i % 2]});
  }
  write(path("in.stl"), stl(soup, "by a CAD system"));
  const Outcome r = run("in.stl out.off --size 0.3");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.err.find("in.stl: not kept: 7 triangles with two corners at one place"), std::string::npos) << r.err;
  EXPECT_EQ(checks::topology(read(path("out.off"))).boundary_cycles, 0u);
  EXPECT_EQ(checks::topology(read(path("out.off"))).euler_characteristic, 2);
  EXPECT_NEAR(checks::area(read(path("out.off"))), checks::area(read(path("expected.off"))), 1e-2);
}

TEST_F(Adapt_mesh, refuses_metrics_that_do_not_fit)
{
  SMA::Medit_field metric;
  metric.values.assign(sphere_.points.size() - 1, 0.1);
  SMA::write_medit_solution(path("m.sol").string(), {metric});
  expect_failure(3, "in.off out.off --metric m.sol", "m.sol");
  for (const double bad : {0.0, -1.0}) {
    metric.values.assign(sphere_.points.size(), 0.1);
    metric.values[17] = bad;
    SMA::write_medit_solution(path("m.sol").string(), {metric});
    expect_failure(3, "in.off out.off --metric m.sol", "vertex 17");
  }
  metric.components = 6;
  metric.values.assign(6 * sphere_.points.size(), 0);
  SMA::write_medit_solution(path("m.sol").string(), {metric});
  expect_failure(3, "in.off out.off --metric m.sol", "vertex 0");
}

TEST_F(Adapt_mesh, fails_early_where_it_may_not_write)
{
  fs::create_directory(path("folder.off"));
  expect_failures_that_name(1, {{"absent/out.off", "in.off absent/out.off --size 0.1"},
                                {"absent/out.json", "in.off out.off --size 0.1 --report absent/out.json"},
                                {"absent/out.sol", "in.off out.off --size 0.1 --output-metric absent/out.sol"},
                                {"folder.off", "in.off folder.off --size 0.1"}});
}

TEST_F(Adapt_mesh, leaves_no_part_of_a_file)
{
  expect_success("in.off out.off --size 0.1 --report out.json --output-metric out.sol --quiet");
  std::set<std::string> expected;
  for (const char* name : {"in.off", "out.off", "out.json", "out.sol"}) expected.insert(path(name).string());
  EXPECT_EQ(files(), expected);
}

TEST_F(Adapt_mesh, warns_on_stderr_unless_it_is_to_be_quiet)
{
  Soup soup = sphere_;
  soup.points.emplace_back(9, 9, 9);
  write(path("in.off"), off(soup));
  const Outcome r = run("in.off out.off --size 0.2 --report out.json"), quiet = run("in.off out.off --size 0.2 --quiet");
  EXPECT_NE(r.err.find("\nadapt_mesh: warning: in.off: 1 vertex has no face"), std::string::npos) << r.err;
  EXPECT_EQ(r.out.find("warning"), std::string::npos) << r.out;
  EXPECT_NE(content(path("out.json")).find("\"warnings\": [\"in.off: 1 vertex has no face"), std::string::npos);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Adapt_mesh, obeys_signals_and_leaves_nothing)
{
  const auto before = files();
  const auto expect_end = [&](int signal, const std::string& size, const auto& is_due) {
    const pid_t program = start({"in.off", "out.off", "--report", "out.json", "--size", size});
    while (!is_due()) ::usleep(200);
    ::kill(program, signal);
    EXPECT_EQ(status_within_a_minute(program), 1);
    EXPECT_NE(content(path(".err")).find("adapt_mesh: interrupted, nothing was written\n"), std::string::npos);
    EXPECT_EQ(files(), before);
  };
  const auto has_begun = [&] { return content(path(".err")).find("round 1/") != std::string::npos; };
  const auto is_writing = [&] {
    for (const auto& f : files())
      if (std::error_code gone; f.find(".partial-") != std::string::npos && fs::file_size(f, gone) > 0 && !gone) return true;
    return false;
  };
  for (const int signal : {SIGINT, SIGTERM}) expect_end(signal, "0.0037", has_begun); // to a million vertices
  expect_end(SIGTERM, "0.01", is_writing);
}

TEST_F(Adapt_mesh, finds_the_meshes_of_cgal_by_name)
{
  expect_success("meshes/elephant.off out.off --size 0.05 --quiet");
  EXPECT_TRUE(checks::is_manifold(read(path("out.off"))));
}

} // namespace test_cli

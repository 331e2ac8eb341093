// SPDX-License-Identifier: GPL-3.0-or-later
//
// MEDIT by the package, other formats by parsers that trust no file. Compiled apart, as the repair of meshes is a
// lot to compile.

#include "mesh_files.h"

#include "Bad_input.h"
#include "Medit_marks.h"
#include "medit_elements.h"
#include "medit_soup.h"
#include "mesh_writers.h"
#include "soup_content.h"
#include "soup_files.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>
#include <CGAL/Surface_mesh_adaptation/IO/repair.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace adapt_mesh {

namespace {

/// CGAL's readers and writers complain on the standard streams: not while one of these lives.
class Silence
{
public:
  Silence() : out_(std::cout.rdbuf(nullptr)), error_(std::cerr.rdbuf(nullptr)) {}
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence()
  {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
  }

private:
  std::streambuf* out_;
  std::streambuf* error_;
};

std::string joined(const std::vector<std::string>& sentences)
{
  std::string text;
  for (const std::string& s : sentences) text += (text.empty() ? "" : "; ") + s;
  return text;
}

void append(std::vector<std::string>& all, const std::string& file, const std::vector<std::string>& sentences)
{
  for (const std::string& s : sentences) all.push_back(file + ": " + s);
}

/// A point that was cut apart has several vertices.
void number_points(const std::vector<std::size_t>& point_of_vertex, Constrained_mesh& result)
{
  for (const Vertex v : result.mesh.vertices()) {
    Vertex& first = result.vertex_of_point[point_of_vertex[v]];
    if (first == Mesh::null_vertex()) first = v;
    else result.copies.emplace_back(v, first);
  }
}

/// Makes the mesh of polygons, and of these what can be made of them. Numbers its vertices.
SMA::Repair_report build(Polygon_soup& soup, const Reading_options& options, Constrained_mesh& result)
{
  result.vertex_of_point.assign(soup.points.size(), Mesh::null_vertex());
  SMA::internal::Soup_repair<Point> repair(std::move(soup.points), soup.polygons);
  SMA::Repair_report report = repair.build(result.mesh, {options.weld, options.repair});
  number_points(report.point_of_vertex, result);
  return report;
}

/// What was found in a file, in sentences.
struct Findings
{
  std::vector<std::string> offences, repairs, warnings;

  explicit Findings(const SMA::Repair_report& report)
    : offences(report.offences()), repairs(report.repairs()), warnings(report.warnings())
  {}

  void add_offence(const SMA::internal::Described_defect& d)
  {
    if (d.defect.count == 0) return;
    offences.push_back(d.problem());
    repairs.push_back(d.repair());
  }
};

/// \throws Bad_input with all offences, unless they were mended
void conclude(const std::string& file, const Findings& found, const std::vector<std::string>& lost,
              const Reading_options& options, Constrained_mesh& result)
{
  if (!options.repair && !found.offences.empty())
    throw Bad_input(file + ": " + joined(found.offences) + "; --repair mends this");
  append(result.repairs, file, found.repairs);
  append(result.warnings, file, found.warnings);
  if (!lost.empty()) result.warnings.push_back(file + ": not kept: " + joined(lost));
}

void parse_polygons(const std::string& text, const std::string& file, Constrained_mesh& result,
                    const Reading_options& options)
{
  Polygon_soup soup = parse_polygon_soup(text, extension(file), file);
  const std::vector<Point> points = soup.of_corners.empty() ? std::vector<Point>() : soup.points;
  const SMA::Repair_report report = build(soup, options, result);
  Soup_content(soup, points, report).put_on(result, options.references);
  conclude(file, Findings(report), soup.lost, options, result);
}

/// The places of points that may be joined, else their indices.
std::vector<std::uint32_t> places(const std::vector<Point>& points, bool may_be_joined)
{
  if (may_be_joined) return SMA::internal::places_of(points);
  std::vector<std::uint32_t> indices(points.size());
  std::iota(indices.begin(), indices.end(), std::uint32_t(0));
  return indices;
}

/// As if only the shape mattered: required elements are constrained, as ridges and corners are.
void forget_references(SMA::Medit_mesh& medit)
{
  for (auto* references : {&medit.point_references, &medit.triangle_references, &medit.quadrilateral_references,
                           &medit.edge_references})
    std::fill(references->begin(), references->end(), 0);
  medit.ridges.insert(medit.ridges.end(), medit.required_edges.begin(), medit.required_edges.end());
  medit.required_edges.clear();
  medit.required_triangles.clear();
}

/// The topology of these files is explicit: nothing is joined unless it is to be repaired. Points and marks off the
/// surface are right if there is a volume.
void parse_medit(const std::string& text, const std::string& file, Constrained_mesh& result, Reading_options options)
{
  SMA::Medit_mesh medit = SMA::parse_medit_mesh(text, file);
  if (!options.references) forget_references(medit);
  options.weld = options.weld && options.repair;
  Polygon_soup soup = polygon_soup(medit);
  const std::vector<std::uint32_t> place = places(soup.points, options.weld);
  Medit_marks marks(medit, place);
  SMA::Repair_report report = build(soup, options, result);
  marks.put_on(result, report.point_of_vertex);
  Soup_content(soup, {}, report).put_on(result, options.references);
  Medit_elements(medit, place, report, result).put();
  if (has_volume(medit)) report.isolated_points = SMA::Soup_defect();
  Findings found(report);
  const SMA::Soup_defect edges = marks.stray_edges(), vertices = marks.stray_vertices();
  found.add_offence({edges, "marked edge is not an edge of a face", "marked edges are not edges of faces", "left out"});
  if (!has_volume(medit))
    found.add_offence({vertices, "marked vertex has no face", "marked vertices have no face", "left out"});
  conclude(file, found, soup.lost, options, result);
}

/// Where the file is: as named or, if there is none, among CGAL's data.
std::string located(const std::string& file)
{
  if (std::filesystem::exists(file)) return file;
  const Silence silence;
  const std::string data_file = CGAL::data_file_path(file);
  return std::filesystem::exists(data_file) ? data_file : file;
}

/// Largest distance along an axis by which single precision would move a vertex.
double rounding_of_single_precision(const Mesh& mesh)
{
  double largest = 0;
  for (const Vertex v : mesh.vertices())
    for (int i = 0; i < 3; ++i) {
      const double x = mesh.point(v)[i];
      largest = (std::max)(largest, std::abs(x - double(float(x))));
    }
  return largest;
}

double shortest_edge(const Mesh& mesh)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const Edge e : mesh.edges())
    shortest = (std::min)(shortest, CGAL::Polygon_mesh_processing::squared_edge_length(e, mesh));
  return std::sqrt(shortest);
}

void write(std::ofstream& out, const std::string& format, bool as_text, const Constrained_mesh& mesh)
{
  if (format == "off") write_off(out, mesh);
  else if (format == "obj") write_obj(out, mesh);
  else if (format == "ply") write_ply(out, mesh);
  else if (as_text) write_stl_text(out, mesh);
  else write_stl_binary(out, mesh);
}

} // namespace

void parse_mesh(const std::string& text, const std::string& file, Constrained_mesh& result,
                const Reading_options& options)
{
  const Silence silence;
  if (is_medit_format(file)) parse_medit(text, file, result, options);
  else parse_polygons(text, file, result, options);
  if (result.mesh.number_of_faces() == 0) throw SMA::Empty_mesh_error();
  SMA::internal::import_face_graph(SMA::Sequential_execution(), result.mesh, result.mesh.points()); // checks it
}

void read_mesh(const std::string& file, Constrained_mesh& result, const Reading_options& options)
{
  const std::string path = located(file);
  if (!std::filesystem::exists(path)) throw SMA::Io_error(file, 0, "no such file");
  if (!std::filesystem::is_regular_file(path)) throw SMA::Io_error(file, 0, "not a file");
  parse_mesh(SMA::internal::read_content(path), file, result, options);
}

std::vector<std::string> write_mesh(const std::string& file, const Constrained_mesh& mesh)
{
  const std::string format = extension(file);
  std::vector<std::string> warnings;
  const std::vector<std::string> lost = left_out(format, mesh);
  if (!lost.empty()) warnings.push_back("not held by the format " + format + ", and left out: " + joined(lost));
  if (is_medit_format(file)) {
    SMA::write_medit_mesh(file, medit_mesh(mesh));
    return warnings;
  }
  constexpr double largest_share = 0.01; // of the shortest edge that rounding may move a vertex by
  const bool is_too_coarse = // for the single precision of binary stl files
    format == "stl" && rounding_of_single_precision(mesh.mesh) > largest_share * shortest_edge(mesh.mesh);
  std::ofstream out(file, std::ios::binary);
  write(out, format, is_too_coarse || mesh.has_labels, mesh);
  if (!out.flush()) throw SMA::Io_error(file, 0, "cannot be written");
  if (is_too_coarse)
    warnings.push_back("the output is text: the single precision of binary stl files would move vertices by more than a "
                       "hundredth of the shortest edge");
  return warnings;
}

} // namespace adapt_mesh

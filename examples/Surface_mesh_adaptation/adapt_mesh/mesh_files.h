// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading and writing the surface meshes of adapt_mesh: MEDIT by the package, other formats by CGAL.

#ifndef ADAPT_MESH_MESH_FILES_H
#define ADAPT_MESH_MESH_FILES_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>
#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace adapt_mesh {

namespace SMA = CGAL::Surface_mesh_adaptation;

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Edge = Mesh::Edge_index;

/// A mesh with its constraints.
struct Constrained_mesh
{
  Mesh mesh;
  Mesh::Property_map<Edge, bool> edge_is_constrained;
  Mesh::Property_map<Vertex, bool> vertex_is_constrained;
  std::vector<Vertex> vertex_of_point; ///< the vertex of each point of the file, `null_vertex()` if not used
  std::vector<std::string> warnings;

  Constrained_mesh()
    : edge_is_constrained(mesh.add_property_map<Edge, bool>("e:constrained", false).first),
      vertex_is_constrained(mesh.add_property_map<Vertex, bool>("v:constrained", false).first)
  {}
  Constrained_mesh(const Constrained_mesh&) = delete; // the maps belong to the mesh
  Constrained_mesh& operator=(const Constrained_mesh&) = delete;
};

/// Of the bounding box.
inline double diagonal(const Mesh& mesh)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::sqrt(CGAL::square(box.x_span()) + CGAL::square(box.y_span()) + CGAL::square(box.z_span()));
}

/// The extension of a file name in lower case, without its dot.
inline std::string extension(const std::string& file)
{
  std::string e = std::filesystem::path(file).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return e.empty() ? e : e.substr(1);
}

inline bool is_mesh_format(const std::string& file)
{
  const std::array<const char*, 6> known = {"off", "obj", "ply", "stl", "mesh", "meshb"};
  return std::find(known.begin(), known.end(), extension(file)) != known.end();
}

inline bool is_medit_format(const std::string& file) { return extension(file) == "mesh" || extension(file) == "meshb"; }

namespace internal {

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

/// A face as CGAL's readers fill it. It remembers how many corners it was given but keeps three, thus a file that
/// announces a huge face costs nothing.
class Soup_face
{
public:
  using value_type = std::size_t;
  using iterator = std::size_t*;
  using const_iterator = const std::size_t*;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void resize(std::size_t size) { size_ = size; }
  std::size_t& operator[](std::size_t i) { return corners_[(std::min)(i, std::size_t(3))]; }
  std::size_t operator[](std::size_t i) const { return corners_[(std::min)(i, std::size_t(3))]; }
  iterator begin() { return corners_.data(); }
  iterator end() { return corners_.data() + (std::min)(size_, std::size_t(3)); }
  const_iterator begin() const { return corners_.data(); }
  const_iterator end() const { return corners_.data() + (std::min)(size_, std::size_t(3)); }

private:
  std::size_t size_ = 0;
  std::array<std::size_t, 4> corners_{}; // the last one takes all that is beyond a triangle
};

/// CGAL allocates what the header of an OFF file announces: refuses one that announces more than the file can hold.
inline void check_off_header(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  CGAL::File_header_OFF header;
  if (!(in >> header)) throw SMA::Io_error(file, 1, "not the header of an off file");
  const std::size_t length = std::filesystem::file_size(file);
  if (header.size_of_vertices() > length || header.size_of_facets() > length)
    throw SMA::Io_error(file, 0, "the file is too short for the numbers in its header");
}

/// The line that a reader was at when it gave up, or 0 if the file is no text.
inline std::size_t line_reached(std::ifstream& in)
{
  in.clear();
  const auto position = in.tellg();
  std::string text(position > 0 ? std::size_t(position) : 0, '\0');
  in.seekg(0).read(text.data(), std::streamsize(text.size()));
  if (text.find('\0') != std::string::npos) return 0;
  if (!text.empty() && text.back() == '\n') text.pop_back(); // the line was read to its end
  return std::size_t(std::count(text.begin(), text.end(), '\n')) + 1;
}

inline SMA::Triangle_soup triangles_of(const std::vector<Soup_face>& faces, std::size_t number_of_points)
{
  SMA::Triangle_soup triangles;
  triangles.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Soup_face& f = faces[i];
    if (f.size() != 3) throw SMA::Non_triangular_face_error(i);
    if (std::any_of(f.begin(), f.end(), [&](std::size_t v) { return v >= number_of_points; }))
      throw SMA::Invalid_input_error("a face has a vertex that does not exist", "face", i);
    triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[1]), std::uint32_t(f[2])});
  }
  return triangles;
}

inline bool read_soup(std::ifstream& in, const std::string& format, std::vector<Point>& points,
                      std::vector<Soup_face>& faces)
{
  const Silence silence;
  return format == "off"   ? CGAL::IO::read_OFF(in, points, faces)
         : format == "obj" ? CGAL::IO::read_OBJ(in, points, faces)
         : format == "ply" ? CGAL::IO::read_PLY(in, points, faces)
                           : CGAL::IO::read_STL(in, points, faces);
}

inline void read_with_cgal(const std::string& file, Constrained_mesh& result)
{
  const std::string format = extension(file);
  if (format == "off") check_off_header(file);
  std::vector<Point> points;
  std::vector<Soup_face> faces;
  std::ifstream in(file, std::ios::binary);
  bool success = false;
  try {
    success = read_soup(in, format, points, faces);
  } catch (const std::exception&) { // whatever a malformed file brings about
  }
  if (!success) throw SMA::Io_error(file, line_reached(in), "not a valid " + format + " file");
  const SMA::Triangle_soup triangles = triangles_of(faces, points.size());
  result.vertex_of_point = SMA::triangle_soup_to_triangle_mesh(std::move(points), triangles, result.mesh);
}

inline void read_medit(const std::string& file, Constrained_mesh& result)
{
  const SMA::Medit_mesh medit = SMA::read_medit_mesh(file);
  result.vertex_of_point =
    SMA::medit_to_triangle_mesh(medit, result.mesh, result.edge_is_constrained, result.vertex_is_constrained);
  for (const std::string& section : medit.ignored_sections)
    result.warnings.push_back(file + ": the section " + section + " is ignored");
  const auto& references = medit.triangle_references;
  if (std::adjacent_find(references.begin(), references.end(), std::not_equal_to<>()) != references.end())
    result.warnings.push_back(file + ": the references of the triangles are not kept");
}

/// Where the file is: as named or, if there is none, among CGAL's data.
inline std::string located(const std::string& file)
{
  if (std::filesystem::exists(file)) return file;
  const Silence silence;
  const std::string data_file = CGAL::data_file_path(file);
  return std::filesystem::exists(data_file) ? data_file : file;
}

} // namespace internal

/// Reads the mesh in `file`, or in the file of that name among CGAL's data, into the empty `result`.
/// \pre `is_mesh_format(file)`
/// \throws Io_error, Invalid_input_error
inline void read_mesh(const std::string& file, Constrained_mesh& result)
{
  const std::string path = internal::located(file);
  if (!std::filesystem::exists(path)) throw SMA::Io_error(file, 0, "no such file");
  if (!std::filesystem::is_regular_file(path)) throw SMA::Io_error(file, 0, "not a file");
  if (!std::ifstream(path)) throw SMA::Io_error(file, 0, "cannot be read");
  if (is_medit_format(path)) internal::read_medit(path, result);
  else internal::read_with_cgal(path, result);
}

/// Writes the mesh to `file`. \pre `is_mesh_format(file)` \throws Io_error
inline void write_mesh(const std::string& file, const Constrained_mesh& mesh)
{
  const std::string format = extension(file);
  if (is_medit_format(file))
    return SMA::write_medit_mesh(
      file, SMA::triangle_mesh_to_medit(mesh.mesh, mesh.edge_is_constrained, mesh.vertex_is_constrained));
  std::ofstream out(file, std::ios::binary);
  const auto precision = CGAL::parameters::stream_precision(17);
  if (format == "ply" || format == "stl") CGAL::IO::set_binary_mode(out);
  const bool success = format == "off"   ? CGAL::IO::write_OFF(out, mesh.mesh, precision)
                       : format == "obj" ? CGAL::IO::write_OBJ(out, mesh.mesh, precision)
                       : format == "ply" ? CGAL::IO::write_PLY(out, mesh.mesh, precision)
                                         : CGAL::IO::write_STL(out, mesh.mesh, precision);
  if (!success || !out.flush()) throw SMA::Io_error(file, 0, "cannot be written");
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_MESH_FILES_H

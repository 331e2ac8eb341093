// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sections of a mesh, read from and written to either form.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MESH_SECTIONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MESH_SECTIONS_H

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT/Medit_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

/// Makes a mesh of the sections that a `Reader` finds. \throws Io_error
template <class Reader>
class Medit_mesh_parser
{
public:
  explicit Medit_mesh_parser(Reader& reader) : in(reader) {}

  Medit_mesh parse()
  {
    in.read_sections([&](const std::string& keyword, const char* position) { read_section(keyword, position); });
    if (section_begin_.count("Vertices") == 0) in.fail(in.position(), "there is no section Vertices");
    check_indices();
    return std::move(mesh_);
  }

private:
  void read_section(const std::string& keyword, const char* position)
  {
    if (section_begin_.count(keyword) != 0) in.fail(position, "there is a second section " + keyword);
    section_begin_[keyword] = position;
    if (keyword == "Vertices") read_points();
    else if (keyword == "Triangles") read_tuples(keyword, mesh_.triangles, mesh_.triangle_references);
    else if (keyword == "Quadrilaterals") read_tuples(keyword, mesh_.quadrilaterals, mesh_.quadrilateral_references);
    else if (keyword == "Edges") read_tuples(keyword, mesh_.edges, mesh_.edge_references);
    else if (keyword == "Ridges") read_indices(keyword, mesh_.ridges);
    else if (keyword == "RequiredEdges") read_indices(keyword, mesh_.required_edges);
    else if (keyword == "RequiredTriangles") read_indices(keyword, mesh_.required_triangles);
    else if (keyword == "Corners") read_indices(keyword, mesh_.corners);
    else if (keyword == "RequiredVertices") read_indices(keyword, mesh_.required_vertices);
    else {
      mesh_.ignored_sections.push_back(keyword);
      in.skip_section();
    }
  }

  void read_points()
  {
    const std::size_t n = in.count();
    in.check_room(n, 1, 3);
    mesh_.points.resize(n);
    mesh_.point_references.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (double& x : mesh_.points[i]) x = in.real("a coordinate");
      mesh_.point_references[i] = in.template integer<int>("a reference");
    }
  }

  template <std::size_t N>
  void read_tuples(const std::string& keyword, Medit_mesh::Tuples<N>& tuples, std::vector<int>& references)
  {
    const std::size_t n = in.count();
    in.check_room(n, N + 1, 0);
    section_begin_[keyword] = in.position();
    tuples.resize(n);
    references.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::uint32_t& v : tuples[i]) v = index();
      references[i] = in.template integer<int>("a reference");
    }
  }

  void read_indices(const std::string& keyword, Medit_mesh::Indices& indices)
  {
    const std::size_t n = in.count();
    in.check_room(n, 1, 0);
    section_begin_[keyword] = in.position();
    indices.resize(n);
    for (std::uint32_t& i : indices) i = index();
  }

  /// An index, counted from 0; whether the item exists is known when the whole file was read.
  std::uint32_t index()
  {
    const auto i = in.template integer<std::uint32_t>("an index");
    if (i == 0) in.fail(in.last(), "the index 0: indices start at 1");
    return i - 1;
  }

  void check_indices() // sections may come in any order, hence last
  {
    check_tuples("Triangles", mesh_.triangles);
    check_tuples("Quadrilaterals", mesh_.quadrilaterals);
    check_tuples("Edges", mesh_.edges);
    check_items("Ridges", mesh_.ridges, mesh_.edges.size(), "edge");
    check_items("RequiredEdges", mesh_.required_edges, mesh_.edges.size(), "edge");
    check_items("RequiredTriangles", mesh_.required_triangles, mesh_.triangles.size(), "triangle");
    check_items("Corners", mesh_.corners, mesh_.points.size(), "vertex");
    check_items("RequiredVertices", mesh_.required_vertices, mesh_.points.size(), "vertex");
  }

  template <std::size_t N>
  void check_tuples(const char* keyword, const Medit_mesh::Tuples<N>& tuples)
  {
    for (std::size_t i = 0; i < tuples.size(); ++i)
      for (std::size_t j = 0; j < N; ++j)
        if (tuples[i][j] >= mesh_.points.size())
          fail_at_integer(keyword, i * (N + 1) + j, "there is no vertex " + std::to_string(tuples[i][j] + 1ull));
  }

  void check_items(const char* keyword, const Medit_mesh::Indices& indices, std::size_t n, const char* kind)
  {
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (indices[i] >= n)
        fail_at_integer(keyword, i, std::string("there is no ") + kind + " " + std::to_string(indices[i] + 1ull));
  }

  /// Blames an integer of a section that was read before.
  [[noreturn]] void fail_at_integer(const char* keyword, std::size_t i, const std::string& what)
  {
    in.fail(in.integer_at(section_begin_[keyword], i), what);
  }

  Reader& in;
  Medit_mesh mesh_;
  std::map<std::string, const char*> section_begin_; // of the items, once they are being read
};

template <class Writer, std::size_t N>
void write_tuples(Writer& out, const char* keyword, const Medit_mesh::Tuples<N>& tuples,
                  const std::vector<int>& references)
{
  if (tuples.empty()) return;
  out.section(keyword, tuples.size());
  for (std::size_t i = 0; i < tuples.size(); ++i) {
    for (const std::uint32_t v : tuples[i]) out.integer(v + 1ull);
    out.integer(references[i]).end_line();
  }
}

template <class Writer>
void write_indices(Writer& out, const char* keyword, const Medit_mesh::Indices& indices)
{
  if (indices.empty()) return;
  out.section(keyword, indices.size());
  for (const std::uint32_t i : indices) out.integer(i + 1ull).end_line();
}

/// Writes the sections of a mesh, those that are not empty.
template <class Writer>
void write_sections(Writer& out, const Medit_mesh& mesh)
{
  out.section("Vertices", mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (const double x : mesh.points[i]) out.real(x);
    out.integer(mesh.point_references[i]).end_line();
  }
  write_tuples(out, "Triangles", mesh.triangles, mesh.triangle_references);
  write_tuples(out, "Quadrilaterals", mesh.quadrilaterals, mesh.quadrilateral_references);
  write_tuples(out, "Edges", mesh.edges, mesh.edge_references);
  write_indices(out, "Ridges", mesh.ridges);
  write_indices(out, "RequiredEdges", mesh.required_edges);
  write_indices(out, "RequiredTriangles", mesh.required_triangles);
  write_indices(out, "Corners", mesh.corners);
  write_indices(out, "RequiredVertices", mesh.required_vertices);
}

/// The largest number that counts or names an item.
inline std::size_t largest_count(const Medit_mesh& mesh)
{
  return (std::max)({mesh.points.size(), mesh.triangles.size(), mesh.quadrilaterals.size(), mesh.edges.size()});
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_MESH_SECTIONS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of MEDIT in text form: `.mesh` for surface meshes, `.sol` for a size, a tensor or a field at their vertices.
// (P. Frey, "MEDIT: an interactive mesh visualization software", INRIA technical report 253, 2001.)
//
// Files count from 1, everything here counts from 0. A file is never trusted: what it announces is allocated only as
// far as its length can back it, and every index and coordinate is checked. Whatever is wrong raises an `Io_error`
// with the line.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_H

#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// The content of a `.mesh` file, as far as surfaces go.
struct Medit_mesh
{
  template <std::size_t N>
  using Simplices = std::vector<std::array<std::uint32_t, N>>;
  using Indices = std::vector<std::uint32_t>;

  std::vector<std::array<double, 3>> points;
  std::vector<int> point_references;         ///< as many as points
  Simplices<3> triangles;                    ///< indices of points
  std::vector<int> triangle_references;      ///< as many as triangles
  Simplices<2> edges;                        ///< indices of points
  std::vector<int> edge_references;          ///< as many as edges
  Indices ridges;                            ///< indices of edges: sharp edges of the surface
  Indices required_edges;                    ///< indices of edges
  Indices corners;                           ///< indices of points: where the surface has a tip, or ridges end or turn
  Indices required_vertices;                 ///< indices of points
  std::vector<std::string> ignored_sections; ///< names of the sections that were skipped, tetrahedra for instance
};

/// The content of a `.sol` file: one field at the vertices.
struct Medit_solution
{
  int components = 1;         ///< 1: a scalar; 6: a symmetric tensor, as xx xy yy xz yz zz
  std::vector<double> values; ///< `components` for each vertex

  std::size_t number_of_vertices() const { return values.size() / std::size_t(components); }
};

namespace internal {

/// Cuts a text into words; '#' starts a comment that ends with the line. The line number is counted only on demand,
/// when an error is reported.
class Medit_scanner
{
public:
  Medit_scanner(const std::string& text, const std::string& file)
    : file_(file), begin_(text.data()), end_(begin_ + text.size()), next_(begin_)
  {}

  /// Where the next word starts.
  const char* position()
  {
    while (next_ != end_ && (is_blank(*next_) || *next_ == '#'))
      next_ = *next_ == '#' ? std::find(next_, end_, '\n') : next_ + 1;
    return next_;
  }

  void move_to(const char* position) { next_ = position; }
  bool at_end() { return position() == end_; }
  bool at_number() { return !at_end() && !std::isalpha(static_cast<unsigned char>(*next_)); }

  std::string_view word()
  {
    const char* const first = position();
    next_ = std::find_if(first, end_, is_separator);
    return {first, std::size_t(next_ - first)};
  }

  double real(const char* what)
  {
    const double value = number<double>(what);
    if (!std::isfinite(value)) fail(last_, std::string(what) + " is not finite");
    return value;
  }

  template <class Integer>
  Integer integer(const char* what)
  {
    return number<Integer>(what);
  }

  /// Reads the number of items of a section. Each item takes `words` words of two characters at least, thus a file
  /// cannot announce much more than it holds.
  std::size_t count(std::size_t words)
  {
    const auto n = integer<std::uint32_t>("the number of items");
    if (2 * words * std::uint64_t(n) > std::uint64_t(end_ - next_) + 1)
      fail(last_, "the file is too short for " + std::to_string(n) + " items");
    return n;
  }

  /// Where the number that was read last starts.
  const char* last() const { return last_; }

  [[noreturn]] void fail(const char* position, const std::string& what) const
  {
    throw Io_error(file_, std::size_t(std::count(begin_, position, '\n')) + 1, what);
  }

  /// The word at `position`, fit for a message.
  std::string quoted(const char* position) const
  {
    constexpr std::ptrdiff_t longest = 32;
    const char* const last = std::find_if(position, position + (std::min)(longest, end_ - position), is_separator);
    std::string text(position, last);
    const auto is_strange = [](char c) { return c < ' ' || c > '~'; };
    std::replace_if(text.begin(), text.end(), is_strange, '?');
    return position == end_ ? "the end of the file" : "'" + text + "'";
  }

private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static bool is_separator(char c) { return is_blank(c) || c == '#'; }

  template <class Number>
  Number number(const char* what)
  {
    last_ = position();
    const char* const first = last_ != end_ && *last_ == '+' ? last_ + 1 : last_; // from_chars() knows no '+'
    Number value = 0;
    const std::from_chars_result result = std::from_chars(first, end_, value);
    if (result.ec == std::errc::result_out_of_range) fail(last_, std::string(what) + " is out of range");
    if (result.ec != std::errc() || (result.ptr != end_ && !is_separator(*result.ptr)))
      fail(last_, std::string(what) + " expected, but there is " + quoted(last_));
    next_ = result.ptr;
    return value;
  }

  std::string file_;
  const char* begin_;
  const char* end_;
  const char* next_;
  const char* last_ = nullptr;
};

/// What both kinds of files share: a header, then sections that start with a keyword, then "End".
class Medit_parser
{
public:
  Medit_parser(const std::string& text, const std::string& file) : in(text, file) {}

protected:
  /// Calls `read_section(keyword, position)` for each section of the file but the header.
  template <class ReadSection>
  void read_sections(const ReadSection& read_section)
  {
    check_version();
    while (!in.at_end()) {
      const char* const position = in.position();
      if (in.at_number()) in.fail(position, "a keyword expected, but there is " + in.quoted(position));
      const std::string keyword(in.word());
      if (keyword == "End") return;
      if (keyword == "Dimension") {
        check_dimension();
        continue;
      }
      if (!has_dimension_) in.fail(position, "the section Dimension must come first");
      read_section(keyword, position);
    }
  }

  /// Skips the section whose keyword was just read, whatever it may hold.
  void skip_section()
  {
    while (in.at_number()) in.word();
  }

  Medit_scanner in;

private:
  void check_version()
  {
    const char* const position = in.position();
    if (in.word() != "MeshVersionFormatted")
      in.fail(position, "MeshVersionFormatted expected, but there is " + in.quoted(position));
    // the versions differ in the width of the numbers of the binary form only
    const auto version = in.integer<int>("the version");
    if (version < 1 || version > 4) in.fail(in.last(), "unknown version " + std::to_string(version));
  }

  void check_dimension()
  {
    const auto dimension = in.integer<int>("the dimension");
    if (dimension != 3) in.fail(in.last(), "the dimension is " + std::to_string(dimension) + " instead of 3");
    has_dimension_ = true;
  }

  bool has_dimension_ = false;
};

class Medit_mesh_parser : Medit_parser
{
public:
  using Medit_parser::Medit_parser;

  Medit_mesh parse()
  {
    read_sections([&](const std::string& keyword, const char* position) { read_section(keyword, position); });
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
    else if (keyword == "Triangles") read_simplices(keyword, mesh_.triangles, mesh_.triangle_references);
    else if (keyword == "Edges") read_simplices(keyword, mesh_.edges, mesh_.edge_references);
    else if (keyword == "Ridges") read_indices(keyword, mesh_.ridges);
    else if (keyword == "RequiredEdges") read_indices(keyword, mesh_.required_edges);
    else if (keyword == "Corners") read_indices(keyword, mesh_.corners);
    else if (keyword == "RequiredVertices") read_indices(keyword, mesh_.required_vertices);
    else if (keyword == "Quadrilaterals") check_there_is_no_quadrilateral();
    else {
      mesh_.ignored_sections.push_back(keyword);
      skip_section();
    }
  }

  void read_points()
  {
    const std::size_t n = in.count(4);
    mesh_.points.resize(n);
    mesh_.point_references.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (double& x : mesh_.points[i]) x = in.real("a coordinate");
      mesh_.point_references[i] = in.integer<int>("a reference");
    }
  }

  template <std::size_t N>
  void read_simplices(const std::string& keyword, Medit_mesh::Simplices<N>& simplices, std::vector<int>& references)
  {
    const std::size_t n = in.count(N + 1);
    section_begin_[keyword] = in.position();
    simplices.resize(n);
    references.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::uint32_t& v : simplices[i]) v = index();
      references[i] = in.integer<int>("a reference");
    }
  }

  void read_indices(const std::string& keyword, Medit_mesh::Indices& indices)
  {
    const std::size_t n = in.count(1);
    section_begin_[keyword] = in.position();
    indices.resize(n);
    for (std::uint32_t& i : indices) i = index();
  }

  /// An index, counted from 0; whether the item exists is known when the whole file was read.
  std::uint32_t index()
  {
    const auto i = in.integer<std::uint32_t>("an index");
    if (i == 0) in.fail(in.last(), "the index 0: indices start at 1");
    return i - 1;
  }

  void check_there_is_no_quadrilateral()
  {
    if (in.integer<std::uint32_t>("the number of items") != 0)
      in.fail(in.last(), "there are quadrilaterals: the surface must be made of triangles");
  }

  void check_indices() // sections may come in any order, hence last
  {
    check_simplices("Triangles", mesh_.triangles);
    check_simplices("Edges", mesh_.edges);
    check_items("Ridges", mesh_.ridges, mesh_.edges.size(), "edge");
    check_items("RequiredEdges", mesh_.required_edges, mesh_.edges.size(), "edge");
    check_items("Corners", mesh_.corners, mesh_.points.size(), "vertex");
    check_items("RequiredVertices", mesh_.required_vertices, mesh_.points.size(), "vertex");
  }

  template <std::size_t N>
  void check_simplices(const char* keyword, const Medit_mesh::Simplices<N>& simplices)
  {
    for (std::size_t i = 0; i < simplices.size(); ++i)
      for (std::size_t j = 0; j < N; ++j)
        if (simplices[i][j] >= mesh_.points.size())
          fail_at_word(keyword, i * (N + 1) + j, "there is no vertex " + std::to_string(simplices[i][j] + 1ull));
  }

  void check_items(const char* keyword, const Medit_mesh::Indices& indices, std::size_t n, const char* kind)
  {
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (indices[i] >= n)
        fail_at_word(keyword, i, std::string("there is no ") + kind + " " + std::to_string(indices[i] + 1ull));
  }

  /// Blames a word of a section that was read before.
  [[noreturn]] void fail_at_word(const char* keyword, std::size_t word, const std::string& what)
  {
    in.move_to(section_begin_[keyword]);
    for (std::size_t i = 0; i < word; ++i) in.word();
    in.fail(in.position(), what);
  }

  Medit_mesh mesh_;
  std::map<std::string, const char*> section_begin_; // of the items, once they are being read
};

class Medit_solution_parser : Medit_parser
{
public:
  using Medit_parser::Medit_parser;

  Medit_solution parse()
  {
    bool found = false;
    read_sections([&](const std::string& keyword, const char* position) {
      if (keyword != "SolAtVertices") return skip_section();
      if (found) in.fail(position, "there is a second section SolAtVertices");
      found = true;
      read_values();
    });
    if (!found) in.fail(in.position(), "there is no section SolAtVertices");
    return std::move(solution_);
  }

private:
  void read_values()
  {
    const std::size_t n = in.count(1);
    const auto fields = in.integer<int>("the number of fields");
    if (fields != 1) in.fail(in.last(), "there are " + std::to_string(fields) + " fields instead of 1");
    const auto type = in.integer<int>("the type of the field");
    if (type != 1 && type != 3)
      in.fail(in.last(), "the type of the field is neither 1 (scalar) nor 3 (symmetric tensor)");
    solution_.components = type == 1 ? 1 : 6;
    for (std::size_t i = 0, end = n * std::size_t(solution_.components); i < end; ++i)
      solution_.values.push_back(in.real("a value"));
  }

  Medit_solution solution_;
};

/// Formats numbers at the end of a text, without the cost of a stream.
class Medit_printer
{
public:
  Medit_printer& section(const char* keyword, std::size_t n)
  {
    text_ += '\n';
    text_ += keyword;
    text_ += '\n';
    return integer(n).end_line();
  }

  template <class Integer>
  Medit_printer& integer(Integer i)
  {
    return append([&](char* b, char* e) { return std::to_chars(b, e, i); });
  }

  /// With 17 significant digits, thus the value that is read back is the same.
  Medit_printer& real(double x)
  {
    constexpr int digits = std::numeric_limits<double>::max_digits10;
    return append([&](char* b, char* e) { return std::to_chars(b, e, x, std::chars_format::general, digits); });
  }

  Medit_printer& end_line()
  {
    text_.back() = '\n';
    return *this;
  }

  std::string finish() { return std::move(text_ += "\nEnd\n"); }

private:
  template <class Print>
  Medit_printer& append(const Print& print)
  {
    std::array<char, 32> word; // the longest number has 24 characters
    text_.append(word.data(), print(word.data(), word.data() + word.size()).ptr);
    text_ += ' ';
    return *this;
  }

  std::string text_ = "MeshVersionFormatted 2\nDimension 3\n";
};

template <std::size_t N>
void print_simplices(Medit_printer& out, const char* keyword, const Medit_mesh::Simplices<N>& simplices,
                     const std::vector<int>& references)
{
  if (simplices.empty()) return;
  out.section(keyword, simplices.size());
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    for (const std::uint32_t v : simplices[i]) out.integer(v + 1ull);
    out.integer(references[i]).end_line();
  }
}

inline void print_indices(Medit_printer& out, const char* keyword, const Medit_mesh::Indices& indices)
{
  if (indices.empty()) return;
  out.section(keyword, indices.size());
  for (const std::uint32_t i : indices) out.integer(i + 1ull).end_line();
}

inline std::string read_text(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Io_error(file, 0, "cannot be opened");
  std::string text;
  std::vector<char> block(std::size_t(1) << 20);
  do {
    in.read(block.data(), std::streamsize(block.size()));
    text.append(block.data(), std::size_t(in.gcount()));
  } while (in);
  if (in.bad() || !in.eof()) throw Io_error(file, 0, "cannot be read");
  return text;
}

inline void write_text(const std::string& file, const std::string& text)
{
  std::ofstream out(file, std::ios::binary);
  if (!out) throw Io_error(file, 0, "cannot be opened for writing");
  out.write(text.data(), std::streamsize(text.size())).flush();
  if (!out) throw Io_error(file, 0, "cannot be written");
}

} // namespace internal

/// Reads a mesh from `text`, the content of the file `file` (which is named in errors only). \throws Io_error
inline Medit_mesh parse_medit_mesh(const std::string& text, const std::string& file)
{
  return internal::Medit_mesh_parser(text, file).parse();
}

/// Reads a solution from `text`, the content of the file `file` (which is named in errors only). \throws Io_error
inline Medit_solution parse_medit_solution(const std::string& text, const std::string& file)
{
  return internal::Medit_solution_parser(text, file).parse();
}

/// Reads a `.mesh` file. Triangles with references, edges and marks are kept, quadrilaterals are rejected, other
/// sections are skipped and listed in `ignored_sections`. \throws Io_error
inline Medit_mesh read_medit_mesh(const std::string& file) { return parse_medit_mesh(internal::read_text(file), file); }

/// Reads a `.sol` file that holds one scalar or one symmetric tensor for each vertex. \throws Io_error
inline Medit_solution read_medit_solution(const std::string& file)
{
  return parse_medit_solution(internal::read_text(file), file);
}

/// The content of the `.mesh` file of `mesh`.
inline std::string print_medit_mesh(const Medit_mesh& mesh)
{
  internal::Medit_printer out;
  out.section("Vertices", mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (const double x : mesh.points[i]) out.real(x);
    out.integer(mesh.point_references[i]).end_line();
  }
  internal::print_simplices(out, "Triangles", mesh.triangles, mesh.triangle_references);
  internal::print_simplices(out, "Edges", mesh.edges, mesh.edge_references);
  internal::print_indices(out, "Ridges", mesh.ridges);
  internal::print_indices(out, "RequiredEdges", mesh.required_edges);
  internal::print_indices(out, "Corners", mesh.corners);
  internal::print_indices(out, "RequiredVertices", mesh.required_vertices);
  return out.finish();
}

/// The content of the `.sol` file of `solution`.
inline std::string print_medit_solution(const Medit_solution& solution)
{
  internal::Medit_printer out;
  out.section("SolAtVertices", solution.number_of_vertices());
  out.integer(1).integer(solution.components == 1 ? 1 : 3).end_line();
  const auto components = std::size_t(solution.components);
  for (std::size_t i = 0; i < solution.values.size(); ++i) {
    out.real(solution.values[i]);
    if ((i + 1) % components == 0) out.end_line();
  }
  return out.finish();
}

/// Writes a `.mesh` file. \throws Io_error
inline void write_medit_mesh(const std::string& file, const Medit_mesh& mesh)
{
  internal::write_text(file, print_medit_mesh(mesh));
}

/// Writes a `.sol` file. \throws Io_error
inline void write_medit_solution(const std::string& file, const Medit_solution& solution)
{
  internal::write_text(file, print_medit_solution(solution));
}

/// Builds the empty face graph `mesh` from the triangles of `medit`: oriented consistently, without the points that
/// no triangle uses. Ridges and required edges are marked in `edge_is_constrained`, corners and required vertices in
/// `vertex_is_constrained`; the other values of both maps are not touched.
///
/// Returns the vertex of each point, or `null_vertex()` for a point that no triangle uses.
/// \throws Invalid_input_error if the triangles are not an orientable 2-manifold, or if a mark is not on it
template <class TriangleMesh, class EdgeIsConstrainedMap, class VertexIsConstrainedMap>
auto medit_to_triangle_mesh(const Medit_mesh& medit, TriangleMesh& mesh, EdgeIsConstrainedMap edge_is_constrained,
                            VertexIsConstrainedMap vertex_is_constrained)
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Point =
    typename boost::property_traits<typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::type>::value_type;
  std::vector<Point> points;
  points.reserve(medit.points.size());
  for (const auto& p : medit.points) points.emplace_back(p[0], p[1], p[2]);
  auto vertex_of_point = triangle_soup_to_triangle_mesh(std::move(points), medit.triangles, mesh);

  const auto mark_edges = [&](const Medit_mesh::Indices& edges) {
    for (const std::uint32_t e : edges) {
      const auto source = vertex_of_point[medit.edges[e][0]];
      const auto target = vertex_of_point[medit.edges[e][1]];
      const bool on_surface = source != Graph_traits::null_vertex() && target != Graph_traits::null_vertex();
      const auto found =
        on_surface ? halfedge(source, target, mesh) : std::make_pair(Graph_traits::null_halfedge(), false);
      if (!found.second) throw Invalid_input_error("a constrained edge is not an edge of a triangle", "edge", e);
      put(edge_is_constrained, edge(found.first, mesh), true);
    }
  };
  mark_edges(medit.ridges);
  mark_edges(medit.required_edges);

  const auto mark_vertices = [&](const Medit_mesh::Indices& vertices) {
    for (const std::uint32_t v : vertices) {
      if (vertex_of_point[v] == Graph_traits::null_vertex())
        throw Invalid_input_error("a constrained vertex is not a vertex of a triangle", "vertex", v);
      put(vertex_is_constrained, vertex_of_point[v], true);
    }
  };
  mark_vertices(medit.corners);
  mark_vertices(medit.required_vertices);
  return vertex_of_point;
}

/// The vertices and faces of `mesh` in their order, its constrained edges as ridges, its constrained vertices as
/// corners; all references are 0.
template <class TriangleMesh, class EdgeIsConstrainedMap, class VertexIsConstrainedMap>
Medit_mesh triangle_mesh_to_medit(const TriangleMesh& mesh, EdgeIsConstrainedMap edge_is_constrained,
                                  VertexIsConstrainedMap vertex_is_constrained)
{
  Medit_mesh medit;
  const auto point = get(CGAL::vertex_point, mesh);
  const auto index = get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh);
  for (const auto v : vertices(mesh)) {
    const auto i = std::uint32_t(medit.points.size());
    put(index, v, i);
    const auto& p = get(point, v);
    medit.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    if (get(vertex_is_constrained, v)) medit.corners.push_back(i);
  }
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh); // target first, as in CGAL's files
    medit.triangles.push_back(
      {get(index, target(h, mesh)), get(index, target(next(h, mesh), mesh)), get(index, source(h, mesh))});
  }
  for (const auto e : edges(mesh))
    if (get(edge_is_constrained, e)) {
      medit.ridges.push_back(std::uint32_t(medit.edges.size()));
      medit.edges.push_back({get(index, source(e, mesh)), get(index, target(e, mesh))});
    }
  medit.point_references.assign(medit.points.size(), 0);
  medit.triangle_references.assign(medit.triangles.size(), 0);
  medit.edge_references.assign(medit.edges.size(), 0);
  return medit;
}

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writing meshes with all that they carry: ply with columns, off with colours, obj with groups, materials and texture
// coordinates, stl with named solids.

#ifndef ADAPT_MESH_MESH_WRITERS_H
#define ADAPT_MESH_MESH_WRITERS_H

#include "mesh_files.h"

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace adapt_mesh {

namespace internal {

using Vector = CGAL::Exact_predicates_inexact_constructions_kernel::Vector_3;

/// The normals at the vertices, if the input had some.
class Output_normals
{
public:
  explicit Output_normals(const Constrained_mesh& m)
  {
    if (!m.has_normals) return;
    normals_.resize(m.mesh.number_of_vertices());
    for (const Vertex v : m.mesh.vertices())
      normals_[v] = CGAL::Polygon_mesh_processing::compute_vertex_normal(v, m.mesh);
  }

  bool exist() const { return !normals_.empty(); }
  const Vector& operator[](Vertex v) const { return normals_[v]; }

private:
  std::vector<Vector> normals_;
};

/// Text and binary numbers, collected and written in large pieces.
class Output_buffer
{
public:
  explicit Output_buffer(std::ostream& out) : out_(out) {}
  Output_buffer(const Output_buffer&) = delete;
  Output_buffer& operator=(const Output_buffer&) = delete;
  ~Output_buffer() { flush(); }

  Output_buffer& operator<<(std::string_view text)
  {
    buffer_ += text;
    if (buffer_.size() > enough) flush();
    return *this;
  }

  /// The shortest text that gives the same number.
  Output_buffer& operator<<(double x) { return number(x); }
  Output_buffer& operator<<(std::size_t n) { return number(n); }
  Output_buffer& operator<<(std::uint32_t n) { return number(n); }

  template <class T>
  void binary(T x)
  {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &x, sizeof(T));
    buffer_.append(bytes.data(), bytes.size());
    if (buffer_.size() > enough) flush();
  }

  /// A value of a column, rounded to what its type can hold.
  void binary(double x, const Number_type& type)
  {
    if (type.kind == 'f') return type.size == 4 ? binary(float(x)) : binary(x);
    if (type.kind == 'u') return integer<std::uint8_t, std::uint16_t, std::uint32_t>(x, type.size);
    integer<std::int8_t, std::int16_t, std::int32_t>(x, type.size);
  }

private:
  static constexpr std::size_t enough = 1 << 20;

  template <class Number>
  Output_buffer& number(Number x)
  {
    std::array<char, 32> text;
    const char* const end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
    return *this << std::string_view(text.data(), std::size_t(end - text.data()));
  }

  template <class One, class Two, class Four>
  void integer(double x, std::size_t size)
  {
    if (size == 1) binary(rounded<One>(x));
    else if (size == 2) binary(rounded<Two>(x));
    else binary(rounded<Four>(x));
  }

  template <class T>
  static T rounded(double x)
  {
    return T(std::clamp(std::round(x), double((std::numeric_limits<T>::min)()), double((std::numeric_limits<T>::max)())));
  }

  void flush()
  {
    out_.write(buffer_.data(), std::streamsize(buffer_.size()));
    buffer_.clear();
  }

  std::ostream& out_;
  std::string buffer_;
};

inline std::string ply_type(const Number_type& t)
{
  if (t.kind == 'f') return t.size == 4 ? "float" : "double";
  const std::string name = t.size == 1 ? "char" : t.size == 2 ? "short" : "int";
  return (t.kind == 'u' ? "u" : "") + name;
}

} // namespace internal

namespace internal {

inline std::string ply_properties(const char* type, std::initializer_list<const char*> names)
{
  std::string lines;
  for (const char* name : names) lines += std::string("property ") + type + " " + name + "\n";
  return lines;
}

template <class Element>
std::string ply_properties(const std::vector<Attribute<Element>>& attributes)
{
  std::string lines;
  for (const auto& a : attributes) lines += "property " + ply_type(a.type) + " " + a.name + "\n";
  return lines;
}

inline void write_ply_header(Output_buffer& out, const Constrained_mesh& m)
{
  const std::uint16_t one = 1;
  const bool is_little = *reinterpret_cast<const char*>(&one) == 1;
  out << "ply\nformat binary_" + std::string(is_little ? "little" : "big") + "_endian 1.0\n";
  out << "element vertex " << m.mesh.number_of_vertices() << "\n" + ply_properties("double", {"x", "y", "z"});
  if (m.has_normals) out << ply_properties("double", {"nx", "ny", "nz"});
  out << ply_properties(m.at_vertices) << "element face " << m.mesh.number_of_faces() << "\n";
  out << ply_properties("list uchar int", {"vertex_indices"}) << ply_properties(m.at_faces);
  if (m.has_labels) out << ply_properties("int", {"label"});
  if (!m.at_corners.empty()) out << ply_properties("list uchar double", {"texcoord"});
  out << "end_header\n";
}

inline void write_ply_face(Output_buffer& out, const Constrained_mesh& m, Face f)
{
  out.binary(std::uint8_t(3));
  for (const Vertex v : m.mesh.vertices_around_face(m.mesh.halfedge(f))) out.binary(std::int32_t(v));
  for (const auto& a : m.at_faces) out.binary(a.map[f], a.type);
  if (m.has_labels) out.binary(std::int32_t(m.label[f]));
  if (m.at_corners.empty()) return;
  out.binary(std::uint8_t(3 * m.at_corners.size()));
  for (const Halfedge h : m.mesh.halfedges_around_face(m.mesh.halfedge(f)))
    for (const auto& a : m.at_corners) out.binary(a.map[h]);
}

} // namespace internal

/// Binary, of the byte order of the machine. Labels are the column `label`.
inline void write_ply(std::ostream& stream, const Constrained_mesh& m)
{
  const internal::Output_normals normals(m);
  internal::Output_buffer out(stream);
  internal::write_ply_header(out, m);
  for (const Vertex v : m.mesh.vertices()) {
    const Point& p = m.mesh.point(v);
    for (int i = 0; i < 3; ++i) out.binary(p[i]);
    for (int i = 0; normals.exist() && i < 3; ++i) out.binary(normals[v][i]);
    for (const auto& a : m.at_vertices) out.binary(a.map[v], a.type);
  }
  for (const Face f : m.mesh.faces()) internal::write_ply_face(out, m, f);
}

namespace internal {

/// The attributes that make a colour: red, green, blue and, if there is one, alpha; none if one of the three is missing.
template <class Element>
std::vector<Attribute<Element>> colour_of(const std::vector<Attribute<Element>>& attributes)
{
  std::vector<Attribute<Element>> colour;
  for (const char* name : {"red", "green", "blue", "alpha"})
    for (const Attribute<Element>& a : attributes)
      if (a.name == name) colour.push_back(a);
  if (colour.size() < 3 || colour[2].name != "blue") colour.clear();
  return colour;
}

template <class Element>
void write_colour(Output_buffer& out, const std::vector<Attribute<Element>>& colour, Element e)
{
  for (const Attribute<Element>& a : colour)
    if (a.type.kind == 'f') out << " " << a.map[e];
    else out << " " << std::size_t((std::max)(0.0, std::round(a.map[e])));
}

} // namespace internal

inline void write_off(std::ostream& stream, const Constrained_mesh& m)
{
  const Mesh& mesh = m.mesh;
  const internal::Output_normals normals(m);
  const auto of_vertices = internal::colour_of(m.at_vertices);
  const auto of_faces = internal::colour_of(m.at_faces);
  internal::Output_buffer out(stream);
  out << std::string(of_vertices.empty() ? "" : "C") + (normals.exist() ? "N" : "") + "OFF\n"
      << mesh.number_of_vertices() << " " << mesh.number_of_faces() << " 0\n\n";
  for (const Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    out << p[0] << " " << p[1] << " " << p[2];
    if (normals.exist()) out << " " << normals[v][0] << " " << normals[v][1] << " " << normals[v][2];
    internal::write_colour(out, of_vertices, v);
    out << "\n";
  }
  for (const Face f : mesh.faces()) {
    out << "3 ";
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) out << " " << std::size_t(v);
    internal::write_colour(out, of_faces, f);
    out << "\n";
  }
}

namespace internal {

/// The faces by their labels.
inline std::vector<Face> faces_by_label(const Constrained_mesh& m)
{
  std::vector<Face> faces(m.mesh.faces().begin(), m.mesh.faces().end());
  std::stable_sort(faces.begin(), faces.end(), [&](Face f, Face g) { return m.label[f] < m.label[g]; });
  return faces;
}

/// The name of a label; a number if it has none.
inline Label name_of(const Constrained_mesh& m, int label)
{
  if (std::size_t(label) < m.names.size() && label >= 0) return m.names[std::size_t(label)];
  return {"", "label_" + std::to_string(label), ""};
}

/// Numbers texture coordinates, those that are alike at a vertex once.
class Texture_numbers
{
public:
  explicit Texture_numbers(const Constrained_mesh& m) : m_(m)
  {
    for (const Face f : m.mesh.faces())
      for (const Halfedge h : m.mesh.halfedges_around_face(m.mesh.halfedge(f))) number(h);
  }

  std::size_t operator[](Halfedge h) const { return number_.at(key(h)); }
  const std::vector<std::array<double, 2>>& list() const { return list_; }

private:
  using Key = std::pair<Vertex, std::array<double, 2>>;

  Key key(Halfedge h) const { return {m_.mesh.target(h), {m_.at_corners[0].map[h], m_.at_corners[1].map[h]}}; }

  void number(Halfedge h)
  {
    if (number_.emplace(key(h), list_.size() + 1).second) list_.push_back(key(h).second);
  }

  const Constrained_mesh& m_;
  std::map<Key, std::size_t> number_;
  std::vector<std::array<double, 2>> list_;
};

/// A line of three numbers after a keyword.
template <class Triple>
void write_row(Output_buffer& out, const char* keyword, const Triple& x)
{
  out << keyword << " " << x[0] << " " << x[1] << " " << x[2] << "\n";
}

/// The lines by which obj files name what follows, as far as it changes.
inline void write_label(Output_buffer& out, const Label& label, const Label& before)
{
  if (label.object != before.object) out << "o " + label.object + "\n";
  if (label.group != before.group) out << "g " + label.group + "\n";
  if (label.material != before.material) out << "usemtl " + label.material + "\n";
}

} // namespace internal

inline void write_obj(std::ostream& stream, const Constrained_mesh& m)
{
  const internal::Output_normals normals(m);
  std::optional<internal::Texture_numbers> texture;
  if (!m.at_corners.empty()) texture.emplace(m);
  internal::Output_buffer out(stream);
  if (!m.material_library.empty()) out << "mtllib " + m.material_library + "\n";
  for (const Vertex v : m.mesh.vertices()) internal::write_row(out, "v", m.mesh.point(v));
  if (texture)
    for (const auto& uv : texture->list()) out << "vt " << uv[0] << " " << uv[1] << "\n";
  for (const Vertex v : m.mesh.vertices())
    if (normals.exist()) internal::write_row(out, "vn", normals[v]);
  Label before;
  for (const Face f : internal::faces_by_label(m)) {
    const Label label = m.has_labels ? internal::name_of(m, m.label[f]) : before;
    internal::write_label(out, label, before);
    before = label;
    out << "f";
    for (const Halfedge h : m.mesh.halfedges_around_face(m.mesh.halfedge(f))) {
      const std::size_t v = std::size_t(m.mesh.target(h)) + 1;
      out << " " << v;
      if (texture || normals.exist()) out << "/";
      if (texture) out << (*texture)[h];
      if (normals.exist()) out << "/" << v;
    }
    out << "\n";
  }
}

/// Binary, in single precision.
inline void write_stl_binary(std::ostream& stream, const Constrained_mesh& m)
{
  internal::Output_buffer out(stream);
  const auto write_triple = [&](const auto& x) {
    for (int i = 0; i < 3; ++i) out.binary(float(x[i]));
  };
  out << std::string(80, ' '); // the header
  out.binary(std::uint32_t(m.mesh.number_of_faces()));
  for (const Face f : m.mesh.faces()) {
    write_triple(CGAL::Polygon_mesh_processing::compute_face_normal(f, m.mesh));
    for (const Vertex v : m.mesh.vertices_around_face(m.mesh.halfedge(f))) write_triple(m.mesh.point(v));
    out.binary(std::uint16_t(0));
  }
}

/// As text, a solid for each label.
inline void write_stl_text(std::ostream& stream, const Constrained_mesh& m)
{
  internal::Output_buffer out(stream);
  const auto name = [&](int label) {
    const Label l = internal::name_of(m, label);
    return !m.has_labels ? std::string() : !l.group.empty() ? l.group : !l.object.empty() ? l.object : l.material;
  };
  std::optional<int> open;
  const auto end = [&] { out << "endsolid " + name(*open) + "\n"; };
  for (const Face f : internal::faces_by_label(m)) {
    if (!open || *open != m.label[f]) {
      if (open) end();
      open = m.label[f];
      out << "solid " + name(*open) + "\n";
    }
    const internal::Vector n = CGAL::Polygon_mesh_processing::compute_face_normal(f, m.mesh);
    out << "facet normal " << n[0] << " " << n[1] << " " << n[2] << "\nouter loop\n";
    for (const Vertex v : m.mesh.vertices_around_face(m.mesh.halfedge(f))) {
      const Point& p = m.mesh.point(v);
      out << "vertex " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
    out << "endloop\nendfacet\n";
  }
  if (open) end();
}

/// Names of what a file of `format` cannot hold.
inline std::vector<std::string> left_out(const std::string& format, const Constrained_mesh& m)
{
  std::vector<std::string> lost;
  const auto add_columns = [&](const auto& attributes, const char* of) {
    const bool holds_colours = format == "off" && !internal::colour_of(attributes).empty();
    for (const auto& a : attributes) {
      const bool is_colour = a.name == "red" || a.name == "green" || a.name == "blue" || a.name == "alpha";
      if (format != "ply" && !(holds_colours && is_colour)) lost.push_back(a.name + of);
    }
  };
  add_columns(m.at_vertices, " of the vertices");
  add_columns(m.at_faces, " of the faces");
  const bool is_medit = format == "mesh" || format == "meshb";
  if (m.has_labels && format == "off") lost.push_back("the labels of the faces");
  if (!m.at_corners.empty() && format != "obj" && format != "ply") lost.push_back("texture coordinates");
  if (m.has_normals && (is_medit || format == "stl")) lost.push_back("normals");
  if (m.medit != nullptr && !is_medit && (!m.medit->required_edges.empty() || !m.medit->referenced_edges.empty()))
    lost.push_back("references of edges and what is required");
  return lost;
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_MESH_WRITERS_H

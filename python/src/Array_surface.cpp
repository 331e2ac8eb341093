// SPDX-License-Identifier: GPL-3.0-or-later

#include "Array_surface.h"

#include "Direct_view.h"

#include <CGAL/Surface_mesh_adaptation/IO/repair.h>
#include <CGAL/Surface_mesh_adaptation/IO/triangle_soup.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>

#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace sma_python {

namespace {

std::vector<Point> points_of(const Array_view<double>& array)
{
  std::vector<Point> points;
  points.reserve(array.rows);
  for (std::size_t i = 0; i < array.rows; ++i) {
    const double* const p = array.row(i);
    points.emplace_back(p[0], p[1], p[2]);
  }
  return points;
}

/// Indices of points that do not exist become one that does not exist either.
SMA::Triangle_soup triangles_of(const Surface_arrays& input)
{
  constexpr std::uint32_t none = (std::numeric_limits<std::uint32_t>::max)();
  SMA::Triangle_soup triangles(input.triangles.rows());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::int64_t v = input.triangles.at(i, j);
      triangles[i][j] = v >= 0 && std::size_t(v) < input.points.rows ? std::uint32_t(v) : none;
    }
  return triangles;
}

std::string joined(const std::vector<std::string>& sentences)
{
  std::string text;
  for (const std::string& s : sentences) text += (text.empty() ? "" : "; ") + s;
  return text;
}

} // namespace

Array_surface::Array_surface(const Surface_arrays& input)
{
  build(input);
  edge_is_constrained = mesh.add_property_map<Edge, bool>("e:constrained", false).first;
  edge_is_protected = mesh.add_property_map<Edge, bool>("e:protected", false).first;
  vertex_is_constrained = mesh.add_property_map<Vertex, bool>("v:constrained", false).first;
  label = mesh.add_property_map<Face, int>("f:label", 0).first;
  size_bounds = mesh.add_property_map<Face, std::pair<double, double>>("f:size_bounds", {0, 0}).first;
  constrain(input);
  read_faces(input);
  read_corners(input);
}

void Array_surface::build(const Surface_arrays& input)
{
  if (input.triangles.rows() == 0) throw SMA::Empty_mesh_error();
  if (!input.weld && !input.repair && build_directly(input)) return;
  if (input.weld || input.repair) {
    const SMA::Repair_report report = SMA::repair_polygon_soup_to_triangle_mesh(
      points_of(input.points), triangles_of(input), mesh, {input.weld, input.repair});
    if (!input.repair && !report.is_valid()) throw SMA::Adaptation_error(joined(report.offences()));
    point_of_vertex = report.point_of_vertex;
    triangle_of_face = report.polygon_of_face;
    repairs = report.repairs();
    warnings = report.warnings();
    return;
  }
  const auto vertex_of_point = SMA::triangle_soup_to_triangle_mesh(points_of(input.points), triangles_of(input), mesh);
  point_of_vertex.resize(mesh.number_of_vertices());
  for (std::size_t i = 0; i < vertex_of_point.size(); ++i)
    if (vertex_of_point[i] != Mesh::null_vertex()) point_of_vertex[vertex_of_point[i]] = i;
  number_faces();
}

void Array_surface::number_faces()
{
  triangle_of_face.resize(mesh.number_of_faces());
  std::iota(triangle_of_face.begin(), triangle_of_face.end(), std::size_t(0));
}

/// Returns whether that can be done.
bool Array_surface::build_directly(const Surface_arrays& input)
{
  const auto view = Direct_view(input).make();
  if (!view) return false;
  input.poll();
  SMA::internal::write_connectivity(SMA::Sequential_execution(), *view, mesh);
  for (const Vertex v : mesh.vertices()) {
    const double* const p = input.points.row(v);
    mesh.point(v) = Point(p[0], p[1], p[2]);
  }
  point_of_vertex.resize(input.points.rows);
  std::iota(point_of_vertex.begin(), point_of_vertex.end(), std::size_t(0));
  number_faces();
  return true;
}

void Array_surface::constrain(const Surface_arrays& input)
{
  if (!input.constrained_vertices.empty())
    for (const Vertex v : mesh.vertices())
      vertex_is_constrained[v] = input.constrained_vertices.data[point_of_vertex[v]] != 0;
  mark_edges(input, input.constrained_edges, "a constrained edge is no edge of a triangle", edge_is_constrained);
  mark_edges(input, input.protected_edges, "a protected edge is no edge of a triangle", edge_is_protected);
}

/// \throws Invalid_input_error with `what` if a pair is no edge
void Array_surface::mark_edges(const Surface_arrays& input, const Index_view& edges, const char* what,
                               Mesh::Property_map<Edge, bool> marks)
{
  if (edges.rows() == 0) return;
  std::vector<Vertex> vertex_of_point(input.points.rows, Mesh::null_vertex());
  for (const Vertex v : mesh.vertices()) vertex_of_point[point_of_vertex[v]] = v;
  const auto vertex = [&](std::int64_t i) {
    return i >= 0 && std::size_t(i) < vertex_of_point.size() ? vertex_of_point[std::size_t(i)] : Mesh::null_vertex();
  };
  for (std::size_t i = 0; i < edges.rows(); ++i) {
    const Vertex v = vertex(edges.at(i, 0)), w = vertex(edges.at(i, 1));
    const bool exist = v != Mesh::null_vertex() && w != Mesh::null_vertex();
    const auto h = exist ? mesh.halfedge(v, w) : Mesh::null_halfedge();
    if (h == Mesh::null_halfedge()) throw SMA::Invalid_input_error(what, "edge", i);
    marks[mesh.edge(h)] = true;
  }
}

/// What is given for triangles. Faces that a repair has added have none of it.
void Array_surface::read_faces(const Surface_arrays& input)
{
  for (const Face f : mesh.faces()) {
    const std::size_t t = triangle_of_face[f];
    if (t == SMA::Repair_report::none) continue;
    if (!input.labels.empty()) label[f] = input.labels.data[t];
    if (!input.size_bounds.empty()) size_bounds[f] = {input.size_bounds.row(t)[0], input.size_bounds.row(t)[1]};
    if (input.protected_faces.empty() || input.protected_faces.data[t] == 0) continue;
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) edge_is_protected[mesh.edge(h)] = true;
  }
}

void Array_surface::read_corners(const Surface_arrays& input)
{
  const std::size_t n = input.corner_values.columns / 3;
  for (std::size_t k = 0; k < n && !input.corner_values.empty(); ++k)
    at_corners.push_back(mesh.add_property_map<Halfedge, double>("h:" + std::to_string(k), 0).first);
  for (const Face f : mesh.faces()) {
    const std::size_t t = triangle_of_face[f];
    if (at_corners.empty() || t == SMA::Repair_report::none) continue;
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      for (std::size_t c = 0; c < 3; ++c)
        if (std::size_t(input.triangles.at(t, c)) == point_of_vertex[mesh.target(h)])
          for (std::size_t k = 0; k < n; ++k) at_corners[k][h] = input.corner_values.row(t)[n * c + k];
  }
}

} // namespace sma_python

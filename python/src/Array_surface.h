// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SMA_PYTHON_ARRAY_SURFACE_H
#define SMA_PYTHON_ARRAY_SURFACE_H

#include "adaptation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_adaptation/IO/Repair_report.h>
#include <CGAL/Surface_mesh_adaptation/metric/Metric_tensor_3.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sma_python {

namespace SMA = CGAL::Surface_mesh_adaptation;

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Edge = Mesh::Edge_index;
using Halfedge = Mesh::Halfedge_index;
using Face = Mesh::Face_index;

/// A mesh made of arrays, with its constraints.
struct Array_surface
{
  Mesh mesh;
  Mesh::Property_map<Edge, bool> edge_is_constrained;
  Mesh::Property_map<Edge, bool> edge_is_protected;
  Mesh::Property_map<Vertex, bool> vertex_is_constrained;
  Mesh::Property_map<Face, int> label;
  Mesh::Property_map<Face, std::pair<double, double>> size_bounds;
  std::vector<Mesh::Property_map<Halfedge, double>> at_corners; ///< each at the halfedge that arrives
  std::vector<std::size_t> point_of_vertex;
  std::vector<std::size_t> triangle_of_face;
  std::vector<std::string> repairs, warnings; ///< what was done to the input, one sentence each

  /// \throws Adaptation_error
  explicit Array_surface(const Surface_arrays&);
  Array_surface(const Array_surface&) = delete; // the maps belong to the mesh
  Array_surface& operator=(const Array_surface&) = delete;

private:
  void build(const Surface_arrays&);
  bool build_directly(const Surface_arrays&);
  void number_faces();
  void constrain(const Surface_arrays&);
  void mark_edges(const Surface_arrays&, const Index_view& edges, const char* kind, Mesh::Property_map<Edge, bool>);
  void read_faces(const Surface_arrays&);
  void read_corners(const Surface_arrays&);
};

/// The tensor in nine numbers.
inline SMA::Metric_tensor_3 tensor_of(const double* m) { return {m[0], m[3], m[4], m[6], m[7], m[8]}; }

inline void append(std::vector<double>& values, const SMA::Metric_tensor_3& m)
{
  values.insert(values.end(), {m[0], m[1], m[3], m[1], m[2], m[4], m[3], m[4], m[5]});
}

} // namespace sma_python

#endif // SMA_PYTHON_ARRAY_SURFACE_H

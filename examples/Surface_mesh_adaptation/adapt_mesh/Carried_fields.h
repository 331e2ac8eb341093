// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields of a `.sol` file that are carried from the vertices of the input to those of the output.

#ifndef ADAPT_MESH_CARRIED_FIELDS_H
#define ADAPT_MESH_CARRIED_FIELDS_H

#include "Bad_input.h"
#include "mesh_files.h"
#include "options.h"

#include <CGAL/Surface_mesh_adaptation/IO/MEDIT.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>

#include <cstddef>
#include <string>
#include <vector>

namespace adapt_mesh {

/// Each component is a map of its own.
class Carried_fields
{
public:
  Carried_fields(const Options& options, Constrained_mesh& mesh)
  {
    if (options.attributes.empty()) return;
    reading(options.attributes, [&] {
      for (const SMA::Medit_field& field : SMA::read_medit_solution(options.attributes)) add(field, options, mesh);
    });
  }

  const std::vector<Mesh::Property_map<Vertex, double>>& maps() const { return maps_; }

  /// Writes them at the vertices in the order of `mesh`. \throws Io_error
  void write(const std::string& file, const Mesh& mesh) const
  {
    SMA::Medit_solution solution;
    std::size_t first = 0;
    for (const int components : components_) {
      solution.push_back({components, {}});
      for (const Vertex v : mesh.vertices())
        for (std::size_t i = 0; i < std::size_t(components); ++i) solution.back().values.push_back(maps_[first + i][v]);
      first += std::size_t(components);
    }
    SMA::write_medit_solution(file, solution);
  }

private:
  void add(const SMA::Medit_field& field, const Options& options, Constrained_mesh& mesh)
  {
    const std::size_t n = std::size_t(field.components);
    if (field.number_of_vertices() != mesh.vertex_of_point.size())
      throw SMA::Io_error(options.attributes, 0,
                          "there are values for " + std::to_string(field.number_of_vertices()) +
                            " vertices, but the mesh has " + std::to_string(mesh.vertex_of_point.size()));
    components_.push_back(field.components);
    for (std::size_t i = 0; i < n; ++i) {
      auto map = mesh.mesh.add_property_map<Vertex, double>("v:field:" + std::to_string(maps_.size()), 0).first;
      for (std::size_t p = 0; p < mesh.vertex_of_point.size(); ++p)
        if (mesh.vertex_of_point[p] != Mesh::null_vertex()) map[mesh.vertex_of_point[p]] = field.values[n * p + i];
      for (const auto& [copy, original] : mesh.copies) map[copy] = map[original];
      maps_.push_back(map);
    }
  }

  std::vector<int> components_;
  std::vector<Mesh::Property_map<Vertex, double>> maps_;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_CARRIED_FIELDS_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What was wrong with a polygon soup, and what was done about it, in numbers and in sentences.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_REPAIR_REPORT_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_REPAIR_REPORT_H

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationFiles
/// @{

/// How many elements of an input have a defect, and where the first one is.
struct Soup_defect
{
  std::size_t count = 0;  ///< how many have it
  std::string first; ///< as "face 12", counted from 0 as the input lists its elements; empty if there is none

  /// The `index`-th of its kind.
  void add(const char* kind, std::size_t index)
  {
    if (count++ == 0) first = kind + (" " + std::to_string(index));
  }

  /// The same for an edge between two vertices.
  void add_edge(std::size_t source, std::size_t target)
  {
    if (count++ == 0) first = "between the vertices " + std::to_string(source) + " and " + std::to_string(target);
  }
};

/// What `repair_polygon_soup_to_triangle_mesh()` found and did.
struct Repair_report
{
  // what makes an input unusable as it is, and what was done with it
  Soup_defect non_finite_points;      ///< a coordinate is NaN or infinite: their faces were left out
  Soup_defect invalid_faces;          ///< with a vertex that does not exist: left out
  Soup_defect small_faces;            ///< with fewer than three corners: left out
  Soup_defect repeating_faces;        ///< with the same vertex twice: divided there, parts below three corners left out
  Soup_defect duplicate_faces;        ///< with the same corners as an earlier one: left out
  Soup_defect non_manifold_edges;     ///< with more than two faces: cut apart
  Soup_defect non_manifold_vertices;  ///< faces form several fans, or cannot be oriented alike: cut apart

  // what can be used
  Soup_defect polygons;               ///< faces with more than three corners: triangulated
  Soup_defect isolated_points;        ///< without a face: left out
  Soup_defect welded_points;          ///< joined with an earlier one at the same place, as edges match then
  Soup_defect open_seams;             ///< edges at the same place as another that could not be joined to it
  Soup_defect turned_faces;           ///< look the other way in the result
  std::size_t turned_components = 0;  ///< that have such faces
  Soup_defect degenerate_faces;       ///< without area, found once all else was done
  std::size_t removed_degenerate_faces = 0;  ///< of these

  // where the result comes from
  std::vector<std::size_t> point_of_vertex; ///< the index of the point of each vertex, in the order of the mesh
  std::vector<std::size_t> polygon_of_face; ///< the index of the polygon of each face, in the order of the mesh; `none`
                                            ///< for a face that came where some without area were removed
  static constexpr std::size_t none = std::size_t(-1);  ///< no polygon

  /// Whether the input can be used as it is.
  bool is_valid() const { return offences().empty(); }

  /// A sentence for each kind of defect that makes the input unusable as it is.
  std::vector<std::string> offences() const;

  /// A sentence for each kind of repair.
  std::vector<std::string> repairs() const;

  /// A sentence for each kind of change that an input needs not be invalid for, and for each defect that is left.
  std::vector<std::string> warnings() const;
};

namespace internal {

/// One kind of defect, in words.
struct Described_defect
{
  const Soup_defect& defect;
  const char* one;  ///< what follows "1 "
  const char* many; ///< what follows any other number
  const char* deed; ///< what was done

  std::string problem() const
  {
    return std::to_string(defect.count) + " " + (defect.count == 1 ? one : many) + " (first: " + defect.first + ")";
  }
  std::string repair() const { return problem() + ": " + deed; }
};

inline std::vector<Described_defect> described_offences(const Repair_report& r)
{
  return {
    {r.non_finite_points, "vertex has a coordinate that is not finite", "vertices have a coordinate that is not finite",
     "left out, with their faces"},
    {r.invalid_faces, "face has a vertex that does not exist", "faces have a vertex that does not exist", "left out"},
    {r.small_faces, "face has fewer than three corners", "faces have fewer than three corners", "left out"},
    {r.repeating_faces, "face has the same vertex twice", "faces have the same vertex twice",
     "divided there or left out"},
    {r.duplicate_faces, "face has the same corners as another", "faces have the same corners as another", "left out"},
    {r.non_manifold_edges, "edge has more than two faces", "edges have more than two faces", "cut apart"},
    {r.non_manifold_vertices, "vertex has faces that form no single fan or cannot be oriented alike",
     "vertices have faces that form no single fan or cannot be oriented alike", "cut apart"},
  };
}

inline std::vector<Described_defect> described_changes(const Repair_report& r)
{
  return {
    {r.polygons, "face has more than three corners", "faces have more than three corners", "triangulated"},
    {r.isolated_points, "vertex has no face", "vertices have no face", "left out"},
    {r.welded_points, "vertex is at the place of another along a seam",
     "vertices are at the places of others along seams", "welded"},
  };
}

inline std::string turned(const Repair_report& r)
{
  const Described_defect faces = {r.turned_faces, "face looked the wrong way", "faces looked the wrong way",
                                  "turned over"};
  const std::string components =
    r.turned_components == 1 ? ", in 1 component" : ", in " + std::to_string(r.turned_components) + " components";
  return faces.repair() + components;
}

inline std::string open(const Repair_report& r)
{
  return Described_defect{r.open_seams, "edge is at the place of others and was not joined to them",
                          "edges are at the places of others and were not joined to them", ""}
    .problem();
}

inline std::string degenerate(const Repair_report& r)
{
  return Described_defect{r.degenerate_faces, "face has no area", "faces have no area", "removed"}.problem();
}

} // namespace internal

inline std::vector<std::string> Repair_report::offences() const
{
  std::vector<std::string> sentences;
  for (const auto& d : internal::described_offences(*this))
    if (d.defect.count > 0) sentences.push_back(d.problem());
  return sentences;
}

inline std::vector<std::string> Repair_report::repairs() const
{
  std::vector<std::string> sentences;
  for (const auto& d : internal::described_offences(*this))
    if (d.defect.count > 0) sentences.push_back(d.repair());
  if (removed_degenerate_faces > 0)
    sentences.push_back(internal::degenerate(*this) + ": " + std::to_string(removed_degenerate_faces) + " removed");
  return sentences;
}

inline std::vector<std::string> Repair_report::warnings() const
{
  std::vector<std::string> sentences;
  for (const auto& d : internal::described_changes(*this))
    if (d.defect.count > 0) sentences.push_back(d.repair());
  if (open_seams.count > 0) sentences.push_back(internal::open(*this));
  if (turned_faces.count > 0) sentences.push_back(internal::turned(*this));
  if (degenerate_faces.count > removed_degenerate_faces)
    sentences.push_back(internal::degenerate(*this) + (removed_degenerate_faces > 0 ? ": some are left" : ""));
  return sentences;
}

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_REPAIR_REPORT_H

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers that stand for keywords in the binary form.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_BINARY_KEYWORDS_H
#define CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_BINARY_KEYWORDS_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace CGAL {
namespace Surface_mesh_adaptation {
namespace internal {

using Medit_keyword = std::pair<std::int32_t, const char*>;

/// Those that are read or written here, and those that are common in files of surfaces.
// clang-format off
constexpr std::array<Medit_keyword, 29> medit_keywords = {{
  {3, "Dimension"}, {4, "Vertices"}, {5, "Edges"}, {6, "Triangles"}, {7, "Quadrilaterals"}, {8, "Tetrahedra"},
  {9, "Prisms"}, {10, "Hexahedra"}, {13, "Corners"}, {14, "Ridges"}, {15, "RequiredVertices"}, {16, "RequiredEdges"},
  {17, "RequiredTriangles"}, {18, "RequiredQuadrilaterals"}, {19, "TangentAtEdgeVertices"}, {20, "NormalAtVertices"},
  {21, "NormalAtTriangleVertices"}, {22, "NormalAtQuadrilateralVertices"}, {23, "AngleOfCornerBound"}, {49, "Pyramids"},
  {54, "End"}, {59, "Tangents"}, {60, "Normals"}, {61, "TangentAtVertices"}, {62, "SolAtVertices"}, {63, "SolAtEdges"},
  {64, "SolAtTriangles"}, {65, "SolAtQuadrilaterals"}, {66, "SolAtTetrahedra"}}};
// clang-format on

inline std::string medit_keyword(std::int32_t code)
{
  const auto found =
    std::find_if(medit_keywords.begin(), medit_keywords.end(), [&](const Medit_keyword& k) { return k.first == code; });
  return found == medit_keywords.end() ? std::to_string(code) : found->second;
}

/// \pre `keyword` is in the table
inline std::int32_t medit_code(std::string_view keyword)
{
  return std::find_if(medit_keywords.begin(), medit_keywords.end(),
                      [&](const Medit_keyword& k) { return keyword == k.second; })
    ->first;
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_IO_MEDIT_BINARY_KEYWORDS_H

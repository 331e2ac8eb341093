// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgSurfaceMeshAdaptationConcepts
\cgalConcept

The surface between the vertices of the input. A patch depends on its own face only: the points, normals and shape
operators of its corners, and the tangents of the feature curves on its edges. All functions are static, and called
concurrently: of a model that is passed as a parameter, its type alone counts.

A model may have a type `Prepared_patch`, made from a `Patch`, with a member `evaluate(u, v)` that returns what the
static function does: it is made once for many points.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Surface_mesh_adaptation::Flat_reconstruction}
\cgalHasModels{CGAL::Surface_mesh_adaptation::PN_triangle_reconstruction}
\cgalHasModels{CGAL::Surface_mesh_adaptation::Gregory_reconstruction}
\cgalHasModels{CGAL::Surface_mesh_adaptation::Walton_meek_reconstruction}
\cgalHasModelsEnd
*/
class SurfaceReconstruction
{
public:
  /// The point with barycentric coordinates `(1 - u - v, u, v)` on the patch, and its unit normal. Interpolates the
  /// corners; the points of an edge depend on the edge alone, so that neighbouring patches meet. Never NaN for finite
  /// input.
  static Surface_point evaluate(const Patch& patch, double u, double v);

  /// The point at parameter `t` of a feature curve from `a` to `b` with unit tangents `ta` and `tb` there, of either
  /// sign: the same points as those of an edge of a patch with these tangents.
  static Vector_3 evaluate_curve(const Vector_3& a, const Vector_3& b, const Vector_3& ta, const Vector_3& tb,
                                 double t);
};

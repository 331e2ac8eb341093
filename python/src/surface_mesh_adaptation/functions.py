# SPDX-License-Identifier: GPL-3.0-or-later
"""The adaptation, and each of its kernels alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _core
from ._arrays import Array
from ._meshes import Surface, surface_of
from ._request import run_request
from .progress import Follower, ProgressFunction
from .report import Report
from .result import Result, corners_of

#: Sizes (n,), tensors (n, 3, 3) or (n, 6), a function of points (n, 3) that returns them, or the name of an attribute.
Metric = Any


def _add_attributes(surface: Surface, attributes: Mapping[str, Any] | None) -> None:
    for name, values in (attributes or {}).items():
        array = np.asarray(values)
        if array.ndim == 0 or len(array) != len(surface.points):
            raise ValueError(
                f"attributes[{name!r}]: expected as many values as points, {len(surface.points)}, "
                f"not an array of shape {array.shape}"
            )
        surface.attributes[name] = array


def _add_of_faces(
    surface: Surface, name: str, rows: tuple[int, ...], given: Mapping[str, Any] | None, kept: dict[str, Array]
) -> None:
    """Adds attributes of triangles or of their corners."""
    for key, values in (given or {}).items():
        array = np.asarray(values)
        if array.shape[: len(rows)] != rows:
            raise ValueError(f"{name}[{key!r}]: expected an array of shape {rows} or {rows} + (k,), not {array.shape}")
        kept[key] = array


def _report(raw: dict[str, Any], surface: Surface) -> Report:
    report = Report.from_json(raw["report"]) if raw["report"] else Report()
    report.repairs += raw["repairs"]
    report.warnings += raw["warnings"] + surface.warnings
    return report


def _result(raw: dict[str, Any], surface: Surface) -> Result:
    metric = raw["metric"]
    result = Result(
        points=raw["points"],
        triangles=raw["triangles"],
        attributes={},
        metric=metric if metric.any() else None,
        feature_edges=raw["feature_edges"],
        corners=corners_of(raw["points"], raw["feature_edges"], raw["constrained_vertices"]),
        constrained_vertices=raw["constrained_vertices"],
        source_points=raw["source_points"],
        source_weights=raw["source_weights"],
        report=_report(raw, surface),
        operations=raw["operations"],
        normals=raw.get("normals"),
        shape_operators=raw.get("shape_operators"),
        seconds=raw["seconds"],
        protected_edges=raw["protected_edges"],
        vertex_origin=raw["vertex_origin"],
        face_origin=raw["face_origin"] if len(raw["face_origin"]) > 0 else None,
        labels=None if surface.label_names is None else surface.label_names[raw["labels"]],
        corner_attributes=_corners(raw["corner_values"], surface),
        input=surface,
    )
    if surface.face_attributes and result.face_origin is not None:
        result.face_attributes = {name: v[result.face_origin] for name, v in surface.face_attributes.items()}
    result.attributes = {name: result.interpolate(values) for name, values in surface.attributes.items()}
    result.report._result = result
    return result


def _corners(values: Array, surface: Surface) -> dict[str, Array]:
    """The attributes of corners, each in its shape, from all of them side by side."""
    if not surface.corner_attributes:
        return {}
    m, result, at = len(surface.triangles), {}, 0
    width = sum(v.size // (3 * m) for v in surface.corner_attributes.values())
    rows = values.reshape(-1, 3, width)
    for name, given in surface.corner_attributes.items():
        k = given.size // (3 * m)
        result[name] = rows[:, :, at : at + k].reshape((len(rows), 3, *given.shape[2:])).astype(given.dtype if given.dtype.kind == "f" else np.float64)
        at += k
    return result


def _run(
    kernel: str,
    mesh: Any,
    triangles: Any,
    options: dict[str, Any],
    progress: bool | ProgressFunction | None,
    full: bool | None,
) -> Any:
    surface = surface_of(mesh, triangles)
    _add_attributes(surface, options.pop("attributes", None))
    m = len(surface.triangles)
    _add_of_faces(surface, "face_attributes", (m,), options.pop("face_attributes", None), surface.face_attributes)
    corners = options.pop("corner_attributes", None)
    _add_of_faces(surface, "corner_attributes", (m, 3), corners, surface.corner_attributes)
    wants_origin = bool(options.pop("face_origin", False)) or bool(surface.face_attributes)
    request = run_request(surface, options)
    request["wants_face_origin"] = wants_origin
    with Follower(progress) as callback:
        raw = _core.run(kernel, request, callback)
    result = _result(raw, surface)
    as_result = surface.rebuild is None if full is None else full
    return result if as_result else result.mesh


def adapt(
    points: Any,
    triangles: Any = None,
    *,
    size: float | Metric | None = None,
    curvature: float | None = None,
    metric: Metric | None = None,
    field: Metric | None = None,
    vertices: int | None = None,
    anisotropic: bool = False,
    max_anisotropy: float | None = None,
    noisy: bool = False,
    norm: float | None = None,
    gradation: float | None = None,
    hmin: float | None = None,
    hmax: float | None = None,
    feature_angle: float | None = None,
    detect_features: bool = True,
    smooth_borders: bool = False,
    constrained_edges: Any = None,
    constrained_vertices: Any = None,
    protected_edges: Any = None,
    protected_faces: Any = None,
    protected_gradation: float | None = None,
    faces: Any = None,
    labels: Any = None,
    size_bounds: Any = None,
    attributes: Mapping[str, Any] | None = None,
    face_attributes: Mapping[str, Any] | None = None,
    corner_attributes: Mapping[str, Any] | None = None,
    face_origin: bool = False,
    reconstruction: str | None = None,
    fit: bool = False,
    shape_weight: float | None = None,
    normals: Array | None = None,
    shape_operators: Array | None = None,
    tolerance: float | None = None,
    avoid_self_intersections: bool = False,
    count_self_intersections: bool = False,
    max_vertices: int | None = None,
    iterations: int | None = None,
    execution: str | None = None,
    threads: int | None = None,
    weld: bool = False,
    repair: bool = False,
    progress: bool | ProgressFunction | None = None,
    full: bool | None = None,
) -> Any:
    """Adapts a triangulated surface to a metric.

    Rounds of refinement, simplification, swapping and relocation, until the edges have length 1 in the metric and the
    triangles are well shaped in it. The input is not changed, and is read without a copy where it is contiguous and of
    type float64, int32 or int64. The result is the same to the last bit for every `execution` and number of `threads`.

    One of `size`, `curvature`, `metric`, `field`, `vertices` and `tolerance` says how fine the mesh is to be. A
    `metric` (or sizes) or a `field` can be combined with `curvature`: then both are kept.

    Parameters
    ----------
    points : array of shape (n, 3), or pyvista.PolyData, trimesh.Trimesh or meshio.Mesh
        The points, or the whole mesh.
    triangles : array of shape (m, 3) of integers, optional
        The corners of the triangles, if `points` is an array. Points that none uses are left out.
    size : float, array, function or str, optional
        The length of the edges; anything but a number is taken as `metric` is.
    curvature : float, optional
        Sizes from the curvature, which aim at a distance to the surface of this fraction of the diagonal of the
        bounding box.
    metric : array, function or str, optional
        Sizes (n,) or symmetric tensors (n, 3, 3) or (n, 6) as xx xy yy xz yz zz, at the points; or a function that
        returns these for all points (n, 3), which is called once, before the run, with those of the input; or the name
        of an attribute. Of a coarse input, `refine` first what such a function is to see.
    field : array, function or str, optional
        Values (n,) at the points, the error of whose linear interpolation is to be as small as `vertices` allow.
    vertices : int, optional
        The number of vertices to aim at: with sizes from the curvature if nothing else is given.
    anisotropic : bool
        Whether triangles are stretched along the directions in which the surface bends, or the field varies, less.
    max_anisotropy : float, optional
        The largest ratio of the sizes at a point, 1000 by default.
    noisy : bool
        Whether the points are not quite on the surface, as those of scans: smoother, less accurate curvatures.
    norm : float, optional
        The p of the L^p norm in which `field` measures the error, at least 1; 2 by default, may be infinite.
    gradation : float, optional
        The sizes at two points one size apart differ by at most this factor; 1: no bound. By default 1.5, 1.3 for
        isotropic sizes from the curvature alone, and no bound for a `metric` alone.
    hmin, hmax : float, optional
        Bounds on the sizes.
    feature_angle : float, optional
        Edges whose faces meet at a larger angle, in degrees, are kept sharp; 45 by default.
    detect_features : bool
        Whether to look for sharp edges.
    smooth_borders : bool
        Whether to keep the outlines of the planes of a CAD tessellation where something curved joins them smoothly.
    constrained_edges : array of shape (k, 2) of integers, optional
        Edges of the input, by their points, that stay chains of edges.
    constrained_vertices : array of booleans (n,) or of indices, optional
        Vertices that stay where they are.
    protected_edges : array of shape (k, 2) of integers, optional
        Edges of the input, by their points, that stay in one piece, between vertices that stay where they are.
    protected_faces : array of booleans (m,) or of indices, optional
        Triangles that stay as they are.
    protected_gradation : float, optional
        How fast sizes come back to those of the metric with the distance from protected edges, whose lengths they
        follow; 1.5 by default, at most 1: they do not.
    faces : array of booleans (m,) or of indices, optional
        The triangles that are adapted; all others stay as they are.
    labels : array (m,), optional
        A number or a name for each triangle, such as its material, or the name of an attribute of the triangles: the
        result has them, and their borders are curves. Of a meshio.Mesh, by default, its physical groups or references.
    size_bounds : array (m, 2), optional
        The smallest and the largest size in each triangle; 0: no bound.
    attributes : dict of arrays, optional
        Values at the points that the result is to have, too; see `Result.interpolate`.
    face_attributes : dict of arrays (m, ...), optional
        Values at the triangles, those of the triangle of the input below the centre.
    corner_attributes : dict of arrays (m, 3, ...) of numbers, optional
        Values at the corners of the triangles, such as texture coordinates; where the sides of an edge differ is a seam,
        which no triangle crosses.
    face_origin : bool
        Whether `Result.face_origin` is wanted; it is there, too, if there are attributes of faces.
    reconstruction : {"patches", "flat"}, optional
        The surface between the points: smooth patches through them, or the triangles themselves.
    fit : bool
        Whether the faces are to run through the surface instead of touching it with their vertices.
    shape_weight : float, optional
        What the shape of the faces counts with `fit`, above 0 and up to 1: the smaller, the nearer. 0.02 by default.
    normals : array of shape (n, 3), optional
        Outer normals; estimated by default. Not used at sharp features and boundaries.
    shape_operators : array of shape (n, 3, 3) or (n, 6), optional
        Derivatives of the normal along the surface; estimated by default.
    tolerance : float, optional
        Certifies that the Hausdorff distance between input and output is below this fraction of the diagonal of the
        bounding box. Alone, sizes from the curvature follow from it.
    avoid_self_intersections : bool
        Whether no triangles of the result may meet where those of the input do not. Sizes get finer where sheets are too
        near each other for them; where the gap is too narrow for that, triangles of the input stay.
    count_self_intersections : bool
        Whether the report has the number of pairs of triangles that meet, before and after.
    max_vertices : int, optional
        Refuse what needs more vertices than these.
    iterations : int, optional
        The largest number of rounds, 8 by default.
    execution : {"sequential", "tbb", "openmp"}, optional
        By default the best that was built in.
    threads : int, optional
        All by default.
    weld : bool
        Join coincident points along seams first.
    repair : bool
        Mend an input that is no valid surface.
    progress : function or True, optional
        Called with a `Progress`; the run stops if it returns False, with the mesh reached so far, and if it raises an
        exception, which passes through. True shows a bar of tqdm.
    full : bool, optional
        Whether to return a `Result` for an object of another package, too, or an object for arrays.

    Returns
    -------
    Result
        For arrays. For an object of another package, and unless `full`, an object of the same kind.

    Raises
    ------
    Invalid_input_error
        One of those derived from it, with the index of the element: the mesh, the metric or an array is not as above.
    Invalid_parameter_error, Empty_mesh_error, Invalid_extent_error, Mesh_too_large_error, Tolerance_error
        As their names say. All derive from `Adaptation_error`.
    TypeError, ValueError
        If an argument has the wrong type or shape.

    Examples
    --------
    >>> result = adapt(points, triangles, curvature=0.001)
    >>> result.report.final.in_range
    """
    options = dict(locals())
    for name in ("points", "triangles", "progress", "full"):
        del options[name]
    return _run("adapt", points, triangles, options, progress, full)


def refine(
    points: Any,
    triangles: Any = None,
    *,
    progress: bool | ProgressFunction | None = None,
    full: bool | None = None,
    **options: Any,
) -> Any:
    """Splits the edges that are longer than sqrt 2 in the metric.

    Parameters
    ----------
    points, triangles, progress, full
        As for `adapt`; `progress` is asked about every twentieth of a second.
    **options
        The keywords of `adapt`; `iterations` is the largest number of sweeps, `fit` and `shape_weight` do not count.

    Returns
    -------
    Result
        With the number of `operations`; for an object of another package, and unless `full`, an object of that kind.
    """
    return _run("refine", points, triangles, options, progress, full)


def simplify(
    points: Any,
    triangles: Any = None,
    *,
    progress: bool | ProgressFunction | None = None,
    full: bool | None = None,
    **options: Any,
) -> Any:
    """Collapses the edges that are shorter than 1 / sqrt 2 in the metric, or all that limits allow.

    Parameters
    ----------
    points, triangles, progress, full
        As for `adapt`; `progress` is asked about every twentieth of a second.
    **options
        The keywords of `adapt`; `iterations` is the largest number of sweeps, `fit` and `shape_weight` do not count.
    max_normal_deviation : float, optional
        The largest angle, in degrees, between the normal of a face and those of the faces that it stands for.
    max_distance : float, optional
        The largest distance of faces from what they stand for, in the unit of the coordinates. With either limit the
        collapses that cost least go first, and a large `size` leaves everything to the limits.

    Returns
    -------
    Result
        With the number of `operations`; for an object of another package, and unless `full`, an object of that kind.
    """
    return _run("simplify", points, triangles, options, progress, full)


def swap(
    points: Any,
    triangles: Any = None,
    *,
    progress: bool | ProgressFunction | None = None,
    full: bool | None = None,
    **options: Any,
) -> Any:
    """Swaps edges to improve the worst quality of their faces, and the degrees of their vertices.

    Parameters
    ----------
    points, triangles, progress, full
        As for `adapt`; `progress` is asked about every twentieth of a second.
    **options
        The keywords of `adapt`; `iterations` is the largest number of sweeps, `fit` and `shape_weight` do not count.

    Returns
    -------
    Result
        With the number of `operations`; for an object of another package, and unless `full`, an object of that kind.
    """
    return _run("swap", points, triangles, options, progress, full)


def regularize(
    points: Any,
    triangles: Any = None,
    *,
    progress: bool | ProgressFunction | None = None,
    full: bool | None = None,
    **options: Any,
) -> Any:
    """Takes vertices away and puts others in where that makes the mesh more regular.

    Parameters
    ----------
    points, triangles, progress, full
        As for `adapt`; `progress` is asked about every twentieth of a second.
    **options
        The keywords of `adapt`; `iterations` is the largest number of sweeps, `fit` and `shape_weight` do not count.

    Returns
    -------
    Result
        With the number of `operations`; for an object of another package, and unless `full`, an object of that kind.
    """
    return _run("regularize", points, triangles, options, progress, full)


def relocate(
    points: Any,
    triangles: Any = None,
    *,
    progress: bool | ProgressFunction | None = None,
    full: bool | None = None,
    **options: Any,
) -> Any:
    """Moves vertices on the surface to improve the faces around them.

    Parameters
    ----------
    points, triangles, progress, full
        As for `adapt`; `progress` is asked about every twentieth of a second.
    **options
        The keywords of `adapt`; `iterations` is the largest number of sweeps, `fit` and `shape_weight` do not count.
    max_normal_deviation : float, optional
        The largest angle, in degrees, between the tangent plane at a vertex and the faces around it.

    Returns
    -------
    Result
        With the number of `operations`; for an object of another package, and unless `full`, an object of that kind.
    """
    return _run("relocate", points, triangles, options, progress, full)

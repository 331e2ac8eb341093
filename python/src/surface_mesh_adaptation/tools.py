# SPDX-License-Identifier: GPL-3.0-or-later
"""What the kernels are made of, for whole arrays: estimates, metrics, the smooth surface."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _core
from ._arrays import Array, evaluated, field, indices, numbers, sizes, tensors
from ._meshes import Surface, surface_of
from ._request import Request, bounded, metric_arrays, surface_request
from .errors import Invalid_parameter_error


class Jets(NamedTuple):
    """Normals and shape operators at points."""

    normals: Array  #: (n, 3)
    shape_operators: Array  #: (n, 3, 3)


class Hessians(NamedTuple):
    """Second derivatives along the surface at points."""

    tensors: Array  #: (n, 3, 3)
    unexplained: Array  #: (n,): near 1 where the mesh does not resolve the field, 0 where the fit is exact


class Complexity(NamedTuple):
    """How much there is to mesh in a metric."""

    area: float  #: in units of the metric
    boundary_length: float  #: the same
    vertices: float  #: of a mesh with edges of length 1


class SurfacePoints(NamedTuple):
    """Points of the smooth surface."""

    points: Array  #: (k, 3)
    normals: Array  #: (k, 3)
    faces: Array  #: (k,): over which they lie
    on_border: Array  #: (k,): whether the way to them ended early, at the border of the faces around


def _request(points: Any, triangles: Any, options: dict[str, Any]) -> tuple[Surface, Request]:
    surface = surface_of(points, triangles)
    return surface, surface_request(surface, options)


def estimate_jets(points: Any, triangles: Any = None, **options: Any) -> Jets:
    """Estimates normals and shape operators as an adaptation would.

    The shape operator is the derivative of the normal along the surface: on a sphere of radius r with outer normals
    ``(I - n n^T) / r``. Where several smooth parts meet, at features, the values are those of one of them; at points
    that no triangle uses they are zero.

    Parameters
    ----------
    points, triangles
        As for `adapt`.
    **options
        Those of `adapt` about features, constraints and the execution.

    Returns
    -------
    Jets
    """
    _, request = _request(points, triangles, options)
    return Jets(*_core.estimate_jets(request))


def estimate_hessians(points: Any, triangles: Any = None, values: Any = None, **options: Any) -> Hessians:
    """Estimates the second derivatives along the surface of values at the points.

    Parameters
    ----------
    points, triangles
        As for `adapt`.
    values : array of shape (n,), or a function of the points
        The field.
    **options
        Those of `adapt` about features, constraints and the execution.

    Returns
    -------
    Hessians
        Zero along the normal. Where several smooth parts meet, at features, the largest of theirs.
    """
    surface, request = _request(points, triangles, options)
    at_points = field("values", evaluated(values, surface.points), len(surface.points))
    return Hessians(*_core.estimate_hessians(request, at_points))


def _metric_request(points: Any, triangles: Any, metric: Any, options: dict[str, Any]) -> Request:
    surface, request = _request(points, triangles, options)
    request.update(metric_arrays("metric", evaluated(metric, surface.points), len(surface.points)))
    return request


def gradation(points: Any, triangles: Any = None, metric: Any = None, ratio: float = 1.5, **options: Any) -> Array:
    """Bounds how fast the sizes of a metric grow over a surface.

    Parameters
    ----------
    points, triangles
        As for `adapt`.
    metric : array of shape (n,), (n, 3, 3) or (n, 6), or a function of the points
        Sizes or tensors.
    ratio : float
        The sizes at two points one size apart differ by at most this factor.

    Returns
    -------
    array of shape (n,) or (n, 3, 3)
        The largest sizes below those given, or tensors with smaller sizes.
    """
    return _core.graded(_metric_request(points, triangles, metric, {"gradation": ratio, **options}))


def scale_to_vertices(
    points: Any, triangles: Any = None, metric: Any = None, vertices: int | None = None, **options: Any
) -> Array:
    """Scales a metric so that a mesh adapted to it has about a number of vertices.

    Parameters
    ----------
    points, triangles
        As for `adapt`.
    metric : array of shape (n,), (n, 3, 3) or (n, 6), or a function of the points
        Sizes or tensors.
    vertices : int
        The number.
    **options
        `hmin`, `hmax` and `gradation` hold in the result.

    Returns
    -------
    array of shape (n,) or (n, 3, 3)
    """
    if vertices is None:
        raise Invalid_parameter_error("vertices: a number is required")
    return _core.scaled(_metric_request(points, triangles, metric, {"vertices": vertices, **options}))


def complexity(points: Any, triangles: Any = None, metric: Any = None, **options: Any) -> Complexity:
    """Integrates a metric over a surface, and says how many vertices a mesh adapted to it has.

    Parameters
    ----------
    points, triangles
        As for `adapt`.
    metric : array of shape (n,), (n, 3, 3) or (n, 6), or a function of the points
        Sizes or tensors.

    Returns
    -------
    Complexity
    """
    return Complexity(*_core.measured(_metric_request(points, triangles, metric, options)))


def _as_tensors(name: str, metric: Any) -> Array:
    array = np.asarray(metric)
    if array.ndim == 1:
        return np.asarray(sizes(name, array, len(array))[:, None, None] ** -2.0 * np.eye(3))
    return tensors(name, array, len(array))


def intersection(a: Any, b: Any) -> Array:
    """The metric that asks for what both ask for.

    Parameters
    ----------
    a, b : arrays of shape (n,), (n, 3, 3) or (n, 6)
        Sizes or tensors.

    Returns
    -------
    array of shape (n, 3, 3)
    """
    first, second = _as_tensors("a", a), _as_tensors("b", b)
    if len(first) != len(second):
        raise ValueError(f"expected two metrics of the same length, not {len(first)} and {len(second)}")
    return _core.intersected(first, second)


def bound(metric: Any, hmin: float | None = None, hmax: float | None = None) -> Array:
    """Tensors with their sizes within bounds.

    Parameters
    ----------
    metric : array of shape (n, 3, 3) or (n, 6)
    hmin, hmax : float, optional

    Returns
    -------
    array of shape (n, 3, 3)
    """
    array = np.asarray(metric)
    return bounded(tensors("metric", array, len(array) if array.ndim > 0 else 0), hmin, hmax)


def exponential_map(points: Any, triangles: Any, vertices: Any, vectors: Any, **options: Any) -> SurfacePoints:
    """Follows geodesics from vertices over the faces around them.

    Parameters
    ----------
    points, triangles
        As for `adapt`; None as `triangles` for an object of another package.
    vertices : array of shape (k,) of integers
        Where they begin.
    vectors : array of shape (k, 3)
        In which direction and how far; projected onto the tangent planes.
    **options
        Those of `adapt` about features, constraints and the execution.

    Returns
    -------
    SurfacePoints
        Where they end. They stop at the border of the faces around the vertex, which `on_border` tells.
    """
    surface, request = _request(points, triangles, options)
    start = indices("vertices", vertices, None, len(surface.points))
    ends = _core.exponential_map(request, start, numbers("vectors", vectors, (len(start), 3)))
    return SurfacePoints(ends[0], ends[1], ends[2], ends[3].astype(bool))


def surface_points(points: Any, triangles: Any, faces: Any, weights: Any, **options: Any) -> SurfacePoints:
    """The smooth surface over the triangles, which an adaptation puts vertices on.

    Parameters
    ----------
    points, triangles
        As for `adapt`; None as `triangles` for an object of another package.
    faces : array of shape (k,) of integers
        The triangles.
    weights : array of shape (k, 3)
        Barycentric coordinates.
    **options
        Those of `adapt` about features, constraints and the execution.

    Returns
    -------
    SurfacePoints
    """
    surface, request = _request(points, triangles, options)
    over = indices("faces", faces, None, len(surface.triangles))
    places = _core.surface_points(request, over, numbers("weights", weights, (len(over), 3)))
    return SurfacePoints(places[0], places[1], places[2], places[3].astype(bool))

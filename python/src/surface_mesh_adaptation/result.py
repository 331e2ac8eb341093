# SPDX-License-Identifier: GPL-3.0-or-later
"""What an adaptation returns."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._arrays import Array
from ._meshes import Surface
from .report import Report


@dataclass
class Result:
    """An adapted surface.

    All arrays are as long as there are vertices or triangles in the result.
    """

    points: Array  #: (n, 3), float64
    triangles: Array  #: (m, 3), int64
    attributes: dict[str, Array]  #: those of the input at its points, interpolated
    metric: Array | None  #: (n, 3, 3): what was adapted to; None if the run was stopped before it was known
    feature_edges: Array  #: (k, 2): ridges, boundaries and constrained edges
    corners: Array  #: indices of the vertices where features end, meet or turn, and of the constrained ones
    constrained_vertices: Array  #: their indices in the result
    source_points: Array  #: (n, 3): the points of the input that each vertex lies between
    source_weights: Array  #: (n, 3): and their weights
    report: Report
    operations: int = 0  #: what a kernel alone did: splits, removals, swaps or moves
    normals: Array | None = None  #: (n, 3), if normals or shape operators were given
    shape_operators: Array | None = None  #: (n, 3, 3), the same
    seconds: float = 0.0  #: that the C++ functions took
    protected_edges: Array | None = None  #: (k, 2), int64: edges that were to stay in one piece
    vertex_origin: Array | None = None  #: (n,), int64: the point of the input that a vertex was, or -1
    face_origin: Array | None = None  #: (m,), int64, if asked for: the triangle of the input below the centre
    labels: Array | None = None  #: (m,), if there were any
    face_attributes: dict[str, Array] = field(default_factory=dict)
    corner_attributes: dict[str, Array] = field(default_factory=dict)  #: (m, 3, ...) each
    input: Surface | None = field(default=None, repr=False)

    def interpolate(self, values: Any) -> Array:
        """Values at the points of the input as they are at the vertices of the result.

        Parameters
        ----------
        values : array of shape (n_input, ...)
            Real numbers are interpolated linearly; of integers, truth values and text those of the nearest point are
            taken, but for colours (three or four bytes), which are interpolated and rounded.

        Returns
        -------
        array of shape (n, ...)
        """
        return interpolated(np.asarray(values), self.source_points, self.source_weights)

    @property
    def mesh(self) -> Any:
        """The result as the kind of object that the input was, or as arrays of points and triangles."""
        if self.input is None or self.input.rebuild is None:
            return self.points, self.triangles
        return self.input.rebuild(self)

    def plot(self, color_by: str = "size", *, screenshot: str | None = None, **options: Any) -> Any:
        """Shows the mesh before and after with pyvista.

        Parameters
        ----------
        color_by : {"size", "quality"} or name of an attribute
        screenshot : str, optional
            A file to write instead of a window.
        **options
            For ``pyvista.Plotter.show``.
        """
        from ._plot import show

        return show(self, color_by, screenshot, options)


def _is_colour(values: Array) -> bool:
    return values.dtype == np.uint8 and values.ndim == 2 and values.shape[1] in (3, 4)


def interpolated(values: Array, points: Array, weights: Array) -> Array:
    """`values` at the places that lie between three `points` each."""
    if not (values.dtype.kind in "fc" or _is_colour(values)):
        nearest = weights.argmax(axis=1)
        return np.asarray(values[points[np.arange(len(points)), nearest]])
    shape = (len(points),) + (1,) * (values.ndim - 1)
    w = [weights[:, i].reshape(shape) for i in range(3)]
    mean = w[0] * values[points[:, 0]] + w[1] * values[points[:, 1]] + w[2] * values[points[:, 2]]
    return np.asarray(np.rint(mean) if _is_colour(values) else mean, dtype=values.dtype)


def corners_of(points: Array, edges: Array, constrained: Array, corner_angle: float = 60) -> Array:
    """The ends, branches and sharp turns of chains of edges, and the vertices that are constrained."""
    degree = np.bincount(edges.ravel(), minlength=len(points))
    ends = np.concatenate([edges, edges[:, ::-1]])
    order = np.argsort(ends[:, 0], kind="stable")
    ends = ends[order]
    first = np.concatenate([[0], np.cumsum(degree)])[:-1]
    middle = np.flatnonzero(degree == 2)
    there = points[ends[first[middle], 1]] - points[middle]
    back = points[middle] - points[ends[first[middle] + 1, 1]]
    cosine = (there * back).sum(axis=1) / (np.linalg.norm(there, axis=1) * np.linalg.norm(back, axis=1))
    turns = middle[cosine < np.cos(np.radians(corner_angle))]
    return np.unique(np.concatenate([np.flatnonzero((degree != 0) & (degree != 2)), turns, constrained]))

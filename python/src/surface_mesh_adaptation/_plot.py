# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of meshes with pyvista."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import Array

if TYPE_CHECKING:
    from ._meshes import Surface
    from .result import Result


def edge_vectors(points: Array, triangles: Array) -> Array:
    """The sides of triangles, each opposite to the corner of its number: (m, 3, 3)."""
    corners: Array = points[triangles]
    return np.asarray(np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1))


def angles(points: Array, triangles: Array) -> Array:
    """The angles of triangles at their corners, in degrees: (m, 3)."""
    sides = edge_vectors(points, triangles)
    a, b = -np.roll(sides, -1, axis=1), np.roll(sides, -2, axis=1)
    sine = np.linalg.norm(np.cross(a, b), axis=2)
    return np.asarray(np.degrees(np.arctan2(sine, (a * b).sum(axis=2))))


def qualities(points: Array, triangles: Array) -> Array:
    """4 sqrt 3 area / sum of squared lengths: 1 for equilateral triangles."""
    sides = edge_vectors(points, triangles)
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    total = (sides**2).sum(axis=(1, 2))
    return np.asarray(np.divide(4 * np.sqrt(3) * area, total, out=np.zeros_like(area), where=total > 0))


def sizes(points: Array, triangles: Array) -> Array:
    """The mean lengths of the sides of triangles."""
    lengths: Array = np.linalg.norm(edge_vectors(points, triangles), axis=2)
    return np.asarray(lengths.mean(axis=1))


def _polydata(points: Array, triangles: Array) -> Any:
    import pyvista

    return pyvista.PolyData(points, np.column_stack([np.full(len(triangles), 3), triangles]))


def _coloured(points: Array, triangles: Array, attributes: dict[str, Array], color_by: str) -> Any:
    mesh = _polydata(points, triangles)
    if color_by in attributes:
        mesh.point_data[color_by] = attributes[color_by]
    elif color_by == "quality":
        mesh.cell_data[color_by] = qualities(points, triangles)
    elif color_by == "size":
        mesh.cell_data[color_by] = sizes(points, triangles)
    else:
        known = ", ".join(map(repr, ["size", "quality", *attributes]))
        raise ValueError(f"color_by: expected one of {known}, not {color_by!r}")
    return mesh


def plotter(result: Result, color_by: str, *, off_screen: bool = False) -> Any:
    """The mesh before and after, side by side."""
    import pyvista

    assert result.input is not None
    window = pyvista.Plotter(shape=(1, 2), off_screen=off_screen, window_size=[1600, 800])
    sides: list[tuple[str, Surface | Result]] = [("before", result.input), ("after", result)]
    for i, (title, mesh) in enumerate(sides):
        window.subplot(0, i)
        drawn = _coloured(mesh.points, mesh.triangles, mesh.attributes, color_by)
        window.add_mesh(drawn, scalars=color_by, show_edges=True, line_width=0.5)
        window.add_text(f"{title}: {len(mesh.points)} vertices", font_size=10)
    window.link_views()
    return window


def show(result: Result, color_by: str, screenshot: str | None, options: dict[str, Any]) -> Any:
    """Opens a window, or writes a picture."""
    window = plotter(result, color_by, off_screen=screenshot is not None)
    return window.show(screenshot=screenshot, **options) if screenshot else window.show(**options)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of other packages as arrays, and back. None of these packages is imported before one of its objects is met."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import Array, indices, numbers

if TYPE_CHECKING:
    from .result import Result

ACCEPTED = "arrays of points (n, 3) and triangles (m, 3), a pyvista.PolyData, a trimesh.Trimesh or a meshio.Mesh"


@dataclass
class Surface:
    """A surface in arrays, with what belongs to it."""

    points: Array
    triangles: Array
    attributes: dict[str, Array] = field(default_factory=dict)  #: at the points
    face_attributes: dict[str, Array] = field(default_factory=dict)
    corner_attributes: dict[str, Array] = field(default_factory=dict)  #: at the corners of triangles, (m, 3, ...)
    labels: Array | None = None  #: of the triangles
    label_names: Array | None = None  #: the different ones
    constrained_edges: Array | None = None
    constrained_vertices: Array | None = None
    rebuild: Callable[[Result], Any] | None = None  #: makes the kind of object that it came from
    warnings: list[str] = field(default_factory=list)


def surface_of(mesh: Any, triangles: Any = None) -> Surface:
    """What `mesh` is, or an error that lists what is accepted."""
    if triangles is not None:
        return _of_arrays(mesh, triangles)
    for package, name, convert in _KINDS:
        module = sys.modules.get(package)
        if module is not None and isinstance(mesh, getattr(module, name)):
            return convert(mesh)
    if isinstance(mesh, (np.ndarray, list, tuple)):
        raise TypeError(f"triangles are missing: expected {ACCEPTED}")
    raise TypeError(f"expected {ACCEPTED}, not {type(mesh).__module__}.{type(mesh).__qualname__}")


def _of_arrays(points: Any, triangles: Any) -> Surface:
    return Surface(numbers("points", points, ("n", 3)), indices("triangles", triangles, 3, None))


# pyvista


def _edges_of_polylines(lines: Array) -> Array:
    """VTK's polylines, each after its length, as pairs of points."""
    edges, at = [], 0
    while at < len(lines):
        chain = lines[at + 1 : at + 1 + lines[at]]
        edges.append(np.column_stack([chain[:-1], chain[1:]]))
        at += 1 + lines[at]
    return np.concatenate(edges) if edges else np.empty((0, 2), dtype=np.int64)


def _of_pyvista(mesh: Any) -> Surface:
    if not mesh.is_all_triangles:
        mesh = mesh.triangulate()
    faces = mesh.faces.reshape(-1, 4)[:, 1:]
    others = mesh.n_cells - len(faces)  # vertices and lines, which come first
    surface = _of_arrays(mesh.points, faces)
    surface.attributes = {name: np.asarray(mesh.point_data[name]) for name in mesh.point_data}
    surface.face_attributes = {name: np.asarray(mesh.cell_data[name])[others:] for name in mesh.cell_data}
    surface.constrained_edges = _edges_of_polylines(np.asarray(mesh.lines))
    fields = {name: np.array(mesh.field_data[name]) for name in mesh.field_data}
    surface.rebuild = lambda result: _to_pyvista(result, fields)
    return surface


def _to_pyvista(result: Result, fields: dict[str, Array]) -> Any:
    import pyvista

    faces = np.column_stack([np.full(len(result.triangles), 3), result.triangles])
    mesh = pyvista.PolyData(result.points, faces)
    for name, values in result.attributes.items():
        mesh.point_data[name] = values
    for name, values in result.face_attributes.items():
        mesh.cell_data[name] = values
    for name, values in fields.items():
        mesh.field_data[name] = values
    return mesh


# trimesh

_COLOURS, _FACE_COLOURS, _UV = "trimesh:vertex_colors", "trimesh:face_colors", "trimesh:uv"


def _of_trimesh(mesh: Any) -> Surface:
    surface = _of_arrays(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    surface.attributes = {name: np.asarray(values) for name, values in mesh.vertex_attributes.items()}
    surface.face_attributes = {name: np.asarray(values) for name, values in mesh.face_attributes.items()}
    material = None
    if mesh.visual.kind == "vertex":
        surface.attributes[_COLOURS] = np.asarray(mesh.visual.vertex_colors)
    elif mesh.visual.kind == "face":
        surface.face_attributes[_FACE_COLOURS] = np.asarray(mesh.visual.face_colors)
    elif mesh.visual.kind == "texture" and mesh.visual.uv is not None:
        surface.attributes[_UV] = np.asarray(mesh.visual.uv)
        material = mesh.visual.material
    metadata = dict(mesh.metadata)
    surface.rebuild = lambda result: _to_trimesh(result, material, metadata)
    return surface


def _to_trimesh(result: Result, material: Any, metadata: dict[str, Any]) -> Any:
    import trimesh

    mesh: Any = trimesh.Trimesh(result.points, result.triangles, process=False, metadata=metadata)
    for name, values in result.face_attributes.items():
        if name == _FACE_COLOURS:
            mesh.visual.face_colors = values
        else:
            mesh.face_attributes[name] = values
    for name, values in result.attributes.items():
        if name == _COLOURS:
            mesh.visual.vertex_colors = values
        elif name == _UV:
            textured: Any = trimesh.visual.TextureVisuals
            mesh.visual = textured(uv=values, material=material)
        else:
            mesh.vertex_attributes[name] = values
    return mesh


# meshio

#: Cell data that say what a face is a part of: physical groups of Gmsh, references of MEDIT, materials.
_LABELS = ("gmsh:physical", "medit:ref", "cell_tags", "MaterialIds", "material")


def _of_meshio(mesh: Any) -> Surface:
    points = np.asarray(mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    parts: dict[str, list[Array]] = {"triangle": [], "line": [], "vertex": []}
    data: dict[str, list[Array]] = {name: [] for name in mesh.cell_data}
    left_out = []
    for i, block in enumerate(mesh.cells):
        kind, cells, repeat = _simplices(block)
        if kind not in parts:
            left_out.append(f"{len(cells)} cells of type {block.type}")
            continue
        parts[kind].append(cells)
        if kind == "triangle":
            for name in data:
                data[name].append(np.repeat(np.asarray(mesh.cell_data[name][i]), repeat, axis=0))
    if not parts["triangle"]:
        found = ", ".join(sorted({block.type for block in mesh.cells})) or "none"
        raise ValueError(f"expected a meshio.Mesh with cells of type triangle or quad; its cells are: {found}")
    surface = _of_arrays(points, np.concatenate(parts["triangle"]))
    surface.attributes = {name: np.asarray(values) for name, values in mesh.point_data.items()}
    surface.face_attributes = {name: np.concatenate(values) for name, values in data.items()}
    surface.labels = next((surface.face_attributes[name] for name in _LABELS if name in surface.face_attributes), None)
    surface.constrained_edges = np.concatenate(parts["line"]) if parts["line"] else None
    surface.constrained_vertices = np.concatenate(parts["vertex"]).ravel() if parts["vertex"] else None
    surface.warnings = ["not kept: " + ", ".join(left_out)] if left_out else []
    has_lines, field_data = bool(parts["line"]), dict(mesh.field_data)
    surface.rebuild = lambda result: _to_meshio(result, has_lines, field_data)
    return surface


def _simplices(block: Any) -> tuple[str, Array, int]:
    """The cells of a block with the corners of simplices, and how many have come of each."""
    cells = np.asarray(block.data)
    if block.type == "quad":
        return "triangle", cells[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3), 2
    return block.type, cells, 1


def _to_meshio(result: Result, has_lines: bool, field_data: dict[str, Any]) -> Any:
    import meshio

    cells = [("triangle", result.triangles)]
    data = {name: [values] for name, values in result.face_attributes.items()}
    if has_lines and len(result.feature_edges) > 0:
        cells.append(("line", result.feature_edges))
        for values in data.values():
            values.append(np.zeros((len(result.feature_edges), *values[0].shape[1:]), dtype=values[0].dtype))
    return meshio.Mesh(result.points, cells, dict(result.attributes), data, field_data=field_data)


_KINDS: list[tuple[str, str, Callable[[Any], Surface]]] = [
    ("pyvista", "PolyData", _of_pyvista),
    ("trimesh", "Trimesh", _of_trimesh),
    ("meshio", "Mesh", _of_meshio),
]

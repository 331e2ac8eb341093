# SPDX-License-Identifier: GPL-3.0-or-later
"""A part with sharp edges, and labels whose borders have to be kept where nothing is sharp."""

import sys
from pathlib import Path

import numpy as np
import pyvista
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

import surface_mesh_adaptation as sma


def sides(triangles):
    """The edges of the triangles, smaller index first: (m, 3, 2)."""
    return np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2)


def pairs_of_neighbours(triangles):
    """The edges with two triangles, and these."""
    edges, of_side = np.unique(sides(triangles).reshape(-1, 2), axis=0, return_inverse=True)
    order = np.argsort(of_side.ravel(), kind="stable")
    is_inner = np.bincount(of_side.ravel()) == 2
    first = np.searchsorted(of_side.ravel()[order], np.flatnonzero(is_inner))
    return edges[is_inner], np.column_stack([order[first], order[first + 1]]) // 3


def parts(triangles, borders):
    """The number of the part, between borders, of each triangle."""
    edges, faces = pairs_of_neighbours(triangles)
    n = triangles.max() + 1
    inside = ~np.isin(edges @ [n, 1], np.sort(borders, axis=1) @ [n, 1])
    graph = coo_matrix((np.ones(inside.sum()), faces[inside].T), shape=2 * [len(triangles)])
    return connected_components(graph, directed=False)[1]


folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
mesh = pyvista.Disc(inner=0.5, outer=1.0, c_res=48).extrude((0, 0, 1), capping=True).triangulate().clean()
triangles = mesh.regular_faces
half = (mesh.cell_centers().points[:, 0] > 0).astype(int)  # a label on each half

edges, faces = pairs_of_neighbours(triangles)
borders = edges[half[faces[:, 0]] != half[faces[:, 1]]]
result = sma.adapt(mesh.points, triangles, curvature=0.002, constrained_edges=borders)

part = parts(result.triangles, result.feature_edges)
centers = result.points[result.triangles].mean(axis=1)
label = np.array([centers[part == p][:, 0].mean() > 0 for p in range(part.max() + 1)])[part]
print(f"{len(result.corners)} corners, {part.max() + 1} parts, {label.sum()} of {len(label)} triangles with label 1")

result.plot("quality", screenshot=folder / "cad_with_labels.png")

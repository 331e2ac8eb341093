# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces to test with, and what is to be true of every result."""

import os
from pathlib import Path

import numpy as np


def sphere(subdivisions=3):
    """The unit sphere, from an octahedron."""
    points = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    triangles = np.array(
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]], dtype=np.int64
    )
    for _ in range(subdivisions):
        points, triangles = subdivided(points, triangles)
        points /= np.linalg.norm(points, axis=1)[:, None]
    return points, triangles


def subdivided(points, triangles):
    """Each triangle in four."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, of_side = np.unique(sides, axis=0, return_inverse=True)
    a, b, c = (of_side.reshape(-1, 3) + len(points)).T
    i, j, k = triangles.T
    middles = (points[edges[:, 0]] + points[edges[:, 1]]) / 2
    parts = [np.column_stack(p) for p in ((i, a, c), (a, j, b), (c, b, k), (a, b, c))]
    return np.concatenate([points, middles]), np.concatenate(parts)


def cube(subdivisions=2):
    """The unit cube."""
    points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    triangles = np.array(
        [
            [0, 1, 3],
            [0, 3, 2],
            [4, 6, 7],
            [4, 7, 5],
            [0, 4, 5],
            [0, 5, 1],
            [2, 3, 7],
            [2, 7, 6],
            [0, 2, 6],
            [0, 6, 4],
            [1, 5, 7],
            [1, 7, 3],
        ]  # fmt: skip
    )
    for _ in range(subdivisions):
        points, triangles = subdivided(points, triangles)
    return points, triangles


def square(n=8):
    """The unit square, with a boundary."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    i = np.arange(n)[:, None] * (n + 1) + np.arange(n)
    i = i.ravel()
    lower = np.column_stack([i, i + 1, i + n + 2])
    upper = np.column_stack([i, i + n + 2, i + n + 1])
    return points, np.concatenate([lower, upper])


def check_manifold(result, characteristic):
    """No edge has more than two faces, and the Euler characteristic is as it was."""
    t = np.asarray(result.triangles)
    sides = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    assert len(np.unique(sides, axis=0)) == len(sides), "an edge is passed twice in the same direction"
    edges = np.unique(np.sort(sides, axis=1), axis=0)
    assert len(result.points) - len(edges) + len(t) == characteristic
    assert np.array_equal(np.unique(t), np.arange(len(result.points)))
    assert np.isfinite(result.points).all()


def data_file(name):
    """A mesh of CGAL's data, or None."""
    folder = os.environ.get("CGAL_DATA_DIR")
    file = Path(folder or "") / "meshes" / name
    return file if folder and file.exists() else None


def read_off(file):
    """Points and triangles of an OFF file of triangles."""
    lines = [line.split("#")[0] for line in Path(file).read_text().splitlines()]
    words = " ".join(lines).split()
    n, m = int(words[1]), int(words[2])
    points = np.array(words[4 : 4 + 3 * n], dtype=float).reshape(n, 3)
    return points, np.array(words[4 + 3 * n : 4 + 3 * n + 4 * m], dtype=np.int64).reshape(m, 4)[:, 1:]


def write_off(file, points, triangles):
    """With all digits."""
    with open(file, "w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines("{:.17g} {:.17g} {:.17g}\n".format(*p) for p in points.tolist())
        out.writelines("3 {} {} {}\n".format(*t) for t in triangles.tolist())

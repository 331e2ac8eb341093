# SPDX-License-Identifier: GPL-3.0-or-later
"""A solver on a surface: -div grad u + u = f on a sphere by linear elements, on meshes adapted to the last solution."""

import sys
from pathlib import Path

import numpy as np
import pyvista
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

import surface_mesh_adaptation as sma

STEEPNESS = 15.0


def on_sphere(p):
    return p / np.linalg.norm(p, axis=1)[:, None]


def exact(p):
    """A steep front along a circle of latitude."""
    return np.tanh(STEEPNESS * (p[:, 2] - 0.3))


def source(p):
    """f, for the Laplacian of a function of z on the unit sphere is (1 - z^2) u'' - 2 z u'."""
    z, u = p[:, 2], exact(p)
    first = STEEPNESS * (1 - u**2)
    return u - ((1 - z**2) * (-2 * STEEPNESS * u * first) - 2 * z * first)


def solve(points, triangles):
    """Linear finite elements on flat triangles."""
    corners = points[triangles]
    opposite = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)
    area = np.linalg.norm(np.cross(opposite[:, 0], opposite[:, 1]), axis=1) / 2
    stiffness = np.einsum("fic,fjc->fij", opposite, opposite) / (4 * area)[:, None, None]
    mass = (np.ones((3, 3)) + np.eye(3)) / 12 * area[:, None, None]
    rows, columns = np.repeat(triangles, 3, axis=1).ravel(), np.tile(triangles, 3).ravel()
    shape = 2 * [len(points)]
    mass_matrix = coo_matrix((mass.ravel(), (rows, columns)), shape).tocsr()
    matrix = coo_matrix((stiffness.ravel(), (rows, columns)), shape).tocsr() + mass_matrix
    middles = (np.roll(corners, -1, axis=1) + np.roll(corners, -2, axis=1)) / 2  # of the sides, for the load
    at_middles = source(on_sphere(middles.reshape(-1, 3))).reshape(-1, 3) * area[:, None] / 6
    load = np.bincount(triangles.ravel(), (at_middles.sum(axis=1)[:, None] - at_middles).ravel(), len(points))
    return spsolve(matrix, load), mass_matrix


folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
sphere = pyvista.Icosphere(radius=1.0, nsub=4)
points, triangles = np.array(sphere.points, dtype=float), sphere.regular_faces
points = on_sphere(points)
normals, shape_operators = points, np.eye(3) - points[:, :, None] * points[:, None, :]  # exact, and carried along
for step in range(5):
    u, mass = solve(points, triangles)
    error = u - exact(on_sphere(points))
    print(f"step {step}: {len(points)} vertices, error {np.sqrt(error @ (mass @ error)):.2e}")
    result = sma.adapt(points, triangles, field=u, vertices=2500, hmax=0.15,
                       attributes={"u": u}, normals=normals, shape_operators=shape_operators)  # fmt: skip
    points, triangles = result.points, result.triangles
    normals, shape_operators = result.normals, result.shape_operators

result.plot("u", screenshot=folder / "solver_loop.png")

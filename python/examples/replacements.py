# SPDX-License-Identifier: GPL-3.0-or-later
"""What to write instead of the usual calls of pyacvd and of pymeshlab."""

import sys
from pathlib import Path

import numpy as np
import pyvista

import surface_mesh_adaptation as sma


def cluster(mesh, number_of_points):
    """Instead of ``pyacvd.Clustering(mesh).cluster(n)`` and ``create_mesh()``: n vertices, evenly."""
    return sma.adapt(mesh, metric=np.ones(mesh.n_points), vertices=number_of_points)


def isotropic_remeshing(mesh, length, iterations=8, angle=30):
    """Instead of ``meshing_isotropic_explicit_remeshing(targetlen=..., iterations=..., featuredeg=...)``."""
    return sma.adapt(mesh, size=length, iterations=iterations, feature_angle=angle)


def decimation(mesh, max_distance):
    """Instead of ``meshing_decimation_quadric_edge_collapse``: as few triangles as a distance allows."""
    return sma.simplify(mesh, size=mesh.length, max_distance=max_distance)


folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
mesh = pyvista.ParametricTorus(u_res=60, v_res=30).triangulate().clean()
results = {
    "clustered": cluster(mesh, 1500),
    "isotropic": isotropic_remeshing(mesh, 0.1),
    "decimated": decimation(mesh, 0.01),
}
window = pyvista.Plotter(shape=(1, 3), off_screen=True, window_size=(1500, 500))
for i, (name, result) in enumerate(results.items()):
    print(f"{name}: {result.n_points} vertices")
    window.subplot(0, i)
    window.add_mesh(result, color="lightsteelblue", show_edges=True)
    window.add_text(f"{name}: {result.n_points}", font_size=10)
window.screenshot(folder / "replacements.png")

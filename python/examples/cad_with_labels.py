# SPDX-License-Identifier: GPL-3.0-or-later
"""A part with sharp edges, and labels whose borders have to be kept where nothing is sharp."""

import sys
from pathlib import Path

import numpy as np
import pyvista

import surface_mesh_adaptation as sma

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
part = pyvista.Disc(inner=0.5, outer=1.0, c_res=48).extrude((0, 0, 1), capping=True).triangulate().clean()
part.cell_data["material"] = np.where(part.cell_centers().points[:, 0] > 0, 2, 1)

result = sma.adapt(part, curvature=0.002, labels="material", full=True)
print(f"{len(result.feature_edges)} sharp edges, {np.sum(result.labels == 2)} triangles of material 2")

window = pyvista.Plotter(shape=(1, 2), off_screen=True, window_size=[1600, 800])
for i, mesh in enumerate((part, result.mesh)):
    window.subplot(0, i)
    window.add_mesh(mesh, scalars="material", show_edges=True)
window.screenshot(folder / "cad_with_labels.png")

# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface that is far too fine, coarsened within a distance, for a volume mesher: TetGen, if it is installed."""

import sys
from pathlib import Path

import numpy as np
import pyvista

import surface_mesh_adaptation as sma

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
fine = pyvista.ParametricEllipsoid(1.0, 0.7, 0.5, u_res=200, v_res=120).triangulate().clean()

within = 0.002 * fine.length
coarse = sma.simplify(fine, size=fine.length, max_distance=within, max_normal_deviation=25, full=True)
print(f"{fine.n_points} -> {len(coarse.points)} vertices within {within:.4f}")
# sizes that grow gently, no more triangles than that needs
result = sma.adapt(fine, curvature=0.002, gradation=1.5, hmax=0.3, tolerance=0.002, full=True)
print(f"with good triangles: {len(result.points)} vertices, certified within {result.report.certified_distance:.4f}")

try:
    import tetgen
except ImportError:
    print("no volume mesh: tetgen is not installed")
else:
    volume = tetgen.TetGen(result.mesh)
    volume.tetrahedralize(order=1, mindihedral=15, minratio=1.5)
    grid = volume.grid
    print(f"{grid.n_cells} tetrahedra of volume {grid.volume:.4f}, exact: {4 / 3 * np.pi * 0.35:.4f}")

result.plot("size", screenshot=folder / "volume_mesher.png")

# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of the same size everywhere."""

import sys
from pathlib import Path

import pyvista

import surface_mesh_adaptation as sma

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
mesh = pyvista.ParametricTorus(u_res=30, v_res=12).triangulate().clean()

result = sma.adapt(mesh, size=0.12, full=True)
print(f"{100 * result.report.final.in_range:.1f} % of the edges are as long as asked for")

result.plot("size", screenshot=folder / "uniform.png")
result.mesh.save(folder / "uniform.vtp")  # a pyvista.PolyData, as the input was

# SPDX-License-Identifier: GPL-3.0-or-later
"""Sizes from the curvature, stretched along the directions in which the surface bends less, and a report to send."""

import sys
from pathlib import Path

import pyvista

import surface_mesh_adaptation as sma

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
mesh = pyvista.ParametricSuperToroid(n1=0.6, n2=0.8, u_res=80, v_res=80).triangulate().clean()

for anisotropic in (False, True):
    result = sma.adapt(mesh, curvature=0.001, anisotropic=anisotropic, full=True)
    print(f"anisotropic: {anisotropic}, {len(result.points)} vertices for a distance of {result.report.deviation:.4f}")

result.plot("size", screenshot=folder / "curvature.png")
result.report.to_html(folder / "curvature.html", title="A supertoroid")

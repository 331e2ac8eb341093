# SPDX-License-Identifier: GPL-3.0-or-later
"""Uniform remeshing by several packages of Python, at equal numbers of vertices: time, quality and distance.

    pip install surface-mesh-adaptation pyvista pymeshlab pyacvd mmgpy meshlib gpytoolbox
    CGAL_DATA_DIR=... python compare.py [MESH...]

What is not installed is left out. Each tool is asked for as many vertices as the input has; one that takes a length is
called until it comes within 2 %, and its last call counts. Time is that of the processor, in all threads; the distance
is from the centers and the vertices of the result to the triangles of the input.
"""

import importlib.util
import os
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

import numpy as np
import pyvista
from shapes import read_off

from surface_mesh_adaptation import adapt
from surface_mesh_adaptation._plot import angles, edge_vectors, qualities

MESHES = ["bunny00.off", "elephant.off", "fandisk.off", "armadillo.off", "camel.off", "knot1.off"]
LONGEST = 120  # seconds for a call
COLUMNS = [
    "",
    "vertices",
    "microseconds of processor per vertex",
    "edges in range",
    "mean quality",
    "angle that 1 % of the faces are below",
    "distance, rms, in millionths of the diagonal",
]


def this_package(points, triangles, length, _):
    result = adapt(points, triangles, size=length)
    return result.points, result.triangles


def this_package_flat(points, triangles, length, _):
    result = adapt(points, triangles, size=length, reconstruction="flat", fit=True)
    return result.points, result.triangles


def with_pymeshlab(points, triangles, length, _):
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(points, triangles))
    meshes.meshing_isotropic_explicit_remeshing(targetlen=pymeshlab.PureValue(length), iterations=10)
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()


def with_pyacvd(points, triangles, _, vertices):
    import pyacvd

    clustering = pyacvd.Clustering(polydata(points, triangles))
    clustering.subdivide(3)  # as its documentation does
    clustering.cluster(vertices)
    mesh = clustering.create_mesh()
    return mesh.points, mesh.faces.reshape(-1, 4)[:, 1:]


def with_mmgpy(points, triangles, length, _):
    import mmgpy

    mesh = mmgpy.MmgMeshS(points, triangles.astype(np.int32))
    extent = np.linalg.norm(np.ptp(points, axis=0))
    mesh.remesh(hsiz=length, hausd=0.01 * extent, verbose=-1)
    return mesh.get_vertices(), mesh.get_triangles()


def with_meshlib(points, triangles, length, _):
    from meshlib import mrmeshnumpy, mrmeshpy

    mesh = mrmeshnumpy.meshFromFacesVerts(triangles.astype(np.int32), points)
    settings = mrmeshpy.RemeshSettings()
    settings.targetEdgeLen = length
    settings.maxEdgeSplits = 10**8
    settings.projectOnOriginalMesh = True
    settings.packMesh = True
    mrmeshpy.remesh(mesh, settings)
    return mrmeshnumpy.getNumpyVerts(mesh), mrmeshnumpy.getNumpyFaces(mesh.topology)


def with_gpytoolbox(points, triangles, length, _):
    import gpytoolbox

    return gpytoolbox.remesh_botsch(points, triangles.astype(np.int32), 10, length, True)


TOOLS = {
    "this package": (this_package, "surface_mesh_adaptation"),
    "- flat, fitted": (this_package_flat, "surface_mesh_adaptation"),
    "pymeshlab": (with_pymeshlab, "pymeshlab"),
    "pyacvd": (with_pyacvd, "pyacvd"),
    "mmgpy": (with_mmgpy, "mmgpy"),
    "meshlib": (with_meshlib, "meshlib"),
    "gpytoolbox": (with_gpytoolbox, "gpytoolbox"),
}


def polydata(points, triangles):
    return pyvista.PolyData(points, np.column_stack([np.full(len(triangles), 3), triangles]))


def timed(tool, points, triangles, length, vertices):
    """Its result and the seconds of the processor."""
    signal.alarm(LONGEST)
    start = time.process_time()
    p, t = tool(points.copy(), triangles.copy(), length, vertices)
    seconds = time.process_time() - start
    signal.alarm(0)
    return np.asarray(p, dtype=float), np.asarray(t, dtype=np.int64), seconds


def at_number(tool, points, triangles):
    """The result with about as many vertices as the input, and the seconds that it took."""
    corners = points[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    n = len(points)
    length = np.sqrt(2 * area / (np.sqrt(3) * n))
    for _ in range(4):
        p, t, seconds = timed(tool, points, triangles, length, n)
        if abs(len(p) / n - 1) < 0.02 or tool is with_pyacvd:
            break
        length *= np.sqrt(len(p) / n)
    return p, t, seconds


def row(name, points, triangles, p, t, seconds):
    lengths = np.linalg.norm(edge_vectors(p, t), axis=2)
    ratio = lengths / np.median(lengths)
    in_range = ((ratio >= np.sqrt(0.5)) & (ratio <= np.sqrt(2))).mean()
    places = np.concatenate([p[np.unique(t)], p[t].mean(axis=1)])
    _, nearest = polydata(points, triangles).find_closest_cell(places, return_closest_point=True)
    rms = np.sqrt(((nearest - places) ** 2).sum(axis=1).mean()) / np.linalg.norm(np.ptp(points, axis=0))
    print(f"| {name} | {len(p)} | {1e6 * seconds / len(p):.0f} | {100 * in_range:.1f} % | {qualities(p, t).mean():.3f} "
          f"| {np.percentile(angles(p, t).min(axis=1), 1):.0f} | {1e6 * rms:.0f} |", flush=True)  # fmt: skip


def main():
    def give_up(*_):
        raise TimeoutError(f"longer than {LONGEST} s")

    signal.signal(signal.SIGALRM, give_up)
    for mesh in sys.argv[1:] or MESHES:
        points, triangles = read_off(Path(os.environ["CGAL_DATA_DIR"]) / "meshes" / mesh)
        print(f"\n{mesh}, {len(points)} vertices\n\n| {' | '.join(COLUMNS)} |\n|{7 * '---|'}")
        for name, (tool, package) in TOOLS.items():
            if importlib.util.find_spec(package) is None:
                continue
            try:
                row(name, points, triangles, *at_number(tool, points, triangles))
            except Exception as error:  # of whatever package
                signal.alarm(0)
                print(f"| {name} | {type(error).__name__}: {str(error)[:60]} |" + 5 * " |", flush=True)


if __name__ == "__main__":
    main()

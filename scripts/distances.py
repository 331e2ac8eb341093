# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts that measure distances share: meshes as arrays, distances by VTK, and programs that are run."""

import subprocess
import sys
import time

import numpy
import vtk
from vtk.util import numpy_support

TIME_LIMIT = 120  # seconds


def arrays(data):
    points = numpy_support.vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    return points, numpy_support.vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def read_off(path):
    words = path.read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    points = numpy.array(words[4:4 + 3 * vertices], dtype=float).reshape(-1, 3)
    return points, numpy.array(words[4 + 3 * vertices:][:4 * faces], dtype=int).reshape(-1, 4)[:, 1:]


def write_medit(path, points, faces):
    with path.open("w") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n")
        file.writelines(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in points.tolist())
        file.write(f"Triangles\n{len(faces)}\n")
        file.writelines(f"{a + 1} {b + 1} {c + 1} 0\n" for a, b, c in faces.tolist())
        file.write("End\n")


def read_medit(path):
    words = path.read_text().split()

    def rows(name, width, kind):
        first = words.index(name) + 2
        count = int(words[first - 1])
        return numpy.array(words[first:first + count * width], dtype=kind).reshape(count, width)[:, :3]
    return rows("Vertices", 4, float), rows("Triangles", 4, int) - 1


def poly_data(points, faces):
    data, cells, places = vtk.vtkPolyData(), vtk.vtkCellArray(), vtk.vtkPoints()
    places.SetData(numpy_support.numpy_to_vtk(points, deep=True))
    cells.SetData(3, numpy_support.numpy_to_vtkIdTypeArray(faces.astype(numpy.int64).ravel(), deep=True))
    data.SetPoints(places)
    data.SetPolys(cells)
    return data


class Locator:
    def __init__(self, data):
        self.locator = vtk.vtkStaticCellLocator()
        self.locator.SetDataSet(data)
        self.locator.BuildLocator()

    def distances(self, points):
        near, cell, sub, squared = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
        result = numpy.empty(len(points))
        for i, p in enumerate(points):
            self.locator.FindClosestPoint(p, near, cell, sub, squared)
            result[i] = squared.get()
        return numpy.sqrt(result)


def samples(points, faces, sides):
    """The same number of points in each face, one face after the other."""
    weights = numpy.array([(i, j, sides - i - j) for i in range(sides + 1) for j in range(sides + 1 - i)]) / sides
    return numpy.einsum("sk,fkx->fsx", weights, points[faces]).reshape(-1, 3)


def sampled(points, faces, least):
    """At least so many points on a mesh."""
    sides = 1
    while len(faces) * (sides + 1) * (sides + 2) // 2 < least:
        sides += 1
    return samples(points, faces, sides)


def rms_over_faces(distances, points, faces):
    """The root mean square over a mesh of `distances` at `samples` of it."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    return numpy.sqrt(numpy.average((distances.reshape(len(faces), -1) ** 2).mean(1), weights=area))


def run(command):
    """How long it took; none if it failed or takes too long."""
    start = time.time()
    try:
        result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=TIME_LIMIT)
    except subprocess.TimeoutExpired:
        print(*command, f"stopped after {TIME_LIMIT} s", sep="\n", file=sys.stderr)
        return None
    if result.returncode != 0:
        print(*command, result.stderr, sep="\n", file=sys.stderr)
        return None
    return time.time() - start

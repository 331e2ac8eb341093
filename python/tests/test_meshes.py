# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of pyvista, trimesh and meshio in and out."""

import subprocess
import sys

import numpy as np
import pytest
from shapes import check_manifold, cube, sphere, square

import surface_mesh_adaptation as sma


def test_nothing_is_imported_that_is_not_needed():
    script = (
        "import sys, numpy, surface_mesh_adaptation as sma\n"
        "sma.adapt(numpy.eye(3), [[0, 1, 2]], size=.5)\n"
        "assert not {'pyvista', 'trimesh', 'meshio', 'tqdm', 'vtk'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_pyvista():
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.Sphere(theta_resolution=24, phi_resolution=24)
    mesh.point_data["x"] = mesh.points[:, 0]
    mesh.field_data["name"] = ["ball"]
    result = sma.adapt(mesh, size=0.05)
    assert isinstance(result, pyvista.PolyData) and result.is_all_triangles and result.is_manifold
    assert np.abs(result.point_data["x"] - result.points[:, 0]).max() < 0.01
    assert list(result.field_data["name"]) == ["ball"]
    full = sma.adapt(mesh, size=0.05, full=True)
    assert np.allclose(full.mesh.points, result.points) and full.report.final.in_range > 0.95


def test_pyvista_polygons_and_lines():
    pyvista = pytest.importorskip("pyvista")
    plane = pyvista.Plane(i_resolution=6, j_resolution=6)
    assert not plane.is_all_triangles
    result = sma.adapt(plane, size=0.1)
    assert result.area == pytest.approx(plane.area)
    points, triangles = square(4)
    faces = np.column_stack([np.full(len(triangles), 3), triangles])
    mesh = pyvista.PolyData(points, faces=faces, lines=[3, 0, 6, 12])
    full = sma.adapt(mesh, size=0.05, full=True)
    ends = full.points[full.feature_edges]
    on_diagonal = np.abs(ends[:, :, 0] - ends[:, :, 1]).max(axis=1) < 1e-12
    assert np.linalg.norm(ends[on_diagonal, 1] - ends[on_diagonal, 0], axis=1).sum() == pytest.approx(np.sqrt(0.5))


def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.icosphere(3)
    colours = np.column_stack([np.rint(127 * (1 + mesh.vertices)), np.full(len(mesh.vertices), 255)])
    mesh.visual.vertex_colors = colours.astype(np.uint8)
    mesh.vertex_attributes["z"] = mesh.vertices[:, 2]
    mesh.metadata["name"] = "ball"
    result = sma.adapt(mesh, size=0.1)
    assert isinstance(result, trimesh.Trimesh) and result.is_watertight and result.is_winding_consistent
    assert np.abs(result.visual.vertex_colors[:, :3] - 127 * (1 + result.vertices)).max() < 4
    assert np.abs(result.vertex_attributes["z"] - result.vertices[:, 2]).max() < 0.01
    assert result.metadata["name"] == "ball"


def test_trimesh_texture():
    trimesh = pytest.importorskip("trimesh")
    points, triangles = square(8)
    visual = trimesh.visual.TextureVisuals(uv=points[:, :2])
    mesh = trimesh.Trimesh(points, triangles, visual=visual, process=False)
    result = sma.adapt(mesh, size=0.05)
    assert np.allclose(result.visual.uv, result.vertices[:, :2])


def test_meshio():
    meshio = pytest.importorskip("meshio")
    points, triangles = square(4)
    cells = [("triangle", triangles[:10]), ("triangle", triangles[10:]), ("line", [[0, 6], [6, 12]]), ("vertex", [[7]])]
    mesh = meshio.Mesh(points, cells, point_data={"x": points[:, 0]})
    result = sma.adapt(mesh, size=0.05)
    assert isinstance(result, meshio.Mesh)
    assert [block.type for block in result.cells] == ["triangle", "line"]
    assert np.allclose(result.point_data["x"], result.points[:, 0])
    assert (result.points == points[7]).all(axis=1).any()


def test_meshio_quads_and_other_cells():
    meshio = pytest.importorskip("meshio")
    points, _ = square(1)
    mesh = meshio.Mesh(points[:, :2], [("quad", [[0, 1, 3, 2]]), ("tetra", [[0, 1, 2, 3]])])
    full = sma.adapt(mesh, size=0.2, full=True)
    check_manifold(full, 1)
    assert any("tetra" in w for w in full.report.warnings)
    with pytest.raises(ValueError, match="tetra"):
        sma.adapt(meshio.Mesh(points, [("tetra", [[0, 1, 2, 3]])]), size=0.2)


def test_full_gives_an_object_of_arrays():
    points, triangles = cube()
    p, t = sma.adapt(points, triangles, size=0.2, full=False)
    result = sma.adapt(points, triangles, size=0.2)
    assert np.array_equal(p, result.points) and np.array_equal(t, result.triangles)


def test_kernels_return_objects_too():
    trimesh = pytest.importorskip("trimesh")
    points, triangles = sphere(2)
    mesh = trimesh.Trimesh(points, triangles, process=False)
    assert isinstance(sma.refine(mesh, size=0.1), trimesh.Trimesh)
    assert sma.refine(mesh, size=0.1, full=True).operations > 0

# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels, protected parts, selections and attributes of faces and corners come out again."""

import numpy as np
import pytest
from shapes import check_manifold, cube, sphere, square

import surface_mesh_adaptation as sma


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def edges_of(triangles):
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(pairs, axis=1), axis=0)


@pytest.mark.parametrize("kind", ["names", "numbers"])
def test_labels(kind):
    points, triangles = square(8)
    x = points[triangles].mean(axis=1)[:, 0]
    labels = np.where(x < points[:, 0].mean(), "rubber", "steel") if kind == "names" else (x > points[:, 0].mean()) + 7
    result = sma.adapt(points, triangles, size=0.05, labels=labels)
    assert len(result.labels) == len(result.triangles)
    assert set(result.labels) == set(labels)
    for label in set(labels):
        before = areas(points, triangles)[labels == label].sum()
        after = areas(result.points, result.triangles)[result.labels == label].sum()
        assert abs(after - before) < 1e-12


def test_protected_edges_and_faces_stay():
    points, triangles = sphere(3)
    chosen = edges_of(triangles)[::17]
    result = sma.adapt(points, triangles, size=0.05, protected_edges=chosen)
    ends = {frozenset(map(tuple, points[e])) for e in chosen}
    assert {frozenset(map(tuple, result.points[e])) for e in result.protected_edges} == ends
    faces = np.arange(20, 40)
    result = sma.adapt(points, triangles, size=0.05, protected_faces=faces)
    after = {frozenset(map(tuple, result.points[t])) for t in result.triangles}
    assert all(frozenset(map(tuple, points[t])) in after for t in triangles[faces])


def test_a_selection_leaves_the_rest():
    points, triangles = sphere(3)
    selected = points[triangles].mean(axis=1)[:, 2] > 0.2
    for run in (sma.adapt, sma.refine):
        result = run(points, triangles, size=0.04, faces=selected)
        check_manifold(result, 2)
        after = {frozenset(map(tuple, result.points[t])) for t in result.triangles}
        assert all(frozenset(map(tuple, points[t])) in after for t in triangles[~selected])
        assert len(result.triangles) > 2 * len(triangles)
    with pytest.raises(sma.Invalid_parameter_error, match="faces"):
        sma.adapt(points, triangles, size=0.04, faces=np.zeros(len(triangles), dtype=bool))


def test_attributes_of_faces_and_origins():
    points, triangles = square(8)
    values = np.arange(3.0 * len(triangles)).reshape(-1, 3)
    result = sma.refine(points, triangles, size=0.05, face_attributes={"v": values})
    assert np.array_equal(result.face_attributes["v"], values[result.face_origin])
    middle = result.points[result.triangles].mean(axis=1)
    assert np.linalg.norm(middle - points[triangles].mean(axis=1)[result.face_origin], axis=1).max() < 0.2
    old = result.vertex_origin >= 0
    assert old.sum() == len(points)
    assert np.array_equal(result.points[old], points[result.vertex_origin[old]])


def test_texture_coordinates_of_corners():
    points, triangles = square(8)
    left = points[triangles].mean(axis=1)[:, 0] < points[:, 0].mean()
    at = points[triangles]  # (m, 3, 3)
    uv = np.where(left[:, None, None], at[:, :, :2], 5 - 2 * at[:, :, :2])
    result = sma.adapt(points, triangles, size=0.05, corner_attributes={"uv": uv})
    at = result.points[result.triangles]
    is_left = at.mean(axis=1)[:, 0] < points[:, 0].mean()
    expected = np.where(is_left[:, None, None], at[:, :, :2], 5 - 2 * at[:, :, :2])
    assert np.abs(result.corner_attributes["uv"] - expected).max() < 1e-12


def test_bounds_of_sizes():
    points, triangles = cube(6)
    top = points[triangles].mean(axis=1)[:, 2] > points[:, 2].max() - 1e-9
    bounds = np.where(top[:, None], [0.0, 0.08], [0.0, 0.0])
    result = sma.adapt(points, triangles, size=0.5, size_bounds=bounds)
    z = result.points[result.triangles].mean(axis=1)[:, 2]
    assert (z > points[:, 2].max() - 1e-9).sum() > 3 * (z < points[:, 2].min() + 1e-9).sum()


def test_labels_of_meshio():
    meshio = pytest.importorskip("meshio")
    points, triangles = square(8)
    groups = (points[triangles].mean(axis=1)[:, 1] > points[:, 1].mean()).astype(int) + 3
    mesh = meshio.Mesh(points, [("triangle", triangles)], cell_data={"gmsh:physical": [groups]})
    result = sma.adapt(mesh, size=0.05)
    after = result.cell_data["gmsh:physical"][0]
    for group in (3, 4):
        before = areas(points, triangles)[groups == group].sum()
        assert abs(areas(result.points, result.cells[0].data)[after == group].sum() - before) < 1e-9


def test_wrong_shapes_are_refused():
    points, triangles = square(2)
    for name, value in (("labels", [1]), ("size_bounds", [[1.0]]), ("faces", [len(triangles)])):
        with pytest.raises((ValueError, IndexError)):
            sma.adapt(points, triangles, size=0.1, **{name: value})
    with pytest.raises(ValueError, match="corner_attributes"):
        sma.adapt(points, triangles, size=0.1, corner_attributes={"uv": np.zeros((3, 2))})

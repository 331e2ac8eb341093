# SPDX-License-Identifier: GPL-3.0-or-later
"""Estimates, metrics and the smooth surface."""

import numpy as np
import pytest
from shapes import cube, sphere, square

import surface_mesh_adaptation as sma


def test_jets_of_a_sphere():
    points, triangles = sphere(3)
    jets = sma.estimate_jets(points, triangles)
    assert np.abs(jets.normals - points).max() < 1e-3
    exact = np.eye(3) - points[:, :, None] * points[:, None, :]
    assert np.abs(jets.shape_operators - exact).max() < 0.02


def test_hessians_in_the_plane():
    points, triangles = square(8)
    x, y = points[:, 0], points[:, 1]
    hessians = sma.estimate_hessians(points, triangles, 2 * x**2 + x * y)
    assert np.allclose(hessians.tensors, [[4, 1, 0], [1, 0, 0], [0, 0, 0]], atol=1e-8)
    assert np.allclose(hessians.unexplained, 0, atol=1e-8)
    by_function = sma.estimate_hessians(points, triangles, lambda p: 2 * p[:, 0] ** 2 + p[:, 0] * p[:, 1])
    assert np.allclose(by_function.tensors, hessians.tensors)
    with pytest.raises(sma.Invalid_field_error):
        sma.estimate_hessians(points, triangles, x * np.nan)


def test_intersection_is_the_smaller_size_in_each_direction():
    a = np.broadcast_to(np.diag([4.0, 1.0, 1.0]), (5, 3, 3))
    b = np.broadcast_to(np.diag([1.0, 9.0, 1.0]), (5, 3, 3))
    assert np.allclose(sma.intersection(a, b), np.diag([4.0, 9.0, 1.0]))
    assert np.allclose(sma.intersection(np.full(3, 0.5), np.full(3, 0.1)), 100 * np.eye(3))
    with pytest.raises(ValueError, match="same length"):
        sma.intersection(a, b[:2])
    with pytest.raises(sma.Invalid_metric_error):
        sma.intersection(a, 0 * b)


def test_bound_clamps_sizes():
    metric = np.broadcast_to(np.diag([100.0, 1.0, 0.01]), (4, 3, 3))
    assert np.allclose(sma.bound(metric, 0.5, 2), np.diag([4.0, 1.0, 0.25]))


def test_gradation_bounds_the_growth():
    points, triangles = square(16)
    sizes = np.full(len(points), 1.0)
    sizes[0] = 0.01
    graded = sma.gradation(points, triangles, sizes, 1.3)
    assert graded[0] == 0.01 and (graded <= sizes).all()
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]])
    length = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    assert (np.abs(graded[edges[:, 0]] - graded[edges[:, 1]]) <= np.log(1.3) * length + 1e-12).all()
    tensors = sma.gradation(points, triangles, sizes[:, None, None] ** -2 * np.eye(3), 1.3)
    assert tensors.shape == (len(points), 3, 3) and np.trace(tensors[1]) > 3.1


def test_complexity_and_scaling():
    points, triangles = square(16)
    c = sma.complexity(points, triangles, np.full(len(points), 0.1))
    assert c.area == pytest.approx(100) and c.boundary_length == pytest.approx(40)
    scaled = sma.scale_to_vertices(points, triangles, np.full(len(points), 0.1), 1000)
    assert sma.complexity(points, triangles, scaled).vertices == pytest.approx(1000, rel=0.02)
    assert len(sma.adapt(points, triangles, size=scaled).points) == pytest.approx(1000, rel=0.1)


def test_the_surface_of_a_sphere():
    points, triangles = sphere(3)
    faces = np.arange(len(triangles))
    weights = np.full((len(faces), 3), 1 / 3)
    at = sma.surface_points(points, triangles, faces, weights)
    assert np.abs(np.linalg.norm(at.points, axis=1) - 1).max() < 2e-4
    assert np.abs(at.normals - at.points).max() < 5e-3
    corners = sma.surface_points(points, triangles, faces, np.tile([0.0, 1, 0], (len(faces), 1)))
    assert np.allclose(corners.points, points[triangles[:, 1]])
    with pytest.raises(sma.Invalid_input_error):
        sma.surface_points(points, triangles, [len(triangles)], [[1, 0, 0]])


def test_geodesics_of_a_sphere():
    points, triangles = sphere(3)
    vertices = np.arange(len(points))
    vectors = 0.05 * np.cross(points, [0.3, 0.4, 0.5])
    ends = sma.exponential_map(points, triangles, vertices, vectors)
    angle = np.linalg.norm(vectors, axis=1)
    exact = np.cos(angle)[:, None] * points + np.sinc(angle / np.pi)[:, None] * vectors
    assert not ends.on_border.any()
    assert np.abs(ends.points - exact).max() < 1e-4
    assert sma.exponential_map(points, triangles, [0], [[0, 9.0, 9.0]]).on_border.all()


def test_tools_take_meshes_of_other_packages():
    trimesh = pytest.importorskip("trimesh")
    points, triangles = cube()
    mesh = trimesh.Trimesh(points, triangles, process=False)
    assert np.array_equal(sma.estimate_jets(mesh).normals, sma.estimate_jets(points, triangles).normals)

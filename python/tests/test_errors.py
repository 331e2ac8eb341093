# SPDX-License-Identifier: GPL-3.0-or-later
"""What is refused, and how."""

import numpy as np
import pytest
from shapes import sphere, square

import surface_mesh_adaptation as sma

POINTS, TRIANGLES = sphere(2)
N = len(POINTS)


def changed(array, row, value):
    copy = np.array(array)
    copy[row] = value
    return copy


@pytest.mark.parametrize(
    "arguments, error, index, words",
    [
        ({"points": POINTS[:, :2]}, ValueError, None, r"\(n, 3\), not an array of shape \(\d+, 2\)"),
        ({"points": POINTS[0]}, ValueError, None, r"\(n, 3\)"),
        ({"points": POINTS + 1j}, TypeError, None, "real numbers"),
        ({"points": POINTS.astype(str)}, TypeError, None, "real numbers"),
        ({"points": None}, TypeError, None, "real numbers"),
        ({"triangles": TRIANGLES * 1.0}, TypeError, None, "integers"),
        ({"triangles": TRIANGLES[:, :2]}, ValueError, None, r"\(k, 3\)"),
        ({"triangles": TRIANGLES > 3}, TypeError, None, "integers"),
        ({"triangles": []}, sma.Empty_mesh_error, None, "no face"),
        ({"triangles": changed(TRIANGLES, 5, [0, 1, N])}, sma.Invalid_input_error, 5, f"0 to {N - 1}"),
        ({"triangles": changed(TRIANGLES, 5, [0, 1, -1])}, sma.Invalid_input_error, 5, f"0 to {N - 1}"),
        ({"triangles": changed(TRIANGLES, 5, [0, 0, 1])}, sma.Invalid_input_error, 5, "same vertex twice"),
        ({"points": changed(POINTS, 7, np.nan)}, sma.Non_finite_coordinate_error, 7, "not finite"),
        ({"points": changed(POINTS, 7, np.inf)}, sma.Non_finite_coordinate_error, 7, "not finite"),
        ({"points": 1e200 * POINTS}, sma.Invalid_extent_error, None, "extent"),
        ({"points": 0 * POINTS}, sma.Invalid_extent_error, None, "extent"),
        ({"size": None}, sma.Invalid_parameter_error, None, "required"),
        ({"size": -1}, sma.Invalid_parameter_error, None, "positive"),
        ({"size": np.nan}, sma.Invalid_parameter_error, None, "positive"),
        ({"size": "u"}, sma.Invalid_parameter_error, None, "no attribute 'u'"),
        ({"size": np.ones(N - 1)}, ValueError, None, rf"\({N},\)"),
        ({"size": changed(np.ones(N), 9, 0)}, sma.Invalid_metric_error, 9, "positive"),
        ({"size": changed(np.ones(N), 9, np.nan)}, sma.Invalid_metric_error, 9, "positive"),
        ({"size": lambda p: p[:, 0] * 0}, sma.Invalid_metric_error, 0, "positive"),
        ({"size": 1e-9}, sma.Mesh_too_large_error, None, "vertices"),
        ({"size": 0.01, "max_vertices": 10}, sma.Mesh_too_large_error, None, "10 are possible"),
        ({"size": None, "metric": -np.ones((N, 6))}, sma.Invalid_metric_error, 0, "positive definite"),
        ({"size": None, "metric": np.ones((N, 5))}, ValueError, None, r"3, 3\) or"),
        ({"size": None, "metric": np.tril(np.ones((N, 3, 3)))}, sma.Invalid_input_error, 0, "symmetric"),
        ({"metric": np.ones(N)}, sma.Invalid_parameter_error, None, "contradicts"),
        ({"size": None, "field": np.ones(N)}, sma.Invalid_parameter_error, None, "field needs vertices"),
        ({"size": None, "vertices": 99, "field": changed(np.ones(N), 3, np.nan)}, sma.Invalid_field_error, 3, "finite"),
        ({"size": None, "vertices": 2.5}, TypeError, None, "whole number"),
        ({"size": None, "vertices": 10**30}, sma.Invalid_parameter_error, None, "whole number"),
        ({"size": None, "curvature": 0}, sma.Invalid_parameter_error, None, "positive"),
        ({"size": None, "curvature": 0.1, "vertices": 9}, sma.Invalid_parameter_error, None, "contradicts"),
        ({"size": None, "curvature": 0.1, "hmin": 2, "hmax": 1}, sma.Invalid_parameter_error, None, "larger"),
        ({"size": None, "curvature": 0.1, "gradation": 0.5}, sma.Invalid_parameter_error, None, "at least 1"),
        ({"size": None, "curvature": 0.1, "gradation": "2"}, TypeError, None, "number"),
        ({"gradation": 1.2}, sma.Invalid_parameter_error, None, "contradict"),
        ({"feature_angle": 0}, sma.Invalid_parameter_error, None, "angle"),
        ({"feature_angle": 10, "detect_features": False}, sma.Invalid_parameter_error, None, "contradicts"),
        ({"shape_weight": 0.5}, sma.Invalid_parameter_error, None, "needs fit"),
        ({"reconstruction": "curved"}, sma.Invalid_parameter_error, None, "'patches', 'flat'"),
        ({"execution": "gpu"}, sma.Invalid_parameter_error, None, "'sequential'"),
        ({"threads": 0}, sma.Invalid_parameter_error, None, "positive"),
        ({"tolerance": -1}, sma.Invalid_parameter_error, None, "positive"),
        ({"iterations": True}, TypeError, None, "whole number"),
        ({"progress": 3}, TypeError, None, "function"),
        ({"normals": 0 * POINTS}, sma.Invalid_normal_error, 0, "not zero"),
        ({"normals": POINTS[:5]}, ValueError, None, rf"\({N}, 3\)"),
        ({"shape_operators": np.full((N, 6), np.nan)}, sma.Invalid_normal_error, None, "not finite"),
        ({"constrained_edges": [[0, N]]}, sma.Invalid_input_error, 0, "index"),
        ({"constrained_edges": [TRIANGLES[0, :2], [0, 1]]}, sma.Invalid_input_error, 1, "no edge"),
        ({"constrained_vertices": [N]}, sma.Invalid_input_error, 0, "index"),
        ({"constrained_vertices": [True]}, ValueError, None, "booleans"),
        ({"attributes": {"u": [1, 2]}}, ValueError, None, r"attributes\['u'\]"),
    ],
)
def test_refused(arguments, error, index, words):
    with pytest.raises(error, match=words) as raised:
        sma.adapt(**{"points": POINTS, "triangles": TRIANGLES, "size": 0.3, **arguments})
    if index is not None:
        assert raised.value.index == index


def test_surfaces_that_are_no_manifold():
    points, triangles = square(2)
    fin = np.concatenate([triangles, [[0, 4, len(points)]]])  # on an inner edge
    with pytest.raises(sma.Invalid_input_error, match="3 faces") as error:
        sma.adapt(np.concatenate([points, [[0, 0, 1.0]]]), fin, size=0.3)
    assert error.value.index in (0, 4)
    bow = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0.0]])
    with pytest.raises(sma.Invalid_input_error, match="single fan") as error:
        sma.adapt(bow, [[0, 1, 2], [0, 3, 4]], size=0.3)
    assert error.value.index == 0


def test_every_error_derives_from_the_base_and_from_one_of_python():
    classes = [c for c in vars(sma.errors).values() if isinstance(c, type) and issubclass(c, sma.Adaptation_error)]
    assert len(classes) == 15
    for c in classes:
        assert c is sma.Adaptation_error or issubclass(c, (ValueError, RuntimeError))


def test_what_is_accepted_is_listed():
    with pytest.raises(TypeError, match="pyvista.PolyData, a trimesh.Trimesh or a meshio.Mesh, not builtins.dict"):
        sma.adapt({}, size=1)
    with pytest.raises(TypeError, match="triangles are missing"):
        sma.adapt(POINTS, size=1)


def test_unknown_keywords_of_kernels_are_listed():
    with pytest.raises(TypeError, match="unknown keywords: sizes; known are .*anisotropic"):
        sma.refine(POINTS, TRIANGLES, sizes=1)


def test_what_a_function_of_points_raises_passes_through():
    def size(p):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        sma.adapt(POINTS, TRIANGLES, size=size)


@pytest.mark.parametrize("seed", range(30))
def test_random_input_never_crashes(seed):
    rng = np.random.default_rng(seed)
    points = rng.standard_normal((12, 3)) * 10.0 ** rng.integers(-5, 5)
    triangles = rng.integers(0, 12, (rng.integers(1, 30), 3))
    try:
        sma.adapt(points, triangles, vertices=50, repair=bool(seed % 2))
    except sma.Adaptation_error:
        pass

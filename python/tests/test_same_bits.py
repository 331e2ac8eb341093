# SPDX-License-Identifier: GPL-3.0-or-later
"""The module gives what the program adapt_mesh gives, to the last bit. SMA_ADAPT_MESH is the program."""

import os
import subprocess

import numpy as np
import pytest
from shapes import data_file, read_off, sphere, write_off

import surface_mesh_adaptation as sma

PROGRAM = os.environ.get("SMA_ADAPT_MESH")
pytestmark = pytest.mark.skipif(not PROGRAM, reason="SMA_ADAPT_MESH is not set")

OPTIONS = [
    (["--size", "0.05"], {"size": 0.05}),
    (["--curvature", "0.002"], {"curvature": 0.002}),
    (["--curvature", "0.002", "--anisotropic"], {"curvature": 0.002, "anisotropic": True}),
    (["--vertices", "2000", "--gradation", "1.4"], {"vertices": 2000, "gradation": 1.4}),
    (["--curvature", "0.002", "--flat", "--fit"], {"curvature": 0.002, "reconstruction": "flat", "fit": True}),
    (["--tolerance", "0.01", "--feature-angle", "60"], {"tolerance": 0.01, "feature_angle": 60}),
    (
        ["--curvature", "0.01", "--no-features", "--hmin", ".02", "--hmax", ".3", "--rounds", "3"],
        {"curvature": 0.01, "detect_features": False, "hmin": 0.02, "hmax": 0.3, "iterations": 3},
    ),
]


@pytest.mark.parametrize("mesh", ["sphere", "elephant.off", "blobby.off", "bunny00.off"])
@pytest.mark.parametrize("options, keywords", OPTIONS, ids=[" ".join(o) for o, _ in OPTIONS])
def test_same_bits(tmp_path, mesh, options, keywords):
    file = tmp_path / "in.off" if mesh == "sphere" else data_file(mesh)
    if file is None:
        pytest.skip("CGAL_DATA_DIR is not set")
    if mesh == "sphere":
        write_off(file, *sphere())
    expected, written = tmp_path / "expected.off", tmp_path / "written.off"
    subprocess.run([PROGRAM, file, expected, *options, "--quiet"], check=True)
    result = sma.adapt(*read_off(file), **keywords)
    write_off(written, result.points, result.triangles)
    points, triangles = read_off(expected)
    assert np.array_equal(result.triangles, triangles)
    assert np.array_equal(result.points, points)
    assert np.array_equal(read_off(written)[0], points)


def write_solution(file, values):
    """A field at vertices: scalars, or tensors of six numbers."""
    kind = 1 if values.ndim == 1 else 3
    rows = "\n".join(" ".join(f"{x:.17g}" for x in row) for row in values.reshape(len(values), -1).tolist())
    file.write_text(f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(values)}\n1 {kind}\n{rows}\nEnd\n")


def sizes(points):
    return 0.05 + 0.1 * points[:, 2] ** 2


def stretching(points):
    return np.tile([400.0, 0.0, 100.0, 0.0, 0.0, 100.0], (len(points), 1))


def wave(points):
    return np.sin(5 * points[:, 0])


@pytest.mark.parametrize(
    "option, name, values, options, keywords",
    [
        ("--metric", "metric", sizes, [], {}),
        ("--metric", "metric", sizes, ["--gradation", "1.2", "--hmin", "0.07"], {"gradation": 1.2, "hmin": 0.07}),
        ("--metric", "metric", stretching, [], {}),
        ("--metric", "metric", stretching, ["--hmax", "0.08"], {"hmax": 0.08}),
        ("--metric", "metric", stretching, ["--vertices", "900"], {"vertices": 900}),
        ("--field", "field", wave, ["--vertices", "900"], {"vertices": 900}),
        (
            "--field",
            "field",
            wave,
            ["--vertices", "900", "--curvature", "0.01", "--anisotropic", "--norm", "4"],
            {"vertices": 900, "curvature": 0.01, "anisotropic": True, "norm": 4},
        ),
    ],
)
def test_same_bits_with_a_metric_or_a_field(tmp_path, option, name, values, options, keywords):
    points, triangles = sphere()
    write_off(tmp_path / "in.off", points, triangles)
    write_solution(tmp_path / "in.sol", values(points))
    expected = tmp_path / "expected.off"
    command = [PROGRAM, tmp_path / "in.off", expected, option, tmp_path / "in.sol", *options, "--quiet"]
    subprocess.run(command, check=True)
    result = sma.adapt(points, triangles, **{name: values(points)}, **keywords)
    expected_points, expected_triangles = read_off(expected)
    assert np.array_equal(result.triangles, expected_triangles)
    assert np.array_equal(result.points, expected_points)

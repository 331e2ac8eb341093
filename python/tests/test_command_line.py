# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m surface_mesh_adaptation"""

import json
import subprocess
import sys

import numpy as np
import pytest
from shapes import sphere, square

from surface_mesh_adaptation.__main__ import main

meshio = pytest.importorskip("meshio")


@pytest.fixture
def square_file(tmp_path):
    points, triangles = square()
    data = {"u": np.tanh(10 * (points[:, 0] - 0.5)), "h": 0.05 + 0.1 * points[:, 0]}
    data["m"] = np.tile([100.0, 0, 0, 0, 25, 0, 0, 0, 1], (len(points), 1))
    mesh = meshio.Mesh(points, [("triangle", triangles)], point_data=data)
    mesh.write(tmp_path / "in.vtu")
    return tmp_path / "in.vtu"


@pytest.mark.parametrize("suffix", ["vtu", "msh", "vtk", "inp", "stl", "ply", "obj", "off", "mesh", "xdmf"])
def test_formats(square_file, tmp_path, suffix):
    if suffix == "xdmf":
        pytest.importorskip("h5py")
    out = tmp_path / f"out.{suffix}"
    assert main([str(square_file), str(out), "--size", "0.1", "--quiet"]) == 0
    assert len(meshio.read(out).cells_dict["triangle"]) > 100


@pytest.mark.parametrize(
    "options",
    [
        ["--metric", "h"],
        ["--metric", "m"],
        ["--field", "u", "--vertices", "200", "--anisotropic"],
        ["--vertices", "200"],
    ],
)
def test_data_of_the_input(square_file, tmp_path, options):
    out = tmp_path / "out.vtu"
    assert main([str(square_file), str(out), *options, "--output-metric", "metric"]) == 0
    result = meshio.read(out)
    assert set(result.point_data) == {"u", "h", "m", "metric"}
    assert result.point_data["metric"].shape == (len(result.points), 6)
    assert np.allclose(result.point_data["h"], 0.05 + 0.1 * result.points[:, 0], atol=1e-3)


def test_reports(square_file, tmp_path):
    out = str(tmp_path / "out.vtu")
    for name in ("report.json", "report.html"):
        assert main([str(square_file), out, "--size", "0.1", "--report", str(tmp_path / name)]) == 0
    assert json.loads((tmp_path / "report.json").read_text())["final"]["vertices"] == len(meshio.read(out).points)
    assert "<svg" in (tmp_path / "report.html").read_text()


@pytest.mark.parametrize(
    "options, status, words",
    [
        ([], 2, "required"),
        (["--size", "-1"], 2, "positive"),
        (["--metric", "nothing"], 2, "no point data 'nothing', but: u, h, m"),
        (["--size", "0.1", "--curvature", "0.1"], 2, "contradict"),
    ],
)
def test_wrong_usage(square_file, tmp_path, capsys, options, status, words):
    assert main([str(square_file), str(tmp_path / "out.vtu"), *options]) == status
    assert words in capsys.readouterr().err
    assert not (tmp_path / "out.vtu").exists()


def test_unusable_input(tmp_path, capsys):
    (tmp_path / "in.vtk").write_text("nothing")
    assert main([str(tmp_path / "in.vtk"), str(tmp_path / "out.vtu"), "--size", "1"]) == 3
    assert main([str(tmp_path / "none.vtk"), str(tmp_path / "out.vtu"), "--size", "1"]) == 3
    assert main([str(tmp_path / "in.unknown"), str(tmp_path / "out.vtu"), "--size", "1"]) == 3


def test_as_a_program(tmp_path):
    points, triangles = sphere()
    meshio.Mesh(points, [("triangle", triangles)]).write(tmp_path / "in.stl")
    command = [sys.executable, "-m", "surface_mesh_adaptation", tmp_path / "in.stl", tmp_path / "out.msh"]
    run = subprocess.run([*command, "--curvature", "0.002"], capture_output=True, text=True)
    assert run.returncode == 0 and "edges in range" in run.stdout, run.stderr

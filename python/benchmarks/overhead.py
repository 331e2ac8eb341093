# SPDX-License-Identifier: GPL-3.0-or-later
"""What Python adds to an adaptation: time beside that of the C++ functions, memory beside that of adapt_mesh.

    CGAL_DATA_DIR=... python overhead.py path/to/adapt_mesh [MESH [VERTICES]]

The mesh is a file of CGAL's data, brought to a number of vertices first. Each run is a process of its own.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

import numpy as np
from shapes import read_off, write_off

import surface_mesh_adaptation as sma


def peak():
    """The largest memory that this program has used, in bytes. (What getrusage says begins with that of the parent.)"""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM"))


def run_in_python(file, keywords):
    """In this process: prints seconds and bytes."""
    with np.load(file) as arrays:
        points, triangles = arrays["points"], arrays["triangles"]
    before = peak()
    start = time.perf_counter()
    result = sma.adapt(points, triangles, threads=1, **keywords)
    seconds = time.perf_counter() - start
    arrays = [
        points,
        triangles,
        result.points,
        result.triangles,
        result.metric,
        result.source_points,
        result.source_weights,
    ]
    print(json.dumps({
        "seconds": seconds, "functions": result.seconds, "kernels": result.report.seconds, "memory": peak() - before,
        "arrays": sum(a.nbytes for a in arrays), "vertices": len(result.points),
    }))  # fmt: skip


def run_program(program, file, options, folder):
    """adapt_mesh: its own seconds, and all the memory of its process."""
    report = folder / "report.json"
    command = [program, file, folder / "out.off", *options, "--threads", "1", "--quiet", "--report", report]
    process = subprocess.Popen([str(c) for c in command])
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0
    return json.loads(report.read_text())["seconds"], 1024 * usage.ru_maxrss


def in_a_process(*arguments):
    """This file with arguments, in a process of its own, so that this one stays small."""
    command = [sys.executable, __file__, *map(str, arguments)]
    return json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)


def prepare(mesh, vertices, folder):
    """Brings a mesh to a number of vertices: prints the size of its edges."""
    points, triangles = read_off(Path(os.environ["CGAL_DATA_DIR"]) / "meshes" / mesh)
    fine = sma.adapt(points, triangles, metric=np.ones(len(points)), vertices=vertices)
    np.savez(folder / "in.npz", points=fine.points, triangles=fine.triangles)
    write_off(folder / "in.off", fine.points, fine.triangles)
    print(json.dumps({"size": float(fine.metric[0, 0, 0] ** -0.5), "vertices": len(fine.points)}))


def compare(program, name, vertices, folder, options, keywords):
    runs = []
    for _ in range(3):
        own, memory = run_program(program, folder / "in.off", options, folder)
        runs.append((in_a_process("--run", folder / "in.npz", json.dumps(keywords)), own, memory))
    best = min(runs, key=lambda r: r[0]["seconds"] / r[0]["functions"])
    python, _, memory = best
    own, kernels = min(r[1] for r in runs), min(r[0]["kernels"] for r in runs)
    print(f"| {name} | {vertices} | {python['vertices']} | {own:.2f} | {kernels:.2f} | {python['functions']:.2f} "
          f"| {python['seconds']:.2f} | {100 * (python['seconds'] / python['functions'] - 1):.1f} % "
          f"| {memory / 2**20:.0f} | {python['memory'] / 2**20:.0f} | {python['arrays'] / 2**20:.0f} |")  # fmt: skip


def main():
    program = sys.argv[1]
    mesh = sys.argv[2] if len(sys.argv) > 2 else "bunny00.off"
    vertices = int(sys.argv[3]) if len(sys.argv) > 3 else 150000
    print("| task | vertices in | out | adapt_mesh: kernels, s | Python: kernels, s | functions, s | call, s "
          "| overhead | adapt_mesh, MiB | Python, MiB more | arrays, MiB |\n|" + 11 * "---|")  # fmt: skip
    with tempfile.TemporaryDirectory() as name:
        prepared = in_a_process("--prepare", mesh, vertices, name)
        size = prepared["size"]
        tasks = [(f"size {f}", ["--size", repr(f * size)], {"size": f * size}) for f in (0.8, 1.0, 1.5)]
        tasks.append(("curvature", ["--curvature", "0.0001"], {"curvature": 0.0001}))
        for task, options, keywords in tasks:
            compare(program, task, prepared["vertices"], Path(name), options, keywords)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--run"]:
        run_in_python(sys.argv[2], json.loads(sys.argv[3]))
    elif sys.argv[1:2] == ["--prepare"]:
        prepare(sys.argv[2], int(sys.argv[3]), Path(sys.argv[4]))
    else:
        main()

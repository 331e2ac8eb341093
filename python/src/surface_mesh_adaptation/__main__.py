# SPDX-License-Identifier: GPL-3.0-or-later
"""``python -m surface_mesh_adaptation in.vtu out.msh --curvature 0.001``: adapt_mesh on all formats of meshio."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import __version__
from .errors import Adaptation_error, Invalid_input_error, Invalid_parameter_error
from .functions import adapt
from .result import Result

_DONE, _FAILED, _BAD_USAGE, _BAD_INPUT = 0, 1, 2, 3


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m surface_mesh_adaptation",
        description="Adapts the triangulated surface in INPUT to a metric and writes it to OUTPUT, in any format that "
        "meshio knows. One of --size, --curvature, --metric, --field, --vertices and --tolerance is required.",
        epilog="Exit status: 0 done, 1 failed, 2 wrong usage, 3 unusable input.",
        allow_abbrev=False,
    )
    add = parser.add_argument
    add("input", metavar="INPUT", type=Path)
    add("output", metavar="OUTPUT", type=Path)
    add("--size", metavar="H", type=float, help="uniform target edge length")
    add("--curvature", metavar="EPS", type=float, help="sizes from the curvature, which aim at a distance to the "
        "surface of EPS times the diagonal of the bounding box")  # fmt: skip
    add("--metric", metavar="NAME", help="the point data of the input with sizes (1 value) or tensors (6 or 9 values)")
    add("--field", metavar="NAME", help="the point data of the input of which the interpolation error is to be small")
    add("--norm", metavar="P", type=float, help="the L^P norm in which --field measures the error (default: 2)")
    add(
        "--anisotropic",
        action="store_true",
        help="stretch the faces where the surface bends, or the field varies, less",
    )
    add("--vertices", metavar="N", type=int, help="number of vertices to aim at")
    add("--max-vertices", metavar="N", type=int, help="refuse what needs more vertices than these")
    add("--hmin", metavar="H", type=float, help="lower bound on the sizes")
    add("--hmax", metavar="H", type=float, help="upper bound on the sizes")
    add("--gradation", metavar="R", type=float, help="largest ratio of the sizes at two points one size apart")
    add("--feature-angle", metavar="DEG", type=float, help="edges whose faces meet at a larger angle are kept sharp")
    add("--no-features", dest="detect_features", action="store_false", help="do not look for sharp edges")
    add("--smooth-borders", action="store_true", help="keep the outlines of the planes of a CAD tessellation")
    add("--tolerance", metavar="EPS", type=float, help="certify that the distance between input and output is below "
        "EPS times the diagonal of the bounding box")  # fmt: skip
    add("--no-self-intersections", dest="avoid_self_intersections", action="store_true",
        help="no triangles of the output meet where those of the input do not")  # fmt: skip
    add("--flat", action="store_true", help="the triangles of the input are the surface")
    add("--fit", action="store_true", help="let the faces run through the surface")
    add("--shape-weight", metavar="W", type=float, help="what the shape of the faces counts with --fit, up to 1")
    add("--no-weld", dest="weld", action="store_false", help="leave coincident vertices apart")
    add("--repair", action="store_true", help="mend an input that is no valid surface")
    add("--rounds", dest="iterations", metavar="N", type=int, help="number of rounds of the kernels")
    add("--threads", metavar="N", type=int, help="number of threads (default: all)")
    add("--execution", metavar="WHICH", help="sequential, tbb or openmp")
    add("--output-metric", metavar="NAME", help="write the metric as point data of this name, of 6 values")
    add("--report", metavar="FILE", type=Path, help="write the report of the run, as JSON or, if FILE ends so, HTML")
    add("--quiet", action="store_true", help="print errors only")
    add("--version", action="version", version=__version__)
    return parser


_OTHERS = ("input", "output", "flat", "output_metric", "report", "quiet")


def _keywords(options: argparse.Namespace) -> dict[str, Any]:
    keywords = {name: value for name, value in vars(options).items() if name not in _OTHERS}
    keywords["reconstruction"] = "flat" if options.flat else "patches"
    return keywords


def _read(file: Path) -> Any:
    try:
        import meshio
    except ImportError as error:
        raise ImportError("files are read with meshio: pip install meshio") from error
    try:
        return meshio.read(file)
    except meshio.ReadError as error:
        raise ValueError(f"{file}: {error or 'meshio cannot read it'}") from error
    except SystemExit as error:  # of meshio, where no reader of several gets through
        raise ValueError(f"{file}: meshio cannot read it") from error


def _columns(values: Any) -> Any:
    """Tensors of nine values in a row as matrices."""
    array = np.asarray(values)
    return array.reshape(-1, 3, 3) if array.ndim == 2 and array.shape[1] == 9 else array


def _point_data(mesh: Any, name: str) -> Any:
    if name not in mesh.point_data:
        raise Invalid_parameter_error(f"there is no point data {name!r}, but: {', '.join(mesh.point_data) or 'none'}")
    return _columns(mesh.point_data[name])


def _write(options: argparse.Namespace, result: Result) -> None:
    mesh = result.mesh
    if options.output_metric and result.metric is not None:
        rows, columns = [0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2]  # xx xy yy xz yz zz
        mesh.point_data[options.output_metric] = result.metric[:, rows, columns]
    try:
        mesh.write(options.output)
    except Exception as error:  # of the writers of meshio, each has its own
        raise OSError(f"{options.output}: meshio cannot write it: {error}") from error
    if options.report and options.report.suffix.lower() in (".html", ".htm"):
        result.report.to_html(options.report, title=options.input.name)
    elif options.report:
        options.report.write_text(result.report.to_json())


def _summary(result: Result) -> None:
    initial, final = result.report.initial, result.report.final
    for warning in result.report.warnings:
        print(f"warning: {warning}", file=sys.stderr)
    print(f"{initial.vertices} -> {final.vertices} vertices, {100 * final.in_range:.2f} % of the edges in range, "
          f"mean quality {final.mean_quality:.3f}, {result.report.seconds:.2f} s")  # fmt: skip


def run(options: argparse.Namespace) -> None:
    """Does what the options say."""
    mesh = _read(options.input)
    keywords = _keywords(options)
    for name in ("metric", "field"):
        if keywords[name] is not None:
            keywords[name] = _point_data(mesh, keywords[name])
    result = adapt(mesh, **keywords, full=True)
    _write(options, result)
    if not options.quiet:
        _summary(result)


def main(arguments: Sequence[str] | None = None) -> int:
    """The program; returns the exit status."""
    options = _parser().parse_args(arguments)
    try:
        run(options)
    except Invalid_parameter_error as error:
        return _complain(error, _BAD_USAGE)
    except (Invalid_input_error, OSError, ValueError) as error:
        return _complain(error, _BAD_INPUT)
    except (Adaptation_error, ImportError, MemoryError) as error:
        return _complain(error, _FAILED)
    except KeyboardInterrupt:
        return _complain("interrupted, nothing was written", _FAILED)
    return _DONE


def _complain(what: object, status: int) -> int:
    print(f"surface_mesh_adaptation: {what}", file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(main())

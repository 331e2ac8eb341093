# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run did and what it reached."""

from __future__ import annotations

import dataclasses
import json
import re
from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from .result import Result

T = TypeVar("T")


def _of(cls: type[T], values: dict[str, Any]) -> T:
    """An object of a dataclass, of the values that it knows."""
    names = {f.name for f in dataclasses.fields(cls)}  # type: ignore[arg-type]
    return cls(**{name: value for name, value in values.items() if name in names})


@dataclass
class MeshStatistics:
    """Size, conformity and quality of a mesh with respect to a metric."""

    vertices: int = 0
    edges: int = 0
    faces: int = 0
    in_range: float = 0.0  #: share of the edges with a metric length in [1/sqrt 2, sqrt 2]
    mean_length: float = 0.0  #: of the edges, in the metric
    mean_quality: float = 0.0  #: of the faces, in the metric: 1 is best
    min_quality: float = 0.0
    min_angle: float = 0.0  #: smallest angle of a face, in degrees
    quality_histogram: list[int] = field(default_factory=list)  #: faces in [i/10, (i + 1)/10)
    length_histogram: list[int] = field(default_factory=list)  #: edges in [i/5, (i + 1)/5), last: above


@dataclass
class KernelReport:
    """One call of a kernel."""

    kernel: str
    round: int = 0
    sweeps: int = 0
    candidates: int = 0
    applied: int = 0
    deferred: int = 0
    seconds: float = 0.0


@dataclass
class SelfIntersectionCounts:
    """Pairs of triangles that meet in more than the vertices and edges that they share."""

    before: int = 0  #: in the input
    after: int = 0  #: in the result
    seconds: float = 0.0  #: that counting took


@dataclass
class Report:
    """The report of an adaptation."""

    execution: str = ""
    threads: int = 1
    rounds: int = 0
    stopped: bool = False  #: by `progress`
    seconds: float = 0.0  #: that the kernels took
    initial: MeshStatistics = field(default_factory=MeshStatistics)  #: the input, in the metric asked for
    final: MeshStatistics = field(default_factory=MeshStatistics)  #: the result
    after_round: list[MeshStatistics] = field(default_factory=list)
    kernels: list[KernelReport] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)  #: what was asked for and not reached
    repairs: list[str] = field(default_factory=list)  #: what was mended in the input
    fallback_patches: int = 0
    tolerance: float = 0.0  #: a length; 0: none was asked for
    certified_distance: float = 0.0  #: if one was: an upper bound of the Hausdorff distance
    deviation: float = 0.0  #: with `curvature`: largest distance from the surface at some places of each face
    self_intersections: SelfIntersectionCounts | None = None  #: if they were counted
    _result: Result | None = field(default=None, repr=False, compare=False)

    @classmethod
    def from_dict(cls, values: dict[str, Any]) -> Report:
        """The report of which `to_dict` gave `values`."""
        report = _of(cls, {k: v for k, v in values.items() if not k.startswith("_")})
        report.initial = _of(MeshStatistics, values.get("initial", {}))
        report.final = _of(MeshStatistics, values.get("final", {}))
        report.after_round = [_of(MeshStatistics, s) for s in values.get("after_round", [])]
        counts = values.get("self_intersections")
        report.self_intersections = _of(SelfIntersectionCounts, counts) if counts else None
        report.kernels = [_of(KernelReport, k) for k in values.get("kernels", [])]
        return report

    @classmethod
    def from_json(cls, text: str) -> Report:
        """The report of which `to_json` gave `text`, or the C++ library."""
        text = re.sub(r'": (-?)inf\b', r'": \1Infinity', text)
        return cls.from_dict(json.loads(re.sub(r'": -?nan\b', '": NaN', text)))

    def to_dict(self) -> dict[str, Any]:
        """All numbers, as dictionaries and lists."""
        plain = dataclasses.replace(self, _result=None)
        values = dataclasses.asdict(plain)
        del values["_result"]
        return values

    def to_json(self, indent: int | None = 2) -> str:
        """All numbers, as text."""
        return json.dumps(self.to_dict(), indent=indent)

    def to_html(self, file: str | PathLike[str], *, title: str = "Surface mesh adaptation") -> None:
        """Writes one page with all there is to say, which needs no other file.

        Histograms of lengths, qualities and angles, the rounds, warnings, and pictures of the mesh before and after if
        pyvista is installed.

        Parameters
        ----------
        file : path
            Where to write.
        title : str
            The heading.
        """
        from ._html import page

        text = page(self, self._result, title)
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)

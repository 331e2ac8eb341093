# SPDX-License-Identifier: GPL-3.0-or-later
"""The report as one page."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from ._plot import angles, plotter

if TYPE_CHECKING:
    from .report import MeshStatistics, Report
    from .result import Result

_STYLE = """
body { font: 15px/1.45 sans-serif; max-width: 72em; margin: 2em auto; padding: 0 1em; color: #222; }
table { border-collapse: collapse; margin: 1em 0; } td, th { padding: .2em .8em; text-align: right; }
th { border-bottom: 1px solid #999; } td:first-child, th:first-child { text-align: left; }
figure { display: inline-block; margin: 1em 1.5em 1em 0; } figcaption { font-size: 13px; }
img { max-width: 100%; } .warning { background: #fff3cd; padding: .4em .8em; margin: .3em 0; }
"""


def _histogram(title: str, labels: Sequence[str], counts: Sequence[int]) -> str:
    """Bars as inline SVG, of shares of the whole."""
    width, height, total = 360, 120, max(1, sum(counts))
    step, top = width / max(1, len(counts)), max(1, max(counts, default=1))
    bars = []
    for i, (label, count) in enumerate(zip(labels, counts)):
        h = height * count / top
        bars.append(
            f'<rect x="{i * step + 1:.1f}" y="{height - h:.1f}" width="{step - 2:.1f}" height="{h:.1f}" fill="#4472a8">'
            f"<title>{escape(label)}: {count} ({100 * count / total:.2f} %)</title></rect>"
            f'<text x="{(i + 0.5) * step:.1f}" y="{height + 14}" font-size="10" text-anchor="middle">'
            f"{escape(label)}</text>"
        )
    svg = f'<svg width="{width}" height="{height + 20}" role="img" aria-label="{escape(title)}">{"".join(bars)}</svg>'
    return f"<figure>{svg}<figcaption>{escape(title)}</figcaption></figure>"


def _table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    def row(tag: str, cells: Sequence[Any]) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(str(c))}</{tag}>" for c in cells) + "</tr>"

    return f"<table>{row('th', head)}{''.join(row('td', r) for r in rows)}</table>"


def _statistics_row(name: str, s: MeshStatistics) -> list[Any]:
    return [name, s.vertices, s.faces, f"{100 * s.in_range:.2f} %", f"{s.mean_length:.3f}", f"{s.mean_quality:.3f}",
            f"{s.min_quality:.3f}", f"{s.min_angle:.1f}"]  # fmt: skip


def _statistics(report: Report) -> str:
    rows = [_statistics_row("input", report.initial)]
    rows += [_statistics_row(f"round {i + 1}", s) for i, s in enumerate(report.after_round)]
    rows.append(_statistics_row("result", report.final))
    return _table(
        ["", "vertices", "faces", "edges in range", "mean length", "mean quality", "worst", "least angle"], rows
    )


def _histograms(report: Report, result: Result | None) -> str:
    final, n = report.final, len(report.final.length_histogram)
    lengths = [f"{i / 5:.1f}" for i in range(n)]
    parts = [
        _histogram("lengths of the edges in the metric, from", lengths, final.length_histogram),
        _histogram("qualities of the faces, from", [f"{i / 10:.1f}" for i in range(10)], final.quality_histogram),
    ]
    if result is not None:
        bounds = np.arange(0, 181, 15)
        counts, _ = np.histogram(angles(result.points, result.triangles), bounds)
        parts.append(_histogram("angles of the faces in degrees, from", [str(b) for b in bounds[:-1]], counts.tolist()))
    return "".join(parts)


def _picture(result: Result | None) -> str:
    """The mesh before and after; nothing where pictures cannot be drawn."""
    if result is None or result.input is None:
        return ""
    try:
        window = plotter(result, "quality", off_screen=True)
        image = window.screenshot(return_img=True)
        window.close()
        from PIL import Image
    except Exception:  # no pyvista, or no way to draw: the page has everything else
        return ""
    png = io.BytesIO()
    Image.fromarray(image).save(png, "PNG")
    return f'<img alt="before and after" src="data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}">'


def _kernels(report: Report) -> str:
    head = ["kernel", "round", "sweeps", "candidates", "applied", "seconds"]
    rows = ([k.kernel, k.round + 1, k.sweeps, k.candidates, k.applied, f"{k.seconds:.3f}"] for k in report.kernels)
    return _table(head, rows)


def page(report: Report, result: Result | None, title: str) -> str:
    """The whole page."""
    stopped = ["stopped before it was done"] if report.stopped else []
    notes = "".join(f'<p class="warning">{escape(w)}</p>' for w in [*stopped, *report.warnings, *report.repairs])
    run = f"{report.rounds} rounds, {report.seconds:.2f} s on {report.threads} threads ({report.execution})"
    if report.tolerance > 0:
        run += f"; distance certified to be at most {report.certified_distance:.4g} (tolerance {report.tolerance:.4g})"
    body = [
        f"<h1>{escape(title)}</h1><p>{escape(run)}</p>", notes, _picture(result), _histograms(report, result),
        "<h2>Rounds</h2>", _statistics(report), "<h2>Kernels</h2>", _kernels(report),
    ]  # fmt: skip
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{_STYLE}</style>'
    return f'<!DOCTYPE html><html lang="en"><head>{head}</head><body>{"".join(body)}</body></html>'

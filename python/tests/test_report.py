# SPDX-License-Identifier: GPL-3.0-or-later
"""The report, as numbers, text and a page; pictures."""

import json
import re

import numpy as np
import pytest
from shapes import sphere

import surface_mesh_adaptation as sma


@pytest.fixture(scope="module")
def result():
    points, triangles = sphere()
    return sma.adapt(points, triangles, size=0.1, attributes={"x": points[:, 0]})


def test_the_report_agrees_with_the_mesh(result):
    final = result.report.final
    assert (final.vertices, final.faces) == (len(result.points), len(result.triangles))
    assert sum(final.quality_histogram) == final.faces and sum(final.length_histogram) == final.edges
    assert {k.kernel for k in result.report.kernels} >= {"refine", "simplify", "swap", "relocate"}


def test_dictionaries_and_json_keep_everything(result):
    values = result.report.to_dict()
    assert json.loads(result.report.to_json()) == values
    assert sma.Report.from_dict(values) == result.report
    assert sma.Report.from_json(result.report.to_json()) == result.report


def test_numbers_have_all_digits(result):
    assert result.report.final.mean_length != float(f"{result.report.final.mean_length:.12g}")


def test_what_json_does_not_know():
    report = sma.Report.from_json(
        '{"seconds": inf, "warnings": ["a \\"x\\": inf"], "final": {"min_angle": -nan}, "new": 1}'
    )
    assert report.seconds == float("inf") and np.isnan(report.final.min_angle)


def test_the_page_needs_nothing_else(result, tmp_path):
    file = tmp_path / "report.html"
    result.report.warnings.append("a <warning>")
    result.report.to_html(file, title="My <mesh>")
    result.report.warnings.pop()
    text = file.read_text()
    assert "a &lt;warning&gt;" in text and "My &lt;mesh&gt;" in text
    assert text.count("<svg") == 3 and "round 1" in text
    assert not re.search(r'(src|href)="(?!data:)', text)


def test_a_page_without_a_mesh(result, tmp_path):
    report = sma.Report.from_json(result.report.to_json())
    report.to_html(tmp_path / "report.html")
    assert (tmp_path / "report.html").read_text().count("<svg") == 2


@pytest.mark.parametrize("color_by", ["size", "quality", "x"])
def test_plot(result, tmp_path, color_by):
    pytest.importorskip("pyvista")
    from surface_mesh_adaptation import _plot

    window = _plot.plotter(result, color_by, off_screen=True)
    assert len(window.renderers) == 2 and all(r.actors for r in window.renderers)
    window.close()
    with pytest.raises(ValueError, match="'size', 'quality', 'x'"):
        _plot.plotter(result, "y", off_screen=True)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples run, and leave their pictures."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("pyvista")
pytest.importorskip("scipy")

EXAMPLES = sorted((Path(__file__).parent.parent / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda e: e.stem)
def test_example(example, tmp_path):
    run = subprocess.run([sys.executable, example, tmp_path], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    print(run.stdout)
    assert (tmp_path / f"{example.stem}.png").stat().st_size > 10_000

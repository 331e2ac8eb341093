# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress, interrupts and threads."""

import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from shapes import check_manifold, sphere

import surface_mesh_adaptation as sma


def test_progress_tells_of_rounds_and_kernels():
    points, triangles = sphere()
    events = []
    result = sma.adapt(points, triangles, size=0.05, progress=lambda p: events.append(p))
    rounds = [p for p in events if p.event == "round"]
    assert len(rounds) == len(result.report.after_round)
    assert rounds[-1].vertices == result.report.after_round[-1].vertices
    assert {p.kernel for p in events if p.event == "kernel"} >= {"refine", "simplify", "swap", "relocate"}
    assert [p.round for p in events if p.event == "round begins"] == list(range(len(rounds)))


def test_false_stops_with_a_valid_mesh():
    points, triangles = sphere()
    result = sma.adapt(points, triangles, size=0.05, progress=lambda p: p.event != "round")
    check_manifold(result, 2)
    assert result.report.stopped and result.report.rounds <= 2  # the next kernel of the second round is the last
    at_once = sma.adapt(points, triangles, size=0.05, progress=lambda p: False)
    check_manifold(at_once, 2)
    assert at_once.report.stopped
    assert at_once.metric is None or (np.linalg.det(at_once.metric) > 0).all()


def test_anything_but_false_goes_on():
    points, triangles = sphere(2)
    for answer in (None, 0, "", True):
        assert not sma.adapt(points, triangles, size=0.2, progress=lambda p, a=answer: a).report.stopped


def test_an_exception_of_progress_passes_through():
    points, triangles = sphere()

    def fail(p):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        sma.adapt(points, triangles, size=0.05, progress=fail)


def test_an_exception_counts_more_than_a_missed_tolerance():
    points, triangles = sphere()

    def fail(p):
        if p.event == "kernel":
            raise LookupError("mine")

    with pytest.raises(LookupError):
        sma.adapt(points, triangles, size=0.5, tolerance=1e-6, progress=fail)


def test_a_bar_is_shown(capsys):
    pytest.importorskip("tqdm")
    points, triangles = sphere(2)
    sma.adapt(points, triangles, size=0.1, progress=True)
    assert "in_range" in capsys.readouterr().err


def test_kernels_alone_can_be_stopped():
    points, triangles = sphere(3)
    result = sma.refine(points, triangles, size=0.01, progress=lambda p: False)
    check_manifold(result, 2)
    assert len(result.points) < 1e5


def test_threads_adapt_their_own_meshes():
    points, triangles = sphere()
    sizes = [0.03, 0.04, 0.05]
    expected = [sma.adapt(points, triangles, size=s).points for s in sizes]
    results = [None] * len(sizes)

    def work(i):
        results[i] = sma.adapt(points, triangles, size=sizes[i], progress=lambda p: None).points

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(sizes))]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    for r, e in zip(results, expected):
        assert np.array_equal(r, e)


def test_the_interpreter_works_meanwhile():
    points, triangles = sphere()
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    sma.adapt(points, triangles, size=0.02, threads=1)
    end = time.perf_counter()
    done.set()
    thread.join()
    assert sum(start < t < end for t in ticks) > 10


_INTERRUPTED = """
import signal, sys, time, numpy as np
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell may have had the background ignore it
sys.path.insert(0, {folder!r})
from shapes import sphere
import surface_mesh_adaptation as sma
points, triangles = sphere(5)
before = points.copy()
print("ready", flush=True)
try:
    sma.{function}(points, triangles, size=0.002, max_vertices=10**8)
except KeyboardInterrupt:
    print("interrupted", time.time(), np.array_equal(points, before), flush=True)
    print(len(sma.adapt(points, triangles, size=0.2).points), flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("function", ["adapt", "refine"])
def test_an_interrupt_ends_the_run(function):
    import pathlib

    script = _INTERRUPTED.format(folder=str(pathlib.Path(__file__).parent), function=function)
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    time.sleep(1.0)
    sent = time.time()
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=120)
    words = out.split()
    assert words[0] == "interrupted" and words[2] == "True" and int(words[3]) > 0
    print("seconds from signal to exception:", float(words[1]) - sent)

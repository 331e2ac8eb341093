# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a run is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass
class Progress:
    """What a run tells, to a function that may stop it by returning False."""

    event: str  #: "round begins", "kernel", "round", or "working": nothing new, about every twentieth of a second
    round: int = 0  #: from 0
    rounds: int = 0  #: at most
    kernel: str | None = None  #: after a "kernel": its name
    applied: int | None = None  #: and what it did
    vertices: int | None = None  #: after a "round": of the mesh
    in_range: float | None = None  #: share of its edges that are as long as asked for
    quality: float | None = None  #: mean of its faces


ProgressFunction = Callable[[Progress], Any]


class _Bar:
    """A bar of tqdm, with a step for each round."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            raise ImportError("progress=True needs tqdm: pip install tqdm") from error
        self.bar = tqdm(total=0, unit="round")

    def __call__(self, progress: Progress) -> None:
        if progress.event == "round begins":
            self.bar.total = progress.rounds
            self.bar.n = progress.round
            self.bar.refresh()
        elif progress.event == "round":
            self.bar.n = progress.round + 1
            self.bar.set_postfix(vertices=progress.vertices, in_range=f"{100 * (progress.in_range or 0):.1f} %")

    def close(self) -> None:
        self.bar.close()


class Follower:
    """`progress` as users give it: None, True or a function, as what the extension module calls."""

    def __init__(self, progress: bool | ProgressFunction | None) -> None:
        self.bar = _Bar() if progress is True else None
        follow = self.bar if self.bar is not None else progress
        if follow is not None and follow is not False and not callable(follow):
            raise TypeError(f"progress: expected a function, True or None, not {progress!r}")
        self.callback = (lambda **event: follow(Progress(**event))) if callable(follow) else None

    def __enter__(self) -> Callable[..., Any] | None:
        return self.callback

    def __exit__(self, *_: Any) -> None:
        if self.bar is not None:
            self.bar.close()

"""How far a file has been read, told now and then to whoever watches."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import Protocol

from mmsverify.formats.locations import Location

Passed = Callable[[int, int], None]
"""Takes the octets of the file that are passed, and the messages so far."""

FETCHING, LOOKING, AUDITING = "fetching", "looking over", "auditing"
"""The stages of a recording: if it is remote, it is fetched; it is looked over as a whole, then judged."""

Stages = Callable[[str, int, int], None]
"""Takes the stage, the octets of the file that are passed in it, and the messages so far in it."""

PAUSE = 0.1
"""Seconds between two tellings, at least."""


class Tick:
    """Tells how far it is, at most ten times a second, however often it is called."""

    def __init__(self, passed: Passed | None, clock: Callable[[], float] = time.monotonic) -> None:
        self._passed, self._clock = passed, clock
        self._due = 0.0
        self._far = self._told = 0, 0
        if passed is not None:
            passed(0, 0)

    def __call__(self, octets: int, messages: int) -> None:
        """So many octets and messages are passed."""
        if self._passed is not None:
            self._far = octets, messages
            if self._clock() >= self._due:
                self._due = self._clock() + PAUSE
                self._tell(self._passed)

    def end(self) -> None:
        """That was all."""
        if self._passed is not None and self._told != self._far:
            self._tell(self._passed)

    def _tell(self, passed: Passed) -> None:
        self._told = self._far
        passed(*self._far)


class Watcher(Protocol):
    """Told of each recording; of several processes, only when one is done."""

    def begin(self, location: Location) -> None:
        """A recording is opened."""

    def passed(self, stage: str, octets: int, messages: int) -> None:
        """How far it is, some ten times a second at most."""

    def wait(self, text: str) -> None:
        """Nothing can begin yet, for the reason that is told."""

    def finish(self) -> None:
        """A recording is done, whatever became of it."""


def stage(name: str, stages: Stages | None) -> Passed | None:
    """What tells of one stage only."""
    return None if stages is None else partial(stages, name)

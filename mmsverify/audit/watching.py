"""Whoever watches an audit: what is told to them while it runs."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol

from mmsverify.formats.locations import Location
from mmsverify.formats.passing import Passed

FETCHING, LOOKING, AUDITING = "fetching", "looking over", "auditing"
"""The stages of a recording: if it is remote, it is fetched; it is looked over as a whole, then judged."""

Stages = Callable[[str, int, int], None]
"""Takes the stage, the octets of the file that are passed in it, and the messages so far in it."""


class Watcher(Protocol):
    """Told of each recording; of several processes, only when one is done."""

    def begin(self, location: Location) -> None:
        """A recording is opened."""

    def passed(self, stage: str, octets: int, messages: int) -> None:
        """How far it is, some ten times a second at most."""

    def finish(self) -> None:
        """A recording is done, whatever became of it."""


def stage(name: str, stages: Stages | None) -> Passed | None:
    """What tells of one stage only."""
    return None if stages is None else partial(stages, name)

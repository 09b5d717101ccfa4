"""The steps of a device that the tables alone have taken, until somebody asks what they have done."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from mmsverify.audit.learning.tables import PRESENT, Step
from mmsverify.formats.stretch import Stretch

Origin = tuple[int | None, int]
"""Where a mark comes from: which message passed, or ``None`` and its number before the trail."""


class Trail(Protocol):
    """Steps, each with its message in a stretch."""

    def __bool__(self) -> bool: ...

    def append(self, step: Step, at: int) -> None: ...

    def last_written(self, stretch: Stretch) -> Iterable[tuple[Step, int]]:
        """The steps that wrote something, each once, with the number of the last of its messages passed."""

    def origin(self, place: int, stretch: Stretch) -> Origin:
        """Where a mark of the state after the last step comes from."""

    def clear(self) -> None: ...


class ListedTrail:
    """A trail as two lists, which whoever follows fills by itself."""

    def __init__(self) -> None:
        self.steps: list[Step] = []
        self.places: list[int] = []

    def __bool__(self) -> bool:
        return bool(self.steps)

    def append(self, step: Step, at: int) -> None:
        """Take one step more."""
        self.steps.append(step)
        self.places.append(at)

    def last_written(self, stretch: Stretch) -> Iterable[tuple[Step, int]]:
        """As `Trail`."""
        last = dict(zip(self.steps, self.places, strict=True))
        return [(step, stretch.passed(at)) for step, at in last.items() if step.wrote]

    def origin(self, place: int, stretch: Stretch) -> Origin:
        """As `Trail`."""
        for step, at in zip(reversed(self.steps), reversed(self.places), strict=True):
            if step.sources is not None:
                place = step.sources[place]
                if place == PRESENT:
                    return stretch.passed(at), PRESENT
        return None, place

    def clear(self) -> None:
        """Forget them."""
        self.steps.clear()
        self.places.clear()

"""The steps of a device that the tables alone have taken, until somebody asks what they have done."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from mmsverify.audit.tables import PRESENT, Step

Origin = tuple[int | None, int]
"""Where a mark comes from: the offset of a message, or ``None`` and its number in the state before."""


class Trail(Protocol):
    """Steps, each with the offset of its message in the stretch."""

    def __bool__(self) -> bool: ...

    def append(self, step: Step, at: int) -> None: ...

    def last_written(self) -> Iterable[tuple[Step, int]]:
        """The steps that wrote something, each once, with the last of its messages."""

    def origin(self, place: int) -> Origin:
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

    def last_written(self) -> Iterable[tuple[Step, int]]:
        """As `Trail`."""
        last = dict(zip(self.steps, self.places, strict=True))
        return [(step, at) for step, at in last.items() if step.wrote]

    def origin(self, place: int) -> Origin:
        """As `Trail`."""
        for step, at in zip(reversed(self.steps), reversed(self.places), strict=True):
            if step.sources is not None:
                place = step.sources[place]
                if place == PRESENT:
                    return at, PRESENT
        return None, place

    def clear(self) -> None:
        """Forget them."""
        self.steps.clear()
        self.places.clear()

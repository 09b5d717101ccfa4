"""What a belief is told: the values of an event's parameters as readers take them, what is to be shown."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from mmsverify.concrete.belief.internal import Outstanding
from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.values import ABSENT, NO, YES, exactly
from mmsverify.model.sorts import Enumeration, EnumSort, Sort


@dataclass(slots=True)
class Watch:
    """An observation that was asked for: the beliefs since then, for it may show any of these instants."""

    earlier: list[list[Partial]] = field(default_factory=list)


@dataclass(slots=True)
class Asked(Watch):
    """A request and the belief when it came, whatever has happened unseen until its answer."""

    request: Outstanding = field(default_factory=lambda: Outstanding("", (), {}))


def as_known(given: Any, sort: Sort | None = None) -> Any:
    """A value as the readers take it; a member of an enumeration may be given as its word."""
    if given is None:
        return ABSENT
    if isinstance(given, bool):
        return YES if given else NO
    if isinstance(sort, EnumSort) and isinstance(given, str):
        return exactly(next(member for member in sort.members if member.value == given))
    if isinstance(given, int | Enumeration):
        return exactly(given)
    return given if isinstance(given, str) else frozenset(given)

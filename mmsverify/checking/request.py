"""What is asked of a check, made plain: which claims of a model, within which bounds."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any

from mmsverify.errors import UsageError
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.results import ProfileFinding

MOST_NAMES = 8
"""Names that an error may list."""

Progress = Callable[[str], None] | None


@dataclass(frozen=True, slots=True)
class Request:
    """``sizes``: elements of each sort (a bounded check); ``unbounded``: no search for counterexamples.

    ``depth`` bounds the steps of a search; ``timeout`` is in seconds, for each property; ``until`` is when,
    on the monotonic clock, the time of all properties that are asked for is over; ``profile`` is
    the model's table of a profile, ``None`` where the user gave none, ``judged`` what that table breaks.
    """

    properties: Sequence[str] = ()
    sizes: Mapping[str, int] | None = None
    unbounded: bool = False
    depth: int | None = None
    timeout: float | None = None
    profile: Mapping[str, Any] | None = None
    judged: Sequence[ProfileFinding] = ()
    until: float = math.inf

    def begun(self, claims: int) -> Request:
        """The request with its time running: that of so many properties."""
        return self if self.timeout is None else replace(self, until=time.monotonic() + self.timeout * claims)

    @property
    def over(self) -> bool:
        """Whether its time is over."""
        return time.monotonic() >= self.until

    def seconds_for(self, claims: int) -> float | None:
        """The seconds that a search for so many claims may take; ``None`` where there is no limit."""
        if self.timeout is None:
            return None
        return max(0.0, min(self.timeout * claims, self.until - time.monotonic()))

    def asks_for(self, claim: Claim) -> bool:
        """Whether the claim is among the properties that are named; where none is, all are."""
        return not self.properties or claim.title in map(_hyphened, self.properties)


def _hyphened(name: str) -> str:
    return name.replace("_", "-")


def require_known(properties: Sequence[str], models: Sequence[ModelData]) -> None:
    """Refuse the name of a property that no model has."""
    known = {claim.title for model in models for claim in model.claims}
    for name in map(_hyphened, properties):
        if name not in known:
            cure = _meant(name, sorted(known))
            raise UsageError(f"no property named {name!r}", place="--property", cure=cure)


def _meant(name: str, known: Sequence[str]) -> str:
    """The name that is nearest; else all of them, or some where they are many: it is to be one line."""
    near = get_close_matches(name, known, n=1)
    if near:
        return f"did you mean {near[0]}?"
    if len(known) <= MOST_NAMES:
        return f"use one of {', '.join(known) or 'none'}"
    likely = get_close_matches(name, known, n=MOST_NAMES, cutoff=0.0)
    return f"there are {len(known)}, among them {', '.join(likely)}; check without --property lists all"


def require_sorts(sizes: Mapping[str, int] | None, models: Sequence[ModelData]) -> None:
    """Refuse a scope that names a sort which no model has, or none of a sort."""
    known = sorted({sort.short for model in models for sort in model.sorts.values()})
    for sort, number in (sizes or {}).items():
        if sort not in known:
            cure = f"use {', '.join(known)}" if known else "leave the scope out: the models have no sorts"
            raise UsageError(f"no model has a sort {sort!r}", place="--scope", cure=cure)
        if number < 1:
            raise UsageError(f"{sort}={number} leaves nothing", place="--scope", cure="give 1 or more")

"""Comparisons of two values: each side is restricted to what the other allows."""

from __future__ import annotations

from collections.abc import Callable

from mmsverify.concrete.belief.nodes import Formula
from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.slots import Slot, Value
from mmsverify.concrete.belief.values import (
    NO,
    YES,
    Interval,
    Known,
    above,
    below,
    interval,
    meet,
    same,
    single,
    smaller,
    without,
)  # fmt: skip


class Same(Formula):
    """Two values are equal."""

    __slots__ = ("left", "right")

    def __init__(self, left: Value, right: Value) -> None:
        self.left, self.right = left, right
        self.reads = left.reads | right.reads

    def holds(self, state: Partial) -> int:
        return same(self.left.known(state), self.right.known(state))

    def assume(self, state: Partial, want: bool, _split: bool) -> list[Partial]:
        if not self.holds(state) & (YES if want else NO):
            return []
        narrowed: Partial | None = state
        for slot, other in ((self.left, self.right), (self.right, self.left)):
            if narrowed is not None and isinstance(slot, Slot):
                narrowed = _compared(narrowed, slot, other.known(narrowed), want)
        return [] if narrowed is None else [narrowed]


def _compared(state: Partial, slot: Slot, theirs: Known, want: bool) -> Partial | None:
    """The slot restricted to a value, or away from the one that it is."""
    now = slot.known(state)
    left = meet(now, theirs) if want else without(now, theirs) if single(theirs) else now
    if left is None:
        return None
    return state if left == now else slot.put(state, left)


class Smaller(Formula):
    """One integer is smaller than another; each bounds the other."""

    __slots__ = ("left", "right")

    def __init__(self, left: Value, right: Value) -> None:
        self.left, self.right = left, right
        self.reads = left.reads | right.reads

    def holds(self, state: Partial) -> int:
        return smaller(interval(self.left.known(state)), interval(self.right.known(state)))

    def assume(self, state: Partial, want: bool, _split: bool) -> list[Partial]:
        if not self.holds(state) & (YES if want else NO):
            return []
        narrowed: Partial | None = state
        if isinstance(self.left, Slot):
            limit = interval(self.right.known(state))[1 if want else 0]
            narrowed = _bounded(state, self.left, limit, below if want else _from)
        if narrowed is not None and isinstance(self.right, Slot):
            limit = interval(self.left.known(narrowed))[0 if want else 1]
            narrowed = _bounded(narrowed, self.right, limit, above if want else _up_to)
        return [] if narrowed is None else [narrowed]


def _from(known: Interval, limit: int | None) -> Interval | None:
    return above(known, None if limit is None else limit - 1)


def _up_to(known: Interval, limit: int | None) -> Interval | None:
    return below(known, None if limit is None else limit + 1)


def _bounded(
    state: Partial, slot: Slot, limit: int | None, cut: Callable[[Interval, int | None], Interval | None]
) -> Partial | None:
    before = interval(slot.known(state))
    left = cut(before, limit)
    if left is None:
        return None
    return state if left == before else slot.put(state, left)

"""Values about the cells of known names: what is known of them in a partial state.

Names are resolved: a value knows the bits of the cells that it reads.
"""

from __future__ import annotations

from typing import Protocol

from mmsverify.concrete.belief.partial import Key, Partial, Place
from mmsverify.concrete.belief.values import Known, interval


class Value(Protocol):
    """Something that has a value in a state; ``reads`` are the bits of the cells that it depends on."""

    reads: int

    def known(self, state: Partial) -> Known:
        """What is known of the value."""


class Constant:
    """A value that does not depend on the state."""

    __slots__ = ("reads", "value")

    def __init__(self, value: Known) -> None:
        self.value = value
        self.reads = 0

    def known(self, _state: Partial) -> Known:
        """The value itself."""
        return self.value


class CellBits:
    """The value of a cell that has bits."""

    __slots__ = ("full", "reads", "shift")

    def __init__(self, place: Place) -> None:
        self.shift, self.full, self.reads = place.shift, place.full, place.bits

    def known(self, state: Partial) -> Known:
        """The values whose bits are set."""
        return state.bits >> self.shift & self.full

    def put(self, state: Partial, value: Known) -> Partial:
        """The state with the cell set."""
        assert isinstance(value, int)
        return state.with_bits(state.bits & ~self.reads | value << self.shift)


class CellBeside:
    """The value of an integer cell, or what is found out about a free choice: both stand beside the bits."""

    __slots__ = ("full", "key", "reads")

    def __init__(self, key: Key, full: Known, reads: int) -> None:
        self.key, self.full, self.reads = key, full, reads

    def known(self, state: Partial) -> Known:
        """What stands there, or everything."""
        found: Known | None = state.beside.get(self.key)
        return self.full if found is None else found

    def put(self, state: Partial, value: Known) -> Partial:
        """The state with the value set."""
        return state.put(self.key, value)


Slot = CellBits | CellBeside
"""A value of which more can be known."""


class Sum:
    """The sum or difference of two integers."""

    __slots__ = ("factor", "left", "reads", "right")

    def __init__(self, left: Value, right: Value, factor: int) -> None:
        self.left, self.right, self.factor = left, right, factor
        self.reads = left.reads | right.reads

    def known(self, state: Partial) -> Known:
        """The interval of all sums."""
        first, last = interval(self.left.known(state))
        low, high = interval(self.right.known(state))
        if self.factor < 0:
            low, high = high, low
        return (
            None if first is None or low is None else first + self.factor * low,
            None if last is None or high is None else last + self.factor * high,
        )

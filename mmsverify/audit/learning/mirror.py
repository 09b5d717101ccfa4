"""States, steps and classes as arrays, for the kernel: what the tables hold, as far as it was met.

Filled where the loops stop at something that the tables know; when it is full, it is filled anew.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

import numba
import numpy as np

from mmsverify.audit.learning import kernel_loops as loops
from mmsverify.audit.learning.classes import ERROR
from mmsverify.audit.learning.learned import Listener
from mmsverify.audit.learning.tables import MOST_MARKS, State, Step, Tables

STATES, POOL = 1 << 13, 1 << 22
_SLOTS = 1 << 16
"""Of the tables for classes and for steps, of which half are used."""
_CHANNELS = 1 << 16
DEVICES = 64


def compiled(function: Callable[..., Any]) -> Any:
    """A loop as machine code; kept on disk where there is a place that can be written."""
    try:
        return numba.njit(cache=True)(function)
    except RuntimeError:  # no place for it: a container that is read-only
        return numba.njit(function)


class Arrays(NamedTuple):
    """What the loops read and write, by the columns that are named there.

    ``channels`` by number; ``devices``, ``steps``, their ``moves`` and ``sources`` by number here;
    ``classes`` (their octets in the ``pool``) and ``entries`` are hash tables; ``places`` are the offsets of
    the messages passed, the ``trail`` step and device of each (-1: none), ``counts`` how many they are.
    """

    channels: Any
    devices: Any
    classes: Any
    pool: Any
    entries: Any
    steps: Any
    moves: Any
    sources: Any
    scratch: Any
    trail: Any
    places: Any
    counts: Any


@dataclass(frozen=True, slots=True)
class Code:
    """The compiled loops."""

    follow: Any = field(default_factory=lambda: compiled(loops.follow))
    last_of_each: Any = field(default_factory=lambda: compiled(loops.last_of_each))
    origin: Any = field(default_factory=lambda: compiled(loops.origin))
    put_class: Any = field(default_factory=lambda: compiled(loops.put_class))
    put_step: Any = field(default_factory=lambda: compiled(loops.put_step))


class Mirror:
    """The arrays, and what the numbers in them stand for."""

    def __init__(self) -> None:
        self.code = Code()
        self.clear()

    def clear(self) -> None:
        """Hold nothing any more."""
        self.states: list[State] = []
        self.steps: list[Step] = []
        self._states: dict[State, int] = {}
        self._steps: dict[Step, int] = {}
        self._roles: dict[int, tuple[int, object]] = {}
        self._known: dict[tuple[int, bytes], int] = {}
        self._entered: set[tuple[int, int]] = set()
        self._pooled = 0
        self._epochs: WeakKeyDictionary[Tables, int] = WeakKeyDictionary()
        self.arrays = _arrays()
        self._where = {name: array.ctypes.data for name, array in self.arrays._asdict().items()}

    def follow(self, data: bytes, at: int) -> tuple[int, int]:
        """Pass the messages that are known here: the offset of the first that is not, and why."""
        a, where = self.arrays, self._where
        octets = np.frombuffer(data, np.uint8)
        found = self.code.follow(
            octets.ctypes.data, at, len(data), where["channels"], where["devices"], where["classes"],
            where["entries"], _SLOTS - 1, where["steps"], where["moves"], where["scratch"], a.trail, a.places,
            a.counts,
        )  # fmt: skip
        return int(found[0]), int(found[1])

    @property
    def full(self) -> bool:
        """Whether there may be no room for one thing more."""
        most = max(len(self._known), len(self._entered), len(self.steps))
        return most > _SLOTS // 2 or len(self.states) > STATES - 2 or self._pooled > POOL - 4096

    def room(self, count: int) -> Arrays:
        """The arrays, with room for so many messages."""
        if len(self.arrays.places) < count:
            self.arrays = self.arrays._replace(trail=np.zeros(count, "i4"), places=np.zeros(count, "i4"))
        return self.arrays

    def stale(self, tables: Tables) -> bool:
        """Whether the tables have forgotten what they were: their classes have other numbers now."""
        return self._epochs.setdefault(tables, tables.epoch) != tables.epoch

    def state(self, state: State) -> int:
        """The number of a state."""
        return _numbered(state, self._states, self.states)

    def role(self, listener: Listener) -> int:
        """The number of a listener's classes."""
        key = id(listener.classes)
        if key not in self._roles:
            self._roles[key] = len(self._roles), listener.classes  # kept, so that no other has its identity
        return self._roles[key][0]

    def step(self, step: Step) -> int:
        """The number of a step."""
        known = len(self.steps)
        number = _numbered(step, self._steps, self.steps)
        if number == known:
            a = self.arrays
            moving, tracing = _row(a.moves[number], step.moves), _row(a.sources[number], step.sources)
            a.steps[number] = self.state(step.target), moving, tracing, -1, 0, 0, -1, 0
        return number

    def enter(self, listener: Listener, rest: bytes, state: State, event: int, step: Step) -> bool:
        """Enter a step and the class of its event; false where it is not new."""
        at, role, whole = self.state(state), self.role(listener), listener.whole or rest[0] > ERROR
        slot, new = self._class(role, rest, event >> 4, whole=whole)
        if (at, event) in self._entered:
            return new
        self._entered.add((at, event))
        number = self.step(step)
        self.code.put_step(self._where["entries"], _SLOTS - 1, at, event, number)
        self.arrays.steps[number, loops.FROM : loops.CLASS + 1] = at, event, slot
        return True

    def _class(self, role: int, rest: bytes, number: int, *, whole: bool) -> tuple[int, bool]:
        """The slot of a class, and whether that is new, or another class has taken its place."""
        key = role, rest
        new = key not in self._known
        if key not in self._known:
            size = 0 if whole else 4 + (rest[1] & 0x7F if rest[1] >= 0x80 else 0)
            head = np.uint64(loops.NONE if whole else int.from_bytes(rest[:size], "little"))
            tail, at = rest[size:], self._pooled
            self.arrays.pool[at : at + len(tail)] = np.frombuffer(tail, np.uint8)
            self._pooled += len(tail)
            where = self._where["pool"] + at
            slot = self.code.put_class(
                self._where["classes"], _SLOTS - 1, head, role, where, len(tail), number
            )
            self._known[key] = int(slot)
        slot = self._known[key]
        new = new or self.arrays.classes[slot, loops.NUMBER] != number
        self.arrays.classes[slot, loops.NUMBER] = number
        return slot, new


def _numbered(thing: Any, numbers: dict[Any, int], things: list[Any]) -> int:
    number = numbers.get(thing)
    if number is None:
        number = numbers[thing] = len(things)
        things.append(thing)
    return number


def _row(row: Any, given: tuple[int, ...] | None) -> int:
    row[: len(given or ())] = given or ()
    return loops.STAYS if given is None else len(given)


def _arrays() -> Arrays:
    def zeros(kind: str, *shape: int) -> Any:
        return np.zeros(shape, kind)

    channels, devices = zeros("i8", _CHANNELS, loops.CHANNEL_ROW), zeros("i8", DEVICES, loops.DEVICE_ROW)
    channels[:, loops.DEVICE] = devices[:, loops.STATE] = -1
    return Arrays(
        channels=channels, devices=devices, classes=zeros("i8", _SLOTS, loops.CLASS_ROW),
        pool=zeros("u1", POOL), entries=zeros("i8", _SLOTS, loops.ENTRY_ROW),
        steps=zeros("i8", _SLOTS, loops.STEP_ROW), moves=zeros("i1", _SLOTS, MOST_MARKS),
        sources=zeros("i1", _SLOTS, MOST_MARKS), scratch=zeros("i8", MOST_MARKS), trail=zeros("i4", 1),
        places=zeros("i4", 1), counts=zeros("i8", 2),
    )  # fmt: skip

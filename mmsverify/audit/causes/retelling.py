"""A conversation with one robot, told again with some messages in doubt, or with other ones in their places.

Each step is remembered: from which state of the device, by which message, to which state and with which
findings. Tellings that have come to the same state go on alike, so that of a hundred tellings that differ in
a message or two only a small part is worked out.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from mmsverify.audit.causes.doubting import Doubtful, Name
from mmsverify.audit.device import Device
from mmsverify.audit.learning.snapshots import Own, Snapshot, Snapshots
from mmsverify.audit.parts import Parts
from mmsverify.audit.telling import History, Place
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding

Told = tuple[Finding, ...]
Step = tuple[int, int, str, bytes, bool]


class SpentError(Exception):
    """So many steps were worked out that it must do."""


@dataclass(frozen=True, slots=True)
class Setting:
    """What a replay knows of a device beside its messages, as `Device` takes it."""

    place: Place
    base_only: frozenset[str] = frozenset()
    blind: tuple[tuple[int, int], ...] = ()


class Retelling:
    """States are numbers; ``NOTHING`` is that of a device of which nothing is known.

    ``names`` are those that the conversation will show: they are known from the beginning, so that states
    before and after a name is first seen mean the same.
    """

    NOTHING = 0

    def __init__(self, parts: Parts, setting: Setting, names: Iterable[Name]) -> None:
        self._snapshots = Snapshots(parts.model, Device.SHARED)
        self._own: Own = {}
        self._states: list[Snapshot] = []
        self._numbers: dict[Any, int] = {}
        self._steps: dict[Step, tuple[int, Told]] = {}
        self._left: int | None = None
        device = parts.device_of(Doubtful, setting.place, setting.base_only, setting.blind, History())
        for sort, name in names:
            device.belief.see(sort, name)
        self._live = device
        self._at = self._number(device)

    def allow(self, steps: int | None) -> None:
        """So many steps may be worked out from now on (``None``: any number); then comes ``SpentError``."""
        self._left = steps

    def step(self, state: int, message: TraceMessage, *, doubted: bool = False) -> tuple[int, Told]:
        """The state after a message, and what was found."""
        key = state, message.index, message.topic, message.data, doubted
        known = self._steps.get(key)
        if known is None:
            known = self._steps[key] = self._step(state, message, doubted)
        return known

    def _step(self, state: int, message: TraceMessage, doubted: bool) -> tuple[int, Told]:
        if self._left is not None:
            if self._left <= 0:
                raise SpentError
            self._left -= 1
        if self._at != state:
            snapshot = self._states[state]
            self._live = self._snapshots.put_back(snapshot.octets, snapshot.marks, self._own)
        self._live.history.recent.clear()  # what was told in another telling may be told again
        told = tuple(self._live.hear(message, doubted=doubted))
        self._at = self._number(self._live)
        return self._at, told

    def _number(self, device: Doubtful) -> int:
        device.settle()
        taken = self._snapshots.take(device, self._own)
        marks = tuple((m.index, m.data) if isinstance(m, TraceMessage) else int(m) for m in taken.marks)
        number = self._numbers.setdefault((taken.octets, marks), len(self._states))
        if number == len(self._states):
            self._states.append(taken)
        return number


def names_of(parts: Parts, setting: Setting, messages: Sequence[TraceMessage]) -> list[Name]:
    """The names that a conversation shows."""
    device = parts.device_of(Doubtful, setting.place, setting.base_only, setting.blind, History())
    known = len(device.names())
    for message in messages:
        for _ in device.hear(message, doubted=False):
            pass
    return list(device.names()[known:])

"""The state of a device as octets: two states that are the same octets tell the same of the same messages.

Left out are the numbers that recur in no other state (``marks``): places of messages, messages themselves,
invokeIDs. They stand beside the octets, in the order in which they are met, and can be put back in another
run of the same conversation. Also left out is what all states of a device share and none changes: the model,
formulas, the history of what was told.
"""

from __future__ import annotations

import enum
import io
import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mmsverify.audit.marks import Index, InvokeId
from mmsverify.audit.telling import History, Place
from mmsverify.concrete.belief.constraints import Constraints
from mmsverify.concrete.belief.coverage import Coverage
from mmsverify.concrete.belief.ground import Ground
from mmsverify.concrete.belief.internal import Unseen
from mmsverify.concrete.belief.partial import World
from mmsverify.concrete.belief.ready import Rows
from mmsverify.formats.trace import TraceMessage
from mmsverify.model import ModelData, Row

Mark = TraceMessage | Index | InvokeId
_SHARED = (ModelData, Row, World, Ground, Rows, Constraints, Unseen, Coverage, History, Place)
_NAMES = {TraceMessage: "message", Index: "index", InvokeId: "invoke"}


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A state: its octets, and what they leave out of it.

    ``order``: which of the messages came before which, for that may matter though their places do not.
    """

    octets: bytes
    marks: tuple[Mark, ...]
    order: tuple[int, ...]


class Snapshots:
    """Takes and puts back the states of one device."""

    def __init__(self) -> None:
        self._shared: dict[int, Any] = {}

    def take(self, state: object) -> Snapshot:
        """What a state is, as octets and marks."""
        file = io.BytesIO()
        pickler = _Pickler(file, self._shared)
        pickler.dump(state)
        marks = tuple(pickler.marks.values())
        places = [mark.index if isinstance(mark, TraceMessage) else int(mark) for mark in marks]
        order = sorted(range(len(marks)), key=places.__getitem__)
        return Snapshot(file.getvalue(), marks, tuple(n for n in order if not isinstance(marks[n], InvokeId)))

    def put_back(self, octets: bytes, marks: Sequence[Mark]) -> Any:
        """The state anew, with these marks in the places of those it was taken with."""
        return _Unpickler(io.BytesIO(octets), self._shared, marks).load()


class _Pickler(pickle.Pickler):
    def __init__(self, file: io.BytesIO, shared: dict[int, Any]) -> None:
        super().__init__(file, protocol=pickle.HIGHEST_PROTOCOL)
        self.marks: dict[tuple[str, int], Mark] = {}
        self._numbers: dict[tuple[str, int], int] = {}
        self._shared = shared

    def persistent_id(self, value: Any) -> tuple[str, int] | None:
        kind = type(value)
        if kind in _NAMES:
            key = _NAMES[kind], value.index if kind is TraceMessage else int(value)
            self.marks.setdefault(key, value)
            return "mark", self._numbers.setdefault(key, len(self._numbers))
        # Members of enumerations come from model files, which no unpickler could import.
        if isinstance(value, (*_SHARED, enum.Enum)) or kind is enum.EnumMeta:
            self._shared[id(value)] = value
            return "shared", id(value)
        return None


class _Unpickler(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, shared: dict[int, Any], marks: Sequence[Mark]) -> None:
        super().__init__(file)
        self._shared, self._marks = shared, marks

    def persistent_load(self, name: tuple[str, int]) -> Any:
        kind, number = name
        return self._marks[number] if kind == "mark" else self._shared[number]

"""The state of a device as octets: two states that are the same octets tell the same of the same messages.

Left out are the numbers that recur in no other state (``marks``): places of messages, messages themselves,
invokeIDs. They stand beside the octets, in the order in which they are met, and can be put back in another
run of the same conversation. Also left out is what all states of a device share, and what all devices do: its
world with the formulas about it, the history of what was told; the model. Of the first there is one object of
each type, so that a state of one device can be put in place of one of another.
"""

from __future__ import annotations

import enum
import io
import pickle
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from mmsverify.audit.marks import Index, InvokeId
from mmsverify.formats.trace import TraceMessage
from mmsverify.model import ModelData, Row
from mmsverify.model.sorts import EnumSort

Mark = TraceMessage | Index | InvokeId


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A state: its octets, and what they leave out of it.

    ``order``: which of the messages came before which, or are the same, for that may matter though their
    places do not.
    """

    octets: bytes
    marks: tuple[Mark, ...]
    order: tuple[int, ...]


Own = dict[type, Any]
"""What all states of one device share, by type."""


class Snapshots:
    """Takes and puts back states of devices of one model. ``own``: the types of what one device's share."""

    def __init__(self, model: ModelData, own: Iterable[type]) -> None:
        self._shared: dict[int, Any] = {}
        # Members of enumerations come from model files, which no unpickler could import.
        sorts = (sort for row in model.rows for sort in (p.of for p in row.on.parameters))
        signatures = (sort for each in model.signatures.values() for sort in (each.of, *each.sorts))
        found = (sort.members for sort in (*sorts, *signatures) if isinstance(sort, EnumSort))
        members = {type(member) for members in found for member in members}
        self._types: set[type] = {enum.EnumMeta, ModelData, Row, *members}
        self._own = {type.__name__: type for type in own}

    def take(self, state: object, own: Own) -> Snapshot:
        """What a state is, as octets and marks; ``own`` are filled in where they are met first."""
        file = io.BytesIO()
        pickler = _Pickler(file, self._shared, self._types, own, self._own.values())
        pickler.dump(state)
        marks = tuple(pickler.marks.values())
        return Snapshot(file.getvalue(), marks, _order(marks))

    def put_back(self, octets: bytes, marks: Sequence[Mark], own: Own) -> Any:
        """The state anew, with these marks in the places of those it was taken with."""
        mine = {name: own[type] for name, type in self._own.items() if type in own}
        return _Unpickler(io.BytesIO(octets), self._shared, marks, mine).load()


def _order(marks: Sequence[Mark]) -> tuple[int, ...]:
    """The rank of each message among those of the marks."""
    places = [
        mark.index if isinstance(mark, TraceMessage) else int(mark)
        for mark in marks
        if not isinstance(mark, InvokeId)
    ]
    ranks = {place: rank for rank, place in enumerate(sorted(set(places)))}
    return tuple(ranks[place] for place in places)


def _mark(number: int) -> Mark:
    raise NotImplementedError("stands for a mark in the octets")


def _same(number: int) -> Any:
    raise NotImplementedError("stands for what all devices share")


def _mine(name: str) -> Any:
    raise NotImplementedError("stands for what all states of a device share")


class _Pickler(pickle.Pickler):
    """Leaves out marks and what is shared, by a table of types: to ask for each object would take long."""

    def __init__(
        self, file: io.BytesIO, shared: dict[int, Any], types: Iterable[type], own: Own, owned: Iterable[type]
    ) -> None:
        super().__init__(file, protocol=pickle.HIGHEST_PROTOCOL)
        self.marks: dict[tuple[type, int], Mark] = {}
        self._numbers: dict[tuple[type, int], int] = {}
        self._shared, self._mine = shared, own
        self.dispatch_table = {
            **dict.fromkeys(types, self._common),
            **dict.fromkeys(owned, self._own),
            **dict.fromkeys((Index, InvokeId, TraceMessage), self._marked),
        }

    def _marked(self, value: Mark) -> tuple[Any, ...]:
        key = type(value), value.index if isinstance(value, TraceMessage) else int(value)
        self.marks.setdefault(key, value)
        return _mark, (self._numbers.setdefault(key, len(self._numbers)),)

    def _common(self, value: Any) -> tuple[Any, ...]:
        self._shared[id(value)] = value
        return _same, (id(value),)

    def _own(self, value: Any) -> tuple[Any, ...]:
        if self._mine.setdefault(type(value), value) is not value:
            raise TypeError(f"a device has a second {type(value).__name__}")
        return _mine, (type(value).__name__,)


class _Unpickler(pickle.Unpickler):
    def __init__(
        self, file: io.BytesIO, shared: dict[int, Any], marks: Sequence[Mark], own: dict[str, Any]
    ) -> None:
        super().__init__(file)
        self._instead = {
            "_mark": marks.__getitem__,
            "_same": shared.__getitem__,
            "_mine": own.__getitem__,
        }

    def find_class(self, module: str, name: str) -> Any:
        return self._instead.get(name) or super().find_class(module, name)

"""The state of a device as octets: two states that are the same octets tell the same of the same messages.

Left out are the numbers that recur in no other state (``marks``): places of messages, messages themselves,
invokeIDs; and values of messages that are nobody's business. They stand beside the octets, in the order in
which they are met, and can be put back in another run of the same conversation. Also left out is what all
states of a device share, and what all devices do: its world with the formulas about it, the history of what
was told; the model. Of the first there is one object of each type, so that a state of one device can be put
in place of one of another.
"""

from __future__ import annotations

import enum
import io
import pickle
from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

from mmsverify.audit.learning.leaves import KINDS, LEAVES, Make, Span, place_of, plain, real
from mmsverify.audit.learning.marks import Index, InvokeId
from mmsverify.concrete.belief.partial import Partial
from mmsverify.formats.trace import TraceMessage
from mmsverify.model import ModelData, Row
from mmsverify.model.sorts import EnumSort

Mark = TraceMessage | Index | InvokeId


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A state: its octets, and what they leave out of it.

    ``order``: which of the messages came before which, or are the same, for that may matter though their
    places do not. ``leafy``: it holds values of messages, which are left out, too, and stand in the messages.
    """

    octets: bytes
    marks: tuple[Mark, ...]
    order: tuple[int, ...]
    leafy: bool


Own = dict[type, Any]
"""What all states of one device share, by type."""
Looked = Set[tuple[int, Span]]
"""Values that are looked at after all, by the index of their message: a state holds them as they are."""


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

    def take(self, state: object, own: Own, looked_at: Looked = frozenset()) -> Snapshot:
        """What a state is, as octets and marks; ``own`` are filled in where they are met first."""
        return self._taken(_Pickler, state, own, looked_at)

    def compare(self, state: object, own: Own, looked_at: Looked = frozenset()) -> Snapshot:
        """The same, to be compared only: octets that do not tell the same object from an equal one."""
        return self._taken(_Comparing, state, own, looked_at)

    def _taken(self, how: type[_Pickler], state: object, own: Own, looked_at: Looked) -> Snapshot:
        file = io.BytesIO()
        pickler = how(file, self._shared, self._types, own, self._own.values())
        pickler.looked_at = looked_at
        pickler.dump(state)
        marks = tuple(pickler.marks.values())
        return Snapshot(file.getvalue(), marks, _order(marks), pickler.leafy)

    def put_back(self, octets: bytes, marks: Sequence[Mark], own: Own, make: Make = real) -> Any:
        """The state anew, with these marks in the places of those it was taken with.

        ``make`` makes its values of messages.
        """
        mine = {name: own[type] for name, type in self._own.items() if type in own}
        instead = {
            "_mark": marks.__getitem__,
            "_same": self._shared.__getitem__,
            "_mine": mine.__getitem__,
            "_leaf": lambda message, begin, end, kind: make(message, (begin, end), KINDS[kind]),
        }
        return _Unpickler(io.BytesIO(octets), instead).load()


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


def _leaf(message: TraceMessage, begin: int, end: int, kind: int) -> Any:
    raise NotImplementedError("stands for a value of a message")


class _Pickler(pickle.Pickler):
    """Leaves out marks and what is shared, by a table of types: to ask for each object would take long."""

    def __init__(
        self, file: io.BytesIO, shared: dict[int, Any], types: Iterable[type], own: Own, owned: Iterable[type]
    ) -> None:
        super().__init__(file, protocol=pickle.HIGHEST_PROTOCOL)
        self.marks: dict[tuple[type, int], Mark] = {}
        self._numbers: dict[tuple[type, int], int] = {}
        self._shared, self._mine = shared, own
        self.leafy = False
        self.looked_at: Looked = frozenset()
        self.dispatch_table = {
            **dict.fromkeys(types, self._common),
            **dict.fromkeys(owned, self._own),
            **dict.fromkeys((Index, InvokeId, TraceMessage), self._marked),
            **dict.fromkeys(LEAVES, self._leafed),
        }

    def _marked(self, value: Mark) -> tuple[Any, ...]:
        key = type(value), value.index if isinstance(value, TraceMessage) else int(value)
        self.marks.setdefault(key, value)
        return _mark, (self._numbers.setdefault(key, len(self._numbers)),)

    def _leafed(self, value: Any) -> tuple[Any, ...]:
        message, begin, end, kind = place_of(value)
        if (message.index, (begin, end)) in self.looked_at:
            return plain(message, begin, end, kind)
        self.leafy = True
        return _leaf, (message, begin, end, kind)

    def _common(self, value: Any) -> tuple[Any, ...]:
        self._shared[id(value)] = value
        return _same, (id(value),)

    def _own(self, value: Any) -> tuple[Any, ...]:
        if self._mine.setdefault(type(value), value) is not value:
            raise TypeError(f"a device has a second {type(value).__name__}")
        return _mine, (type(value).__name__,)


def _partial(bits: int, beside: list[tuple[Any, Any]]) -> Any:
    raise NotImplementedError("stands for a partial state that is only compared")


class _Comparing(_Pickler):
    """Writes what is the same object as if it were several, sets in order, no hashes that are kept."""

    def __init__(self, *args: Any) -> None:
        super().__init__(*args)
        self.fast = True
        self.dispatch_table = {**self.dispatch_table, Partial: self._bare}

    def persistent_id(self, value: Any) -> Any:
        return tuple(sorted(value, key=repr)) if type(value) in (frozenset, set) else None

    @staticmethod
    def _bare(value: Partial) -> tuple[Any, ...]:
        return _partial, (value.bits, sorted(value.beside.items(), key=itemgetter(0)))


class _Unpickler(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, instead: Mapping[str, Any]) -> None:
        super().__init__(file)
        self._instead = instead

    def find_class(self, module: str, name: str) -> Any:
        return self._instead.get(name) or super().find_class(module, name)

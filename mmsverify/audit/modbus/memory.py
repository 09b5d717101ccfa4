"""What clients wrote, held against what the next of them reads back.

Worth a note and no more: the robot's program writes outputs, internal signals and registers too, and no
message shows that. Told is only what no message explains. Whatever may have written, and does not say what
and when, makes unknown what it may have touched: writes on their way, other function codes, missing messages.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field

from mmsverify.formats.modbus import BITS, MULTIPLE, ON, SINGLE, Adu, Function, Request

_COMPARED = {Function.READ_COILS, Function.READ_HOLDING_REGISTERS}  # what the writes of the protocol write
Point = tuple[bool, int]
"""Whether it is a bit, and its address."""


@dataclass(frozen=True, slots=True)
class Written:
    """The value of one point, and the messages of the request that wrote it and of its answer."""

    unit: int
    value: int
    asked: int
    answered: int


@dataclass(slots=True)
class Memory:
    """The points whose values are known from writes, and the writes that are under way.

    Units are told apart only where it is safe: a write in one unit makes a point unknown in all of them.
    """

    _known: dict[Point, Written] = field(default_factory=dict)
    _under_way: dict[int, Request | None] = field(default_factory=dict)  # by message; ``None``: unknown ones
    _uncertain: set[int] = field(default_factory=set)
    _unsettled: set[Point] = field(default_factory=set)

    def ask(self, number: int, request: Request | None) -> None:
        """A write comes, as message ``number``: what it writes is not known until its answer.

        Nor after it, where another one that writes the same is under way: which is performed last? ``None``
        is a request that may write anything.
        """
        if request is None:
            self.lose()
        else:
            for point in _points(request):
                self._known.pop(point, None)
        for other, waiting in self._under_way.items():
            if request is None or waiting is None or _overlap(request, waiting):
                self._uncertain |= {number, other}
        self._under_way[number] = request

    def lose(self) -> None:
        """Something may have been written, anything and at any time until now."""
        self._known.clear()
        self._uncertain |= self._under_way.keys()

    def refuse(self, number: int) -> None:
        """A write was refused: what it would have written stays unknown, for it may have begun."""
        if self._under_way.pop(number, False) is None:
            self.lose()
        self._uncertain.discard(number)

    def give_up(self, number: int) -> None:
        """A write is not answered any more. It may still be performed, whenever: its points stay unknown."""
        request = self._under_way.get(number, None)
        if request is not None:
            del self._under_way[number]
            self._uncertain.discard(number)
            self._unsettled.update(_points(request))

    def accept(self, number: int, sent: Adu, answered: int) -> None:
        """A write was answered by no exception; ``sent`` is its ADU."""
        request = self._under_way.get(number)
        if request is None or number in self._uncertain:
            self.refuse(number)
            return
        del self._under_way[number]
        for point, value in zip(_points(request), _values(request, sent.data), strict=False):
            if point not in self._unsettled:
                self._known[point] = Written(sent.unit, value, number, answered)

    def read(self, request: Request, answer: Adu, asked: int) -> list[tuple[Point, int, Written]]:
        """The points whose value is not the one written last.

        Each is told once and never again: somebody else writes it, too.
        """
        if not self._known or request.function not in _COMPARED:
            return []
        found = []
        for point, value in zip(_points(request), _held(request, answer.data[1:]), strict=False):
            written = self._known.get(point)
            if written is None or written.answered >= asked or written.unit != answer.unit:
                continue
            if written.value != value:
                del self._known[point]
                self._unsettled.add(point)
                found.append((point, value, written))
        return found


def writes(request: Request) -> bool:
    """Whether a request changes anything."""
    return request.function in SINGLE | MULTIPLE


def _overlap(one: Request, other: Request) -> bool:
    same = (one.function in BITS) == (other.function in BITS)
    return (
        same and one.address < other.address + other.quantity and other.address < one.address + one.quantity
    )


def _points(request: Request) -> Iterator[Point]:
    bit = request.function in BITS
    return ((bit, request.address + at) for at in range(request.quantity))


def _values(request: Request, data: bytes) -> Iterator[int]:
    """What a write puts into its points; ``data`` are those of its ADU."""
    if request.function in SINGLE:
        return iter([int(request.value == ON) if request.function in BITS else request.value])
    return _held(request, data[5:])


def _held(request: Request, octets: bytes) -> Iterator[int]:
    if request.function in BITS:
        return (octets[at // 8] >> at % 8 & 1 for at in range(min(request.quantity, 8 * len(octets))))
    return (word for (word,) in struct.iter_unpack(">H", octets[: len(octets) & ~1]))

"""What clients wrote, held against what the next of them reads back.

Worth a note and no more: the robot's program writes outputs, internal signals and registers too, and no
message shows that. Told is only what no other message explains: every write that is on its way, every
message that may be missing and every refusal makes what it may have touched unknown.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field

from mmsverify.formats.modbus import BITS, MULTIPLE, ON, SINGLE, Adu, Function, Request

_READS = {Function.READ_COILS, Function.READ_HOLDING_REGISTERS}  # what the writes of the protocol write
Point = tuple[bool, int]  # whether it is a bit; its address


@dataclass(frozen=True, slots=True)
class Written:
    """The value of one point, and the messages of the request that wrote it and of its answer."""

    value: int
    asked: int
    answered: int


@dataclass(slots=True)
class Memory:
    """The points of one unit whose values are known from writes."""

    _known: dict[Point, Written] = field(default_factory=dict)

    def ask(self, request: Request) -> None:
        """A request comes: what it will write is not known until its answer."""
        if writes(request):
            for point in _points(request):
                self._known.pop(point, None)

    def accept(self, request: Request, data: bytes, asked: int, answered: int) -> None:
        """A write was answered by no exception; ``data`` are those of the request."""
        for point, value in zip(_points(request), _values(request, data), strict=False):
            self._known[point] = Written(value, asked, answered)

    def read(self, request: Request, answer: Adu, asked: int) -> Iterator[tuple[Point, int, Written]]:
        """The points whose value is not the one written last; each is told once."""
        if request.function not in _READS:
            return
        for point, value in zip(_points(request), _held(request, answer.data[1:]), strict=False):
            written = self._known.get(point)
            if written is not None and written.answered < asked and written.value != value:
                del self._known[point]
                yield point, value, written


def writes(request: Request) -> bool:
    """Whether a request changes anything."""
    return request.function in SINGLE | MULTIPLE


def _points(request: Request) -> Iterator[Point]:
    bit = request.function in BITS
    return ((bit, request.address + at) for at in range(request.quantity))


def _values(request: Request, data: bytes) -> Iterator[int]:
    """What a write puts into its points."""
    if request.function in SINGLE:
        single = request.function in BITS
        return iter([int(request.value == ON) if single else request.value])
    return _held(request, data[5:])


def _held(request: Request, octets: bytes) -> Iterator[int]:
    if request.function in BITS:
        return (octets[at // 8] >> at % 8 & 1 for at in range(min(request.quantity, 8 * len(octets))))
    return (word for (word,) in struct.iter_unpack(">H", octets[: len(octets) & ~1]))

"""Messages that are encoded once and written often, with new times, new invokeIDs and new values.

A `Script` is what one part of a conversation says, from its first request to its last answer. `Player` writes
scripts one after the other: requests get the invokeIDs that come next, their answers the same; where a script
says `FRESH`, four octets are written that were never written before, and where it says `NOW`, the time of
day. Everything else stays as the robot of the samples said it. Nothing is kept of what was written, so that a
recording may be of any length.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mmsverify.audit.learning.classes import split
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.samples.cell import Cell
from mmsverify.samples.recording import BEGIN

FRESH, NOW = b"\x4d\x3a\x91\x2e", b"\x02\x6e\x93\x2f"
"""What stands in a script for a value that is new each time, and for the time of day."""
_HOLE = re.compile(re.escape(FRESH) + b"|" + re.escape(NOW))
_REQUEST = 0xA0
_DAY = 86_400_000
_SPREAD = 0x9E3779B1  # odd, so that no two numbers of 29 bits give the same

Key = tuple[str, int]


@dataclass(frozen=True, slots=True)
class Line:
    """One message: what stands around its invokeID, and the pause before it in ns.

    ``request`` says which of the script's requests it is or answers, None where it has no invokeID; ``heads``
    holds what stands before an invokeID of so many octets. ``rest`` are the octets between those that are
    filled in, ``fills`` says with what.
    """

    pause: int
    channel: Channel
    request: int | None
    heads: tuple[bytes, ...]
    rest: tuple[bytes, ...]
    fills: tuple[bytes, ...]


Script = Sequence[Line]


def script(cell: Cell, *parts: Callable[[Cell], None]) -> Script:
    """What is said in some parts of a conversation."""
    recording = cell.recording
    before = recording.count
    last = recording.messages[-1][0] if before else BEGIN
    for part in parts:
        part(cell)
    lines, requests = [], dict[Key, int]()
    for time, channel, octets in recording.messages[before:]:
        lines.append(_line(time - last, channel, octets, requests))
        last = time
    return tuple(lines)


def _line(pause: int, channel: Channel, octets: bytes, requests: dict[Key, int]) -> Line:
    # Link events and what sets an association up have no invokeID.
    rest, invoke = (split(octets) if channel.message_encoding == "mms-ber" else None) or (octets, None)
    if invoke is None:
        return Line(pause, channel, None, (), tuple(_HOLE.split(rest)), tuple(_HOLE.findall(rest)))
    asks = octets[0] == _REQUEST
    sender = channel.metadata["sender"]
    key = sender if asks else {"client": "server", "server": "client"}[sender], invoke
    number = requests.setdefault(key, len(requests))
    at = 2 if octets[1] < 0x80 else 2 + (octets[1] & 0x7F)
    tag, content = octets[at], octets[at + 2 + octets[at + 1] :]
    heads = tuple(bytes((octets[0],)) + _length(2 + n + len(content)) + bytes((tag, n)) for n in range(5))
    return Line(pause, channel, number, heads, tuple(_HOLE.split(content)), tuple(_HOLE.findall(content)))


def _length(size: int) -> bytes:
    if size < 0x80:
        return bytes((size,))
    octets = size.to_bytes((size.bit_length() + 7) // 8)
    return bytes((0x80 | len(octets),)) + octets


@dataclass(slots=True)
class Player:
    """Writes scripts; ``stride`` is the distance from one invokeID to the next, of Unsigned32."""

    trace: TraceWriter
    stride: int = 1
    time: int = BEGIN
    _asked: int = 0
    _fresh: int = 0

    def play(self, lines: Script) -> None:
        """Write one script, or some of its messages."""
        first = self._asked
        for line in lines:
            self.time += line.pause
            content = self._filled(line) if line.fills else line.rest[0]
            if line.request is not None:
                invoke = (first + line.request + 1) * self.stride & 0x7FFFFFFF
                size = invoke.bit_length() // 8 + 1
                content = line.heads[size] + invoke.to_bytes(size) + content
                self._asked = max(self._asked, first + line.request + 1)
            self.trace.add(self.time, line.channel, content)

    def _filled(self, line: Line) -> bytes:
        pieces = [line.rest[0]]
        for fill, rest in zip(line.fills, line.rest[1:], strict=True):
            if fill == NOW:
                pieces += [(self.time // 1_000_000 % _DAY).to_bytes(4), rest]
            else:
                self._fresh += 1
                # From 0x20000000 on: an INTEGER of four octets, and a floating-point value that is a number.
                pieces += [(0x20000000 | self._fresh * _SPREAD & 0x1FFFFFFF).to_bytes(4), rest]
        return b"".join(pieces)

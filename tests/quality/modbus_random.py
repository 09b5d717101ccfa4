"""Random conversations with a Modbus/TCP server that keeps the rules, written from the text alone.

Clients come and go, send several requests before an answer, ask for what is not theirs; recordings may have
gaps, and the answers of some servers overtake each other.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Iterator
from pathlib import Path
from random import Random

from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel

NAME = "robot"
OUTPUTS, INPUTS, INTERNALS, REGISTERS = range(1, 961), range(1001, 1961), range(2001, 2961), range(1024)
DEDICATED = frozenset({12, 2040})
READS, WRITES = (1, 2, 3, 4), (5, 6, 15, 16)
Said = tuple[Channel, bytes]


class Line:
    """One connection: its next transaction, and the answers that are ready to be sent."""

    def __init__(self, name: str, chance: Random) -> None:
        self.name, self.unit = name, chance.randrange(256)
        self.transaction = chance.randrange(1 << 16)
        self.ready: list[bytes] = []


class Plant:
    """A server and its clients."""

    def __init__(self, seed: int) -> None:
        self.chance = Random(seed)
        self.lines: list[Line] = []
        self.made = 0
        self.in_order = seed % 3 > 0

    def talk(self, count: int) -> Iterator[Said]:
        """So many messages; then all hang up."""
        for _ in range(count):
            yield from self._next()
        for line in list(self.lines):
            yield self._link(line, self.chance.choice(["close", "reset"]))

    def _next(self) -> Iterator[Said]:
        waiting = [line for line in self.lines if line.ready]
        what = self.chance.random()
        if not self.lines or (what < 0.03 and len(self.lines) < 4):
            self.made += 1
            self.lines.append(Line(f"c{self.made}", self.chance))
            yield self._link(self.lines[-1], "open")
        elif what < 0.05:
            line = self.lines.pop(self.chance.randrange(len(self.lines)))
            yield self._link(line, self.chance.choice(["close", "reset"]))
        elif what < 0.07:
            line = self.chance.choice(self.lines)
            line.ready = [each for each in line.ready if self.chance.random() < 0.5]  # lost in the gap
            yield self._link(line, "gap")
        elif waiting and what < 0.6:
            line = self.chance.choice(waiting)
            ready = 0 if self.in_order else self.chance.randrange(len(line.ready))
            yield self._channel(line, "server"), line.ready.pop(ready)
        else:
            yield from self._ask(self.chance.choice(self.lines))

    def _link(self, line: Line, event: str) -> Said:
        return Channel.link(NAME), json.dumps(
            {"connection": line.name, "event": event, "role": "modbus"}
        ).encode()

    def _channel(self, line: Line, sender: str) -> Channel:
        return Channel.modbus(NAME, line.name, "client" if sender == "client" else "server")

    def _ask(self, line: Line) -> Iterator[Said]:
        line.transaction = (line.transaction + 1) % (1 << 16)
        function = self.chance.choice((*READS, *WRITES))
        numbers = self.chance.choice((OUTPUTS, INPUTS, INTERNALS, REGISTERS))
        first, count = self.chance.choice(numbers), self.chance.choice((1, 1, 8, 20, 90))
        request, answer = self._pdus(function, first, count)
        if self._refused(function, first, 1 if function in (5, 6) else count):
            answer = bytes([function | 0x80, 2])
        elif self.chance.random() < 0.02:
            answer = bytes([function | 0x80, 6])  # busy
        line.ready.append(_adu(line, answer))
        yield self._channel(line, "client"), _adu(line, request)

    def _pdus(self, function: int, first: int, count: int) -> tuple[bytes, bytes]:
        head = struct.pack(">BH", function, first)
        octets = (count + 7) // 8 if function in (1, 2, 15) else 2 * count
        if function in READS:
            return head + struct.pack(">H", count), bytes([function, octets]) + self.chance.randbytes(octets)
        if function in (5, 6):
            value = self.chance.choice((0, 0xFF00)) if function == 5 else self.chance.randrange(1 << 16)
            return (head + struct.pack(">H", value),) * 2
        answer = head + struct.pack(">H", count)
        return answer + bytes([octets]) + self.chance.randbytes(octets), answer

    def _refused(self, function: int, first: int, count: int) -> bool:
        asked = range(first, first + count)
        if function in (3, 4, 6, 16):
            return asked[-1] not in REGISTERS
        homes = [INPUTS] if function == 2 else [OUTPUTS, INTERNALS]
        inside = any(first in home and asked[-1] in home for home in homes)
        return not inside or (function in (5, 15) and not DEDICATED.isdisjoint(asked))


def _adu(line: Line, pdu: bytes) -> bytes:
    return struct.pack(">HHHB", line.transaction, 0, len(pdu) + 1, line.unit) + pdu


def write(path: Path, seed: int, count: int) -> Path:
    """A recording of a conversation."""
    return record(path, Plant(seed).talk(count))


def record(path: Path, said: Iterable[Said]) -> Path:
    """What was said as a recording, with the profile of its server."""
    with TraceWriter(path) as trace:
        trace.add_profile({"model": "modbus-signals", "dedicated": str(sorted(DEDICATED))})
        for number, (channel, data) in enumerate(said):
            trace.add(1_000_000 * number, channel, data)
    return path

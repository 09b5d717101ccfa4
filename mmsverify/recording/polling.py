"""A Modbus client that polls a controller: VR cells become samples, signals the ADUs that asked for them.

A client of our own, and small: a trace wants the octets of every ADU as they came, also of those that are
wrong. pymodbus, the library at hand, shows its receive buffer instead, and reads again what was read before.
"""

from __future__ import annotations

import asyncio
import struct
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from mmsverify.errors import DecodeError, UsageError
from mmsverify.formats import modbus
from mmsverify.formats.capture.faults import Fault
from mmsverify.formats.capture.link import Endpoint
from mmsverify.formats.modbus import HEADER
from mmsverify.formats.trace import Channel
from mmsverify.formats.vr import Number
from mmsverify.recording.log import Live, Log
from mmsverify.recording.points import Point, PollMap, Read
from mmsverify.recording.running import Address

_PATIENCE = 10.0  # seconds to reach the controller
_PAUSES = (0.5, 1.0, 2.0, 5.0)  # seconds before one tries again; the last for ever


class _Lost(Exception):  # noqa: N818 (no error of ours: it only leaves the loop of polls)
    """The connection is of no more use: it ended, nothing is answered, or the answer is none."""


@dataclass(slots=True)
class Poller:
    """Polls what a map lists, over one connection that is opened again when it is lost.

    ``tell`` is told what a watcher may want.
    """

    server: Address
    map: PollMap
    log: Log
    tell: Callable[[str], None]
    _transaction: int = 0
    _refused: set[Read] = field(default_factory=set)

    async def work(self) -> None:
        """Poll until cancelled. Raises ``UsageError`` where the controller cannot be reached at first."""
        try:
            line = await self._opened()
        except OSError as error:
            cause = f"cannot be reached: {_reason(error)}"
            raise UsageError(cause, place=str(self.server), cure="check address, port and cable") from None
        self.tell(f"polling {self.server} every {self.map.period:g} s; Ctrl-C ends the recording")
        while True:
            try:
                await self._polls(line)
                return
            except (_Lost, OSError) as error:
                self.tell(f"{self.server}: {_reason(error)}; connecting again")
            finally:
                await line.close()
            line = await self._again()

    async def _again(self) -> _Line:
        for pause in _endless(_PAUSES):
            await asyncio.sleep(pause)
            with suppress(OSError):
                return await self._opened()
        raise AssertionError("the pauses never end")

    async def _opened(self) -> _Line:
        opening = asyncio.open_connection(*self.server)
        reader, writer = await asyncio.wait_for(opening, _PATIENCE)
        client = Endpoint(*writer.get_extra_info("sockname")[:2])
        live = self.log.connection("modbus", client, Endpoint(*self.server))
        return _Line(reader, writer, live)

    async def _polls(self, line: _Line) -> None:
        """Poll as long as there is a trace to write to."""
        loop = asyncio.get_running_loop()
        due = loop.time()
        channel = Channel.vr(line.live.host, "polled")
        while not self.log.broken:
            await self._poll(line, channel)
            due = max(due + self.map.period, loop.time())  # one that comes late does not make the next early
            await asyncio.sleep(due - loop.time())

    async def _poll(self, line: _Line, channel: Channel) -> None:
        found: dict[tuple[str, int], int] = {}
        for read in self.map.reads():
            found |= await self._asked(line, read, recorded=False)
        cells = {
            point.cell: value for point in self.map.points if (value := _value(point, found)) is not None
        }
        if cells:
            self.log.sample(channel, cells)
        for read in self.map.signals:
            await self._asked(line, read, recorded=True)

    async def _asked(self, line: _Line, read: Read, *, recorded: bool) -> Mapping[tuple[str, int], int]:
        """What stands at the addresses of one read; nothing where the controller refuses it."""
        self._transaction = (self._transaction + 1) % 0x10000
        data = struct.pack(">HH", read.address, read.count)
        asked = HEADER.pack(self._transaction, 0, 6, self.map.unit) + bytes([read.function]) + data
        try:
            answer = await asyncio.wait_for(line.exchange(asked, recorded=recorded), self.map.timeout)
        except TimeoutError:
            raise _Lost(f"no answer to {read} in {self.map.timeout:g} s") from None
        adu = _decoded(answer)
        if adu.transaction != self._transaction:
            raise _Lost(f"transaction {adu.transaction} answered, and {self._transaction} was asked")
        if adu.exception:
            return self._refusal(line.live, read, adu)
        wrong = modbus.unlike(modbus.Request(read.function, read.address, read.count), adu)
        if adu.function != read.function or wrong:
            raise _Lost(f"the answer to {read} has {wrong or f'function code {adu.function}'}")
        return {(read.table, read.address + i): word for i, word in enumerate(_words(read, adu.data[1:]))}

    def _refusal(self, live: Live, read: Read, adu: modbus.Adu) -> Mapping[tuple[str, int], int]:
        code = adu.data[0] if adu.data else 0
        self.log.note(live.talk.name, Fault("modbus", f"{read} was refused, exception {code}"))
        if read not in self._refused:
            self._refused.add(read)
            self.tell(f"{self.server}: {read} was refused, exception {code}")
        return {}


@dataclass(slots=True)
class _Line:
    """One connection to the controller."""

    reader: asyncio.StreamReader
    writer: asyncio.StreamWriter
    live: Live

    async def exchange(self, asked: bytes, *, recorded: bool) -> bytes:
        """Send one ADU and give the next one that comes; ``recorded``: both go into the trace."""
        if recorded:
            self.live.data("client", asked)
        self.writer.write(asked)
        await self.writer.drain()
        try:
            head = await self.reader.readexactly(HEADER.size - 1)
            length = int.from_bytes(head[4:6])
            rest = await self.reader.readexactly(min(length, modbus.LARGEST_PDU + 1))
        except asyncio.IncompleteReadError as error:
            if recorded and error.partial:
                self.live.data("server", error.partial)
            raise _Lost("the controller ended the connection") from None
        if recorded:
            self.live.data("server", head + rest)
        return head + rest

    async def close(self) -> None:
        self.live.end("close")
        self.writer.close()
        with suppress(OSError):
            await self.writer.wait_closed()


def _decoded(octets: bytes) -> modbus.Adu:
    try:
        return modbus.decode(octets)
    except DecodeError as error:
        raise _Lost(f"an answer that is no ADU: {error.cause}") from None


def _words(read: Read, data: bytes) -> list[int]:
    if read.function in modbus.BITS:
        return [data[at // 8] >> at % 8 & 1 for at in range(read.count)]
    return list(struct.unpack(f">{read.count}H", data))


def _value(point: Point, found: Mapping[tuple[str, int], int]) -> Number | None:
    words = [found.get((point.table, point.address + at)) for at in range(point.size)]
    known = tuple(word for word in words if word is not None)
    return point.value(known) if len(known) == point.size else None


def _endless(pauses: tuple[float, ...]) -> Iterator[float]:
    yield from pauses
    while True:
        yield pauses[-1]


def _reason(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error) or "no answer"

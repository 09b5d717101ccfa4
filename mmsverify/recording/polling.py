"""A Modbus client that polls a controller: VR cells become samples, signals the ADUs that asked for them.

A client of our own, and small: a trace wants the octets of every ADU as they came, also of those that are
wrong. pymodbus, the library at hand, shows its receive buffer instead, and reads again what was read before.
"""

from __future__ import annotations

import asyncio
import struct
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import chain, repeat

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
    _told: set[str] = field(default_factory=set)
    _sampled: set[str] = field(default_factory=set)

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
                self.log.note(line.live.talk.name, Fault("modbus", _reason(error)))
                self.tell(f"{self.server}: {_reason(error)}; connecting again")
            finally:
                await line.close()
            line = await self._again()

    async def _again(self) -> _Line:
        for pause in chain(_PAUSES, repeat(_PAUSES[-1])):
            await asyncio.sleep(pause)
            with suppress(OSError):
                return await self._opened()
        raise AssertionError("the pauses never end")

    async def _opened(self) -> _Line:
        async with asyncio.timeout(_PATIENCE):  # not wait_for: in 3.11 it may swallow a cancellation
            reader, writer = await asyncio.open_connection(*self.server)
        client = Endpoint(*writer.get_extra_info("sockname")[:2])
        live = self.log.connection("modbus", client, Endpoint(*self.server))
        return _Line(reader, writer, live)

    async def _polls(self, line: _Line) -> None:
        """Poll as long as there is a trace to write to."""
        loop = asyncio.get_running_loop()
        due = loop.time()
        channel = Channel.vr(self.log.host, "polled")
        while not self.log.broken:
            await self._poll(line, channel)
            due = max(due + self.map.period, loop.time())  # one that comes late does not make the next early
            await asyncio.sleep(due - loop.time())

    async def _poll(self, line: _Line, channel: Channel) -> None:
        found: dict[tuple[str, int], int] = {}
        for read in self.map.reads():
            found |= await self._asked(line, read, recorded=False)
        values = {point.cell: self._value(line.live, point, found) for point in self.map.points}
        cells = {cell: value for cell, value in values.items() if value is not None}
        # A cell that is left out of a sample kept its value: that may be said only of one that never had any.
        if cells and self._sampled <= cells.keys():
            self._sampled |= cells.keys()
            self.log.sample(channel, cells)
        for read in self.map.signals:
            await self._asked(line, read, recorded=True)

    def _value(self, live: Live, point: Point, found: Mapping[tuple[str, int], int]) -> Number | None:
        words = [found.get((point.table, point.address + at)) for at in range(point.size)]
        known = tuple(word for word in words if word is not None)
        if len(known) < point.size:
            return None
        value = point.value(known)
        if value is None:
            self._amiss(live, f"{point.cell} holds no number")
        return value

    async def _asked(self, line: _Line, read: Read, *, recorded: bool) -> Mapping[tuple[str, int], int]:
        """What stands at the addresses of one read; nothing where the controller refuses it."""
        self._transaction = (self._transaction + 1) % 0x10000
        data = struct.pack(">HH", read.address, read.count)
        asked = HEADER.pack(self._transaction, 0, 6, self.map.unit) + bytes([read.function]) + data
        try:
            async with asyncio.timeout(self.map.timeout):
                answer = await line.exchange(asked, recorded=recorded)
        except TimeoutError:
            raise _Lost(f"no answer to {read} in {self.map.timeout:g} s") from None
        adu = self._answer(answer, read)
        if adu.exception:
            code = adu.data[0] if adu.data else 0
            self._amiss(line.live, f"{read} was refused, exception {code}")
            return {}
        if wrong := modbus.unlike(modbus.Request(read.function, read.address, read.count), adu):
            raise _Lost(f"the answer to {read} has {wrong}")
        return {(read.table, read.address + i): word for i, word in enumerate(_words(read, adu.data[1:]))}

    def _answer(self, octets: bytes, read: Read) -> modbus.Adu:
        """The answer to the last question; whatever else it is, the connection is of no more use."""
        try:
            adu = modbus.decode(octets)
        except DecodeError as error:
            raise _Lost(f"an answer that is no ADU: {error.cause}") from None
        found = {
            "transaction": adu.transaction,
            "unit": adu.unit,
            "function": adu.function & ~modbus.EXCEPTION,
        }
        wanted = {"transaction": self._transaction, "unit": self.map.unit, "function": int(read.function)}
        for name, number in wanted.items():
            if found[name] != number:
                raise _Lost(f"{name} {found[name]} answers, and {number} was asked")
        return adu

    def _amiss(self, live: Live, what: str) -> None:
        """Count it, and tell it once."""
        self.log.note(live.talk.name, Fault("modbus", what))
        if what not in self._told:
            self._told.add(what)
            self.tell(f"{self.server}: {what}")


@dataclass(slots=True)
class _Line:
    """One connection to the controller."""

    reader: asyncio.StreamReader
    writer: asyncio.StreamWriter
    live: Live

    async def exchange(self, asked: bytes, *, recorded: bool) -> bytes:
        """Send one ADU and give the next one that comes; ``recorded``: both go into the trace.

        What came of an answer is recorded even if the rest of it never comes.
        """
        if recorded:
            self.live.data("client", asked)
        self.writer.write(asked)
        await self.writer.drain()
        came = bytearray()
        try:
            wanted = HEADER.size - 1
            while len(came) < wanted:
                octets = await self.reader.read(wanted - len(came))
                if not octets:
                    raise _Lost("the controller ended the connection")
                came += octets
                if any(came[2:4]):
                    raise _Lost(f"an answer that is no ADU: protocol {came[2:4].hex()}")
                if len(came) == HEADER.size - 1:
                    wanted += min(int.from_bytes(came[4:6]), modbus.LARGEST_PDU + 1)
        finally:
            if recorded and came:
                self.live.data("server", bytes(came))
        return bytes(came)

    async def close(self) -> None:
        self.live.end("close")
        self.writer.close()
        with suppress(OSError):
            await self.writer.wait_closed()


def _words(read: Read, data: bytes) -> list[int]:
    if read.function in modbus.BITS:
        return [data[at // 8] >> at % 8 & 1 for at in range(read.count)]
    return list(struct.unpack(f">{read.count}H", data))


def _reason(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error) or "no answer"

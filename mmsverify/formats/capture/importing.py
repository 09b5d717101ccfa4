"""Captures and tables to a trace: what was read, and what could not be read."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from mmsverify.errors import InputError
from mmsverify.formats.capture.conversation import (
    Conversation,
    Names,
    Ports,
    channels,
    reader,
    role_of,
    server_of,
)
from mmsverify.formats.capture.faults import Fault, UnreadableError
from mmsverify.formats.capture.link import LINKS, Endpoint, Segment, segment_of
from mmsverify.formats.capture.packets import Capture, Packet
from mmsverify.formats.capture.tcp import Connection, Connections, Happening
from mmsverify.formats.csv_samples import CsvSamples, Tables, is_csv
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel, Role
from mmsverify.formats.vr import encode

SAMPLING = {
    "scan": "every scan is a row (--sampling scan)",
    "polled": "any number of scans may lie between two rows (--sampling scan, where every scan is one)",
}
"""What an audit will take the samples for."""


_PATIENCE = 4  # happenings on a connection of unknown ports after which it is nobody's


@dataclass(frozen=True, slots=True)
class Undecoded:
    """A frame that could not be read, or not wholly: its number in the capture from 1 (0: the whole file)."""

    packet: int
    layer: str
    reason: str


@dataclass(frozen=True, slots=True)
class ImportedInput:
    """What was found in one capture; the other field names are those of the JSON result.

    ``remarks``: how a table was read, a sentence each.
    """

    path: str
    frames: int
    pdus: Mapping[str, int]
    undecoded: list[Undecoded]
    remarks: tuple[str, ...] = ()


def import_captures(
    paths: Iterable[str | os.PathLike[str]],
    writer: TraceWriter,
    *,
    ports: Ports | None = None,
    hosts: Mapping[str, str] | None = None,
    tables: Tables | None = None,
) -> list[ImportedInput]:
    """Write the MMS PDUs and Modbus ADUs of captures, and the VR samples of tables, into one trace.

    Connections and controllers keep distinct names. ``hosts`` names VMDs and controllers by address
    (``10.0.0.5`` or ``10.0.0.5:102``). A file that cannot be read is reported with its reason; raises
    ``InputError`` where none could be read.
    """
    names, controllers = Names(dict(hosts or {})), _Controllers(tables or Tables())
    done: list[ImportedInput] = []
    errors: list[InputError] = []
    for path in paths:
        part = _Table(path, writer, controllers) if is_csv(path) else None
        try:
            done.append(part.run() if part else _Import(path, writer, ports or Ports(), names).run())
        except InputError as error:
            errors.append(error)
            samples = part.samples if part else 0
            done.append(ImportedInput(os.fspath(path), samples, _counts(vr=samples), [_unread(error, path)]))
    if errors and len(errors) == len(done):
        raise errors[0]
    return done


def _unread(error: InputError, path: str | os.PathLike[str]) -> Undecoded:
    """Why a file could not be read; of a table, the line, which ``place`` names after the path."""
    line = error.place.removeprefix(f"{os.fspath(path)}:")
    if line.isdecimal():
        return Undecoded(int(line), "csv", error.cause)
    told = f"{error.cause} ({error.cure})" if is_csv(path) and error.cure else error.cause
    return Undecoded(0, "file", told)


def _counts(mms: int = 0, modbus: int = 0, vr: int = 0) -> dict[str, int]:
    return {"mms": mms, "modbus": modbus, "vr": vr}


@dataclass(slots=True)
class _Controllers:
    """The names of the controllers whose tables are read: two files of one name are two controllers."""

    tables: Tables
    _taken: set[str] = field(default_factory=set)

    def channel(self, path: str | os.PathLike[str]) -> Channel:
        """The channel for the samples of one table."""
        name = self.tables.controller or self._free(Path(path).stem)
        return Channel.vr(name, self.tables.sampling)

    def _free(self, stem: str) -> str:
        names = (stem if number == 1 else f"{stem}-{number}" for number in itertools.count(1))
        name = next(name for name in names if name not in self._taken)
        self._taken.add(name)
        return name


@dataclass(slots=True)
class _Table:
    path: str | os.PathLike[str]
    writer: TraceWriter
    controllers: _Controllers
    samples: int = 0

    def run(self) -> ImportedInput:
        channel = self.controllers.channel(self.path)
        rows = CsvSamples(self.path, self.controllers.tables.asked)
        for sample in rows:
            self.writer.add(sample.time, channel, encode(sample.cells))
            self.samples += 1
        remarks = (*rows.remarks, SAMPLING[self.controllers.tables.sampling])
        return ImportedInput(os.fspath(self.path), self.samples, _counts(vr=self.samples), [], remarks)


@dataclass(slots=True)
class _Unnamed:
    """A connection of which nobody knows yet whether it is of interest."""

    waiting: list[Happening] = field(default_factory=list)
    said: dict[Endpoint, bytes] = field(default_factory=dict)
    foreign: bool = False

    def role(self, happening: Happening) -> Role | None:
        """The protocol that a side's octets are of by now, on ports where none is expected."""
        if happening.data:
            self.said[happening.source] = self.said.get(happening.source, b"") + happening.data
        return role_of(self.said.get(happening.source, b""))


@dataclass(slots=True)
class _Import:
    path: str | os.PathLike[str]
    writer: TraceWriter
    ports: Ports
    names: Names
    _faults: dict[int, Undecoded] = field(default_factory=dict)
    _unread_links: dict[int, int] = field(default_factory=dict)
    _conversations: dict[Connection, Conversation | _Unnamed] = field(default_factory=dict)
    _connections: Connections = field(default_factory=Connections)
    _frames: int = 0
    _last: Packet | None = None

    def run(self) -> ImportedInput:
        capture = Capture(self.path)
        for packet in capture:
            self._frames, self._last = packet.number, packet
            self._packet(packet)
        self._end(capture.cut)
        totals = {"mms": 0, "modbus": 0}
        for conversation in self._conversations.values():
            if isinstance(conversation, Conversation):
                totals[conversation.role] += conversation.messages
        undecoded = [self._faults[packet] for packet in sorted(self._faults)]
        return ImportedInput(os.fspath(self.path), self._frames, _counts(**totals), undecoded)

    def _packet(self, packet: Packet) -> None:
        if packet.link not in LINKS:
            self._unread_links[packet.link] = self._unread_links.get(packet.link, 0) + 1
            return
        try:
            segment = segment_of(packet)
        except UnreadableError as error:
            self._report(packet.number, error.fault)
            return
        if segment is not None:
            self._segment(segment)

    def _segment(self, segment: Segment) -> None:
        for connection, happening in self._connections.feed(segment):
            self._happening(connection, happening)
        if segment.missing and self.ports.role((segment.source, segment.target)):
            self._report(segment.packet, Fault("tcp", f"{segment.missing} octets are not in the capture"))

    def _happening(self, connection: Connection, happening: Happening) -> None:
        known = self._conversations.get(connection)
        if known is None:
            known = self._conversations[connection] = _Unnamed()
        if isinstance(known, _Unnamed):
            if known.foreign:
                return
            known = self._decide(connection, known, happening)
        if isinstance(known, Conversation):
            known.take(happening)

    def _decide(
        self, connection: Connection, unnamed: _Unnamed, happening: Happening
    ) -> Conversation | _Unnamed:
        """Begin a conversation as soon as it is clear that there is one, with all that was said before."""
        role = self.ports.role(connection.ends)
        unnamed.waiting.append(happening)
        if role is None and happening.kind == "data":
            role = unnamed.role(happening)
            unnamed.foreign = role is None and len(unnamed.waiting) > _PATIENCE
        if unnamed.foreign:
            unnamed.waiting.clear()
            unnamed.said.clear()
        if role is None or happening.kind not in ("open", "data"):
            return unnamed
        *earlier, last = unnamed.waiting
        told = last._replace(data=unnamed.said.get(last.source, last.data))
        conversation = self._conversations[connection] = self._begin(connection, role, told)
        for each in earlier:
            conversation.take(each)
        return conversation

    def _begin(self, connection: Connection, role: Role, first: Happening) -> Conversation:
        server = server_of(connection, role, self.ports.of(role), first)
        host, name = self.names.host(server, role), self.names.connection(role)
        return Conversation(
            role=role,
            server=server,
            name=name,
            reader=reader(role, aligned=connection.opener is not None),
            link=Channel.link(host),
            channels=channels(role, host, name),
            writer=self.writer,
            report=self._report,
        )

    def _report(self, packet: int, fault: Fault) -> None:
        """Keep the first fault of a frame: what follows in it follows from that."""
        self._faults.setdefault(packet, Undecoded(packet, fault.layer, fault.reason))

    def _end(self, cut: str) -> None:
        for connection, happening in self._connections.end():
            self._happening(connection, happening)
        if self._last is not None:
            for conversation in self._conversations.values():
                if isinstance(conversation, Conversation):
                    conversation.finish(self._last.number, self._last.time)
        self._note_unread_links()
        if cut:
            self._report(self._frames + 1, Fault("file", cut))

    def _note_unread_links(self) -> None:
        for link, count in sorted(self._unread_links.items()):
            if count == self._frames:
                raise InputError(f"link type {link} is not read", place=os.fspath(self.path))
            self._report(0, Fault("link", f"{count} packets of link type {link} are not read"))

"""One TCP connection as it goes into a trace: who is server, which protocol, what is written and where."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Protocol

from mmsverify.formats.capture import tpkt
from mmsverify.formats.capture.association import PDU_TAGS, Association
from mmsverify.formats.capture.faults import Fault
from mmsverify.formats.capture.link import Endpoint
from mmsverify.formats.capture.modbus import ModbusConnection, asks
from mmsverify.formats.capture.tcp import Connection, Happening
from mmsverify.formats.trace import LETTERS, USUAL_PORTS, Channel, LinkEvent, Role, Sender

_SESSION_STARTS = (0x01, 0x0D, 0x0E)


class Sink(Protocol):
    """Where messages go: a recording in the making."""

    def add(self, time: int, channel: Channel, data: bytes) -> None: ...


class Reader(Protocol):
    """One protocol on one connection: octets of either side in, messages and faults out."""

    def feed(self, sender: Sender, data: bytes) -> Iterator[bytes | Fault]: ...

    def lose(self, sender: Sender) -> None: ...

    def end(self, sender: Sender) -> Fault | None: ...


@dataclass(frozen=True, slots=True)
class Ports:
    """On which TCP ports which protocol is expected; elsewhere both are found by their first octets."""

    mms: frozenset[int] = frozenset({USUAL_PORTS["mms"]})
    modbus: frozenset[int] = frozenset({USUAL_PORTS["modbus"]})

    def role(self, ends: tuple[Endpoint, Endpoint]) -> Role | None:
        """What to expect between two endpoints."""
        found = {end.port for end in ends}
        if found & self.mms:
            return "mms"
        return "modbus" if found & self.modbus else None

    def of(self, role: Role) -> frozenset[int]:
        """The ports of one protocol."""
        return self.mms if role == "mms" else self.modbus


@dataclass(slots=True)
class Names:
    """Names of the connections in one trace: a1, a2, ... for associations, c1, c2, ... for Modbus.

    ``hosts`` gives addresses another name; a server on an unusual port is told by address and port.
    """

    hosts: dict[str, str] = field(default_factory=dict)
    _counts: dict[Role, int] = field(default_factory=lambda: {"mms": 0, "modbus": 0})

    def connection(self, role: Role) -> str:
        """The next free name."""
        self._counts[role] += 1
        return f"{LETTERS[role]}{self._counts[role]}"

    def host(self, server: Endpoint, role: Role) -> str:
        """The name of the VMD or controller at an endpoint."""
        text = f"{server.address}:{server.port}"
        name = self.hosts.get(text) or self.hosts.get(server.address) or server.address
        return name if server.port == USUAL_PORTS[role] or text in self.hosts else f"{name}:{server.port}"


@dataclass(slots=True)
class Conversation:
    """What one connection of a known role writes into the trace, message by message.

    What could not be read becomes a gap. ``verbatim``: what stands where a message should is written as one,
    for these are the octets that were on the wire, and no capture has lost any.
    """

    role: Role
    server: Endpoint
    name: str
    reader: Reader
    link: Channel
    channels: dict[Sender, Channel]
    writer: Sink
    report: Callable[[int, Fault], None]
    verbatim: bool = False
    messages: int = 0
    ended: bool = False
    _gap_last: bool = False
    _spoke: dict[Sender, int] = field(default_factory=dict)  # the last packet of each side

    def take(self, happening: Happening) -> None:
        """Write down what happens on the connection."""
        sender: Sender = "server" if happening.source == self.server else "client"
        if self.ended:
            if happening.data:
                self.report(happening.packet, Fault("tcp", "data after the end of the connection"))
        elif happening.kind == "data":
            self._data(happening, sender)
        elif happening.kind == "gap":
            self.reader.lose(sender)
            self.tell("gap", happening.time)
        elif happening.kind == "open":
            self.tell("open", happening.time)
        else:
            self.finish(happening.packet, happening.time)
            self.tell(happening.kind, happening.time)
            self.ended = True

    def finish(self, packet: int, time: int) -> None:
        """Nothing more will come: octets that are left over are a fault."""
        for sender in self.channels:
            fault = self.reader.end(sender)
            if fault:
                self._fault(self._spoke.get(sender, packet), time, sender, fault)

    def tell(self, event: LinkEvent, time: int) -> None:
        """Write a link event; gaps with nothing between them are one."""
        if event == "gap" and self._gap_last:
            return
        text = json.dumps({"connection": self.name, "event": event, "role": self.role})
        self._write(time, self.link, text.encode())
        self._gap_last = event == "gap"

    def _data(self, happening: Happening, sender: Sender) -> None:
        self._spoke[sender] = happening.packet
        for item in self.reader.feed(sender, happening.data):
            if isinstance(item, Fault):
                self._fault(happening.packet, happening.time, sender, item)
            else:
                self._write(happening.time, self.channels[sender], item)
                self.messages += 1
                self._gap_last = False

    def _fault(self, packet: int, time: int, sender: Sender, fault: Fault) -> None:
        self.report(packet, fault)
        if self.verbatim and fault.octets:
            self._write(time, self.channels[sender], fault.octets)
            self._gap_last = False
            return
        if fault.lost:
            self.tell("gap", time)

    def _write(self, time: int, channel: Channel, data: bytes) -> None:
        self.writer.add(max(time, 1), channel, data)  # viewers refuse a recording that has a time 0


def reader(role: Role, *, aligned: bool) -> Reader:
    """A reader for a connection of this role; ``aligned``: its first octets will be there."""
    return Association(aligned=aligned) if role == "mms" else ModbusConnection()


def channels(role: Role, host: str, name: str) -> dict[Sender, Channel]:
    """Where the messages of both sides of a connection stand in a trace."""
    kind = Channel.mms if role == "mms" else Channel.modbus
    return {"client": kind(host, name, "client"), "server": kind(host, name, "server")}


def role_of(data: bytes) -> Role | None:
    """The protocol that a side's first octets are of, on a port where none is expected."""
    if looks_like_mms(data):
        return "mms"
    return None if asks(data) is None else "modbus"


def looks_like_mms(data: bytes) -> bool:
    """Whether a side's first octets are those of MMS on a port where nobody expects it.

    A connection request counts only with transport selectors: other protocols on TPKT (remote desktops) send
    none.
    """
    if len(data) < 8 or not tpkt.boundary(data):
        return False
    if data[5] == 0xF0:
        return data[7] in _SESSION_STARTS or data[7] in PDU_TAGS
    return b"\xc1" in data[11:] and b"\xc2" in data[11:]


def server_of(connection: Connection, role: Role, ports: frozenset[int], first: Happening) -> Endpoint:
    """Who accepted the connection: by the handshake, else by port, else by who asks, else by lower port."""
    one, other = connection.ends
    if connection.opener is not None:
        return other if connection.opener == one else one
    for end in (one, other):
        if end.port in ports:
            return end
    speaker, listener = (one, other) if first.source == one else (other, one)
    asked = {b"\xe0": True, b"\xd0": False}.get(first.data[5:6]) if role == "mms" else asks(first.data)
    if asked is None:
        return min(one, other, key=lambda end: end.port)
    return listener if asked else speaker

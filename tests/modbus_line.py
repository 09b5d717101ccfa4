"""One server's recording in the making, message by message, what the audit tells of it; requests to ask."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from mmsverify.audit.modbus import Access, Plan, Server
from mmsverify.audit.telling import Place
from mmsverify.concrete.scope import scope_for
from mmsverify.formats.trace import Channel, Sender, TraceMessage
from mmsverify.model import ModelData, load
from mmsverify.profiles import KEYS, SIGNALS_TABLE
from mmsverify.resources import models_dir
from mmsverify.results import Finding

ON = 0xFF00
PLAN = {key: entry.default for key, entry in KEYS[SIGNALS_TABLE].items()}
WORD = {0x01: 8, 0x02: 8, 0x03: 2, 0x04: 2, 0x05: ON, 0x06: 3, 0x0F: 8, 0x10: 2}
REST = {0x0F: b"\x01\x05", 0x10: b"\x04\x00\x01\x00\x02"}
ANSWER = {0x01: b"\x01\x05", 0x02: b"\x01\x05", 0x03: b"\x04\x00\x01\x00\x02", 0x04: b"\x04\x00\x01\x00\x02"}

# Requests written by hand.

DEDICATED = [10, 2010]
"""The signals of the plan that are dedicated, in what follows."""

REFUSED = [
    (0x01, 961, "access.beyond", "M-2.3-3"),
    (0x01, 956, "access.beyond", "M-2.3.2-1"),
    (0x02, 1957, "access.beyond", "M-2.3.2-3"),
    (0x03, 1023, "access.beyond", "M-2.3-3"),
    (0x05, 0, "access.beyond", "M-2.3.2-3"),
    (0x10, 1024, "access.beyond", "M-2.3-3"),
    (0x02, 1, "access.not-inputs", "M-2.3.1-2"),
    (0x02, 2001, "access.not-inputs", "M-2.3.1-3"),
    (0x02, 9, "access.not-inputs", "M-2.3.1-1"),
    (0x01, 1001, "access.not-coils", "M-2.3.1-4"),
    (0x05, 1001, "access.not-coils", "M-2.3.1-1"),
    (0x0F, 1001, "access.not-coils", "M-2.3.1-4"),
    (0x05, 10, "access.dedicated", "M-2.3.2-2"),
    (0x0F, 3, "access.dedicated", "M-2.3.2-3"),
    (0x0F, 2003, "access.dedicated", "M-2.3.2-2"),
]
"""By function code and first number: the step of the model that refuses it, and a clause that says so."""

UNSOUND = [
    (0x01, 1, 0, b"", b"\x00"),
    (0x01, 1, 2001, b"", b"\xfb" + bytes(251)),
    (0x02, 1001, 8, b"\x00", b"\x01\x05"),
    (0x05, 1, 0x00FF, b"", b"\x00\x01\x00\xff"),
    (0x0F, 1, 8, b"\x02\x05", b"\x00\x01\x00\x08"),
    (0x10, 0, 2, b"\x02\x00\x01", b"\x00\x00\x00\x02"),
]
"""Requests with data that they cannot have: function code, first number, second word, the rest; an answer."""

COILS = [(function, address) for function in (0x01, 0x05, 0x0F) for address in (1, 953, 2001, 2953)]
INPUTS = [(0x02, 1001), (0x02, 1953)]
WORDS = [(function, address) for function in (0x03, 0x04, 0x06, 0x10) for address in (0, 1022)]
"""What nothing stands against, by function code and first number."""


def access_of(model: ModelData) -> Access:
    """What a model of the server says of requests."""
    return Access(model, scope_for(model, {"Socket": 0, "Client": 0}, {}))


@cache
def access() -> Access:
    """What the model that is shipped says of them."""
    return access_of(load("modbus-signals", models_dir(), "repaired"))


def planned(profile: Mapping[str, Any]) -> Plan:
    """The plan of a profile, with the default where it says nothing."""
    return Plan({**PLAN, **profile})


@dataclass
class Line:
    """One server's recording, message by message, and what is told of it."""

    profile: dict[str, Any] = field(default_factory=dict)
    messages: list[TraceMessage] = field(default_factory=list)
    found: list[Finding] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.server = Server(Place("made.mcap", "robot4"), access(), planned(self.profile))

    def link(self, event: str, name: str = "line") -> Line:
        told = json.dumps({"connection": name, "event": event, "role": "modbus"}).encode()
        self.server.link(name, event, self._message(Channel.link("robot4"), told))
        return self

    def octets(self, sender: Sender, data: bytes, name: str = "line") -> Line:
        channel = Channel.modbus("robot4", name, sender)
        self._tell(self.server.message(self._message(channel, data)))
        return self

    def asks(self, transaction: int, function: int = 0x01, address: int = 1, word: int | None = None,
             rest: bytes | None = None, name: str = "line", unit: int = 1) -> Line:  # fmt: skip
        second = WORD.get(function, 0) if word is None else word
        more = REST.get(function, b"") if rest is None else rest
        pdu = struct.pack(">BHH", function, address, second) + more
        return self.octets("client", adu(transaction, pdu, unit), name)

    def answers(self, transaction: int, function: int = 0x01, data: bytes = b"\x01\x05",
                name: str = "line", unit: int = 1) -> Line:  # fmt: skip
        return self.octets("server", adu(transaction, bytes([function]) + data, unit), name)

    def refuses(self, transaction: int, function: int = 0x01, code: int = 2, name: str = "line") -> Line:
        return self.answers(transaction, function | 0x80, bytes([code]), name)

    def told(self) -> list[tuple[int | None, str]]:
        self._tell(self.server.end())
        return [(each.index, each.rule) for each in self.found]

    def _message(self, channel: Channel, data: bytes) -> TraceMessage:
        number = len(self.messages)
        self.messages.append(TraceMessage(number, 1000 * (number + 1), channel, data))
        return self.messages[-1]

    def _tell(self, found: Iterable[Finding]) -> None:
        self.found += found


def adu(transaction: int, pdu: bytes, unit: int = 1) -> bytes:
    return struct.pack(">HHHB", transaction, 0, len(pdu) + 1, unit) + pdu


def opened(**profile: Any) -> Line:
    return Line(profile).link("open")


def echo(function: int, address: int, word: int) -> bytes:
    return ANSWER.get(function, struct.pack(">HH", address, word))


def accepted(function: int, address: int, **profile: Any) -> Line:
    """A request that is answered as if nothing stood against it."""
    line = opened(**profile).asks(1, function, address)
    return line.answers(1, function, echo(function, address, WORD[function]))

"""One server's recording in the making, message by message, and what the audit tells of it."""

from __future__ import annotations

import struct
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from mmsverify.audit.modbus import Access, Plan, Server
from mmsverify.audit.telling import Place
from mmsverify.concrete.scope import scope_for
from mmsverify.formats.trace import Channel, Sender, TraceMessage
from mmsverify.model import load
from mmsverify.profiles import KEYS, SIGNALS_TABLE
from mmsverify.resources import models_dir
from mmsverify.results import Finding

ON = 0xFF00
PLAN = {key: entry.default for key, entry in KEYS[SIGNALS_TABLE].items()}
WORD = {0x01: 8, 0x02: 8, 0x03: 2, 0x04: 2, 0x05: ON, 0x06: 3, 0x0F: 8, 0x10: 2}
REST = {0x0F: b"\x01\x05", 0x10: b"\x04\x00\x01\x00\x02"}
ANSWER = {0x01: b"\x01\x05", 0x02: b"\x01\x05", 0x03: b"\x04\x00\x01\x00\x02", 0x04: b"\x04\x00\x01\x00\x02"}


@cache
def access() -> Access:
    model = load("modbus-signals", models_dir(), "repaired")
    return Access(model, scope_for(model, {"Socket": 0, "Client": 0}, {}))


@dataclass
class Line:
    """One server's recording, message by message, and what is told of it."""

    profile: dict[str, Any] = field(default_factory=dict)
    index: int = 0
    found: list[Finding] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.server = Server(Place("made.mcap", "robot4"), access(), Plan({**PLAN, **self.profile}))

    def link(self, event: str, name: str = "line") -> Line:
        self.server.link(name, event, self._message(Channel.link("robot4"), b"{}"))
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
        self.index += 1
        return TraceMessage(self.index - 1, 1000 * self.index, channel, data)

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

"""Recordings by which an audit tells a changed server of signals from the real one.

They are requests written by hand, each answered as it may be and as it may not, random conversations with a
server that is written from the text alone, and the sample recording: none is made from the rows it judges.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import chain
from pathlib import Path
from typing import Any

import modbus_random
from modbus_line import (
    COILS,
    DEDICATED,
    INPUTS,
    REFUSED,
    UNSOUND,
    WORDS,
    Line,
    accepted,
    access,
    access_of,
    opened,
    planned,
)
from modbus_random import Plant
from small_score import Small

from mmsverify.audit.lookahead import link
from mmsverify.audit.modbus import Access, Server
from mmsverify.audit.telling import Place
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.model import ModelData
from mmsverify.profiles import SIGNALS_TABLE, from_metadata
from mmsverify.resources import traces_dir
from mmsverify.results import Finding

SAMPLE = "faulty-signals.mcap"
CONVERSATIONS, LENGTH = 4, 400
Found = list[tuple[int | None, str, str]]


@dataclass(frozen=True)
class Recording:
    """The messages of one server, and the profile that it has."""

    name: str
    messages: tuple[TraceMessage, ...]
    profile: Mapping[str, Any]

    def judged(self, access: Access) -> Found:
        """What an audit by these steps finds: where, which rule, how bad; notes apart."""
        server = Server(Place("told.mcap", "robot"), access, planned(self.profile))
        found = chain(*(_heard(server, message) for message in self.messages), server.end())
        return [(f.index, f.rule, f.severity) for f in found if f.severity != "note"]

    @cached_property
    def found(self) -> Found:
        """What the real model finds."""
        return self.judged(access())


def _heard(server: Server, message: TraceMessage) -> Iterator[Finding]:
    if happened := link(message, "modbus"):
        server.link(*happened, message)
    else:
        yield from server.message(message)


@cache
def recordings() -> tuple[Recording, ...]:
    """All of them: what is written by hand, the conversations, the sample."""
    return *by_hand(), *map(conversation, range(CONVERSATIONS)), sample()


def by_hand() -> Iterator[Recording]:
    """Each request with an answer that it may have, and with one that it may not."""
    for function, address, *_ in REFUSED:
        name = f"{function:#04x} from {address}"
        line = opened(dedicated=DEDICATED).asks(1, function, address).refuses(1, function)
        yield written(f"{name}, refused", line)
        yield written(f"{name}, accepted", accepted(function, address, dedicated=DEDICATED))
    for function, address, word, rest, data in UNSOUND:
        name = f"{function:#04x} with {word} and {len(rest)} octets"
        asked = (1, function, address, word, rest)
        yield written(f"{name}, refused", opened().asks(*asked).refuses(1, function, 3))
        yield written(f"{name}, accepted", opened().asks(*asked).answers(1, function, data))
    for function, address in (*COILS, *INPUTS, *WORDS):
        yield written(f"{function:#04x} from {address}, accepted", accepted(function, address))
    yield written("dedicated, read", accepted(0x01, DEDICATED[0], dedicated=DEDICATED))


def written(name: str, line: Line) -> Recording:
    """One line as a recording."""
    return Recording(name, tuple(line.messages), line.profile)


def conversation(seed: int) -> Recording:
    """A random conversation with a server that keeps the rules."""
    said = enumerate(Plant(seed).talk(LENGTH))
    messages = tuple(TraceMessage(n, 1_000_000 * n, channel, data) for n, (channel, data) in said)
    return Recording(f"conversation {seed}", messages, {"dedicated": sorted(modbus_random.DEDICATED)})


def sample() -> Recording:
    """The sample recording."""
    trace = read_trace(Path(traces_dir()) / SAMPLE)
    return Recording(SAMPLE, tuple(trace), from_metadata(trace.profile, SAMPLE)[SIGNALS_TABLE])


def telling(model: ModelData) -> str:
    """The first recording that a changed model judges otherwise; empty if none does."""
    changed = access_of(model)
    return next((each.name for each in recordings() if each.judged(changed) != each.found), "")


SIGNALS = Small("modbus-signals", sizes={"Socket": 2, "Client": 2}, telling=telling)
"""The server, with two clients that two sockets can serve at once."""

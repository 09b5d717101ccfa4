"""What is seen on the wire as it goes into a trace: connections, messages, samples, what could not be read.

Nothing here may stop the traffic. A disk that is full or a fault of ours ends the recording, or loses a
stretch of it, and is told; whoever passes the octets on goes on.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Literal

from mmsverify.formats.capture.conversation import Conversation, Names, channels, reader
from mmsverify.formats.capture.faults import Fault
from mmsverify.formats.capture.link import Endpoint
from mmsverify.formats.capture.tcp import Happening
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel, Role, Sender
from mmsverify.formats.vr import Number, encode

_MOST_REASONS = 1000  # different things that could not be read, told one by one; the rest is a number
_OTHERS = ("", "recording", "further reasons")


@dataclass(frozen=True, slots=True)
class Unread:
    """Octets that could not be read: on which connection, in which layer, why, and how often."""

    connection: str
    layer: str
    reason: str
    count: int


@dataclass(frozen=True, slots=True)
class Recorded:
    """What a recording holds. ``refused`` clients were turned away, for the server could not be reached.

    ``broken`` says why the trace could not be written to its end; empty if it was.
    """

    connections: int
    pdus: Mapping[str, int]
    refused: int
    undecoded: list[Unread]
    broken: str = ""


class Clock:
    """Time in ns that never goes back, though the machine's clock may be set meanwhile."""

    def __init__(self) -> None:
        self._offset = time.time_ns() - time.monotonic_ns()

    def now(self) -> int:
        """The time now, in ns since 1970."""
        return self._offset + time.monotonic_ns()


@dataclass(slots=True)
class Log:
    """One trace in the making. ``hosts`` names servers, as ``import --name`` does."""

    writer: TraceWriter
    hosts: Mapping[str, str] = field(default_factory=dict)
    refused: int = 0
    broken: str = ""
    _samples: int = 0
    _clock: Clock = field(default_factory=Clock)
    _names: Names | None = None
    _live: list[Live] = field(default_factory=list)
    _ended: Counter[Role] = field(default_factory=Counter)
    _connections: int = 0
    _unread: Counter[tuple[str, str, str]] = field(default_factory=Counter)

    def connection(self, role: Role, client: Endpoint, server: Endpoint) -> Live:
        """A connection that opens now."""
        self._names = self._names or Names(dict(self.hosts))
        host, name = self._names.host(server, role), self._names.connection(role)
        talk = Conversation(
            role=role,
            server=server,
            name=name,
            reader=reader(role, aligned=True),
            link=Channel.link(host),
            channels=channels(role, host, name),
            writer=self.writer,
            report=lambda _, fault: self.note(name, fault),
        )
        live = Live(self, talk, client)
        self._connections += 1
        self._live.append(live)
        live.happens("open", "client")
        return live

    def sample(self, channel: Channel, cells: Mapping[str, Number]) -> None:
        """The VR cells of a controller as they are now."""
        self.attempt(lambda: self.writer.add(self._clock.now(), channel, encode(cells)))
        self._samples += not self.broken

    def note(self, connection: str, fault: Fault) -> None:
        """Count something that could not be read."""
        place = (connection, fault.layer, fault.reason)
        room = place in self._unread or len(self._unread) < _MOST_REASONS
        self._unread[place if room else _OTHERS] += 1

    def forget(self, live: Live) -> None:
        """A connection is over: only its number of messages is kept."""
        if live in self._live:
            self._live.remove(live)
            self._ended[live.talk.role] += live.talk.messages

    def flush(self) -> None:
        """Make what was recorded readable."""
        self.attempt(self.writer.flush)

    def end(self) -> Recorded:
        """No more will come: what is left over of any message is told."""
        for live in list(self._live):
            self.attempt(partial(live.talk.finish, 0, self._clock.now()))
            self.forget(live)
        self.attempt(self.writer.close)
        counts = {"mms": self._ended["mms"], "modbus": self._ended["modbus"], "vr": self._samples}
        undecoded = [Unread(*place, count) for place, count in self._unread.items()]
        return Recorded(self._connections, counts, self.refused, undecoded, self.broken)

    def now(self) -> int:
        """The time now, in ns since 1970; it never goes back."""
        return self._clock.now()

    def attempt(self, write: Callable[[], object]) -> None:
        """Write, unless that has failed before; a failure ends the recording and not the caller."""
        if self.broken:
            return
        try:
            write()
        except OSError as error:
            self.broken = error.strerror or str(error)


@dataclass(slots=True, eq=False)
class Live:
    """One connection while it lasts."""

    log: Log
    talk: Conversation
    client: Endpoint
    over: bool = False

    @property
    def host(self) -> str:
        """The name of the server in the trace."""
        return self.talk.link.metadata["name"]

    def data(self, sender: Sender, octets: bytes) -> None:
        """One side says something, now."""
        self.happens("data", sender, octets)

    def end(self, kind: Literal["close", "reset"]) -> None:
        """The connection ends; only the first end counts."""
        if not self.over:
            self.over = True
            self.happens(kind, "client")
            self.log.forget(self)

    def happens(
        self, kind: Literal["open", "data", "close", "reset"], sender: Sender, octets: bytes = b""
    ) -> None:
        """Write down what happens on the connection."""
        source = self.talk.server if sender == "server" else self.client
        happening = Happening(kind, 0, self.log.now(), source, octets)
        try:
            self.log.attempt(lambda: self.talk.take(happening))
        except Exception as error:  # a fault of our readers must not cost a plant its connection
            self.log.note(self.talk.name, Fault("recording", f"{type(error).__name__}: {error}"))
            self.log.attempt(lambda: self.talk.take(happening._replace(kind="gap", data=b"")))

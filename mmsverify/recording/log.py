"""What is seen on the wire as it goes into a trace: connections, messages, samples, what could not be read.

Nothing here may stop the traffic. A disk that is full ends the recording, a fault of ours loses a stretch of
it, and either is told; whoever passes the octets on goes on.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import count
from typing import Literal

from mmsverify.formats.capture.conversation import Conversation, channels, reader
from mmsverify.formats.capture.faults import Fault
from mmsverify.formats.capture.link import Endpoint
from mmsverify.formats.capture.tcp import Happening
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import LETTERS, Channel, Role, Sender
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
    """Time in ns that never goes back, though the machine's clock may be set meanwhile.

    While the machine sleeps it may stand still.
    """

    def __init__(self) -> None:
        self._offset = time.time_ns() - time.monotonic_ns()

    def now(self) -> int:
        """The time now, in ns since 1970."""
        return self._offset + time.monotonic_ns()


class _Guarded:
    """A trace's writer that fails once: then nothing more is written, and ``broken`` says why."""

    def __init__(self, writer: TraceWriter) -> None:
        self.broken = ""
        self._writer = writer

    def add(self, time: int, channel: Channel, data: bytes) -> None:
        self._attempt(lambda: self._writer.add(time, channel, data))

    def flush(self) -> None:
        self._attempt(self._writer.flush)

    def close(self) -> None:
        self._attempt(self._writer.close)

    def _attempt(self, write: Callable[[], object]) -> None:
        if self.broken:
            return
        try:
            write()
        except Exception as error:  # whatever it is, it must not cost a plant its connections
            told = getattr(error, "strerror", None) or str(error)
            self.broken = told or type(error).__name__


class Log:
    """One trace in the making; ``host`` names the server in it."""

    def __init__(self, writer: TraceWriter, host: str) -> None:
        self.host = host
        self.refused = 0
        self.clock = Clock()
        self._writer = _Guarded(writer)
        self._samples = self._connections = 0
        self._live: dict[str, Live] = {}
        self._ended: Counter[Role] = Counter()
        self._unread: Counter[tuple[str, str, str]] = Counter()

    @property
    def broken(self) -> str:
        """Why nothing more is written; empty as long as all is well."""
        return self._writer.broken

    def connection(self, role: Role, client: Endpoint, server: Endpoint) -> Live:
        """A connection that opens now. It bears the first name that no other one has at the moment.

        A recorder may run for years, and a trace has room for some ten thousand names.
        """
        numbered = (f"{LETTERS[role]}{number}" for number in count(1))
        name = next(name for name in numbered if name not in self._live)
        talk = Conversation(
            role=role,
            server=server,
            name=name,
            reader=reader(role, aligned=True),
            link=Channel.link(self.host),
            channels=channels(role, self.host, name),
            writer=self._writer,
            report=lambda _, fault: self.note(name, fault),
            verbatim=True,
        )
        live = self._live[name] = Live(self, talk, client)
        self._connections += 1
        live.happens("open", "client")
        return live

    def sample(self, channel: Channel, cells: Mapping[str, Number]) -> None:
        """The VR cells of a controller as they are now."""
        self._writer.add(self.clock.now(), channel, encode(cells))
        self._samples += not self.broken

    def note(self, connection: str, fault: Fault) -> None:
        """Count something that could not be read."""
        place = (connection, fault.layer, fault.reason)
        room = place in self._unread or len(self._unread) < _MOST_REASONS
        self._unread[place if room else _OTHERS] += 1

    def forget(self, live: Live) -> None:
        """A connection is over: only its number of messages is kept."""
        if self._live.pop(live.talk.name, None) is not None:
            self._ended[live.talk.role] += live.talk.messages

    def flush(self) -> None:
        """Make what was recorded readable."""
        self._writer.flush()

    def end(self) -> Recorded:
        """No more will come: what is left over of any message is told."""
        for live in list(self._live.values()):
            live.talk.finish(0, self.clock.now())
            self.forget(live)
        self._writer.close()
        counts = {"mms": self._ended["mms"], "modbus": self._ended["modbus"], "vr": self._samples}
        undecoded = [Unread(*place, times) for place, times in self._unread.items()]
        return Recorded(self._connections, counts, self.refused, undecoded, self.broken)


@dataclass(slots=True, eq=False)
class Live:
    """One connection while it lasts."""

    log: Log
    talk: Conversation
    client: Endpoint
    over: bool = False

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
        if self.log.broken:
            return
        source = self.talk.server if sender == "server" else self.client
        try:
            self.talk.take(Happening(kind, 0, self.log.clock.now(), source, octets))
        except Exception as error:  # a fault of our readers must not cost a plant its connection
            self.log.note(self.talk.name, Fault("recording", f"{type(error).__name__}: {error}"))
            self.talk.tell("gap", self.log.clock.now())

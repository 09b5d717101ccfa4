"""TCP connections from captured segments: what each side said, in order, how the connection began and ended.

Retransmitted octets are dropped, early ones wait, what never comes is a hole. The octets' meaning is not
known here. RFC 9293 names the fields; sequence numbers are compared modulo 2**32.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal, NamedTuple

from mmsverify.formats.capture.link import Endpoint, Segment

_MODULUS = 1 << 32
_FAR = 1 << 26  # further off than any window: another connection on the same ports
_LARGEST_WAIT = 1 << 20  # octets that wait behind a hole
_MOST_WAITING = 1000  # pieces of them
_PATIENCE = 200  # segments of the connection after which a hole is believed
_PATIENCE_ACKNOWLEDGED = 16  # the same where the receiver says that it has what the capture has not


class Piece(NamedTuple):
    """Octets of one direction in order; ``lost`` ones (-1: unknown how many) are missing before them."""

    packet: int
    time: int
    data: bytes
    lost: int = 0


class Happening(NamedTuple):
    """What a connection shows: it opens, ``source`` says ``data``, something is missing (gap), it ends."""

    kind: Literal["open", "data", "gap", "close", "reset"]
    packet: int
    time: int
    source: Endpoint
    data: bytes = b""


def _after(seq: int, reference: int) -> int:
    """How many octets ``seq`` is after ``reference``; negative if before."""
    return (seq - reference + _MODULUS // 2) % _MODULUS - _MODULUS // 2


class Stream:
    """One direction of a connection."""

    __slots__ = ("_waiting", "acknowledged", "fin", "next", "start", "waited")

    def __init__(self) -> None:
        self.start: int | None = None  # the sequence number of the first octet, as far as the capture shows
        self.next: int | None = None  # that of the next octet to deliver
        self.fin: int | None = None
        self.acknowledged: int | None = None
        self.waited = 0
        self._waiting: list[tuple[int, Piece]] = []

    def expect(self, seq: int) -> None:
        """Learn where the stream stands, if that is not known yet."""
        if self.next is None:
            self.start = self.next = seq

    def acknowledge(self, seq: int | None) -> None:
        """The other side has everything before ``seq``."""
        if seq is None or seq == self.acknowledged:
            return
        self.expect(seq)
        if self.acknowledged is None or _after(seq, self.acknowledged) > 0:
            self.acknowledged = seq

    def push(self, seq: int, piece: Piece) -> list[Piece]:
        """Take in captured octets; give back what is now in order."""
        self.expect(seq)
        ahead = self._ahead(seq)
        if abs(ahead) > _FAR:
            self._waiting.clear()
            self.next = (seq + len(piece.data)) % _MODULUS
            return [Piece(piece.packet, piece.time, piece.data, -1)]
        if ahead + len(piece.data) <= 0:
            return []
        self._waiting.append((seq, piece))
        return self._drain(piece.time)

    def lose(self) -> list[Piece]:
        """Give up the hole before the earliest waiting octets; give back what then is in order."""
        if not self._waiting:
            return []
        seq, first = min(self._waiting, key=lambda entry: self._ahead(entry[0]))
        lost, self.next = self._ahead(seq), seq
        return [Piece(first.packet, first.time, b"", lost), *self._drain(first.time)]

    def impatient(self) -> bool:
        """Count one more segment behind a hole; say whether the hole must now be believed."""
        if not self._waiting:
            self.waited = 0
            return False
        self.waited += 1
        if (
            len(self._waiting) > _MOST_WAITING
            or sum(len(piece.data) for _, piece in self._waiting) > _LARGEST_WAIT
        ):
            return True
        return self.waited > (_PATIENCE_ACKNOWLEDGED if self.unseen() > 0 else _PATIENCE)

    def unseen(self) -> int:
        """Octets that the other side acknowledged and this capture does not have."""
        if self.acknowledged is None or self.next is None:
            return 0
        return _after(self.acknowledged, self.next)

    @property
    def finished(self) -> bool:
        """Whether the stream's end was seen and everything before it delivered."""
        return self.fin is not None and self.next is not None and _after(self.fin, self.next) <= 0

    @property
    def disturbed(self) -> bool:
        """Whether octets wait behind a hole, or the stream's end was seen."""
        return self.holed or self.fin is not None

    @property
    def holed(self) -> bool:
        """Whether octets wait behind a hole."""
        return bool(self._waiting)

    def _ahead(self, seq: int) -> int:
        assert self.next is not None
        return _after(seq, self.next)

    def _drain(self, now: int) -> list[Piece]:
        ready: list[Piece] = []
        self._waiting.sort(key=lambda entry: self._ahead(entry[0]))
        while self._waiting and self._ahead(self._waiting[0][0]) <= 0:
            seq, piece = self._waiting.pop(0)
            fresh = piece.data[-self._ahead(seq) :]
            if fresh:
                ready.append(Piece(piece.packet, max(piece.time, now), fresh))
                self.next = (seq + len(piece.data)) % _MODULUS
        return ready


class Connection:
    """Two streams between two endpoints. ``opener`` is who sent the SYN, if the capture shows it."""

    def __init__(self, first: Segment) -> None:
        self.ends = (first.source, first.target)
        self.opener: Endpoint | None = None
        self.over = False
        self._open = False
        self._streams = {first.source: Stream(), first.target: Stream()}
        self._last = first

    def feed(self, segment: Segment) -> Iterable[Happening]:
        """What one more segment brings about."""
        self._last = segment
        stream, other = self._streams[segment.source], self._streams[segment.target]
        if self._plain(segment, stream, other):
            stream.waited = other.waited = 0
            other.acknowledge(segment.ack)
            if not segment.data:
                return ()
            stream.next = (segment.seq + len(segment.data)) % _MODULUS
            return (Happening("data", segment.packet, segment.time, segment.source, segment.data),)
        return self._anything(segment, stream, other)

    def _plain(self, segment: Segment, stream: Stream, other: Stream) -> bool:
        """Whether only the next octets come, if any, and nothing else is going on: the case of nearly all."""
        return not (
            segment.syn
            or segment.fin
            or segment.rst
            or segment.seq != stream.next
            or stream.disturbed
            or other.disturbed
            or not (self._open or self.opener is None)
        )

    def _anything(self, segment: Segment, stream: Stream, other: Stream) -> Iterator[Happening]:
        if segment.syn:
            yield from self._handshake(segment, stream)
        other.acknowledge(segment.ack)
        if segment.data:
            yield from self._opened(segment)
            piece = Piece(segment.packet, segment.time, segment.data)
            yield from _told(stream.push(self._data_seq(segment), piece), segment.source)
        yield from self._impatience()
        yield from self._ending(segment, stream)

    def start(self, source: Endpoint) -> int | None:
        """The sequence number of the first octet that ``source`` sends, if known."""
        return self._streams[source].start

    def end(self) -> Iterator[Happening]:
        """The capture ends, or the ports are used anew: deliver what waits, tell what is missing."""
        yield from self._flush()
        if not self.over and any(stream.fin is not None for stream in self._streams.values()):
            yield self._finish("close", self._last)
        self.over = True

    def _data_seq(self, segment: Segment) -> int:
        return (segment.seq + segment.syn) % _MODULUS

    def _handshake(self, segment: Segment, stream: Stream) -> Iterator[Happening]:
        stream.expect((segment.seq + 1) % _MODULUS)
        self.opener = self.opener or (segment.source if segment.ack is None else segment.target)
        if segment.ack is not None:
            yield from self._opened(segment)

    def _opened(self, segment: Segment) -> Iterator[Happening]:
        if self.opener is not None and not self._open:
            self._open = True
            yield Happening("open", segment.packet, segment.time, self.opener)

    def _impatience(self) -> Iterator[Happening]:
        for source, stream in self._streams.items():
            if stream.impatient():
                yield from _told(stream.lose(), source)

    def _ending(self, segment: Segment, stream: Stream) -> Iterator[Happening]:
        if self.over:
            return
        if segment.rst:
            yield from self._flush()
            yield self._finish("reset", segment)
            return
        if segment.fin and stream.fin is None:
            stream.fin = (self._data_seq(segment) + len(segment.data) + segment.missing) % _MODULUS
            stream.expect(stream.fin)
        if all(stream.finished for stream in self._streams.values()):
            yield self._finish("close", segment)

    def _finish(self, kind: Literal["close", "reset"], segment: Segment) -> Happening:
        self.over = True
        return Happening(kind, segment.packet, segment.time, segment.source)

    def _flush(self) -> Iterator[Happening]:
        for source, stream in self._streams.items():
            while stream.holed:
                yield from _told(stream.lose(), source)
            if stream.unseen() > 1:  # one octet may be the FIN
                yield Happening("gap", self._last.packet, self._last.time, source)


def _told(pieces: list[Piece], source: Endpoint) -> Iterator[Happening]:
    for piece in pieces:
        if piece.lost:
            yield Happening("gap", piece.packet, piece.time, source)
        if piece.data:
            yield Happening("data", piece.packet, piece.time, source, piece.data)


class Connections:
    """All connections of one capture, by their endpoints."""

    def __init__(self) -> None:
        self._known: dict[frozenset[Endpoint], Connection] = {}

    def feed(self, segment: Segment) -> Iterable[tuple[Connection, Happening]]:
        """What one segment brings about, on which connection."""
        key = frozenset((segment.source, segment.target))
        connection = self._known.get(key)
        before: list[tuple[Connection, Happening]] = []
        if connection is not None and _begins_anew(connection, segment):
            before = [(connection, happening) for happening in connection.end()]
            connection = None
        if connection is None:
            connection = self._known[key] = Connection(segment)
        return before + [(connection, happening) for happening in connection.feed(segment)]

    def end(self) -> Iterator[tuple[Connection, Happening]]:
        """The capture ends: what every connection still has to say."""
        for connection in self._known.values():
            yield from ((connection, happening) for happening in connection.end())


def _begins_anew(connection: Connection, segment: Segment) -> bool:
    """Whether a SYN begins another connection on the same ports, and is no retransmission."""
    if not segment.syn or segment.ack is not None:
        return False
    return connection.over or connection.start(segment.source) not in (None, (segment.seq + 1) % _MODULUS)

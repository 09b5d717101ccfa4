"""Messages of a recording that stand one after the other in memory, in event order.

Nobody takes a message in hand who need not: a reader goes from record to record by their lengths, and asks
for a message where it wants one.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from mmsverify.errors import InputError
from mmsverify.formats import mcap_records as rec
from mmsverify.formats.trace import Channel, TraceMessage

PAD = bytes(64)
"""Stands behind the records, so that what is at the end of the last one can be looked at like any other."""


class DisorderError(Exception):
    """A message is older than one before it: the order of the file is not that of the events."""


class Places(Protocol):
    """Offsets, in growing order."""

    def append(self, at: int, /) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, number: int, /) -> int: ...


@dataclass(slots=True, eq=False)
class Stretch:
    """Records of a recording, ``data`` up to ``size``; ``index`` is that of the first message.

    ``places`` are the offsets of the messages passed so far; whoever passes one adds it. ``last`` is the log
    time of the last one passed, or of the last one before the stretch. ``cut``: the last record need not be
    whole. ``place`` says where the stretch begins, for who reads an error.
    """

    data: bytes
    size: int
    index: int
    last: int
    known: rec.Definitions
    wrong: Callable[[InputError], InputError]
    cut: bool = False
    places: Places = field(default_factory=list[int])

    def message(self, at: int) -> TraceMessage:
        """The message at that offset."""
        _, length, number, _, time, _ = rec.MESSAGE_HEAD.unpack_from(self.data, at)
        data = self.data[at + rec.MESSAGE_HEAD.size : at + rec.HEAD.size + length]
        return TraceMessage(self.index_at(at), time, self.channel(number), data)

    def index_at(self, at: int) -> int:
        """The index of the message at that offset, which has been passed or is the next."""
        return self.index + bisect_left(self.places, at)

    def number(self, at: int) -> int:
        """The number of the channel of the message at that offset."""
        found: int = rec.MESSAGE_HEAD.unpack_from(self.data, at)[2]
        return found

    def channel(self, number: int) -> Channel:
        """The channel of that number; one that nobody has defined has no name."""
        return rec.channel_of(number, self.known)

    def next(self, at: int) -> tuple[int, TraceMessage | None]:
        """Pass one record of any kind: the offset behind it, and its message if it is one.

        Raises ``InputError`` where the octets are no record, ``DisorderError`` where the message is too old.
        """
        try:
            opcode, length = rec.HEAD.unpack_from(self.data, at)
            following = at + rec.HEAD.size + length
            if following > self.size or at + rec.HEAD.size > self.size:
                if self.cut:
                    return self.size, None
                raise InputError("the last record leads out of its chunk")
            if opcode in (rec.SCHEMA, rec.CHANNEL):
                self.known.learn(opcode, self.data[at + rec.HEAD.size : following])
            if opcode != rec.MESSAGE:
                return following, None
            if length < rec.MESSAGE_FIXED:
                raise InputError(f"a message record of {length} octets")
            if len(self.places) >= rec.MOST_MESSAGES:
                raise rec.too_many()
        except InputError as error:
            raise self.wrong(error) from None
        message = self.message(at)
        if message.time < self.last:
            raise DisorderError
        self.last = message.time
        self.places.append(at)
        return following, message


def joined(messages: Sequence[rec.Message], index: int, last: int) -> Stretch:
    """A stretch of messages that have been brought into order."""
    channels: list[Channel] = []
    numbers: dict[int, int] = {}
    records: list[bytes] = []
    for time, _, channel, data in messages:
        number = numbers.get(id(channel))
        if number is None:
            number = numbers[id(channel)] = len(channels)
            if number > rec.LARGEST_NUMBER:
                raise InputError("too many channels", cure="sort the recording by log time")
            channels.append(channel)
        head = rec.MESSAGE_HEAD.pack(rec.MESSAGE, rec.MESSAGE_FIXED + len(data), number, 0, time, time)
        records += (head, data)
    octets = b"".join(records)
    known = rec.Definitions({}, dict(enumerate(channels)))
    return Stretch(octets + PAD, len(octets), index, last, known, _no_fault)


def _no_fault(error: InputError) -> InputError:
    return error

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


class DisorderError(Exception):
    """A message is older than one before it: the order of the file is not that of the events."""


class Places(Protocol):
    """Offsets, in growing order."""

    def append(self, at: int, /) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, number: int, /) -> int: ...


@dataclass(slots=True, eq=False)
class Stretch:
    """Records of a recording; ``index`` is that of the first message.

    ``places`` are the offsets of the messages passed so far; whoever passes one adds it. ``last`` is the log
    time of the last one passed, or of the last one before the stretch. ``cut``: the last record need not be
    whole. ``wrong`` says of an error where it is. ``span`` is where the octets of the stretch begin and
    end in the file, as far as they stand together there.
    """

    data: bytes
    index: int
    last: int
    known: rec.Definitions
    wrong: Callable[[InputError], InputError]
    cut: bool = False
    span: tuple[int, int] = (0, 0)
    places: Places = field(default_factory=list[int])

    @property
    def size(self) -> int:
        """How many octets there are."""
        return len(self.data)

    def octets(self, at: int) -> int:
        """How much of the file has been passed with what stands before that offset."""
        begin, end = self.span
        return begin + (end - begin) * at // max(self.size, 1)

    def message(self, at: int) -> TraceMessage:
        """The message at that offset."""
        _, length, number, _, time, _ = rec.MESSAGE_HEAD.unpack_from(self.data, at)
        data = self.data[at + rec.MESSAGE_HEAD.size : at + rec.HEAD.size + length]
        return TraceMessage(self.index + self.passed(at), time, self.channel(number), data)

    def time(self, at: int) -> int:
        """The log time in ns of the message at that offset."""
        found: int = rec.MESSAGE_HEAD.unpack_from(self.data, at)[4]
        return found

    def passed(self, at: int) -> int:
        """How many messages were passed before the one at that offset, which was passed or is the next."""
        if not self.places or self.places[-1] < at:
            return len(self.places)
        return bisect_left(self.places, at)

    def number(self, at: int) -> int:
        """The number of the channel of the message at that offset, -1 where none fits there."""
        if at + rec.MESSAGE_HEAD.size > self.size:
            return -1
        found: int = rec.MESSAGE_HEAD.unpack_from(self.data, at)[2]
        return found

    def channel(self, number: int) -> Channel:
        """The channel of that number; one that nobody has defined has no name."""
        return rec.channel_of(number, self.known)

    def record(self, at: int) -> tuple[int, int]:
        """The opcode of the record at that offset, and where the next one begins, be it beyond the end."""
        if at + rec.HEAD.size > self.size:
            return 0, self.size + 1
        opcode, length = rec.HEAD.unpack_from(self.data, at)
        return opcode, at + rec.HEAD.size + length

    def defines(self, at: int) -> bool:
        """Whether a definition stands at that offset, after which a number may mean another channel."""
        return self.record(at)[0] in (rec.SCHEMA, rec.CHANNEL)

    def next(self, at: int) -> tuple[int, TraceMessage | None]:
        """Pass one record of any kind: the offset behind it, and its message if it is one.

        Raises ``InputError`` where the octets are no record, ``DisorderError`` where the message is too old.
        """
        try:
            opcode, following = self.record(at)
            if following > self.size:
                if self.cut:
                    return self.size, None
                raise InputError("the last record leads out of its chunk")
            if opcode in (rec.SCHEMA, rec.CHANNEL):
                self.known.learn(opcode, self.data[at + rec.HEAD.size : following])
            if opcode != rec.MESSAGE:
                return following, None
            if following - at < rec.MESSAGE_HEAD.size:
                raise InputError(f"a message record of {following - at - rec.HEAD.size} octets")
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
    return Stretch(octets, index, last, known, _no_fault)


def _no_fault(error: InputError) -> InputError:
    return error

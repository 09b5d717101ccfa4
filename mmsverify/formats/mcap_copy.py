"""Everything that stands in a recording, for a copy that leaves nothing out but its compression and indexes.

Messages keep what an audit has no use for: the time of publishing, the sequence number, the number of their
channel. Records that are damaged are left out of the copy, as far as messages can be read around them.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import BinaryIO, NamedTuple

from mmsverify.errors import InputError
from mmsverify.formats import mcap_records as rec
from mmsverify.formats.mcap import McapTrace
from mmsverify.formats.mcap_survey import Block
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel, TraceMessage


class Sealed(NamedTuple):
    """What is written on a message beside its log time: its channel and the number of that, and the rest."""

    channel: Channel
    number: int
    sequence: int
    publish: int


class Recorded(NamedTuple):
    """A message with everything that was recorded of it."""

    message: TraceMessage
    sealed: Sealed


class Attachment(NamedTuple):
    """A file that stands in a recording; times in ns."""

    log: int
    created: int
    name: str
    media_type: str
    data: bytes


class Original:
    """A recording that is copied: its messages in event order, its files and pairs, the profile it names."""

    def __init__(self, trace: McapTrace) -> None:
        self._trace = trace
        self._known = trace.definitions()
        self.profile = ""
        self.attachments: list[Attachment] = []
        self.metadata: list[tuple[str, dict[str, str]]] = []
        with trace.open() as file:
            for opcode, body in _records(file):
                with suppress(InputError):
                    self._take(opcode, rec.Fields(body))

    def _take(self, opcode: int, fields: rec.Fields) -> None:
        match opcode:
            case rec.HEADER:
                self.profile = fields.text()
            case rec.METADATA:
                self.metadata.append((fields.text(), fields.pairs()))
            case rec.ATTACHMENT:
                log, created, name, kind = fields.integer(8), fields.integer(8), fields.text(), fields.text()
                data = fields.octets(fields.integer(8))
                self.attachments.append(Attachment(log, created, name, kind, data))

    def messages(self) -> Iterator[Recorded]:
        """The messages in event order; raises ``InputError`` where the recording is damaged."""
        index = 0
        for batch in self._trace.batches_by(_load, self._known):
            for time, _, sealed, data in batch:
                yield Recorded(TraceMessage(index, time, sealed.channel, data), sealed)
                index += 1

    def define(self, copy: TraceWriter) -> None:
        """Let the copy hold the schemas and channels of which there is no message, too."""
        for number, channel in sorted(self._known.channels.items()):
            copy.register(channel, number)
        for _, schema in sorted(self._known.schemas.items()):
            copy.register_schema(schema)


def _load(block: Block, file: BinaryIO, known: rec.Definitions) -> list[tuple[int, int, Sealed, bytes]]:
    try:
        octets, base = block.unpack(file), block.number << 32
        found = rec.messages(octets, base, known, cut=block.cut)
    except InputError as error:
        raise block.wrong(error) from None
    return [(time, rank, _sealed(octets, rank - base, channel), data) for time, rank, channel, data in found]


def _sealed(octets: bytes, at: int, channel: Channel) -> Sealed:
    _, _, number, sequence, _, publish = rec.MESSAGE_HEAD.unpack_from(octets, at)
    return Sealed(channel, number, sequence, publish)


def _records(file: BinaryIO) -> Iterator[tuple[int, bytes]]:
    """The whole records outside chunks that are no messages, with what follows their lengths."""
    size = file.seek(0, 2)
    at = len(rec.MAGIC)
    while at + rec.HEAD.size <= size:
        file.seek(at)
        opcode, length = rec.HEAD.unpack(file.read(rec.HEAD.size))
        at += rec.HEAD.size + length
        if opcode in (0, rec.FOOTER) or at > size:
            return
        if opcode in (rec.HEADER, rec.METADATA, rec.ATTACHMENT):
            yield opcode, file.read(length)

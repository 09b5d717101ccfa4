"""The first, quick pass over an MCAP file: where its messages stand, its metadata, whether it was cut.

Chunks are passed over, not unpacked. A file that breaks off is told from a file that lies by its end: a
finished file ends with the MCAP magic, so a record that leads out of it is a lie; without the magic it is a
cut.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import BinaryIO

from mmsverify.errors import InputError
from mmsverify.formats import mcap_records as rec

_RUN = 1 << 20  # octets of messages outside chunks that are read at one go


@dataclass(frozen=True, slots=True)
class Block:
    """A stretch of the file with messages: the payload of one chunk, or a run of records outside chunks.

    ``number`` counts the blocks of the file from 0; ``start`` and ``end`` bound the log times, as the file
    claims for a chunk; ``unpacked`` is the size in octets when decompressed; ``cut`` says that the file ends
    inside.
    """

    number: int
    position: int
    size: int
    start: int
    end: int
    unpacked: int
    compression: str = ""
    crc: int = 0
    cut: bool = False

    def load(self, file: BinaryIO, known: rec.Definitions) -> list[rec.Message]:
        """The messages of this block in their order; channels defined inside go to ``known``."""
        try:
            data = self.unpack(file)
            return rec.messages(data, self.number << 32, known, cut=self.cut)
        except InputError as error:
            raise self.wrong(error) from None

    def wrong(self, error: InputError, place: str = "") -> InputError:
        """The error with where in the file its block begins."""
        return InputError(f"octet {self.position}: {error.cause}", place=place, cure=error.cure)

    def unpack(self, file: BinaryIO) -> bytes:
        """The records of this block."""
        file.seek(self.position)
        return rec.unpack(file.read(self.size), self.compression, self.unpacked, self.crc, cut=self.cut)


@dataclass(slots=True)
class Survey:
    """What one pass over the file tells. ``remark`` is empty unless the file was cut off."""

    blocks: list[Block] = field(default_factory=list)
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    known: rec.Definitions = field(default_factory=lambda: rec.Definitions({}, {}))
    remark: str = ""


@dataclass(frozen=True, slots=True)
class _Record:
    opcode: int
    position: int  # of the first octet after the length
    length: int

    @property
    def start(self) -> int:
        return self.position - rec.HEAD.size

    @property
    def end(self) -> int:
        return self.position + self.length


def survey(file: BinaryIO) -> Survey:
    """Walk the records of ``file`` once. Raises ``InputError`` where it is no MCAP file, or one that lies."""
    head = file.read(len(rec.MAGIC))
    if head != rec.MAGIC:
        if head.lstrip().startswith(b"<"):
            cure = "name the file itself; the URL of a folder ends with /"
            raise InputError("a web page, not an MCAP file", cure=cure)
        raise InputError("not an MCAP file", cure="import a capture first: mmsverify import")
    return _Surveyor(file).run()


class _Surveyor:
    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._size = file.seek(0, 2)
        self._finished = self._at(self._size - len(rec.MAGIC), len(rec.MAGIC)) == rec.MAGIC
        self._found = Survey()
        self._run: Block | None = None
        self._summed = 0, 0  # octets from the begin of the file, and their CRC

    def run(self) -> Survey:
        for record in self._records():
            self._note(record)
        self._close_run()
        return self._found

    def _at(self, position: int, count: int) -> bytes:
        self._file.seek(max(position, 0))
        return self._file.read(count)

    def _records(self) -> Iterator[_Record]:
        at = len(rec.MAGIC)
        while at + rec.HEAD.size <= self._size:
            opcode, length = rec.HEAD.unpack(self._at(at, rec.HEAD.size))
            record = _Record(opcode, at + rec.HEAD.size, length)
            if opcode == 0 or record.end > self._size:
                return self._break_off(record)
            yield record
            at = record.end
            if opcode == rec.FOOTER and self._at(at, len(rec.MAGIC)) == rec.MAGIC:
                return None
        self._found.remark = f"cut off at octet {at}, before its end"
        return None

    def _break_off(self, record: _Record) -> None:
        if self._finished:
            raise InputError(
                f"octet {record.start}: a record of {record.length} octets leads out of the file"
            )
        self._found.remark = f"cut off in the record at octet {record.start}"
        if record.opcode == rec.CHUNK:
            self._note_chunk(record)

    def _note(self, record: _Record) -> None:
        if record.opcode == rec.CHUNK:
            self._note_chunk(record)
        elif record.opcode == rec.DATA_END:
            self._check_data(record)
        elif record.opcode in rec.RUN_RECORDS:
            self._note_plain(record)
        else:
            self._close_run()

    def _note_plain(self, record: _Record) -> None:
        if record.opcode == rec.MESSAGE:
            self._extend_run(record)
            return
        body = self._at(record.position, record.length)
        try:
            self._define(record.opcode, body)
        except InputError as error:
            raise InputError(f"octet {record.start}: {error.cause}") from None
        self._close_run()

    def _define(self, opcode: int, body: bytes) -> None:
        if opcode == rec.METADATA:
            name, pairs = rec.metadata(body)
            self._found.metadata.setdefault(name, {}).update(pairs)
        else:
            self._found.known.learn(opcode, body)

    def _extend_run(self, record: _Record) -> None:
        time = self._message_time(record)
        run = self._run
        if run is None or run.size > _RUN:
            self._close_run()
            run = Block(len(self._found.blocks), record.start, 0, time, time, 0)
        size = record.end - run.position
        self._run = replace(run, size=size, unpacked=size, start=min(run.start, time), end=max(run.end, time))

    def _message_time(self, record: _Record) -> int:
        if record.length < rec.MESSAGE_FIXED:
            raise InputError(f"octet {record.start}: a message record of {record.length} octets")
        time: int = rec.MESSAGE_HEAD.unpack(self._at(record.start, rec.MESSAGE_HEAD.size))[4]
        return time

    def _close_run(self) -> None:
        if self._run is not None:
            self._found.blocks.append(self._run)
            self._run = None

    def _note_chunk(self, record: _Record) -> None:
        self._close_run()
        present = min(record.end, self._size)
        head = self._at(record.position, rec.CHUNK_HEAD.size + 40)[: present - record.position]
        block = self._chunk(record, head, present)
        if block is not None:
            self._found.blocks.append(block)

    def _chunk(self, record: _Record, head: bytes, present: int) -> Block | None:
        cut = record.end > present
        try:
            fields = rec.Fields(head)
            start, end, unpacked = fields.integer(8), fields.integer(8), fields.integer(8)
            crc, name, size = fields.integer(4), fields.text(), fields.integer(8)
        except InputError as error:
            if cut:  # not even the chunk's head is whole
                return None
            raise InputError(f"octet {record.start}: {error.cause}") from None
        position = record.position + rec.CHUNK_HEAD.size + len(name.encode()) + 8
        if size > record.end - position:
            raise InputError(f"octet {record.start}: a chunk of {record.length} octets claims {size} of data")
        size = min(size, present - position)
        number = len(self._found.blocks)
        return Block(number, position, size, start, end, unpacked, name, crc, cut)

    def _check_data(self, record: _Record) -> None:
        self._close_run()
        claimed = int.from_bytes(self._at(record.position, min(record.length, 4)), "little")
        if claimed and claimed != self._data_crc(record.start):
            raise InputError("the CRC of the data does not match its octets", cure="copy the recording again")

    def _data_crc(self, end: int) -> int:
        """The CRC up to there; a file that ends its data a thousand times is not summed a thousand times."""
        begin, crc = self._summed
        left = end - begin
        self._file.seek(begin)
        while left > 0 and (piece := self._file.read(min(left, _RUN))):
            crc, left = zlib.crc32(piece, crc), left - len(piece)
        self._summed = end, crc
        return crc

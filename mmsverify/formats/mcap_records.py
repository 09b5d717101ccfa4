"""MCAP records as octets: what stands at which offset, and how a chunk is unpacked. No file is opened here.

Written against the MCAP 0 specification. Own code, because the mcap package reads messages at a tenth of this
speed, yields nothing from chunks without message indexes, and trusts every length in the file. The package
stays the judge: the tests compare both.
"""

from __future__ import annotations

import io
import struct
import zlib
from contextlib import suppress
from dataclasses import dataclass

import lz4.frame
import zstandard

from mmsverify.errors import InputError
from mmsverify.formats.trace import Channel, Schema

MAGIC = b"\x89MCAP0\r\n"
FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, METADATA, DATA_END = 0x02, 0x03, 0x04, 0x05, 0x06, 0x0C, 0x0F
HEADER, ATTACHMENT = 0x01, 0x09
RUN_RECORDS = frozenset({SCHEMA, CHANNEL, MESSAGE, METADATA})

HEAD = struct.Struct("<BQ")  # opcode, length of what follows
MESSAGE_HEAD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
CHUNK_HEAD = struct.Struct("<QQQII")  # start, end, size when unpacked, its CRC-32, length of a name
MESSAGE_FIXED = MESSAGE_HEAD.size - HEAD.size

# A chunk is unpacked in memory, so its claim is a claim on memory. Recorders write chunks of 1 to 16 MiB.
LARGEST_CHUNK = 64 << 20
LARGEST_NUMBER = 0xFFFF  # of a channel
MOST_MESSAGES = 400_000  # of one chunk: each takes some 250 octets beside its data, however small it is
_PIECE = 4 << 20

Message = tuple[int, int, Channel, bytes]  # log time, rank by position in the file, channel, data


@dataclass(slots=True)
class Definitions:
    """The schemas and channels that the records read so far define."""

    schemas: dict[int, Schema]
    channels: dict[int, Channel]

    def learn(self, opcode: int, body: bytes) -> None:
        """Take in one schema or channel record; ``body`` is what follows its length."""
        fields = Fields(body)
        number = fields.integer(2)
        if opcode == SCHEMA:
            name, encoding = fields.text(), fields.text()
            self.schemas[number] = Schema(name, encoding, fields.octets(fields.integer(4)))
        else:
            schema = self.schemas.get(fields.integer(2))
            self._keep(number, Channel(fields.text(), fields.text(), schema, fields.pairs()))

    def _keep(self, number: int, channel: Channel) -> None:
        if self.channels.get(number) != channel:  # a repeated record must not make a second object
            self.channels[number] = channel


class Fields:
    """The fields of one record, from left to right; a length that leads out of the record is an error."""

    def __init__(self, body: bytes) -> None:
        self._body = body
        self._at = 0

    def octets(self, count: int) -> bytes:
        """The next ``count`` octets."""
        end = self._at + count
        if end > len(self._body):
            raise InputError(f"a field of {count} octets leads out of its record of {len(self._body)}")
        taken, self._at = self._body[self._at : end], end
        return taken

    def integer(self, width: int) -> int:
        """The next little-endian unsigned integer of ``width`` octets."""
        return int.from_bytes(self.octets(width), "little")

    def text(self) -> str:
        """The next string: its length in four octets, then UTF-8."""
        return self.octets(self.integer(4)).decode("utf-8", "replace")

    def pairs(self) -> dict[str, str]:
        """The next map from string to string."""
        inside = Fields(self.octets(self.integer(4)))
        found: dict[str, str] = {}
        while inside._at < len(inside._body):
            key = inside.text()
            found[key] = inside.text()
        return found


def metadata(body: bytes) -> tuple[str, dict[str, str]]:
    """The name and the pairs of one metadata record."""
    fields = Fields(body)
    return fields.text(), fields.pairs()


def messages(data: bytes, base: int, known: Definitions, *, cut: bool) -> list[Message]:
    """The messages among the records of ``data``, in their order; definitions go to ``known``.

    ``base`` is the rank that the first record gets: what is later in the file has a higher rank. ``cut``
    allows the last record to be incomplete.
    """
    found: list[Message] = []
    channels, at, size = known.channels, 0, len(data)
    while at + HEAD.size <= size:
        opcode, length = HEAD.unpack_from(data, at)
        following = at + HEAD.size + length
        if following > size:
            break
        if opcode == MESSAGE:
            if length < MESSAGE_FIXED:
                raise InputError(f"a message record of {length} octets")
            _, _, number, _, time, _ = MESSAGE_HEAD.unpack_from(data, at)
            channel = channels.get(number) or _nameless(number, channels)
            found.append((time, base + at, channel, data[at + MESSAGE_HEAD.size : following]))
            if len(found) > MOST_MESSAGES:
                raise InputError(
                    f"a chunk of more than {MOST_MESSAGES} messages", cure="write smaller chunks"
                )
        elif opcode in (SCHEMA, CHANNEL):
            known.learn(opcode, data[at + HEAD.size : following])
        at = following
    if at < size and not cut:
        raise InputError("the last record leads out of its chunk")
    return found


def channel_of(number: int, known: Definitions) -> Channel:
    """The channel of that number, whether it is defined or not."""
    return known.channels.get(number) or _nameless(number, known.channels)


def _nameless(number: int, channels: dict[int, Channel]) -> Channel:
    # A message whose channel the file never defines still counts in the index; nobody will know its channel.
    return channels.setdefault(number, Channel("", "", None, {"undefined": str(number)}))


def unpack(raw: bytes, compression: str, size: int, crc: int, *, cut: bool) -> bytes:
    """A chunk's records from its compressed octets; ``cut``: as much as can be had of an incomplete chunk.

    The claimed ``size`` is never exceeded, whatever the compressed octets would expand to.
    """
    if size > LARGEST_CHUNK:
        raise InputError(f"a chunk claims {size} octets", cure=f"write chunks below {LARGEST_CHUNK} octets")
    data = _inflate(raw, compression, size + 1)
    if len(data) > size or (len(data) < size and not cut):
        raise InputError(f"a chunk claims {size} octets and holds {_count(data, size)}")
    if crc and not cut and zlib.crc32(data) != crc:
        raise InputError("a chunk's CRC does not match its octets", cure="copy the recording again")
    return data


def _count(data: bytes, size: int) -> str:
    return "more" if len(data) > size else str(len(data))


def _inflate(raw: bytes, compression: str, limit: int) -> bytes:
    if compression in ("", "none"):
        return raw[:limit]
    try:
        if compression == "zstd":
            return _inflate_zstd(raw, limit)
        if compression == "lz4":
            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(raw, max_length=limit))
    except (zstandard.ZstdError, RuntimeError, EOFError, MemoryError) as error:
        raise InputError(f"a {compression} chunk cannot be unpacked: {error}") from None
    raise InputError(f"chunks compressed with {compression!r}", cure="use none, lz4 or zstd")


def _inflate_zstd(raw: bytes, limit: int) -> bytes:
    with suppress(zstandard.ZstdError):  # the other way tells what is wrong, and how much there is
        if 0 < zstandard.frame_content_size(raw) < limit:
            return zstandard.ZstdDecompressor().decompress(raw, allow_extra_data=False)
    reader = zstandard.ZstdDecompressor().stream_reader(io.BytesIO(raw), read_across_frames=True)
    pieces: list[bytes] = []
    while limit > 0 and (piece := reader.read(min(limit, _PIECE))):
        pieces.append(piece)
        limit -= len(piece)
    return b"".join(pieces)

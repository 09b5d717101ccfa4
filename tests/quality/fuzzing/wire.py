"""Recordings and captures as octets, record by record: also what no writer would ever write."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Mapping, Sequence
from random import Random

import lz4.frame
import zstandard

from mmsverify.formats.trace import Channel, Schema

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, DATA_END, CHUNK, METADATA = 1, 2, 15, 6, 12
Said = tuple[int, Channel, bytes]
"""Time in ns, channel, octets."""


def record(opcode: int, body: bytes) -> bytes:
    """One record with its true length."""
    return struct.pack("<BQ", opcode, len(body)) + body


def text(octets: bytes) -> bytes:
    """Octets behind their length."""
    return struct.pack("<I", len(octets)) + octets


def pairs(held: Mapping[str, str]) -> bytes:
    """A map of strings."""
    return text(b"".join(text(k.encode()) + text(v.encode()) for k, v in held.items()))


def definitions(channels: Sequence[Channel]) -> bytes:
    """The schema and the record of each channel, numbered from 1."""
    return b"".join(_schema(n, c.schema) + _channel(n, c) for n, c in enumerate(channels, 1))


def _schema(number: int, schema: Schema | None) -> bytes:
    if schema is None:
        return b""
    fields = text(schema.name.encode()) + text(schema.encoding.encode()) + text(schema.data)
    return record(3, struct.pack("<H", number) + fields)


def _channel(number: int, channel: Channel) -> bytes:
    fields = text(channel.topic.encode()) + text(channel.message_encoding.encode()) + pairs(channel.metadata)
    return record(4, struct.pack("<HH", number, number if channel.schema else 0) + fields)


def message(number: int, sequence: int, time: int, data: bytes) -> bytes:
    """A message of the channel with that number."""
    return record(5, struct.pack("<HIQQ", number, sequence, time, time) + data)


def chunk(records: bytes, compression: str, *, begin: int = 0, end: int = 1 << 62, crc: bool = True) -> bytes:
    """A chunk of records, truly told."""
    packed = {"": bytes, "lz4": lz4.frame.compress, "zstd": zstandard.ZstdCompressor().compress}[compression](
        records
    )
    head = struct.pack("<QQQI", begin, end, len(records), zlib.crc32(records) if crc else 0)
    return record(CHUNK, head + text(compression.encode()) + struct.pack("<Q", len(packed)) + packed)


def file(records: bytes) -> bytes:
    """A whole file around records."""
    end = record(DATA_END, b"\x00" * 4) + record(FOOTER, b"\x00" * 20)
    return MAGIC + record(HEADER, text(b"") + text(b"fuzz")) + records + end + MAGIC


def records(said: Iterable[Said], profile: Mapping[str, str] | None = None) -> bytes:
    """Definitions, the profile's metadata, and messages."""
    held = list(said)
    channels = list(dict.fromkeys(channel for _, channel, _ in held))
    told = record(METADATA, text(b"mmsverify.profile") + pairs(profile)) if profile else b""
    spoken = (
        message(channels.index(channel) + 1, at, time, data) for at, (time, channel, data) in enumerate(held)
    )
    return definitions(channels) + told + b"".join(spoken)


def bomb(rng: Random, largest: int) -> bytes:
    """A chunk that is small as it stands and large when unpacked: many small messages, or one large one."""
    size = int(2 ** rng.uniform(16, largest.bit_length() - 1))
    one = message(1, 0, 1, b"\x00" * rng.choice((0, 0, 9, size)))
    many = one * max(size // len(one), 1)
    return file(chunk(many, rng.choice(("zstd", "lz4")), crc=rng.random() < 0.5))


def block(kind: int, body: bytes) -> bytes:
    """One little-endian pcapng block."""
    padded = body + bytes(-len(body) % 4)
    size = struct.pack("<I", len(padded) + 12)
    return struct.pack("<I", kind) + size + padded + size


def pcapng(packets: Iterable[bytes], link: int = 1) -> bytes:
    """A section with one interface, which has options, and enhanced, simple and old packets in turn."""
    begin = block(0x0A0D0D0A, b"\x4d\x3c\x2b\x1a\x01\x00\x00\x00" + b"\xff" * 8)
    options = struct.pack("<HHB3xHHqHH", 9, 1, 9, 14, 8, 0, 0, 0)
    interface = block(1, struct.pack("<HHI", link, 0, 0) + options)
    blocks = (_packet(at, frame) for at, frame in enumerate(packets))
    return begin + interface + b"".join(blocks)


def _packet(at: int, frame: bytes) -> bytes:
    size = len(frame)
    if at % 5 == 3:
        return block(3, struct.pack("<I", size) + frame)
    if at % 5 == 4:
        return block(2, struct.pack("<HHIIII", 0, 0, 0, at, size, size) + frame)
    return block(6, struct.pack("<IIIII", 0, 0, at, size, size) + frame)

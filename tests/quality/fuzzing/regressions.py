"""Inputs that were faults once, as small as they became: a table of octets, and a few that are made in code.

Octets stand there in hexadecimal, ``05 00*3`` for 05 00 00 00: a stretch, and how often.
"""

from __future__ import annotations

import gzip
import struct
import zlib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from capture_wire import Talk, captured, pcap

from fuzzing import wire

TABLE = Path(__file__).resolve().parents[1] / "fuzz_regressions.tsv"


def regressions() -> Iterator[tuple[str, str, bytes]]:
    """Target, name and octets of each."""
    for line in TABLE.read_text(encoding="utf-8").splitlines()[1:]:
        target, name, octets, _ = line.split("\t")
        yield target, name, b"".join(map(_stretch, octets.split()))
    for (target, name), make in _MADE.items():
        yield target, name, make()


def _stretch(text: str) -> bytes:
    octets, _, count = text.partition("*")
    return bytes.fromhex(octets) * int(count or 1)


def _small_messages() -> bytes:
    """Some thousand octets that unpack to two million messages."""
    one = wire.message(1, 0, 1, b"")
    return wire.file(wire.chunk(one * ((63 << 20) // len(one)), "zstd"))


def _ends() -> bytes:
    """A file that ends its data again and again, with the true CRC: all before was summed each time."""
    octets, crc = bytearray(wire.MAGIC), zlib.crc32(wire.MAGIC)
    for _ in range(40_000):
        end = wire.record(wire.DATA_END, struct.pack("<I", crc))
        octets += end
        crc = zlib.crc32(end, crc)
    return bytes(octets)


def _zipped_packet() -> bytes:
    """A capture of some ten thousand octets in gzip: one packet of 60 MiB in which anything may be a TPKT."""
    frame = captured(Talk().say(("client", b"")))[40:]
    lied = bytearray(frame[:16] + b"\x00\x00" + frame[18:] + b"\x03\x00" * (30 << 20))
    size = struct.pack("<I", len(lied))
    return gzip.compress(pcap([])[:24] + bytes(8) + size + size + lied, mtime=0)


_MADE: Mapping[tuple[str, str], Callable[[], bytes]] = {
    ("mcap", "two-million-messages-in-a-chunk"): _small_messages,
    ("mcap", "the-data-end-forty-thousand-times"): _ends,
    ("capture", "a-packet-of-sixty-mib-in-gzip"): _zipped_packet,
}

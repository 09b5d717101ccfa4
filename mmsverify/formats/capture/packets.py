"""Capture files (pcap, pcapng, either in gzip) as a stream of packets. What a packet holds is not read.

Own code for the container only: dpkt's readers keep times as floating point, know one interface per file and
raise on a capture that was cut off. pcapng per draft-ietf-opsawg-pcapng; pcap per draft-ietf-opsawg-pcap.
"""

from __future__ import annotations

import gzip
import os
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, NamedTuple

from mmsverify.errors import InputError

# Octets of one block, and of one packet in it; a larger claim is a lie. The limits are those of Wireshark.
_LARGEST = 16 << 20
_LARGEST_PACKET = 256 << 10
_NANO = 1_000_000_000
_LATEST = (1 << 64) - 1  # what a trace can hold
_PCAP = {  # magic as it stands in the file: byte order, ns per tick, size of a packet's header
    b"\xa1\xb2\xc3\xd4": (">", 1000, 16),
    b"\xd4\xc3\xb2\xa1": ("<", 1000, 16),
    b"\xa1\xb2\x3c\x4d": (">", 1, 16),
    b"\x4d\x3c\xb2\xa1": ("<", 1, 16),
    b"\xa1\xb2\xcd\x34": (">", 1000, 24),
    b"\x34\xcd\xb2\xa1": ("<", 1000, 24),
}
_SECTION, _INTERFACE, _OLD_PACKET, _SIMPLE, _ENHANCED = 0x0A0D0D0A, 1, 2, 3, 6
_ORDERS = {b"\x1a\x2b\x3c\x4d": ">", b"\x4d\x3c\x2b\x1a": "<"}


class Packet(NamedTuple):
    """One packet: its number in the file from 1, capture time in ns, link type (LINKTYPE_...), octets."""

    number: int
    time: int
    link: int
    data: bytes


class CutError(Exception):
    """The file ends inside a packet or block."""


class Capture:
    """The packets of one capture file, once. ``cut`` says, after the last packet, why there are no more:
    the file ends inside a packet, or is damaged from there on; empty where it is whole.

    Raises ``InputError`` where the file is no capture.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self.cut = ""

    def __iter__(self) -> Iterator[Packet]:
        try:
            with _open(self.path) as file:
                yield from self._packets(file)
        except OSError as error:
            raise InputError(error.strerror or str(error), place=self.path) from None
        except InputError as error:
            raise InputError(error.cause, place=self.path, cure=error.cure) from None

    def _packets(self, file: BinaryIO) -> Iterator[Packet]:
        try:
            magic = _exactly(file, 4)
        except CutError:
            raise InputError("not a capture: fewer than 4 octets") from None
        number = 0
        try:
            for time, link, data in _reader(magic, file):
                number += 1
                yield Packet(number, time, link, data)
        except CutError:
            self.cut = "the capture ends inside this packet"
        except InputError as error:
            if not number:
                raise
            self.cut = error.cause


def _open(path: str) -> BinaryIO:
    try:
        if Path(path).is_dir():
            raise InputError("a folder, not a capture")
        with open(path, "rb") as file:
            zipped = file.read(2) == b"\x1f\x8b"
        return gzip.open(path) if zipped else open(path, "rb")  # type: ignore[return-value]
    except ValueError as error:  # a NUL in the path
        raise InputError(str(error)) from None


def _exactly(file: BinaryIO, count: int, largest: int = _LARGEST) -> bytes:
    if count > largest:
        raise InputError(f"a packet or block claims {count} octets", cure="the capture is damaged")
    try:
        data = file.read(count)
    except (EOFError, zlib.error, gzip.BadGzipFile):
        raise CutError from None
    if len(data) < count:
        raise CutError
    return data


def _next(file: BinaryIO, count: int) -> bytes:
    """So many octets, or nothing at the end of the file."""
    try:
        data = file.read(count)
    except (EOFError, zlib.error, gzip.BadGzipFile):
        raise CutError from None
    if data and len(data) < count:
        raise CutError
    return data


def _reader(magic: bytes, file: BinaryIO) -> Iterator[tuple[int, int, bytes]]:
    if magic in _PCAP:
        return _pcap(file, *_PCAP[magic])
    if magic == _SECTION.to_bytes(4):
        return _Sections(file).packets()
    raise InputError("neither pcap nor pcapng", cure="import takes network captures")


def _pcap(file: BinaryIO, order: str, tick: int, size: int) -> Iterator[tuple[int, int, bytes]]:
    link = struct.unpack(order + "I", _exactly(file, 20)[16:])[0] & 0xFFFF  # above: the length of the FCS
    head_of = struct.Struct(order + "III").unpack_from
    while head := _next(file, size):
        seconds, fraction, count = head_of(head)
        yield seconds * _NANO + fraction * tick, link, _exactly(file, count, _LARGEST_PACKET)


def _captured(body: bytes, at: int, count: int) -> bytes:
    """The octets of a packet in its block; what a block claims beyond its own end is not there."""
    octets = body[at : at + count]
    if len(octets) > _LARGEST_PACKET:
        raise InputError(f"a packet or block claims {count} octets", cure="the capture is damaged")
    return octets


@dataclass(frozen=True, slots=True)
class _Interface:
    link: int
    ticks: int = 1_000_000  # per second
    offset: int = 0  # seconds

    def time(self, high: int, low: int) -> int:
        time = self.offset * _NANO + (high << 32 | low) * _NANO // self.ticks
        return min(max(time, 0), _LATEST)


class _Sections:
    """pcapng: sections with a byte order and interfaces of their own."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._order = "<"
        self._interfaces: list[_Interface] = []
        self._time = 0

    def packets(self) -> Iterator[tuple[int, int, bytes]]:
        """Walk the blocks; the type of the first was already read."""
        self._section()
        while kind := _next(self._file, 4):
            number = self._unpack("I", kind)[0]
            if number == _SECTION:
                self._section()
                continue
            packet = self._block(number, self._body())
            if packet is not None:
                yield packet

    def _unpack(self, form: str, data: bytes) -> tuple[int, ...]:
        try:
            return struct.unpack_from(self._order + form, data)
        except struct.error:
            raise InputError(f"a pcapng block of {len(data)} octets is too short") from None

    def _section(self) -> None:
        head = _exactly(self._file, 8)
        order = _ORDERS.get(head[4:])
        if order is None:
            raise InputError("a pcapng section without byte order")
        self._order, self._interfaces = order, []
        length = self._unpack("I", head)[0]
        _exactly(self._file, max(length - 12, 0))

    def _body(self) -> bytes:
        length = self._unpack("I", _exactly(self._file, 4))[0]
        if length < 12:
            raise InputError(f"a pcapng block claims {length} octets")
        padded = length + -length % 4
        return _exactly(self._file, padded - 8)[: length - 12]

    def _block(self, kind: int, body: bytes) -> tuple[int, int, bytes] | None:
        if kind == _INTERFACE:
            self._interfaces.append(self._interface(body))
        elif kind == _ENHANCED:
            number, high, low, count, _ = self._unpack("IIIII", body)
            return self._packet(number, high, low, _captured(body, 20, count))
        elif kind == _OLD_PACKET:
            number, _, high, low, count, _ = self._unpack("HHIIII", body)
            return self._packet(number, high, low, _captured(body, 20, count))
        elif kind == _SIMPLE:
            count = self._unpack("I", body)[0]
            # It has no time: that of the packet before.
            return self._time, self._of(0).link, _captured(body, 4, count)
        return None

    def _packet(self, number: int, high: int, low: int, data: bytes) -> tuple[int, int, bytes]:
        interface = self._of(number)
        self._time = interface.time(high, low)
        return self._time, interface.link, data

    def _of(self, number: int) -> _Interface:
        if number >= len(self._interfaces):
            raise InputError(f"a pcapng packet of interface {number}, which no block describes")
        return self._interfaces[number]

    def _interface(self, body: bytes) -> _Interface:
        link = self._unpack("H", body)[0]
        options = self._options(body[8:])
        resolution = options.get(9, b"\x06")[:1] or b"\x06"
        power = resolution[0] & 0x7F
        ticks = 2**power if resolution[0] & 0x80 else 10 ** min(power, 30)
        offset = int.from_bytes(
            options.get(14, b"")[:8], "little" if self._order == "<" else "big", signed=True
        )
        return _Interface(link, ticks, offset)

    def _options(self, data: bytes) -> dict[int, bytes]:
        found: dict[int, bytes] = {}
        at = 0
        while at + 4 <= len(data):
            code, length = self._unpack("HH", data[at : at + 4])
            if code == 0:
                break
            found[code] = data[at + 4 : at + 4 + length]
            at += 4 + length + -length % 4
        return found

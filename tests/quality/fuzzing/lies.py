"""Lengths that lie: where each format has its lengths, and what may stand there instead."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator, Sequence
from random import Random
from typing import Literal

from fuzzing.mutate import Mutator

Order = Literal["big", "little"]
Place = tuple[int, int, Order]
"""Where a length stands, its octets, their order."""


def lying(places: Callable[[bytes], Iterator[Place]]) -> Mutator:
    """A mutator that changes one of the lengths that ``places`` finds."""

    def lie(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
        found = list(places(data))
        if not found:
            return data
        at, width, order = rng.choice(found)
        top = 1 << 8 * width
        true = int.from_bytes(data[at : at + width], order)
        near = true + rng.choice((-9, -4, -2, -1, 1, 2, 4, 9))
        told = rng.choice(
            (near, near, 0, 1, top - 1, top // 2, true * 2, 1 << 26, 1 << 30, rng.randrange(top))
        )
        return data[:at] + (told % top).to_bytes(width, order) + data[at + width :]

    return lie


def tpkt(data: bytes) -> Iterator[Place]:
    """TPKT: two octets after 03 00; and the length indicator of the TPDU behind."""
    at = 0
    while at + 4 <= len(data):
        if data[at : at + 2] != b"\x03\x00":
            at += 1
            continue
        yield at + 2, 2, "big"
        yield at + 4, 1, "big"
        at += max(int.from_bytes(data[at + 2 : at + 4]), 4)


def session(data: bytes) -> Iterator[Place]:
    """The length indicators of an SPDU and of its parameters, as far as they lead."""
    at = 1
    while at < min(len(data), 64):
        yield at, 1, "big"
        at += 2 if at == 1 else 2 + data[at]


def mbap(data: bytes) -> Iterator[Place]:
    """MBAP: the length after transaction and protocol; the protocol too; byte counts behind."""
    at = 0
    while at + 8 <= len(data):
        yield at + 4, 2, "big"
        yield at + 2, 2, "big"
        yield from ((at + more, 1, "big") for more in (8, 12) if at + more < len(data))
        at += 6 + max(int.from_bytes(data[at + 4 : at + 6]), 2)


def pcap(data: bytes) -> Iterator[Place]:
    """pcap, little-endian as the seeds are: captured and original length of each packet, the link type."""
    yield 20, 4, "little"
    at = 24
    while at + 16 <= len(data):
        yield at + 8, 4, "little"
        yield at + 12, 4, "little"
        yield from _network(at + 16)
        at += 16 + struct.unpack_from("<I", data, at + 8)[0]


def pcapng(data: bytes) -> Iterator[Place]:
    """pcapng, little-endian: the length of each block, of a packet, of options; an interface's number."""
    at = 0
    while at + 12 <= len(data):
        yield at + 4, 4, "little"
        yield at + 8, 4, "little"
        yield at + 16, 2, "little"
        yield at + 18, 2, "little"
        yield at + 20, 4, "little"
        yield from _network(at + 28)
        at += max(struct.unpack_from("<I", data, at + 4)[0], 12)


def _network(frame: int) -> Iterator[Place]:
    """Below Ethernet: what is inside, IP's head and length, fragment, protocol, TCP's head."""
    yield frame + 12, 2, "big"
    for at, width in ((14, 1), (16, 2), (20, 2), (23, 1), (46, 1)):
        yield frame + at, width, "big"


def frames(data: bytes) -> Iterator[Place]:  # noqa: ARG001
    """The same of one frame behind the octet that tells its link."""
    yield 0, 1, "big"
    yield from _network(1)


def mcap(data: bytes) -> Iterator[Place]:
    """MCAP: each record's length, and the lengths of four octets that its fields begin with."""
    at = 8
    while at + 9 <= len(data):
        size = struct.unpack_from("<Q", data, at + 1)[0]
        yield at + 1, 8, "little"
        if data[at] in _FIELDS:
            yield from ((at + 9 + more, width, "little") for more, width in _FIELDS[data[at]])
        at += 9 + size


_FIELDS: dict[int, tuple[tuple[int, int], ...]] = {
    1: ((0, 4),),
    3: ((0, 2), (2, 4)),
    4: ((0, 2), (2, 2), (4, 4)),
    5: ((0, 2), (6, 8)),
    6: ((0, 8), (8, 8), (16, 8), (24, 4), (28, 4), (32, 4), (36, 8)),
    12: ((0, 4),),
    15: ((0, 4),),
}
"""By opcode: where numbers stand in a record, and their octets."""

"""BER octets taken apart and put together again, so that what is changed inside keeps a true length outside.

A flipped octet seldom comes further than the first length; a changed tree reaches the innermost field.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

_DEEPEST = 24
_LARGEST = 1 << 16
"""Octets of what is taken apart: a tree takes some hundred times the memory of its octets."""
_LIES = (
    b"\x80",
    b"\xff",
    b"\x81\x00",
    b"\x84\xff\xff\xff\xff",
    b"\x84\x00\x00\x00\x01",
    b"\xfe" + b"\xff" * 126,
)
_CONTENTS = (
    b"", b"\x00", b"\xff", b"\x80", b"\x7f\xff\xff\xff", b"\x80\x00\x00\x00", b"\x00\xff\xff\xff\xff",
    b"\x07\x80", b"\x09\xff", b"\xc3\x28", b"\x1b\x24", b"\x00" * 9, b"R_ARM", b"R_CTRL", b"-" * 33,
)  # fmt: skip


@dataclass(slots=True)
class Node:
    """One element; ``lie`` are the octets that stand where its length belongs."""

    tag: bytes
    inside: list[Node] | bytes
    lie: bytes = b""


def parse(octets: bytes, depth: int = 0) -> list[Node] | None:
    """The elements that fill the octets; nothing where they are none, or too many to be taken apart."""
    if len(octets) > _LARGEST:
        return None
    nodes, at = [], 0
    while at < len(octets):
        begin = _after_tag(octets, at)
        size, start = _length(octets, begin)
        if start + size > len(octets):
            return None
        inside = octets[start : start + size]
        below = parse(inside, depth + 1) if octets[at] & 0x20 and depth < _DEEPEST else None
        nodes.append(Node(octets[at:begin], inside if below is None else below))
        at = start + size
    return nodes


def _after_tag(octets: bytes, at: int) -> int:
    begin = at + 1
    if octets[at] & 0x1F == 0x1F:
        while begin < len(octets) and octets[begin] & 0x80:
            begin += 1
        begin += 1
    return begin


def _length(octets: bytes, at: int) -> tuple[int, int]:
    if at >= len(octets):
        return 1, at  # leads out
    if octets[at] < 0x80:
        return octets[at], at + 1
    start = at + 1 + (octets[at] & 0x7F)
    return int.from_bytes(octets[at + 1 : start]), start


def written(nodes: Sequence[Node]) -> bytes:
    """The octets of some elements."""
    return b"".join(node.tag + _sized(node) for node in nodes)


def _sized(node: Node) -> bytes:
    contents = node.inside if isinstance(node.inside, bytes) else written(node.inside)
    return (node.lie or length(len(contents))) + contents


def length(size: int) -> bytes:
    """The length octets of contents of that size."""
    if size < 0x80:
        return bytes((size,))
    shortest = size.to_bytes((size.bit_length() + 7) // 8)
    return bytes((0x80 | len(shortest),)) + shortest


def _everywhere(nodes: list[Node]) -> Iterator[tuple[list[Node], int]]:
    for at, node in enumerate(nodes):
        yield nodes, at
        if isinstance(node.inside, list):
            yield from _everywhere(node.inside)


def tree(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:
    """One element is changed, repeated, gone, exchanged, given another's inside, or lies about its length."""
    nodes = parse(data)
    places = list(_everywhere(nodes)) if nodes else []
    if not nodes or not places:
        return data
    home, at = rng.choice(places)
    rng.choice((_contents, _grown, _lies, _gone, _again, _swapped, _grafted, _retagged))(rng, home, at, seeds)
    return written(nodes)


def _contents(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:  # noqa: ARG001
    home[at].inside = rng.choice(_CONTENTS) if rng.random() < 0.8 else rng.randbytes(rng.randint(1, 40))


def _grown(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:  # noqa: ARG001
    """A number or text of thousands of octets."""
    size = int(2 ** rng.uniform(4, 13))
    home[at].inside = rng.choice((b"\x7f", b"\x80", b"A", b"\x01")) + rng.choice((b"\xff", b"\x41")) * size


def _lies(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:  # noqa: ARG001
    size = len(written([home[at]]))
    near = length(max(0, size + rng.randint(-4, 2)))
    longer = b"\x88" + size.to_bytes(8)
    home[at].lie = rng.choice((*_LIES, near, near, longer))


def _gone(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:  # noqa: ARG001
    del home[at]


def _again(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:  # noqa: ARG001
    most = _LARGEST // max(len(written([home[at]])), 1)
    home[at:at] = [home[at]] * min(rng.randint(1, 3) if rng.random() < 0.95 else 500, most)


def _swapped(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:  # noqa: ARG001
    other = rng.randrange(len(home))
    home[at], home[other] = home[other], home[at]


def _grafted(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:
    others = list(_everywhere(parse(rng.choice(seeds)) or []))
    if others:
        theirs, where = rng.choice(others)
        home[at] = theirs[where]


def _retagged(rng: Random, home: list[Node], at: int, seeds: Sequence[bytes]) -> None:  # noqa: ARG001
    tag = bytearray(home[at].tag)
    tag[-1] = (tag[-1] & 0xE0) | rng.randrange(31) if len(tag) == 1 else rng.randrange(0x80)
    home[at].tag = bytes(tag)

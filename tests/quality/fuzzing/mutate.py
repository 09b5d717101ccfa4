"""Mutators that know no format: octets flipped, cut, spliced, doubled, swollen.

Each takes the chance that decides, the octets, and the other seeds. `Mutation` mixes them with what a format
adds: lies about its lengths, things nested in each other, its own tree taken apart.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from random import Random

Mutator = Callable[[Random, bytes, Sequence[bytes]], bytes]

EDGES = (0x00, 0x01, 0x02, 0x1F, 0x20, 0x30, 0x7F, 0x80, 0x81, 0x84, 0xA0, 0xBF, 0xFE, 0xFF)
"""Octets at which decoders change their minds."""


def flip(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """Some bits."""
    changed = bytearray(data)
    for _ in range(rng.randint(1, 4) if data else 0):
        changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def replace(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """Some octets, each by one at an edge or any."""
    changed = bytearray(data)
    for _ in range(rng.randint(1, 3) if data else 0):
        changed[rng.randrange(len(changed))] = rng.choice(EDGES) if rng.random() < 0.7 else rng.randrange(256)
    return bytes(changed)


def cut(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """The end is missing, or the begin."""
    at = rng.randint(0, len(data))
    return data[:at] if rng.random() < 0.8 else data[at:]


def drop(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """A stretch in the middle is missing."""
    begin, end = _stretch(rng, data, 16)
    return data[:begin] + data[end:]


def insert(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """Octets that do not belong there."""
    at = rng.randint(0, len(data))
    return data[:at] + rng.randbytes(rng.randint(1, 8)) + data[at:]


def splice(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:
    """The begin of one and the end of another."""
    other = rng.choice(seeds)
    return data[: rng.randint(0, len(data))] + other[rng.randint(0, len(other)) :]


def double(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """A stretch is there twice, or a few times."""
    begin, end = _stretch(rng, data, 64)
    return data[:end] + data[begin:end] * rng.randint(1, 4) + data[end:]


def move(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """A stretch stands elsewhere."""
    begin, end = _stretch(rng, data, 64)
    rest = data[:begin] + data[end:]
    at = rng.randint(0, len(rest))
    return rest[:at] + data[begin:end] + rest[at:]


def number(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """A number of two, four or eight octets becomes one at an edge."""
    width = rng.choice((2, 4, 8))
    at = rng.randint(0, max(len(data) - width, 0))
    edge = rng.choice((0, 1, 1 << 8 * width - 1, (1 << 8 * width) - 1, len(data), rng.getrandbits(8 * width)))
    written = (edge % (1 << 8 * width)).to_bytes(width, rng.choice(("big", "little")))
    return data[:at] + written + data[at + width :]


def nothing(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """No octet at all."""
    return b""


def swell(rng: Random, data: bytes, seeds: Sequence[bytes], largest: int) -> bytes:  # noqa: ARG001
    """A stretch is there so often that the whole is large: what takes the square of a length shows."""
    begin, end = _stretch(rng, data, 24) if rng.random() < 0.7 else (0, len(data))
    size = int(largest ** rng.uniform(0.5, 1.0))
    return data[:begin] + data[begin:end] * (size // max(end - begin, 1)) + data[end:]


def run(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """One character of a text, up to a hundred thousand times."""
    at = rng.randint(0, len(data))
    one = rng.choice(
        (
            b" ",
            b"\t",
            b"\n",
            b",",
            b";",
            b'"',
            b"'",
            b"(",
            b"[",
            b".",
            b"0",
            b"9",
            b"-",
            b"_",
            b":",
            b"/",
            b"#",
            b"\\",
            b"e",
            b"1,",
            b"a.",
            b"a=",
            b" (",
            b"x ",
        )
    )
    return data[:at] + one * int(2 ** rng.uniform(2, 17)) + data[at:]


def _stretch(rng: Random, data: bytes, most: int) -> tuple[int, int]:
    begin = rng.randint(0, len(data))
    return begin, min(len(data), begin + rng.randint(1, most))


GENERAL: tuple[tuple[Mutator, float], ...] = (
    (flip, 4),
    (replace, 4),
    (cut, 2),
    (drop, 2),
    (insert, 2),
    (splice, 2),
    (double, 2),
    (move, 1),
    (number, 2),
    (nothing, 0.05),
)


@dataclass(frozen=True, slots=True)
class Mutation:
    """How the octets of one format are mutated: ``own`` mutators with their weights beside the general ones.

    ``largest``: octets to which an input may swell; ``swollen``: how many of a thousand do.
    """

    seeds: Sequence[bytes]
    own: Sequence[tuple[Mutator, float]] = ()
    largest: int = 1 << 20
    swollen: float = 3.0

    def __call__(self, rng: Random) -> bytes:
        data = rng.choice(self.seeds)
        if rng.random() * 1000 < self.swollen:
            data = swell(rng, data, self.seeds, self.largest)
        # Half of the inputs are mutated by what knows the format alone: they come further in.
        mixed = not self.own or rng.random() < 0.5
        mutators, weights = zip(*(GENERAL if mixed else ()), *self.own, strict=True)
        for mutator in rng.choices(mutators, weights, k=_rounds(rng)):
            data = mutator(rng, data, self.seeds)
        return data


def _rounds(rng: Random) -> int:
    rounds = 1
    while rng.random() < 0.4 and rounds < 6:
        rounds += 1
    return rounds

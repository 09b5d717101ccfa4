"""Things inside each other, ten to a hundred thousand deep."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from fuzzing.trees import length, parse, written

_JSON = ((b"[", b"]"), (b'{"a":', b"}"), (b'{"VR0":[', b"]}"))
_TOML = ((b"[", b"]"), (b"{a=", b"}"), (b"{name=[", b"]}"))


def depth(rng: Random) -> int:
    """Ten to a hundred thousand, every order of size as often."""
    return int(10 ** rng.uniform(1, 5))


def nested(deep: int, tags: Sequence[bytes], inside: bytes = b"") -> bytes:
    """Elements in elements, the tags in turn, every length true."""
    heads, size = [], len(inside)
    for at in range(deep):
        head = tags[at % len(tags)] + length(size)
        heads.append(head)
        size += len(head)
    return b"".join(reversed(heads)) + inside


def ber(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """Constructed elements around what is there, or in place of one of its elements."""
    tags = rng.choice(((b"\x30",), (b"\xa0",), (b"\xa2", b"\xa1"), (b"\xbf\x4f",), (b"\xa0", b"\x30")))
    nodes = parse(data)
    if not nodes or rng.random() < 0.3:
        return nested(depth(rng), tags, data)
    home = nodes
    while isinstance(home[0].inside, list) and home[0].inside and rng.random() < 0.8:
        home = home[0].inside
    node = rng.choice(home)
    node.inside = nested(depth(rng), tags, b"\x05\x00")
    return written(nodes)


def own_tag(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """The tag of the first element around itself, again and again: a type inside its own definition."""
    nodes = parse(data)
    if not nodes or not isinstance(nodes[0].inside, list) or not nodes[0].inside:
        return data
    inner = nodes[0].inside[-1]
    inner.inside = nested(depth(rng), [inner.tag], b"\x80\x01\x00")
    return written(nodes)


def json(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """Lists and objects in place of a value, closed or not."""
    return _bracketed(rng, data, b":", _JSON)


def toml(rng: Random, data: bytes, seeds: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """Lists and tables in place of a value, or keys of many parts."""
    if rng.random() < 0.3:
        keys = b".".join([b"a"] * min(depth(rng), 5000))
        return data + rng.choice((b"\n[%b]\n", b"\n%b = 1\n", b"\n[[%b]]\n")) % keys
    return _bracketed(rng, data, b"=", _TOML)


def _bracketed(rng: Random, data: bytes, mark: bytes, pairs: Sequence[tuple[bytes, bytes]]) -> bytes:
    opened, closed = rng.choice(pairs)
    deep = depth(rng)
    thing = opened * deep + b"1" + (closed * deep if rng.random() < 0.7 else b"")
    places = [at for at in range(len(data)) if data[at : at + 1] == mark]
    if not places:
        return data + thing
    at = rng.choice(places) + 1
    return data[:at] + thing + (data[data.find(b"\n", at) :] if b"\n" in data[at:] else data[-1:])

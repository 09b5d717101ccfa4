"""Compiled ASN.1 types, continued: the built-in types that hold a value and no elements.

What lives here pairs the contents octets of `ber` with the bounds a type declares and with the Python type of
its values.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mmsverify.formats import ber
from mmsverify.formats.ber import CONSTRUCTED, Fault
from mmsverify.formats.codec import Misfit, Reader, Walk

Read = Callable[[bytes, int, int], Any]
Pack = Callable[[Any], bytes]
Bounds = tuple[tuple[int, int], ...]
"""Ranges, ends included; a value must lie in one of them. Empty: no bound."""


class Primitive:
    """A built-in type under one tag; ``kind`` is its ASN.1 name, ``bounds`` those of its value or size."""

    __slots__ = ("_pack", "bounds", "head", "kind", "readers")

    def __init__(self, head: int, kind: str, bounds: Bounds = ()) -> None:
        read, self._pack = _KINDS[kind]
        self.head = head
        self.kind = kind
        self.bounds = bounds
        # Of an INTEGER with bounds, and of text, not every value is one.
        free = kind in ("OCTET STRING", "BIT STRING") or (kind == "INTEGER" and not bounds)
        bounded = _bounded(read, kind, bounds) if bounds else read
        self.readers: dict[int, Reader] = {head: _covered(bounded, kind) if free else _reader(bounded)}
        if kind == "NULL":
            self.readers[constructed(head)] = _constructed_null

    def write(self, value: Any, depth: int) -> bytes:  # noqa: ARG002
        contents = self._pack(value)
        if self.bounds and not _within(self.bounds, _measure(self.kind, value)):
            raise Misfit(f"{value!r} is outside the bounds of its type")
        return ber.element(self.head, contents)


def constructed(head: int) -> int:
    """The identifier octets with the constructed bit set."""
    octets = (head.bit_length() + 7) // 8 or 1
    return head | CONSTRUCTED << 8 * (octets - 1)


def _reader(read: Read) -> Reader:
    def plain(walk: Walk, begin: int, end: int, depth: int) -> Any:  # noqa: ARG001
        return read(walk.octets, begin, end)

    return plain


def _covered(read: Read, kind: str) -> Reader:
    def covered(walk: Walk, begin: int, end: int, depth: int) -> Any:  # noqa: ARG001
        value = read(walk.octets, begin, end)
        return value if walk.cover is None else walk.cover(kind, begin, end, value)

    return covered


def _constructed_null(walk: Walk, begin: int, end: int, depth: int) -> None:  # noqa: ARG001
    """Some senders set the constructed bit of a NULL: harmless, so it is read; wrong, so it is remarked."""
    ber.read_null(walk.octets, begin, end)
    walk.remarks.append(f"octet {begin}: a NULL is written as a constructed element")


def _bounded(read: Read, kind: str, bounds: Bounds) -> Read:
    def within(octets: bytes, begin: int, end: int) -> Any:
        value = read(octets, begin, end)
        if not _within(bounds, _measure(kind, value)):
            what = value if kind == "INTEGER" else f"a size of {len(value)}"
            raise Fault(f"{what} is outside the bounds of its type", begin)
        return value

    return within


def _within(bounds: Bounds, measure: int) -> bool:
    return any(low <= measure <= high for low, high in bounds)


def _measure(kind: str, value: Any) -> int:
    return int(value) if kind == "INTEGER" else len(value)


def _checked(kind: type, pack: Pack) -> Pack:
    def checked(value: Any) -> bytes:
        if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
            raise Misfit(f"a value of type {kind.__name__} is needed, not {value!r}")
        return pack(value)

    return checked


def _text(read: Read, encoding: str) -> tuple[Read, Pack]:
    """A string type: what it writes must read back."""

    def pack(value: str) -> bytes:
        try:
            octets = value.encode(encoding)
            read(octets, 0, len(octets))
        except (UnicodeEncodeError, Fault) as bad:
            raise Misfit(f"{value!r} has a character that the type does not allow") from bad
        return octets

    return read, _checked(str, pack)


def _pack_bits(value: str) -> bytes:
    if value.strip("01"):
        raise Misfit(f"a bit string is written with 0 and 1, not as {value!r}")
    return ber.write_bits(value)


def _pack_oid(value: str) -> bytes:
    try:
        return ber.write_oid(value)
    except ValueError:
        raise Misfit(f"{value!r} is no object identifier") from None


def _pack_null(value: Any) -> bytes:
    if value is not None:
        raise Misfit(f"a NULL is None, not {value!r}")
    return b""


_KINDS: dict[str, tuple[Read, Pack]] = {
    "BOOLEAN": (ber.read_boolean, _checked(bool, lambda value: b"\xff" if value else b"\x00")),
    "INTEGER": (ber.read_integer, _checked(int, ber.write_integer)),
    "BIT STRING": (ber.read_bits, _checked(str, _pack_bits)),
    "OCTET STRING": (ber.read_octets, _checked(bytes, bytes)),
    "NULL": (ber.read_null, _pack_null),
    "OBJECT IDENTIFIER": (ber.read_oid, _checked(str, _pack_oid)),
    "ObjectDescriptor": _text(ber.read_graphic, "latin-1"),
    "UTF8String": _text(ber.read_utf8, "utf-8"),
    "GeneralizedTime": _text(ber.read_time, "ascii"),
    "GraphicString": _text(ber.read_graphic, "latin-1"),
    "VisibleString": _text(ber.read_visible, "ascii"),
}

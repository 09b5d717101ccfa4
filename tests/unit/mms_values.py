"""Hypothesis strategies for the values of compiled ASN.1 types, for the tests of the codec."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from mmsverify.formats.builtin import Primitive
from mmsverify.formats.codec import Choice, ListOf, Struct
from mmsverify.formats.tagging import EitherForm, Explicit, ExplicitAny

PRINTABLE = st.text(st.characters(min_codepoint=0x20, max_codepoint=0x7E), max_size=12)
KINDS: dict[str, SearchStrategy[Any]] = {
    "BOOLEAN": st.booleans(),
    "NULL": st.none(),
    "INTEGER": st.integers(-(2**70), 2**70),
    "BIT STRING": st.text("01", max_size=20),
    "OCTET STRING": st.binary(max_size=12),
    "OBJECT IDENTIFIER": st.sampled_from(["1.0.9506.2.1", "2.1.1", "0.39", "2.999.18446744073709551617"]),
    "ObjectDescriptor": PRINTABLE,
    "UTF8String": st.text(max_size=8),
    "GraphicString": PRINTABLE,
    "GeneralizedTime": st.sampled_from(["20260722101500Z", "2026072210.5", "202607221015+0130"]),
    "VisibleString": PRINTABLE,
}


def values(kind: Any, depth: int = 3, skip: frozenset[str] = frozenset()) -> SearchStrategy[Any]:
    """Values of a compiled type: below ``depth`` only what ends, members named in ``skip`` left out."""
    match kind:
        case Primitive():
            return primitive(kind)
        case Struct():
            return struct(kind, depth, skip)
        case ListOf():
            return st.lists(values(kind.item, depth - 1, skip), max_size=2) if depth > 0 else st.just([])
        case Choice():
            return st.one_of([paired(name, one, depth, skip) for name, one in ended(kind, depth)])
        case Explicit():
            return st.deferred(lambda: values(kind.inner, depth - 1, skip))
        case ExplicitAny():
            return st.sampled_from([b"\x05\x00", bytes.fromhex("30038001ff"), b"\x9f\x50\x01a"])
        case EitherForm():
            return values(kind.usual, depth, skip)
    return st.deferred(lambda: values(kind.target, depth, skip))


def primitive(kind: Primitive) -> SearchStrategy[Any]:
    if not kind.bounds:
        return KINDS[kind.kind]
    if kind.kind == "INTEGER":
        return st.one_of([st.integers(low, high) for low, high in kind.bounds])
    if kind.kind == "BIT STRING":
        return st.one_of([st.text("01", min_size=low, max_size=min(high, 20)) for low, high in kind.bounds])
    return st.one_of([st.binary(min_size=low, max_size=high) for low, high in kind.bounds])


def struct(kind: Struct, depth: int, skip: frozenset[str]) -> SearchStrategy[dict[str, Any]]:
    """A default is given or not: the reader fills it in, so it is always given here."""
    members = [member for member in kind.members if member.name not in skip]
    needed = {m.name: values(m.type, depth - 1, skip) for m in members if not m.optional}
    rest = {m.name: values(m.type, depth - 1, skip) for m in members if m.optional}
    return st.fixed_dictionaries(needed, optional=rest if depth > 0 else {})


def paired(name: str, kind: Any, depth: int, skip: frozenset[str]) -> SearchStrategy[tuple[str, Any]]:
    return st.deferred(lambda: values(kind, depth - 1, skip)).map(lambda value: (name, value))


def ended(kind: Choice, depth: int) -> list[tuple[str, Any]]:
    """The alternatives; when it is time to end, those that hold no further elements, if there are any."""
    plain = [(name, one) for name, one in kind.alternatives.items() if isinstance(one, Primitive)]
    return plain if depth <= 0 and plain else list(kind.alternatives.items())

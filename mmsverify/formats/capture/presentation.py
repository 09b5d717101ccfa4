"""The presentation layer (ISO 8823-1, X.226): contexts as negotiated, and the values in each of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from mmsverify.formats import ber
from mmsverify.formats.capture.faults import UnreadableError
from mmsverify.formats.capture.tlv import Element, elements, first, only

ACSE = bytes.fromhex("52010001")  # 2.2.1.0.1
_LAYER = "presentation"
_NORMAL_MODE, _SET, _SEQUENCE, _USER_DATA = 0xA2, 0x31, 0x30, 0x61
_DEFINITIONS, _RESULTS = 0xA4, 0xA5
_INTEGER, _OBJECT = 0x02, 0x06
_SINGLE, _ALIGNED, _ARBITRARY = 0xA0, 0x81, 0x82
_LONGEST = 8  # octets of a number; contexts are small odd ones, results smaller still


class Value(NamedTuple):
    """One presentation data value: the context that it stands in and its octets."""

    context: int
    octets: bytes


def connect(user: bytes) -> tuple[list[tuple[int, bytes]], list[Value]]:
    """A CP: the proposed contexts (identifier, abstract syntax) in order, and the values."""
    parameters = _parameters(user)
    listed = first(parameters, _LAYER, _DEFINITIONS)
    proposed = [_definition(item) for item in elements(listed.contents, _LAYER)] if listed else []
    return proposed, _values_of(parameters)


def accept(user: bytes) -> tuple[list[bool], list[Value]]:
    """A CPA: for each proposed context, in that order, whether it was accepted; and the values."""
    parameters = _parameters(user)
    listed = first(parameters, _LAYER, _RESULTS)
    results = [_accepted(item) for item in elements(listed.contents, _LAYER)] if listed else []
    return results, _values_of(parameters)


def values(user: bytes) -> list[Value]:
    """User data as it stands in the data phase and in a release: fully encoded."""
    element = only(user, _LAYER)
    if element.tag != _USER_DATA:
        raise UnreadableError(_LAYER, f"{element.tag:02X} where fully encoded data (61) belongs")
    return list(_listed(element.contents))


def plain(octets: bytes, at: int) -> Value | None:
    """The value that is all of the octets from ``at`` on, one of fully encoded data in the form of most.

    ``None`` where anything is otherwise, right or wrong.
    """
    size = len(octets)
    try:
        data, begin, end = ber.header(octets, at, size)
        item, begin, last = ber.header(octets, begin, size)
        value, inside, until = ber.header(octets, begin + 3, size)
    except (ber.Fault, IndexError):
        return None
    usual = (data, item, value) == (_USER_DATA, _SEQUENCE, _SINGLE) and end == last == until == size
    if not usual or octets[begin : begin + 2] != b"\x02\x01" or octets[begin + 2] > 0x7F:
        return None
    return Value(octets[begin + 2], octets[inside:])


def abort(user: bytes) -> list[Value]:
    """A user abort (with or without [0], its data tagged 61 or not), or a provider abort: no values."""
    if not user:
        return []
    element = only(user, _LAYER)
    if element.tag == _USER_DATA:
        return list(_listed(element.contents))
    inside = list(elements(element.contents, _LAYER))
    found = next((item for item in inside if item.tag == _USER_DATA), None)
    if found is None:
        found = next((item for item in inside if item.tag == _SINGLE), None)
    return list(_listed(found.contents)) if found else []


def _parameters(user: bytes) -> bytes:
    """The normal mode parameters of a CP or CPA."""
    element = only(user, _LAYER)
    normal = first(element.contents, _LAYER, _NORMAL_MODE) if element.tag == _SET else None
    if normal is None:
        raise UnreadableError(_LAYER, "no normal mode parameters")
    return normal.contents


def _definition(item: Element) -> tuple[int, bytes]:
    identifier = first(item.contents, _LAYER, _INTEGER)
    syntax = first(item.contents, _LAYER, _OBJECT)
    if identifier is None or syntax is None:
        raise UnreadableError(_LAYER, "a context definition without identifier or abstract syntax")
    return _integer(identifier), syntax.contents


def _accepted(item: Element) -> bool:
    result = first(item.contents, _LAYER, 0x80)
    return result is not None and _integer(result) == 0


def _integer(element: Element) -> int:
    if len(element.contents) > _LONGEST:
        raise UnreadableError(_LAYER, f"a number of {len(element.contents)} octets")
    return int.from_bytes(element.contents, "big", signed=True)


def _values_of(parameters: bytes) -> list[Value]:
    user = first(parameters, _LAYER, _USER_DATA)
    return list(_listed(user.contents)) if user else []


def _listed(octets: bytes) -> Iterator[Value]:
    for item in elements(octets, _LAYER):
        if item.tag != _SEQUENCE:
            raise UnreadableError(_LAYER, f"{item.tag:02X} where a presentation data value (30) belongs")
        yield pdv(item.contents)


def pdv(octets: bytes) -> Value:
    """The inside of a PDV-list, and of an EXTERNAL: the context, and the value in one of three forms."""
    context: int | None = None
    for element in elements(octets, _LAYER):
        if element.tag == _INTEGER:
            context = _integer(element)
        elif element.tag in (_SINGLE, _ALIGNED) and context is not None:
            return Value(context, element.contents)
        elif element.tag == _ARBITRARY and context is not None:
            return Value(context, element.contents[1:])  # the first octet counts unused bits: none in BER
    raise UnreadableError(_LAYER, "a presentation data value without context or value")

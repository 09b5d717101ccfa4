"""BER elements of the layers below MMS, without a schema. MMS itself is not read here."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from mmsverify.formats import ber
from mmsverify.formats.capture.faults import UnreadableError

_MOST = 10_000  # elements side by side; a list of contexts or values has some ten


class Element(NamedTuple):
    """One element: its identifier octets as a number, its contents, and all its octets."""

    tag: int
    contents: bytes
    octets: bytes


def elements(octets: bytes, layer: str) -> Iterator[Element]:
    """The elements that stand one after the other in ``octets``. Raises ``UnreadableError`` for ``layer``."""
    at = count = 0
    while at < len(octets):
        count += 1
        if count > _MOST:
            raise UnreadableError(layer, f"more than {_MOST} elements side by side")
        try:
            tag, begin, end = ber.header(octets, at, len(octets))
        except ber.Fault as fault:
            raise UnreadableError(layer, f"octet {fault.offset}: {fault.cause}") from None
        yield Element(tag, octets[begin:end], octets[at:end])
        at = end


def only(octets: bytes, layer: str) -> Element:
    """The one element that ``octets`` are."""
    found = list(elements(octets, layer))
    if len(found) != 1:
        raise UnreadableError(layer, f"{len(found)} elements where one belongs")
    return found[0]


def first(octets: bytes, layer: str, tag: int) -> Element | None:
    """The first element with this tag among those of ``octets``."""
    return next((element for element in elements(octets, layer) if element.tag == tag), None)

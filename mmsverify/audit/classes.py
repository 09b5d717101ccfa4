"""What is left of a message when the invokeID is taken out: the class of events that it belongs to.

Only the head of a PDU is looked at. What has not the usual form has no class and is judged by itself.
"""

from __future__ import annotations

from collections.abc import Callable

_REQUEST, _RESPONSE, ERROR = 0xA0, 0xA1, 0xA2
_WHOLE = frozenset({0xA3, *range(0xA8, 0xAE)})
"""The first octets of unconfirmed, Initiate and Conclude PDUs, in which no invokeID is."""
_INTEGER, _IMPLICIT = 0x02, 0x80
_INVOKE = {_REQUEST: _INTEGER, _RESPONSE: _INTEGER, ERROR: _IMPLICIT}
"""By the PDU's first octet: the first octet of its invokeID, which stands first in it."""

Split = Callable[[bytes], tuple[bytes, int | None] | None]


def whole(octets: bytes) -> tuple[bytes, int | None]:
    """A message in which nothing is an invokeID is its own class."""
    return octets, None


def split(octets: bytes) -> tuple[bytes, int | None] | None:
    """The octets without the invokeID, and that; ``None`` where the PDU is of another kind.

    Two PDUs of which the rest is the same, and the invokeIDs are as long, differ in nothing else.
    """
    kind = octets[0] if octets else 0
    if kind in _WHOLE:
        return octets, None
    tag = _INVOKE.get(kind)
    if tag is None or len(octets) < 5:
        return None
    at = 2 if octets[1] < 0x80 else 2 + (octets[1] & 0x7F)
    if at + 2 > len(octets) or octets[at] != tag:
        return None
    size = octets[at + 1]
    begin, end = at + 2, at + 2 + size
    if not 0 < size <= 4 or end > len(octets):
        return None
    invoke = int.from_bytes(octets[begin:end], signed=True)
    # What is negative, or takes more octets than it needs, is not what the others of its class are.
    if invoke < 0 or size != (invoke.bit_length() + 8) // 8:
        return None
    return octets[:begin] + octets[end:], invoke

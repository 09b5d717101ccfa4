"""What is left of a message when the invokeID is taken out, and values that the audit does not look at.

That is the class of events that it belongs to. For the invokeID only the head of a PDU is looked at: what has
not the usual form has no class and is judged by itself. Which values are not looked at is found out, see
`leaves`; here they are octets to be left out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from itertools import pairwise

from mmsverify.audit.learning.leaves import INTEGER, Span

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


MOST_KNOWN = 1 << 15
"""Messages of classes with values left out that are known as a whole, so that nothing need be left out."""
MOST_TEMPLATES = 8
"""Ways to leave values out of messages of one length."""


class Template:
    """Which octets are left out of messages: ``numbers`` of the classes, by what is left.

    Where it was found that values are looked at after all, ``less`` holds those that are still left out.
    ``met``: how many there were that differ in the values only.
    """

    def __init__(self, spans: Mapping[Span, str], size: int) -> None:
        # The first octet of a BIT STRING says how many bits are in use, and stays.
        left_out = [(begin + (kind == "BIT STRING"), end) for (begin, end), kind in sorted(spans.items())]
        self.left_out = tuple(left_out)
        self.integers = tuple(b for (b, e), kind in sorted(spans.items()) if kind == INTEGER and e - b > 1)
        ends = [0, *(place for span in left_out for place in span), size]
        self._kept = tuple((a, b) for a, b in list(pairwise(ends))[::2] if a < b)
        self.numbers: dict[bytes, int] = {}
        self.less: dict[bytes, Mapping[Span, str]] = {}
        self.met: dict[bytes, int] = {}

    def rest(self, octets: bytes) -> bytes:
        """What is left of a message."""
        return b"".join([octets[begin:end] for begin, end in self._kept])

    def fits(self, octets: bytes) -> bool:
        """Whether what is left out are values: each INTEGER in its shortest form."""
        for at in self.integers:
            first, second = octets[at], octets[at + 1]
            if (first == 0 and second < 0x80) or (first == 0xFF and second >= 0x80):
                return False
        return True


class Classes(dict[bytes, int]):
    """By what is left of a message without its invokeID: the number of its class.

    ``find`` looks at what has values left out, too, and knows it as a whole then.
    """

    def __init__(self) -> None:
        super().__init__()
        self._templates: dict[int, list[Template]] = {}
        self._whole: list[bytes] = []

    def find(self, octets: bytes) -> int | None:
        """The number of the class that a message belongs to, if there is one."""
        found = self.get(octets)
        if found is not None:
            return found
        for template in self._templates.get(len(octets), ()):
            number = template.numbers.get(template.rest(octets))
            if number and template.fits(octets):
                self._know(octets, number)
                return number
        return None

    def template(self, octets: bytes, spans: Mapping[Span, str]) -> Template | None:
        """The template that leaves out these spans of messages as long; ``None`` where there are too many."""
        made = Template(spans, len(octets))
        known = self._templates.setdefault(len(octets), [])
        for template in known:
            if template.left_out == made.left_out and template.integers == made.integers:
                return template
        if len(known) >= MOST_TEMPLATES:
            return None
        known.append(made)
        return made

    def clear(self) -> None:
        """Know nothing any more."""
        super().clear()
        self._templates.clear()
        self._whole.clear()

    def forget(self, number: int) -> None:
        """A class is no more: what was known as a whole to belong to it is not known any more."""
        for octets in [octets for octets in self._whole if self.get(octets) == number]:
            del self[octets]
        self._whole = [octets for octets in self._whole if octets in self]

    def _know(self, octets: bytes, number: int) -> None:
        if len(self._whole) >= MOST_KNOWN:
            self._drop(self._whole)
            self._whole = []
        self[octets] = number
        self._whole.append(octets)

    def _drop(self, known: Iterable[bytes]) -> None:
        for octets in known:
            self.pop(octets, None)

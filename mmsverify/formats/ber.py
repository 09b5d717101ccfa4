"""Octets and elements: BER identifiers, lengths and the contents of the built-in types (X.690).

What lives here knows no type of MMS: it turns the contents octets of a primitive into a plain Python value
and back, and says with a `Fault` what is wrong with them. Which element stands where is `codec`'s business.
Strict where X.690 is: what an encoder must not write is refused; what it may write (long lengths, any true
BOOLEAN) is read.
"""

from __future__ import annotations

import re

from mmsverify.errors import MmsverifyError

CONSTRUCTED = 0x20
"""The bit of the first identifier octet that says that elements, not a value, stand inside."""

_VISIBLE = re.compile(rb"[\x20-\x7e]*\Z")
_GRAPHIC = re.compile(rb"[\x1b\x20-\x7e\xa0-\xff]*\Z")
_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]")
_TIME = re.compile(r"\d{10}(\d{2}(\d{2})?)?([.,]\d+)?(Z|[+-]\d{2}(\d{2})?)?\Z")
_ARC_LIMIT = 1 << 128
LONGEST_INTEGER = 256
"""Octets of an INTEGER that is read: no type of MMS has longer ones, and no report could print much more."""


class Fault(Exception):  # noqa: N818 - never leaves this folder
    """What is wrong at an octet; collects the names of the fields around it, innermost first."""

    def __init__(self, cause: str, offset: int) -> None:
        super().__init__(cause)
        self.cause = cause
        self.offset = offset
        self.path: list[str] = []


class EncodeError(MmsverifyError):
    """A Python value that does not fit its type; ``place`` is the chain of field names."""

    code = "encode"


def header(octets: bytes, at: int, limit: int) -> tuple[int, int, int]:
    """Read identifier and length at ``at``: identifier octets as one number, start of the contents, their
    end.

    Contents that would reach beyond ``limit``, the end of the parent, are a `Fault`.
    """
    try:
        head = octets[at]
        begin = at + 1
        if head & 0x1F == 0x1F:
            head, begin = _long_identifier(octets, at, limit)
        length = octets[begin]
        begin += 1
        if length > 0x7F:
            length, begin = long_length(octets, begin, limit)
    except IndexError:
        raise Fault("the octets end inside an identifier or a length", at) from None
    end = begin + length
    if end > limit:
        raise Fault(_too_long(length, begin, limit, len(octets)), at)
    return head, begin, end


def _too_long(length: int, begin: int, limit: int, size: int) -> str:
    where = "the message ends" if limit == size else "its parent ends"
    return f"an element of {length} octets, but {where} after {max(limit - begin, 0)}"


def _long_identifier(octets: bytes, at: int, limit: int) -> tuple[int, int]:
    head = octets[at]
    number = 0
    for position in range(at + 1, min(limit, at + 6)):
        octet = octets[position]
        head = head << 8 | octet
        number = number << 7 | octet & 0x7F
        if octet < 0x80:
            if number < 31 or octets[at + 1] == 0x80:
                raise Fault(f"tag {number} in more octets than it needs", at)
            return head, position + 1
    raise Fault("the octets end inside an identifier, or the tag is not one of MMS", at)


def long_length(octets: bytes, begin: int, limit: int) -> tuple[int, int]:
    """A length of several octets, of which the first was read; and where the contents begin."""
    count = octets[begin - 1] & 0x7F
    if count == 0:
        raise Fault("an indefinite length, which this decoder does not read", begin - 1)
    if count == 0x7F:
        raise Fault("the length octet FF is reserved", begin - 1)
    end = begin + count
    if end > limit:
        raise Fault("the octets end inside a length", begin - 1)
    return int.from_bytes(octets[begin:end]), end


def element(head: int, contents: bytes) -> bytes:
    """Write an element: identifier octets, shortest definite length, contents."""
    size = len(contents)
    if size < 0x80:
        length = bytes((size,))
    else:
        shortest = size.to_bytes((size.bit_length() + 7) // 8)
        length = bytes((0x80 | len(shortest),)) + shortest
    return head.to_bytes((head.bit_length() + 7) // 8 or 1) + length + contents


def shown(head: int) -> str:
    """The identifier octets as a reader of the standard's tables knows them: ``BF28``."""
    return f"{head:02X}"


def read_boolean(octets: bytes, begin: int, end: int) -> bool:
    """X.690 8.2: one octet; anything but zero is TRUE."""
    if end - begin != 1:
        raise Fault(f"a BOOLEAN of {end - begin} octets", begin)
    return octets[begin] != 0


def read_null(octets: bytes, begin: int, end: int) -> None:  # noqa: ARG001
    """X.690 8.8: no contents."""
    if end != begin:
        raise Fault(f"a NULL of {end - begin} octets", begin)


def read_integer(octets: bytes, begin: int, end: int) -> int:
    """X.690 8.3: two's complement in the fewest octets."""
    if end - begin == 1:
        octet = octets[begin]
        return octet if octet < 0x80 else octet - 0x100
    if end == begin:
        raise Fault("an INTEGER without octets", begin)
    if end - begin > LONGEST_INTEGER:
        raise Fault(f"an INTEGER of {end - begin} octets, and {LONGEST_INTEGER} is the most", begin)
    first, second = octets[begin], octets[begin + 1]
    if (first == 0 and second < 0x80) or (first == 0xFF and second >= 0x80):
        raise Fault("an INTEGER in more octets than it needs", begin)
    return int.from_bytes(octets[begin:end], signed=True)


def write_integer(value: int) -> bytes:
    """X.690 8.3: two's complement in the fewest octets."""
    size = ((value if value >= 0 else ~value).bit_length() // 8) + 1
    return value.to_bytes(size, signed=True)


def read_bits(octets: bytes, begin: int, end: int) -> str:
    """X.690 8.6: the bits as ``0`` and ``1``, bit 0 first; the first octet counts those unused at the end."""
    if end == begin:
        raise Fault("a BIT STRING without octets", begin)
    unused = octets[begin]
    size = 8 * (end - begin - 1)
    if unused > 7 or unused > size:
        raise Fault(f"a BIT STRING with {unused} unused bits in {end - begin - 1} octets", begin)
    if not size:
        return ""
    return f"{int.from_bytes(octets[begin + 1 : end]):0{size}b}"[: size - unused]


def write_bits(value: str) -> bytes:
    """X.690 8.6, unused bits zero."""
    unused = -len(value) % 8
    packed = int(value + "0" * unused or "0", 2).to_bytes((len(value) + unused) // 8)
    return bytes((unused,)) + packed


def read_octets(octets: bytes, begin: int, end: int) -> bytes:
    """X.690 8.7, primitive form."""
    return octets[begin:end]


def read_visible(octets: bytes, begin: int, end: int) -> str:
    """VisibleString: ISO 646, printable."""
    raw = octets[begin:end]
    if _VISIBLE.match(raw) is None:
        raise Fault("a VisibleString with a character that is not printable ISO 646", begin)
    return raw.decode("ascii")


def read_utf8(octets: bytes, begin: int, end: int) -> str:
    """UTF8String; of the control characters only those that a text has."""
    try:
        text = octets[begin:end].decode("utf-8")
    except UnicodeDecodeError as bad:
        raise Fault("a UTF8String that is not UTF-8", begin + bad.start) from None
    if _CONTROL.search(text):
        raise Fault("a UTF8String with a control character", begin)
    return text


def read_graphic(octets: bytes, begin: int, end: int) -> str:
    """GraphicString, as ISO 8859-1: designations of further character sets are kept, not followed."""
    raw = octets[begin:end]
    if _GRAPHIC.match(raw) is None:
        raise Fault("a GraphicString with a control character", begin)
    return raw.decode("latin-1")


def read_time(octets: bytes, begin: int, end: int) -> str:
    """GeneralizedTime, as the string it is."""
    text = read_visible(octets, begin, end)
    if _TIME.match(text) is None:
        raise Fault(f"'{text}' is no GeneralizedTime", begin)
    return text


def read_oid(octets: bytes, begin: int, end: int) -> str:
    """X.690 8.19: an object identifier as dotted numbers."""
    arcs: list[int] = []
    number, fresh = 0, True
    for position in range(begin, end):
        octet = octets[position]
        if fresh and octet == 0x80:
            raise Fault("an OBJECT IDENTIFIER with an arc in more octets than it needs", position)
        number = number << 7 | octet & 0x7F
        fresh = octet < 0x80
        if fresh:
            arcs.append(number)
            number = 0
        elif number > _ARC_LIMIT:
            raise Fault("an OBJECT IDENTIFIER with an arc of more than 128 bits", position)
    if not fresh or not arcs:
        raise Fault("an OBJECT IDENTIFIER that ends inside an arc", begin)
    root = min(arcs[0] // 40, 2)
    return ".".join(map(str, (root, arcs[0] - 40 * root, *arcs[1:])))


def write_oid(value: str) -> bytes:
    """X.690 8.19; a ValueError where ``value`` is no object identifier."""
    arcs = [int(arc) for arc in value.split(".")]
    if len(arcs) < 2 or min(arcs) < 0 or arcs[0] > 2 or (arcs[0] < 2 and arcs[1] > 39):
        raise ValueError(value)
    return b"".join(map(_arc, (40 * arcs[0] + arcs[1], *arcs[2:])))


def _arc(number: int) -> bytes:
    septets = [number & 0x7F]
    while number := number >> 7:
        septets.append(number & 0x7F | 0x80)
    return bytes(reversed(septets))


def check_element(octets: bytes, begin: int, end: int, depth: int) -> None:
    """Make sure that one element fills ``begin`` to ``end``, and well-formed ones fill it (for ANY)."""
    head, start, stop = header(octets, begin, end)
    if stop != end:
        raise Fault(f"{end - stop} octets after the end of the element", stop)
    if _first(head) & CONSTRUCTED:
        _check_all(octets, start, stop, depth - 1)


def _check_all(octets: bytes, begin: int, end: int, depth: int) -> None:
    if depth <= 0:
        raise Fault("elements nested too deeply", begin)
    while begin < end:
        head, start, stop = header(octets, begin, end)
        if _first(head) & CONSTRUCTED:
            _check_all(octets, start, stop, depth - 1)
        begin = stop


def _first(head: int) -> int:
    while head > 0xFF:
        head >>= 8
    return head

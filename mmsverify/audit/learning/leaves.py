"""Values in a message of which the audit may never ask what they are: a measured current, a seam's image.

Which of them it asks is not written down anywhere: it is seen when a message is judged with an `Opaque` in
place of each. Whoever looks at one is told off by `TouchedError`; if nobody does, the message would have been
judged alike with any other value.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any, NoReturn

from mmsverify.errors import DecodeError
from mmsverify.formats import ber, mms
from mmsverify.formats.trace import TraceMessage

Span = tuple[int, int]
"""Begin and end of contents octets in a message."""

INTEGER, OCTETS, BITS = KINDS = ("INTEGER", "OCTET STRING", "BIT STRING")


class Leaf:
    """Where a value stands: mixed into the types of the values themselves, which are otherwise as ever."""

    message: TraceMessage
    span: Span
    kind: str


class LeafInt(int, Leaf):
    """An INTEGER."""


class LeafBytes(bytes, Leaf):
    """An OCTET STRING."""


class LeafText(str, Leaf):
    """A BIT STRING, as text."""


class TouchedError(BaseException):
    """Somebody wants to know what an `Opaque` is. No `Exception`: nobody on the way may catch it."""

    def __init__(self, leaf: Opaque) -> None:
        super().__init__()
        self.message, self.span = object.__getattribute__(leaf, "place")[:2]


def _touched(self: Opaque, *_: Any, **__: Any) -> NoReturn:
    raise TouchedError(self)


class Opaque:
    """Stands for a value of which nothing is known, and nothing may be asked; it can only be passed on."""

    __slots__ = ("place",)

    def __init__(self, message: TraceMessage, span: Span, kind: str) -> None:
        object.__setattr__(self, "place", (message, span, kind))

    # Python asks for these of the type, not of the object. `__class__` is what isinstance asks for.
    __class__ = property(_touched)
    __getattribute__ = __setattr__ = __delattr__ = __getattr__ = _touched
    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = __hash__ = __bool__ = _touched
    __str__ = __repr__ = __format__ = __bytes__ = __len__ = __iter__ = __contains__ = _touched
    __getitem__ = __int__ = __index__ = __float__ = __add__ = __radd__ = __sub__ = __rsub__ = _touched
    __mul__ = __rmul__ = __mod__ = __rmod__ = __floordiv__ = __truediv__ = __and__ = __or__ = _touched
    __xor__ = __rand__ = __ror__ = __rxor__ = __lshift__ = __rshift__ = __neg__ = __invert__ = _touched
    __abs__ = __divmod__ = __pow__ = __call__ = __reduce__ = __reduce_ex__ = __copy__ = __deepcopy__ = (
        _touched
    )


_LEAF_OF: Mapping[type, Any] = {int: LeafInt, bytes: LeafBytes, str: LeafText}
Path = tuple[str, ...]
"""The names of fields and alternatives, from the outside in; items of lists have none."""
Make = Callable[[TraceMessage, Span, str], Any]
"""Makes what stands for a value."""
LEAVES = (LeafInt, LeafBytes, LeafText, Opaque)


def place_of(leaf: Any) -> tuple[TraceMessage, int, int, int]:
    """Message, begin, end and the number of the kind of a leaf, opaque or not."""
    if type(leaf) is Opaque:
        message, (begin, end), kind = object.__getattribute__(leaf, "place")
    else:
        message, (begin, end), kind = leaf.message, leaf.span, leaf.kind
    return message, begin, end, KINDS.index(kind)


def plain(message: TraceMessage, begin: int, end: int, kind: int) -> tuple[type, tuple[Any]]:
    """The type of a value and the value, which does not know where it stands."""
    octets = message.data
    if KINDS[kind] == INTEGER:
        return int, (ber.read_integer(octets, begin, end),)
    if KINDS[kind] == OCTETS:
        return bytes, (octets[begin:end],)
    return str, (ber.read_bits(octets, begin, end),)


def real(message: TraceMessage, span: Span, kind: str) -> Any:
    """The value itself, which knows where it stands."""
    made, (value,) = plain(message, *span, KINDS.index(kind))
    leaf = _LEAF_OF[made](value)
    leaf.message, leaf.span, leaf.kind = message, span, kind
    return leaf


def read(message: TraceMessage, spans: Collection[Span], make: Make) -> mms.Pdu:
    """The PDU of a message, with what is made in place of the values in those spans."""
    if not spans:
        return mms.decode(message.data)

    def cover(kind: str, begin: int, end: int, value: Any) -> Any:
        return make(message, (begin, end), kind) if (begin, end) in spans else value

    return mms.decode(message.data, cover)


def leaves(octets: bytes) -> dict[Span, str]:
    """The values of a PDU of which the octets could be any: their spans, each with its kind."""
    found: dict[Span, str] = {}

    def cover(kind: str, begin: int, end: int, value: Any) -> Any:
        if end - begin > (kind == BITS):
            found[begin, end] = kind
        return value

    try:
        mms.decode(octets, cover)
    except DecodeError:
        return {}
    return found


def fields(octets: bytes) -> dict[Path, Span]:
    """Where the fields of a PDU stand, by the names that lead to them; of a list, one item stands for all."""
    return {path: (begin, end) for path, begin, end in mms.fields(octets)}

"""Compiled ASN.1 types, continued: what stands around a type, an explicit tag or a second form.

What lives here reads and writes no value of its own: it hands the octets on to the type inside.
"""

from __future__ import annotations

from typing import Any

from mmsverify.formats.ber import Fault, check_element, element, header, shown
from mmsverify.formats.codec import MAX_DEPTH, Misfit, Reader, Type, Walk, type_name, wanted


class Explicit:
    """An explicit tag: one element of the inner type and nothing else."""

    __slots__ = ("head", "inner", "readers")

    def __init__(self, head: int, inner: Type) -> None:
        self.head = head
        self.inner = inner
        self.readers: dict[int, Reader] = {head: self.read}

    def read(self, walk: Walk, begin: int, end: int, depth: int) -> Any:
        if depth > MAX_DEPTH:
            raise Fault("elements nested too deeply", begin)
        if begin == end:
            raise Fault(f"nothing stands under the explicit tag {shown(self.head)}", begin)
        head, start, stop = header(walk.octets, begin, end)
        reader = self.inner.readers.get(head)
        if reader is None:
            raise Fault(f"found {shown(head)} where {wanted(self.inner.readers)} must stand", begin)
        if stop != end:
            raise Fault(f"{end - stop} octets too many under the explicit tag {shown(self.head)}", stop)
        return reader(walk, start, stop, depth + 1)

    def write(self, value: Any, depth: int) -> bytes:
        if depth > MAX_DEPTH:
            raise Misfit("nested too deeply")
        return element(self.head, self.inner.write(value, depth + 1))


class ExplicitAny:
    """An explicit tag over ANY: the octets of one element, well-formed but not looked into."""

    __slots__ = ("head", "readers")

    def __init__(self, head: int) -> None:
        self.head = head
        self.readers: dict[int, Reader] = {head: self.read}

    def read(self, walk: Walk, begin: int, end: int, depth: int) -> bytes:
        check_element(walk.octets, begin, end, MAX_DEPTH - depth)
        return walk.octets[begin:end]

    def write(self, value: Any, depth: int) -> bytes:
        if not isinstance(value, bytes):
            raise Misfit(f"the bytes of an element are needed, not {type_name(value)}")
        try:
            check_element(value, 0, len(value), MAX_DEPTH - depth)
        except Fault as fault:
            raise Misfit(fault.cause) from None
        return element(self.head, value)


class EitherForm:
    """Two forms of one type: the first is written; what does not fit it is tried against the second."""

    __slots__ = ("other", "readers", "usual")

    def __init__(self, usual: Type, other: Type) -> None:
        self.usual = usual
        self.other = other
        self.readers = dict(usual.readers)
        for head, reader in other.readers.items():
            first = usual.readers.get(head)
            self.readers[head] = _first_that_fits(first, reader) if first else reader

    def write(self, value: Any, depth: int) -> bytes:
        try:
            return self.usual.write(value, depth)
        except Misfit as misfit:
            try:
                return self.other.write(value, depth)
            except Misfit:
                raise misfit from None


def _first_that_fits(usual: Reader, other: Reader) -> Reader:
    def read(walk: Walk, begin: int, end: int, depth: int) -> Any:
        remarks, spans = len(walk.remarks), len(walk.spans or ())
        try:
            return usual(walk, begin, end, depth)
        except Fault as fault:
            del walk.remarks[remarks:]
            if walk.spans is not None:
                del walk.spans[spans:]
            try:
                return other(walk, begin, end, depth)
            except Fault as second:
                raise max(fault, second, key=lambda one: one.offset) from None

    return read

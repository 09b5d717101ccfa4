"""Compiled ASN.1 types once more, as Python functions: the short way for octets without a fault.

In the context of logs that do not repeat themselves, facing eight elements in a small PDU, we write functions
for the types from the tables of `codec` (`coding` says how), and accept that code is made at run time: they
are three times as fast as walking the tables. A function gives the value that `codec` gives, or it gives up;
then `codec` reads the octets from the beginning and says what is wrong, or what is to be remarked. It gives
up early: a NULL that is written as constructed, the second of two forms, elements nested deeply.

To make a function takes as long as to read some hundred PDUs by the tables. So one is made where the same has
been asked for often, and a short recording is read as fast as before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from mmsverify.formats import ber
from mmsverify.formats.codec import ListOf, Struct, Type
from mmsverify.formats.coding import Code, called, possible_heads

Read = Callable[[bytes, int, int, int], Any]
"""Reads contents octets: the message, begin, end, depth."""

OFTEN = 64
_SHORT, _MANY = 32, 4096
_LOOKED_UP: Mapping[str, Callable[[bytes, int, int], str]] = {
    "BIT STRING": ber.read_bits,
    "OBJECT IDENTIFIER": ber.read_oid,
    "ObjectDescriptor": ber.read_graphic,
    "UTF8String": ber.read_utf8,
    "GeneralizedTime": ber.read_time,
    "GraphicString": ber.read_graphic,
    "VisibleString": ber.read_visible,
}
_LEAST = (1, 0, *(1 << 8 * size - 9 for size in range(2, 9)))
_MOST = (0, *(1 << 8 * size - 1 for size in range(1, 9)))
"""The positive INTEGERs of so many octets; of none there is none."""


class Irregular(Exception):  # noqa: N818 - never leaves this folder
    """Octets that need the long way."""


GIVES_UP = (Irregular, ber.Fault, LookupError, ValueError)
"""What a function raises then; the errors are those of reading beyond the end, and of text."""


def root_table(root: Type, often: int = OFTEN) -> dict[int, Read]:
    """The functions for the elements that may begin a message, by identifier octets.

    Each is made when it has been asked for ``often`` times; before, it gives up.
    """
    return _Maker(often).table(root)


class _Values(dict[bytes, str]):
    """Contents octets to values of one built-in type. Names and bits come again and again: some are kept."""

    def __init__(self, read: Callable[[bytes, int, int], str]) -> None:
        super().__init__()
        self._read = read

    def __missing__(self, octets: bytes) -> str:
        value = self._read(octets, 0, len(octets))
        if len(octets) <= _SHORT and len(self) < _MANY:
            self[octets] = value
        return value


class _Maker:
    """Makes functions, and holds what their code refers to."""

    def __init__(self, often: int) -> None:
        self._often = often
        self._names: dict[int, str] = {}
        self._kept: list[Any] = []  # so that no id is given twice
        self._space: dict[str, Any] = {
            "irregular": Irregular,
            "long_length": ber.long_length,
            "integer": ber.read_integer,
            "from_bytes": int.from_bytes,
            "least": _LEAST,
            "most": _MOST,
            "check_element": ber.check_element,
            **{called(kind): _Values(read) for kind, read in _LOOKED_UP.items()},
        }

    def constant(self, value: Any) -> str:
        """The name of a value."""
        if id(value) not in self._names:
            self._space[self._name("k", value)] = value
        return self._names[id(value)]

    def table_name(self, kind: Type) -> str:
        """The name of the table of a type with several identifier octets."""
        if id(kind) not in self._names:
            self._space[self._name("t", kind)] = self.table(kind)
        return self._names[id(kind)]

    def function_name(self, kind: Struct | ListOf) -> str:
        """The name of the function for the contents of a type."""
        if id(kind) not in self._names:
            name = self._name("f", kind)
            self._later(self._space, name, kind, kind.head)
        return self._names[id(kind)]

    def table(self, kind: Type) -> dict[int, Read]:
        """A function for each of the identifier octets that a type can have."""
        made: dict[int, Read] = {}
        for head in possible_heads(kind):
            self._later(made, head, kind, head)
        return made

    def _name(self, letter: str, thing: Any) -> str:
        self._kept.append(thing)
        self._names[id(thing)] = f"{letter}{len(self._kept)}"
        return self._names[id(thing)]

    def _later(self, place: dict[Any, Any], key: Any, kind: Type, head: int) -> None:
        """Put in a place what makes the function that belongs there, when the time has come."""
        asked = 0

        def first(octets: bytes, begin: int, end: int, depth: int) -> Any:
            nonlocal asked
            asked += 1
            if asked < self._often:
                raise Irregular
            place[key] = self._function(kind, head)
            return place[key](octets, begin, end, depth)

        place[key] = first

    def _function(self, kind: Type, head: int) -> Read:
        text = Code(self).function(kind, head)
        made: dict[str, Read] = {}
        exec(compile(text, f"<{type(kind).__name__} {head:X}>", "exec"), self._space, made)
        return made["read"]

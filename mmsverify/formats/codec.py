"""Compiled ASN.1 types: SEQUENCE, SEQUENCE OF and CHOICE in BER.

What lives here knows how such a type stands in octets, not which of them MMS has: `schema` builds these
objects from the ASN.1 modules. (Tags around a type are `tagging`'s, types without elements `builtin`'s.) Each
type holds `readers`, a table from identifier octets to the function that reads the contents of such an
element: reading is one look-up for each element. A `Fault` or a `Misfit` rises through them and collects the
names of the fields around it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from mmsverify.formats.ber import Fault, element, header, shown

MAX_DEPTH = 64
"""Elements nested deeper than this are refused: no PDU of MMS needs it, and a recursion must end."""


Cover = Callable[[str, int, int, Any], Any]
"""Takes the ASN.1 name of a type, begin and end of contents octets, the value; gives what stands for it.

Asked only of contents for which any other octets, as many, would be a value as well (of an INTEGER: any that
are its shortest form).
"""


class Walk:
    """One message being read: its octets, remarks on what is tolerated, and where fields stand.

    ``cover`` gives what stands in place of values.
    """

    __slots__ = ("cover", "octets", "remarks", "spans")

    def __init__(
        self,
        octets: bytes,
        spans: list[tuple[str, int, int]] | None = None,
        cover: Cover | None = None,
    ) -> None:
        self.octets = octets
        self.remarks: list[str] = []
        self.spans = spans
        self.cover = cover


Reader = Callable[[Walk, int, int, int], Any]
"""Reads the contents octets from a begin to an end, at a depth."""


class Misfit(Exception):  # noqa: N818 - never leaves this folder
    """A Python value that does not fit a type; collects the names of the fields around it while it rises."""

    def __init__(self, cause: str) -> None:
        super().__init__(cause)
        self.cause = cause
        self.path: list[str] = []


class Type(Protocol):
    """What every compiled type can do."""

    readers: dict[int, Reader]

    def write(self, value: Any, depth: int) -> bytes:
        """The element that holds ``value``, or a `Misfit`."""
        ...


@dataclass(frozen=True, slots=True)
class Member:
    """One member of a SEQUENCE; ``default`` is None where the type declares none."""

    name: str
    type: Type
    optional: bool
    default: Any = None

    @property
    def needed(self) -> bool:
        return not self.optional and self.default is None


class Struct:
    """SEQUENCE, as a dict in order; an absent OPTIONAL member is left out, a DEFAULT filled in."""

    __slots__ = ("_rows", "head", "members", "readers")

    def __init__(self, head: int, members: Sequence[Member]) -> None:
        self.head = head
        self.members = tuple(members)
        self.readers: dict[int, Reader] = {head: self.read}
        self._rows = [(m.name, m.type.readers, m.needed, m.default) for m in members]

    def read(self, walk: Walk, begin: int, end: int, depth: int) -> dict[str, Any]:
        if depth > MAX_DEPTH:
            raise Fault("elements nested too deeply", begin)
        octets, spans, rows = walk.octets, walk.spans, self._rows
        value: dict[str, Any] = {}
        at, position = begin, 0
        while at < end:
            head, start, stop = header(octets, at, end)
            while True:
                if position == len(rows):
                    raise self._surplus(head, at)
                name, readers, needed, default = rows[position]
                reader = readers.get(head)
                if reader is not None:
                    break
                if needed:
                    raise Fault(f"found {shown(head)} where {name} ({wanted(readers)}) must stand", at)
                if default is not None:
                    value[name] = default
                position += 1
            position += 1
            try:
                value[name] = reader(walk, start, stop, depth + 1)
            except Fault as fault:
                fault.path.append(name)
                raise
            if spans is not None:
                spans.append((name, start, stop))
            at = stop
        if position < len(rows):
            self._close(value, position, end)
        return value

    def _close(self, value: dict[str, Any], position: int, end: int) -> None:
        for name, readers, needed, default in self._rows[position:]:
            if needed:
                raise Fault(f"{name} ({wanted(readers)}) is missing", end)
            if default is not None:
                value[name] = default

    def _surplus(self, head: int, at: int) -> Fault:
        known = [row[0] for row in self._rows if head in row[1]]
        if known:
            return Fault(f"{known[0]} ({shown(head)}) is out of order or given twice", at)
        return Fault(f"the element {shown(head)} belongs to no member", at)

    def write(self, value: Any, depth: int) -> bytes:
        if not isinstance(value, Mapping):
            raise Misfit(f"a dict is needed, not {type_name(value)}")
        if depth > MAX_DEPTH:
            raise Misfit("nested too deeply")
        unknown = value.keys() - {member.name for member in self.members}
        if unknown:
            raise Misfit(f"no member is called {', '.join(sorted(map(str, unknown)))}")
        return element(self.head, b"".join(self._written(member, value, depth) for member in self.members))

    @staticmethod
    def _written(member: Member, value: Mapping[str, Any], depth: int) -> bytes:
        if member.name not in value:
            if member.needed:
                raise Misfit(f"{member.name} is missing")
            return b""
        content = value[member.name]
        if member.default is not None and content == member.default:
            return b""
        try:
            return member.type.write(content, depth + 1)
        except Misfit as misfit:
            misfit.path.append(member.name)
            raise


class ListOf:
    """SEQUENCE OF, as a list."""

    __slots__ = ("head", "item", "readers")

    def __init__(self, head: int, item: Type) -> None:
        self.head = head
        self.item = item
        self.readers: dict[int, Reader] = {head: self.read}

    def read(self, walk: Walk, begin: int, end: int, depth: int) -> list[Any]:
        if depth > MAX_DEPTH:
            raise Fault("elements nested too deeply", begin)
        octets, readers = walk.octets, self.item.readers
        value: list[Any] = []
        at = begin
        while at < end:
            head, start, stop = header(octets, at, end)
            reader = readers.get(head)
            if reader is None:
                raise Fault(f"found {shown(head)} where an item ({wanted(readers)}) must stand", at)
            try:
                value.append(reader(walk, start, stop, depth + 1))
            except Fault as fault:
                fault.path.append(f"[{len(value)}]")
                raise
            if walk.spans is not None:
                walk.spans.append((f"[{len(value) - 1}]", start, stop))
            at = stop
        return value

    def write(self, value: Any, depth: int) -> bytes:
        if not isinstance(value, list | tuple):
            raise Misfit(f"a list is needed, not {type_name(value)}")
        if depth > MAX_DEPTH:
            raise Misfit("nested too deeply")
        return element(
            self.head, b"".join(self._item(index, item, depth) for index, item in enumerate(value))
        )

    def _item(self, index: int, item: Any, depth: int) -> bytes:
        try:
            return self.item.write(item, depth + 1)
        except Misfit as misfit:
            misfit.path.append(f"[{index}]")
            raise


class Choice:
    """CHOICE, as a pair of the alternative's name and its value. It has no tag of its own."""

    __slots__ = ("alternatives", "readers")

    def __init__(self, alternatives: Sequence[tuple[str, Type]]) -> None:
        self.alternatives = dict(alternatives)
        self.readers: dict[int, Reader] = {}
        for name in self.alternatives:
            self.link(name)

    def link(self, name: str) -> None:
        """Take over the table of an alternative; again when a type inside its own definition is complete."""
        for head, reader in self.alternatives[name].readers.items():
            self.readers[head] = _alternative(name, reader)

    def alternative(self, head: int) -> tuple[str, Type]:
        """The alternative that an element with these identifier octets is."""
        return next((name, kind) for name, kind in self.alternatives.items() if head in kind.readers)

    def write(self, value: Any, depth: int) -> bytes:
        match value:
            case (str(name), content) if name in self.alternatives:
                pass
            case _:
                raise Misfit(
                    f"a pair (alternative, value) is needed, with one of {', '.join(self.alternatives)}"
                )
        try:
            return self.alternatives[name].write(content, depth)
        except Misfit as misfit:
            misfit.path.append(name)
            raise


def _alternative(name: str, reader: Reader) -> Reader:
    def read(walk: Walk, begin: int, end: int, depth: int) -> tuple[str, Any]:
        try:
            value = name, reader(walk, begin, end, depth)
        except Fault as fault:
            fault.path.append(name)
            raise
        if walk.spans is not None:
            walk.spans.append((name, begin, end))
        return value

    return read


def wanted(readers: Mapping[int, Reader]) -> str:
    """The identifier octets that a table knows, for a message."""
    heads = [shown(head) for head in readers]
    return "/".join(heads[:6]) + ("/..." if len(heads) > 6 else "")


def type_name(value: object) -> str:
    """What a Python value is, for a message."""
    return type(value).__name__

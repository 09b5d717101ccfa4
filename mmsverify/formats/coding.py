"""The code of a function that reads a compiled ASN.1 type, written from its tables.

Names in the code: ``o`` the octets, ``a`` and ``e`` where the contents begin and end, ``d`` their depth; with
numbers, those of elements inside. ``n`` is the length read last. Tags, lengths and most values are read in
line; what `called` names is looked up. Whether an element ends within the one around it is asked once for all
elements of that: where one reaches too far, the last of them does not end where it must. Reading beyond the
message is an IndexError.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from mmsverify.formats.builtin import Primitive
from mmsverify.formats.codec import MAX_DEPTH, Choice, ListOf, Member, Struct, Type
from mmsverify.formats.schema import Later
from mmsverify.formats.tagging import EitherForm, Explicit, ExplicitAny

_MARGIN = 16
"""How much deeper than its function an element in line may stand: fewer levels than that."""
_IN_LINE = 2
"""So many types with elements inside are written in line, one in another."""
_FEW = 5
"""Of so many alternatives each is tried; for more there is a table."""
_EITHER_TEXT = ["VisibleString", "UTF8String"]

Where = Callable[[str], None]
"""Writes what follows from a condition: that an identifier is one that may stand there."""


class Surroundings(Protocol):
    """Names for what is outside a function."""

    def constant(self, value: Any) -> str: ...
    def table_name(self, kind: Type) -> str: ...
    def function_name(self, kind: Struct | ListOf) -> str: ...


class Code:
    """The lines of one function. Each method that reads gives the expression for the value read."""

    def __init__(self, around: Surroundings) -> None:
        self._around = around
        self._lines: list[str] = []
        self._indent = 1
        self._count = 0

    def function(self, kind: Type, head: int) -> str:
        """The function for the contents of an element of this type with these identifier octets."""
        self._add(f"if d > {MAX_DEPTH - _MARGIN}: raise irregular")
        value = self._contents(kind, head, ("a", "e"), 0, 0)
        return "\n".join(["def read(o, a, e, d):", *self._lines, f" return {value}"])

    def _add(self, *lines: str) -> None:
        self._lines += [" " * self._indent + line for line in lines]

    def _fresh(self, letters: str) -> Sequence[str]:
        self._count += 1
        return [f"{letter}{self._count}" for letter in letters]

    def _refuse(self, found: str) -> None:
        self._add(f"if not ({found}): raise irregular")

    def _only_where(self, found: str) -> None:
        self._add(f"if {found}:")
        self._indent += 1

    def _contents(self, kind: Type, head: int, span: Sequence[str], depth: int, level: int) -> str:
        """Read the contents that stand from ``span`` to ``span``, ``depth`` below those of the function.

        ``level``: within so many types that are written in line.
        """
        assert depth < _MARGIN
        begin, end = span
        match kind:
            case Later():
                return self._contents(settled(kind), head, span, depth, _IN_LINE)
            case EitherForm():
                return self._contents(_form(kind, head), head, span, depth, level)
            case Choice():
                name, inner = kind.alternative(head)
                return f"({name!r}, {self._contents(inner, head, span, depth, level)})"
            case Explicit():
                return self._explicit(kind, span, depth, level)
            case ExplicitAny():
                self._add(f"check_element(o, {begin}, {end}, {MAX_DEPTH - depth} - d)")
                return f"o[{begin}:{end}]"
            case Primitive() if head != kind.head:  # a NULL that is written as constructed
                self._add("raise irregular")
                return "None"
            case Primitive():
                return self._primitive(kind, span)
            case Struct() | ListOf() if level >= _IN_LINE:
                return f"{self._around.function_name(kind)}(o, {begin}, {end}, d + {depth})"
            case Struct():
                return self._struct(kind, span, depth, level + 1)
            case ListOf():
                return self._list(kind, span, depth, level + 1)
        raise AssertionError(kind)

    # Types with elements inside.

    def _explicit(self, kind: Explicit, span: Sequence[str], depth: int, level: int) -> str:
        inside, (value,) = self._fresh("bc"), self._fresh("x")
        read = self._element(kind.inner, span, inside, (depth + 1, level), self._refuse)
        self._add(f"{value} = {read}", f"if {inside[1]} != {span[1]}: raise irregular")
        return value

    def _struct(self, kind: Struct, span: Sequence[str], depth: int, level: int) -> str:
        (value,) = self._fresh("v")
        at, end = span
        first = next((number for number, one in enumerate(kind.members) if not one.needed), None)
        found: list[str] = []
        for number, member in enumerate(kind.members):
            if number == first:
                self._add(f"{value} = {{{', '.join(found)}}}")
            if member.needed:
                inside = self._fresh("bc")
                read = self._element(member.type, (at, end), inside, (depth + 1, level), self._refuse)
                at = inside[1]
                if first is None or number < first:
                    found.append(f"{member.name!r}: {read}")
                else:
                    self._add(f"{value}[{member.name!r}] = {read}")
            else:
                at = self._optional(member, f"{value}[{member.name!r}]", (at, end), (depth + 1, level))
        self._add(f"if {at} != {end}: raise irregular")
        return f"{{{', '.join(found)}}}" if first is None else value

    def _optional(self, member: Member, place: str, span: Sequence[str], deep: tuple[int, int]) -> str:
        """A member that may be absent; where the next one begins."""
        indent, inside, (at,) = self._indent, self._fresh("bc"), self._fresh("a")
        self._add(f"{at} = {span[0]}")
        if member.default is not None:
            self._add(f"{place} = {self._around.constant(member.default)}")
        self._only_where(f"{at} < {span[1]}")
        found = self._element(member.type, (at, span[1]), inside, deep, self._only_where)
        self._add(f"{place} = {found}", f"{at} = {inside[1]}")
        self._indent = indent
        return at

    def _list(self, kind: ListOf, span: Sequence[str], depth: int, level: int) -> str:
        at, value = self._fresh("av")
        inside = self._fresh("bc")
        self._add(f"{at} = {span[0]}", f"{value} = []", f"while {at} < {span[1]}:")
        self._indent += 1
        item = self._element(kind.item, (at, span[1]), inside, (depth + 1, level), self._refuse)
        self._add(f"{value}.append({item})", f"{at} = {inside[1]}")
        self._indent -= 1
        self._add(f"if {at} != {span[1]}: raise irregular")
        return value

    # Elements.

    def _element(
        self, kind: Type, span: Sequence[str], inside: Sequence[str], deep: tuple[int, int], where: Where
    ) -> str:
        """Read the element at the beginning of ``span``; its contents will stand from ``inside`` to it.

        ``deep``: depth and level of its contents.
        """
        heads = possible_heads(kind)
        if where == self._refuse and _kinds(kind) == _EITHER_TEXT:
            del heads[1:]  # the second form is rare
        if len(heads) == 1:
            self._tagged(span, inside, where, heads[0])
            return self._contents(kind, heads[0], inside, *deep)
        if len(heads) <= _FEW and max(heads) < 0x100:
            found = self._one_of(heads, span, inside, where)
            return self._tried(kind, heads, found, inside, deep)
        reader = self._any_of(kind, heads, span, inside, where)
        return f"{reader}(o, {inside[0]}, {inside[1]}, d + {deep[0]})"

    def _tagged(self, span: Sequence[str], inside: Sequence[str], where: Where, head: int) -> None:
        """An element that can have one identifier only."""
        octets = head.to_bytes(1 if head < 0x100 else 2)
        places = [span[0], *(f"{span[0]} + {number}" for number in (1, 2, 3))]
        where(" and ".join(f"o[{place}] == {octet}" for place, octet in zip(places, octets, strict=False)))
        self._add(f"n = o[{places[len(octets)]}]", f"{inside[0]} = {places[len(octets) + 1]}")
        self._stop(inside, span[1])

    def _stop(self, inside: Sequence[str], end: str) -> None:
        begin, stop = inside
        self._add(f"if n > 127: n, {begin} = long_length(o, {begin}, {end})", f"{stop} = {begin} + n")

    def _one_of(self, heads: Sequence[int], span: Sequence[str], inside: Sequence[str], where: Where) -> str:
        """An element of one of few alternatives: the name of its identifier."""
        (found,) = self._fresh("h")
        self._add(f"{found} = o[{span[0]}]")
        where(" or ".join(f"{found} == {head}" for head in heads))
        self._add(f"n = o[{span[0]} + 1]", f"{inside[0]} = {span[0]} + 2")
        self._stop(inside, span[1])
        return found

    def _tried(
        self, kind: Type, heads: Sequence[int], found: str, inside: Sequence[str], deep: tuple[int, int]
    ) -> str:
        """The contents by the identifier that was found."""
        (value,) = self._fresh("x")
        # Of several alternatives few will ever come: what stands inside them is not written in line.
        depth, level = deep if len(heads) <= 2 else (deep[0], _IN_LINE)
        for number, head in enumerate(heads):
            self._add("else:" if number == len(heads) - 1 else f"{'el' * (number > 0)}if {found} == {head}:")
            self._indent += 1
            self._add(f"{value} = {self._contents(kind, head, inside, depth, level)}")
            self._indent -= 1
        return value

    def _any_of(
        self, kind: Type, heads: Sequence[int], span: Sequence[str], inside: Sequence[str], where: Where
    ) -> str:
        """An element of one of many alternatives, each with its own function: the name of that."""
        found, reader = self._fresh("hr")
        at, begin = span[0], inside[0]
        self._add(f"{found} = o[{at}]", f"{begin} = {at} + 2")
        if max(heads) > 0xFF:
            self._add(f"if {found} & 31 == 31: {found} = {found} << 8 | o[{at} + 1]; {begin} += 1")
        self._add(f"{reader} = {self._around.table_name(settled(kind))}.get({found})")
        where(f"{reader} is not None")
        self._add(f"n = o[{begin} - 1]")
        self._stop(inside, span[1])
        return reader

    # Values.

    def _primitive(self, kind: Primitive, span: Sequence[str]) -> str:
        begin, end = span
        (value,) = self._fresh("x")
        if begin == "a":
            self._add("n = e - a")
        match kind.kind:
            case "INTEGER":
                return self._integer(kind, value, begin, end)
            case "BOOLEAN":
                self._add("if n != 1: raise irregular")
                return f"o[{begin}] != 0"
            case "NULL":
                self._add("if n: raise irregular")
                return "None"
            case "OCTET STRING":
                self._add(f"{value} = o[{begin}:{end}]")
            case _:
                self._add(f"{value} = {called(kind.kind)}[o[{begin}:{end}]]")
        if kind.bounds:
            self._refuse(_inside(kind, f"len({value})"))
        return value

    def _integer(self, kind: Primitive, value: str, begin: str, end: str) -> str:
        """Positive ones of up to eight octets are read in line, if they need so many."""
        small = all(any(low <= one <= high for low, high in kind.bounds) for one in range(128))
        within = [f"if not ({_inside(kind, value)}): raise irregular"] if kind.bounds else []
        self._add(
            f"if n == 1 and o[{begin}] < 128: {value} = o[{begin}]",
            "else:",
            f" {value} = from_bytes(o[{begin}:{end}])",
            f" if n > 8 or not least[n] <= {value} < most[n]: {value} = integer(o, {begin}, {end})",
            *(f" {line}" for line in within if small),
        )
        if not small:
            self._add(*within)
        return value


def _inside(kind: Primitive, value: str) -> str:
    return " or ".join(f"{low} <= {value} <= {high}" for low, high in kind.bounds)


def called(kind: str) -> str:
    """The name in the code of the values of a built-in type that is not read in line."""
    return f"any_{kind.replace(' ', '_').lower()}"


def settled(kind: Type) -> Type:
    """The type itself, where it stands inside its own definition."""
    if isinstance(kind, Later):
        assert kind.target is not None
        return kind.target
    return kind


def possible_heads(kind: Type) -> list[int]:
    """The identifier octets that an element of a type can have; a NULL is primitive."""
    kind = settled(kind)
    if isinstance(kind, Primitive | Struct | ListOf | Explicit | ExplicitAny):
        return [kind.head]
    if isinstance(kind, Choice):
        return [head for one in kind.alternatives.values() for head in possible_heads(one)]
    assert isinstance(kind, EitherForm)
    return [*dict.fromkeys(possible_heads(kind.usual) + possible_heads(kind.other))]


def _form(kind: EitherForm, head: int) -> Type:
    """The form that is read: the usual one if it can be. A VisibleString is the same text as UTF-8."""
    second = head not in kind.usual.readers
    if head in kind.other.readers and _kinds(kind) == _EITHER_TEXT:
        second = True
    return kind.other if second else kind.usual


def _kinds(kind: Type) -> list[str]:
    """The built-in types of a type of two forms, where no bounds are given."""
    if not isinstance(kind, EitherForm):
        return []
    both = kind.usual, kind.other
    return [one.kind for one in both if isinstance(one, Primitive) and not one.bounds]

"""Parsed ASN.1 modules to compiled types. The text was parsed before (`asn1_text`); how octets are read is
`codec`'s.

The types of the module of forms that are only read (`ALSO_READ`) stand beside the types of the same name.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from mmsverify.errors import InputError, MmsverifyError
from mmsverify.formats.builtin import Bounds, Primitive, constructed
from mmsverify.formats.codec import Choice, ListOf, Member, Reader, Struct, Type
from mmsverify.formats.tagging import EitherForm, Explicit, ExplicitAny

ALSO_READ = "MMS-Also-Read"
"""The module whose types are tried where the type of the same name does not fit."""

_UNIVERSAL = {
    "BOOLEAN": 1,
    "INTEGER": 2,
    "BIT STRING": 3,
    "OCTET STRING": 4,
    "NULL": 5,
    "OBJECT IDENTIFIER": 6,
    "ObjectDescriptor": 7,
    "UTF8String": 12,
    "SEQUENCE": 16,
    "SEQUENCE OF": 16,
    "GeneralizedTime": 24,
    "GraphicString": 25,
    "VisibleString": 26,
}
_CLASSES = {"UNIVERSAL": 0x00, "APPLICATION": 0x40, "CONTEXT": 0x80, "PRIVATE": 0xC0}
TABLE = "modules.json"
"""The file beside the modules that holds what `asn1_text` makes of them."""

Tree = dict[str, Any]
Tag = tuple[int, int]
"""Class bits and number."""


class SchemaError(MmsverifyError):
    """An ASN.1 module that cannot be compiled; ``place`` is the type."""

    code = "schema"


class Later:
    """A type inside its own definition, until that is complete."""

    def __init__(self) -> None:
        self.readers: dict[int, Reader] = {}
        self.target: Type | None = None
        self.waiting: list[Callable[[], None]] = []

    def complete(self, target: Type) -> None:
        self.target = target
        self.readers.update(target.readers)
        for link in self.waiting:
            link()

    def write(self, value: Any, depth: int) -> bytes:
        assert self.target is not None
        return self.target.write(value, depth)


class Schema:
    """The types of some ASN.1 modules, compiled when asked for. Type names are unique over all of them.

    ``parsed`` is what `asn1_text.parsed` makes of their text.
    """

    def __init__(self, parsed: Mapping[str, Tree]) -> None:
        modules = parsed["modules"]
        self._choice_defaults: Tree = parsed["choice defaults"]
        self._also: Tree = modules[ALSO_READ]["types"] if ALSO_READ in modules else {}
        self._values: Tree = {
            name: one for module in modules.values() for name, one in module["values"].items()
        }
        self._trees: Tree = {}
        for name, module in modules.items():
            if name != ALSO_READ:
                self._adopt(name, module)
        self._compiled: dict[tuple[str, Tag | None], Type] = {}

    @classmethod
    def of_folder(cls, folder: Path) -> Schema:
        """The modules of ``folder`` by their table: it is read in a millisecond, they are not parsed."""
        try:
            return cls(json.loads((folder / TABLE).read_text(encoding="utf-8")))
        except (OSError, ValueError) as error:
            cure = "install mmsverify again, or make it with python -m mmsverify.formats.asn1_text"
            raise InputError(f"cannot be read: {error}", place=str(folder / TABLE), cure=cure) from None

    def _adopt(self, name: str, module: Tree) -> None:
        if module.get("tags") != "IMPLICIT":
            raise SchemaError("the module does not say IMPLICIT TAGS", place=name)
        twice = self._trees.keys() & module["types"].keys()
        if twice:
            raise SchemaError("a second type of that name", place=f"{name}.{min(twice)}")
        self._trees.update(module["types"])

    def type(self, name: str) -> Type:
        """The compiled type of that name."""
        return self._named(name, None)

    def names(self, name: str) -> dict[int, str]:
        """Number to name, for an INTEGER with named numbers or a BIT STRING with named bits; else empty."""
        tree = self._trees[name]
        numbers = tree.get("named-numbers") or dict(tree.get("named-bits") or ())
        return {int(number): label for label, number in numbers.items()}

    def object_identifier(self, name: str) -> str:
        """The object identifier that a module assigns to that name, as dotted numbers."""
        arcs = self._values[name]["value"]
        return ".".join(str(arc[1] if isinstance(arc, list) else arc) for arc in arcs)

    def places(self, root: str, names: Iterable[str]) -> list[str]:
        """The productions and fields that field names lead through from the type ``root``, outermost first.

        A production is told by its name, a field by that of its production and of the fields around it.
        """
        found: list[str] = []
        open_ones = self._opened(root, {"type": root}, found)
        for name in names:
            steps = ((f"{where}.{name}", one) for where, tree in open_ones for one in tree["members"])
            place, member = next((step for step in steps if step[1]["name"] == name), ("", {}))
            if not member:
                break
            found.append(place)
            open_ones = self._opened(place, member, found)
        return found

    def _opened(self, where: str, tree: Tree, found: list[str]) -> list[tuple[str, Tree]]:
        """The trees with members behind a type, in both its forms; productions on the way join ``found``."""
        kind = tree["type"]
        if kind == "SEQUENCE OF":
            return self._opened(where, tree["element"], found)
        if kind in ("SEQUENCE", "CHOICE"):
            return [(where, tree)]
        if kind not in self._trees:
            return []
        found.append(kind)
        forms = [form[kind] for form in (self._trees, self._also) if kind in form]
        return [one for form in forms for one in self._opened(kind, form, found)]

    def _named(self, name: str, tag: Tag | None) -> Type:
        key = name, tag
        if key not in self._compiled:
            if name not in self._trees:
                raise SchemaError("no module defines this type", place=name)
            later = Later()
            self._compiled[key] = later
            made = self._build(self._trees[name], tag, name)
            if name in self._also:
                made = EitherForm(made, self._build(self._also[name], tag, name))
            self._compiled[key] = made
            later.complete(made)
        return self._compiled[key]

    def _build(self, tree: Tree, outer: Tag | None, place: str) -> Type:
        """Compile ``tree``; ``outer`` is an implicit tag around it, which takes the place of its own."""
        own = tree.get("tag")
        if own is None:
            return self._untagged(tree, outer, place)
        tag = outer or (_CLASSES[own.get("class", "CONTEXT")], own["number"])
        bare = {key: value for key, value in tree.items() if key != "tag"}
        if own.get("kind") != "EXPLICIT":
            return self._untagged(bare, tag, place)
        if bare["type"] == "ANY":
            return ExplicitAny(_constructed(tag))
        return Explicit(_constructed(tag), self._untagged(bare, None, place))

    def _untagged(self, tree: Tree, tag: Tag | None, place: str) -> Type:
        kind = tree["type"]
        if kind == "CHOICE":
            return self._choice(tree, tag, place)
        if kind not in _UNIVERSAL:
            return self._named(kind, tag)
        tag = tag or (0, _UNIVERSAL[kind])
        if kind == "SEQUENCE":
            return Struct(_constructed(tag), [self._member(member, place) for member in tree["members"]])
        if kind == "SEQUENCE OF":
            return ListOf(_constructed(tag), self._build(tree["element"], None, place))
        return Primitive(_identifier(tag), kind, _bounds(tree))

    def _choice(self, tree: Tree, tag: Tag | None, place: str) -> Type:
        if tag is not None:
            raise SchemaError("an implicit tag over a CHOICE", place=place, cure="write EXPLICIT")
        alternatives = [
            (one["name"], self._build(one, None, f"{place}.{one['name']}")) for one in tree["members"]
        ]
        _refuse_same_tags(alternatives, place)
        made = Choice(alternatives)
        for name, kind in alternatives:
            if isinstance(kind, Later):
                kind.waiting.append(partial(made.link, name))
        return made

    def _member(self, tree: Tree, place: str) -> Member:
        where = f"{place}.{tree['name']}"
        kind = self._build(tree, None, where)
        return Member(
            tree["name"], kind, tree.get("optional", False), self._default(tree.get("default"), where)
        )

    def _default(self, written: Any, place: str) -> Any:
        if not isinstance(written, str):
            return written
        if written.startswith("0b"):
            return written[2:]
        if written in self._choice_defaults:
            return written, self._choice_defaults[written]
        raise SchemaError(f"the default {written} is not understood", place=place)


def _identifier(tag: Tag) -> int:
    bits, number = tag
    return bits | number if number < 31 else (bits | 0x1F) << 8 | number


def _constructed(tag: Tag) -> int:
    return constructed(_identifier(tag))


def _bounds(tree: Tree) -> Bounds:
    written = tree.get("restricted-to") or tree.get("size") or ()
    return tuple((bound[0], bound[1]) if isinstance(bound, list) else (bound, bound) for bound in written)


def _refuse_same_tags(alternatives: Iterable[tuple[str, Type]], place: str) -> None:
    seen: dict[int, str] = {}
    for name, kind in alternatives:
        for head in kind.readers:
            if head in seen:
                raise SchemaError(f"{seen[head]} and {name} have the same tag", place=place)
            seen[head] = name

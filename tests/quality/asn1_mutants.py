"""ASN.1 modules with one thing changed: a tag, a member, a default, a name, a type.

A mutant is a change of the parse tree of the modules; what is made of it is a schema of its own.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

Tree = dict[str, Any]
Edit = Callable[[Tree], None]
OTHER_TYPE = {
    "INTEGER": "BOOLEAN", "BOOLEAN": "INTEGER", "NULL": "BOOLEAN", "VisibleString": "OCTET STRING",
    "BIT STRING": "OCTET STRING", "OBJECT IDENTIFIER": "OCTET STRING", "OCTET STRING": "NULL",
    "SEQUENCE": "NULL", "CHOICE": "NULL", "SEQUENCE OF": "NULL",
}  # fmt: skip


@dataclass(frozen=True)
class Mutant:
    """A change: where (module, then keys and positions), what, how."""

    module: str
    path: tuple[Any, ...]
    name: str
    edit: Edit

    def applied(self, modules: Tree) -> Tree:
        """The modules with this change made; what is given stays as it is."""
        changed = {**modules, self.module: copy.deepcopy(modules[self.module])}
        node = changed[self.module]["types"]
        for step in self.path:
            node = node[step]
        self.edit(node)
        return changed


def mutants(
    modules: Tree, module: str, production: str, fields: frozenset[str] = frozenset()
) -> list[Mutant]:
    """Every change of one production; with ``fields``, of those members only."""
    tree = modules[module]["types"][production]
    return [
        Mutant(module, path, f"{'.'.join(place)}: {what}", edit)
        for path, place, node in _nodes(tree, (production,), (production,))
        if not fields or fields.intersection(place[1:2])
        for what, edit in _edits(node)
    ]


def _nodes(
    tree: Tree, path: tuple[Any, ...], place: tuple[str, ...]
) -> Iterator[tuple[tuple[Any, ...], tuple[str, ...], Tree]]:
    """Every part of a production: the way to it by keys and positions, the same by names, the part."""
    yield path, place, tree
    for index, member in enumerate(tree.get("members", ())):
        yield from _nodes(member, (*path, "members", index), (*place, member["name"]))
    if "element" in tree:
        yield from _nodes(tree["element"], (*path, "element"), (*place, "each"))


def _edits(node: Tree) -> Iterator[tuple[str, Edit]]:
    yield from _tags(node)
    yield f"another type than {node['type']}", _retyped
    members = node.get("members", ())
    for index, member in enumerate(members):
        yield f"without {member['name']}", _without(index)
        if index:
            yield f"{member['name']} and the one before change places", _swapped(index)
        if node["type"] == "SEQUENCE":
            for what, edit in _presence(member):
                yield f"{member['name']} {what}", _within(index, edit)
    yield from _names(node)


def _within(index: int, edit: Edit) -> Edit:
    return lambda node: edit(node["members"][index])


def _tags(node: Tree) -> Iterator[tuple[str, Edit]]:
    if "tag" not in node:
        yield "a tag of its own", lambda one: one.update(tag={"number": 77, "kind": "EXPLICIT"})
        return
    yield "another tag", lambda one: one["tag"].update(number=one["tag"]["number"] + 11)
    if node["tag"].get("kind") == "EXPLICIT":
        yield "an implicit tag", lambda one: one["tag"].update(kind="IMPLICIT")
    else:
        yield "an explicit tag", lambda one: one["tag"].update(kind="EXPLICIT")
    yield "no tag", lambda one: one.pop("tag")


def _retyped(node: Tree) -> None:
    node["type"] = OTHER_TYPE.get(node["type"], "OCTET STRING")
    for key in ("members", "element", "named-numbers", "named-bits", "restricted-to", "size"):
        node.pop(key, None)
    node.pop("default", None)


def _without(index: int) -> Edit:
    return lambda node: node["members"].pop(index)


def _swapped(index: int) -> Edit:
    def edit(node: Tree) -> None:
        one, other = node["members"][index - 1 : index + 1]
        if node["type"] == "CHOICE":
            one["name"], other["name"] = other["name"], one["name"]
        else:
            node["members"][index - 1 : index + 1] = [other, one]

    return edit


def _presence(node: Tree) -> Iterator[tuple[str, Edit]]:
    if node.get("optional"):
        yield "not OPTIONAL", lambda one: one.pop("optional")
    elif "default" in node:
        yield "no DEFAULT", lambda one: one.pop("default")
        yield "OPTIONAL instead of DEFAULT", _no_default
        if str(node["default"]).startswith("0b"):
            yield "another DEFAULT", lambda one: one.update(default="0b" + "0" * (len(one["default"]) - 2))
    else:
        yield "OPTIONAL", lambda one: one.update(optional=True)


def _no_default(node: Tree) -> None:
    del node["default"]
    node["optional"] = True


def _names(node: Tree) -> Iterator[tuple[str, Edit]]:
    for name in node.get("named-numbers", ()):
        yield f"{name} has another number", _renumbered(name)
    for index, (name, _) in enumerate(node.get("named-bits", ())):
        yield f"{name} is another bit", _moved(index)


def _renumbered(name: str) -> Edit:
    return lambda node: node["named-numbers"].update({name: node["named-numbers"][name] + 50})


def _moved(index: int) -> Edit:
    def edit(node: Tree) -> None:
        name, number = node["named-bits"][index]
        node["named-bits"][index] = (name, str(int(number) + 50))

    return edit

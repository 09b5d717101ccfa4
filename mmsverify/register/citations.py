"""Citations out of whatever holds them: model declarations, tables of rules, profile keys.

One walk over plain data: a :class:`Clause`, or a text that is an id, counts for the nearest thing that has a
name. So a new table is covered by being listed, and no table has to know that there is a register.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from mmsverify.model import Clause, Model, Procedure
from mmsverify.model.claims import ClaimSource, Removed
from mmsverify.model.declare import Declared
from mmsverify.model.expr import Expr
from mmsverify.model.rows import Repair
from mmsverify.model.steps import cited
from mmsverify.model.terms import SetOf, Term

ID = re.compile(r"[A-Z]-[A-Za-z0-9.]+(-[A-Za-z0-9]+)?")
"""An id of a register: the letter of its source, the clause, the number or label within it."""

READING = re.compile(r"(RP|VR|MR)-\d\d|B-[A-Z]+(-[A-Z]+)*")
"""A reading of the project, or an assumption about the base standard: no statement of a register."""

NAMES = ("rule", "id", "name")
"""The fields by which data names itself, the first that is filled."""

OPAQUE = (Expr, Term, SetOf, Repair, type)
"""What cites nothing of its own: expressions, and the reasons of repairs, which are told apart."""

Cited = tuple[str, str, Clause]
"""What kind of thing encodes, its name, what it cites."""

KINDS: Mapping[str, str] = {
    "Transition": "row",
    "Procedure": "step of a procedure",
    "Initially": "condition at power-on",
    "Assume": "assumption",
    "Unspecified": "declared gap",
    "Occurs": "cause of an event",
    "Relation": "variable",
    "Derived": "definition",
}


def of_model(source: type[Model]) -> Iterator[Cited]:
    """What the declarations of a model cite, and the tables that it has as an option.

    ``tables`` says of each table what kind of thing its entries are.
    """
    for kind, table in source.options.get("tables", {}).items():
        yield from ((kind, own, clause) for own, clause in citations(table, kind))
    for name, declared in source.declared.items():
        if isinstance(declared, Removed):
            continue
        if isinstance(declared, Procedure):
            for step in declared.steps:
                yield KINDS["Procedure"], f"{name}/{step.label}", cited(declared.clause, step)
            continue
        title = name.replace("_", "-") if isinstance(declared, ClaimSource) else name
        kind = _kind(declared)
        yield from ((kind, own, clause) for own, clause in citations(vars(declared), title, inner=True))


def _kind(declared: Declared) -> str:
    if isinstance(declared, ClaimSource):
        return f"property ({declared.kind})"
    word = type(declared).__name__
    return KINDS.get(word, word.lower())


def citations(value: Any, name: str, *, inner: bool = False) -> Iterator[tuple[str, Clause]]:
    """Every citation within ``value``, with the name of the innermost thing that has one.

    ``inner``: the keys of this mapping are attributes, no names.
    """
    if isinstance(value, Clause):
        yield name, value
    elif isinstance(value, str):
        if ID.fullmatch(value) and not READING.fullmatch(value):
            yield name, Clause.of(value)
    elif isinstance(value, OPAQUE):
        return
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from citations(key, name)
            yield from citations(item, name if inner or not isinstance(key, str) else key)
    elif isinstance(value, tuple | list | set | frozenset):
        for item in value:
            yield from citations(item, name)
    elif is_dataclass(value):
        parts = {field.name: getattr(value, field.name) for field in fields(value)}
        named = next(
            (parts[word] for word in NAMES if isinstance(parts.get(word), str) and parts[word]), name
        )
        yield from citations({k: v for k, v in parts.items() if k not in NAMES}, named, inner=True)

"""A finite world for a model: how many things of each kind, what they are called, what is fixed about them.

The concrete readers enumerate; a scope is what makes that finite. Nothing here knows rows or states.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Any

from mmsverify.errors import UsageError
from mmsverify.model import expr as ex
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Row, Signature
from mmsverify.model.sorts import BOOL, ElementSort, Enumeration, EnumSort, IntSort, Sort
from mmsverify.model.terms import SetOf

Value = bool | int | str | Enumeration
"""A value of a cell: a truth value, an integer, the name of an element, a member of an enumeration."""

Binding = Value | frozenset[str] | None
"""A value of a parameter: also a set of names, or ``None`` for an optional parameter that is absent."""

CellKey = tuple[str, tuple[str, ...]]
"""A state variable with the names of the elements that it is taken at."""

Scenario = Callable[[Mapping[str, int], Mapping[str, Any]], Any]


@dataclass(frozen=True, slots=True)
class Scope:
    """The elements of each sort (by its short name), facts about rigid or initial cells, bounds of integers.

    A fact may give a member of an enumeration or the word that the member prints. ``int_bounds`` (both
    inclusive) stand where a sort states no bound of its own: a step to a value outside is cut, and the
    reader says so. ``tried`` names, for an enumeration, the members that a parameter takes; all where it does
    not say. ``largest_set`` bounds the sets that a parameter takes; such a scope has fewer steps, so that it
    serves to find a run and never to exclude one.
    """

    elements: Mapping[str, tuple[str, ...]]
    facts: Mapping[CellKey, Value] = field(default_factory=dict)
    int_bounds: tuple[int, int] = (0, 3)
    tried: Mapping[str, tuple[Enumeration, ...]] = field(default_factory=dict)
    largest_set: int | None = None

    def names(self, sort: ElementSort) -> tuple[str, ...]:
        """The names of the elements of a sort; :class:`UsageError` if the scope says nothing of the sort."""
        names = self.elements.get(sort.short)
        if names is None:
            raise UsageError(f"the scope has no {sort.short}", cure=f"give at least one: {sort.short}=1")
        return names

    def bounds(self, sort: IntSort) -> tuple[int, int]:
        """The least and the greatest integer of a sort in this scope."""
        low, high = self.int_bounds
        return (low if sort.low is None else sort.low, high if sort.high is None else sort.high)

    def values(self, sort: Sort) -> tuple[Value, ...]:
        """All values of a sort, in their fixed order."""
        if isinstance(sort, ElementSort):
            return self.names(sort)
        if isinstance(sort, EnumSort):
            return sort.members
        if isinstance(sort, IntSort):
            low, high = self.bounds(sort)
            return tuple(range(low, high + 1))
        return (False, True)

    def cells(self, signature: Signature) -> Iterator[CellKey]:
        """All cells of a variable, in order."""
        for names in product(*(self.values(sort) for sort in signature.sorts)):
            yield signature.name, tuple(map(str, names))

    def bindings(self, row: Row) -> Iterator[dict[str, Binding]]:
        """All ways to give values to a row's parameters; absence comes first, sets grow in binary order."""
        choices = [self.parameter_values(row, parameter) for parameter in row.parameters]
        for values in product(*choices):
            yield dict(zip((p.name for p in row.parameters), values, strict=True))

    def parameter_values(self, row: Row, parameter: ex.Ref | SetOf) -> tuple[Binding, ...]:
        """What one parameter of a row may be."""
        if isinstance(parameter, SetOf):
            names = self.names(parameter.of)
            return tuple(frozenset(names[i] for i in members) for members in self.subsets(parameter.of))
        absent: tuple[Binding, ...] = (None,) if parameter.name in row.on.optional else ()
        return absent + self.tried.get(parameter.of.name, self.values(parameter.of))

    def subsets(self, sort: ElementSort) -> Iterator[frozenset[int]]:
        """The sets of elements that a parameter takes, in binary order, as the numbers of their members."""
        size = len(self.names(sort))
        for bits in range(1 << size):
            if self.largest_set is None or bits.bit_count() <= self.largest_set:
                yield frozenset(i for i in range(size) if bits >> i & 1)

    def __str__(self) -> str:
        """The sizes; of a model that has no elements there is nothing to count but the one machine."""
        sizes = ", ".join(f"{sort}={len(names)}" for sort, names in self.elements.items())
        return sizes or "one machine"


def known_facts(model: ModelData, scope: Scope) -> dict[CellKey, Value]:
    """The facts of a scope as values of the model; :class:`UsageError` for an unknown cell or value."""
    facts: dict[CellKey, Value] = {}
    for key, given in scope.facts.items():
        signature = model.signatures.get(key[0])
        if signature is None or key not in set(scope.cells(signature)):
            cause = f"a fact about {cell_name(key)}, which is no cell of {model.name} in scope {scope}"
            raise UsageError(cause, cure="name a variable and elements of the scope")
        facts[key] = _value(given, signature.of, scope, key)
    return facts


def _value(given: Value, sort: Sort, scope: Scope, key: CellKey) -> Value:
    for value in scope.values(sort):
        if given == value and isinstance(given, bool) == isinstance(value, bool):
            return value
        if isinstance(value, Enumeration) and given in (value.name, value.value):
            return value
    known = ", ".join(map(str, scope.values(sort)))
    raise UsageError(f"{given!s} is not a value of {cell_name(key)}", cure=f"use one of {known}")


def cell_name(key: CellKey) -> str:
    """``state[R_ARM]``: the cell as results print it."""
    return f"{key[0]}[{', '.join(key[1])}]" if key[1] else key[0]


def generic_scope(model: ModelData, sizes: Mapping[str, int]) -> Scope:
    """A scope without facts; elements are called ``PI1``, ``PI2``; a sort without a size has one."""
    return Scope(
        {
            s.short: tuple(f"{s.short}{i + 1}" for i in range(sizes.get(s.short, 1)))
            for s in model.sorts.values()
        }
    )


def scope_for(model: ModelData, sizes: Mapping[str, int], profile: Mapping[str, Any] | None = None) -> Scope:
    """The scope that the model's own ``scenario`` option makes of sizes and profile, else a generic one."""
    unknown = [name for name in sizes if name not in {s.short for s in model.sorts.values()}]
    if unknown:
        raise UsageError(f"the model {model.name} has no sort {unknown[0]}",
                         cure="use " + ", ".join(s.short for s in model.sorts.values()))  # fmt: skip
    scenario: Scenario | None = model.options.get("scenario")
    if scenario is None:
        return generic_scope(model, sizes)
    made = scenario(sizes, profile or {})
    if isinstance(made, Scope):
        return made
    elements, facts, *rest = made if isinstance(made, tuple) else (made.elements, made.facts)
    return Scope(dict(elements), dict(facts), *rest)


def is_boolean(sort: Sort) -> bool:
    """Whether the values of a sort are truth values."""
    return sort is BOOL or sort == BOOL

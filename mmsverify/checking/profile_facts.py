"""What a profile fixes, as assumptions of a proof for any number of elements.

The names of the profile are constants, different from each other; every other element has the fixed
attributes of one that the profile does not name. What stays free is how many others there are, and what they
do.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

from mmsverify.checking.worlds import World
from mmsverify.concrete import Scope
from mmsverify.concrete.evaluate import Moment, holds
from mmsverify.concrete.scope import CellKey, Value, known_facts
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Const, Expr, Ref
from mmsverify.model.model import ModelData
from mmsverify.model.rewrite import bind
from mmsverify.model.rows import Claim
from mmsverify.model.sorts import ElementSort, Sort


def assumed(model: ModelData, profile: Mapping[str, Any] | None) -> list[Expr]:
    """The assumptions; none without a profile, or for a model whose option ``named`` counts no names."""
    counts = model.options.get("named")
    if profile is None or counts is None:
        return []
    sizes = dict(counts(profile))
    named = World(sizes, profile).scope(model)
    larger = World({sort: size + 1 for sort, size in sizes.items()}, profile).scope(model)
    known = _Names({sort: named.elements[sort] for sort in sizes}, model)
    facts = known_facts(model, larger).items()
    return [*known.different(), *(known.fact(key, held) for key, held in facts)]


def applies(model: ModelData, claim: Claim, scope: Scope) -> bool:
    """Whether the claim is made of the profile that holds in a scope."""
    if claim.provided == ex.TRUE:
        return True
    known = known_facts(model, scope)
    read = [model.signatures[name] for name in ex.variables_of(claim.provided)]
    fixed = {key: known.get(key, False) for signature in read for key in scope.cells(signature)}
    return holds(claim.provided, Moment(scope, fixed, {}))


class _Names:
    """The names of a profile as constants of a proof; any other name stands for all that are left."""

    def __init__(self, names: Mapping[str, tuple[str, ...]], model: ModelData) -> None:
        self.names, self.model = names, model
        self._sorts = {sort.short: sort for sort in model.sorts.values()}

    def different(self) -> Iterator[Expr]:
        """The constants of a sort are different elements."""
        for short, names in self.names.items():
            sort = self._sorts[short]
            for left, right in combinations(names, 2):
                yield ex.negation(ex.equal(_constant(left, sort), _constant(right, sort)))

    def fact(self, key: CellKey, held: Value) -> Expr:
        """One fact: about the names in it, and about every element that the profile does not name."""
        signature = self.model.signatures[key[0]]
        args: list[Expr] = []
        others: list[Ref] = []
        for place, (name, sort) in enumerate(zip(key[1], signature.sorts, strict=True)):
            assert isinstance(sort, ElementSort)
            if name in self.names.get(sort.short, ()):
                args.append(_constant(name, sort))
            else:
                others.append(Ref(f"other{place}", sort))
                args.append(others[-1])
        unnamed = (ex.equal(ref, _constant(n, ref.of)) for ref in others for n in self._listed(ref))
        cell = Cell(signature.name, tuple(args), signature.of)
        assert not isinstance(held, str)
        stated = ex.disjunction(*unnamed, ex.equal(cell, Const(held, signature.of)))
        return bind(True, tuple(others), stated)

    def _listed(self, ref: Ref) -> tuple[str, ...]:
        assert isinstance(ref.of, ElementSort)
        return self.names.get(ref.of.short, ())


def _constant(name: str, sort: Sort) -> Ref:
    """The constant for a name; the mark keeps it apart from the parameters of rows."""
    return Ref(f"{name}@profile", sort)

"""Random steps of a model, taken by the judge: what every kind of made-up conversation is made of."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from random import Random

from mmsverify.concrete import Scope
from mmsverify.concrete.evaluate import Valuation, step, within_bounds
from mmsverify.concrete.scope import Binding
from mmsverify.model import ModelData, Row

Bindings = dict[str, Binding]


def guessed(row: Row, known: Mapping[str, Binding], scope: Scope, random: Random) -> Bindings:
    """Parameters of a row: those that are known, any values for the others."""
    return {
        p.name: known[p.name] if p.name in known else random.choice(scope.parameter_values(row, p))
        for p in row.parameters
    }


def taken(
    model: ModelData, scope: Scope, row: Row, bindings: Mapping[str, Binding], state: Valuation
) -> Valuation | None:
    """The state after a row, if it can be taken."""
    after = step(row, bindings, state, scope)
    return after if after is not None and within_bounds(model, scope, after) else None


def tried(
    model: ModelData,
    scope: Scope,
    rows: Iterable[Row],
    known: Mapping[str, Binding],
    state: Valuation,
    random: Random,
    tries: int,
) -> tuple[Row, Bindings, Valuation] | None:
    """A step of one of the rows, if one is found: the row, its parameters, the state after."""
    listed = list(rows)
    for _ in range(tries if listed else 0):
        row = random.choice(listed)
        bindings = guessed(row, known, scope, random)
        after = taken(model, scope, row, bindings, state)
        if after is not None:
            return row, bindings, after
    return None

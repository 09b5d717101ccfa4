"""The judge: expressions and rows read by walking the tree, over states that are plain mappings.

This is the simplest possible reading, and the slowest. The other readers are tested against it and
counterexamples are replayed by it, so nothing here is shared with them and nothing here is clever.

An absent optional parameter has no value. Every Boolean atom that reads one (a comparison, a Boolean cell,
a membership, the parameter itself) is false; an update at an absent argument touches nothing; an update to
an absent value is an error of the model. Models protect such reads with ``present``, so that no reader
needs another convention.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product

from mmsverify.concrete.scope import Binding, CellKey, Scope, Value, is_boolean
from mmsverify.errors import ModelError
from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Expr, Ref
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Row
from mmsverify.model.sorts import IntSort

Valuation = Mapping[CellKey, Value]
"""A state: the value of every cell."""


@dataclass(frozen=True, slots=True)
class Moment:
    """All that an expression may speak of: state and parameters; of a step, the next state and the row."""

    scope: Scope
    state: Valuation
    bindings: Mapping[str, Binding]
    after: Valuation | None = None
    row: Row | None = None

    def knowing(self, refs: tuple[Ref, ...]) -> Iterator[Moment]:
        """This moment with the bound variables set to every combination of values."""
        for values in product(*(self.scope.values(ref.of) for ref in refs)):
            names = (ref.name for ref in refs)
            yield replace(self, bindings={**self.bindings, **dict(zip(names, values, strict=True))})


def holds(expr: Expr, at: Moment) -> bool:
    """Whether a Boolean expression is true."""
    return value(expr, at) is True


def value(expr: Expr, at: Moment) -> Value | None:
    """The value of an expression; ``None`` if it is not Boolean and rests on an absent parameter."""
    found = _value(expr, at)
    return False if found is None and is_boolean(expr.sort) else found


def _value(expr: Expr, at: Moment) -> Value | None:
    match expr:
        case ex.Const(constant):
            return constant
        case ex.Ref(name):
            return _given(at, name)
        case ex.Cell():
            return _cell(expr, at)
        case ex.Member(name, element):
            return value(element, at) in _subset(at, name)
        case ex.Present(name):
            return at.bindings[name] is not None
        case ex.RowFact(fact, values):
            return _fact(fact, at) in values
        case ex.Ite(condition, then, otherwise):
            return value(then if holds(condition, at) else otherwise, at)
        case ex.Plus(left, right, factor):
            return _sum(value(left, at), value(right, at), factor)
    return _connective(expr, at)


def _connective(expr: Expr, at: Moment) -> bool:
    match expr:
        case ex.Not(body):
            return not holds(body, at)
        case ex.And(parts):
            return all(holds(part, at) for part in parts)
        case ex.Or(parts):
            return any(holds(part, at) for part in parts)
        case ex.Eq(left, right):
            return value(left, at) is not None and value(left, at) == value(right, at)
        case ex.Less(left, right):
            return _less(value(left, at), value(right, at))
        case ex.Quantified(universal, bound, body):
            return (all if universal else any)(holds(body, each) for each in at.knowing(bound))
    raise TypeError(f"no reading for {expr!r}")


def _given(at: Moment, name: str) -> Value | None:
    found = at.bindings[name]
    assert not isinstance(found, frozenset)
    return found


def _subset(at: Moment, name: str) -> frozenset[str]:
    found = at.bindings[name] or frozenset()
    assert isinstance(found, frozenset)
    return found


def _cell(expr: ex.Cell, at: Moment) -> Value | None:
    args = tuple(value(arg, at) for arg in expr.args)
    state = at.after if expr.next else at.state
    assert state is not None, "a two-state expression where there is one state"
    return None if None in args else state[expr.variable, tuple(map(str, args))]


def _fact(fact: str, at: Moment) -> str:
    assert at.row is not None, "a fact about a step where there is none"
    return row_facts(at.row)[fact]


def row_facts(row: Row) -> dict[str, str]:
    """What a claim about steps may ask of the row that makes the step."""
    return {"answer": row.answer, "service": row.on.service, "phase": row.on.phase, "name": row.name}


def _sum(left: Value | None, right: Value | None, factor: int) -> int | None:
    return left + factor * right if isinstance(left, int) and isinstance(right, int) else None


def _less(left: Value | None, right: Value | None) -> bool:
    return isinstance(left, int) and isinstance(right, int) and left < right


def enabled(row: Row, at: Moment) -> bool:
    """Whether every conjunct of the row's guard holds."""
    return all(holds(conjunct.condition, at) for conjunct in row.guard)


def updated(row: Row, at: Moment) -> dict[CellKey, Value]:
    """The state after the row's assignments: all read the state before, a later one wins."""
    after = dict(at.state)
    for assign in row.assigns:
        for each in at.knowing(assign.bound):
            args = tuple(value(arg, each) for arg in assign.args)
            if None not in args and holds(assign.where, each):
                after[assign.variable, tuple(map(str, args))] = _assigned(row, assign, each)
    return after


def _assigned(row: Row, assign: Assign, at: Moment) -> Value:
    found = value(assign.value, at)
    if found is None:
        raise absent_value(row, assign)
    return found


def absent_value(row: Row, assign: Assign) -> ModelError:
    """The error for an update that reads the value of a parameter that is not given."""
    return ModelError(
        f"row {row.id} gives {assign.variable} the value of an optional parameter that is absent",
        place=assign.place or row.place,
        cure="make the update only where it is given: .when(x.present)",
    )


def step(
    row: Row, bindings: Mapping[str, Binding], state: Valuation, scope: Scope
) -> dict[CellKey, Value] | None:
    """The state after one step of a row, or ``None`` where its guard refuses."""
    at = Moment(scope, state, bindings)
    return updated(row, at) if enabled(row, at) else None


Taken = tuple[Row, dict[str, Binding], dict[CellKey, Value]]


def successors(model: ModelData, scope: Scope, state: Valuation) -> Iterator[Taken]:
    """Every step from a state: row, parameters, state after it, which may lie outside the bounds."""
    for row in model.actions:
        for bindings in scope.bindings(row):
            after = step(row, bindings, state, scope)
            if after is not None:
                yield row, bindings, after


def within_bounds(model: ModelData, scope: Scope, state: Valuation) -> bool:
    """Whether every integer of a state lies inside the bounds of its sort in this scope."""
    for (variable, _), held in state.items():
        sort = model.signatures[variable].of
        if isinstance(sort, IntSort) and held not in scope.values(sort):
            return False
    return True

"""How far a state may still drift before an event: the values that internal rows could yet give to variables.

A state from which, for all that may still happen, the event cannot be, need not be explored further.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.truth import value
from mmsverify.concrete.belief.values import Known, everything, join
from mmsverify.model.expr import Cell, Const, Expr, Ite, Ref
from mmsverify.model.rows import Row

Reach = dict[str, Known]


def reach(firings: Iterable[tuple[Row, dict[str, Any]]], blank: Partial) -> Reach:
    """For each variable that the rows write, the values that they may give it."""
    found: Reach = {}
    for row, env in firings:
        for assign in row.assigns:
            target = Cell(assign.variable, assign.args, assign.value.sort)
            for known in _values(assign.value, target, env, blank):
                found[assign.variable] = join(found.get(assign.variable, known), known)
    return found


def _values(expr: Expr, target: Cell, env: dict[str, Any], blank: Partial) -> Iterator[Known]:
    """The values that an assignment may give its target, beyond what the target already has."""
    match expr:
        case Ite(_, then, otherwise):
            yield from _values(then, target, env, blank)
            yield from _values(otherwise, target, env, blank)
        case Const() | Ref():
            yield value(expr)(blank, env)
        case Cell() if expr == target:
            return
        case _:
            yield everything(expr.sort)


def drifted(state: Partial, within_reach: Reach) -> Partial:
    """The state with every value still possible that its cells may yet take."""
    cells = {
        key: join(known, within_reach[key[0]]) if key[0] in within_reach else known
        for key, known in state.cells.items()
    }
    return Partial(state.world, cells)

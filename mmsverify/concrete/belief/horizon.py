"""How far a state may still drift before an event: the values that internal rows could yet give to variables.

A state from which, for all that may still happen, the event cannot be, need not be explored further.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mmsverify.concrete.belief.partial import Key, Partial
from mmsverify.concrete.belief.truth import Env, value
from mmsverify.concrete.belief.values import Known, everything, join
from mmsverify.model.expr import Cell, Const, Expr, Ite, Ref
from mmsverify.model.rows import Row

Reach = dict[str, Known]


def reach(firings: Iterable[tuple[Row, Env]], blank: Partial) -> Reach:
    """For each variable that the rows write, the values that they may give it."""
    found: Reach = {}
    for row, env in firings:
        for assign in row.assigns:
            target = Cell(assign.variable, assign.args, assign.value.sort)
            for known in _values(assign.value, target, env, blank):
                found[assign.variable] = join(found.get(assign.variable, known), known)
    return found


def _values(expr: Expr, target: Cell, env: Env, blank: Partial) -> Iterator[Known]:
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


class Drifting:
    """A state with every value still possible that its cells may yet take, for whoever only reads it."""

    __slots__ = ("_reach", "_state", "cells", "world")

    def __init__(self, state: Partial, within_reach: Reach) -> None:
        self.world, self.cells = state.world, state.cells
        self._state, self._reach = state, within_reach

    def get(self, key: Key) -> Known:
        """What may yet be of a cell."""
        known, more = self._state.get(key), self._reach.get(key[0])
        return known if more is None else join(known, more)

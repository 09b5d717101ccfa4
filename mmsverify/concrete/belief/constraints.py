"""The proved invariants as constraints on partial states: what one known cell says of others.

After a cell has changed, only those instances of an invariant are looked at that mention the cell (the idea
of watched literals); they are made once for the names seen, without those that hold anyway. Nothing is split
here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import TypeGuard

from mmsverify.concrete.belief.ground import Ground, quantifies
from mmsverify.concrete.belief.nodes import Fixed, Formula
from mmsverify.concrete.belief.partial import OTHER, Partial
from mmsverify.concrete.belief.several import changed
from mmsverify.concrete.belief.values import NO, YES
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Expr, Quantified, Ref
from mmsverify.model.rows import Clause

LARGEST = 60
"""Nodes of a formula that is worth asking.

Larger ones spell out definitions of the whole state: they are costly and narrow little.
"""
LARGEST_MEMO = 20_000


@dataclass(frozen=True, slots=True)
class _Constraint:
    bound: tuple[Ref, ...]
    body: Expr
    clause: Clause


@dataclass(frozen=True, slots=True)
class _Instance:
    """An invariant about certain names; ``unseen``: one of them has not been seen, and may not be there."""

    formula: Formula
    clause: Clause
    unseen: bool


@dataclass(frozen=True, slots=True)
class Conflict:
    """An invariant that no state in question satisfies."""

    clause: Clause


class Constraints:
    """The invariants of a model, indexed by the cells that they mention."""

    def __init__(self, ground: Ground, invariants: Iterable[tuple[Expr, Clause]]) -> None:
        self.ground = ground
        self.world = ground.world
        self._constraints = [
            _constraint(part, clause)
            for formula, clause in invariants
            for part in _conjuncts(formula)
            if sum(1 for _ in ex.walk(part)) <= LARGEST
        ]
        self._memo: dict[tuple[Partial, int], Partial | Conflict] = {}
        self._lasting: dict[int, list[_Instance]] = {}
        self._passing: dict[int, list[_Instance]] = {}
        self._counted: dict[str, int] = {}
        self._fresh = False

    def forget(self) -> None:
        """Drop what was remembered: a new name has been seen."""
        self._memo.clear()
        self._passing.clear()
        self._fresh = False

    def everywhere(self, state: Partial) -> Partial | Conflict:
        """The state narrowed by every instance of every invariant."""
        return self._remembered(state, self.world.all)

    def consistent(self, states: Iterable[Partial]) -> list[Partial]:
        """The states that no invariant excludes, each narrowed by all of them."""
        return [found for found in map(self.everywhere, states) if not isinstance(found, Conflict)]

    def after(self, state: Partial, before: Partial) -> Partial | Conflict:
        """The state narrowed by what its changes imply, and what that implies in turn."""
        return self._remembered(state, self._difference(before, state))

    def _difference(self, before: Partial, after: Partial) -> int:
        if before.beside is after.beside:
            return before.bits ^ after.bits
        found = 0
        for key in changed(before, after):
            found |= self.world.spots[key]
        return found

    def _remembered(self, state: Partial, start: int) -> Partial | Conflict:
        if not start:
            return state
        key = (state, start)
        found = self._memo.get(key)
        if found is None:
            if len(self._memo) > LARGEST_MEMO:
                self._memo.clear()
            found = self._memo[key] = self._propagate(state, start)
        return found

    def _propagate(self, state: Partial, start: int) -> Partial | Conflict:
        if not self._fresh:
            self._make()
        todo = start
        while todo:
            place = self.world.at_bit[(todo & -todo).bit_length() - 1]
            todo &= ~place.bits
            for instances in (self._lasting.get(place.shift, ()), self._passing.get(place.shift, ())):
                for instance in instances:
                    found = instance.formula.holds(state)
                    if found == YES:
                        continue
                    narrowed = instance.formula.assume(state, True, False) if found != NO else []
                    if not narrowed:
                        if instance.unseen:
                            continue  # it holds of no unseen name: then there is none
                        return Conflict(instance.clause)
                    if narrowed[0] is not state:
                        todo |= self._difference(state, narrowed[0])
                        state = narrowed[0]
        return state

    def _make(self) -> None:
        """The instances about names seen since the last time, and those that quantify over them."""
        for constraint in self._constraints:
            lasting = not quantifies(constraint.body)
            index = self._lasting if lasting else self._passing
            for instance in self._made(constraint, self._counted if lasting else {}):
                for place in self.world.changed(instance.formula.reads):
                    index.setdefault(place.shift, []).append(instance)
        self._counted = {sort: len(names) for sort, names in self.world.names.items()}
        self._fresh = True

    def _made(self, constraint: _Constraint, counted: Mapping[str, int]) -> Iterator[_Instance]:
        names = [ref.name for ref in constraint.bound]
        sorts = [ref.of.name for ref in constraint.bound]
        old = [set(self.world.names[sort][: counted.get(sort, 0)]) for sort in sorts]
        if counted and not sorts:
            return
        for chosen in product(*(self.world.names[sort] for sort in sorts)):
            if counted and all(name in seen for name, seen in zip(chosen, old, strict=True)):
                continue
            named = dict(zip(names, chosen, strict=True))
            if chosen.count(OTHER) > 1 and _confuses(constraint.body, named):
                continue
            formula = self.ground.formula(constraint.body, named)
            if not isinstance(formula, Fixed) or formula.value != YES:
                yield _Instance(formula, constraint.clause, OTHER in chosen)


def _confuses(body: Expr, named: Mapping[str, str]) -> bool:
    """Whether it compares two unseen names that share a cell: what the cell says holds of each by itself."""
    cells = {node for node in ex.walk(body) if isinstance(node, Cell)}
    shared = {(c.variable, tuple(named.get(getattr(arg, "name", ""), arg) for arg in c.args)) for c in cells}
    return len(shared) < len(cells)


def _constraint(formula: Expr, clause: Clause) -> _Constraint:
    bound, body = (formula.bound, formula.body) if _is_universal(formula) else ((), formula)
    return _Constraint(bound, body, clause)


def _is_universal(formula: Expr) -> TypeGuard[Quantified]:
    return isinstance(formula, Quantified) and formula.universal


def _conjuncts(formula: Expr) -> Iterator[Expr]:
    """The conjuncts of a formula, also those under a universal quantifier or behind one implication."""
    if isinstance(formula, ex.And):
        for part in formula.parts:
            yield from _conjuncts(part)
    elif _is_universal(formula) and isinstance(formula.body, ex.And):
        for part in formula.body.parts:
            yield from _conjuncts(ex.quantified(True, formula.bound, part))
    elif _is_universal(formula) and isinstance(formula.body, ex.Or):
        for part in _distributed(formula.body):
            yield ex.quantified(True, formula.bound, part)
    else:
        yield formula


def _distributed(body: ex.Or) -> Iterator[Expr]:
    """A disjunction with one conjunction in it as several disjunctions."""
    joined = [part for part in body.parts if isinstance(part, ex.And)]
    if len(joined) != 1:
        yield body
        return
    others = [part for part in body.parts if part is not joined[0]]
    for part in joined[0].parts:
        yield ex.disjunction(*others, part)

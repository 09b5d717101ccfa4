"""The proved invariants as constraints on partial states: what one known cell says of others.

After a cell has changed, only those instances of an invariant are looked at that mention the cell: its
arguments bind the quantified variables, the remaining ones range over the names seen (the idea of watched
literals). Nothing is split here.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import TypeGuard

from mmsverify.concrete.belief.comparison import Narrowing
from mmsverify.concrete.belief.narrow import narrowing
from mmsverify.concrete.belief.partial import OTHER, Key, Partial, World
from mmsverify.concrete.belief.truth import Truth, truth
from mmsverify.concrete.belief.values import NO, YES
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Expr, Quantified, Ref
from mmsverify.model.rows import Clause

LARGEST = 60
"""Nodes of a formula that is worth asking.

Larger ones spell out definitions of the whole state: they are costly and narrow little.
"""

_Trigger = tuple[int, tuple[str, ...]]


@dataclass(frozen=True, slots=True)
class _Constraint:
    bound: tuple[Ref, ...]
    holds: Truth
    assume: Narrowing
    clause: Clause


@dataclass(frozen=True, slots=True)
class Conflict:
    """An invariant that no state in question satisfies."""

    clause: Clause


class Constraints:
    """The invariants of a model, indexed by the variables that they mention."""

    def __init__(self, world: World, invariants: Iterable[tuple[Expr, Clause]]) -> None:
        self.world = world
        self._constraints: list[_Constraint] = []
        self._triggers: dict[str, list[_Trigger]] = {}
        self._memo: dict[tuple[Partial, frozenset[Key]], Partial | Conflict] = {}
        for formula, clause in invariants:
            for part in _conjuncts(formula):
                if sum(1 for _ in ex.walk(part)) <= LARGEST:
                    self._add(part, clause)

    def _add(self, formula: Expr, clause: Clause) -> None:
        bound, body = (formula.bound, formula.body) if _is_universal(formula) else ((), formula)
        number = len(self._constraints)
        self._constraints.append(_Constraint(bound, truth(body), narrowing(body, True), clause))
        seen = set()
        for node in ex.walk(body):
            if isinstance(node, Cell):
                seen.add((node.variable, tuple(a.name if isinstance(a, Ref) else "" for a in node.args)))
        for variable, args in sorted(seen):
            self._triggers.setdefault(variable, []).append((number, args))

    def forget(self) -> None:
        """Drop what was remembered: a new name has been seen."""
        self._memo.clear()

    def everywhere(self, state: Partial) -> Partial | Conflict:
        """The state narrowed by every instance of every invariant."""
        return self.after(
            state,
            {
                (s.name, names)
                for s in self.world.model.signatures.values()
                for names in self.world.combinations(s.sorts)
            },
        )

    def consistent(self, states: Iterable[Partial]) -> list[Partial]:
        """The states that no invariant excludes, each narrowed by all of them."""
        return [found for found in map(self.everywhere, states) if not isinstance(found, Conflict)]

    def after(self, state: Partial, changed: Iterable[Key]) -> Partial | Conflict:
        """The state narrowed by what the changed cells imply, and what that implies in turn."""
        start = frozenset(changed)
        if not start:
            return state
        memo_key = (state, start)
        found = self._memo.get(memo_key)
        if found is None:
            if len(self._memo) > 20000:
                self._memo.clear()
            found = self._memo[memo_key] = self._propagate(state, start)
        return found

    def _propagate(self, state: Partial, start: frozenset[Key]) -> Partial | Conflict:
        queue, waiting = deque(sorted(start)), set(start)
        while queue:
            key = queue.popleft()
            waiting.discard(key)
            for constraint, env in self._instances(key):
                found = constraint.holds(state, env)
                if found == YES:
                    continue
                narrowed = constraint.assume(state, env, False) if found != NO else []
                if not narrowed:
                    if OTHER in env.values():
                        continue  # it holds of no unseen name: then there is none
                    return Conflict(constraint.clause)
                for fresh in _differences(state, narrowed[0]):
                    if fresh not in waiting:
                        waiting.add(fresh)
                        queue.append(fresh)
                state = narrowed[0]
        return state

    def _instances(self, key: Key) -> Iterator[tuple[_Constraint, dict[str, str]]]:
        variable, names = key
        for number, args in self._triggers.get(variable, ()):
            constraint = self._constraints[number]
            env = _bound(args, names, constraint.bound)
            if env is None:
                continue
            free = [ref for ref in constraint.bound if ref.name not in env]
            for combination in product(*(self.world.names[ref.of.name] for ref in free)):
                yield constraint, {**env, **{ref.name: n for ref, n in zip(free, combination, strict=True)}}


def _bound(args: tuple[str, ...], names: tuple[str, ...], bound: tuple[Ref, ...]) -> dict[str, str] | None:
    """The quantified variables that a changed cell's arguments decide; ``None`` where they contradict."""
    quantified = {ref.name for ref in bound}
    env: dict[str, str] = {}
    for arg, name in zip(args, names, strict=True):
        if arg in quantified and env.setdefault(arg, name) != name:
            return None
    return env


def _differences(before: Partial, after: Partial) -> list[Key]:
    return [
        key
        for key, value in after.cells.items()
        if before.cells.get(key) != value and not key[0].startswith("$")
    ]


def _is_universal(formula: Expr) -> TypeGuard[Quantified]:
    return isinstance(formula, Quantified) and formula.universal


def _conjuncts(formula: Expr) -> Iterator[Expr]:
    """The conjuncts of a formula, also those under a universal quantifier."""
    if isinstance(formula, ex.And):
        for part in formula.parts:
            yield from _conjuncts(part)
    elif _is_universal(formula) and isinstance(formula.body, ex.And):
        for part in formula.body.parts:
            yield from _conjuncts(ex.quantified(True, formula.bound, part))
    else:
        yield formula

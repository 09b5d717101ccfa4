"""Rows prepared for beliefs: their conditions and updates as closures, and the cells that they touch.

Preparing is done once a row; taking a row is the hot path.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mmsverify.concrete.belief.comparison import Narrowing
from mmsverify.concrete.belief.narrow import narrowing
from mmsverify.concrete.belief.partial import OTHER, Partial
from mmsverify.concrete.belief.patterns import Pattern, patterns
from mmsverify.concrete.belief.truth import Env, Truth, Value, truth, value
from mmsverify.concrete.belief.values import NO
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Ref
from mmsverify.model.rows import Row
from mmsverify.model.sorts import ElementSort


@dataclass(frozen=True, slots=True)
class CompiledAssign:
    """One update: bound names and their sorts, the condition, the target's arguments, the new value.

    ``made`` and ``spared`` narrow a state to where the condition holds, and to where it does not.
    """

    variable: str
    args: tuple[str, ...]
    bound: tuple[str, ...]
    sorts: tuple[Any, ...]
    where: Truth
    value: Value
    made: Narrowing
    spared: Narrowing


@dataclass(frozen=True, slots=True)
class CompiledRow:
    """A row's guard as truth tests and as narrowings, its updates, and the cells in its expressions.

    ``conditions`` are the cells that each conjunct reads, ``takes`` those that the updates read. ``chosen``
    are the elements that the responder chooses and no event shows.
    """

    row: Row
    tests: tuple[Truth, ...]
    guard: tuple[Narrowing, ...]
    assigns: tuple[CompiledAssign, ...]
    conditions: tuple[tuple[Pattern, ...], ...]
    takes: tuple[Pattern, ...]
    writes: tuple[Pattern, ...]
    chosen: tuple[Ref, ...]

    def impossible(self, state: Partial, env: Env) -> bool:
        """Whether a condition of the guard certainly fails, whatever is chosen."""
        return all(self.refuses(state, each) for each in self.instances(state, env))

    def refuses(self, state: Partial, env: Env) -> bool:
        """Whether a condition of the guard certainly fails in an environment with all choices made."""
        return any(test(state, env) == NO for test in self.tests)

    def instances(self, state: Partial, env: Env) -> Iterator[Env]:
        """The environment with every choice of elements; ``OTHER`` stands for one unseen name."""
        if not self.chosen:
            yield env
            return
        for names in state.world.combinations([ref.of for ref in self.chosen]):
            yield {**env, **dict(zip((ref.name for ref in self.chosen), names, strict=True))}

    def chooses_unseen(self, env: Env) -> bool:
        """Whether one of the choices is an unseen name: what is known of all of them need not be its own."""
        return any(env[ref.name] == OTHER for ref in self.chosen)


_COMPILED: dict[int, CompiledRow] = {}


def compiled(row: Row) -> CompiledRow:
    """The row, prepared; by identity, for to hash a row is to walk all its expressions."""
    found = _COMPILED.get(id(row))
    if found is None or found.row is not row:
        found = _COMPILED[id(row)] = _compile(row)
    return found


def _compile(row: Row) -> CompiledRow:
    conditions = [conjunct.condition for conjunct in row.guard]
    taken = {p for a in row.assigns for p in _reads(a)}
    written = [(a.variable, tuple(arg.name for arg in a.args if isinstance(arg, Ref))) for a in row.assigns]
    return CompiledRow(
        row=row,
        tests=tuple(map(truth, conditions)),
        guard=tuple(narrowing(c, True) for c in conditions),
        assigns=tuple(map(_assign, row.assigns)),
        conditions=tuple(tuple(patterns(c)) for c in conditions),
        takes=tuple(sorted(taken, key=str)),
        writes=tuple(sorted(set(written), key=str)),
        chosen=tuple(c for c in row.choices if isinstance(c, Ref) and isinstance(c.of, ElementSort)),
    )


def _assign(assign: Assign) -> CompiledAssign:
    return CompiledAssign(
        assign.variable,
        tuple(arg.name for arg in assign.args if isinstance(arg, Ref)),
        tuple(ref.name for ref in assign.bound),
        tuple(ref.of for ref in assign.bound),
        truth(assign.where),
        value(assign.value),
        narrowing(assign.where, True),
        narrowing(assign.where, False),
    )


def _reads(assign: Assign) -> Iterator[Pattern]:
    yield from patterns(assign.where)
    yield from patterns(assign.value)

"""Taking a row in a partial state: assume its conjuncts one by one, then make its updates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import reduce
from itertools import product
from math import prod

from mmsverify.concrete.belief.compiled import CompiledAssign, compiled
from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.partial import MARKS, Fact, Key, Partial
from mmsverify.concrete.belief.patterns import touches
from mmsverify.concrete.belief.truth import ABSENT, Env
from mmsverify.concrete.belief.values import NO, YES, Known, join, within
from mmsverify.model.rows import Clause, Conjunct, Row

LARGEST_TABLE = 128


@dataclass(frozen=True, slots=True)
class Refusal:
    """How far a row got in a state: the conjunct that refused, how many held before, and the invariant."""

    row: Row
    state: Partial
    conjunct: Conjunct
    passed: int
    invariant: Clause = field(default_factory=lambda: Clause(()))


def satisfy(
    row: Row, state: Partial, env: Env, constraints: Constraints
) -> tuple[list[Partial], list[Refusal]]:
    """The states in which the row's guard holds; if none is left, the refusals at the furthest conjunct."""
    states, refusals = [state], []
    for passed, (conjunct, assume) in enumerate(zip(row.guard, compiled(row).guard, strict=True)):
        left: list[Partial] = []
        for before in states:
            for narrowed in assume(before, env, True):
                settled = settle(before, narrowed, constraints)
                if isinstance(settled, Conflict):
                    refusals.append(Refusal(row, before, conjunct, passed, settled.clause))
                else:
                    left.append(settled)
        if not left:
            return [], [r for r in refusals if r.passed == passed] or [
                Refusal(row, s, conjunct, passed) for s in states[:8]
            ]
        states = left
    return states, []


def changed(before: Partial, after: Partial) -> list[Key]:
    """The cells in which the states differ, free choices apart."""
    old = before.cells
    return [k for k, v in after.cells.items() if old.get(k) is not v and old.get(k) != v and k[0][0] != "$"]


def settle(before: Partial, after: Partial, constraints: Constraints) -> Partial | Conflict:
    """The state after a change, with what the invariants conclude from the cells that changed."""
    return after if after is before else constraints.after(after, changed(before, after))


def take(row: Row, state: Partial, env: Env, constraints: Constraints) -> tuple[list[Partial], list[Refusal]]:
    """The states after the row, without what was found out about its free choices; or why there are none."""
    done: list[Partial] = []
    refusals: list[Refusal] = []
    for each in compiled(row).instances(state, env):
        ready, refused = _ready(row, state, each, constraints)
        refusals += refused
        for before in ready:
            after = settle(before, _plain(update(row, before, each)), constraints)
            if not isinstance(after, Conflict):
                done.append(after)
    return done, refusals


def _ready(
    row: Row, state: Partial, env: Env, constraints: Constraints
) -> tuple[list[Partial], list[Refusal]]:
    """The states in which the row can be taken; an unseen name that is chosen narrows nothing."""
    if not compiled(row).chooses_unseen(env):
        return satisfy(row, state, env, constraints)
    return ([], []) if compiled(row).refuses(state, env) else ([state], [])


def possible(row: Row, state: Partial, env: Env) -> bool:
    """Whether no single condition of the row's guard certainly fails: a quick test before taking it."""
    return not compiled(row).impossible(state, env)


def idle(row: Row, state: Partial, env: Env) -> bool:
    """Whether the row certainly leads to no state that ``state`` does not allow already."""
    return all(within(known, state.get(key)) for key, known in _written(row, state, env).items())


def maybe(row: Row, state: Partial, env: Env, constraints: Constraints) -> Partial:
    """The state after the row, or as it is: it is not told whether the row was taken."""
    if not idle(row, state, env):
        for after in take(row, state, env, constraints)[0]:
            state = state if state.covers(after) else state.joined(after)
    return state


def _plain(state: Partial) -> Partial:
    choices = [key for key in state.cells if key[0][0] == "$" and key[0] not in MARKS]
    return state.without(choices) if choices else state


def update(row: Row, state: Partial, env: Env) -> Partial:
    """The state with the row's assignments made in order, all reading the state before.

    One that may or may not be made keeps the old value possible.
    """
    cells = _written(row, state, env)
    if not cells:
        return state
    stale = {
        key
        for key in state.facts()
        if not _still_true(state.world.facts[int(key[1][0])], row, state, env, cells)
    }
    kept = {key: known for key, known in state.cells.items() if key not in stale} if stale else state.cells
    return Partial(state.world, {**kept, **cells})


def _written(row: Row, state: Partial, env: Env) -> dict[Key, Known]:
    cells: dict[Key, Known] = {}
    for assign in compiled(row).assigns:
        if not assign.bound:
            _assign(assign, state, env, cells)
            continue
        inner = dict(env)
        for combination in state.world.combinations(assign.sorts):
            inner.update(zip(assign.bound, combination, strict=True))
            _assign(assign, state, inner, cells)
    return cells


def _still_true(fact: Fact, row: Row, state: Partial, env: Env, written: Mapping[Key, Known]) -> bool:
    """Whether a fact about unseen names survives the row.

    It does if it reads nothing that is written, or if the row keeps it in any state.
    """
    if not touches(fact.cells, written):
        return True
    key = (id(fact), row.id, frozenset(env.items()))
    if key not in state.world.survives:
        state.world.survives[key] = _survives(fact, row, Partial(state.world, {}), env)
    return state.world.survives[key]


def _survives(fact: Fact, row: Row, blank: Partial, env: Env) -> bool:
    """Whether the row keeps the fact for all values of its cells, whatever the rest of the state."""
    keys: list[Key] = [
        (variable, tuple(name for name in names if name is not None))
        for variable, names in sorted(fact.cells, key=str)
        if None not in names
    ]
    ranges = [_singles(blank.get(key)) for key in keys]
    if len(keys) < len(fact.cells) or prod(map(len, ranges)) not in range(1, LARGEST_TABLE):
        return False
    return all(
        _kept(fact, row, blank, env, dict(zip(keys, values, strict=True))) for values in product(*ranges)
    )


def _kept(fact: Fact, row: Row, blank: Partial, env: Env, values: Mapping[Key, Known]) -> bool:
    before = Partial(blank.world, values)
    if not fact.holds(before, fact.env) & fact.wanted:
        return True
    return fact.holds(Partial(blank.world, {**values, **_written(row, before, env)}), fact.env) == fact.wanted


def _singles(known: Known) -> list[Known]:
    """The values of a small known set, one by one; none of an interval."""
    if isinstance(known, int):
        return [mask for mask in (NO, YES) if known & mask]
    return [frozenset([value]) for value in sorted(known, key=str)] if isinstance(known, frozenset) else []


def _assign(assign: CompiledAssign, state: Partial, env: Env, cells: dict[Key, Known]) -> None:
    holds = assign.where(state, env)
    if holds == NO:
        return
    args = tuple([env.get(name, ABSENT) for name in assign.args])
    if ABSENT in args:
        return
    key = (assign.variable, args)
    if holds == YES:
        cells[key] = assign.value(state, env)
        return
    # The condition may speak of the cell itself: the new value belongs to where it holds, the old one
    # to where it does not.
    values = [assign.value(met, env) for met in assign.made(state, env, False)]
    values += [cells.get(key, spared.get(key)) for spared in assign.spared(state, env, False)]
    cells[key] = reduce(join, values or [state.get(key)])

"""Taking a row in a partial state: assume its conjuncts one by one, then make its updates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.narrow import narrowing
from mmsverify.concrete.belief.partial import Key, Partial
from mmsverify.concrete.belief.truth import ABSENT, Env, truth, value
from mmsverify.concrete.belief.values import NO, YES, Known, join
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Ref
from mmsverify.model.rows import Clause, Conjunct, Row


@dataclass(frozen=True, slots=True)
class Refusal:
    """How far a row got in a state: the conjunct that refused, how many held before it, what else it rests on."""

    row: Row
    state: Partial
    conjunct: Conjunct
    passed: int
    invariant: Clause = field(default_factory=lambda: Clause(()))


def satisfy(
    guard: Sequence[Conjunct], state: Partial, env: Env, constraints: Constraints, row: Row
) -> tuple[list[Partial], list[Refusal]]:
    """The states in which all conjuncts hold; where none is left, the refusals at the furthest conjunct reached."""
    states, refusals = [state], []
    for passed, conjunct in enumerate(guard):
        assume = narrowing(conjunct.condition, True)
        left: list[Partial] = []
        for before in states:
            for narrowed in assume(before, env, True):
                settled = settle(before, narrowed, constraints)
                if isinstance(settled, Conflict):
                    refusals.append(Refusal(row, before, conjunct, passed, settled.clause))
                else:
                    left.append(settled)
        if not left:
            return [], [r for r in refusals if r.passed == passed] or [Refusal(row, s, conjunct, passed) for s in states[:8]]
        states = left
    return states, []


def settle(before: Partial, after: Partial, constraints: Constraints) -> Partial | Conflict:
    """The state after a change, with what the invariants conclude from the cells that changed."""
    if after is before:
        return after
    changed = [k for k, v in after.cells.items() if before.cells.get(k) != v and not k[0].startswith("$")]
    return constraints.after(after, changed)


def take(row: Row, state: Partial, env: Env, constraints: Constraints) -> tuple[list[Partial], list[Refusal]]:
    """The states after the row, without what was found out about its free choices; or why it cannot be taken."""
    ready, refusals = satisfy(row.guard, state, env, constraints, row)
    done: list[Partial] = []
    for before in ready:
        after = settle(before, _plain(update(row.assigns, before, env)), constraints)
        if not isinstance(after, Conflict):
            done.append(after)
    return done, refusals


def _plain(state: Partial) -> Partial:
    choices = [key for key in state.cells if key[0].startswith("$") and not key[0].startswith("$decided")]
    return state.without(choices) if choices else state


def update(assigns: Sequence[Assign], state: Partial, env: Env) -> Partial:
    """The state with the assignments made in order, all reading the state before; unsure ones keep the old value possible."""
    cells: dict[Key, Known] = {}
    for assign in assigns:
        sorts = [ref.of for ref in assign.bound]
        for combination in state.world.combinations(sorts):  # type: ignore[arg-type]
            _assign(assign, state, {**env, **{r.name: n for r, n in zip(assign.bound, combination, strict=True)}}, cells)
    return Partial(state.world, {**state.cells, **cells}) if cells else state


def _assign(assign: Assign, state: Partial, env: Env, cells: dict[Key, Known]) -> None:
    holds = truth(assign.where)(state, env)
    if holds == NO:
        return
    args = tuple(env.get(arg.name, ABSENT) for arg in assign.args if isinstance(arg, Ref))
    if ABSENT in args:
        return
    key = (assign.variable, args)
    new = value(assign.value)(state, env)
    old = cells.get(key)
    cells[key] = new if holds == YES else join(new, state.get(key) if old is None else old)

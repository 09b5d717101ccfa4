"""Taking a row in a partial state: assume its conjuncts one by one, then make its updates."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import reduce
from itertools import product
from math import prod

from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.partial import Fact, Key, Partial
from mmsverify.concrete.belief.ready import Ready, Write
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


def satisfy(ready: Ready, state: Partial, constraints: Constraints) -> tuple[list[Partial], list[Refusal]]:
    """The states in which the row's guard holds; if none is left, the refusals at the furthest conjunct."""
    states: list[Partial] = [state]
    refusals: list[Refusal] = []
    for passed, formula in enumerate(ready.guard):
        left: list[Partial] = []
        for before in states:
            for narrowed in formula.assume(before, True, True):
                settled = settle(before, narrowed, constraints)
                if isinstance(settled, Conflict):
                    conjunct = ready.row.guard[passed]
                    refusals.append(Refusal(ready.row, before, conjunct, passed, settled.clause))
                else:
                    left.append(settled)
        if not left:
            conjunct = ready.row.guard[passed]
            return [], [r for r in refusals if r.passed == passed] or [
                Refusal(ready.row, s, conjunct, passed) for s in states[:8]
            ]
        states = left
    return states, []


def settle(before: Partial, after: Partial, constraints: Constraints) -> Partial | Conflict:
    """The state after a change, with what the invariants conclude from the cells that changed."""
    return after if after is before else constraints.after(after, before)


def take(
    ways: Iterable[Ready], state: Partial, constraints: Constraints
) -> tuple[list[Partial], list[Refusal]]:
    """The states after the row, without what was found out about its free choices; or why there are none."""
    done: list[Partial] = []
    refusals: list[Refusal] = []
    for each in ways:
        able, refused = _able(each, state, constraints)
        refusals += refused
        for before in able:
            after = settle(before, update(each, before).without_choices(), constraints)
            if not isinstance(after, Conflict):
                done.append(after)
    return done, refusals


def _able(ready: Ready, state: Partial, constraints: Constraints) -> tuple[list[Partial], list[Refusal]]:
    """The states in which the row can be taken; of an unseen name nothing is found out."""
    if not ready.unseen:
        return satisfy(ready, state, constraints)
    return ([], []) if any(f.holds(state) == NO for f in ready.guard) else ([state], [])


def idle(ready: Ready, state: Partial) -> bool:
    """Whether the row certainly leads to no state that ``state`` does not allow already."""
    return all(within(known, state.get(key)) for key, known in _written(ready.updates, state).items())


def update(ready: Ready, state: Partial) -> Partial:
    """The state with the row's assignments made in order, all reading the state before.

    One that may or may not be made keeps the old value possible.
    """
    cells = _written(ready.updates, state)
    if not cells:
        return state
    stale = [key for key in state.facts() if not _still_true(state.world.fact_of(key), ready, state, cells)]
    return _with(state.without(stale) if stale else state, cells)


def _with(state: Partial, cells: Mapping[Key, Known]) -> Partial:
    bits, beside, places = state.bits, state.beside, state.world.places
    for key, known in cells.items():
        place = places.get(key)
        if place is not None:
            assert isinstance(known, int)
            bits = bits & ~place.bits | known << place.shift
        elif known != state.world.full[key[0]]:
            beside = {**beside, key: known}
        elif key in beside:
            beside = {k: v for k, v in beside.items() if k != key}
    return Partial(state.world, bits, beside)


def _written(updates: Iterable[Write], state: Partial) -> dict[Key, Known]:
    cells: dict[Key, Known] = {}
    for write in updates:
        holds = write.where.holds(state)
        if holds == NO:
            continue
        known = write.value.known(state) if holds == YES else _perhaps(write, state, cells)
        before = cells.get(write.key, state.get(write.key))
        cells[write.key] = join(known, before) if write.vague else known
    return cells


def _perhaps(write: Write, state: Partial, cells: Mapping[Key, Known]) -> Known:
    """The new value where the condition holds, the old one where it does not: it may speak of the cell."""
    key = write.key
    values = [write.value.known(met) for met in write.where.assume(state, True, False)]
    values += [cells.get(key, spared.get(key)) for spared in write.where.assume(state, False, False)]
    return reduce(join, values or [state.get(key)])


def _still_true(fact: Fact, ready: Ready, state: Partial, written: Mapping[Key, Known]) -> bool:
    """Whether a fact about unseen names survives the row.

    It does if it reads nothing that is written, or if the row keeps it in any state.
    """
    world, about = state.world, fact.about(fact.env)
    if not any(world.spots[key] & about.reads for key in written):
        return True
    key = (id(fact), id(ready))
    if key not in world.survives:
        world.survives[key] = _survives(fact, ready, world.blank())
    return world.survives[key]


def _survives(fact: Fact, ready: Ready, blank: Partial) -> bool:
    """Whether the row keeps the fact for all values of its cells, whatever the rest of the state."""
    about = fact.about(fact.env)
    keys = [place.key for place in blank.world.changed(about.reads)]
    ranges = [_singles(blank.get(key)) for key in keys]
    if prod(map(len, ranges)) not in range(1, LARGEST_TABLE):
        return False
    return all(_kept(fact, ready, blank, dict(zip(keys, values, strict=True))) for values in product(*ranges))


def _kept(fact: Fact, ready: Ready, blank: Partial, values: Mapping[Key, Known]) -> bool:
    before, about, wanted = _with(blank, values), fact.about(fact.env), YES if fact.want else NO
    if not about.holds(before) & wanted:
        return True
    return about.holds(_with(before, _written(ready.updates, before))) == wanted


def _singles(known: Known) -> list[Known]:
    """The values of a set, one by one; none of an interval."""
    if isinstance(known, tuple):
        return []
    return [1 << bit for bit in range(known.bit_length()) if known >> bit & 1]

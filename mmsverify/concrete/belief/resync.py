"""Starting again after a contradiction: the states that agree with what was observed, whatever was believed.

Each function errs to the larger set of states: what the contradiction leaves in doubt is no longer known.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mmsverify.concrete.belief.act import settle, take, update
from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.given import Asked
from mmsverify.concrete.belief.goal import Goal, doubts
from mmsverify.concrete.belief.partial import UNSEEN, Key, Partial
from mmsverify.concrete.belief.ready import Rows
from mmsverify.concrete.belief.several import distinct
from mmsverify.concrete.belief.values import Env
from mmsverify.model.model import ModelData
from mmsverify.model.rows import MINUS

MOST_DOUBTED = 8


def rigid(model: ModelData) -> frozenset[str]:
    """The variables that never change: no contradiction makes one doubt them."""
    return frozenset(name for name, signature in model.signatures.items() if signature.rigid)


def sight_lost(states: Sequence[Partial], constraints: Constraints) -> list[Partial]:
    """The states with nothing known of what can change."""
    lasting = rigid(constraints.world.model)
    return constraints.consistent(distinct(state.keep(lasting) for state in states))


def forced(goal: Goal, states: Sequence[Partial], constraints: Constraints) -> list[Partial]:
    """The effects of the observed answer, its guards ignored."""
    found: list[Partial] = []
    refused = bool(goal.rows) and goal.rows[0].answer == MINUS
    for way in (way for ways in (goal.ways[:1] if refused else goal.ways) for way in ways):
        for state in states:
            after = update(way, state).without_choices()
            settled = settle(state, after, constraints)
            found.append(
                _without_names(after, goal.env, constraints) if isinstance(settled, Conflict) else settled
            )
    return found


def as_if_refused(last: Asked, made: Rows, constraints: Constraints) -> list[Partial]:
    """What holds if a request was refused, in the states in which it certainly had to be when it came."""
    rows = [row for row in last.request.rows if row.answer == MINUS]
    refusing = Goal(rows, last.request.env, made).ways
    certain = [(w, s) for w in refusing for states in last.earlier for s in states if doubts(w, s) is None]
    return [after for ways, state in certain for after in take(ways, state, constraints)[0]]


def _without_names(state: Partial, env: Env, constraints: Constraints) -> Partial:
    """The state with nothing known of the names in the event, and of what belongs to no name."""
    names = set(_names(env))
    lasting = rigid(state.world.model)

    def doubted(key: Key) -> bool:
        return key[0] not in lasting and (not key[1] or bool(names.intersection(key[1])) or key[0] == UNSEEN)

    found = constraints.everywhere(state.forget_cells(doubted))
    return state.forget(frozenset(state.world.full) - lasting) if isinstance(found, Conflict) else found


def _names(env: Env) -> Iterator[str]:
    for given in env.values():
        if isinstance(given, str):
            yield given
        elif isinstance(given, frozenset):
            yield from given


def learned_anew(goal: Goal, states: Sequence[Partial], constraints: Constraints) -> list[Partial]:
    """The states if a message that contradicts them is true: what it reads is forgotten, then learned.

    What else was believed of the names in it is forgotten, too: the same message may show that next.
    """
    learned: list[Partial] = []
    names = set(_names(goal.env))
    doubted = frozenset[str]().union(*(row.reads for row in goal.rows)) - rigid(constraints.world.model)
    for state in states[:MOST_DOUBTED]:
        blank = constraints.everywhere(_forgotten(state.forget(doubted), names))
        if not isinstance(blank, Conflict):
            learned += [after for ways in goal.ways for after in take(ways, blank, constraints)[0]]
    return learned


def _forgotten(state: Partial, names: set[str]) -> Partial:
    """The state with nothing known of these names but what never changes."""
    lasting = rigid(state.world.model)

    def doubted(key: Key) -> bool:
        about = state.world.fact_of(key).env.values() if key[0] == UNSEEN else key[1]
        return key[0] not in lasting and any(name in names for name in about if isinstance(name, str))

    return state.forget_cells(doubted)

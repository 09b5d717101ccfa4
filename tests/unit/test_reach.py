"""What is new first: far runs are found, each is a run, and no more than that is said."""

from __future__ import annotations

from dataclasses import replace

import pytest
from small_models import Lamps

from mmsverify.concrete import Machine, Scope, SearchResult, generic_scope, reach, replay, search
from mmsverify.concrete.reach import NEW_PAIR, NEW_VALUE, NOTHING_NEW, Novelty
from mmsverify.model import (
    Each,
    Initially,
    Model,
    Relation,
    Sometimes,
    Transition,
    Variable,
    assemble,
    for_all,
    for_some,
    integer,
    internal,
)


class Desk(Model, name="desk"):
    """Switches that anybody flips at any time, each with a mark of its own; beside them, a long way to go."""

    S = Each("Switch")
    (s,) = S.elements("s")
    mark = Variable(integer(0), S, rigid=True)
    on = Relation(S)
    stage = Variable(integer(0, 9))

    flip = Transition("D-1", on=internal("flip", s), then=[on[s].becomes(~on[s])])
    go = Transition(
        "D-2",
        on=internal("go"),
        when=[stage() < 9, for_all(s)(~on[s])],
        then=[stage().becomes(stage() + 1)],
    )

    off_at_first = Initially("D-0", for_all(s)(~on[s]) & (stage() == 0))
    ends = Sometimes("D-5", (stage() == 9) & for_some(s)(on[s]))
    turns_back = Sometimes("D-6", stage().next < stage())


DESK = assemble(Desk)
ENDS, TURNS_BACK = DESK.claims
NAMES = tuple(f"s{i}" for i in range(14))
FOURTEEN = Scope(
    {"S": NAMES}, {("mark", (name,)): i for i, name in enumerate(NAMES)}, int_bounds=(0, len(NAMES))
)


def looked(**limits: int) -> SearchResult:
    return reach(Machine(DESK, FOURTEEN), [ENDS], **{"max_states": 10_000, **limits})


def test_a_run_is_found_among_more_states_than_may_be_seen() -> None:
    assert looked().witnesses.keys() == {"ends"}
    assert not search(DESK, FOURTEEN, claims=[ENDS], max_states=10_000).witnesses


def test_what_is_found_is_a_run() -> None:
    path = looked().witnesses["ends"]
    assert len(path) == 11
    replay(DESK, FOURTEEN, path, ENDS)


def test_it_finds_no_run_longer_than_the_limit() -> None:
    assert looked(max_depth=10).witnesses
    assert not looked(max_depth=9).witnesses


def test_it_ends_at_the_limit_of_states_and_says_so() -> None:
    assert looked(max_states=20).reason == "the limit of 20 states"


def test_where_nothing_new_is_left_it_does_not_say_that_everything_was_seen() -> None:
    result = reach(Machine(DESK, FOURTEEN), [TURNS_BACK], max_states=10_000)
    assert (result.exhausted, result.reason) == (False, "states that show nothing new")


def test_a_state_is_new_by_a_value_then_by_a_pair_of_values() -> None:
    layout = Machine(DESK, Scope({"S": ("s0", "s1")}, {})).layout
    novelty = Novelty(layout, [])

    def state(*codes: int) -> bytes | tuple[int, ...]:
        held = dict.fromkeys(layout.keys, 0)
        held |= {("on", ("s0",)): codes[0], ("on", ("s1",)): codes[1]}
        return layout.pack(held[key] for key in layout.keys)

    assert novelty.rank(state(0, 0), None) == NEW_VALUE
    assert novelty.rank(state(1, 0), state(0, 0)) == NEW_VALUE
    assert novelty.rank(state(0, 1), state(0, 0)) == NEW_VALUE
    assert novelty.rank(state(1, 1), state(0, 1)) == NEW_PAIR
    assert novelty.rank(state(1, 1), state(1, 0)) == NOTHING_NEW


def test_what_was_seen_in_one_view_is_new_in_another() -> None:
    layout = Machine(DESK, Scope({"S": ("s0",)}, {})).layout
    stage = layout.position["stage", ()]
    novelty = Novelty(layout, [lambda state: state[stage]])
    first = layout.pack(0 for _ in layout.keys)
    later = layout.pack(int(i == stage) for i in range(len(layout.keys)))
    assert novelty.rank(first, None) == NEW_VALUE
    assert novelty.rank(later, first) == NEW_VALUE
    assert novelty.rank(first, later) == NOTHING_NEW


@pytest.mark.parametrize(("largest", "sets"), [(None, 8), (1, 4), (0, 1)])
def test_a_scope_may_bound_the_sets_that_a_parameter_takes(largest: int | None, sets: int) -> None:
    model = assemble(Lamps)
    scope = replace(generic_scope(model, {"L": 3}), largest_set=largest)
    (lamp,) = model.sorts.values()
    assert len(list(scope.subsets(lamp))) == sets

"""Beliefs about a small machine: what each kind of event teaches, what is blamed, and how it goes on."""

from __future__ import annotations

from typing import Any

import pytest

from mmsverify.concrete.belief import Belief
from mmsverify.concrete.belief.partial import OTHER
from mmsverify.concrete.belief.values import plain
from mmsverify.model import (
    BOOL,
    Always,
    Each,
    Enumeration,
    Model,
    ModelData,
    Observation,
    Procedure,
    Relation,
    Transition,
    Variable,
    accept,
    assemble,
    do,
    for_all,
    indication,
    internal,
    needs,
    parameter,
    refuse,
    response,
    shown,
)
from mmsverify.model.rows import MINUS, PLUS


class Phase(Enumeration):
    """The phases of a machine."""

    OFF = "OFF"
    STARTING = "STARTING"
    ON = "ON"


class Machines(Model, name="machines", standard="X"):
    """Machines are switched on, one at most has the key; they go off by themselves."""

    machine = Each("Machine")
    phase = Variable(Phase, machine)
    key = Relation(machine)
    warm = Relation(machine)
    m, n = machine.elements("m n")
    yes = parameter("yes", BOOL)
    seen = parameter("seen", Phase)

    one_key = Always("X-KEY", for_all(m, n)((key[m] & key[n]) >> (m == n)))

    asked = Transition(
        "X-1",
        on=indication("switch", m),
        when=[phase[m] == Phase.OFF],
        then=[phase[m].becomes(Phase.STARTING)],
    )
    switch = Procedure(
        "X-2",
        on=response("switch", m),
        on_refusal=[phase[m].becomes(Phase.OFF).when(phase[m] == Phase.STARTING)],
        steps=[
            refuse("a", unless=phase[m] == Phase.STARTING, rule="switch.not-off", says="{m} is not off"),
            refuse("b", unless=key[m], rule="switch.no-key", level="warning", says="{m} has no key"),
            do("c", phase[m].becomes(Phase.ON)),
            accept("c"),
        ],
    )
    turn = Procedure(
        "X-3", on=response("turn", m), steps=[do("a", key[n].becomes(n == m).over(n)), accept("a")]
    )
    goes_off = Transition(
        "X-4", on=internal("goes_off", m), when=[phase[m] == Phase.ON], then=[phase[m].becomes(Phase.OFF)]
    )
    cools = Transition(
        "X-5", on=internal("cools", m), when=[warm[m]], then=[warm[m].becomes(False)], observation_only=True
    )
    touch = Procedure(
        "X-8",
        on=response("touch", m),
        steps=[refuse("a", when=warm[m], rule="touch.warm", says="hot"), accept("b")],
    )
    look = Observation(
        "X-6",
        on=shown("look", m, seen),
        shows=[needs("X-6", rule="look.phase", that=phase[m] == seen, says="not {seen}")],
    )
    who = Observation("X-7", on=shown("who", m, yes), shows=[needs("X-7", rule="who", that=key[m] == yes)])
    heat = Observation(
        "X-9", on=shown("heat", m, yes), shows=[needs("X-9", rule="heat", that=warm[m] == yes)]
    )


@pytest.fixture(scope="module")
def model() -> ModelData:
    return assemble(Machines)


@pytest.fixture
def belief(model: ModelData) -> Belief:
    return Belief(model, invariants=model.always)


def rule(outcome: Any) -> str | None:
    return outcome.blame.rule if outcome.blame else None


def switch(belief: Belief, name: str, answer: str) -> str | None:
    belief.indicate("r", "switch", {"m": name})
    return rule(belief.respond("r", "switch", {"m": name}, answer))


def phases(belief: Belief, name: str) -> set[str]:
    key = "phase", (name if name in belief.world.names["Machine"] else OTHER,)
    of = belief.model.signatures["phase"].of
    return {str(word) for state in belief.states for word in plain(state.get(key), of)}


def test_at_first_everything_is_possible(belief: Belief) -> None:
    assert switch(belief, "A", PLUS) is None
    assert switch(belief, "B", MINUS) is None


def test_an_answer_tells_what_must_have_held(belief: Belief) -> None:
    switch(belief, "A", PLUS)
    assert phases(belief, "A") == {"ON"}
    assert rule(belief.show("who", {"m": "A", "yes": False})) == "who"


def test_an_invariant_tells_of_others(belief: Belief) -> None:
    belief.show("who", {"m": "A", "yes": True})
    assert rule(belief.show("who", {"m": "B", "yes": True})) == "who"


def test_a_name_that_is_seen_late_obeys_what_was_known_of_all(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "A"}, PLUS)
    assert rule(belief.show("who", {"m": "LATE", "yes": True})) == "who"


def test_a_service_that_nothing_allows_is_blamed_with_the_condition(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "B"}, PLUS)
    belief.show("look", {"m": "A", "seen": "OFF"})
    belief.indicate("r", "switch", {"m": "A"})
    found = belief.respond("r", "switch", {"m": "A"}, PLUS).blame
    assert found is not None
    assert (found.rule, found.level, found.says) == ("switch.no-key", "warning", "A has no key")
    assert found.clause.ids == ("X-2-b",)
    assert found.expected == (MINUS,)


def test_after_a_blame_the_effects_may_have_happened_or_not(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "B"}, PLUS)
    belief.show("look", {"m": "A", "seen": "OFF"})
    switch(belief, "A", PLUS)
    assert rule(belief.show("look", {"m": "A", "seen": "ON"})) is None
    assert phases(belief, "A") == {"ON"}


def test_a_refusal_without_reason_is_a_warning(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "A"}, PLUS)
    belief.show("look", {"m": "A", "seen": "OFF"})
    assert switch(belief, "A", MINUS) == "switch.refused"


def test_a_refusal_for_a_local_reason_needs_no_other(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "A"}, PLUS)
    belief.show("look", {"m": "A", "seen": "OFF"})
    belief.indicate("r", "switch", {"m": "A"})
    assert rule(belief.respond("r", "switch", {"m": "A"}, MINUS, local=True)) is None
    assert phases(belief, "A") == {"OFF"}


def test_what_happens_unseen_explains_an_answer(belief: Belief) -> None:
    switch(belief, "A", PLUS)
    assert switch(belief, "A", PLUS) is None


def test_what_explains_observations_only_explains_no_answer(belief: Belief) -> None:
    belief.show("heat", {"m": "A", "yes": True})
    assert rule(belief.respond("r", "touch", {"m": "A"}, PLUS)) == "touch.warm"


def test_what_explains_observations_only_explains_an_observation(belief: Belief) -> None:
    belief.show("heat", {"m": "A", "yes": True})
    assert rule(belief.show("heat", {"m": "A", "yes": False})) is None
    assert rule(belief.show("heat", {"m": "A", "yes": True})) == "heat"


def test_a_lie_is_told_and_the_truth_is_still_known(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "A"}, PLUS)
    assert rule(belief.show("who", {"m": "A", "yes": False})) == "who"
    assert rule(belief.show("who", {"m": "A", "yes": True})) is None


def test_an_observation_may_show_any_instant_since_it_was_asked_for(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "B"}, PLUS)
    belief.watch("w")
    belief.respond("r", "turn", {"m": "A"}, PLUS)
    assert rule(belief.show("who", {"m": "A", "yes": False}, "w")) is None
    assert rule(belief.show("who", {"m": "A", "yes": True})) is None


def test_a_request_may_be_performed_before_its_answer_is_seen(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "B"}, PLUS)
    belief.indicate("slow", "turn", {"m": "A"})
    assert rule(belief.show("who", {"m": "A", "yes": True})) is None
    assert rule(belief.respond("slow", "turn", {"m": "A"}, PLUS)) is None
    assert rule(belief.show("who", {"m": "B", "yes": True})) == "who"


def test_requests_may_be_performed_in_either_order(belief: Belief) -> None:
    belief.indicate("r1", "turn", {"m": "A"})
    belief.indicate("r2", "turn", {"m": "B"})
    belief.respond("r2", "turn", {"m": "B"}, PLUS)
    belief.respond("r1", "turn", {"m": "A"}, PLUS)
    assert rule(belief.show("who", {"m": "B", "yes": True})) is None


def test_a_request_that_is_lost_may_have_been_performed(belief: Belief) -> None:
    for shown_key in (True, False):
        belief.respond("r", "turn", {"m": "B"}, PLUS)
        belief.indicate("lost", "turn", {"m": "A"})
        belief.drop("lost")
        assert rule(belief.show("who", {"m": "A", "yes": shown_key})) is None


def test_out_of_sight_everything_may_change(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "B"}, PLUS)
    belief.lose_sight()
    assert rule(belief.show("who", {"m": "A", "yes": True})) is None


def test_facts_are_known_from_the_start(model: ModelData) -> None:
    belief = Belief(model, {("phase", ("A",)): Phase.ON})
    assert phases(belief, "A") == {"ON"}


def test_the_state_before_a_violation_is_told_in_words(belief: Belief) -> None:
    belief.respond("r", "turn", {"m": "B"}, PLUS)
    belief.show("look", {"m": "A", "seen": "OFF"})
    belief.indicate("r", "switch", {"m": "A"})
    found = belief.respond("r", "switch", {"m": "A"}, PLUS).blame
    assert found is not None
    assert found.before == {"phase[A]": "STARTING"}

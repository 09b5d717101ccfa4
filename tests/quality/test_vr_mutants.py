"""The claims about the VR framework have teeth: nearly every rule or claim written otherwise is noticed.

The whole is measured by ``bench/mutants.py``, which writes docs/mutation-vr.md.
"""

from __future__ import annotations

import pytest
from mutation import CHANGED, DROPPED, LOST, NEGATED, Mutant
from mutation_fate import CHECK, EQUAL
from small_score import LEAST, Small, SmallScore, repaired, the_mutant
from vr_shelf import TASKS, TEMPLATE, recordings, telling

MODELS = (TEMPLATE, TASKS)


@pytest.fixture(scope="module")
def scores() -> dict[str, SmallScore]:
    return {small.name: SmallScore(small) for small in MODELS}


@pytest.mark.parametrize(
    ("model", "place", "kind", "claim"),
    [
        (TEMPLATE, "org: org.unhomed", NEGATED, "goes_to_origin_on_command"),
        (TEMPLATE, "resume: resume.not-paused", DROPPED, "only_a_held_flow_goes_on"),
        (TEMPLATE, "pause: paused", LOST, "pause_holds"),
        (TEMPLATE, "set_pre_mode: status, mode = Stop", CHANGED, "tells_halt"),
        (TEMPLATE, "home_ends: arrived", LOST, "goes_on_to_origin"),
        (TEMPLATE, "reset_error: mode, (mode = ErrS) and homed", LOST, "reset_of_general_error"),
        (TASKS, "acts: control02", LOST, "action_comes_next"),
        (TASKS, "refuses: command", LOST, "refused_is_cleared"),
        (TASKS, "inputs: axis", CHANGED, "emergency"),
    ],
)
def test_a_changed_rule_breaks_the_claim_that_speaks_of_it(
    scores: dict[str, SmallScore], model: Small, place: str, kind: str, claim: str
) -> None:
    assert scores[model.name].of_rows(the_mutant(model.name, place, kind)) == (CHECK, claim)


@pytest.mark.parametrize("model", MODELS, ids=lambda small: str(small.name))
def test_rules_that_are_not_changed_are_equal(scores: dict[str, SmallScore], model: Small) -> None:
    unchanged = Mutant("", "", "", dict(enumerate(repaired(model.name).rows)))
    assert scores[model.name].of_rows(unchanged) == (EQUAL, "")


def test_a_condition_that_another_one_implies_is_equal(scores: dict[str, SmallScore]) -> None:
    implied = the_mutant(TEMPLATE.name, "home: home.while-running", DROPPED)
    assert scores[TEMPLATE.name].of_rows(implied) == (EQUAL, "")


def test_which_of_two_ways_leads_into_a_mode_is_not_to_be_seen(scores: dict[str, SmallScore]) -> None:
    swapped = the_mutant(TEMPLATE.name, "stop: mode", CHANGED)
    assert scores[TEMPLATE.name].of_rows(swapped) == (EQUAL, "")


@pytest.mark.parametrize(
    ("place", "kind"),
    [
        ("home: mode", LOST),
        ("org: org.unhomed", NEGATED),
        ("stop_ends: mode", CHANGED),
        ("set_pre_mode: status, mode = ErrB", CHANGED),
    ],
)
def test_a_recording_written_by_hand_tells_a_changed_rule(place: str, kind: str) -> None:
    assert telling(the_mutant(TEMPLATE.name, place, kind).applied(repaired(TEMPLATE.name)))


def test_no_recording_tells_the_model_from_itself() -> None:
    assert telling(repaired(TEMPLATE.name)) == ""
    assert len({recording.name for recording in recordings()}) == len(recordings()) > 200


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS, ids=lambda small: str(small.name))
def test_nearly_every_mutant_is_noticed_today(scores: dict[str, SmallScore], model: Small) -> None:
    share, alive = scores[model.name].noticed()
    assert share >= LEAST, alive

"""The claims about the VR framework have teeth: nearly every rule or claim written otherwise is noticed.

The whole is measured by ``bench/mutants.py``, which writes docs/mutation-vr.md.
"""

from __future__ import annotations

from collections import Counter

import pytest
from mutation import CHANGED, DROPPED, LOST, NEGATED, Mutant, mutants
from mutation_fate import AUDIT, CHECK, EQUAL, OPEN, key
from mutation_subjects import DOCS, VR_TABLES, vr_text
from mutation_table import read
from vr_by_hand import UNASKED, lawful
from vr_runs import KINDS, Sampling
from vr_score import TASKS, TEMPLATE, VrScore, numbered_mutants, repaired
from vr_shelf import recordings, telling
from vr_story import findings, marked

MODELS = (TEMPLATE, TASKS)
RENEW = "write it anew: python bench/mutants.py --model vr-template vr-tasks --write"
STALE = 0.05
"""So many of today's mutants may be missing: a rule or a claim may be added without measuring all anew."""
LEAST = 0.95
"""Of the mutants that are not equal, this share is killed."""


def a_mutant(name: str, place: str, kind: str) -> Mutant:
    made = mutants(repaired(name), entries=True)
    return next(m for m in made if (m.place, m.kind) == (place, kind))


@pytest.fixture(scope="module")
def scores() -> dict[str, VrScore]:
    return {name: VrScore(name) for name in MODELS}


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
    scores: dict[str, VrScore], model: str, place: str, kind: str, claim: str
) -> None:
    assert scores[model].of_rows(a_mutant(model, place, kind)) == (CHECK, claim)


@pytest.mark.parametrize("name", MODELS)
def test_rules_that_are_not_changed_are_equal(scores: dict[str, VrScore], name: str) -> None:
    unchanged = Mutant("", "", "", dict(enumerate(repaired(name).rows)))
    assert scores[name].of_rows(unchanged) == (EQUAL, "")


def test_a_condition_that_another_one_implies_is_equal(scores: dict[str, VrScore]) -> None:
    implied = a_mutant(TEMPLATE, "home: home.while-running", DROPPED)
    assert scores[TEMPLATE].of_rows(implied) == (EQUAL, "")


def test_which_of_two_ways_leads_into_a_mode_is_not_to_be_seen(scores: dict[str, VrScore]) -> None:
    swapped = a_mutant(TEMPLATE, "stop: mode", CHANGED)
    assert scores[TEMPLATE].of_rows(swapped) == (EQUAL, "")


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
    assert telling(a_mutant(TEMPLATE, place, kind).applied(repaired(TEMPLATE)))


def test_no_recording_tells_the_model_from_itself() -> None:
    assert telling(repaired(TEMPLATE)) == ""
    assert len({recording.name for recording in recordings()}) == len(recordings()) > 200


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("story", lawful())
def test_a_right_run_written_by_hand_is_not_blamed(story: str, kind: Sampling) -> None:
    assert findings(story, kind) == []


@pytest.mark.parametrize("story", UNASKED.strip().splitlines())
def test_an_unasked_way_to_the_origin_is_blamed(story: str) -> None:
    assert [found.index for found in findings(story, "scan")] == marked(story)


# The page.


def test_the_page_about_mutants_is_made_from_what_became_of_them() -> None:
    assert (DOCS / "mutation-vr.md").read_text(encoding="utf-8") == vr_text(), RENEW


@pytest.mark.parametrize("name", MODELS)
def test_the_mutants_that_were_judged_are_those_of_today(name: str) -> None:
    judged = Counter((fate.what, fate.kind, fate.place) for fate in read(VR_TABLES[name]))
    today = Counter(map(key, numbered_mutants(name)))
    assert (today - judged).total() <= STALE * today.total(), RENEW


@pytest.mark.parametrize("name", MODELS)
def test_nearly_all_mutants_were_killed(name: str) -> None:
    counted = Counter(fate.fate for fate in read(VR_TABLES[name]))
    assert set(counted) <= {CHECK, AUDIT, EQUAL, OPEN}
    killed = counted[CHECK] + counted[AUDIT]
    assert killed >= LEAST * (killed + counted[OPEN])


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_nearly_every_mutant_is_noticed_today(scores: dict[str, VrScore], name: str) -> None:
    score = scores[name]
    fates = [score.fate(number) for number in range(len(score.mutants))]
    counted = Counter(fate.fate for fate in fates)
    killed = counted[CHECK] + counted[AUDIT]
    assert killed / (killed + counted[OPEN]) >= LEAST, [str(fate) for fate in fates if fate.open]

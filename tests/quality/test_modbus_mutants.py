"""The claims about a server of signals have teeth: nearly every rule or claim written otherwise is noticed.

The whole is measured by ``bench/mutants.py``, which writes docs/mutation-modbus.md.
"""

from __future__ import annotations

import pytest
from modbus_shelf import CONVERSATIONS, SIGNALS, by_hand, conversation, recordings, telling
from mutation import CHANGED, DROPPED, LOST, NEGATED, Mutant
from mutation_fate import AUDIT, CHECK, EQUAL
from small_score import LEAST, SmallScore, repaired, the_mutant

MODEL = SIGNALS.name


@pytest.fixture(scope="module")
def score() -> SmallScore:
    return SmallScore(SIGNALS)


@pytest.mark.parametrize(
    ("place", "kind", "claim"),
    [
        ("request: access.dedicated", DROPPED, "nothing_is_touched"),
        ("request: stopped", CHANGED, "never_stopped"),
        ("connects: condition 2", DROPPED, "comes_again_when_freed"),
        ("answers: condition 2", DROPPED, "upon_its_own_socket"),
        ("answers: condition 2", NEGATED, "upon_its_own_socket"),
        ("answers: condition 4", DROPPED, "answers_who_is_there"),
        ("closes: heard", LOST, "heard_are_served"),
    ],
)
def test_a_changed_rule_breaks_the_claim_that_speaks_of_it(
    score: SmallScore, place: str, kind: str, claim: str
) -> None:
    assert score.of_rows(the_mutant(MODEL, place, kind)) == (CHECK, claim)


def test_rules_that_are_not_changed_are_equal(score: SmallScore) -> None:
    assert score.of_rows(Mutant("", "", "", dict(enumerate(repaired(MODEL).rows)))) == (EQUAL, "")


def test_a_condition_that_another_one_implies_is_equal(score: SmallScore) -> None:
    assert score.of_rows(the_mutant(MODEL, "receives: condition 1", DROPPED)) == (EQUAL, "")


@pytest.mark.parametrize("kind", [DROPPED, NEGATED])
@pytest.mark.parametrize("place", ["request: request.unsound", "request: access.not-inputs"])
def test_what_no_claim_speaks_of_a_recording_tells(score: SmallScore, place: str, kind: str) -> None:
    fate, by = score.of_rows(the_mutant(MODEL, place, kind))
    assert (fate, by.rpartition(", ")[2]) == (AUDIT, "accepted")


@pytest.mark.parametrize("kind", [DROPPED, NEGATED])
@pytest.mark.parametrize("rule", ["access.beyond", "access.not-coils", "access.dedicated"])
def test_a_recording_written_by_hand_tells_a_changed_rule(rule: str, kind: str) -> None:
    assert telling(the_mutant(MODEL, f"request: {rule}", kind).applied(repaired(MODEL)))


def test_no_recording_tells_the_model_from_itself() -> None:
    assert telling(repaired(MODEL)) == ""
    assert len({recording.name for recording in recordings()}) == len(recordings()) == 70


def test_of_requests_written_by_hand_only_those_are_blamed_that_were_to_be_refused() -> None:
    made = list(by_hand())
    refused = {each.name.removesuffix(", refused") for each in made if each.name.endswith(", refused")}
    blamed = [each.name.removesuffix(", accepted") for each in made if each.found]
    assert set(blamed) == refused
    assert len(blamed) == len(refused) == 21


@pytest.mark.parametrize("seed", range(CONVERSATIONS))
def test_a_conversation_with_a_right_server_is_not_blamed(seed: int) -> None:
    assert conversation(seed).found == []


@pytest.mark.slow
def test_nearly_every_mutant_is_noticed_today(score: SmallScore) -> None:
    share, alive = score.noticed()
    assert share >= LEAST, alive

"""Every step that refuses, broken both ways: accepted where it refuses, refused where nothing is against it.

Each time the audit finds it, at the answer, with a clause of the step, and finds nothing else. What cannot be
broken, or is not told, stands in tables with the reason.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest
from robot import robot
from robot_conversations import ARM, CALIBRATION, blamed
from robot_refusals import ME, Liar, Meeting, Situation, accepting, refusing
from robot_talk import row_name
from unreachable import Reach

from mmsverify.concrete.evaluate import Moment, holds, updated
from mmsverify.model import Row
from mmsverify.results import Finding

MULTIPLE = {"predefined": [ARM, CALIBRATION], "associations": "multiple"}
PROFILES = (MULTIPLE, {**MULTIPLE, "step_limited": False}, {**MULTIPLE, "single_task": True})
SIZES = {"PI": 4, "Client": 2, "Request": 1, "Domain": 4, "Upload": 2}
ACCEPTED, REFUSED = "wrongly accepted", "wrongly refused"
STEPS = {row_name(row): row for row in refusing(robot("repaired"))}


FAST = ("stop/b result(-)", "select/b#2 result(-)", "kill/a result(-)", "load_domain/1 result(-)")
"""Steps that the fast set breaks, too."""

UNREACHABLE = {
    **{f"{name}/R-6.1.3.2.5-1 result(-)": "only at the panel, which sends no message"
       for name in ("create", "delete", "kill", "select", "start", "stop", "resume", "reset", "alter",
                    "load_domain", "delete_domain")},
    "select/i result(-)": "no reachable state",
}  # fmt: skip
"""Steps that no request can meet, as Z3 proves."""

ELSEWHERE = {
    "initiate/2 result(-)": "Initiate is no confirmed request: test_audit_recordings has the second one",
    "take_control/R-9.2.2.1-3 result(-)": "who asks without an association: test_audit_associations",
    "initiate_download/R-9.2.2.1-3 result(-)": "who asks without an association: test_audit_associations",
}
"""Steps whose condition is one of the association, which the rules of the protocol judge."""

ENDS = "a program that is RUNNING may have ended unseen"
RESTS = "the arm may have come to rest unseen (RP-07), and the service was right after that"
LOCAL = "VMD Reset may be refused for a local reason, which no message shows (step c)"
NUMBERS = "the robot numbers its uploads: it refuses one for want of numbers, which is a local reason"
NOT_TOLD = {
    ("delete/a#3 result(-)", ACCEPTED): ENDS,
    ("delete/R-7.3.3.8.1-e result(-)", ACCEPTED): RESTS,
    ("reset/R-6.3.5.8-1 result(-)", ACCEPTED): RESTS,
    **{(name, REFUSED): LOCAL for name in STEPS if name.startswith("vmd_reset/")},
    ("vmd_reset/b result(-)", ACCEPTED): ENDS,
    ("vmd_reset/c result(-)", ACCEPTED): LOCAL,
    ("initiate_upload/2#2 result(-)", REFUSED): NUMBERS,
}
"""What a robot can do wrong without the answer telling, with the reason; the list may only become shorter."""


@cache
def world(number: int) -> Meeting:
    return Meeting(robot("repaired"), PROFILES[number], SIZES)


def met(step: Row, way: str) -> Situation | None:
    """A situation for a step, in the first world that has one."""
    found = (getattr(world(number), way)(step) for number in range(len(PROFILES)))
    return next((situation for situation in found if situation is not None), None)


def broken(situation: Situation, row: Row, step: Row) -> tuple[Liar, int]:
    """The conversation in which the robot answers by the row, whatever its guard says; the answer's index.

    Where what the row does cannot be, the robot has lied: it has done what it does when the step refuses.
    """
    talk = situation.told()
    before = talk.state
    talk.break_rule(row, situation.given)
    index = len(talk.messages) - 1
    if not sound(talk):
        talk.state = updated(step, Moment(talk.scope, before, situation.given))
    talk.look_round(ME)
    return talk, index


def sound(talk: Liar) -> bool:
    """Whether the state keeps all invariants and can be shown; else a look would show more than one fault."""
    at = Moment(talk.scope, talk.state, {})
    return all(holds(claim.formula, at) for claim in talk.model.always) and all(
        map(bound_to_any(talk), talk.scope.elements["PI"])
    )


def bound_to_any(talk: Liar) -> Callable[[str], bool]:
    """Whether a program invocation, if it exists, has a domain: an answer can show none without."""

    def found(pi: str) -> bool:
        gone = str(talk.state["state", (pi,)]) == "NON-EXISTENT"
        return gone or any(talk.state["uses", (pi, d)] for d in talk.scope.elements["Domain"])

    return found


def broken_one_way(name: str, way: str, path: Path) -> tuple[Row, int, list[Finding]]:
    """The step, the index of the answer, what the audit finds."""
    step = STEPS[name]
    situation = met(step, "against" if way == ACCEPTED else "nothing_against")
    assert situation is not None, "no situation is found"
    talk, index = broken(situation, situation.row if way == ACCEPTED else step, step)
    return step, index, blamed(talk, path)


def cases() -> Iterator[object]:
    for name in STEPS:
        if name not in UNREACHABLE and name not in ELSEWHERE:
            yield pytest.param(name, id=name, marks=() if name in FAST else pytest.mark.slow)


@pytest.mark.parametrize("name", list(cases()))
def test_what_a_step_must_refuse_is_blamed_once_where_it_is_accepted(name: str, tmp_path: Path) -> None:
    step, index, found = broken_one_way(name, ACCEPTED, tmp_path / "made.mcap")
    if (name, ACCEPTED) in NOT_TOLD:
        assert len(found) <= 1
        assert not any(finding.index == index for finding in found), "it is told now: take it from NOT_TOLD"
        return
    (finding,) = found
    assert finding.index == index
    assert finding.rule == step.guard[-1].rule
    assert set(finding.clauses) & set(step.guard[-1].clause.ids)
    assert (finding.severity == "error") is (step.guard[-1].level == "error")
    assert "answered result(+), but " in finding.message


@pytest.mark.parametrize("name", list(cases()))
def test_a_refusal_against_which_nothing_stands_is_a_warning_at_the_answer(name: str, tmp_path: Path) -> None:
    step, index, found = broken_one_way(name, REFUSED, tmp_path / "made.mcap")
    if (name, REFUSED) in NOT_TOLD:
        assert len(found) <= 1
        assert not any(finding.index == index for finding in found), "it is told now: take it from NOT_TOLD"
        return
    (finding,) = found
    assert (finding.index, finding.severity) == (index, "warning")
    assert finding.rule == f"{step.on.service}.refused"
    assert set(finding.clauses) & {
        id for each in accepting(robot("repaired"), step) for id in each.clause.ids
    }
    assert "answered result(-), but nothing stands against it" in finding.message


@pytest.mark.slow
def test_the_steps_that_no_request_can_meet_are_those_that_z3_proves() -> None:
    reach = Reach(robot("repaired"))
    proved = {name: reach.refusal(step) for name, step in STEPS.items()}
    assert {name: why for name, why in proved.items() if why} == UNREACHABLE

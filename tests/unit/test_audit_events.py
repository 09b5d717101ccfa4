"""Event notifications and their causes: none without the other, where the recording leaves no doubt."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from mmsverify.audit.notifications import PATIENCE
from mmsverify.auditing import audit_traces
from mmsverify.formats.mms import bit_string
from mmsverify.results import Finding
from mmsverify.samples import pdus
from mmsverify.samples.cell import ARM, Cell
from mmsverify.samples.pdus import vmd
from mmsverify.samples.recording import Recording

Listen = Callable[[Cell], Sequence[Finding]]
READY, EXECUTING, PAUSED = "robot-ready", "robot-executing", "robot-motion-paused"


@pytest.fixture
def listen(tmp_path: Path) -> Listen:
    def audited(made: Cell) -> Sequence[Finding]:
        path = tmp_path / "made.mcap"
        made.recording.write(path)
        return audit_traces([path], profile=None, model=None).findings

    return audited


def rules(findings: Sequence[Finding]) -> list[tuple[int | None, str]]:
    return [(finding.index, finding.rule) for finding in findings]


def ready() -> Cell:
    """A robot with a task program that is selected with the arm's."""
    made = Cell(Recording("cell"))
    made.begin()
    made.status("robot-idle")
    made.arm("idle")
    made.download("TASK", [b"JOB"])
    made.create("TASK")
    made.select("TASK", ARM)
    made.status(READY, "TASK")
    return made


def enroll(made: Cell, condition: str, **more: Any) -> None:
    """An enrollment called E; ``more`` replaces parts of it."""
    body = pdus.enrollment("E", condition, "R_STC" if condition == "R_RVS" else ARM)
    made.call("defineEventEnrollment", body | more)


def tell(made: Cell, condition: str, **more: Any) -> None:
    """A notification to E, without an action's result."""
    body = {
        "eventEnrollmentName": vmd("E"), "eventConditionName": vmd(condition), "severity": 64,
        "transitionTime": ("undefined", None), "notificationLost": False, **more,
    }  # fmt: skip
    made.tell("eventNotification", body)


def count(made: Cell) -> int:
    return len(made.recording._messages)


def halt(made: Cell) -> int:
    """The task runs, then the arm is stopped; the index of the answer to Stop."""
    made.start("TASK", free=True)
    made.run("stop", ARM)
    return count(made) - 1


@pytest.mark.parametrize("condition", ["R_RVS", ARM])
def test_a_cause_and_its_notification_belong_together(condition: str, listen: Listen) -> None:
    made = ready()
    enroll(made, condition)
    for _ in range(2):
        halt(made)
        tell(made, condition)
        made.run("reset", "TASK", None)
    made.close()
    assert rules(listen(made)) == []


@pytest.mark.parametrize("condition", ["R_RVS", ARM])
def test_a_notification_before_anything_has_run_is_unfounded(condition: str, listen: Listen) -> None:
    made = ready()
    enroll(made, condition)
    tell(made, condition)
    (found,) = listen(made)
    assert (found.index, found.rule, found.severity) == (count(made) - 1, "event.unfounded", "error")
    assert found.clauses[0] == {"R_RVS": "R-8.7.1-1", ARM: "R-8.7.4-1"}[condition]


def test_one_cause_founds_one_notification(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    halt(made)
    tell(made, ARM)
    tell(made, ARM)
    assert rules(listen(made)) == [(count(made) - 1, "event.unfounded")]


def test_a_program_may_end_by_itself_and_found_a_notification(listen: Listen) -> None:
    made = ready()
    enroll(made, "R_RVS")
    made.start("TASK", cycles=1)
    tell(made, "R_RVS")
    made.status("robot-loaded")
    assert rules(listen(made)) == []


def test_a_notification_may_come_before_the_answer_that_brings_its_cause(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    made.start("TASK", free=True)
    stop = made.ask("stop", {"programInvocationName": ARM})
    made.arm_left_running("E", "stopped", by="TASK")
    made.answer(stop, "stop")
    made.close()
    assert rules(listen(made)) == []


def test_the_result_of_an_action_may_be_older_than_the_next_request(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    halt(made)
    asked = made.ask(
        "resume", {"programInvocationName": "TASK"}, ("controlling", {"modeType": ("continueMode", None)})
    )
    made.arm_left_running("E", "stopped", by="TASK")
    made.answer(asked, "resume")
    made.status(EXECUTING, "TASK")
    assert rules(listen(made)) == []


def test_the_result_of_an_action_shows_the_state(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    halt(made)
    made.arm_left_running("E", "unrunnable", by="TASK")
    assert rules(listen(made)) == [(count(made) - 1, "attributes.state")]


def test_a_missing_notification_is_told_at_its_cause_when_the_association_is_concluded(
    listen: Listen,
) -> None:
    made = ready()
    enroll(made, ARM)
    cause = halt(made)
    made.close()
    (found,) = listen(made)
    assert (found.index, found.rule, found.severity) == (cause, "event.missing", "error")
    assert found.clauses == ("R-8.7.4-1", "R-6.3.9-1")


def test_a_missing_notification_is_told_when_its_cause_occurs_again(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    cause = halt(made)
    made.run("reset", "TASK", None)
    halt(made)
    assert rules(listen(made)) == [(cause, "event.missing")]


def test_a_missing_notification_is_waited_for(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    cause = halt(made)
    for _ in range(PATIENCE // 2):
        made.status(PAUSED, "TASK")
    assert rules(listen(made)) == []
    made.status(PAUSED, "TASK")
    assert rules(listen(made)) == [(cause, "event.missing")]


def test_a_local_control_that_is_taken_before_everybody_s_eyes_must_be_notified(listen: Listen) -> None:
    made = ready()
    both = bit_string("Transitions", ["active-to-idle", "idle-to-active"], 7)
    enroll(made, "R_RLC", eventConditionTransitions=both)
    made.status(READY, "TASK")
    made.status(READY, "TASK", local=True, logical=1)
    cause = count(made) - 1
    made.close()
    assert rules(listen(made)) == [(cause, "event.missing")]


def gap(made: Cell) -> None:
    made.recording.link(made.name, "gap")


def reset(made: Cell) -> None:
    made.recording.link(made.name, "reset")


@pytest.mark.parametrize("end", [gap, reset, lambda _made: None])
def test_nothing_is_missing_where_the_recording_breaks_off(
    end: Callable[[Cell], None], listen: Listen
) -> None:
    made = ready()
    enroll(made, ARM)
    halt(made)
    end(made)
    assert rules(listen(made)) == []


@pytest.mark.parametrize(
    "more",
    [
        {"eventConditionTransitions": bit_string("Transitions", ["idle-to-active"], 7)},
        {"clientApplication": {}},
    ],
)
def test_nothing_is_missing_that_was_not_asked_for_here(more: dict[str, Any], listen: Listen) -> None:
    made = ready()
    enroll(made, ARM, **more)
    halt(made)
    made.close()
    assert rules(listen(made)) == []


def test_a_condition_that_is_disabled_is_not_notified(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    asked = made.ask("alterEventConditionMonitoring", {"eventConditionName": vmd(ARM), "enabled": False})
    made.answer(asked, "alterEventConditionMonitoring")
    halt(made)
    made.close()
    assert "event.missing" not in [rule for _, rule in rules(listen(made))]


def test_what_was_deleted_is_not_notified_any_more(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    made.call("deleteEventEnrollment", ("specific", [vmd("E")]), gives=0)
    halt(made)
    tell(made, ARM)
    made.close()
    assert rules(listen(made)) == [(count(made) - 4, "event.deleted")]


def test_an_enrollment_that_the_recording_does_not_show_is_not_judged(listen: Listen) -> None:
    made = ready()
    tell(made, ARM)
    assert rules(listen(made)) == []


def test_a_gap_may_hide_a_cause(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    gap(made)
    tell(made, ARM)
    assert rules(listen(made)) == []


def test_somebody_at_the_panel_may_have_run_the_arm(listen: Listen) -> None:
    made = ready()
    enroll(made, ARM)
    made.status(READY, "TASK", local=True, logical=1)
    tell(made, ARM)
    assert rules(listen(made)) == []

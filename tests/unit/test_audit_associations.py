"""Recordings of associations: how they begin and end, what stops a robot, what is told of which message."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mmsverify.audit.suspicion import undecodable
from mmsverify.auditing import audit_traces
from mmsverify.errors import DecodeError
from mmsverify.formats.mms import Pdu
from mmsverify.model.rows import Clause
from mmsverify.results import Finding
from mmsverify.samples import pdus
from mmsverify.samples.cell import Cell
from mmsverify.samples.recording import Recording

INTERVENTION = "manualInterventionRequired"
Listen = Callable[[Cell], list[Finding]]


@pytest.fixture
def listen(tmp_path: Path) -> Listen:
    def audited(made: Cell) -> list[Finding]:
        path = tmp_path / "made.mcap"
        made.recording.write(path, None)
        return list(audit_traces([path], profile=None, model=None).findings)

    return audited


@pytest.fixture
def cell() -> Cell:
    made = Cell(Recording("cell"))
    made.begin()
    return made


def say(made: Cell, sender: str, kind: str, invoke_id: int | None = None) -> None:
    made.recording.say(made.name, sender, Pdu(kind, invoke_id))  # type: ignore[arg-type]


def places(findings: list[Finding]) -> list[tuple[int | None, str, str]]:
    return [(finding.index, finding.rule, finding.severity) for finding in findings]


def domain(name: str, *, sharable: bool) -> dict[str, Any]:
    """The attributes of a standardized domain that its own program uses."""
    return {
        "listOfCapabilities": [], "state": 3, "mmsDeletable": False, "sharable": sharable,
        "listOfProgramInvocations": [name], "uploadInProgress": 0,
    }  # fmt: skip


def stopped(made: Cell) -> None:
    """The robot is stopped as a whole: message 4 is the answer."""
    made.call("vMDStop")


@pytest.mark.exercises("R-9.2.2.4-1")
def test_a_robot_that_concludes_directly_after_a_stop_is_suspected(listen: Listen, cell: Cell) -> None:
    stopped(cell)
    say(cell, "server", "conclude-RequestPDU")
    (found,) = listen(cell)
    assert (found.index, found.rule, found.severity) == (5, "association.concluded-after-stop", "warning")
    assert (found.clauses, found.readings) == (("R-9.2.2.4-1",), ("RP-23",))


@pytest.mark.exercises("R-9.2.2.4-1")
def test_a_connection_lost_directly_after_an_emergency_stop_is_worth_a_note(
    listen: Listen, cell: Cell
) -> None:
    cell.tell_status(INTERVENTION, logical=1, physical=3)
    cell.recording.link(cell.name, "reset")
    assert places(listen(cell)) == [(4, "association.lost-after-stop", "note")]


def test_a_client_may_conclude_whenever_it_likes(listen: Listen, cell: Cell) -> None:
    stopped(cell)
    cell.close()
    assert listen(cell) == []


def test_a_robot_may_conclude_when_nothing_has_stopped_it(listen: Listen, cell: Cell) -> None:
    stopped(cell)
    cell.status(INTERVENTION, logical=1, physical=3)
    cell.call("identify", gives={"vendorName": "V", "modelName": "M", "revision": "1"})
    say(cell, "server", "conclude-RequestPDU")
    say(cell, "client", "conclude-ResponsePDU")
    cell.recording.link(cell.name, "close")
    assert listen(cell) == []


def test_a_request_that_a_conclude_leaves_unanswered_is_told_where_it_was_asked(
    listen: Listen, cell: Cell
) -> None:
    cell.ask("status", False)
    cell.tell_status("robot-idle")
    cell.close()
    assert places(listen(cell)) == [(3, "protocol.unanswered", "error")]


def test_a_connection_that_is_lost_answers_nothing_more(listen: Listen, cell: Cell) -> None:
    cell.ask("status", False)
    cell.recording.link(cell.name, "reset")
    assert listen(cell) == []


@pytest.mark.exercises("R-9.2.2.2.1-1")
def test_a_cancelled_request_is_not_performed(listen: Listen, cell: Cell) -> None:
    asked = cell.ask("status", False)
    say(cell, "client", "cancel-RequestPDU", asked)
    say(cell, "server", "cancel-ResponsePDU", asked)
    cell.answer(
        asked, "status", pdus.status(0, 0), pdus.robot_status("robot-idle", (), ("noneSelected", None))
    )
    (found,) = listen(cell)
    assert (found.index, found.rule, found.related) == (6, "cancel.performed", (4,))
    assert found.readings == ("B-CANCEL",)


def test_a_service_before_the_answer_to_initiate_has_no_association(listen: Listen) -> None:
    made = Cell(Recording("cell"))
    made.recording.say(made.name, "client", pdus.initiation("Request", (), ()))
    made.ask("status", False)
    made.ask("identify")
    assert places(listen(made)) == [(1, "protocol.no-association", "error")]


@pytest.mark.exercises("R-7.4.1.2-2", "R-7.4.1.5-1")
def test_an_additional_service_is_confirmed(listen: Listen, cell: Cell) -> None:
    cell.recording._add(cell.recording._messages[-1][1], bytes.fromhex("a304a3028000"))
    assert places(listen(cell)) == [(3, "protocol.additional-unconfirmed", "error")]


@pytest.mark.parametrize("octets", ["a3", "a380", "a38104a3028000", "a304a4028000", "a004a3028000"])
def test_other_octets_are_just_undecodable(octets: str) -> None:
    wanted = "protocol.additional-unconfirmed" if octets.startswith("a381") else "protocol.undecodable"
    assert undecodable(bytes.fromhex(octets), DecodeError("no", offset=0), Clause(())).rule == wanted


@pytest.mark.exercises("R-7.3.2.1-1")
def test_a_robot_that_opens_the_connection_itself_is_worth_a_note(listen: Listen, cell: Cell) -> None:
    detail = pdus.robot_status("robot-idle", (), ("noneSelected", None))
    told = Pdu("unconfirmed-PDU", None, "unsolicitedStatus", pdus.status(0, 0), detail)
    cell.recording.say(cell.name, "client", told)
    cell.recording.say(cell.name, "client", told)
    assert places(listen(cell)) == [(3, "protocol.status-of-caller", "note")]


@pytest.mark.exercises("R-9.2.2.2.1-1", "R-9.2.2.1-1", "R-9.2.3.1-1")
def test_a_robot_without_the_base_class_is_told_so_at_initiate(listen: Listen) -> None:
    made = Cell(Recording("cell"))
    for _ in range(2):
        made.open({"client": (), "server": ("status", "identify")}, ("select",), 1)
        made.close()
    assert places(listen(made)) == [(2, "conformance.services", "warning")]


def test_a_value_that_every_poll_shows_is_told_once(listen: Listen, cell: Cell) -> None:
    for _ in range(3):
        cell.read(("R_VPWR", ("integer", 1)))
    assert places(listen(cell)) == [(4, "variable.type", "error")]


def test_an_object_that_every_poll_shows_is_told_once(listen: Listen, cell: Cell) -> None:
    for _ in range(3):
        cell.call("getDomainAttributes", "R_ARM", gives=domain("R_ARM", sharable=False))
    (found,) = listen(cell)
    assert (found.index, found.rule, found.clauses[0]) == (4, "object.attribute", "R-8.2.1-3")


def test_what_the_model_has_told_of_a_poll_is_not_told_again_of_the_next(listen: Listen, cell: Cell) -> None:
    for _ in range(3):
        cell.domain("R_ARM", "in-use", [])
    assert places(listen(cell)) == [(4, "domain.in-use-unbound", "error")]


@pytest.mark.exercises("R-8.5.3.1-1")
def test_what_a_client_writes_is_judged_when_the_robot_accepts_it(listen: Listen, cell: Cell) -> None:
    body = {"variableAccessSpecification": pdus.variables(pdus.vmd("R_SF")), "listOfData": [("integer", 1)]}
    cell.call("write", body, gives=[("success", None)])
    assert places(listen(cell)) == [(4, "variable.written", "error")]


@pytest.mark.exercises("R-8.2.3-2")
def test_a_domain_that_no_profile_names_is_not_deletable_either(listen: Listen, cell: Cell) -> None:
    cell.call("deleteDomain", "R_SAFE")
    assert places(listen(cell)) == [(4, "object.deleted", "error")]


@pytest.mark.exercises("R-8.2.1-3")
def test_what_the_model_has_told_of_a_message_is_not_told_twice(listen: Listen, cell: Cell) -> None:
    cell.call("deleteDomain", "R_ARM")
    assert places(listen(cell)) == [(4, "delete-domain.not-deletable", "error")]


@pytest.mark.exercises("R-8.2.1-3", "R-8.2.2-2")
@pytest.mark.parametrize(("name", "field"), [("R_ARM", "sharable"), ("R_CAL", "mmsDeletable")])
def test_the_attributes_of_a_standardized_domain_are_judged(
    listen: Listen, cell: Cell, name: str, field: str
) -> None:
    gives = domain(name, sharable=name == "R_ARM")
    cell.call("getDomainAttributes", name, gives=gives)
    cell.call("getDomainAttributes", name, gives=gives | {field: not gives[field]})
    assert places(listen(cell)) == [(6, "object.attribute", "error")]


@pytest.mark.exercises("R-7.4.4.3-2", "R-7.4.4.1.1.2-1")
def test_a_list_of_controlled_ones_comes_with_the_controlling_one(listen: Listen, cell: Cell) -> None:
    asked = cell.ask("select", {"controlled": ["R_ARM"]})
    cell.refuse(asked, ("service", "object-state-conflict"))
    assert ("select.controlled-alone", "error") in [
        (f.rule, f.severity) for f in listen(cell) if f.index == 3
    ]


@pytest.mark.exercises("R-5.3.1.3.2.1-1")
def test_what_nothing_has_shown_since_robot_idle_cannot_act(listen: Listen, cell: Cell) -> None:
    cell.status("robot-idle")
    cell.call("kill", {"programInvocationName": "GHOST"})
    assert ("program.never-shown", "error") in [(f.rule, f.severity) for f in listen(cell) if f.index == 6]


def test_what_is_no_task_program_may_be_older_than_a_recording_that_begins_late(listen: Listen) -> None:
    cell = Cell(Recording("cell"))
    cell.status("robot-idle")
    cell.call("kill", {"programInvocationName": "GHOST"})
    assert places(listen(cell)) == [(3, "program.not-shown-yet", "note")]


@pytest.mark.exercises("R-8.7.1-1")
def test_an_event_without_its_cause_is_unfounded(listen: Listen, cell: Cell) -> None:
    cell.status("robot-idle")
    cell.call("defineEventEnrollment", pdus.enrollment("E", "R_RVS", "R_STC"))
    cell.status("robot-idle")
    idle = pdus.robot_status("robot-idle", pdus.ALL_WELL, ("noneSelected", None))
    told = pdus.notification("E", "R_RVS", "R_STC", ("status", pdus.status(0, 0)), idle)
    cell.tell("eventNotification", told)
    assert places(listen(cell)) == [(9, "event.unfounded", "error")]

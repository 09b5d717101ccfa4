"""What decodes and yet means nothing to a robot: told with its clause, and no more is made of it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.formats.mms import Pdu
from mmsverify.results import Audit, Finding
from mmsverify.samples import pdus
from mmsverify.samples.cell import ARM, OFFERED, Cell
from mmsverify.samples.recording import Recording

Listen = Callable[..., list[Finding]]
STATUS: dict[str, Any] = {"vmdLogicalStatus": 0, "vmdPhysicalStatus": 0}
DETAIL: dict[str, Any] = {
    "robotVMDState": 0,
    "robotSpecificStatus": "0110",
    "robotSpecificStatusMask": "1111",
    "selectedProgramInvocation": ("noneSelected", None),
}


@pytest.fixture
def listen(tmp_path: Path) -> Listen:
    def audited(made: Cell, **profile: str) -> list[Finding]:
        path = tmp_path / "made.mcap"
        made.recording.write(path, {"model": "mms-robot", **profile} if profile else None)
        audit: Audit = audit_traces([path], profile=None, model=None)
        return list(audit.findings)

    return audited


@pytest.fixture
def cell() -> Cell:
    made = Cell(Recording("cell"))
    made.begin()
    return made


def told(found: list[Finding]) -> list[tuple[str, str, str]]:
    return [(one.rule, one.severity, one.clauses[0]) for one in found]


@pytest.mark.parametrize("state", [6, 9, -1])
def test_a_robot_state_without_a_name_is_an_error(cell: Cell, listen: Listen, state: int) -> None:
    cell.call("status", False, gives=STATUS, extra={**DETAIL, "robotVMDState": state})
    assert told(listen(cell)) == [("value.unnamed", "error", "R-7.3.2.1.2-3")]


def test_what_every_poll_shows_again_is_told_once(cell: Cell, listen: Listen) -> None:
    for _ in range(3):
        cell.call("status", False, gives=STATUS, extra={**DETAIL, "robotVMDState": 9})
    assert len(listen(cell)) == 1


@pytest.mark.parametrize("field", STATUS)
def test_a_status_of_the_device_without_a_name_is_an_error(cell: Cell, listen: Listen, field: str) -> None:
    cell.call("status", False, gives={**STATUS, field: 4}, extra=DETAIL)
    (found,) = listen(cell)
    assert (found.rule, found.readings) == ("value.unnamed", ("B-SYNTAX",))
    assert field in found.message


@pytest.mark.parametrize(
    ("field", "clause"),
    [("robotSpecificStatus", "R-7.3.2.1.1.2-1"), ("robotSpecificStatusMask", "R-7.3.2.1.1.3-1")],
)
def test_bits_that_are_missing_are_a_warning_and_show_nothing(
    cell: Cell, listen: Listen, field: str, clause: str
) -> None:
    cell.tell("unsolicitedStatus", STATUS, {**DETAIL, "robotSpecificStatus": "0111", field: "011"})
    assert told(listen(cell)) == [("status.bits", "warning", clause)]


def test_bits_beyond_the_four_mean_nothing(cell: Cell, listen: Listen) -> None:
    cell.call("status", False, gives=STATUS, extra={**DETAIL, "robotSpecificStatus": "01101"})
    assert listen(cell) == []


def test_the_status_in_a_notification_is_judged_too(cell: Cell, listen: Listen) -> None:
    detail = {**DETAIL, "robotVMDState": 7}
    cell.tell("eventNotification", pdus.notification("E", "R_SIV", "R_STC", ("status", STATUS), detail))
    assert ("value.unnamed", "error", "R-7.3.2.1.2-3") in told(listen(cell))


def test_a_control_without_a_name_is_an_error_of_the_request(cell: Cell, listen: Listen) -> None:
    body = {"programInvocationName": "TASK", "listOfDomainNames": ["TASK"], "reusable": True}
    asked = cell.ask("createProgramInvocation", body, 3)
    cell.refuse(asked, ("definition", "object-attribute-inconsistent"))
    found = [one for one in listen(cell) if one.severity == "error"]
    assert told(found) == [("value.unnamed", "error", "R-7.3.3.2.1.1-1")]


def test_a_state_of_a_program_invocation_without_a_name_is_an_error(cell: Cell, listen: Listen) -> None:
    body = {**pdus.attributes("idle", [ARM], deletable=False), "state": 9}
    cell.call("getProgramInvocationAttributes", ARM, gives=body, extra=pdus.controlled(None))
    (found,) = listen(cell)
    assert (found.rule, "state 9" in found.message) == ("value.unnamed", True)


def test_a_detail_of_another_companion_standard_is_an_error(cell: Cell, listen: Listen) -> None:
    cell.ask("defineEventEnrollment", pdus.enrollment("E", "R_RVS", "R_STC"), ("index", 4))
    assert told(listen(cell)) == [("detail.foreign", "error", "R-7.3.4-1")]


@pytest.mark.parametrize(("information", "rules"), [(None, []), (b"\x83\x01\x05", ["error.additional"])])
def test_a_failed_service_of_the_robot_tells_nothing_beside(
    cell: Cell, listen: Listen, information: bytes | None, rules: list[str]
) -> None:
    asked = cell.ask("select", {"controlling": "NOBODY", "controlled": []})
    error = {"errorClass": ("access", 2), "serviceSpecificInformation": ("additionalService", information)}
    cell.recording.say(cell.name, "server", Pdu("confirmed-ErrorPDU", asked, body={"serviceError": error}))
    assert [one.rule for one in listen(cell)] == rules


NAMES = {"vendorName": "v", "modelName": "m", "revision": "1"}


@pytest.mark.parametrize(
    ("listed", "rules"),
    [
        (None, []),
        (["1.0.9506.2.1", "1.0.9506.3.1"], []),
        (["1.0.9506.2.1"], [("identify.syntax", "note", "R-7.2-1")]),
    ],
)
def test_a_robot_names_its_abstract_syntax_if_it_names_any(
    cell: Cell, listen: Listen, listed: list[str] | None, rules: list[tuple[str, str, str]]
) -> None:
    body = NAMES if listed is None else {**NAMES, "listOfAbstractSyntaxes": listed}
    cell.call("identify", None, gives=body)
    assert told(listen(cell)) == rules


def test_a_device_of_which_nothing_is_known_may_name_other_syntaxes(listen: Listen) -> None:
    made = Cell(Recording("cell"))
    made.call("identify", None, gives={**NAMES, "listOfAbstractSyntaxes": ["1.0.9506.2.1"]})
    assert listen(made) == []


def test_an_answer_in_the_robots_form_needs_a_proposal_in_it(listen: Listen) -> None:
    made = Cell(Recording("cell"))
    proposal = pdus.initiation("Request", ("status",), ())
    del proposal.body["initRequestDetail"]["additionalSupportedCalling"]
    made.recording.say(made.name, "client", proposal)
    made.recording.say(made.name, "server", pdus.initiation("Response", OFFERED["server"], ("select",)))
    assert told(listen(made)) == [("negotiation.syntax", "error", "R-7.5.2-1")]


@pytest.mark.parametrize(("supported", "count"), [("true", 0), ("false", 1)])
def test_a_robot_without_step_limited_does_not_show_it(
    cell: Cell, listen: Listen, supported: str, count: int
) -> None:
    cell.attributes("TASK", "idle", pdus.controlling([], ("stepLimited", 3)))
    found = [one for one in listen(cell, step_limited=supported) if one.rule == "attributes.step-limited"]
    assert [one.clauses[:2] for one in found] == [("R-7.3.3.9.2.9-1", "R-7.3.3.9.4.2-1")] * count


def test_an_undecodable_pdu_is_told_with_what_its_type_encodes(cell: Cell, listen: Listen) -> None:
    octets = bytes.fromhex("A01B020109BF28058003504931BF4F0DBF280A3008800135A103840103")
    cell.recording._add(cell.recording._messages[-2][1], octets)
    (found,) = listen(cell)
    assert found.rule == "protocol.undecodable"
    assert found.clauses[0] == "R-7.3.3.3.4-2"
    assert {"R-T4-2", "R-7.3.1-2"} <= set(found.clauses)

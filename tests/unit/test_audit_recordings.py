"""Whole small recordings: what an audit finds in them, and what it does not dare to say."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.formats.mms import Pdu
from mmsverify.results import Audit
from mmsverify.samples import pdus
from mmsverify.samples.cell import ARM, OFFERED, ROBOT_ADDITIONAL, Cell
from mmsverify.samples.pdus import controlled, controlling, initiation, of_domain
from mmsverify.samples.recording import Recording

LOADED, READY, EXECUTING = "robot-loaded", "robot-ready", "robot-executing"
Listen = Callable[..., Audit]


@pytest.fixture
def listen(tmp_path: Path) -> Listen:
    def audited(recording: Recording, **profile: str) -> Audit:
        path = tmp_path / "made.mcap"
        recording.write(path, {"model": "mms-robot", **profile} if profile else None)
        return audit_traces([path], profile=None, model=None)

    return audited


def rules(audit: Audit) -> list[tuple[int | None, str]]:
    return [(finding.index, finding.rule) for finding in audit.findings]


def cell(*, begun: bool = True) -> Cell:
    made = Cell(Recording("cell"))
    if begun:
        made.begin()
    return made


def test_a_recording_that_begins_in_mid_operation_may_start_with_anything(listen: Listen) -> None:
    made = cell(begun=False)
    made.status(EXECUTING, "TASK")
    made.attributes("TASK", "running", controlling([ARM]))
    made.run("stop", ARM)
    assert rules(listen(made.recording)) == []


def test_what_the_beginning_shows_is_known_from_then_on(listen: Listen) -> None:
    made = cell(begun=False)
    made.status(READY, "TASK")
    made.start("OTHER", cycles=1)
    (found,) = listen(made.recording).findings
    assert found.rule == "start.not-selected"
    assert found.clauses[0] == "R-7.3.3.3.3-d0"
    assert (found.expected, found.observed) == (("result(-)",), "result(+)")


def test_a_gap_forgets_what_was_known(listen: Listen) -> None:
    made = cell(begun=False)
    made.status(READY, "TASK")
    made.recording.link(made.name, "gap")
    made.start("OTHER", cycles=1)
    assert rules(listen(made.recording)) == []


def moved_unasked(made: Cell) -> None:
    made.status(READY, "TASK")
    made.status(EXECUTING, "TASK")


@pytest.mark.parametrize("lost", [None, "gap"])
def test_what_a_recording_lacks_may_be_performed_until_it_is_answered(listen: Listen, lost: Any) -> None:
    made = cell(begun=lost is not None)
    if lost is not None:
        made.recording.link(made.name, lost)
    moved_unasked(made)
    made.recording.say(made.name, "server", Pdu("confirmed-ResponsePDU", 99, "start", None))
    assert rules(listen(made.recording)) == []


def test_an_inquiry_that_a_recording_lacks_explains_nothing(listen: Listen) -> None:
    made = cell(begun=False)
    moved_unasked(made)
    made.recording.say(
        made.name, "server", Pdu("confirmed-ResponsePDU", 99, "read", {"listOfAccessResult": []})
    )
    assert (3, "status.robot-state") in rules(listen(made.recording))


def test_an_answer_is_not_waited_for_without_end(listen: Listen) -> None:
    made = cell(begun=False)
    moved_unasked(made)
    for _ in range(50):
        made.status(EXECUTING, "TASK")
    made.recording.say(made.name, "server", Pdu("confirmed-ResponsePDU", 9999, "start", None))
    assert rules(listen(made.recording)) == [(3, "status.robot-state")]


def test_what_was_answered_already_is_not_performed_again_unseen(listen: Listen) -> None:
    made = cell(begun=False)
    asked = made.ask("kill", {"programInvocationName": "OTHER"})
    made.refuse(asked, ("access", "object-non-existent"))
    moved_unasked(made)
    made.refuse(asked, ("access", "object-non-existent"))
    assert len(rules(listen(made.recording))) == 1


def test_what_waits_during_a_gap_may_have_been_performed_before_its_end(listen: Listen) -> None:
    """TASK may have been killed, and created and selected again, before the answer comes."""
    made = cell()
    other = Cell(made.recording, "other")
    other.begin()
    asked = other.ask("kill", {"programInvocationName": "TASK"})
    made.recording.link(made.name, "gap")
    made.status(READY, "TASK")
    other.answer(asked, "kill")
    made.status(READY, "TASK")
    assert rules(listen(made.recording, associations="multiple")) == []


def test_a_refusal_that_nothing_explains_is_a_warning(listen: Listen) -> None:
    made = cell()
    made.status("robot-idle")
    asked = made.ask("vMDStop", None, None)
    refusal = Pdu("confirmed-ErrorPDU", asked, body={"serviceError": {"errorClass": ("service", 2)}})
    made.recording.say(made.name, "server", refusal)
    (found,) = listen(made.recording).findings
    assert (found.rule, found.severity) == ("vMDStop.refused", "warning")


def test_a_refusal_for_want_of_resources_needs_no_explanation(listen: Listen) -> None:
    made = cell()
    body = {"programInvocationName": "TASK", "listOfDomainNames": ["TASK"], "reusable": True}
    asked = made.ask("createProgramInvocation", body, 1)
    made.recording.say(
        made.name,
        "server",
        Pdu("confirmed-ErrorPDU", asked, body={"serviceError": {"errorClass": ("resource", 1)}}),
    )
    assert rules(listen(made.recording)) == []


def test_a_device_that_is_no_robot_is_judged_by_the_base_standard_only(listen: Listen) -> None:
    made = cell(begun=False)
    for sort, side in (("Request", "client"), ("Response", "server")):
        pdu = initiation(sort, ("status", "start"), ())
        del pdu.body[f"init{sort}Detail"][
            "additionalSupported" + ("Calling" if side == "client" else "Called")
        ]
        made.recording.say(made.name, side, pdu)  # type: ignore[arg-type]
    made.call("start", {"programInvocationName": "NOBODY"})
    made.call("start", {"programInvocationName": "NOBODY"})
    made.call("kill", {"programInvocationName": "NOBODY"})
    assert rules(listen(made.recording)) == [(7, "negotiation.service")]


def test_octets_that_are_no_pdu_are_a_finding_and_the_audit_goes_on(listen: Listen) -> None:
    made = cell()
    made.recording._add(made.recording._messages[-1][1], b"\x30\x03\x02\x01")
    made.status(EXECUTING, None)
    assert rules(listen(made.recording)) == [(3, "protocol.undecodable"), (5, "status.executing-unselected")]


def test_nothing_is_said_after_conclude(listen: Listen) -> None:
    made = cell()
    made.close()
    made.status("robot-idle")
    assert rules(listen(made.recording)) == []
    late = cell()
    late.recording.say(late.name, "client", Pdu("conclude-RequestPDU"))
    late.recording.say(late.name, "server", Pdu("conclude-ResponsePDU"))
    late.status("robot-idle")
    assert rules(listen(late.recording))[0] == (5, "protocol.after-conclude")


def test_a_status_that_contradicts_itself_is_told_once(listen: Listen) -> None:
    made = cell()
    made.create("TASK")
    for _ in range(4):
        made.status(EXECUTING, None)
    assert rules(listen(made.recording)) == [(6, "status.executing-unselected")]


def test_the_arm_must_be_controlled(listen: Listen) -> None:
    made = cell()
    made.attributes(ARM, "idle", controlling([]), deletable=False)
    (found,) = listen(made.recording).findings
    assert (found.rule, found.clauses[0]) == ("attributes.arm-control", "R-8.3.1-6")


def test_a_variable_of_the_standard_has_its_type(listen: Listen) -> None:
    made = cell()
    made.read(("R_VPWR", ("integer", 1)))
    (found,) = listen(made.recording).findings
    assert (found.rule, found.clauses[0]) == ("variable.type", "R-8.5.3.1-1")


def test_a_second_association_is_too_many_for_the_base_class_only(listen: Any) -> None:
    made = cell()
    Cell(made.recording, "second").open(OFFERED, ROBOT_ADDITIONAL, 1)
    assert rules(listen(made.recording)) == [(5, "initiate.second-association")]
    assert rules(listen(made.recording, associations="multiple")) == []


def test_a_notification_about_the_arm_needs_a_cause(listen: Listen) -> None:
    made = cell()
    made.arm("idle")
    made.call("defineEventEnrollment", pdus.enrollment("E", ARM, ARM))
    made.arm_left_running("E", "running")
    assert "event.arm-running" in [rule for _, rule in rules(listen(made.recording))]


def test_one_fault_is_one_finding(listen: Listen) -> None:
    """After a violation every state that agrees with what was seen is possible: no cascade."""
    made = cell()
    made.create("TASK")
    made.start("TASK", free=True)
    made.attributes("TASK", "running", controlling([]))
    made.run("stop", "TASK")
    made.attributes("TASK", "stopped", controlling([]))
    made.attributes(ARM, "idle", controlled(None), deletable=False)
    assert rules(listen(made.recording)) == [(6, "start.not-selected")]


def test_a_refusal_may_tell_the_state_from_before_another_request_was_answered(listen: Listen) -> None:
    made = cell()
    made.create("OLD")
    refused = made.ask("resume", {"programInvocationName": "OLD"})
    made.call("deleteProgramInvocation", "OLD")
    made.refuse(refused, ("service", "object-state-conflict"), ("resume", "idle"))
    assert rules(listen(made.recording)) == []


def test_what_is_being_created_may_be_used_before_the_answer_says_so(listen: Listen) -> None:
    made = cell()
    made.status("robot-idle")
    body = {"programInvocationName": "NEW", "listOfDomainNames": ["NEW"], "reusable": True}
    asked = made.ask("createProgramInvocation", body)
    made.start("NEW")
    made.answer(asked, "createProgramInvocation")
    assert rules(listen(made.recording)) == []


def test_an_answer_may_show_the_state_from_before_another_answer_showed_more(listen: Listen) -> None:
    made = cell()
    made.create("JOB", 0)
    made.start("JOB")
    early = made.ask("getProgramInvocationAttributes", "JOB")
    made.attributes("JOB", "idle", pdus.NORMAL)  # it has come to its end
    made.answer(early, "getProgramInvocationAttributes", pdus.attributes("running", ["JOB"]), pdus.NORMAL)
    assert rules(listen(made.recording)) == []


def test_a_device_in_local_control_shows_that_somebody_took_it(listen: Listen) -> None:
    made = cell()
    made.read(("R_VLOCAL", ("boolean", False)))
    made.read((of_domain(ARM, "R_DLOCAL"), ("boolean", True)))
    assert rules(listen(made.recording)) == []


def test_a_segment_may_have_been_handed_over_before_its_upload_was_ended(listen: Listen) -> None:
    made = cell()
    made.call("initiateUploadSequence", ARM, gives={"ulsmID": 1, "listOfCapabilities": []})
    segment = made.ask("uploadSegment", 1)
    made.call("terminateUploadSequence", 1)
    made.answer(segment, "uploadSegment", {"loadData": ("non-coded", b"END"), "moreFollows": False})
    assert rules(listen(made.recording)) == []


def test_a_domain_may_show_an_upload_whose_beginning_is_not_answered_yet(listen: Listen) -> None:
    made = cell()
    made.download("JOB", [b"END"])
    made.domain("JOB", "ready", [])
    begun = made.ask("initiateUploadSequence", "JOB")
    gives = {
        "listOfCapabilities": [],
        "state": 2,
        "mmsDeletable": True,
        "sharable": False,
        "listOfProgramInvocations": [],
        "uploadInProgress": 1,
    }
    made.call("getDomainAttributes", "JOB", gives=gives)
    made.answer(begun, "initiateUploadSequence", {"ulsmID": 1, "listOfCapabilities": []})
    assert rules(listen(made.recording)) == []


def test_a_damaged_recording_does_not_keep_others_from_being_audited(tmp_path: Path) -> None:
    good, bad = tmp_path / "good.mcap", tmp_path / "bad.mcap"
    made = cell()
    made.status(LOADED)
    made.recording.write(good, None)
    octets = bytearray(good.read_bytes())
    octets[140] ^= 0xFF
    bad.write_bytes(octets)
    audit = audit_traces([bad, good], profile=None, model=None)
    assert [Path(entry.path).name for entry in audit.inputs][-1] == "good.mcap"
    assert [(f.rule, Path(f.path).name) for f in audit.findings] == [("input.unreadable", "bad.mcap")]


@pytest.mark.parametrize("profile", [{"arms": "17"}, {"predefind": "[]"}, {"select_robot": "maybe"}])
def test_a_recording_with_a_bad_profile_does_not_keep_others_from_being_audited(
    tmp_path: Path, profile: dict[str, str]
) -> None:
    good, bad = tmp_path / "good.mcap", tmp_path / "bad.mcap"
    made = cell()
    made.status(LOADED)
    made.recording.write(good, None)
    made.recording.write(bad, {"model": "mms-robot", **profile})
    audit = audit_traces([bad, good], profile=None, model=None)
    assert [Path(entry.path).name for entry in audit.inputs] == ["good.mcap"]
    assert [(f.rule, Path(f.path).name) for f in audit.findings] == [("input.unreadable", "bad.mcap")]


@pytest.mark.parametrize("length", [8, 100])
def test_a_recording_of_which_no_message_is_left_is_not_judged(tmp_path: Path, length: int) -> None:
    cut = tmp_path / "cut.mcap"
    made = cell()
    made.recording.write(cut, None)
    cut.write_bytes(cut.read_bytes()[:length])
    (found,) = audit_traces([cut], profile=None, model=None).findings
    assert found.rule == "input.unreadable"
    assert "first message" in found.message

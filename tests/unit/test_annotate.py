"""Annotated recordings: everything that was there, and channels that a log viewer can draw."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from mcap.reader import make_reader

from mmsverify.audit.spoken import Listener
from mmsverify.auditing import annotate, audit_traces, read_events
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.resources import traces_dir
from mmsverify.results import Finding

FAULTY = traces_dir() / "faulty-vmd-stop.mcap"
CLIENTS = traces_dir() / "two-clients.mcap"
ADDED = "/mmsverify/"


def finding(path: Path, index: int | None, severity: str = "error") -> Finding:
    return Finding(
        path=str(path), index=index, time=None, topic=None, vmd="weld5", severity=severity,  # type: ignore[arg-type]
        rule="a.rule", clauses=("R-1",), message="it is so",
    )  # fmt: skip


def annotated(out: Path, path: Path = FAULTY, *findings: Finding) -> list[TraceMessage]:
    annotate(path, findings, out)
    return list(read_trace(out))


def added(messages: list[TraceMessage], kind: str) -> list[tuple[int, Mapping[str, Any]]]:
    return [(m.index, json.loads(m.data)) for m in messages if m.topic.endswith(f"{ADDED}{kind}")]


def test_every_message_of_the_original_is_there_unchanged(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", FAULTY, finding(FAULTY, 7))
    kept = [(m.time, m.channel, m.data) for m in copy if ADDED not in m.topic]
    assert kept == [(m.time, m.channel, m.data) for m in read_trace(FAULTY)]


def test_the_profile_travels_with_the_copy(tmp_path: Path) -> None:
    annotated(tmp_path / "out.mcap", CLIENTS)
    assert read_trace(tmp_path / "out.mcap").profile == read_trace(CLIENTS).profile


def test_a_violation_stands_right_after_its_message(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", FAULTY, finding(FAULTY, 7), finding(FAULTY, 9, "warning"))
    original = {m.index: m for m in read_trace(FAULTY)}
    (at, first), (_, second) = added(copy, "violations")
    before = [m for m in copy[:at] if ADDED not in m.topic][-1]
    assert (before.data, copy[at].time) == (original[7].data, original[7].time)
    assert first["timestamp"] == {"sec": original[7].time // 10**9, "nsec": original[7].time % 10**9}
    assert (first["level"], second["level"]) == (4, 3)
    assert (first["name"], first["line"], first["message"]) == ("a.rule", 7, "it is so [R-1]")


def test_a_violation_of_the_file_as_a_whole_stands_at_its_end(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", FAULTY, finding(FAULTY, None))
    assert copy[-1].topic == "/weld5/mmsverify/violations"


def test_findings_of_other_recordings_are_left_out(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", FAULTY, finding(CLIENTS, 7))
    assert added(copy, "violations") == []


def test_the_robot_state_is_a_number_and_a_word(tmp_path: Path) -> None:
    states = [shown for _, shown in added(annotated(tmp_path / "out.mcap"), "state")]
    assert [(s["robot_state_number"], s["robot_state"]) for s in states] == [
        (0, "ROBOT-IDLE"), (1, "ROBOT-LOADED"), (3, "ROBOT-EXECUTING"), (5, "MANUAL-INTERVENTION-REQUIRED"),
        (0, "ROBOT-IDLE"), (0, "ROBOT-IDLE"),
    ]  # fmt: skip


def test_every_mms_message_is_told_as_json(tmp_path: Path) -> None:
    told = [shown for _, shown in added(annotated(tmp_path / "out.mcap"), "events")]
    spoken = [m.index for m in read_trace(FAULTY) if m.message_encoding == "mms-ber"]
    assert [shown["index"] for shown in told] == spoken


def test_the_log_channel_is_what_viewers_know(tmp_path: Path) -> None:
    annotated(tmp_path / "out.mcap", FAULTY, finding(FAULTY, 7))
    with (tmp_path / "out.mcap").open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    schemas = {schema.name: schema for schema in summary.schemas.values()}
    assert schemas["foxglove.Log"].encoding == "jsonschema"
    assert "level" in json.loads(schemas["foxglove.Log"].data)["properties"]


def test_the_same_call_gives_the_same_octets(tmp_path: Path) -> None:
    for name in ("a.mcap", "b.mcap"):
        annotated(tmp_path / name, FAULTY, finding(FAULTY, 7))
    assert (tmp_path / "a.mcap").read_bytes() == (tmp_path / "b.mcap").read_bytes()


def test_an_audit_of_the_copy_finds_the_same(tmp_path: Path) -> None:
    out = tmp_path / "out.mcap"
    found = audit_traces([CLIENTS], profile=None, model=None)
    annotate(CLIENTS, found.findings, out)
    again = audit_traces([out], profile=None, model=None)
    assert [(f.rule, f.message) for f in again.findings] == [(f.rule, f.message) for f in found.findings]
    assert again.inputs[0].skipped > 0


def test_an_answer_knows_its_request_and_its_programs() -> None:
    events = {event.index: event for event in read_events(FAULTY)}
    answer = events[42]
    asked = events[answer.answers or 0]
    assert (answer.service, answer.answer) == ("getProgramInvocationAttributes", "result(+)")
    assert (asked.sender, asked.programs, asked.invoke_id) == ("client", ("Weld_Roof",), answer.invoke_id)
    assert answer.programs == asked.programs


def test_a_refusal_and_a_selection_are_told() -> None:
    events = list(read_events(CLIENTS))
    assert ("takeControl", "result(-)") in [(e.service, e.answer) for e in events]
    assert ("Weld_Door", "R_ARM") in [e.programs for e in events if e.service == "select"]


def test_octets_that_are_no_pdu_say_why() -> None:
    message = next(m for m in read_trace(FAULTY) if m.message_encoding == "mms-ber")
    (event,) = Listener().events([TraceMessage(0, 1, message.channel, b"\x30\x00")])
    assert event.fault
    assert event.kind == ""


def test_a_recording_that_cannot_be_read_is_an_error(tmp_path: Path) -> None:
    from mmsverify.errors import InputError

    with pytest.raises(InputError):
        annotate(tmp_path / "none.mcap", [], tmp_path / "out.mcap")

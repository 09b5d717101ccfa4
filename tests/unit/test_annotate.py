"""Annotated recordings: everything that was there, and channels that a log viewer can draw."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from annotated_files import Read, everything, odd_recording
from jsonschema import Draft202012Validator

from mmsverify.annotating import ADDED, FINDINGS, REPORT, VERDICT, annotate
from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.errors import InputError
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.trace import Channel
from mmsverify.report.audit_json import document
from mmsverify.report.capping import capped
from mmsverify.resources import traces_dir
from mmsverify.results import Audit, Finding

SAMPLES = sorted(traces_dir().glob("*.mcap"))
FAULTY = traces_dir() / "faulty-vmd-stop.mcap"
CLIENTS = traces_dir() / "two-clients.mcap"
READABLE = {"string", "integer", "number", "boolean"}
"""The types of fields that Lichtblick's reader of JSON schemas knows, beside objects and lists of these."""


@cache
def audited(path: Path) -> Audit:
    return audit_traces([path], profile=None, model=None)


def finding(path: Path, index: int | None, severity: str = "error") -> Finding:
    return Finding(
        path=str(path), index=index, time=None, topic=None, vmd="weld5", severity=severity,  # type: ignore[arg-type]
        rule="a.rule", clauses=("R-1",), message="it is so",
    )  # fmt: skip


def annotated(out: Path, path: Path, *findings: Finding) -> Read:
    audit = audited(path)
    annotate(path, replace(audit, findings=findings) if findings else audit, out)
    return everything(out)


def told(read: Read, topic: str) -> list[dict[str, Any]]:
    return [json.loads(each.data) for each in read.messages if each.topic == topic]


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_what_was_recorded_is_there_octet_for_octet_and_in_order(path: Path, tmp_path: Path) -> None:
    copy, original = annotated(tmp_path / "out.mcap", path), everything(path)
    assert [each for each in copy.messages if not each.added] == original.messages
    assert copy.schemas.items() >= original.schemas.items()
    assert [pair for pair in copy.metadata if pair[0] != VERDICT] == original.metadata
    assert [each for each in copy.attachments if each[0] != REPORT] == original.attachments


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_every_message_that_was_added_is_what_its_schema_says(path: Path, tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", path)
    judges = {}
    for name, (encoding, text) in copy.schemas.items():
        if encoding == "jsonschema":
            Draft202012Validator.check_schema(json.loads(text))
            judges[name] = Draft202012Validator(json.loads(text))
    assert [each for each in copy.messages if each.added]
    for each in copy.messages:
        if each.schema in judges:
            judges[each.schema].validate(json.loads(each.data))


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_every_schema_that_was_added_is_one_that_viewers_can_read(path: Path, tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", path)
    for name in {each.schema for each in copy.messages if each.added}:
        for field, kind in json.loads(copy.schemas[name][1])["properties"].items():
            assert re.fullmatch(r"[A-Za-z0-9_]+", field), (name, field)
            inner = kind["items"] if kind["type"] == "array" else kind
            assert inner["type"] in READABLE or field == "timestamp", (name, field)
            assert "oneOf" not in kind


def test_what_an_audit_does_not_read_is_copied_as_well(tmp_path: Path) -> None:
    path = odd_recording(tmp_path / "odd.mcap")
    copy, original = annotated(tmp_path / "out.mcap", path), everything(path)
    kept = [replace(each, log=max(each.log, 1)) for each in original.messages]
    assert [each for each in copy.messages if not each.added] == kept
    assert [channel for channel in copy.channels if channel[3] != ADDED] == original.channels
    assert copy.schemas.items() >= original.schemas.items()
    assert ("notes", {"line": "7"}) in copy.metadata
    assert copy.attachments[0] == original.attachments[0]
    assert (original.profile, copy.profile) == ("plant", "plant")


def test_a_message_without_a_log_time_is_put_at_one_nanosecond(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = odd_recording(tmp_path / "odd.mcap"), tmp_path / "out.mcap"
    assert main(["audit", str(path), "--annotate", str(out), "--exit-zero"]) == 0
    assert "2 messages of log time 0 put at 1 ns" in capsys.readouterr().err
    assert min(each.log for each in everything(out).messages) == 1
    assert min(each.publish for each in everything(out).messages if not each.added) == 0


def test_the_profile_travels_with_the_copy(tmp_path: Path) -> None:
    annotated(tmp_path / "out.mcap", CLIENTS)
    assert read_trace(tmp_path / "out.mcap").profile == read_trace(CLIENTS).profile


def test_a_finding_stands_right_after_its_message(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", FAULTY, finding(FAULTY, 7), finding(FAULTY, 9, "warning"))
    original = {m.index: m for m in read_trace(FAULTY)}
    first, second = told(copy, FINDINGS)
    at = next(n for n, each in enumerate(copy.messages) if each.topic == FINDINGS)
    before = [each for each in copy.messages[:at] if not each.added][-1]
    assert (before.data, copy.messages[at].log) == (original[7].data, original[7].time)
    assert first["timestamp"] == {"sec": original[7].time // 10**9, "nsec": original[7].time % 10**9}
    assert (first["level"], second["level"]) == (4, 3)
    assert (first["name"], first["line"], first["message"]) == ("a.rule", 7, "it is so [R-1]")


def test_a_finding_of_the_file_as_a_whole_stands_at_its_end(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", FAULTY, finding(FAULTY, None))
    assert copy.messages[-1].topic == FINDINGS


def test_findings_of_other_recordings_are_left_out(tmp_path: Path) -> None:
    assert told(annotated(tmp_path / "out.mcap", FAULTY, finding(CLIENTS, 7)), FINDINGS) == []


def test_the_state_is_told_where_it_changes_in_words_and_in_numbers(tmp_path: Path) -> None:
    states = told(annotated(tmp_path / "out.mcap", FAULTY), "/mmsverify/state/weld5")
    shown = [(s["robot_state"], s["robot_state_code"]) for s in states]
    assert ("ROBOT-EXECUTING", 3) in shown
    assert ("ROBOT-IDLE | ROBOT-LOADED", -2) in shown
    assert ("unknown", -1) in {(s["program_R_CAL"], s["program_R_CAL_code"]) for s in states}
    assert ("MANUAL-INTERVENTION-REQUIRED", 5) in shown
    assert {(s["program_Weld_Roof"], s["program_Weld_Roof_code"]) for s in states} >= {
        ("RUNNING", 3), ("IDLE | STOPPED", -2),
    }  # fmt: skip
    assert all(before != after for before, after in pairwise(states))


def test_a_robot_and_a_controller_of_one_name_have_a_state_each(tmp_path: Path) -> None:
    source = tmp_path / "same.mcap"
    with TraceWriter(source) as trace:
        for message in read_trace(FAULTY):
            trace.add(message.time, message.channel, message.data)
            trace.add(message.time, Channel.vr("weld5", "polled"), b'{"C_RunMD":0}')
    out = annotated(tmp_path / "out.mcap", source)
    assert "robot_state" in told(out, "/mmsverify/state/weld5")[0]
    assert told(out, "/mmsverify/state/weld5/vr-template")[0]["mode"] == "Idle"


def test_a_controller_without_a_command_has_none(tmp_path: Path) -> None:
    press = told(
        annotated(tmp_path / "out.mcap", traces_dir() / "faulty-press.mcap"), "/mmsverify/state/press3"
    )
    assert {"none", "home", "org"} <= {state["command"] for state in press}
    assert "unknown" not in {state["command"] for state in press}


def test_mms_messages_are_decoded_with_the_time_that_the_answer_took(tmp_path: Path) -> None:
    topic = "/mmsverify/decoded/weld5/mms/cell-controller/server"
    answer = next(m for m in told(annotated(tmp_path / "out.mcap", FAULTY), topic) if m["index"] == 42)
    times = {m.index: m.time for m in read_trace(FAULTY)}
    assert answer["title"] == "GetProgramInvocationAttributes result(+)"
    assert (answer["answer_code"], answer["sender_code"], answer["kind_tag"]) == (1, 1, 1)
    assert answer["programs"] == "Weld_Roof"
    assert answer["response_time"] == (times[42] - times[answer["answers"]]) / 1e9


def test_modbus_messages_are_decoded_to_addresses_and_values(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", traces_dir() / "faulty-signals.mcap")
    topics = [f"/mmsverify/decoded/robot4/modbus/{name}/server" for name in ("line", "panel")]
    served = {m["index"]: m for topic in topics for m in told(copy, topic)}
    assert (served[15]["address"], served[15]["values"]) == (1001, [1, 1, 1, 1, 0, 0, 0, 0])
    assert (served[11]["address"], served[11]["exception"]) == (961, 2)


def test_samples_are_told_with_the_cells_that_kept_their_values(tmp_path: Path) -> None:
    path, vr = tmp_path / "x.mcap", Channel.vr("press3", "polled")
    with TraceWriter(path) as trace:
        for time, said in ((1000, b'{"C_RunMD":0,"CF_Home":1}'), (2000, b'{"C_RunMD":1}'), (3000, b"[]")):
            trace.add(time, vr, said)
    shown = told(annotated(tmp_path / "out.mcap", path), "/mmsverify/decoded/press3/vr")
    assert [(s["C_RunMD"], s["CF_Home"]) for s in shown] == [(0, 1), (1, 1), (1, 1)]
    assert [bool(s["fault"]) for s in shown] == [False, False, True]


def test_the_report_and_the_verdict_travel_with_the_copy(tmp_path: Path) -> None:
    copy = annotated(tmp_path / "out.mcap", CLIENTS)
    ((name, kind, data),) = copy.attachments
    assert (name, kind) == (REPORT, "application/json")
    expected = document(audited(CLIENTS))
    expected["inputs"][0]["seconds"] = 0.0
    assert json.loads(data) == expected
    verdict: Mapping[str, str] = dict(copy.metadata)[VERDICT]
    assert (verdict["verdict"], verdict["errors"], verdict["messages"]) == ("violated", "1", "58")


def test_what_is_only_counted_is_in_the_report_of_the_copy(tmp_path: Path) -> None:
    audit = replace(audited(FAULTY), findings=[finding(FAULTY, index) for index in range(5)])
    annotate(FAULTY, capped(audit, 2), tmp_path / "out.mcap")
    copy = everything(tmp_path / "out.mcap")
    assert len(told(copy, FINDINGS)) == 2
    assert dict(copy.metadata)[VERDICT]["errors"] == "5"
    assert json.loads(copy.attachments[0][2])["summary"]["violations"] == 5


def test_the_same_call_gives_the_same_octets(tmp_path: Path) -> None:
    for name in ("a.mcap", "b.mcap"):
        annotated(tmp_path / name, FAULTY, finding(FAULTY, 7))
    assert (tmp_path / "a.mcap").read_bytes() == (tmp_path / "b.mcap").read_bytes()


def test_an_audit_of_the_copy_finds_the_same(tmp_path: Path) -> None:
    out = tmp_path / "out.mcap"
    annotated(out, CLIENTS)
    again = audit_traces([out], profile=None, model=None)
    assert [(f.rule, f.message) for f in again.findings] == [
        (f.rule, f.message) for f in audited(CLIENTS).findings
    ]
    assert again.inputs[0].skipped > 0


def test_a_copy_that_is_annotated_again_has_the_new_annotation_alone(tmp_path: Path) -> None:
    once = annotated(tmp_path / "once.mcap", CLIENTS)
    annotate(
        tmp_path / "once.mcap",
        audit_traces([tmp_path / "once.mcap"], profile=None, model=None),
        tmp_path / "twice.mcap",
    )
    twice = everything(tmp_path / "twice.mcap")
    assert len(twice.messages) == len(once.messages)
    assert [name for name, *_ in twice.attachments] == [REPORT]
    assert [name for name, _ in twice.metadata].count(VERDICT) == 1


def test_names_that_are_no_text_are_escaped(tmp_path: Path) -> None:
    odd = replace(finding(FAULTY, 7), message="\udc80<b>", topic="\udc80")
    (entry,) = told(annotated(tmp_path / "out.mcap", FAULTY, odd), FINDINGS)
    assert entry["message"] == "\udc80<b> [R-1]"


def test_of_a_recording_that_is_cut_off_what_is_whole_is_copied(tmp_path: Path) -> None:
    path = tmp_path / "cut.mcap"
    path.write_bytes(odd_recording(tmp_path / "odd.mcap", chunked=False).read_bytes()[:-400])
    copy = annotated(tmp_path / "out.mcap", path)
    assert len([each for each in copy.messages if not each.added]) == len(list(read_trace(path)))
    assert dict(copy.metadata)[VERDICT]["truncated"] == "true"


def test_a_recording_that_cannot_be_read_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(InputError):
        annotate(tmp_path / "none.mcap", Audit([], []), tmp_path / "out.mcap")


def test_the_layout_names_what_annotated_samples_have(tmp_path: Path) -> None:
    fields: dict[str, set[str]] = {}
    for name in ("faulty-select", "faulty-press", "faulty-signals"):
        for each in annotated(tmp_path / f"{name}.mcap", traces_dir() / f"{name}.mcap").messages:
            fields.setdefault(each.topic, set()).update(json.loads(each.data) if each.added else ())
    layout = json.loads((traces_dir().parent / "docs" / "foxglove-layout.json").read_text(encoding="utf-8"))
    panels = layout["configById"]
    for panel in panels.values():
        assert panel.get("topicToRender", FINDINGS) in fields
        for path in [each["value"] for each in panel.get("paths", ())] + [panel.get("topicPath", FINDINGS)]:
            topic, _, field = path.replace('"', "").partition(".")
            assert not field or field in fields[topic], path
            assert topic in fields
    named = set(re.findall(r'"([A-Za-z]+![a-z]+)"', json.dumps([layout["layout"], panels["Tab!devices"]])))
    assert named == set(panels)

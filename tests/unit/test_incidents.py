"""What is shown of a recording around its findings: who said what, and what was known of each device when."""

from __future__ import annotations

from pathlib import Path

import pytest
from mcap.writer import Writer

from mmsverify.audit.replay import Replay
from mmsverify.audit.saying import MOST_FIELDS, Reader, flat
from mmsverify.auditing import audit_traces
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.incident import Incident, Lane
from mmsverify.incidents import AFTER, BEFORE, Watched, dossier, reconstruct, timeline
from mmsverify.profiles import for_recording, within_framework
from mmsverify.resources import traces_dir

SAMPLES = sorted(traces_dir().glob("*.mcap"))


def incident(path: Path) -> Incident:
    return reconstruct(path, audit_traces([path], profile=None, model=None).findings)


def sample(name: str) -> Path:
    return traces_dir() / f"{name}.mcap"


def lanes(path: Path, name: str) -> dict[str, Lane]:
    (device,) = [line for line in timeline(path) if line.device == name]
    return {lane.name: lane for lane in device.lanes}


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_the_same_is_known_by_what_was_learned_and_without(path: Path) -> None:
    trace = read_trace(path)
    tables = within_framework(for_recording(None, trace.profile, trace.path))
    known = []
    for exact in (True, False):
        watched = Watched()
        list(Replay(trace, tables, None, "repaired", exact=exact, watch=watched).run())
        known.append(watched.lanes)
    assert known[0] == known[1]


def test_a_timeline_shows_what_the_status_shows() -> None:
    robot = lanes(sample("faulty-select"), "weld3")
    told = [(change.index, change.words) for change in robot["robot state"].changes]
    assert (32, "ROBOT-EXECUTING") in told
    assert told[0][1]  # what is not known is no change
    assert [change.words for change in robot["selected"].changes][:2] == ["none", "Weld_Door"]
    assert "RUNNING" in {change.words for change in robot["program Weld_Door"].changes}


def test_a_timeline_shows_the_modes_and_commands_of_a_controller() -> None:
    press = lanes(sample("faulty-press"), "press3")
    assert [change.words for change in press["mode"].changes][:3] == ["Idle", "DbgRdy", "Home"]
    assert "home" in {change.words for change in press["command"].changes}


def test_around_a_finding_stand_the_messages_of_its_device() -> None:
    found = incident(sample("faulty-select"))
    messages = {message.index: message for message in read_trace(sample("faulty-select"))}
    for centre, window in found.windows.items():
        assert centre in window
        assert window == sorted(window)
        assert {*range(centre - BEFORE, centre + AFTER + 1)} & messages.keys() <= {*window}
        for index in window:
            assert found.sayings[index].octets == messages[index].data
    said = found.sayings[41]
    assert (said.title, said.answers, said.partner) == ("Select result(+)", 40, "cell-controller")
    assert ("controlling", "Weld_Roof") in found.sayings[40].fields


def test_what_is_related_to_a_finding_is_shown_however_far_it_is() -> None:
    audit = audit_traces([sample("faulty-select")], profile=None, model=None)
    far = [
        found
        for found in audit.findings
        if any(index < (found.index or 0) - BEFORE for index in found.related)
    ]
    shown = incident(sample("faulty-select"))
    assert far
    for found in far:
        assert found.index is not None
        assert {*found.related} <= {*shown.windows[found.index]}


def test_an_answer_across_messages_that_are_not_kept_is_no_answer() -> None:
    shown = incident(sample("faulty-select"))
    for saying in shown.sayings.values():
        if saying.answers is not None:
            assert {*range(saying.answers, saying.index)} <= shown.sayings.keys()


def test_requests_over_modbus_are_paired_by_their_transaction() -> None:
    shown = incident(sample("faulty-signals")).sayings
    assert shown[11].title == "write single coil exception 2"
    assert shown[11].answers == 10
    assert ("address", "961") in shown[10].fields


def test_after_a_link_event_nothing_asked_before_is_answered() -> None:
    reader = Reader()
    asked, answer = list(read_trace(sample("faulty-select")))[40:42]
    assert reader.saying(asked).title == "Select request"
    assert reader.saying(answer).answers == 40
    reader.saying(asked)
    lost = b'{"connection":"cell-controller","role":"mms","event":"reset"}'
    reader.saying(TraceMessage(42, answer.time, Channel.link("weld3"), lost))
    assert reader.saying(answer).answers is None


def test_alternatives_that_are_the_first_two_of_many_are_told() -> None:
    robot = lanes(sample("production-run"), "weld7")
    told = {change.words for change in robot["robot state"].changes}
    assert any(words.startswith("ROBOT-IDLE | ROBOT-LOADED") for words in told)


def test_a_message_of_many_values_is_not_told_without_end(tmp_path: Path) -> None:
    path = tmp_path / "many.mcap"
    with TraceWriter(path) as trace:
        many = ",".join(f'"X{number}":1' for number in range(5000))
        trace.add(1000, Channel.vr("press3", "scan"), f'{{{many},"C_RunMD":99}}'.encode())
    (said,) = incident(path).sayings.values()
    assert len(said.fields) <= MOST_FIELDS + 1


def test_links_and_gaps_stand_on_the_timeline(tmp_path: Path) -> None:
    path = tmp_path / "gap.mcap"
    link = Channel.link("weld9")
    with TraceWriter(path) as trace:
        for time, event in ((1000, "open"), (2000, "gap"), (3000, "close")):
            said = f'{{"connection":"line","role":"mms","event":"{event}"}}'
            trace.add(time, link, said.encode())
    (line,) = timeline(path)
    assert [link.words for link in line.links] == ["open line", "gap line", "close line"]
    assert [gap.time for gap in line.gaps] == [2000]


def test_a_name_may_be_that_of_a_robot_and_of_a_controller(tmp_path: Path) -> None:
    path = tmp_path / "same.mcap"
    with TraceWriter(path) as trace:
        for message in read_trace(sample("faulty-select")):
            trace.add(message.time, message.channel, message.data)
            trace.add(message.time, Channel.vr("weld3", "polled"), b'{"C_RunMD":0}')
    lines = {line.model: line for line in timeline(path)}
    assert (lines["mms-robot"].messages, lines["vr-template"].messages) == (65, 65)
    assert "selected" in {lane.name for lane in lines["mms-robot"].lanes}
    assert lines["vr-template"].lanes[0].name == "mode"


def test_octets_that_nobody_can_read_have_a_fault(tmp_path: Path) -> None:
    path = tmp_path / "bad.mcap"
    with TraceWriter(path) as trace:
        trace.add(1000, Channel.mms("weld9", "line", "client"), b"\xff\x00\x01")
        trace.add(2000, Channel.modbus("robot4", "line", "client"), b"\x00\x01")
        trace.add(3000, Channel.vr("press3", "scan"), b"[]")
    shown = incident(path).sayings
    assert len(shown) == 3
    assert all(saying.fault for saying in shown.values())


def test_of_a_recording_that_is_cut_off_what_could_be_read_is_shown(tmp_path: Path) -> None:
    path, told = tmp_path / "cut.mcap", Channel.vr("press3", "polled")
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=400)
        writer.start()
        schema = writer.register_schema(told.schema_name, "jsonschema", b"{}")
        number = writer.register_channel(told.topic, "json", schema, dict(told.metadata))
        for time in range(1000, 1100):
            writer.add_message(number, time, b'{"C_RunMD":0}', time)
        writer.finish()  # type: ignore[no-untyped-call]
    octets = path.read_bytes()
    path.write_bytes(octets[: len(octets) // 2])
    (line,) = timeline(path)
    assert 0 < line.messages < 100


def test_a_dossier_tells_what_the_cited_statements_and_readings_say() -> None:
    audit = audit_traces(SAMPLES, profile=None, model=None)
    beside = dossier(audit)
    cited = {each for found in audit.findings for each in (*found.clauses, *found.readings)}
    assert cited == beside.statements.keys()
    assert all(beside.statements.values())
    assert beside.incidents.keys() == {entry.path for entry in audit.inputs}
    assert dict(beside.judged)["model"] == "mms-robot, modbus-signals, vr-template"


def test_of_a_recording_that_is_gone_the_findings_stand(tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(sample("faulty-select").read_bytes())
    audit = audit_traces([path], profile=None, model=None)
    path.unlink()
    assert dossier(audit).incidents == {}


def test_values_are_told_by_their_paths_and_not_without_end() -> None:
    deep: list[object] = []
    inner = deep
    for _ in range(100):
        inner.append([])
        inner = inner[0]  # type: ignore[assignment]
    told = dict(
        flat({"a": ("b", {"c": [1, b"\x02\x03"]}), "long": "x" * 1000, "deep": deep, "none": None}, ())
    )
    assert told["a.b.c.0"] == "1"
    assert told["a.b.c.1"] == "02 03"
    assert told["long"].endswith("...")
    assert "none" not in told

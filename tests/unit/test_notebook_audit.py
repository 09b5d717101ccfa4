"""An audit in a notebook: frames, charts, explanations; no text of a recording becomes anything but text."""

from __future__ import annotations

import json
import subprocess
import sys
from functools import cache
from pathlib import Path
from xml.etree import ElementTree as ET

import pandas as pd
import pytest
import vl_convert

import mmsverify as mv
from mmsverify.errors import UsageError
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.notebook import NotebookAudit
from mmsverify.results import Audit, AuditedInput, Finding

HOSTILE = '"><script>alert(1)</script><img src=x onerror=alert(2)>'
SVG_TEXT = "{http://www.w3.org/2000/svg}text"


@cache
def audited(name: str) -> NotebookAudit:
    return mv.audit(mv.sample(name))


def words(svg: str) -> set[str]:
    return {" ".join(each.itertext()).strip() for each in ET.fromstring(svg).iter(SVG_TEXT)}


@pytest.fixture
def hostile(tmp_path: Path) -> NotebookAudit:
    name = HOSTILE.replace("/", "\\")
    path = tmp_path / "hostile.mcap"
    with TraceWriter(path) as trace:
        trace.add(1_000_000, Channel.link(name), b'{"connection": "c", "event": "gap", "role": "mms"}')
        trace.add(2_000_000, Channel.mms(name, name, "client"), b"\xff\x00\x01")
        trace.add(3_000_000, Channel.vr(name, "scan"), json.dumps({HOSTILE: 1, "C_RunMD": "x"}).encode())
    return mv.audit(path)


# Frames.


def test_findings_are_indexed_by_their_capture_time_to_the_nanosecond() -> None:
    findings = audited("faulty-select").findings
    assert str(findings.index.dtype) == "datetime64[ns, UTC]"
    assert findings.index.name == "time"
    assert findings["index"].tolist() == [41, 57]
    assert findings.index[0] == pd.Timestamp("2026-01-05T06:00:25.568000000Z")
    assert {str(findings[name].dtype) for name in ("path", "rule", "severity", "vmd")} == {"category"}
    assert findings["severity"].max() == "error"


def test_a_finding_about_a_file_as_a_whole_has_no_time(tmp_path: Path) -> None:
    path = tmp_path / "broken.mcap"
    path.write_bytes(b"no recording")
    audit = mv.audit([path, mv.sample("faulty-signals")])
    assert sorted(audit.findings.index.isna()) == [False, False, False, True]
    assert audit.inputs["messages"].tolist() == [24]
    with pytest.raises(UsageError, match="as a whole"):
        audit.sequence(around=audit.findings[audit.findings.index.isna()].iloc[0])
    assert "input.unreadable" in audit.explain(audit.findings[audit.findings.index.isna()].iloc[0]).text


def test_events_are_the_messages_of_every_kind() -> None:
    events = audited("faulty-select").events
    assert len(events) == 65
    assert str(events.index.dtype) == "datetime64[ns, UTC]"
    assert events.index.is_monotonic_increasing
    answer = events[events["index"] == 41].iloc[0]
    assert (answer["what"], answer["answers"], answer["sender"]) == ("Select result(+)", 40, "server")
    assert "ROBOT-EXECUTING" in set(events["robot_state"])
    assert set(audited("faulty-signals").events["device"]) == {"robot4"}


def test_of_samples_those_cells_are_told_that_have_changed() -> None:
    events = audited("faulty-press").events
    told = events[events["index"] == 117].iloc[0]["fields"]
    assert "C_RunMD=2" in told
    assert "CS_ErrId" not in told


def test_frames_are_built_when_they_are_asked_for_and_once() -> None:
    audit = mv.audit(mv.sample("faulty-signals"))
    assert "events" not in vars(audit)
    assert audit.events is audit.events
    assert audit.findings is audit.findings


@pytest.mark.parametrize("zone", ["", "Z", "+00:00"])
def test_a_slice_holds_the_messages_of_its_time_alone(zone: str) -> None:
    audit = audited("faulty-select")
    begin, end = f"2026-01-05T06:00:25.5{zone}", f"2026-01-05T06:00:34.968{zone}"
    part = audit.events_between(begin, end)
    whole = audit.events
    kept = whole.loc["2026-01-05T06:00:25.5Z":"2026-01-05T06:00:34.968Z"]
    assert 0 < len(part) < len(whole)
    assert part["index"].tolist() == kept["index"].tolist()
    assert part["answers"].tolist() == kept["answers"].tolist()


def test_a_slice_by_device_leaves_the_others_out() -> None:
    audit = mv.audit([mv.sample("faulty-signals"), mv.sample("faulty-press")])
    assert set(audit.events_between(device="robot4")["device"]) == {"robot4"}
    assert audit.events_between(device="nobody").empty


def test_several_recordings_folders_and_patterns_are_taken() -> None:
    audit = mv.audit(str(mv.sample("faulty-signals").parent / "faulty-[ps]*s*.mcap"), jobs=1)
    assert {Path(path).stem for path in audit.inputs["path"]} >= {"faulty-signals", "faulty-press"}


def test_two_audits_are_compared_by_rule() -> None:
    told = audited("faulty-select").compare(audited("faulty-press"))
    assert told.loc["select.selected-active", "change"] == "gone"
    assert told.loc["org.unhomed", "change"] == "new"
    assert set(audited("faulty-press").compare(audited("faulty-press"))["change"]) == {"as before"}


# Charts.


def test_a_timeline_shows_lanes_and_findings() -> None:
    told = words(audited("faulty-select").timeline().svg())
    assert {"weld3", "robot state", "ROBOT-EXECUTING", "#41 select.selected-active"} <= told


def test_a_timeline_shows_gaps(hostile: NotebookAudit) -> None:
    assert "gap" in words(hostile.timeline().svg())


def test_a_part_of_a_timeline_shows_what_was_known_before() -> None:
    audit = audited("faulty-press")
    told = words(audit.timeline(begin="2026-01-05T06:00:05", end="2026-01-05T06:00:08").svg())
    assert {"Run", "Home", "#117 home.while-running"} <= told
    assert "#311 org.unhomed" not in told


def test_an_unknown_device_or_recording_is_refused_with_those_that_are_there() -> None:
    with pytest.raises(UsageError, match="press3"):
        audited("faulty-press").timeline(device="nobody")
    with pytest.raises(UsageError, match="no recording of this audit"):
        audited("faulty-press").timeline(path="other.mcap")


def test_a_sequence_joins_requests_with_their_answers() -> None:
    audit = audited("faulty-select")
    picture = audit.sequence(around=audit.findings.iloc[0])
    told = words(picture.svg())
    assert {"cell-controller", "weld3", "#41", "Select result(+)"} <= told
    described = json.dumps(picture.chart.to_dict())
    assert '"strokeWidth": 8' in described  # the bar from request to answer


def test_a_chart_holds_a_static_picture_and_one_that_moves() -> None:
    bundle = audited("faulty-press").timeline()._repr_mimebundle_()
    assert {"image/png", "application/vnd.vegalite.v5+json", "text/plain"} <= bundle.keys()
    assert "text/html" not in bundle  # which would fetch a script from elsewhere


def test_a_chart_is_the_same_in_old_viewers() -> None:
    described = audited("faulty-press").timeline().chart.to_dict()
    del described["$schema"]
    versions = vl_convert.get_vegalite_versions()
    drawn = [vl_convert.vegalite_to_svg(described, vl_version=each) for each in (versions[0], versions[-1])]
    assert words(drawn[0]) == words(drawn[1])


@pytest.mark.parametrize("ending", ["svg", "png", "pdf", "json"])
def test_a_chart_is_written_as_its_name_ends(ending: str, tmp_path: Path) -> None:
    path = audited("faulty-signals").timeline().save(tmp_path / f"picture.{ending}")
    begins = {"svg": b"<svg", "png": b"\x89PNG", "pdf": b"%PDF", "json": b"{"}
    assert path.read_bytes().startswith(begins[ending])


def test_another_ending_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="svg, png, pdf"):
        audited("faulty-signals").timeline().save(tmp_path / "picture.bmp")


def test_a_lane_that_changes_all_the_time_is_drawn_in_few_bars() -> None:
    from mmsverify.incident import Change, DeviceLine, Lane
    from mmsverify.report.charts import WIDTH, timeline

    changes = [Change(at, 1_000 * at, str(at % 7)) for at in range(100_000)]
    line = DeviceLine("press", "vr-template", 0, 100_000_000, 100_000, [Lane("mode", changes)])
    finding = Finding("a", 1, 5, "t", "press", "error", "r", ("V",), "m")
    described = timeline([line], [finding] * 10_000).chart.to_dict()
    assert len(json.dumps(described)) < 400 * WIDTH


def test_without_altair_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mmsverify.report.charts", None)
    with pytest.raises(UsageError, match="mmsverify\\[viz\\]"):
        audited("faulty-press").timeline()


# Words.


def test_an_explanation_tells_clause_cause_and_what_would_have_been_legal() -> None:
    told = audited("faulty-select").explain(0).text
    for part in ("R-7.4.4.2-e", "refuses while the program invocation selected so far", "result(-)", "#40"):
        assert part in told


def test_of_a_sample_it_tells_whether_there_is_a_legal_way() -> None:
    assert "no legal way leads to it" in str(audited("faulty-press").explain(0))


def test_a_finding_is_named_by_its_row_its_number_or_itself() -> None:
    audit = audited("faulty-select")
    second = audit.finding(1)
    assert audit.finding(audit.findings.iloc[1]) is second
    assert audit.finding(second) is second
    with pytest.raises(UsageError, match="not a finding of this audit"):
        audit.finding(audited("faulty-press").findings.iloc[0])


def test_an_audit_shows_itself() -> None:
    shown = audited("faulty-select")._repr_html_()
    assert "faulty-select.mcap" in shown
    assert "start.not-selected" in shown
    assert "2 violations" in repr(audited("faulty-select"))


def test_no_text_of_a_recording_becomes_markup(hostile: NotebookAudit) -> None:
    shown = [hostile._repr_html_(), hostile.timeline().svg()]
    shown += [hostile.explain(number)._repr_html_() for number in range(len(hostile.findings))]
    shown += [hostile.sequence(around=number).svg() for number in range(len(hostile.findings))]
    assert len(hostile.findings) >= 2
    assert any("&lt;img" in each for each in shown)
    for each in shown:
        assert "<script" not in each
        assert "<img" not in each


def test_a_path_cannot_be_markup_either() -> None:
    found = Finding(HOSTILE, None, None, None, None, "error", HOSTILE, (HOSTILE,), HOSTILE)
    audit = NotebookAudit(Audit([AuditedInput(HOSTILE, 0, 0, 0, False, 0.0)], [found]))
    assert "<script" not in audit._repr_html_()
    assert "<img" not in audit.explain(0)._repr_html_()


# The names of the package.


LIGHT = """
import sys
import mmsverify as mv
import mmsverify.audit.replay
assert not {"pandas", "altair", "numpy", "z3", "mmsverify.notebook"} & set(sys.modules)
assert callable(mv.audit) and callable(mv.model) and mmsverify.audit.replay.Replay
audit = mv.audit(mv.sample("faulty-signals"))
assert not {"altair", "z3", "networkx"} & set(sys.modules)
assert "access.dedicated" in set(audit.findings["rule"])
import pickle, inspect
assert pickle.loads(pickle.dumps([mv, mv.audit])) == [mv, mmsverify.audit]
assert "profile" in inspect.signature(mv.audit).parameters
assert {"audit", "check", "model", "sample"} <= set(dir(mv))
"""


def test_the_package_stays_light_until_a_name_is_used() -> None:
    done = subprocess.run([sys.executable, "-c", LIGHT], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_sample_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(UsageError, match="faulty-select"):
        mv.sample("nothing")


def test_a_name_that_is_not_there_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="nothing"):
        mv.nothing  # type: ignore[attr-defined]  # noqa: B018

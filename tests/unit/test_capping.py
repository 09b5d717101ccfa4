"""At most so many findings of a rule and device are told; the counts stay true, in every format."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from report_samples import READ, SELECT, START

from mmsverify.cli import main
from mmsverify.formats.mcap import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.report import AUDIT_FORMATS, render_audit
from mmsverify.report.capping import capped
from mmsverify.results import Audit, Finding, Severity, Withheld


def findings(number: int, severity: Severity = "error", vmd: str = "cell7") -> list[Finding]:
    return [replace(SELECT, index=index, severity=severity, vmd=vmd) for index in range(number)]


MANY = Audit([READ], [*findings(9), *findings(4, vmd="cell8"), *findings(2, "note", "cell9"), START])
FEW = capped(MANY, 3)


def test_each_rule_and_device_is_told_so_often_and_the_rest_is_counted() -> None:
    assert [finding.index for finding in FEW.findings if finding.vmd == "cell7"] == [0, 1, 2, 4]
    assert FEW.withheld == (
        Withheld("a.mcap", "cell7", SELECT.rule, "error", 6),
        Withheld("a.mcap", "cell8", SELECT.rule, "error", 1),
    )
    assert capped(MANY, None) is MANY
    assert capped(MANY, 9).withheld == ()


def test_errors_are_told_before_notes_however_late_they_come() -> None:
    late = [*findings(5, "note"), replace(SELECT, index=90)]
    told = capped(Audit([READ], late), 2)
    assert [(finding.severity, finding.index) for finding in told.findings] == [("note", 0), ("error", 90)]
    assert told.withheld == (Withheld("a.mcap", "cell7", SELECT.rule, "note", 4),)


def test_each_recording_has_its_own_number() -> None:
    others = [replace(finding, path="b.mcap") for finding in findings(3)]
    told = capped(Audit([READ], [*findings(3), *others]), 2)
    assert [(rest.path, rest.count) for rest in told.withheld] == [("a.mcap", 1), ("b.mcap", 1)]


def test_json_counts_all_of_them() -> None:
    told = json.loads(render_audit(FEW, "json"))
    assert told["summary"] == {"violations": 16, "errors": 13, "warnings": 1, "notes": 2}
    assert len(told["violations"]) == 9
    assert [(rest["vmd"], rest["count"]) for rest in told["withheld"]] == [("cell7", 6), ("cell8", 1)]
    assert "withheld" not in json.loads(render_audit(MANY, "json"))


@pytest.mark.parametrize("format", ["text", "html"])
def test_people_are_told_the_true_counts(format: str) -> None:
    page = render_audit(FEW, format)
    assert "16 violations (13 errors, 1 warning, 2 notes)" in page
    assert "6 more of cell7, not told (--max-per-rule)" in page


def test_text_tells_what_it_leaves_out() -> None:
    lines = render_audit(FEW, "text").splitlines()
    rule = "select.controlled-elsewhere"
    assert f"  ERROR  {rule}  6 more of cell7, not told (--max-per-rule)" in lines
    assert f"  ERROR  {rule}  1 more of cell8, not told (--max-per-rule)" in lines


def test_sarif_notifies_of_what_it_leaves_out() -> None:
    (run,) = json.loads(render_audit(FEW, "sarif"))["runs"]
    assert len(run["results"]) == 9
    (invocation,) = run["invocations"]
    told = invocation["toolExecutionNotifications"]
    assert [each["properties"]["count"] for each in told] == [6, 1]
    assert {each["associatedRule"]["id"] for each in told} == {SELECT.rule}


def test_junit_counts_what_it_leaves_out() -> None:
    root = ElementTree.fromstring(render_audit(FEW, "junit"))
    (failure,) = root.iter("failure")
    assert str(failure.get("message")).endswith("(and 12 more events)")
    assert str(failure.text).endswith("7 more, not told (--max-per-rule)")


def faulty(path: Path, samples: int = 40) -> Path:
    """A controller whose every second sample is no sample."""
    vr = Channel.vr("press3", "polled")
    with TraceWriter(path) as trace:
        for index in range(samples):
            trace.add(1_000 + index, vr, b"[]" if index % 2 else b'{"C_RunMD":0,"CS_RunSTA":0}')
    return path


def status(*arguments: str) -> int:
    return main(["audit", "-q", *arguments])


@pytest.mark.parametrize("format", AUDIT_FORMATS)
def test_the_exit_status_is_that_of_all_findings(format: str, tmp_path: Path) -> None:
    trace, out = str(faulty(tmp_path / "a.mcap")), str(tmp_path / "out")
    options = [trace, "--format", format, "--max-per-rule", "1", "-o", out]
    assert status(*options) == 1
    assert status(*options, "--exit-zero") == 0
    assert status(*options, "--strict") == 1


def test_a_dataset_counts_all_of_them(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    trace, out = str(faulty(tmp_path / "a.mcap")), tmp_path / "set"
    options = [trace, "--format", "parquet", "-o", str(out), "--max-per-rule", "1"]
    assert status(*options, "--exit-zero") == 0
    rows = parquet.read_table(out / "inputs").to_pylist()
    told = parquet.read_table(out / "findings").to_pylist()
    counted = [row["errors"] + row["warnings"] + row["notes"] for row in rows]
    assert counted == [len(told) + rows[0]["withheld"]]
    assert rows[0]["withheld"] > 0


@pytest.fixture
def found(monkeypatch: pytest.MonkeyPatch) -> Callable[[Sequence[Finding]], None]:
    """Lets every audit find the same."""

    def find(findings: Sequence[Finding]) -> None:
        audit = Audit([READ], list(findings))
        monkeypatch.setattr("mmsverify.auditing.audit_traces", lambda *_, **__: audit)
        monkeypatch.setattr("mmsverify.auditing.audit_each", lambda *_, **__: iter([audit]))

    return find


@pytest.mark.parametrize("format", [*AUDIT_FORMATS, "parquet"])
@pytest.mark.parametrize(
    ("severity", "options", "expected"),
    [
        ("warning", [], 0), ("warning", ["--strict"], 1), ("warning", ["--exit-zero"], 0),
        ("note", ["--strict"], 0), ("error", ["--strict"], 1), ("error", ["--exit-zero"], 0),
    ],
)  # fmt: skip
def test_which_findings_fail_can_be_chosen_in_every_format(
    severity: Severity, options: list[str], expected: int, format: str, tmp_path: Path, found: Any
) -> None:
    if format == "parquet":
        pytest.importorskip("pyarrow.parquet")
    found(findings(2, severity))
    assert status("a.mcap", *options, "--format", format, "-o", str(tmp_path / "out")) == expected


def test_what_cannot_be_read_stays_a_bad_request(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert status(str(tmp_path / "none.mcap"), "--exit-zero") == 2
    assert status("a.mcap", "--exit-zero", "--strict") == 2
    assert "--strict: not with --exit-zero" in capsys.readouterr().err
    assert status("a.mcap", "--max-per-rule", "0") == 2


def test_the_help_names_the_options(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["audit", "--help"]) == 0
    page = capsys.readouterr().out
    assert all(option in page for option in ("--exit-zero", "--strict", "--max-per-rule"))

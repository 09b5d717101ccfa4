"""SARIF and JUnit are what the schemas of `tests/schemas` say, by which dashboards and servers read them."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import xmlschema
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft4Validator
from report_samples import AUDIT, CLEAN, HOSTILE, READ, SELECT, START, UNREADABLE

from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.incident import Dossier
from mmsverify.incidents import statements
from mmsverify.report import render_audit
from mmsverify.report.capping import capped
from mmsverify.resources import traces_dir
from mmsverify.results import Audit

SCHEMAS = Path(__file__).parents[1] / "schemas"
SAMPLES = sorted(traces_dir().glob("*.mcap"))
DOSSIER = Dossier(statements={"R-7.4.4.2-d": "what it says"})
MANY = Audit([READ], [replace(START, index=index) for index in range(9)] + [SELECT, UNREADABLE])
AUDITS = {
    "usual": AUDIT, "clean": CLEAN, "nothing": Audit([], []), "capped": capped(MANY, 2),
    "hostile": Audit([READ], [replace(SELECT, topic=HOSTILE, message=HOSTILE, vmd=HOSTILE, rule=HOSTILE)]),
}  # fmt: skip


@cache
def sarif_schema() -> Draft4Validator:
    return Draft4Validator(json.loads((SCHEMAS / "sarif-2.1.0-rtm.5.json").read_text(encoding="utf-8")))


@cache
def junit_schema() -> xmlschema.XMLSchema:
    return xmlschema.XMLSchema(str(SCHEMAS / "junit-10.xsd"))


def sarif(audit: Audit) -> Any:
    log = json.loads(render_audit(audit, "sarif", DOSSIER))
    sarif_schema().validate(log)
    return log["runs"][0]


@pytest.mark.parametrize("name", AUDITS)
def test_sarif_is_what_its_schema_says(name: str) -> None:
    assert sarif(AUDITS[name])["tool"]["driver"]["name"] == "mmsverify"


@pytest.mark.parametrize("name", AUDITS)
def test_junit_is_what_its_schema_says(name: str) -> None:
    junit_schema().validate(render_audit(AUDITS[name], "junit"))


def test_the_schemas_refuse_what_is_wrong() -> None:
    log = json.loads(render_audit(AUDIT, "sarif"))
    log["runs"][0]["results"][0]["level"] = "fatal"
    assert not sarif_schema().is_valid(log)
    assert not junit_schema().is_valid(render_audit(AUDIT, "junit").replace("testcase", "case"))


@settings(max_examples=25, deadline=None)
@given(st.text(st.characters(exclude_categories=()), max_size=20))
def test_no_text_of_a_recording_breaks_either(text: str) -> None:
    finding = replace(SELECT, topic=text, message=text, observed=text, rule=text, path=text, vmd=text)
    audit = Audit([replace(READ, path=text)], [finding, finding])
    sarif(capped(audit, 1))
    junit_schema().validate(render_audit(capped(audit, 1), "junit"))


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_of_every_sample_both_are_valid_and_every_rule_has_help(path: Path) -> None:
    audit = audit_traces([path], profile=None, model=None)
    log = json.loads(render_audit(audit, "sarif", Dossier(statements=statements(audit))))
    sarif_schema().validate(log)
    junit_schema().validate(render_audit(audit, "junit"))
    for rule in log["runs"][0]["tool"]["driver"]["rules"]:
        assert not rule["shortDescription"]["text"].startswith("mmsverify's rule"), rule["id"]


def test_the_command_tells_what_the_clauses_say(tmp_path: Path) -> None:
    out, trace = tmp_path / "x.sarif", traces_dir() / "two-clients.mcap"
    assert main(["audit", str(trace), "-q", "--format", "sarif", "-o", str(out)]) == 1
    (rule,) = json.loads(out.read_text(encoding="utf-8"))["runs"][0]["tool"]["driver"]["rules"]
    said = statements(audit_traces([trace], profile=None, model=None))
    assert rule["help"]["text"] == f"R-7.3.3.4.1-b: {said['R-7.3.3.4.1-b']}"
    assert "- **R-7.3.3.4.1-b** " in rule["help"]["markdown"]


def test_rules_carry_levels_and_clauses_in_words() -> None:
    rules = {rule["id"]: rule for rule in sarif(AUDIT)["tool"]["driver"]["rules"]}
    select, start = rules["select.controlled-elsewhere"], rules["start.direct"]
    assert select["fullDescription"]["text"] == "what it says"
    assert select["defaultConfiguration"]["level"] == "error"
    assert start["defaultConfiguration"]["level"] == "warning"
    assert start["help"]["text"] == "mmsverify's rule start.direct"


def test_a_message_is_a_line_so_that_dashboards_can_show_it() -> None:
    by_rule = {result["ruleId"]: result for result in sarif(AUDIT)["results"]}
    results = [by_rule[rule] for rule in ("input.unreadable", "start.direct", "select.controlled-elsewhere")]
    lines = [r["locations"][0]["physicalLocation"]["region"] for r in results]
    assert lines == [{"startLine": 1}, {"startLine": 5}, {"startLine": 18}]


def test_a_fingerprint_outlasts_messages_that_come_before_and_tells_likes_apart() -> None:
    def prints(*indices: int) -> list[str]:
        findings = [replace(SELECT, index=index, related=()) for index in indices]
        found = [result["partialFingerprints"] for result in sarif(Audit([READ], findings))["results"]]
        assert all(each["primaryLocationLineHash"] == each["mmsverifyFinding/v1"] for each in found)
        return [each["primaryLocationLineHash"] for each in found]

    assert prints(17, 30) == prints(1017, 1030)
    assert len({*prints(17, 30)}) == 2
    other = sarif(Audit([READ], [replace(SELECT, message="another")]))["results"][0]["partialFingerprints"]
    assert other["primaryLocationLineHash"] not in prints(17)


def test_only_relative_paths_begin_at_the_root_of_what_is_scanned() -> None:
    def place(path: str) -> dict[str, str]:
        told = sarif(Audit([replace(READ, path=path)], []))
        found: dict[str, str] = told["artifacts"][0]["location"]
        return found

    assert place("logs/a.mcap") == {"uri": "logs/a.mcap", "uriBaseId": "%SRCROOT%"}
    assert place("/logs/a.mcap") == {"uri": "file:///logs/a.mcap"}
    assert place("../a.mcap") == {"uri": "../a.mcap"}
    assert place("s3://plant/a.mcap") == {"uri": "s3://plant/a.mcap"}

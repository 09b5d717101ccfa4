"""SARIF output has the shape that SARIF 2.1.0 asks for, so that dashboards take it."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from report_samples import AUDIT, CLEAN, HOSTILE, READ, SELECT

from mmsverify.report import render_audit
from mmsverify.results import Audit


def run(audit: Audit) -> Any:
    log = json.loads(render_audit(audit, "sarif"))
    assert log["version"] == "2.1.0"
    assert log["$schema"].endswith("sarif-schema-2.1.0.json")
    assert len(log["runs"]) == 1
    return log["runs"][0]


def uri(path: str) -> str:
    audit = Audit([replace(READ, path=path)], [replace(SELECT, path=path)])
    found: str = run(audit)["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    return found


def test_every_result_points_at_its_rule_and_its_artifact() -> None:
    told = run(AUDIT)
    rules = told["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == [
        "input.unreadable",
        "select.controlled-elsewhere",
        "start.direct",
    ]
    assert len(told["results"]) == 3
    for result in told["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
        place = result["locations"][0]["physicalLocation"]["artifactLocation"]
        assert told["artifacts"][place["index"]]["location"]["uri"] == place["uri"]


def test_results_have_what_the_schema_requires_and_nothing_of_another_type() -> None:
    for result in run(AUDIT)["results"]:
        assert result["level"] in {"error", "warning", "note"}
        assert result["message"]["text"]
        assert all(isinstance(tag, str) for tag in result["properties"].get("tags", []))
        assert result.get("occurrenceCount", 1) >= 1
        assert None not in result["properties"].values()


def test_a_finding_is_placed_by_topic_and_index_and_tagged_by_clause() -> None:
    (result,) = run(Audit([READ], [SELECT]))["results"]
    (place,) = result["locations"][0]["logicalLocations"]
    assert place == {"name": "#17", "fullyQualifiedName": "/cell7/mms/a1/server#17", "kind": "message"}
    assert result["properties"]["tags"] == ["R-7.4.4.2-d"]
    assert result["properties"]["time"] == 1764000000123456789
    assert [related["id"] for related in result["relatedLocations"]] == [3, 9, 16]


def test_a_rule_carries_every_clause_it_was_broken_under() -> None:
    other = replace(SELECT, index=18, clauses=("R-7.4.4.2-b",))
    (rule,) = run(Audit([READ], [SELECT, other]))["tool"]["driver"]["rules"]
    assert rule["properties"]["tags"] == ["R-7.4.4.2-b", "R-7.4.4.2-d"]


def test_a_whole_file_finding_has_no_logical_location() -> None:
    unreadable = run(AUDIT)["results"][-1]
    assert unreadable["ruleId"] == "input.unreadable"
    assert "logicalLocations" not in unreadable["locations"][0]


def test_a_clean_audit_is_a_run_without_results() -> None:
    told = run(CLEAN)
    assert told["results"] == []
    amounts = {"messages": 1204, "events": 1200, "skipped": 4, "truncated": False}
    place = {"uri": "a.mcap", "uriBaseId": "%SRCROOT%"}
    assert told["artifacts"] == [{"location": place, "roles": ["analysisTarget"], "properties": amounts}]
    assert told["invocations"] == [{"executionSuccessful": True}]


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("a b.mcap", "a%20b.mcap"),
        ("/tmp/ä.mcap", "file:///tmp/%C3%A4.mcap"),
        ("a:b#c?.mcap", "a%3Ab%23c%3F.mcap"),
        ("\udc80.mcap", "%80.mcap"),
    ],
)
def test_a_path_becomes_a_valid_uri(path: str, expected: str) -> None:
    assert uri(path) == expected


def test_hostile_names_leave_the_log_readable() -> None:
    (result,) = run(Audit([READ], [replace(SELECT, topic=HOSTILE)]))["results"]
    assert result["properties"]["topic"] == HOSTILE

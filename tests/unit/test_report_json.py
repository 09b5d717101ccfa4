"""Results as JSON have the keys, the order and the stability that other people's scripts rely on."""

from __future__ import annotations

import json
from dataclasses import replace
from enum import Enum
from typing import Any

from report_samples import AUDIT, CHECK, HOSTILE, READ, SELECT, START

from mmsverify.report import render_audit, render_check
from mmsverify.results import Audit, Finding, ModelCheck


def audited(audit: Audit) -> Any:
    return json.loads(render_audit(audit, "json"))


def checked(check: ModelCheck) -> Any:
    return json.loads(render_check([check], "json"))


def before(value: Any) -> Any:
    return audited(Audit([READ], [replace(SELECT, before={"cell": value})]))["violations"][0]["before"][
        "cell"
    ]


def test_an_audit_has_the_keys_of_its_schema_in_their_order() -> None:
    told = audited(AUDIT)
    assert list(told) == ["schema", "inputs", "summary", "violations"]
    assert told["schema"] == "mmsverify.audit/1"
    assert told["inputs"] == [
        {
            "path": "a.mcap",
            "messages": 1204,
            "events": 1200,
            "skipped": 4,
            "truncated": False,
            "seconds": 0.3123,
        }
    ]


def test_a_violation_tells_every_field_of_its_finding() -> None:
    violation = audited(Audit([READ], [SELECT]))["violations"][0]
    assert violation == {
        "path": "a.mcap",
        "index": 17,
        "time": 1764000000123456789,
        "topic": "/cell7/mms/a1/server",
        "vmd": "cell7",
        "severity": "error",
        "rule": "select.controlled-elsewhere",
        "clauses": ["R-7.4.4.2-d"],
        "readings": [],
        "message": "Select answered result(+), but R_ARM is controlled by 'Paint'",
        "expected": ["result(-)"],
        "observed": "result(+)",
        "before": {
            "control": {"Paint": {"oneOf": ["CONTROLLING", "NORMAL"]}, "R_ARM": "CONTROLLED"},
            "selected": [],
        },
        "related": [3, 9, 16],
    }


def test_a_count_is_told_only_where_a_finding_stands_for_several_events() -> None:
    once, often = audited(Audit([READ], [SELECT, START]))["violations"][::-1]
    assert "count" not in once
    assert often["count"] == 5


def test_the_summary_counts_findings_by_severity() -> None:
    assert audited(AUDIT)["summary"] == {"violations": 3, "errors": 2, "warnings": 1, "notes": 0}


def test_violations_stand_in_the_order_of_path_and_index_however_they_were_found() -> None:
    reverse = Audit(AUDIT.inputs, list(reversed(AUDIT.findings)))
    assert render_audit(reverse, "json") == render_audit(AUDIT, "json")
    assert [(v["path"], v["index"]) for v in audited(AUDIT)["violations"]] == [
        ("a.mcap", 4),
        ("a.mcap", 17),
        ("b.mcap", None),
    ]


def test_a_finding_about_the_whole_file_stands_before_those_of_its_messages() -> None:
    whole = replace(SELECT, index=None, time=None)
    assert [v["index"] for v in audited(Audit([READ], [SELECT, whole]))["violations"]] == [None, 17]


def test_hostile_names_survive_unchanged_in_plain_ascii() -> None:
    finding: Finding = replace(SELECT, topic=HOSTILE)
    text = render_audit(Audit([READ], [finding]), "json")
    assert text.isascii()
    assert json.loads(text)["violations"][0]["topic"] == HOSTILE


def test_sets_and_alternatives_are_sorted_numbers_by_size() -> None:
    assert before({"oneOf": [10, 9, -2]}) == {"oneOf": [-2, 9, 10]}
    assert before(frozenset({"b", "a"})) == ["a", "b"]
    assert before({"oneOf": ["b", 3, True]}) == {"oneOf": [3, True, "b"]}


def test_an_enumeration_is_told_by_its_name_and_no_number_is_infinite() -> None:
    class Mode(Enum):
        IDLE = 1

    assert before(Mode.IDLE) == "IDLE"
    assert before(float("inf")) == "inf"
    assert before(1.5) == 1.5


def test_a_check_has_the_keys_of_its_schema_in_their_order() -> None:
    told = checked(CHECK)
    assert told["schema"] == "mmsverify.check/1"
    model = told["models"][0]
    assert (model["model"], model["variant"], model["notes"]) == (
        "mms-robot",
        "as-written",
        ["two rows overlap"],
    )
    assert list(model["properties"][0]) == [
        "name", "kind", "clauses", "result", "method", "scope", "depth", "seconds", "counterexample",
        "witness",
    ]  # fmt: skip


def test_properties_that_a_profile_leaves_out_are_listed() -> None:
    assert "left_out" not in checked(CHECK)["models"][0]
    assert checked(replace(CHECK, left_out=("a", "b")))["models"][0]["left_out"] == ["a", "b"]


def test_a_counterexample_is_told_step_by_step_with_the_whole_state() -> None:
    broken, reached, _ = checked(CHECK)["models"][0]["properties"]
    assert broken["witness"] is None
    assert broken["counterexample"]["steps"][1] == {
        "action": "select",
        "arguments": {"pi": "A"},
        "clauses": ["R-7.4.4.2-f1"],
        "state": {"control": {"A": "CONTROLLING"}, "selected": ["A"]},
    }
    assert reached["counterexample"] is None
    assert [step["action"] for step in reached["witness"]["steps"]] == ["create"]


def test_only_an_undecided_property_gives_a_reason() -> None:
    broken, _, unknown = checked(CHECK)["models"][0]["properties"]
    assert unknown["reason"] == "time limit of 10 s reached"
    assert "reason" not in broken

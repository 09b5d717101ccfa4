"""An audit as SARIF 2.1.0 (OASIS Standard, 27 March 2020), for code-scanning dashboards and editors.

A finding has no line in a text file: its place is a logical location, the message's topic and index (SARIF
3.33), inside the trace as an artifact (3.28). The standard's clauses are tags of rules and results.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from urllib.parse import quote

import mmsverify
from mmsverify.report.order import by_input, ordered
from mmsverify.report.wording import instant, plain, printable
from mmsverify.results import Audit, AuditedInput, Finding

VERSION = "2.1.0"
SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"


def render(audit: Audit) -> str:
    log = {"$schema": SCHEMA, "version": VERSION, "runs": [_run(audit)]}
    return json.dumps(log, indent=2, ensure_ascii=True) + "\n"


def _run(audit: Audit) -> dict[str, Any]:
    rules = _rules(audit.findings)
    inputs = [(path, entry) for path, entry, _ in by_input(audit)]
    rule_at = {rule["id"]: number for number, rule in enumerate(rules)}
    path_at = {path: number for number, (path, _) in enumerate(inputs)}
    return {
        "tool": {"driver": {"name": "mmsverify", "version": mmsverify.__version__, "rules": rules}},
        "artifacts": [_artifact(path, entry) for path, entry in inputs],
        "results": [
            _result(finding, rule_at[finding.rule], path_at[finding.path])
            for finding in ordered(audit.findings)
        ],
    }


def _artifact(path: str, entry: AuditedInput | None) -> dict[str, Any]:
    artifact: dict[str, Any] = {"location": {"uri": _uri(path)}}
    if entry is not None:
        artifact["properties"] = {
            "messages": entry.messages,
            "events": entry.events,
            "skipped": entry.skipped,
            "truncated": entry.truncated,
        }
    return artifact


def _rules(findings: Iterable[Finding]) -> list[dict[str, Any]]:
    """The rules that found something, each with every clause it was broken under."""
    clauses: dict[str, set[str]] = {}
    for finding in findings:
        clauses.setdefault(finding.rule, set()).update(finding.clauses)
    return [{"id": rule, "properties": {"tags": sorted(clauses[rule])}} for rule in sorted(clauses)]


def _result(finding: Finding, rule: int, artifact: int) -> dict[str, Any]:
    result = {
        "ruleId": finding.rule,
        "ruleIndex": rule,
        "level": finding.severity,
        "message": {"text": finding.message or finding.rule},
        "locations": [_location(finding, artifact)],
        "relatedLocations": [
            {"id": index, "logicalLocations": [{"name": f"#{index}", "kind": "message"}]}
            for index in sorted({*finding.related})
        ],
        "properties": _properties(finding),
    }
    if not finding.related:
        del result["relatedLocations"]
    return result | ({"occurrenceCount": finding.count} if finding.count > 1 else {})


def _location(finding: Finding, artifact: int) -> dict[str, Any]:
    uri = {"uri": _uri(finding.path), "index": artifact}
    location: dict[str, Any] = {"physicalLocation": {"artifactLocation": uri}}
    if finding.index is not None:
        location["logicalLocations"] = [_message(finding.index, printable(finding.topic or ""))]
    return location


def _message(index: int, topic: str) -> dict[str, str]:
    return {"name": f"#{index}", "fullyQualifiedName": f"{topic}#{index}", "kind": "message"}


def _properties(finding: Finding) -> dict[str, Any]:
    told = {
        "tags": list(dict.fromkeys((*finding.clauses, *finding.readings))),
        "index": finding.index,
        "time": finding.time,
        "instant": None if finding.time is None else instant(finding.time),
        "topic": finding.topic,
        "vmd": finding.vmd,
        "expected": list(finding.expected),
        "observed": finding.observed,
        "before": plain(finding.before),
        "related": list(finding.related),
    }
    return {name: value for name, value in told.items() if value not in (None, "", [], {})}


def _uri(path: str) -> str:
    """A URI reference: relative paths stay relative, octets outside the URI alphabet are percent-encoded."""
    if "://" in path:  # the URL of a remote recording
        return quote(path, safe="%/:?#[]@!$&'()*+,;=~")
    octets = quote(os.fsencode(Path(path).as_posix()))
    return f"file://{octets}" if octets.startswith("/") else octets

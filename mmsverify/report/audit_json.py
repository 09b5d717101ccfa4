"""An audit as JSON, schema ``mmsverify.audit/1``. Its keys are stable; new ones may be added."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from mmsverify.report.order import ordered, tally
from mmsverify.report.wording import plain, seconds
from mmsverify.results import Audit, AuditedInput, Finding

SCHEMA = "mmsverify.audit/1"


def render(audit: Audit) -> str:
    # ASCII: file names that are not valid text survive as escapes, whatever the encoding of stdout.
    return json.dumps(document(audit), indent=2, ensure_ascii=True) + "\n"


def document(audit: Audit) -> dict[str, Any]:
    """The audit as JSON's types; ``withheld`` stands there where findings are counted and not told."""
    counts = tally(audit.findings, audit.withheld)
    told = {
        "schema": SCHEMA,
        "inputs": [summary(entry) for entry in audit.inputs],
        "summary": {
            "violations": sum(counts.values()),
            "errors": counts["error"],
            "warnings": counts["warning"],
            "notes": counts["note"],
        },
        "violations": [violation(finding) for finding in ordered(audit.findings)],
    }
    return told | ({"withheld": [asdict(rest) for rest in audit.withheld]} if audit.withheld else {})


def summary(entry: AuditedInput) -> dict[str, Any]:
    """How a recording was read."""
    return {
        "path": entry.path,
        "messages": entry.messages,
        "events": entry.events,
        "skipped": entry.skipped,
        "truncated": entry.truncated,
        "seconds": seconds(entry.seconds),
    }


def violation(finding: Finding) -> dict[str, Any]:
    """A finding; ``count`` stands there where it is not 1."""
    told = {
        "path": finding.path,
        "index": finding.index,
        "time": finding.time,
        "topic": finding.topic,
        "vmd": finding.vmd,
        "severity": finding.severity,
        "rule": finding.rule,
        "clauses": list(finding.clauses),
        "readings": list(finding.readings),
        "message": finding.message,
        "expected": list(finding.expected),
        "observed": finding.observed,
        "before": plain(finding.before),
        "related": list(finding.related),
    }
    return told | ({"count": finding.count} if finding.count > 1 else {})

"""An audit as SARIF 2.1.0 (OASIS Standard, 27 March 2020), for code-scanning dashboards and editors.

A message of a recording has no line in a text. Its place is a logical location, topic and index (SARIF 3.33),
inside the recording as an artifact (3.28). Dashboards that show nothing without a line get the message's
number, counted from 1, as one (3.30). The standard's clauses are tags of rules and results, and what they
say, in the project's words, is the help of the rules.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import quote

import mmsverify
from mmsverify.report.order import SEVERITIES, by_input, ordered
from mmsverify.report.wording import instant, plain, printable
from mmsverify.results import Audit, AuditedInput, Finding, Withheld

VERSION = "2.1.0"
SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
ROOT = "%SRCROOT%"
"""The name for the folder that relative paths begin at, as dashboards know it."""
UNREADABLE = "input.unreadable"
FINGERPRINTS = ("primaryLocationLineHash", "mmsverifyFinding/v1")
"""Under the first name dashboards look for what tells a finding from others, run by run."""


def render(audit: Audit, statements: Mapping[str, str] | None = None) -> str:
    """The log. ``statements``: what clauses and readings say, by id; without them rules have no help."""
    log = {"$schema": SCHEMA, "version": VERSION, "runs": [_run(audit, statements or {})]}
    return json.dumps(log, indent=2, ensure_ascii=True) + "\n"


def _run(audit: Audit, statements: Mapping[str, str]) -> dict[str, Any]:
    rules = _rules(audit.findings, statements)
    inputs = [(path, entry) for path, entry, _ in by_input(audit)]
    rule_at = {rule["id"]: number for number, rule in enumerate(rules)}
    path_at = {path: number for number, (path, _) in enumerate(inputs)}
    prints: Counter[str] = Counter()
    return {
        "tool": {"driver": {"name": "mmsverify", "version": mmsverify.__version__, "rules": rules}},
        "automationDetails": {"id": "mmsverify/audit/"},
        "columnKind": "unicodeCodePoints",
        "invocations": [_invocation(audit, rule_at)],
        "artifacts": [_artifact(path, entry) for path, entry in inputs],
        "results": [
            _result(finding, rule_at[finding.rule], path_at[finding.path], _fingerprint(finding, prints))
            for finding in ordered(audit.findings)
        ],
    }


def _invocation(audit: Audit, rule_at: Mapping[str, int]) -> dict[str, Any]:
    """Whether all could be read, and what is counted and not among the results."""
    unread = any(finding.rule == UNREADABLE for finding in audit.findings)
    told: dict[str, Any] = {"executionSuccessful": not unread}
    if audit.withheld:
        told["toolExecutionNotifications"] = [_left_out(rest, rule_at) for rest in audit.withheld]
    return told


def _left_out(rest: Withheld, rule_at: Mapping[str, int]) -> dict[str, Any]:
    device = f" of {printable(rest.vmd)}" if rest.vmd else ""
    text = f"{rest.count} more of {printable(rest.rule)}{device} ({rest.severity}) are not among the results"
    return {
        "level": "note",
        "message": {"text": text},
        "associatedRule": {"id": rest.rule, "index": rule_at[rest.rule]},
        "locations": [{"physicalLocation": {"artifactLocation": _place(rest.path)}}],
        "properties": {"count": rest.count, "severity": rest.severity, "vmd": rest.vmd or ""},
    }


def _artifact(path: str, entry: AuditedInput | None) -> dict[str, Any]:
    artifact: dict[str, Any] = {"location": _place(path), "roles": ["analysisTarget"]}
    if entry is not None:
        artifact["properties"] = {
            "messages": entry.messages,
            "events": entry.events,
            "skipped": entry.skipped,
            "truncated": entry.truncated,
        }
    return artifact


# Rules.


def _rules(findings: Iterable[Finding], statements: Mapping[str, str]) -> list[dict[str, Any]]:
    """The rules that found something, each with every clause it was broken under."""
    found: dict[str, list[Finding]] = {}
    for finding in findings:
        found.setdefault(finding.rule, []).append(finding)
    return [_rule(rule, found[rule], statements) for rule in sorted(found)]


def _rule(rule: str, findings: Sequence[Finding], statements: Mapping[str, str]) -> dict[str, Any]:
    clauses = sorted({clause for finding in findings for clause in finding.clauses})
    level = min((finding.severity for finding in findings), key=SEVERITIES.index)
    readings = sorted({reading for finding in findings for reading in finding.readings})
    said = [(cited, statements[cited]) for cited in (*clauses, *readings) if cited in statements]
    short = said[0][1] if said else f"mmsverify's rule {printable(rule)}"
    text = "\n".join(f"{clause}: {words}" for clause, words in said) or short
    markdown = "\n".join(f"- **{clause}** {words}" for clause, words in said) or short
    return {
        "id": rule,
        "shortDescription": {"text": short},
        "fullDescription": {"text": " ".join(words for _, words in said) or short},
        "help": {"text": text, "markdown": markdown},
        "defaultConfiguration": {"level": level},
        "properties": {"tags": clauses, "problem.severity": _problem(level)},
    }


def _problem(level: str) -> str:
    return "recommendation" if level == "note" else level


# Results.


def _result(finding: Finding, rule: int, artifact: int, fingerprint: str) -> dict[str, Any]:
    result = {
        "ruleId": finding.rule,
        "ruleIndex": rule,
        "level": finding.severity,
        "message": {"text": finding.message or finding.rule},
        "locations": [_location(finding, artifact)],
        "partialFingerprints": dict.fromkeys(FINGERPRINTS, fingerprint),
        "relatedLocations": [
            {
                "id": index,
                "physicalLocation": _physical(finding.path, artifact, index),
                "logicalLocations": [{"name": f"#{index}", "kind": "message"}],
            }
            for index in sorted({*finding.related})
        ],
        "properties": _properties(finding),
    }
    if not finding.related:
        del result["relatedLocations"]
    return result | ({"occurrenceCount": finding.count} if finding.count > 1 else {})


def _fingerprint(finding: Finding, seen: Counter[str]) -> str:
    """The same for the same finding in another run, also where messages came before it.

    Of several that are alike it tells which one it is: the first, the second.
    """
    what = (Path(finding.path).name, finding.topic, finding.vmd, finding.rule, finding.message)
    alike = sha256(json.dumps([*what, finding.observed, *finding.clauses]).encode()).hexdigest()[:32]
    seen[alike] += 1
    return f"{alike}:{seen[alike]}"


def _location(finding: Finding, artifact: int) -> dict[str, Any]:
    location: dict[str, Any] = {"physicalLocation": _physical(finding.path, artifact, finding.index)}
    if finding.index is not None:
        location["logicalLocations"] = [_message(finding.index, printable(finding.topic or ""))]
    return location


def _physical(path: str, artifact: int, index: int | None) -> dict[str, Any]:
    """The message in its recording; the file as a whole is shown at its first one."""
    line = 1 if index is None else index + 1
    return {"artifactLocation": {**_place(path), "index": artifact}, "region": {"startLine": line}}


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


def _place(path: str) -> dict[str, str]:
    """Where an artifact is; a relative path begins at the root of what is scanned."""
    uri = _uri(path)
    relative = "://" not in uri and not uri.startswith("../")
    return {"uri": uri} | ({"uriBaseId": ROOT} if relative else {})


def _uri(path: str) -> str:
    """A URI reference: relative paths stay relative, octets outside the URI alphabet are percent-encoded."""
    if "://" in path:  # the URL of a remote recording
        return quote(path, safe="%/:?#[]@!$&'()*+,;=~")
    octets = quote(os.fsencode(Path(path).as_posix()))
    return f"file://{octets}" if octets.startswith("/") else octets

"""The order in which an audit is told, the same in every format: by path, then by place in the trace."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

from mmsverify.results import Audit, AuditedInput, Finding, Withheld

SEVERITIES = ("error", "warning", "note")


def ordered(findings: Iterable[Finding]) -> list[Finding]:
    """By path, index (the file as a whole first), severity, rule and message."""
    return sorted(findings, key=_place)


def _place(finding: Finding) -> tuple[Any, ...]:
    index = -1 if finding.index is None else finding.index
    severity = SEVERITIES.index(finding.severity)
    return finding.path, index, severity, finding.rule, finding.topic or "", finding.message, finding.clauses


def by_input(audit: Audit) -> list[tuple[str, AuditedInput | None, list[Finding]]]:
    """Each path, how it was read (``None``: not at all) and its findings; inputs as given, unread last."""
    found: dict[str, list[Finding]] = {}
    for finding in ordered(audit.findings):
        found.setdefault(finding.path, []).append(finding)
    read: dict[str, AuditedInput | None] = {entry.path: entry for entry in audit.inputs}
    return [(path, entry, found.get(path, [])) for path, entry in (read | _missing(found, read)).items()]


def _missing(found: Mapping[str, object], read: Mapping[str, object]) -> dict[str, None]:
    return {path: None for path in found if path not in read}


def tally(findings: Iterable[Finding], withheld: Iterable[Withheld] = ()) -> dict[str, int]:
    """How many findings of each severity, with those that are only counted.

    A finding that stands for several events counts once.
    """
    counts: Counter[str] = Counter(finding.severity for finding in findings)
    for rest in withheld:
        counts[rest.severity] += rest.count
    return {severity: counts[severity] for severity in SEVERITIES}

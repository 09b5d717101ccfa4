"""Of many findings of one rule and device only so many are told; the rest is counted.

The same findings are left out in every format, so that two reports of one audit agree.
"""

from __future__ import annotations

from collections import Counter, defaultdict

from mmsverify.report.order import SEVERITIES
from mmsverify.results import Audit, Finding, Severity, Withheld

Key = tuple[str, str, str]


def capped(audit: Audit, most: int | None) -> Audit:
    """The audit with at most ``most`` findings of each rule and device in one recording (``None``: all).

    Errors are told before warnings, and these before notes; among equals the first ones of the recording.
    """
    if most is None:
        return audit
    by_rule: dict[Key, list[int]] = defaultdict(list)
    for number, finding in enumerate(audit.findings):
        by_rule[_key(finding)].append(number)
    left_out = {
        number
        for same in by_rule.values()
        for number in sorted(same, key=lambda number: _rank(audit.findings[number]))[most:]
    }
    told = [finding for number, finding in enumerate(audit.findings) if number not in left_out]
    rest = [audit.findings[number] for number in sorted(left_out)]
    return Audit(audit.inputs, told, (*audit.withheld, *_counts(rest)))


def _rank(finding: Finding) -> tuple[int, int]:
    return SEVERITIES.index(finding.severity), -1 if finding.index is None else finding.index


def _key(finding: Finding) -> Key:
    return finding.path, finding.vmd or "", finding.rule


def _counts(findings: list[Finding]) -> list[Withheld]:
    counts: Counter[tuple[str, str | None, str, Severity]] = Counter(
        (finding.path, finding.vmd, finding.rule, finding.severity) for finding in findings
    )
    return [Withheld(*what, count) for what, count in sorted(counts.items(), key=lambda item: str(item[0]))]

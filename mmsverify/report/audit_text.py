"""An audit for a person with the standard open beside it: by input, then in the order of the trace."""

from __future__ import annotations

from collections.abc import Iterator

from mmsverify.report.order import by_input, tally
from mmsverify.report.wording import assignments, counted, folded, instant, printable
from mmsverify.results import Audit, AuditedInput, Finding

WIDTH = 100
INDENT = " " * 4


def render(audit: Audit) -> str:
    lines: list[str] = []
    for path, entry, findings in by_input(audit):
        lines += [_reading(path, entry), ""]
        for finding in findings:
            lines += [*_finding(finding), ""]
        rest = [f"  {line}" for line in withheld(audit, path)]
        lines += [*rest, ""] if rest else []
    return "\n".join([*lines, summary(audit)]) + "\n"


def summary(audit: Audit) -> str:
    """The closing line: how much was read, how much was found."""
    counts = tally(audit.findings, audit.withheld)
    total = sum(counts.values())
    judged = any(entry.events for entry in audit.inputs)
    nothing = (
        "no model knows these channels" if any(e.messages for e in audit.inputs) else "there is no message"
    )
    none = "no violation" if judged else f"nothing was judged: {nothing}"
    found = counted(total, "violation") if total else none
    parts = ", ".join(counted(number, severity) for severity, number in counts.items())
    messages = counted(sum(entry.messages for entry in audit.inputs), "message")
    unread = sum(entry is None for _, entry, _ in by_input(audit))
    read = counted(len(audit.inputs), "input") + (f" ({unread} more not read)" if unread else "")
    return f"{read}, {messages}: {found}" + (f" ({parts})" if total else "")


def withheld(audit: Audit, path: str) -> list[str]:
    """What is counted and not told of one recording: a line for each rule, device and severity."""
    return [
        f"{rest.severity.upper()}  {printable(rest.rule)}  {rest.count} more"
        f"{f' of {printable(rest.vmd)}' if rest.vmd else ''}, not told (--max-per-rule)"
        for rest in audit.withheld
        if rest.path == path
    ]


def _reading(path: str, entry: AuditedInput | None) -> str:
    if entry is None:
        return f"{printable(path)}: not read"
    skipped = f", {entry.skipped} skipped" if entry.skipped else ""
    cut = ", cut off: read up to the last whole message" if entry.truncated else ""
    amount = f"{counted(entry.messages, 'message')}, {counted(entry.events, 'event')}{skipped}{cut}"
    return f"{printable(path)}: {amount} ({entry.seconds:.1f} s)"


def _finding(finding: Finding) -> list[str]:
    facts = [f"{label:<9} {text}" for label, text in _facts(finding) if text]
    return [
        f"  {heading(finding)}",
        *(INDENT + line for line in [printable(finding.message), *facts, *_before(finding)]),
    ]


def heading(finding: Finding) -> str:
    """Severity, place in the trace, time, topic and rule on one line."""
    parts = [
        finding.severity.upper(),
        "whole file" if finding.index is None else f"#{finding.index}",
        "" if finding.time is None else instant(finding.time),
        printable(finding.topic or ""),
        printable(finding.rule),
        f"({finding.count} times)" if finding.count > 1 else "",
    ]
    return "  ".join(part for part in parts if part)


def _facts(finding: Finding) -> Iterator[tuple[str, str]]:
    yield "clauses", " ".join(finding.clauses)
    yield "readings", " ".join(finding.readings)
    yield "expected", " or ".join(map(printable, finding.expected))
    yield "observed", printable(finding.observed)
    yield "related", " ".join(f"#{index}" for index in finding.related)


def _before(finding: Finding) -> list[str]:
    """The state before the event, several cells a line."""
    lines = folded(assignments(finding.before), WIDTH - len(INDENT) - 10)
    return [f"{'before' if number == 0 else '':<9} {line}" for number, line in enumerate(lines)]

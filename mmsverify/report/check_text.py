"""Verdicts for a control engineer: a table of the properties, then every broken one step by step.

A step shows what was done, which clauses allow it, and the cells of the state that it changed, nothing else:
a counterexample is read by what moves. A cell that a step leaves out is one that never changes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from mmsverify.report.wording import assignments, cells, columns, folded, printable, spoken
from mmsverify.results import ModelCheck, PathStep, ProfileFinding, Verdict

WIDTH = 100
INDENT = " " * 6
HEAD = ("property", "result", "method", "scope", "seconds")


def render(checks: Sequence[ModelCheck]) -> str:
    return "\n\n".join("\n".join(_model(check)) for check in checks) + "\n"


def _model(check: ModelCheck) -> Iterator[str]:
    yield f"{printable(check.model)}, {check.variant}: {summary(check)}"
    yield ""
    yield from (f"  {line}" for line in columns([HEAD, *(_row(verdict) for verdict in check.verdicts)]))
    for verdict in check.verdicts:
        yield from _undecided(verdict)
    for verdict in check.verdicts:
        yield from _broken(verdict)
    if check.left_out:
        yield ""
        yield from folded(["not claimed with this profile: " + check.left_out[0], *check.left_out[1:]], WIDTH)
    if check.profile:
        yield ""
        yield from map(_of_profile, check.profile)
    if check.notes:
        yield ""
        yield from (f"note: {printable(note)}" for note in check.notes)


def _of_profile(found: ProfileFinding) -> str:
    return f"profile {found.severity}: {found.rule}: {printable(found.message)} ({' '.join(found.clauses)})"


def summary(check: ModelCheck) -> str:
    """How many properties have which result."""
    counts = Counter(verdict.result for verdict in check.verdicts)
    parts = [f"{counts[result]} {result}" for result in ("proved", "violated", "unknown") if counts[result]]
    return ", ".join(parts) or "no property"


def _row(verdict: Verdict) -> tuple[str, ...]:
    depth = "" if verdict.depth is None else f", depth {verdict.depth}"
    return verdict.name, verdict.result, verdict.method, verdict.scope + depth, f"{verdict.seconds:.2f}"


def _undecided(verdict: Verdict) -> Iterator[str]:
    if verdict.result == "unknown":
        yield ""
        yield f"{verdict.name} is unknown: {printable(verdict.reason) or 'no reason given'}"


def _broken(verdict: Verdict) -> Iterator[str]:
    if verdict.result != "violated":
        return
    yield ""
    yield f"{verdict.name} is violated ({' '.join(verdict.clauses)})"
    if verdict.statement:
        yield f"  {printable(verdict.statement)}"
    if verdict.reason:
        yield f"  {printable(verdict.reason)}"
    yield from _steps(verdict.counterexample or ())


def _steps(steps: Sequence[PathStep]) -> Iterator[str]:
    before: Mapping[str, str] | None = None
    for number, step in enumerate(steps, start=1):
        clauses = f"  [{' '.join(step.clauses)}]" if step.clauses else ""
        yield f"  {number:>2}. {printable(step.action)}{_arguments(step)}{clauses}"
        after = cells(step.state)
        yield from (INDENT + line for line in (_whole(step) if before is None else _changes(before, after)))
        before = {**(before or {}), **after}


def _arguments(step: PathStep) -> str:
    if not step.arguments:
        return ""
    return (
        "(" + ", ".join(f"{printable(name)}={spoken(value)}" for name, value in step.arguments.items()) + ")"
    )


def _whole(step: PathStep) -> list[str]:
    """The first state has no state before it to differ from: it is told whole, but for what is false or 0."""
    told = {cell: held for cell, held in step.state.items() if held is not False and held != 0}
    rest = ["(everything else is false or 0)"] if len(told) < len(step.state) else []
    return folded(assignments(told), WIDTH - len(INDENT)) + rest


def _changes(before: Mapping[str, str], after: Mapping[str, str]) -> list[str]:
    rows = [
        (cell, f"{before.get(cell, 'unknown')} -> {held}")
        for cell, held in sorted(after.items())
        if before.get(cell) != held
    ]
    return columns(rows) if rows else ["(no cell changes)"]

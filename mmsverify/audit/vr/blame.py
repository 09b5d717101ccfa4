"""Why a sample cannot follow: the command that was not allowed, the mode that does not come next, the status."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mmsverify.audit.vr.scans import PRE, RESET, Scans
from mmsverify.concrete.automaton import States
from mmsverify.model import Row
from mmsverify.model import expr as ex
from mmsverify.model.rows import MINUS, PLUS, Clause, Conjunct
from mmsverify.results import Severity

MACHINE = Clause.of("V-CTL02-N")
"""The machine runs by the built-in state machine, whatever else is broken."""


@dataclass(frozen=True, slots=True)
class Blame:
    """One violation, before it is a finding; ``expected`` are words for the mode or the status."""

    rule: str
    severity: Severity
    clause: Clause
    says: str
    about: str
    expected: tuple[str, ...]


def of_status(scans: Scans, agreeing: States, mode: str) -> Blame:
    """The mode can be as shown, the status cannot: ``agreeing`` are the states with that mode."""
    expected = sorted({str(scans.automaton.value(s, "status")) for s in agreeing})
    (row,) = (row for row in scans.automaton.machine.model.actions if row.on.service == PRE)
    return Blame("status.mode", "error", Clause.of("V-PRE-0", "V-STA-N", "V-CTL02-1") + row.clause, f"the status cannot be so in mode {mode}",
                 "status", tuple(expected))  # fmt: skip


def of_mode(scans: Scans, states: States, shown: str, seen: frozenset[str] | None) -> Blame:
    """The mode cannot follow; ``seen`` are the commands that the samples show (``None``: they show none at all)."""
    ready = scans.ready(states)
    modes = sorted({str(scans.automaton.value(s, "mode")) for s in ready})
    before = " or ".join(modes)
    nexts = sorted(
        {str(scans.automaton.value(s, "mode")) for s in scans.once(states, resets=seen is None or RESET in seen)}
    )
    left = _left_alone(scans, ready, shown) if seen is not None and RESET not in seen else None
    if left is not None:
        return Blame("error.left", "error", left.clause + MACHINE, f"{before} is left for {shown} without ResetErr",
                     "mode", tuple(nexts))  # fmt: skip
    refused = min(_refusals(scans, ready, shown, seen), key=lambda found: found[0], default=None)
    if refused is not None:
        _, row, broken = refused
        worst = next((c for c in broken if c.level == "error"), broken[0])
        severity: Severity = "error" if worst.level == "error" else "warning"
        clause = worst.clause + row.clause + MACHINE
        return Blame(worst.rule, severity, clause, f"{worst.says}: {before} is followed by {shown}", "mode", tuple(nexts))
    clause = Clause.of("V-NEXT-N", "V-CTL02-3") + MACHINE
    for row in _leading_on(scans, ready):
        clause = row.clause + clause
    return Blame("mode.next", "error", clause, f"{before} is followed by {shown}", "mode", tuple(nexts))


def _leading_on(scans: Scans, ready: States) -> Iterator[Row]:
    """The rows of SetNextMode that apply: what would have been right."""
    rows = {edge.row for s in ready for edge in scans.automaton.edges[s] if edge.row.on.service == "set_next_mode"}
    yield from sorted(rows, key=lambda row: row.id)


def _left_alone(scans: Scans, ready: States, shown: str) -> Row | None:
    """The row of ResetErr, if it alone leads to what is shown."""
    for s in sorted(ready):
        for edge in scans.automaton.edges[s]:
            if edge.row.on.service == RESET and str(scans.automaton.value(edge.target, "mode")) == shown:
                return edge.row
    return None


def _refusals(
    scans: Scans, ready: States, shown: str, seen: frozenset[str] | None
) -> Iterator[tuple[tuple[Any, ...], Row, tuple[Conjunct, ...]]]:
    """Commands that lead to the mode shown and are not allowed here, the most plausible first in order."""
    for row in scans.automaton.machine.model.actions:
        if row.on.phase != "response" or row.answer != PLUS or shown not in _targets(row):
            continue
        was_seen = seen is not None and row.on.service in seen
        if seen and not was_seen or (seen is not None and not seen and row.on.service == RESET):
            continue
        for state in sorted(ready):
            broken = tuple(_stated(c, row, scans) for c in scans.automaton.broken(state, row))
            if broken:
                worst = any(c.level == "error" for c in broken)
                yield (not was_seen, worst, len(broken), row.id, state), row, broken


def _stated(conjunct: Conjunct, row: Row, scans: Scans) -> Conjunct:
    """The condition with the words of the step that refuses where it does not hold."""
    for other in scans.automaton.machine.model.actions:
        if other.name == row.name and other.answer == MINUS and other.guard[-1].rule == conjunct.rule:
            return other.guard[-1]
    return conjunct


def _targets(row: Row) -> frozenset[str]:
    """The modes that a row may lead to."""
    values = (node for assign in row.assigns if assign.variable == "mode" for node in ex.walk(assign.value))
    return frozenset(str(node.value) for node in values if isinstance(node, ex.Const))


def before(scans: Scans, states: States) -> Mapping[str, Any]:
    """What was known before: by variable, its word or the words that it may be."""
    found: dict[str, Any] = {}
    for name in ("mode", "status", "homed", "lost"):
        words = sorted({scans.automaton.value(s, name) for s in states}, key=str)
        plain = [word if isinstance(word, bool) else str(word) for word in words]
        found[name] = plain[0] if len(plain) == 1 else {"oneOf": plain}
    return found

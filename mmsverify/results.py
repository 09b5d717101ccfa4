"""What the tool finds, as data: findings of an audit, verdicts of a check. Renderers compute nothing.

The field names are those of the JSON results; they are stable.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

Severity = Literal["error", "warning", "note"]
Result = Literal["proved", "violated", "unknown"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One violation in a trace: which event, which clause, what was seen and what would have been legal.

    ``index`` counts from 0 over all messages of the file in event order (``None``: the file as a whole);
    ``time`` is the capture time in ns. ``clauses`` are ids of the clause register, ``readings`` those of the
    project's own readings and base-standard assumptions. ``before`` maps attributes to the value that the
    model held before the event, or to ``{"oneOf": [...]}``.
    """

    path: str
    index: int | None
    time: int | None
    topic: str | None
    vmd: str | None
    severity: Severity
    rule: str
    clauses: tuple[str, ...]
    message: str
    expected: tuple[str, ...] = ()
    observed: str = ""
    before: Mapping[str, Any] = field(default_factory=dict)
    related: tuple[int, ...] = ()
    readings: tuple[str, ...] = ()
    count: int = 1


@dataclass(frozen=True, slots=True)
class AuditedInput:
    """How an input was read: ``messages`` of any channel, ``events`` that a model judged, ``skipped``."""

    path: str
    messages: int
    events: int
    skipped: int
    truncated: bool
    seconds: float


@dataclass(frozen=True, slots=True)
class Audit:
    """The result of one audit run."""

    inputs: Sequence[AuditedInput]
    findings: Sequence[Finding]


@dataclass(frozen=True, slots=True)
class PathStep:
    """One step of a counterexample or witness: the action, its arguments, its clauses, the state after it."""

    action: str
    arguments: Mapping[str, Any]
    clauses: tuple[str, ...]
    state: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is known of one property. ``scope`` is ``any number of ...`` or a bound like ``PI=3, Client=1``.

    ``depth`` is the bound on steps where the method has one; ``reason`` says why a verdict is ``unknown``.
    """

    name: str
    kind: Literal["always", "sometimes", "step"]
    clauses: tuple[str, ...]
    result: Result
    method: str
    scope: str
    seconds: float
    depth: int | None = None
    counterexample: tuple[PathStep, ...] | None = None
    witness: tuple[PathStep, ...] | None = None
    reason: str = ""
    statement: str = ""


@dataclass(frozen=True, slots=True)
class ModelCheck:
    """All verdicts of one model in one variant."""

    model: str
    variant: str
    verdicts: Sequence[Verdict]
    notes: Sequence[str] = ()

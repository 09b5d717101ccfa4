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
class Withheld:
    """Findings of one rule and device that are counted and not told one by one: ``count`` of a severity."""

    path: str
    vmd: str | None
    rule: str
    severity: Severity
    count: int


@dataclass(frozen=True, slots=True)
class Audit:
    """The result of one audit run. ``withheld`` counts those findings that are not among ``findings``."""

    inputs: Sequence[AuditedInput]
    findings: Sequence[Finding]
    withheld: Sequence[Withheld] = ()


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
class ProfileFinding:
    """What a profile breaks: the rule of the check, the statements, how bad it is, the sentence about it."""

    rule: str
    clauses: tuple[str, ...]
    severity: Severity
    message: str


@dataclass(frozen=True, slots=True)
class ModelCheck:
    """All verdicts of one model in one variant, and what the profile that was given breaks.

    ``left_out`` are the properties asked for that are not claimed of robots with that profile.
    """

    model: str
    variant: str
    verdicts: Sequence[Verdict]
    notes: Sequence[str] = ()
    profile: Sequence[ProfileFinding] = ()
    left_out: Sequence[str] = ()


@dataclass(frozen=True, slots=True)
class Statement:
    """One statement of a standard, in the project's words: where it stands, its sort, how it can be checked.

    One that cannot be checked has a ``reason`` of a closed vocabulary, with a sentence ``because``.
    """

    id: str
    clause: str
    kind: str
    checks: tuple[str, ...]
    says: str
    reason: str
    because: str
    checkable: bool


@dataclass(frozen=True, slots=True)
class Encoding:
    """What encodes a statement: its kind (a row, a property, a rule), its name, the variants that have it."""

    kind: str
    name: str
    variants: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Exercise:
    """What exercises a statement: a ``test``, or a ``sample`` recording."""

    by: str
    name: str


@dataclass(frozen=True, slots=True)
class Entry:
    """A statement with everything that encodes and exercises it."""

    statement: Statement
    encoded: tuple[Encoding, ...]
    exercised: tuple[Exercise, ...]

    @property
    def uncovered(self) -> bool:
        """Whether it can be checked and is not: nothing encodes it, and no reason is given."""
        return self.statement.checkable and not self.encoded and not self.statement.reason


@dataclass(frozen=True, slots=True)
class Mended:
    """A declaration that differs from the text: which statements it mends, by which readings, and why."""

    name: str
    variant: str
    readings: tuple[str, ...]
    mends: tuple[str, ...]
    because: str


@dataclass(frozen=True, slots=True)
class Register:
    """The clause register of a model, or a part of it: ``counts`` are those of the whole.

    ``unknown`` are ids that are cited and have no statement in it.
    """

    model: str
    standard: str
    variants: tuple[str, ...]
    entries: tuple[Entry, ...]
    repairs: tuple[Mended, ...]
    unknown: tuple[str, ...]
    counts: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Mending:
    """How the repaired reading mends a fault: the row or claim that differs, its reading and clauses, why."""

    declaration: str
    reading: str
    clauses: tuple[str, ...]
    because: str


@dataclass(frozen=True, slots=True)
class Breach:
    """A procedure that breaks a property, by the shortest run found.

    ``change`` is the case of it (``A -> B``) where a property has several, ``world`` what the profile of the
    run predefines; ``steps`` starts with the initial state.
    """

    procedure: str
    change: str
    world: str
    steps: tuple[PathStep, ...]


@dataclass(frozen=True, slots=True)
class Fault:
    """A property that the text breaks: by which procedures, what that means for a plant, what mends it.

    ``open`` names procedures that may break it from states which no run that was looked at reaches;
    ``mended`` tells what is known of the property in the repaired reading.
    """

    name: str
    statement: str
    clauses: tuple[str, ...]
    consequence: str
    breaches: tuple[Breach, ...]
    open: tuple[str, ...]
    mendings: tuple[Mending, ...]
    mended: str


@dataclass(frozen=True, slots=True)
class Oddity:
    """What the text says in vain or leaves open: a step never taken, a choice, an event without a rule."""

    kind: Literal["unreachable", "contradiction", "gap", "choice"]
    name: str
    clauses: tuple[str, ...]
    what: str


@dataclass(frozen=True, slots=True)
class Survey:
    """The faults of a text, found by holding every property against every procedure."""

    model: str
    variant: str
    standard: str
    properties: int
    procedures: int
    faults: Sequence[Fault]
    oddities: Sequence[Oddity]


@dataclass(frozen=True, slots=True)
class Explanation:
    """How a sample follows from the one before: the shortest legal way, or findings that say why none exists.

    ``way`` is ``None`` where no legal way leads there; its steps hold the variables that the samples show.
    Of the ``first`` sample of a controller it is empty.
    ``scan``: whether one scan lies between the samples; else any number of them may.
    """

    path: str
    index: int
    controller: str
    scan: bool
    way: tuple[PathStep, ...] | None
    findings: tuple[Finding, ...] = ()
    first: bool = False


@dataclass(frozen=True, slots=True)
class Evidence:
    """One message that speaks against an event: its index, what it says, its request's index."""

    index: int
    words: str
    asked: int | None = None


@dataclass(frozen=True, slots=True)
class Ground:
    """Earlier messages that exclude an event together, whatever was answered and shown by all others.

    ``irreducible``: none of them can be left out; each was, and then the event was no contradiction. Where it
    is false, the search was broken off, and fewer might do. Of a ``stretch`` all messages from the first to
    the last count: of samples, none by itself says what the next ones go by.
    """

    messages: tuple[Evidence, ...]
    irreducible: bool
    stretch: bool = False

    @property
    def earliest(self) -> int | None:
        """The index of the first of these messages; ``None`` where no earlier message is needed."""
        return min((each.index for each in self.messages), default=None)


@dataclass(frozen=True, slots=True)
class Edit:
    """One message said otherwise: one changed, one service (or unasked message) put in, or one left out.

    ``index``: the message that is changed or left out (its request with it, ``asked``), or before which
    something is put in. ``words`` tell what is said instead; ``said`` are the topics and octets of the
    messages that are put in, or in place of the changed one.
    """

    kind: Literal["change", "insert", "drop"]
    index: int
    words: str
    said: tuple[tuple[str, bytes], ...] = ()
    asked: int | None = None


@dataclass(frozen=True, slots=True)
class Account:
    """Why a finding stands, and what would have been legal; each part found by replaying, none guessed.

    ``event`` is the message in words, ``statements`` are those of the finding's clauses, in their order,
    ``readings`` what its readings say, by id.
    ``grounds`` each exclude the event by themselves, the smallest first; none where it was not found out, and
    ``remarks`` then say why. ``right`` is what would have been legal at the event, and ``later`` are the
    messages after it that would then have been wrong. ``edits`` each make a legal conversation, the nearest
    first, at most one of each sort: the event said otherwise, something put in before it, one of the messages
    that exclude it said otherwise, the event left out.
    """

    finding: Finding
    event: str
    asked: int | None
    statements: tuple[Statement, ...]
    grounds: tuple[Ground, ...] = ()
    right: Edit | None = None
    later: tuple[int, ...] = ()
    edits: tuple[Edit, ...] = ()
    remarks: tuple[str, ...] = ()
    readings: Mapping[str, str] = field(default_factory=dict)

    @property
    def earliest(self) -> int | None:
        """The earliest message of the smallest set that excludes the event."""
        return self.grounds[0].earliest if self.grounds else None

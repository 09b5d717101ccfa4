"""Why a sample cannot follow: a command that was not allowed, a mode that does not come next, the status."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from mmsverify.audit.vr.rules import VR_RULES
from mmsverify.audit.vr.scans import NEXT, PRE, RESET, TO_ORIGIN, Scans
from mmsverify.concrete.automaton import States
from mmsverify.model import Row
from mmsverify.model import expr as ex
from mmsverify.model.rows import MINUS, PLUS, Clause, Conjunct
from mmsverify.results import Severity

MACHINE = Clause.of("V-CTL02-N")
"""The machine runs by the built-in state machine: whatever else is broken, that is."""
STAYS = {"DbgRdy": Clause.of("V-NEXT-01", "V-SM-1"), "HomeRdy": Clause.of("V-NEXT-03b", "V-SM-1"),
         "OrgRdy": Clause.of("V-NEXT-05", "V-SM-1")}  # fmt: skip
"""The waiting modes, which SetNextMode leaves as they are."""
HOME_RDY, ORG, RUN = "HomeRdy", "Org", "Run"
PAUSES = frozenset({"V-STA-10", "VR-09"})
"""What SetPreMode does with a flow that is paused, in Run only."""
Seen = frozenset[str] | None
"""The commands that the samples show; ``None`` where they show no commands at all."""


@dataclass(frozen=True, slots=True)
class Given:
    """What was commanded in a scan: the commands seen, what is barred, and the number in C_Cmd if not 0.

    ``auto_org``: CF_AutoOrg is set.
    """

    seen: Seen = None
    barred: frozenset[str] = frozenset()
    number: float | None = None
    auto_org: bool = False


@dataclass(frozen=True, slots=True)
class Blame:
    """One violation, before it is a finding: ``about`` is a variable, ``expected`` are its words."""

    rule: str
    severity: Severity
    clause: Clause
    says: str
    about: str
    expected: tuple[str, ...]


class Blaming:
    """Explanations by the rows of one automaton."""

    def __init__(self, scans: Scans) -> None:
        self._scans = scans
        self._automaton = scans.automaton
        self._rows = scans.automaton.machine.model.actions

    def words(self, states: Iterable[int], name: str) -> tuple[str, ...]:
        """What a variable may hold, in order."""
        return tuple(sorted({str(self._automaton.value(s, name)) for s in states}))

    def of_status(self, agreeing: States, mode: str) -> Blame:
        """The mode can be as shown, the status cannot: ``agreeing`` are the states with that mode."""
        rule = VR_RULES["status.mode"]
        statuses, clause = self.words(agreeing, "status"), rule.clause + self.set_pre_mode(mode)
        return Blame(rule.id, rule.severity, clause, rule.says.format(mode=mode), "status", statuses)

    def of_late_status(self, statuses: frozenset[str], mode: str) -> Blame | None:
        """Mode and status can be as shown, but not at a time: the command that leads to the mode.

        The status is that of the mode before, where the text, or a reading of it, does not allow it.
        """
        before = self._scans.settled(statuses)
        refused = min(self._refusals(before, mode, None), key=lambda found: found[0], default=None)
        if refused is None:
            return None
        blame = self._of_refusal(refused, " or ".join(self.words(before, "mode")), mode, ())
        return replace(blame, clause=blame.clause + self.set_pre_mode(mode))

    def set_pre_mode(self, mode: str) -> Clause:
        """What SetPreMode does in a mode."""
        (row,) = (row for row in self._rows if row.on.service == PRE)
        its_own = f"V-PRE-{self._mode_numbers.get(mode, 0):02}"
        others = {c for c in row.clause.ids if c.startswith("V-PRE-") and c != its_own}
        others |= set() if mode == RUN else PAUSES
        return Clause.of("V-PRE-0", *(c for c in (*row.clause.ids, *row.clause.readings) if c not in others))

    @cached_property
    def _mode_numbers(self) -> Mapping[str, int]:
        numbers = self._automaton.machine.model.options["numbers"]["mode"]
        return {str(mode): number for number, mode in numbers.items()}

    def of_mode(self, states: States, shown: str, given: Given) -> Blame:
        """The mode cannot follow."""
        ready = self._scans.ready(states)
        held = " or ".join(self.words(ready, "mode"))
        nexts = self.words(self._scans.once(states, given.barred), "mode")
        if given.auto_org and held == HOME_RDY and shown == ORG and not given.seen:
            rule = VR_RULES["origin.not-after-home"]
            return Blame(rule.id, rule.severity, rule.clause, rule.says, "mode", nexts)
        refused = min(self._refusals(ready, shown, given.seen), key=lambda found: found[0], default=None)
        unasked = self._barred(ready, shown, given.barred)
        if refused is not None and (given.seen or unasked is None):
            return self._of_refusal(refused, held, shown, nexts)
        if unasked is not None:
            return self._of_unasked(unasked, held, shown, given, nexts)
        rule = VR_RULES["mode.next"]
        clause = rule.clause
        for word in self.words(ready, "mode"):
            clause = STAYS[word] + clause if word in STAYS else clause
        for row in self._leading_on(ready, given.seen or frozenset()):
            clause = row.clause + clause
        says = rule.says.format(held=held, shown=shown)
        return Blame(rule.id, rule.severity, clause, says, "mode", nexts)

    def _of_refusal(
        self, refused: tuple[Any, Row, Conjunct], held: str, shown: str, nexts: tuple[str, ...]
    ) -> Blame:
        """A command was obeyed that is not allowed."""
        _, row, conjunct = refused
        severity: Severity = "error" if conjunct.level == "error" else "warning"
        clause = conjunct.clause + row.clause + MACHINE
        says = f"{conjunct.says}: {held} is followed by {shown}"
        return Blame(conjunct.rule, severity, clause, says, "mode", nexts)

    def _leading_on(self, ready: States, seen: frozenset[str]) -> list[Row]:
        """The rows that apply, of SetNextMode and of the commands given: what would have been right."""
        events = {NEXT, *seen}
        edges = (edge for s in ready for edge in self._automaton.edges[s])
        led = {e.row for e in edges if e.row.on.service in events and "mode" in e.row.writes}
        return sorted(led, key=lambda row: row.id)

    def _barred(self, ready: States, shown: str, barred: frozenset[str]) -> Row | None:
        """The row that leads from here to what is shown, and was not asked for."""
        edges = (edge for s in sorted(ready) for edge in self._automaton.edges[s])
        found = (e for e in edges if barred & {e.row.on.service, e.row.name} and "mode" in e.row.writes)
        rows = [e.row for e in found if str(self._automaton.value(e.target, "mode")) == shown]
        return min(rows, key=lambda row: (row.name != TO_ORIGIN, row.id), default=None)

    def _of_unasked(self, row: Row, held: str, shown: str, given: Given, nexts: tuple[str, ...]) -> Blame:
        """What is shown may follow, if it is commanded; and it was not."""
        if row.on.service == RESET:
            says = f"{held} is left for {shown} without ResetErr"
            return Blame("error.left", "error", row.clause + MACHINE, says, "mode", nexts)
        if row.name == TO_ORIGIN:
            name = "origin.unasked"
        elif given.number is None:
            name = "command.none"
        else:
            name = "command.other" if given.seen else "command.unknown"
        rule = VR_RULES[name]
        says = rule.says.format(held=held, shown=shown, number=given.number)
        return Blame(rule.id, rule.severity, rule.clause + row.clause, says, "mode", nexts)

    def _refusals(
        self, ready: States, shown: str, seen: Seen
    ) -> Iterator[tuple[tuple[Any, ...], Row, Conjunct]]:
        """The commands that lead to the mode shown, and what stands against them, with weights."""
        for row in self._rows:
            if row.on.phase != "response" or row.answer != PLUS or shown not in targets(row):
                continue
            command = row.on.service
            # What is not seen is not ResetErr either: where there is no error, the text gives it no effect.
            if command not in seen if seen else command == RESET:
                continue
            for state in sorted(ready):
                broken = self._automaton.broken(state, row)
                if broken:
                    worst = next((c for c in broken if c.level == "error"), broken[0])
                    weight = worst.level == "error", len(broken), row.id, state
                    yield weight, row, self._stated(worst, row)

    def _stated(self, conjunct: Conjunct, row: Row) -> Conjunct:
        """The condition in the words of the step that refuses where it does not hold."""
        refusing = (r for r in self._rows if r.name == row.name and r.answer == MINUS)
        return next((r.guard[-1] for r in refusing if r.guard[-1].rule == conjunct.rule), conjunct)

    def before(self, states: States) -> Mapping[str, Any]:
        """What was known before: by variable, its value or those that it may have."""
        found: dict[str, Any] = {}
        for name in ("mode", "status", "homed", "lost"):
            values = {self._automaton.value(s, name) for s in states}
            plain = [v if isinstance(v, bool) else str(v) for v in sorted(values, key=str)]
            found[name] = plain[0] if len(plain) == 1 else {"oneOf": plain}
        return found


def targets(row: Row) -> frozenset[str]:
    """The modes that a row may lead to."""
    values = (node for a in row.assigns if a.variable == "mode" for node in ex.walk(a.value))
    return frozenset(str(node.value) for node in values if isinstance(node, ex.Const))

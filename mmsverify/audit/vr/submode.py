"""VR(C_SubMD): with a command of the user's DoCmd sets it to the number of its action, and at no other time.

What is known is which states the machine may be in, by what the cell ought to hold in them. A sample may show
the cell a sample early or late beside the mode: what does not fit is told with the next one, unless that
explains it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mmsverify.audit.rule import Breach
from mmsverify.audit.vr.blame import Given, targets
from mmsverify.audit.vr.scans import Scans
from mmsverify.concrete.automaton import States
from mmsverify.formats.trace import TraceMessage
from mmsverify.formats.vr import plain
from mmsverify.model.rows import PLUS, Clause

ANY = None
"""What a command of which no table is given sets the cell to: any number."""
REFUSED, UNKNOWN = Clause.of("V-CMD02-2b", "V-CHK-2"), Clause.of("V-DO-X", "V-CHK-4")
_NONE: States = frozenset()
Shown = Mapping[str, frozenset[str]]
Belief = dict[float | None, States]


@dataclass(frozen=True, slots=True)
class Doubt:
    """A sample that does not fit: what it shows, whether that may be late, and what it will be told as."""

    held: float
    late: bool
    breach: Breach


class SubModes:
    """C_SubMD of one controller; ``numbers``: what each command of the user's sets it to."""

    def __init__(self, scans: Scans, numbers: Mapping[str, int | None]) -> None:
        self._scans, self._numbers = scans, numbers
        self._own = frozenset(numbers)
        self._listed = ANY not in numbers.values()
        rows = (row for row in scans.automaton.machine.model.actions if row.on.service in self._own)
        self._acting = frozenset(mode for row in rows for mode in targets(row))
        self._belief: Belief = {}
        self._doubt: Doubt | None = None

    def begin(self, held: float, states: States) -> None:
        """Go on from these states, whatever has been."""
        self._belief, self._doubt = {held: states}, None

    def follow(
        self, message: TraceMessage, held: float, shown: Shown, states: States, given: Given | None
    ) -> Breach | None:
        """What is wrong with this sample, or the one before, if anything.

        ``states`` are those that mode and status leave; ``given``: what was commanded in the scan, if the
        samples are scans.
        """
        doubt = self._doubt
        if doubt is None and held in self._belief and not self._may_be_set(shown):
            self.begin(held, states)  # so it is with most samples
            return None
        right = self._scans.agreeing(self._that_hold(held, given), shown)
        if doubt is None and not right and self._belief:
            self._doubts(message, held, shown, states, given)
            return None
        self.begin(held, right & states or states)
        if doubt is None or (right and (doubt.late or doubt.held == held)):
            return None
        return doubt.breach

    def _may_be_set(self, shown: Shown) -> bool:
        """Whether an action that would set the cell otherwise may go on: none whose number is not known."""
        return self._listed and bool(shown.get("mode", self._acting) & self._acting)

    def _that_hold(self, held: float, given: Given | None) -> States:
        """The states in which the cell ought to hold this."""
        own = frozenset(command for command, number in self._numbers.items() if number in (held, ANY))
        kept = (self._kept(s, given) for number, s in self._belief.items() if number in (held, ANY))
        return _NONE.union(*kept, *(self._set(s, own, given) for s in self._belief.values()))

    def _kept(self, states: States, given: Given | None) -> States:
        """Where no command of the user's is obeyed."""
        if given is None:
            return self._scans.often(states, self._own)
        return self._scans.once(states, given.barred | self._own)

    def _set(self, states: States, own: frozenset[str], given: Given | None) -> States:
        """Where one of these commands is obeyed, and of the user's no other one after it."""
        scans = self._scans
        if given is not None:
            return scans.obeying(states, own - given.barred)
        return scans.often(scans.obeying(scans.often(states), own), self._own)

    # What is told.

    def _doubts(
        self, message: TraceMessage, held: float, shown: Shown, states: States, given: Given | None
    ) -> None:
        """Go on with every number that the cell may be about to hold."""
        (before,) = self._belief
        earlier = self._belief[before]
        agreeing = self._scans.agreeing
        begun = {c: agreeing(self._set(earlier, frozenset({c}), given), shown) for c in sorted(self._own)}
        ought: Belief = {before: agreeing(self._kept(earlier, given), shown)}
        for command, reached in begun.items():
            number = self._numbers[command]
            ought[number] = ought.get(number, _NONE) | reached
        possible = {number: reached & states for number, reached in ought.items() if reached & states}
        if not possible:
            self.begin(held, states)
            return
        acting = [command for command, reached in begun.items() if reached & states]
        numbers = [plain(number) for number in sorted(n for n in possible if n is not None)]
        words = {
            "found": plain(held),
            "before": None if before is None else plain(before),
            "right": " or ".join(map(str, numbers)),
        }
        expects = tuple(f"C_SubMD={number}" for number in numbers)
        rule, clause = self._broken(acting, given)
        self._belief = possible
        self._doubt = Doubt(
            held, held == before, Breach(rule, words, clause=clause, at=message, expects=expects)
        )

    def _broken(self, acting: list[str], given: Given | None) -> tuple[str, Clause]:
        """The rule and the statements: an action of the wrong number, or a change by no such command."""
        if acting:
            return "sub-mode.number", Clause.of(*dict.fromkeys(map(self._does, acting)))
        seen = sorted(given.seen or ()) if given is not None else []
        if seen:
            basic = [self._does(command) for command in seen if command not in self._own]
            return "sub-mode.changed", Clause.of(*basic) if basic else REFUSED
        if given is not None and given.number is not None:
            return "sub-mode.changed", UNKNOWN
        return "sub-mode.unasked", Clause.of("V-DO-00")

    def _does(self, command: str) -> str:
        """The statement on what DoCmd makes of a command."""
        rows = self._scans.automaton.machine.model.actions
        cited = (row.clause.ids for row in rows if row.on.service == command and row.answer == PLUS)
        return next(each for ids in cited for each in ids if each.startswith("V-DO-"))

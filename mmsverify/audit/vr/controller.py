"""One controller: its samples go in, findings come out.

The belief is a set of states of the automaton: those that agree with the samples so far. A sample shows the
cells that it names and, of the others, what they held last.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, ClassVar

from mmsverify.audit.rule import Breach
from mmsverify.audit.telling import History, Place, of_rule
from mmsverify.audit.vr.blame import Blaming, Given
from mmsverify.audit.vr.rules import VR_RULES
from mmsverify.audit.vr.scans import NOTHING, PRE, RESET, RUN_ACTION, TO_ORIGIN, Scans
from mmsverify.audit.vr.submode import SubModes
from mmsverify.audit.vr.ways import Segment, Stage, shortest
from mmsverify.concrete.automaton import States
from mmsverify.errors import DecodeError
from mmsverify.formats import vr
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding

MODE, STATUS, COMMAND, HOMED = "C_RunMD", "CS_RunSTA", "C_Cmd", "CF_Home"
CELL_OF = {"mode": MODE, "status": STATUS}
STOPS, AUTO_ORG, SUB_MODE = "CF_Stop", "CF_AutoOrg", "C_SubMD"
MOST_WORDS = 3
"""So many alternatives are still worth telling."""
SCAN = "scan"
LAG = 3
"""So many samples a command may stand in C_Cmd before the mode follows: nothing says when it is cleared."""
FROM_WITHIN = frozenset({"onErrB", "onErrS"})
"""Commands that ScanMIO gives, and that no sample need show."""

Numbers = Mapping[str, Any]


class Numbering:
    """What the numbers in cells mean, for one profile; the model says it."""

    def __init__(self, numbers: Numbers, sub_actions: str) -> None:
        self.modes = {number: frozenset({str(mode)}) for number, mode in numbers["mode"].items()}
        listed = numbers["status"](sub_actions)
        self.statuses = {number: frozenset(map(str, meant)) for number, meant in listed.items()}
        self.commands: Mapping[int, str] = numbers["command"]
        self.obeyed = frozenset(self.commands.values()) - FROM_WITHIN
        self.sub_modes: Mapping[str, int | None] = numbers["sub_mode"]

    def number(self, name: str, word: str) -> str:
        """A word of mode or status as the number that its cell holds, or the numbers."""
        table = self.modes if name == "mode" else self.statuses
        return "|".join(str(n) for n, words in table.items() if word in words) or word


class Controller:
    """The replay of one controller's samples."""

    SHARED: ClassVar[tuple[type, ...]] = (Scans, Numbering, Blaming, Place, History)
    """The types of what all its states share."""
    grown: tuple[()] = ()
    """Nothing is met that is not in the model from the beginning."""

    def __init__(
        self, place: Place, scans: Scans, numbering: Numbering, history: History | None = None
    ) -> None:
        self._place = place
        self._scans, self._numbering, self._blaming = scans, numbering, Blaming(scans)
        self._sub_modes = SubModes(scans, numbering.sub_modes)
        self.history = history or History()
        self._states: States = scans.automaton.all
        self._cells: dict[str, float] = {}
        self._told: dict[str, float] = {}
        self._commands: tuple[float | None, ...] = ()
        self._changed: int | None = None
        self._mode: frozenset[str] = frozenset()
        self._wrong_status: float | None = None
        self._lawless: float | None = None
        self._unhomed = False
        self._two_tables = False
        self._begun = self._commanded = self._went_on = self._stopping = False
        self._last: Segment | None = None
        self._was: float | None = None

    def sample(self, message: TraceMessage) -> Iterator[Finding]:
        """The findings of one sample."""
        try:
            said = vr.decode(message.data)
        except DecodeError as error:
            yield self._breach(message, "vr.undecodable", cause=error.cause)
            return
        for bad in said.bad:
            yield self._breach(message, "vr.cell", cell=bad.name, found=bad.found)
        self._went_on, self._stopping = bool(self._cells.get(AUTO_ORG)), bool(self._cells.get(STOPS))
        self._was = self._cells.get(SUB_MODE)
        self._cells |= said.cells
        self._commands = (*self._commands, self._cells.get(COMMAND))[-LAG:]
        shown: dict[str, frozenset[str]] = {}
        yield from self._numbers(message, shown)
        if self._wrong_status is not None and self._wrong_status == self._cells.get(STATUS):
            shown.pop("status", None)  # told; it shows nothing until it changes
        else:
            self._wrong_status = None
        if self._lawless is not None and self._lawless == self._cells.get(MODE):
            shown.clear()  # told; no state has this mode, and it shows nothing until it changes
        else:
            self._lawless = None
        yield from self._follow(message, shown, said.cells)

    def grow(self, grown: Iterable[object]) -> None:
        """Nothing to grow."""

    def shows(self) -> dict[str, str]:
        """What is known of the controller now, in words, by lane; several where it may be one or another."""
        value, command = self._scans.automaton.value, self._cells.get(COMMAND, 0)
        held = {lane: sorted({str(value(state, lane)) for state in self._states}) for lane in CELL_OF}
        lanes = {lane: " | ".join(words) if len(words) <= MOST_WORDS else "" for lane, words in held.items()}
        named = self._numbering.commands.get(int(command)) or str(vr.plain(command) or "")
        return lanes | {"command": named}

    def settle(self) -> None:
        """Nothing waits for the next sample to be forgotten."""

    def way(self) -> tuple[Stage, ...] | None:
        """The shortest legal way to the last sample from the one before; ``None`` where there is none.

        Empty for the first sample, for a recording may begin at any time.
        """
        if self._last is None:
            return ()
        # C_SubMD may be a sample early or late (VR-20): what fits it goes before what only the mode fits.
        way = shortest(self._scans, self._last) or shortest(self._scans, replace(self._last, held=None))
        return way if way is None else tuple(map(self._cited, way))

    @property
    def at_first(self) -> bool:
        """Whether there was no sample before the last one."""
        return self._last is None

    def _cited(self, stage: Stage) -> Stage:
        """The step with the clauses of its mode alone, where it is SetPreMode."""
        if stage.row.on.service != PRE:
            return stage
        return replace(stage, clause=self._blaming.set_pre_mode(stage.mode))

    def _numbers(self, message: TraceMessage, shown: dict[str, frozenset[str]]) -> Iterator[Finding]:
        """What mode and status mean; a number without a meaning is told once, and shows nothing."""
        for name, table in (("mode", self._numbering.modes), ("status", self._numbering.statuses)):
            number = self._cells.get(CELL_OF[name])
            if number is None:
                continue
            meant = table.get(int(number)) if number == int(number) else None
            if meant is not None:
                shown[name] = meant
                self._told.pop(name, None)
                if len(meant) > 1 and not self._two_tables:
                    self._two_tables = True
                    yield self._breach(message, "status.two-tables", found=vr.plain(number))
            elif self._told.get(name) != number:
                self._told[name] = number
                yield self._breach(message, f"{name}.unknown", found=vr.plain(number))

    # What may follow.

    def _follow(
        self, message: TraceMessage, shown: Mapping[str, frozenset[str]], said: Mapping[str, float]
    ) -> Iterator[Finding]:
        scans, earlier, everything = self._scans, self._states, self._scans.automaton.all
        given = self._given() if message.metadata.get("sampling") == SCAN else None
        reached = self._reached(given)
        agreeing = scans.agreeing(reached, shown)
        self._last = self._segment(agreeing, given) if self._begun else None
        self._begun = True
        found = None if agreeing else self._violation(message, reached, shown, given)
        if found is not None:
            if found.observed.startswith(STATUS):
                self._wrong_status = self._cells[STATUS]
            agreeing = scans.agreeing(everything, shown) or scans.agreeing(everything, _mode_of(shown))
            if not agreeing:  # the mode of an action of which the machine has no command
                agreeing, self._lawless = everything, self._cells[MODE]
        if scans.agreeing(earlier, shown) != earlier:
            self._changed = message.index
        self._mode = shown.get("mode", self._mode)
        denied = self._homing_is_denied()
        certain = denied and self._mode != {RUN_ACTION}
        if certain and not self._unhomed and (found is None or found.severity == "warning"):
            found = self._breach(message, "mode.unhomed", mode=vr.plain(self._cells[MODE]))
        if found is not None:
            yield found
        odd = found is not None or self._unhomed
        self._unhomed = denied and (self._unhomed or found is not None)
        if HOMED in said:  # the flag may be set a little earlier, or later
            flag = frozenset({str(bool(self._cells[HOMED]))})
            agreeing = scans.agreeing(agreeing, {"homed": flag}) or agreeing
        self._states = agreeing
        if SUB_MODE in self._cells:
            yield from self._sub_mode(message, shown, given, odd)

    def _segment(self, agreeing: States, given: Given | None) -> Segment:
        """What lies between the sample before and this one, in which these states agree with it."""
        barred = given.barred if given else NOTHING
        held, was = self._cells.get(SUB_MODE), self._was
        return Segment(
            self._before(), agreeing, given is not None, barred, held, was, self._numbering.sub_modes
        )

    def _sub_mode(
        self, message: TraceMessage, shown: Mapping[str, frozenset[str]], given: Given | None, odd: bool
    ) -> Iterator[Finding]:
        """What C_SubMD shows; nothing, where the mode is ``odd`` already."""
        held = self._cells[SUB_MODE]
        if odd:
            self._sub_modes.begin(held, self._states)
            return
        breach = self._sub_modes.follow(message, held, shown, self._states, given)
        if breach is not None:
            yield of_rule(self._place, breach.at or message, VR_RULES[breach.rule], breach)

    def _reached(self, given: Given | None) -> States:
        """The states that may follow; ``given``: what was commanded in the scan, if there was just one."""
        if not self._begun:
            return self._states
        scans, before = self._scans, self._before()
        return scans.often(before) if given is None else scans.once(before, given.barred)

    def _before(self) -> States:
        """The states to go on from: any unhomed one, too, where the flag forbids the machine to be there."""
        return self._states | self._scans.unhomed if self._unhomed else self._states

    def _homing_is_denied(self) -> bool:
        """Whether VR(CF_Home) is 0 in a mode that needs homing, even if the flag is a scan behind."""
        return self._cells.get(HOMED) == 0 and bool(self._mode) and self._mode <= self._scans.homed_modes

    def _given(self) -> Given:
        """What has been commanded in this scan: what stands in C_Cmd, or stood there in the last samples.

        Where C_Cmd is not recorded, or has held 0 so far, commands may come and go between the samples; but
        an error is not left unseen. Errors are commanded from within.
        """
        if COMMAND not in self._cells:
            return Given()
        known = self._numbering.commands
        numbers = [number for number in self._commands if number]
        seen = frozenset(known[int(number)] for number in numbers if int(number) in known)
        self._commanded = self._commanded or bool(numbers)
        barred = self._numbering.obeyed if self._commanded else frozenset({RESET})
        if self._cells.get(STOPS) or self._stopping:
            barred -= {"stop"}
        goes_on = self._cells.get(AUTO_ORG) or self._went_on
        if AUTO_ORG in self._cells and not goes_on:
            barred |= {TO_ORIGIN}
        number = vr.plain(numbers[-1]) if numbers else None
        return Given(seen, barred - seen, number, auto_org=bool(goes_on))

    # What is told.

    def _violation(
        self,
        message: TraceMessage,
        reached: States,
        shown: Mapping[str, frozenset[str]],
        given: Given | None,
    ) -> Finding:
        scans = self._scans
        by_mode = scans.agreeing(reached, _mode_of(shown))
        if "mode" in shown and not by_mode:
            (word,) = shown["mode"]
            before = reached if given is None else self._states
            found = self._blaming.of_mode(before, word, given or Given())
        else:
            word = next(iter(shown.get("mode", ("unknown",))))
            late = None
            if given is None and self._mode and self._mode != shown.get("mode"):
                late = self._blaming.of_late_status(shown["status"], word)
            found = late or self._blaming.of_status(by_mode or reached, word)
        cell = CELL_OF[found.about]
        return Finding(
            path=self._place.path, vmd=self._place.vmd,
            index=message.index, time=message.time, topic=message.topic,
            severity=found.severity, rule=found.rule, message=found.says,
            clauses=found.clause.ids, readings=found.clause.readings,
            expected=tuple(f"{cell}={self._numbering.number(found.about, word)}" for word in found.expected),
            observed=f"{cell}={vr.plain(self._cells[cell])}",
            before=self._blaming.before(self._states),
            related=() if self._changed is None else (self._changed,),
        )  # fmt: skip

    def _breach(self, message: TraceMessage, name: str, **words: Any) -> Finding:
        return of_rule(self._place, message, VR_RULES[name], Breach(name, words))


def _mode_of(shown: Mapping[str, frozenset[str]]) -> dict[str, frozenset[str]]:
    return {name: words for name, words in shown.items() if name == "mode"}

"""How the states of a controller go on from sample to sample, scan by scan or with scans left out.

In a scan the status is set from the mode (SetPreMode), the mode changes once at most, by a command or by
SetNextMode, and the status may or may not have been set again: so it lags the mode by one scan at most.
"""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.concrete.automaton import Automaton, States
from mmsverify.model import Row

PRE, NEXT, RESET = "set_pre_mode", "set_next_mode", "resetErr"


class Scans:
    """The automaton of a controller, by scans; what has been worked out is remembered."""

    def __init__(self, automaton: Automaton) -> None:
        self.automaton = automaton
        self._memo: dict[tuple[str, States, bool], States] = {}

    def once(self, states: States, *, resets: bool) -> States:
        """The states after one scan; ``resets``: an error may have been reset in it."""
        return self._remembered("once", states, resets)

    def often(self, states: States) -> States:
        """The states after any number of scans, none included."""
        return self._remembered("often", states, True)

    def _remembered(self, how: str, states: States, resets: bool) -> States:
        key = how, states, resets
        if key not in self._memo:
            if how == "once":
                self._memo[key] = self._scan(states, resets)
            else:
                self._memo[key] = self.automaton.closed(states, lambda each: self._scan(each, resets))
        return self._memo[key]

    def _scan(self, states: States, resets: bool) -> States:
        ready = self.ready(states)

        def moves(row: Row) -> bool:
            return "mode" in row.writes and (resets or row.on.service != RESET)

        moved = self._quiet(ready | self.automaton.after(ready, moves))
        return moved | self._set(moved)

    def ready(self, states: States) -> States:
        """The states in which the mode may change: the status has been set."""
        return self._quiet(self._set(self._quiet(states)))

    def _set(self, states: States) -> States:
        return self.automaton.after(states, lambda row: row.on.service == PRE)

    def _quiet(self, states: States) -> States:
        """What may be set without a change of the mode or the status: flags."""

        def flags(row: Row) -> bool:
            return not row.writes & {"mode", "status"}

        return self.automaton.closed(states, lambda each: self.automaton.after(each, flags))

    def agreeing(self, states: States, shown: Mapping[str, frozenset[str]]) -> States:
        """The states that hold what is shown: for each variable, one of these words."""
        value = self.automaton.value
        return frozenset(
            s for s in states if all(str(value(s, name)) in words for name, words in shown.items())
        )

"""How the states of a controller go on from sample to sample, scan by scan or with scans left out.

In a scan the status is set from the mode (SetPreMode), the mode changes once at most, by a command or by
SetNextMode, and the status may or may not have been set again: so it lags the mode by one scan at most.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from functools import cached_property, lru_cache

from mmsverify.concrete.automaton import Automaton, States
from mmsverify.model import Row

PRE, NEXT, RESET, TO_ORIGIN = "set_pre_mode", "set_next_mode", "resetErr", "goes_to_origin"
RUN_ACTION = "Run_SubActions"
"""The mode of actions 401 to 499: where these are allowed, only a reading says."""
REMEMBERED = 4096
_NONE: States = frozenset()
NOTHING: frozenset[str] = frozenset()
"""Nothing is barred."""


class Scans:
    """The automaton of a controller, by scans; what has been worked out is remembered.

    A step leads from a set of states to all that it leads to from one of them. So what is remembered is by
    state, however many sets of states a long recording meets; by set only what was asked last.
    """

    def __init__(self, automaton: Automaton) -> None:
        self.automaton = automaton
        self._after_scan: dict[tuple[int, frozenset[str]], States] = {}
        self._reached: dict[tuple[int, frozenset[str]], States] = {}
        self._obeying: dict[tuple[int, frozenset[str]], States] = {}
        self._holding: dict[tuple[str, frozenset[str]], States] = {}
        self._remembered_once = lru_cache(maxsize=REMEMBERED)(self._once)
        self._remembered_often = lru_cache(maxsize=REMEMBERED)(self._often)
        self._remembered_obeying = lru_cache(maxsize=REMEMBERED)(self._obey)

    def once(self, states: States, barred: frozenset[str] = NOTHING) -> States:
        """The states after one scan; ``barred``: commands not given in it, rows that do not apply."""
        return self._remembered_once(states, barred)

    def often(self, states: States, barred: frozenset[str] = NOTHING) -> States:
        """The states after any number of scans, none included."""
        return self._remembered_often(states, barred)

    def obeying(self, states: States, commands: frozenset[str]) -> States:
        """The states after one scan in which one of these commands has been obeyed."""
        return self._remembered_obeying(states, commands) if commands else _NONE

    def _once(self, states: States, barred: frozenset[str]) -> States:
        return _NONE.union(*{self._from(state, barred) for state in states})

    def _often(self, states: States, barred: frozenset[str]) -> States:
        return _NONE.union(*{self._reach(state, barred) for state in states})

    def _obey(self, states: States, commands: frozenset[str]) -> States:
        return _NONE.union(*{self._from_obeying(state, commands) for state in states})

    def _reach(self, state: int, barred: frozenset[str]) -> States:
        """What any number of scans leads to; from a state that is known it is not looked for again."""
        if (state, barred) not in self._reached:
            met, ahead = {state}, [state]
            while ahead:
                new = self._from(ahead.pop(), barred) - met
                met |= new
                for each in new:
                    if (each, barred) in self._reached:
                        met |= self._reached[each, barred]
                    else:
                        ahead.append(each)
            self._reached[state, barred] = frozenset(met)
        return self._reached[state, barred]

    def _from_obeying(self, state: int, commands: frozenset[str]) -> States:
        key = state, commands
        if key not in self._obeying:
            ready = self.ready(frozenset({state}))
            self._obeying[key] = self._moved(ready, lambda row: row.on.service in commands)
        return self._obeying[key]

    def _from(self, state: int, barred: frozenset[str]) -> States:
        key = state, barred
        if key not in self._after_scan:
            self._after_scan[key] = self._scan(frozenset({state}), barred)
        return self._after_scan[key]

    def _scan(self, states: States, barred: frozenset[str]) -> States:
        ready = self.ready(states)

        def moves(row: Row) -> bool:
            return not barred & {row.on.service, row.name}

        return self._settling(ready) | self._moved(ready, moves)

    def _moved(self, ready: States, moves: Callable[[Row], bool]) -> States:
        """After a change of the mode by such a row."""
        changing = self.automaton.after(ready, lambda row: "mode" in row.writes and moves(row))
        return self._settling(changing)

    def _settling(self, states: States) -> States:
        """The status may or may not be set again."""
        quiet = self._quiet(states)
        return quiet | self._set(quiet)

    def ready(self, states: States) -> States:
        """The states in which the mode may change: the status has been set."""
        return self._quiet(self._set(self._quiet(states)))

    def _set(self, states: AbstractSet[int]) -> States:
        return self.automaton.after(states, lambda row: row.on.service == PRE)

    def _quiet(self, states: States) -> States:
        """What may be set without a change of the mode or the status: flags."""

        def flags(row: Row) -> bool:
            return not row.writes & {"mode", "status"}

        return self.automaton.closed(states, lambda each: self.automaton.after(each, flags))

    @cached_property
    def unhomed(self) -> States:
        """The states of a machine that is not homed."""
        return self._that_hold("homed", frozenset({"False"}))

    @cached_property
    def homed_modes(self) -> frozenset[str]:
        """The modes of homed machines only, even of such as were homed a scan ago."""
        value, lately = self.automaton.value, self.unhomed | self.once(self.unhomed)
        every = {str(value(s, "mode")) for s in self.automaton.all}
        return frozenset(every - {str(value(s, "mode")) for s in lately})

    def settled(self, statuses: frozenset[str]) -> States:
        """The states with one of these statuses in which SetPreMode has nothing left to do."""
        return frozenset(s for s in self._that_hold("status", statuses) if self._set({s}) == {s})

    def agreeing(self, states: States, shown: Mapping[str, frozenset[str]]) -> States:
        """The states that hold what is shown: for each variable, one of these words."""
        for name, words in shown.items():
            states &= self._that_hold(name, words)
        return states

    def _that_hold(self, name: str, words: frozenset[str]) -> States:
        key = name, words
        if key not in self._holding:
            value, every = self.automaton.value, self.automaton.all
            self._holding[key] = frozenset(s for s in every if str(value(s, name)) in words)
        return self._holding[key]

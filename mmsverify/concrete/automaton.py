"""A small model as an explicit automaton: all its states, and from each the states that its rows lead to.

For models of some thousand states without elements, whose recordings are long: what a set of states becomes
is worked out once, and looked up from then on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache

from mmsverify.concrete.layout import State
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import Value
from mmsverify.model.rows import Conjunct, Row

LARGEST = 100_000
States = frozenset[int]
"""States of the automaton, by number."""


@dataclass(frozen=True, slots=True)
class Edge:
    """A step of the automaton."""

    row: Row
    target: int


class TooManyStatesError(Exception):
    """More states than an explicit automaton is for."""


class Automaton:
    """The reachable states of a machine, numbered in the order in which they are met.

    Raises ``TooManyStatesError`` beyond ``LARGEST``.
    """

    def __init__(self, machine: Machine) -> None:
        self.machine = machine
        self.states: list[State] = []
        self.edges: list[tuple[Edge, ...]] = []
        self._numbers: dict[State, int] = {}
        self._explore()
        self.all: States = frozenset(range(len(self.states)))
        # Kept with the automaton: a cache of the class would keep every automaton that ever was.
        self.value = cache(self._value)
        """What a variable without arguments holds, by the number of a state and its own name."""
        self.broken = cache(self._broken)
        """The conditions of a row that do not hold in a state, by its number and the row."""

    def _explore(self) -> None:
        for state in self.machine.start.states:
            self._number(state)
        done = 0
        while done < len(self.states):
            if done >= LARGEST:
                raise TooManyStatesError
            found = self.machine.successors(self.states[done])
            steps = [(self.machine.instances[n].row, after) for n, after in found if after is not None]
            self.edges.append(tuple(Edge(row, self._number(after)) for row, after in steps))
            done += 1

    def _number(self, state: State) -> int:
        if state not in self._numbers:
            self._numbers[state] = len(self.states)
            self.states.append(state)
        return self._numbers[state]

    def after(self, states: Iterable[int], taken: Callable[[Row], bool]) -> States:
        """Where one step by such a row leads."""
        return frozenset(edge.target for s in states for edge in self.edges[s] if taken(edge.row))

    def closed(self, states: States, step: Callable[[States], States]) -> States:
        """The states and all that any number of such steps leads to."""
        while not (grown := states | step(states)) <= states:
            states = grown
        return states

    def _value(self, state: int, name: str) -> Value:
        return self.machine.layout.read(self.states[state])[name, ()]

    def _broken(self, state: int, row: Row) -> tuple[Conjunct, ...]:
        return tuple(c for c in row.guard if not self.machine.predicate(c.condition)(self.states[state]))

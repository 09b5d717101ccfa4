"""The steps that a machine takes, one after the other, and the graph of them: nodes are packed states.

For models of some ten thousand states, and for a fair sample of larger ones; ``concrete.search`` goes
further, faster.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Hashable, Iterator

import networkx as nx

from mmsverify.concrete.compile import Successors
from mmsverify.concrete.layout import State
from mmsverify.concrete.machine import Machine

Kind = Callable[[State], Hashable]
Taken = tuple[State, int, State]
"""A step: the state before, the number of the instance, the state after."""


def explore(machine: Machine, *, max_states: int | None = None) -> nx.MultiDiGraph[State]:
    """The graph of the reachable states; an edge has the number of its instance as key, and its ``row``.

    At most ``max_states`` states are expanded, breadth first; ``graph.graph["complete"]`` tells whether
    that was all.
    """
    graph: nx.MultiDiGraph[State] = nx.MultiDiGraph()
    graph.add_nodes_from(machine.start.states, initial=True)
    walk = Walk(machine, machine.successors, max_states=max_states)
    for source, number, target in walk.steps():
        graph.add_edge(source, target, key=number, row=machine.instances[number].row)
    graph.graph["complete"] = walk.complete
    return graph


class Walk:
    """An exploration in progress: its steps as they are taken, then whether it was ``complete``.

    With ``kind`` the states of the kind that was expanded least come first, so that a sample has every kind
    that is near; without it the order is breadth first.
    """

    def __init__(
        self,
        machine: Machine,
        successors: Successors,
        *,
        kind: Kind | None = None,
        max_states: int | None = None,
    ) -> None:
        self.machine, self.successors = machine, successors
        self.kind: Kind = kind or (lambda _: 0)
        self.max_states = max_states
        self.complete = machine.start.complete
        self._queues: dict[Hashable, deque[State]] = {}
        self._taken: dict[Hashable, int] = {}
        self._seen: set[State] = set()

    def steps(self) -> Iterator[Taken]:
        """Every step from every state that is expanded."""
        for state in self.machine.start.states:
            self._meet(state)
        expanded = 0
        while any(self._queues.values()):
            if expanded == self.max_states:
                self.complete = False
                return
            expanded += 1
            yield from self._expand(self._next())

    def _expand(self, state: State) -> Iterator[Taken]:
        for number, after in self.successors(state):
            if after is None:
                self.complete = False
                continue
            if after not in self._seen:
                self._meet(after)
            yield state, number, after

    def _meet(self, state: State) -> None:
        self._seen.add(state)
        kind = self.kind(state)
        self._queues.setdefault(kind, deque()).append(state)
        self._taken.setdefault(kind, 0)

    def _next(self) -> State:
        """The oldest state of the kind that was taken from least, the kind met first among equals."""
        kind = min((k for k, queue in self._queues.items() if queue), key=self._taken.__getitem__)
        self._taken[kind] += 1
        return self._queues[kind].popleft()

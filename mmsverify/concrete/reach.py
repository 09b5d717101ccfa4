"""Search for what must be possible, what is new first: far runs in scopes too large for breadth-first search.

A state is newer than another where it shows a value that no state showed before, else where it shows two
values together that no state showed together before (the novelty of width-based planning; Lipovetzky and
Geffner, ECAI 2012). States that show neither are left out, so that a few thousand stand for millions. What is
new is asked apart for each view, a value that the model defines of the whole state (the robot state): what
has been seen in one view is new in another.

A run that is found is a run; it need not be a shortest one, and where none is found nothing is known.
"""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heappop, heappush

from mmsverify.concrete.compile import Predicate
from mmsverify.concrete.layout import Layout, State
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.search import Exploration, Limits, SearchResult
from mmsverify.concrete.symmetry import Symmetry
from mmsverify.model.rows import Claim
from mmsverify.model.sorts import BOOL

NEW_VALUE, NEW_PAIR, NOTHING_NEW = 1, 2, 3

View = tuple[object, ...]


def reach(
    machine: Machine,
    claims: Sequence[Claim],
    *,
    max_states: int,
    max_depth: int | None = None,
    max_seconds: float | None = None,
) -> SearchResult:
    """Look for witnesses of the ``Sometimes`` claims. It is never ``exhausted``."""
    run = _Reach(machine, Symmetry(machine.layout), claims)
    run.limits = Limits(max_depth, max_states, max_seconds)
    return run.result(run.explore())


class _Reach(Exploration):
    """One run: the states that wait to be expanded, the newest first, then those with the fewest steps."""

    def __init__(self, machine: Machine, symmetry: Symmetry, claims: Sequence[Claim]) -> None:
        super().__init__(machine, symmetry, claims)
        self.novelty = Novelty(machine.layout, _views(machine))
        self.waiting: list[tuple[int, int, int]] = []
        self.steps: list[int] = []

    def explore(self) -> str:
        """Search until every claim is settled, a limit is reached, or nothing new is left; tells which."""
        for state in self.machine.start.states:
            self._discover(state, -1)
        next_states = self.machine.moves(self.of_steps)
        while self.open and self.waiting:
            _, _, index = heappop(self.waiting)
            reason = self.limits.reached(-1, len(self.states))
            if reason:
                return reason
            self._expand(index, next_states(self.states[index]))
        return "states that show nothing new" if self.open else "every claim is settled"

    def _discover(self, state: State, parent: int) -> None:
        index = len(self.states)
        super()._discover(state, parent)
        if len(self.states) == index:  # an initial state that is like one before it
            return
        self.steps.append(0 if parent < 0 else self.steps[parent] + 1)
        self.depth = max(self.depth, self.steps[index])
        rank = self.novelty.rank(self.states[index], None if parent < 0 else self.states[parent])
        farthest = self.limits.depth
        if rank != NOTHING_NEW and (farthest is None or self.steps[index] < farthest):
            heappush(self.waiting, (rank, self.steps[index], index))


class Novelty:
    """Which values of cells have been seen together, by view. A value is a bit, a state a set of bits."""

    def __init__(self, layout: Layout, views: Sequence[Predicate]) -> None:
        self._views = views
        self._first: list[int] = []
        size = 0
        for low, high in layout.ranges:
            self._first.append(size - low)
            size += high - low + 1
        self._seen: dict[View, dict[int, int]] = {}
        self._before: tuple[State | None, View] = (None, ())

    def rank(self, state: State, before: State | None) -> int:
        """How new a state is to which a step from ``before`` leads; what it shows has been seen then."""
        view = self._view(state)
        seen = self._seen.setdefault(view, {})
        bits = [first + code for first, code in zip(self._first, state, strict=True)]
        changed = bits
        if before is not None and self._view_before(before) == view:
            changed = [bit for bit, now, then in zip(bits, state, before, strict=True) if now != then]
        whole = 0
        for bit in bits:
            whole |= 1 << bit
        rank = NOTHING_NEW if all(bit in seen for bit in changed) else NEW_VALUE
        for bit in changed:
            unseen = whole & ~seen.get(bit, 0)
            if unseen:
                rank = min(rank, NEW_PAIR)
                self._see(seen, bit, unseen)
        return rank

    def _see(self, seen: dict[int, int], bit: int, others: int) -> None:
        seen[bit] = seen.get(bit, 0) | others
        while others:
            lowest = others & -others
            other = lowest.bit_length() - 1
            seen[other] = seen.get(other, 0) | 1 << bit
            others ^= lowest

    def _view(self, state: State) -> View:
        return tuple(read(state) for read in self._views)

    def _view_before(self, state: State) -> View:
        """The view of the state that is being expanded: it is asked for again for each step from it."""
        if self._before[0] is not state:
            self._before = (state, self._view(state))
        return self._before[1]


def _views(machine: Machine) -> list[Predicate]:
    """What the model defines of the whole state, if it is more than a mere truth value."""
    model = machine.model
    whole = (name for name, (over, body) in model.definitions.items() if not over and body.sort is not BOOL)
    return [read for name in whole for _, read in machine.readings(name)]

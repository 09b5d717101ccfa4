"""Breadth-first search of the reachable states: every claim checked on the way, shortest paths first.

It counts states, and steps that change the state. Incomplete never looks like complete: ``exhausted`` is
true only if every state of the scope was seen and nothing was cut.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from mmsverify.concrete.compile import Predicate, Successors, TwoStatePredicate
from mmsverify.concrete.formulas import FALSE
from mmsverify.concrete.layout import State
from mmsverify.concrete.machine import Machine, event, speaks_of_steps
from mmsverify.concrete.scope import Scope
from mmsverify.concrete.symmetry import Symmetry
from mmsverify.concrete.trace_path import Path, Retrace
from mmsverify.model import expr as ex
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim


@dataclass(frozen=True, slots=True)
class SearchResult:
    """What a search saw.

    ``states`` counts distinct states (with symmetry: of representatives), ``transitions`` the steps that
    change the state, ``depth`` the steps to the farthest state. ``cut`` tells that a step left the bounds
    of an integer. ``violations`` and ``witnesses`` map names of claims to shortest paths. ``reason`` says
    why the search ended.
    """

    states: int
    transitions: int
    depth: int
    exhausted: bool
    cut: bool
    violations: dict[str, Path]
    witnesses: dict[str, Path]
    seconds: float
    reason: str = ""


def search(
    model: ModelData,
    scope: Scope,
    *,
    claims: Sequence[Claim] | None = None,
    max_depth: int | None = None,
    max_states: int | None = None,
    max_seconds: float | None = None,
    symmetry: bool = False,
    machine: Machine | None = None,
) -> SearchResult:
    """Explore the states of a model in a scope and check ``claims`` (where none are named, all).

    It ends early once every claim is settled (violated, or witnessed); with ``claims=()`` it only counts.
    With ``symmetry`` states that differ by an exchange of like elements count once; the verdicts are the
    same.
    """
    machine = machine or Machine(model, scope)
    run = Exploration(
        machine, Symmetry(machine.layout) if symmetry else None, model.claims if claims is None else claims
    )
    run.limits = Limits(max_depth, max_states, max_seconds)
    return run.result(run.explore())


@dataclass(slots=True)
class Limits:
    """Where a search ends: steps, states, seconds; none where it says nothing."""

    depth: int | None = None
    states: int | None = None
    seconds: float | None = None
    began: float = field(default_factory=time.monotonic)

    @property
    def elapsed(self) -> float:
        return time.monotonic() - self.began

    def reached(self, depth: int, states: int) -> str:
        """Which limit is reached, in words; empty if none is."""
        if self.states is not None and states >= self.states:
            return f"the limit of {self.states} states"
        if self.seconds is not None and self.elapsed >= self.seconds:
            return f"the limit of {self.seconds:g} s"
        if self.depth is not None and depth >= self.depth:
            return f"the limit of {self.depth} steps"
        return ""


class Exploration:
    """One run: the states seen in order of discovery, each with its predecessor."""

    def __init__(self, machine: Machine, symmetry: Symmetry | None, claims: Sequence[Claim]) -> None:
        self.machine = machine
        self.symmetry = symmetry
        self.limits = Limits()
        self.states: list[State] = []
        self.parents: list[int] = []
        self.seen: dict[State, int] = {}
        self.transitions = self.depth = 0
        self.cut = False
        self.open = list(claims)
        self.ever = bool(claims)
        self.found: dict[str, tuple[Claim, int]] = {}
        self.of_steps = [claim for claim in claims if speaks_of_steps(claim)]
        self._compiled: dict[int, TwoStatePredicate] = {}
        self._checks: dict[int, list[tuple[Claim, TwoStatePredicate]]] = {}
        self.quiet = self._quiet()

    def explore(self) -> str:
        """Search until nothing is new or a limit is reached; why it ended, empty if it is complete."""
        for state in self.machine.start.states:
            self._discover(state, -1)
        next_states = self.machine.moves(self.of_steps)
        done, level = 0, len(self.states)
        while done < level:
            reason = self._level(range(done, level), next_states)
            if reason:
                return reason
            done, level = level, len(self.states)
            self.depth += level > done
        return ""

    def _level(self, frontier: range, next_states: Successors) -> str:
        """Expand the states of one depth; the reason to stop, if there is one."""
        for index in frontier:
            if index & 255 == 0 or index == frontier.start:
                reason = self.limits.reached(self.depth, len(self.states))
                if reason:
                    return reason
            self._expand(index, next_states(self.states[index]))
            if self.ever and not self.open:
                return "every claim is settled"
        return ""

    def _expand(self, index: int, steps: list[tuple[int, State | None]]) -> None:
        state, seen, symmetry, watched = self.states[index], self.seen, self.symmetry, bool(self.of_steps)
        for number, after in steps:
            if after is None:
                self.cut = True
                continue
            if watched:
                self._check_step(index, number, after)
            if after == state:
                continue
            self.transitions += 1
            key = symmetry.canonical(after) if symmetry else after
            if key not in seen:
                self._discover(key, index)

    def _discover(self, state: State, parent: int) -> None:
        if self.symmetry and parent < 0:
            state = self.symmetry.canonical(state)
            if state in self.seen:
                return
        index = self.seen[state] = len(self.states)
        self.states.append(state)
        self.parents.append(parent)
        if not self.quiet(state):
            self._settle_state(index)

    def _settle_state(self, index: int) -> None:
        for claim in [c for c in self.open if not speaks_of_steps(c)]:
            if self.machine.predicate(event(claim))(self.states[index]):
                self._settle(claim, index)
        self.quiet = self._quiet()

    def _check_step(self, index: int, number: int, after: State) -> None:
        for claim, happens in self._step_checks(number):
            if claim.name not in self.found and happens(self.states[index], after):
                self._settle(claim, index)

    def _settle(self, claim: Claim, index: int) -> None:
        self.found[claim.name] = (claim, index)
        self.open.remove(claim)

    def _quiet(self) -> Predicate:
        """True of the states that settle no open claim."""
        return self.machine.predicate(
            ex.conjunction(*(ex.negation(event(claim)) for claim in self.open if not speaks_of_steps(claim)))
        )

    def _step_checks(self, number: int) -> list[tuple[Claim, TwoStatePredicate]]:
        checks = self._checks.get(number)
        if checks is None:
            formulas = [(claim, self.machine.check(claim, number)) for claim in self.of_steps]
            checks = self._checks[number] = [
                (c, self._two_state(formula)) for c, formula in formulas if formula != FALSE
            ]
        return checks

    def _two_state(self, formula: int) -> TwoStatePredicate:
        if formula not in self._compiled:
            self._compiled[formula] = self.machine.step_predicate(formula)
        return self._compiled[formula]

    def result(self, reason: str) -> SearchResult:
        """The outcome, with the path of every settled claim."""
        start, paths = self.machine.start, dict(self._paths())
        why = reason or ("" if start.complete else "more initial states than the limit")
        why = why or ("an integer left its bounds" if self.cut else "")
        return SearchResult(
            states=len(self.states), transitions=self.transitions, depth=self.depth,
            exhausted=not why, cut=self.cut,
            violations={n: path for n, path in paths.items() if self.found[n][0].kind != "sometimes"},
            witnesses={n: path for n, path in paths.items() if self.found[n][0].kind == "sometimes"},
            seconds=self.limits.elapsed, reason=why,
        )  # fmt: skip

    def _paths(self) -> Iterator[tuple[str, Path]]:
        retrace = Retrace(self.machine, self.symmetry.canonical if self.symmetry else lambda state: state)
        for name, (claim, index) in self.found.items():
            yield name, retrace.path(list(self._back(index))[::-1], claim if speaks_of_steps(claim) else None)

    def _back(self, index: int) -> Iterator[State]:
        while index >= 0:
            yield self.states[index]
            index = self.parents[index]

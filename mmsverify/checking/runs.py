"""Runs that settle claims, looked for breadth first in small worlds and replayed before they are believed.

Claims to which the same variables matter are settled in one search, of the part of the model that matters.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile

from mmsverify.checking.profile_facts import applies
from mmsverify.checking.request import Progress, Request
from mmsverify.checking.worlds import World
from mmsverify.concrete import Machine, Path, Scope, SearchResult, path_steps, reach, replay, search
from mmsverify.concrete.scope import CellKey, Value
from mmsverify.concrete.slicing import cone, narrowed, restored, sliced
from mmsverify.model import expr as ex
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.model.sorts import ElementSort
from mmsverify.results import PathStep

LARGEST_SET = 1
"""Members of the sets that a search for witnesses alone tries: most rows ask only whether there is one."""


@dataclass(frozen=True, slots=True)
class Run:
    """A run that breaks a claim or reaches what a ``Sometimes`` says: as printed, and as it is taken."""

    steps: tuple[PathStep, ...]
    world: Scope
    path: Path

    @property
    def scope(self) -> str:
        """The scope as results print it."""
        return str(self.world)

    @property
    def facts(self) -> Mapping[CellKey, Value]:
        """What is fixed in the scope."""
        return self.world.facts

    @property
    def length(self) -> int:
        """Steps after the initial state."""
        return len(self.steps) - 1


@dataclass(frozen=True, slots=True)
class Search:
    """How far a search without a run went: all states of the scope, or every state within ``depth`` steps."""

    scope: str
    depth: int
    exhausted: bool
    reason: str


class Explorer:
    """Searches for runs of one model; keeps what it found, and how far it looked where it found nothing."""

    def __init__(self, model: ModelData, request: Request, progress: Progress = None) -> None:
        self.model, self.request, self.progress = model, request, progress
        self.runs: dict[str, Run] = {}
        self.searches: dict[str, list[Search]] = {}
        self.seconds: dict[str, float] = {}

    def explore(
        self, claims: Sequence[Claim], worlds: Iterable[World], *, states: int, few: bool = True
    ) -> None:
        """Look for a run that settles each claim, at most ``states`` states a world."""
        for world in worlds:
            scope = world.scope(self.model, few)
            open_here = [c for c in claims if c.name not in self.runs and self._concerns(scope, c)]
            for group in self._groups(open_here):
                self._tell(scope, group)
                self._search(scope, group, states)

    def reach(self, claims: Sequence[Claim], world: World, *, states: int, together: bool) -> None:
        """Look for witnesses, not the shortest, in a world; ``together``: of all claims in one search."""
        scope = world.scope(self.model)
        left = [c for c in claims if c.name not in self.runs and self._concerns(scope, c)]
        for group in [left] if together and left else self._groups(left):
            self._tell(scope, group)
            begin = time.monotonic()
            part = sliced(self.model, group)
            machine = Machine(part, replace(narrowed(part, scope), largest_set=LARGEST_SET))
            possible = [claim for claim in group if not machine.out_of_reach(claim)]
            if possible:
                depth, seconds = self.request.depth, self.request.seconds_for(len(possible))
                result = reach(machine, possible, max_states=states, max_depth=depth, max_seconds=seconds)
                for claim in possible:
                    if claim.name in result.witnesses:
                        self._believe(scope, claim, result.witnesses[claim.name])
            self._spent(group, begin)

    def _groups(self, claims: Sequence[Claim]) -> Iterator[list[Claim]]:
        """The claims that are alike, as long as there is time."""
        return takewhile(lambda _: not self.request.over, alike(self.model, claims))

    def shorten(self, claims: Sequence[Claim], worlds: Iterable[World], *, states: int) -> None:
        """Look for shorter counterexamples than those found, in worlds where the claims were not refuted."""
        for world in worlds:
            scope = world.scope(self.model)
            known = [c for c in claims if c.name in self.runs and self.runs[c.name].facts != scope.facts]
            for group in self._groups(known):
                self._search(scope, group, states, max(self.runs[c.name].length for c in group) - 1)

    def _concerns(self, scope: Scope, claim: Claim) -> bool:
        """Whether the claim is made of the scope's profile, and elements of all its sorts are there."""
        if not applies(self.model, claim, scope):
            return False
        read = (self.model.signatures[name].sorts for name in ex.variables_of(claim.formula))
        return all(scope.names(sort) for sorts in read for sort in sorts if isinstance(sort, ElementSort))

    def _tell(self, scope: Scope, group: Sequence[Claim]) -> None:
        if self.progress:
            self.progress(f"{self.model.name}: {scope}: looking for runs, {len(group)} properties open")

    def _search(self, scope: Scope, group: Sequence[Claim], states: int, longest: int | None = None) -> None:
        begin = time.monotonic()
        self._settle(scope, group, states, self.request.depth if longest is None else longest)
        self._spent(group, begin)

    def _settle(self, scope: Scope, group: Sequence[Claim], states: int, depth: int | None) -> None:
        part = sliced(self.model, group)
        tight = narrowed(part, scope)
        machine = Machine(part, tight)
        idle = [claim for claim in group if machine.out_of_reach(claim)]
        for claim in idle:
            self.searches.setdefault(claim.name, []).append(Search(str(scope), 0, True, ""))
        group = [claim for claim in group if claim not in idle]
        if not group:
            return
        result = search(
            part, tight, claims=group, machine=machine, symmetry=True,
            max_states=states, max_depth=depth, max_seconds=self.request.seconds_for(len(group)),
        )  # fmt: skip
        for claim in group:
            self._keep(scope, claim, result)

    def _keep(self, scope: Scope, claim: Claim, result: SearchResult) -> None:
        short = {**result.violations, **result.witnesses}.get(claim.name)
        if short is None:
            seen = Search(str(scope), result.depth, result.exhausted, result.reason)
            self.searches.setdefault(claim.name, []).append(seen)
            return
        if claim.name in self.runs and self.runs[claim.name].length < len(short):
            return
        self._believe(scope, claim, short)

    def _spent(self, claims: Sequence[Claim], begin: float) -> None:
        """Share what a search took since it began among its claims."""
        share = (time.monotonic() - begin) / len(claims)
        for claim in claims:
            self.seconds[claim.name] = self.seconds.get(claim.name, 0.0) + share

    def _believe(self, scope: Scope, claim: Claim, short: Path) -> None:
        """Keep a run of a part of the model once the whole model has taken it again."""
        path = restored(self.model, scope, short)
        replay(self.model, scope, path, claim)
        self.runs[claim.name] = Run(path_steps(self.model, scope, path), scope, path)


def alike(model: ModelData, claims: Sequence[Claim]) -> Iterator[list[Claim]]:
    """The claims in groups that the same variables matter to; the group with the fewest variables first."""
    groups: dict[frozenset[str], list[Claim]] = {}
    for claim in claims:
        groups.setdefault(cone(model, claim), []).append(claim)
    return (groups[variables] for variables in sorted(groups, key=lambda names: (len(names), sorted(names))))

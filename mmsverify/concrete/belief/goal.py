"""An event that is about to be judged, and what in a state stands in its way.

Rows of an event that make the same updates are alternatives: where one of them certainly applies, the others
add nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from mmsverify.concrete.belief.compiled import CompiledRow, compiled
from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.patterns import Pattern, at
from mmsverify.concrete.belief.truth import Env
from mmsverify.concrete.belief.values import NO, YES
from mmsverify.model.rows import Row

Patterns = frozenset[Pattern]
NOTHING: Patterns = frozenset()


@dataclass(frozen=True, slots=True)
class Step:
    """A row in an environment, with the cells that each of its conditions and its updates touch."""

    row: CompiledRow
    env: Env
    needs: tuple[Patterns, ...]
    takes: Patterns
    writes: Patterns

    @property
    def reads(self) -> Patterns:
        """The cells that its conditions and updates read."""
        return self.takes.union(*self.needs)

    def obstacle(self, state: Partial) -> Patterns | None:
        """What a condition that certainly fails reads; ``None`` where none does."""
        if self.row.chosen:
            return self.reads if self.row.impossible(state, self.env) else None
        for test, needs in zip(self.row.tests, self.needs, strict=True):
            if test(state, self.env) == NO:
                return needs
        return None

    def doubts(self, state: Partial) -> Patterns:
        """What the conditions read that hold in some of the states that ``state`` stands for, not in all."""
        if self.row.chosen:
            return self.reads
        return NOTHING.union(
            *(
                needs
                for test, needs in zip(self.row.tests, self.needs, strict=True)
                if test(state, self.env) != YES
            )
        )


def step(row: Row, env: Env) -> Step:
    """The row with the names of an environment."""
    ready = compiled(row)
    return Step(
        ready,
        env,
        tuple(at(needs, env) for needs in ready.conditions),
        at(ready.takes, env),
        at(ready.writes, env),
    )


class Goal:
    """The rows that may explain an event, in its environment."""

    def __init__(self, rows: Sequence[Row], env: Env) -> None:
        self.env = env
        self.steps = [step(row, env) for row in rows]
        self.groups = _alike(tuple(map(_Same, rows)))
        self.key = (rows[0].id if rows else "", rows[0].answer if rows else "", frozenset(env.items()))
        self.reads = NOTHING.union(*(each.reads for each in self.steps))

    def impossible(self, state: Any) -> bool:
        """Whether the state certainly contradicts it."""
        return all(each.row.impossible(state, self.env) for each in self.steps)

    def wants(self, state: Partial) -> Iterator[tuple[Patterns, Patterns, Patterns]]:
        """What must come before the event for it to be another one than in this state.

        Each as three sets of cells: those whose change may let a row apply, those that its updates read,
        those that they write. Where a row applies already, only what its updates touch is asked for: all else
        may as well come after.
        """
        for group in self.groups:
            steps = [self.steps[i] for i in group]
            obstacles = [each.obstacle(state) for each in steps]
            possible = [s for s, obstacle in zip(steps, obstacles, strict=True) if obstacle is None]
            doubts = [each.doubts(state) for each in possible]
            takes, writes = steps[0].takes, steps[0].writes
            if NOTHING in doubts:
                yield NOTHING, takes, writes
                continue
            if possible:
                yield NOTHING.union(*doubts), takes, writes
            yield NOTHING.union(*(o for o in obstacles if o is not None)), NOTHING, NOTHING


class _Same:
    """A row by identity, for to compare rows is to walk their expressions."""

    __slots__ = ("row",)

    def __init__(self, row: Row) -> None:
        self.row = row

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and self.row is other.row

    def __hash__(self) -> int:
        return id(self.row)


@cache
def _alike(rows: tuple[_Same, ...]) -> tuple[tuple[int, ...], ...]:
    """The places of the rows that make the same updates, together."""
    groups: dict[Any, list[int]] = {}
    for place, each in enumerate(rows):
        groups.setdefault((each.row.assigns, each.row.choices), []).append(place)
    return tuple(map(tuple, groups.values()))

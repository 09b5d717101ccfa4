"""An event that is about to be judged, and what in a state stands in its way.

Rows of an event that make the same updates are alternatives: where one of them certainly applies, the others
add nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any

from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.ready import Ready, Rows
from mmsverify.concrete.belief.values import NO, YES, Env
from mmsverify.model.rows import Row

Ways = tuple[Ready, ...]


def obstacle(ways: Ways, state: Partial) -> int | None:
    """The cells of conditions that certainly fail, one for each way; ``None`` where some way may be open."""
    found = 0
    for way in ways:
        for formula, needs in zip(way.guard, way.needs, strict=True):
            if formula.holds(state) == NO:
                found |= needs
                break
        else:
            return None
    return found


def doubts(ways: Ways, state: Partial) -> int | None:
    """The cells of conditions that are open; ``None`` where the row certainly applies, in its only way."""
    if len(ways) == 1 and all(formula.holds(state) == YES for formula in ways[0].guard):
        return None
    found = 0
    for way in ways:
        for formula, needs in zip(way.guard, way.needs, strict=True):
            if formula.holds(state) != YES or len(ways) > 1:
                found |= needs
    return found


class Goal:
    """The rows that may explain an event, in its environment."""

    def __init__(self, rows: Sequence[Row], env: Env, made: Rows) -> None:
        self.env = env
        self.rows = tuple(rows)
        self.ways = [made.ready(row, env) for row in rows]
        self.groups = _alike(tuple(map(_Same, rows)))
        self.key = (rows[0].id if rows else "", rows[0].answer if rows else "", frozenset(env.items()))
        self.reads = 0
        for way in (way for ways in self.ways for way in ways):
            self.reads |= way.reads

    def impossible(self, state: Partial) -> bool:
        """Whether the state certainly contradicts it."""
        return all(obstacle(ways, state) is not None for ways in self.ways)

    def wants(self, state: Partial) -> Iterator[tuple[int, int, int]]:
        """What must come before the event for it to be another one than in this state.

        Each as three sets of cells: those whose change may let a row apply, those that its updates read,
        those that they write. Where a row applies already, only what its updates touch is asked for: all else
        may as well come after.
        """
        for group in self.groups:
            ways = [self.ways[i] for i in group]
            takes = writes = 0
            for way in (way for each in ways for way in each):
                takes |= way.takes
                writes |= way.writes
            obstacles = [obstacle(each, state) for each in ways]
            open_ways = [each for each, o in zip(ways, obstacles, strict=True) if o is None]
            doubted = [doubts(each, state) for each in open_ways]
            lets = 0
            if None not in doubted:
                for cells in (*obstacles, *doubted):
                    lets |= cells or 0
            if open_ways:
                yield lets, takes, writes
            else:
                yield lets, 0, 0


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

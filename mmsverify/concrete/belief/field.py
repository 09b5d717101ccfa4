"""What can happen unseen, and which of it can wait: steps that touch different cells need no order.

A set of steps is an integer with a bit for each. The search takes, in a state, only the steps of a *stubborn
set* (Valmari): what may remove an obstacle to the event, what may remove an obstacle to that, and whatever
disturbs or is disturbed by a member that can be taken. Every other step can be moved behind the first
member that is taken, so that leaving it out loses no state, except as one that is reached after the event.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from mmsverify.concrete.belief.goal import NOTHING, Goal, Patterns, Step
from mmsverify.concrete.belief.partial import Partial

Tag = tuple[str, tuple[str, ...]]
History = frozenset[Tag]


@dataclass(frozen=True, slots=True)
class Move:
    """Something that may happen unseen, once between two events for the names in its tag.

    One of ``ways`` is taken. ``bars`` are the tags' names after which it does not happen. ``explains``: it is
    assumed only where it makes possible what is shown, not where it merely may have happened.
    """

    tag: Tag
    ways: tuple[Step, ...]
    reads: Patterns
    writes: Patterns
    bars: frozenset[str] = frozenset()
    explains: bool = False
    enabled: Any = None

    def obstacle(self, state: Partial) -> Patterns | None:
        """What stands against it in the state; ``None`` if nothing does for certain."""
        if self.enabled is not None:
            return self.enabled(state)  # type: ignore[no-any-return]
        found = [way.obstacle(state) for way in self.ways]
        return None if None in found else NOTHING.union(*(f for f in found if f is not None))


def move(tag: Tag, ways: Sequence[Step], bars: Iterable[str] = (), *, explains: bool = False) -> Move:
    """The move that takes one of the steps."""
    return Move(
        tag,
        tuple(ways),
        NOTHING.union(*(way.reads for way in ways)),
        NOTHING.union(*(way.writes for way in ways)),
        frozenset(bars),
        explains,
    )


@dataclass(slots=True)
class _Index:
    """Which steps touch a cell."""

    by_variable: dict[str, list[tuple[tuple[str | None, ...], int]]] = field(default_factory=dict)
    _memo: dict[Patterns, int] = field(default_factory=dict)

    def add(self, patterns: Patterns, bit: int) -> None:
        for variable, args in patterns:
            self.by_variable.setdefault(variable, []).append((args, bit))

    def touching(self, patterns: Patterns) -> int:
        """The steps that touch one of the cells."""
        found = self._memo.get(patterns)
        if found is None:
            found = self._memo[patterns] = self._touching(patterns)
        return found

    def _touching(self, patterns: Patterns) -> int:
        found = 0
        for variable, args in patterns:
            for mine, bit in self.by_variable.get(variable, ()):
                if not found & bit and all(
                    a is None or b is None or a == b for a, b in zip(mine, args, strict=True)
                ):
                    found |= bit
        return found


class Field:
    """The moves that may come before an event, and how they disturb each other."""

    def __init__(self, moves: Sequence[Move]) -> None:
        self.moves = moves
        self._readers, self._writers = _Index(), _Index()
        self._tags: dict[Tag, int] = {}
        self._named: dict[str, int] = {}
        self._barred: dict[str, int] = {}
        self._disturbed: list[int | None] = [None] * len(moves)
        self._gone: dict[History, int] = {}
        self._marked = self._explaining = 0
        for number, each in enumerate(moves):
            bit = 1 << number
            self._readers.add(each.reads, bit)
            self._writers.add(each.writes, bit)
            self._tags[each.tag] = self._tags.get(each.tag, 0) | bit
            self._named[each.tag[0]] = self._named.get(each.tag[0], 0) | bit
            if each.enabled is not None:
                self._marked |= bit
            if each.explains:
                self._explaining |= bit
            for name in each.bars:
                self._barred[name] = self._barred.get(name, 0) | bit

    def gone(self, history: History) -> int:
        """The moves that cannot come any more: they have been made, or others bar them."""
        found = self._gone.get(history)
        if found is None:
            found = 0
            for tag in history:
                found |= self._tags.get(tag, 0) | self._barred.get(tag[0], 0)
            self._gone[history] = found
        return found

    def next(self, state: Partial, history: History, goal: Goal) -> tuple[list[Move], list[Move]]:
        """The moves to try in the state, and those that may have been made before any of them.

        All others can wait. Of the second kind it does not matter which have been made: they only disturb.
        """
        gone = self.gone(history)
        members = tried = disturb = 0
        todo = self._roots(state, goal) & ~gone
        while todo:
            number = (todo & -todo).bit_length() - 1
            members |= 1 << number
            obstacle = self.moves[number].obstacle(state)
            if obstacle is None:
                tried |= 1 << number
                disturb |= self._disturbing(number)
            else:
                todo |= self._writers.touching(obstacle)
            todo &= ~members & ~gone
        beside, gone = 0, gone | self._explaining
        disturb &= ~members & ~gone
        while disturb:
            number = (disturb & -disturb).bit_length() - 1
            members |= 1 << number
            obstacle = self.moves[number].obstacle(state)
            if obstacle is None:
                beside |= 1 << number
                disturb |= self._disturbing(number)
            else:
                disturb |= self._writers.touching(obstacle)
            disturb &= ~members & ~gone
        tried |= beside & self._marked
        return self._listed(tried), self._listed(beside & ~self._marked)

    def _listed(self, found: int) -> list[Move]:
        return [self.moves[number] for number in bits(found)]

    def _roots(self, state: Partial, goal: Goal) -> int:
        found = 0
        for lets, takes, writes in goal.wants(state):
            found |= self._writers.touching(lets)
            found |= self._writers.touching(takes) | self._writers.touching(writes)
            found |= self._readers.touching(writes)
        return found

    def _disturbing(self, number: int) -> int:
        """The moves whose order with this one may matter."""
        found = self._disturbed[number]
        if found is None:
            mine = self.moves[number]
            found = self._writers.touching(mine.reads) | self._writers.touching(mine.writes)
            found |= self._readers.touching(mine.writes)
            found |= self._tags[mine.tag] | self._barred.get(mine.tag[0], 0)
            for name in mine.bars:
                found |= self._named.get(name, 0)
            self._disturbed[number] = found
        return found


def bits(found: int) -> Iterator[int]:
    """The places of the bits that are set."""
    while found:
        low = found & -found
        yield low.bit_length() - 1
        found ^= low

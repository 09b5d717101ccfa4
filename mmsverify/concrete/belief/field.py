"""What can happen unseen, and which of it can wait: moves that touch different cells need no order.

A set of moves, like a set of cells, is an integer with bits. The search tries, in a state, only the moves of
a *stubborn set* (Valmari): what may remove an obstacle to the event, what may remove an obstacle to that, and
whatever disturbs or is disturbed by a member that can be made. Every other move can be put behind the first
member that is made, so that leaving it out loses no state, except as one that is reached after the event.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from mmsverify.concrete.belief.goal import Goal, Ways, obstacle
from mmsverify.concrete.belief.partial import OTHER, Partial

Tag = tuple[str, tuple[str, ...]]
History = frozenset[Tag]


@dataclass(frozen=True, slots=True, eq=False)
class Move:
    """Something that may happen unseen, with names.

    One of ``ways`` is taken. ``bars`` are the tags' names after which it does not happen. ``explains``: it is
    assumed only where it makes possible what is shown and was not, not where it merely may have happened.
    ``stands`` tells what stands against it, where that is not in its rows.
    """

    tag: Tag
    ways: Ways
    reads: int
    writes: int
    bars: frozenset[str] = frozenset()
    explains: bool = False
    stands: Callable[[Partial], int | None] | None = None

    def obstacle(self, state: Partial) -> int | None:
        """The cells that stand against it in the state; ``None`` if it may be made."""
        return obstacle(self.ways, state) if self.stands is None else self.stands(state)


def move(tag: Tag, ways: Ways, bars: Iterable[str] = (), *, explains: bool = False) -> Move:
    """The move that takes one of the ways."""
    reads = writes = 0
    for way in ways:
        reads |= way.reads
        writes |= way.writes
    return Move(tag, ways, reads, writes, frozenset(bars), explains)


class Field:
    """The moves that may come before an event, and how they disturb each other."""

    def __init__(self, moves: Sequence[Move]) -> None:
        self.moves = moves
        self._tags: dict[Tag, int] = {}
        self._named: dict[str, int] = {}
        self._barred: dict[str, int] = {}
        self._disturbed: list[int | None] = [None] * len(moves)
        self._writers: dict[int, int] = {}
        self._gone: dict[History, int] = {}
        self._marked = self._explaining = 0
        for number, each in enumerate(moves):
            bit = 1 << number
            self._tags[each.tag] = self._tags.get(each.tag, 0) | bit
            self._named[each.tag[0]] = self._named.get(each.tag[0], 0) | bit
            if each.stands is not None:
                self._marked |= bit
            if each.explains:
                self._explaining |= bit
            for name in each.bars:
                self._barred[name] = self._barred.get(name, 0) | bit

    def gone(self, history: History) -> int:
        """The moves that cannot come any more: they have been made and come but once, or others bar them.

        What one unseen name has done, another may do.
        """
        found = self._gone.get(history)
        if found is None:
            found = 0
            for tag in history:
                found |= self._barred.get(tag[0], 0) | (0 if OTHER in tag[1] else self._tags.get(tag, 0))
            self._gone[history] = found
        return found

    def next(self, state: Partial, history: History, goal: Goal) -> tuple[list[Move], list[Move]]:
        """The moves to try in the state, and those that may have been made before any of them.

        All others can wait. Of the second kind it does not matter which have been made: they only disturb.
        """
        gone = self.gone(history)
        if self._explaining and not goal.impossible(state):
            gone |= self._explaining  # the state allows what is shown: nothing needs an explanation
        members = tried = disturb = 0
        todo = self._roots(state, goal) & ~gone
        while todo:
            number = (todo & -todo).bit_length() - 1
            members |= 1 << number
            stands = self.moves[number].obstacle(state)
            if stands is None:
                tried |= 1 << number
                disturb |= self._disturbing(number)
            else:
                todo |= self._writing(stands)
            todo &= ~members & ~gone
        beside, gone = 0, gone | self._explaining
        disturb &= ~members & ~gone
        while disturb:
            number = (disturb & -disturb).bit_length() - 1
            members |= 1 << number
            stands = self.moves[number].obstacle(state)
            if stands is None:
                beside |= 1 << number
                disturb |= self._disturbing(number)
            else:
                disturb |= self._writing(stands)
            disturb &= ~members & ~gone
        tried |= beside & self._marked
        return self._listed(tried), self._listed(beside & ~self._marked)

    def _listed(self, found: int) -> list[Move]:
        return [self.moves[number] for number in bits(found)]

    def _roots(self, state: Partial, goal: Goal) -> int:
        found = 0
        for lets, takes, writes in goal.wants(state):
            found |= self._writing(lets | takes | writes)
            if writes:
                for number, each in enumerate(self.moves):
                    if each.reads & writes:
                        found |= 1 << number
        return found

    def _writing(self, cells: int) -> int:
        """The moves that may change one of the cells."""
        found = self._writers.get(cells)
        if found is None:
            found = 0
            for number, each in enumerate(self.moves):
                if each.writes & cells:
                    found |= 1 << number
            self._writers[cells] = found
        return found

    def _disturbing(self, number: int) -> int:
        """The moves whose order with this one may matter."""
        found = self._disturbed[number]
        if found is None:
            mine = self.moves[number]
            found = self._tags[mine.tag] | self._barred.get(mine.tag[0], 0)
            for name in mine.bars:
                found |= self._named.get(name, 0)
            for other, each in enumerate(self.moves):
                if each.writes & (mine.reads | mine.writes) or each.reads & mine.writes:
                    found |= 1 << other
            self._disturbed[number] = found
        return found


def bits(found: int) -> Iterator[int]:
    """The places of the bits that are set."""
    while found:
        low = found & -found
        yield low.bit_length() - 1
        found ^= low

"""The smallest set of earlier messages that exclude an event: found by doubting all others.

What is asked of a set is whether the finding still comes when every message outside it is doubted, as
`doubting` takes that word. More messages only exclude more, so the question is monotone, and a set from which
nothing can be left out is found with few questions: first how late one may begin to listen, which names a
message that is needed; then, by halves, which of those after it are (QuickXplain: U. Junker, AAAI 2004). In
the end each member is left out once more: that the set is irreducible is not derived, but tried. Of several
irreducible sets the one of the latest messages is found; where a single message among those that wrote what
was contradicted will do instead, that is taken. No smaller one is looked for beyond that.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

Asks = Callable[[int, frozenset[int]], bool]
"""Whether the finding comes when turns before a number are unheard, and of the others only these believed."""


class GivenUpError(Exception):
    """There are no questions left."""


@dataclass(frozen=True, slots=True)
class Found:
    """The turns of the set; ``irreducible``: without any one of them the finding did not come."""

    turns: tuple[int, ...]
    irreducible: bool


def smallest(count: int, asks: Asks, likely: Collection[int], alone: Collection[int] = ()) -> Found | None:
    """The set for the turns 0 to ``count`` - 1; ``None`` where all of them together do not do.

    ``likely`` are turns to be tried first, those of ``alone`` each by itself, before all else. ``asks`` may
    raise ``GivenUpError``; then the set is as small as was reached by then.
    """
    search = _Search(count, asks, sorted({turn for turn in likely if 0 <= turn < count}))
    try:
        if not search.is_one_of(alone):
            if not search.begins():
                return None
            search.reduce()
        irreducible = search.irreducible()
    except GivenUpError:
        return Found(tuple(sorted(search.best)), irreducible=False) if search.best is not None else None
    assert search.best is not None
    return Found(tuple(sorted(search.best)), irreducible)


class _Search:
    """``best`` is the smallest set so far that does."""

    def __init__(self, count: int, asks: Asks, likely: Sequence[int]) -> None:
        self._count, self._asks, self._likely = count, asks, likely
        self.best: frozenset[int] | None = None
        self._first = count

    def _does(self, turns: Collection[int], first: int | None = None) -> bool:
        """Whether a set does; one that does is kept if it is smaller."""
        kept = frozenset(turns)
        found = self._asks(min(kept, default=self._count) if first is None else first, kept)
        if found and (self.best is None or len(kept) < len(self.best)):
            self.best = kept
        return found

    def _from(self, first: int) -> bool:
        return self._does(range(first, self._count), first)

    def is_one_of(self, turns: Collection[int]) -> bool:
        """Whether one of these alone does, or none at all."""
        return bool(turns) and (self._from(self._count) or any(self._does({turn}) for turn in turns))

    def begins(self) -> bool:
        """Find how late one may begin to listen; whether the finding comes at all."""
        if self._from(self._count):
            return True
        too_late, enough = self._count, self._count
        while enough == self._count:
            back = max(1, 2 * (self._count - too_late))
            first = max(0, self._count - back)
            if self._from(first):
                enough = first
            elif first == 0:
                return False
            else:
                too_late = first
        while too_late - enough > 1:
            middle = (too_late + enough) // 2
            if self._from(middle):
                enough = middle
            else:
                too_late = middle
        self._first = enough
        return True

    def reduce(self) -> None:
        """Leave out what is not needed."""
        if self._first == self._count:
            return
        needed = frozenset({self._first})
        likely = frozenset(turn for turn in self._likely if turn > self._first)
        rest = sorted(likely) if self._does(needed | likely) else list(range(self._first + 1, self._count))
        if not self._does(needed):
            self._does(needed | self._explain(needed, rest))
        assert self.best is not None
        if len(self.best) > 1:
            any(self._does({turn}) for turn in reversed(self._likely) if turn < self._first)

    def _explain(self, background: frozenset[int], turns: Sequence[int]) -> frozenset[int]:
        """Those of ``turns`` that are needed beside the background; the first half is left out first."""
        if len(turns) == 1:
            return frozenset(turns)
        if not turns:
            return frozenset()
        half = len(turns) // 2
        older, later = turns[:half], turns[half:]
        return self._halves(background, older, later)

    def _halves(
        self, background: frozenset[int], older: Sequence[int], later: Sequence[int]
    ) -> frozenset[int]:
        with_later = background | frozenset(later)
        needed = frozenset() if self._does(with_later) else self._explain(with_later, older)
        with_needed = background | needed
        more = frozenset() if self._does(with_needed) else self._explain(with_needed, later)
        return needed | more

    def irreducible(self) -> bool:
        """Leave out each member once more; one that is not needed after all is gone."""
        assert self.best is not None
        for turn in sorted(self.best):
            self._does(self.best - {turn})
        return True

"""Which statements the events of a recording have exercised: what a register tells of a sample.

Only what is certain counts: a row that alone explains an answer, a condition that the message at hand could
have broken. Events that no message shows are possibilities, and never count.
"""

from __future__ import annotations

from collections.abc import Sequence

from mmsverify.concrete.belief.goal import Goal
from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.values import YES
from mmsverify.model.rows import Clause, Row


class Coverage:
    """The statements that have been exercised so far."""

    def __init__(self) -> None:
        self.clauses: set[Clause] = set()

    def taken(self, rows: Sequence[Row]) -> None:
        """An event can be explained by one of these rows."""
        if len({row.id for row in rows}) == 1:
            self.clauses.add(rows[0].clause)

    def shown(self, goal: Goal, blank: Partial) -> None:
        """A message agrees with what is known; ``blank`` is a state of which nothing is."""
        for row, ways in zip(goal.rows, goal.ways, strict=True):
            tested = [
                any(formula.holds(blank) != YES for formula in parts)
                for parts in zip(*(w.guard for w in ways), strict=True)
            ]
            self.clauses.add(row.clause)
            self.clauses |= {c.clause for c, tests in zip(row.guard, tested, strict=True) if tests}

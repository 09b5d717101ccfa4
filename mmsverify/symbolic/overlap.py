"""Gaps and overlaps: states in which no row answers an event, or in which two rows answer it differently.

Rows that a procedure's steps give exclude each other on their face; the others are asked of Z3, under the
invariants that are given. An overlap is no mistake where the text leaves a choice to the responder. Two
rows with one answer and one effect are no overlap.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import z3

from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr
from mmsverify.model.model import ModelData
from mmsverify.model.rewrite import bind, rebuilt
from mmsverify.model.rows import Claim, Row, after
from mmsverify.model.terms import SetOf
from mmsverify.symbolic.allowed import Allowed


@dataclass(frozen=True, slots=True)
class Overlap:
    """Two rows that can answer the same event in one state, with different answers or effects."""

    event: str
    rows: tuple[str, str]


@dataclass(frozen=True, slots=True)
class Unanswered:
    """An event that no row answers in some state; ``proved`` is false where Z3 gave no answer."""

    event: str
    proved: bool


class Coverage:
    """Asks, for each event of a model, which of its rows can be taken where the invariants hold."""

    def __init__(self, model: ModelData, invariants: Sequence[Claim], *, timeout: float = 5.0) -> None:
        self.model = model
        self._allowed = Allowed(model, invariants, timeout=timeout)

    def overlaps(self) -> Iterator[Overlap]:
        """Pairs of rows of one event that can both be taken, and then answer or act differently."""
        for event, rows in self._events().items():
            for left, right in combinations(rows, 2):
                if not _exclusive(left, right) and self._both(left, right):
                    yield Overlap(event, (left.id, right.id))

    def gaps(self) -> Iterator[Unanswered]:
        """Events whose answer is due (responses) but for which no row can be taken in some state."""
        for event, rows in self._events().items():
            if rows[0].on.phase == "response":
                answer = self._allowed.ask(*(ex.negation(_possible(row)) for row in rows))
                if answer != z3.unsat:
                    yield Unanswered(event, answer == z3.sat)

    def _events(self) -> dict[str, list[Row]]:
        events: dict[str, list[Row]] = {}
        for row in self.model.actions:
            if row.on.phase != "internal":
                events.setdefault(str(row.on), []).append(row)
        return events

    def _both(self, left: Row, right: Row) -> bool:
        if left.answer == right.answer and set(left.assigns) == set(right.assigns):
            return False
        differ = ex.TRUE if left.answer != right.answer else ex.negation(self._same_effect(left, right))
        return self._allowed.possible(left.guard_formula, right.guard_formula, differ)

    def _same_effect(self, left: Row, right: Row) -> Expr:
        """Every cell that either row writes gets the same value from both."""
        return ex.conjunction(*(self._same_cells(name, left, right) for name in left.writes | right.writes))

    def _same_cells(self, name: str, left: Row, right: Row) -> Expr:
        signature = self.model.signatures[name]
        refs = tuple(ex.Ref(f"at{i}", sort) for i, sort in enumerate(signature.sorts))
        cell = ex.Cell(name, refs, signature.of)
        return bind(True, refs, ex.equal(after(cell, left.assigns), after(cell, right.assigns)))


def _exclusive(left: Row, right: Row) -> bool:
    """Whether one row's guard has a conjunct whose negation is a conjunct of the other's."""
    mine = {c.condition for c in left.guard}
    return any(ex.negation(c.condition) in mine for c in right.guard)


def _possible(row: Row) -> Expr:
    """The guard, for some choice of the parameters that no event shows; of sets, the empty one is tried."""
    sets = frozenset(choice.name for choice in row.choices if isinstance(choice, SetOf))
    guard = _without(row.guard_formula, sets)
    read = ex.refs_of(guard)
    return bind(False, tuple(c for c in row.choices if isinstance(c, ex.Ref) and c.name in read), guard)


def _without(expr: Expr, sets: frozenset[str]) -> Expr:
    """The expression where the sets are empty."""
    if isinstance(expr, ex.Member) and expr.set in sets:
        return ex.FALSE
    return rebuilt(expr, lambda part: _without(part, sets))

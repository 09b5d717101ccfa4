"""Occurrences: what must come about in the state for an event to be announced.

An occurrence is no step: whichever row makes it come about, it has occurred once ``before`` held and then
``after`` does. So no row has to know which events it causes, and a row that is added causes them, too.
"""

from __future__ import annotations

from dataclasses import dataclass

from mmsverify.model.declare import Declared, On
from mmsverify.model.expr import Expr
from mmsverify.model.place import caller, mistake
from mmsverify.model.rows import SHOWN, Clause, Conjunct, Repair, Row
from mmsverify.model.terms import Term, formula


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A cause of an event condition: ``before`` holds, and then ``after``.

    ``transitions`` are those of the condition that it may be; who has not enrolled for all of them need not
    be told.
    """

    name: str
    condition: str
    clause: Clause
    before: Expr
    after: Expr
    transitions: frozenset[str]

    def row(self, side: Expr) -> Row:
        """One side of it as something that a message shows."""
        guard = (Conjunct(side, self.clause),)
        return Row(self.name, On("shown", self.condition), guard, (), SHOWN, self.clause)


class Occurs(Declared):
    """Declares an occurrence of the event condition ``of``, from ``before`` to ``after``."""

    repairs: Repair | None = None

    def __init__(
        self, *clauses: str, of: str, before: Term, after: Term, transitions: tuple[str, ...]
    ) -> None:
        self.place = caller()
        if not clauses:
            raise mistake("an occurrence without a clause", "cite the statement that it encodes", self.place)
        self.clause = Clause.of(*clauses)
        self.condition, self.transitions = of, frozenset(transitions)
        self.before, self.after = formula(before), formula(after)

    def occurrence(self) -> Occurrence:
        """The occurrence as plain data."""
        return Occurrence(self.name, self.condition, self.clause, self.before, self.after, self.transitions)
